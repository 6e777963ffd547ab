// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "sim/core/numbers/fourier.h"
#include "sim/core/process/parallel.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/pipeline/program.h"
#include "tests/sanitized.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

// Ctrl-C while gnuplot draws: no temporary file is left, and the command ends as interrupted.

class InterruptedFigure : public testing::Test {
 protected:
  // A gnuplot that reports its start and then runs longer than the test's time limit, so that a program that waits for
  // it fails the test.
  void SetUp() override {
    fs::create_directories(bin());
    fs::create_directories(out());
    write_file(bin() / "gnuplot", "#!/bin/sh\ntouch '" + begun().string() + "'\nexec sleep 3000\n");
    fs::permissions(bin() / "gnuplot", fs::perms::owner_all);
  }

  fs::path out() const { return folder_.path() / "out"; }

  // Exit code, or 128 + n when signal n ended it, of the program that receives a signal as soon as gnuplot runs.
  int signalled(const Words& arguments, int signal, std::string* said = nullptr) {
    fs::remove(begun());
    const pid_t process =
        start_words(with({"/usr/bin/env", "PATH=" + bin().string() + ":/usr/bin:/bin", kProgram}, arguments),
                    folder_.path() / "stdout", folder_.path() / "stderr");
    int status = 0;
    bool ended = false;
    while (!fs::exists(begun()) && !ended) {
      ended = ::waitpid(process, &status, WNOHANG) == process;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_FALSE(ended) << arguments[0] << ": " << read_file(folder_.path() / "stderr");
    if (!ended) {
      ::kill(process, signal);
      ::waitpid(process, &status, 0);
    }
    if (said) *said = read_file(folder_.path() / "stderr");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  Words left() const {
    Words names;
    for (const auto& entry : fs::directory_iterator(out())) names.push_back(entry.path().filename());
    return names;
  }

 private:
  fs::path bin() const { return folder_.path() / "bin"; }
  fs::path begun() const { return folder_.path() / "begun"; }

  TemporaryFolder folder_;
};

TEST_F(InterruptedFigure, OfACommandThatEndsImmediatelyLeavesNoFile) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(signalled({"map", "scenarios/points.yaml", "-o", out() / "map.png"}, signal), 128 + signal);
    EXPECT_THAT(left(), testing::IsEmpty());
  }
}

TEST_F(InterruptedFigure, OfOtherCommandsMakesThemFail) {
  write_file(out() / "cut.csv", "# frequency_hz theta_deg phi_deg dBsm\n1e10 90 0 -3\n1e10 90 1 -3\n");
  for (const Words& words :
       {Words{"sea", "scenarios/points.yaml", "--duration-s", "20", "--figure", out() / "sea.png", "-o",
              out() / "sea.csv"},
        Words{"motion", "scenarios/quick.yaml", "--duration-s", "20", "--figure", out() / "m.png", "-o",
              out() / "m.csv"},
        Words{"rcs", "--target", "assets/icosahedral_reflector.glb", "--frequency-ghz", "10", "--azimuth-deg", "0:1:1",
              "-o", out() / "rcs.csv", "--reference", out() / "cut.csv", "--reference-polarisation", "vv"}}) {
    std::string said;
    EXPECT_EQ(signalled(words, SIGINT, &said), 1) << words[0];
    EXPECT_THAT(said, testing::HasSubstr("seaglint: interrupted\n"));
    for (const std::string& name : left()) EXPECT_TRUE(name.ends_with(".csv")) << name;
  }
}

// Without memory a command ends with exit code 1 and one line; it neither crashes nor waits for ever.

TEST(MemoryLimit, OfTheAddressSpaceEndsARunWithOneLine) {
  if (kSanitized) GTEST_SKIP() << "sanitizers take more address space";
  int refused = 0;
  // MB; the program takes some 90, its network's library 560 more, a whole run 850.
  for (const int limit : {150, 300, 450, 600, 672, 716, 740, 850, 950}) {
    const TemporaryFolder folder;
    const ProgramResult result = run_words(
        {"/bin/bash", "-c", "ulimit -v " + std::to_string(limit * 1024) + "; exec timeout -k 5 60 \"$@\"", "limited",
         kProgram, "run", "scenarios/points.yaml", "-o", folder.path() / "run", "--set", "learning.epochs=2"});
    EXPECT_TRUE(result.code == 0 || result.code == 1)
        << limit << " MB: exit code " << result.code << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), result.code) << limit << " MB: " << result.err;
    refused += result.code;
  }
  EXPECT_GT(refused, 0);
}

// Constructors of libraries' static objects need memory before the program begins.
TEST(MemoryLimit, BelowWhatLibrariesNeedToBeginEndsWithOneLine) {
  if (kSanitized) GTEST_SKIP() << "sanitizers take more address space";
  int refused = 0;
  for (int limit = 60; limit <= 110; limit += 2) {
    const ProgramResult result =
        run_words({"/bin/bash", "-c", "ulimit -v " + std::to_string(limit * 1024) + "; exec \"$@\"", "limited",
                   kProgram, "--version"});
    // 127: the system cannot load the libraries.
    EXPECT_THAT(result.code, testing::AnyOf(0, 1, 127)) << limit << " MB: " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), result.code == 0 ? 0 : 1) << result.err;
    if (result.code == 1) {
      EXPECT_EQ(result.err, "seaglint: out of memory\n") << limit << " MB";
    }
    refused += result.code != 0;
  }
  EXPECT_GT(refused, 0);
}

// Stages that run concurrently in one process use the same libraries safely.

TEST(Threads, SolverAndRadarPlanTheirTransformsConcurrently) {
  const Scatterer plate(make_plate(0.2, 0.2));
  IntervalSampling sampling;
  sampling.first_hz = 16e9;
  sampling.step_hz = 1e6;
  sampling.count = 20;
  sampling.frequencies_per_pulse = 10;
  for (int pulse = 0; pulse < 8; ++pulse) {
    sampling.pulse_first.push_back(pulse % 2 * 10);
    sampling.pulse_time_s.push_back(250e-6 * pulse);
  }
  const Trajectory rest = Trajectory::at_rest(Vec3::Zero());
  const auto plan_both = [&](std::size_t i) {
    if (i % 2 == 0) {
      interval_response(plate, rest, Vec3::UnitX(), Polarisation::kVv, sampling, SolverSpec{.min_patch_m = 0.0035});
    } else {
      for (std::size_t length = 8; length < 300; ++length) FourierBatch(length + i % 7, 1, Fourier::kForward).execute();
    }
  };
  // FFTW's planner, used by two stages without a common lock, corrupted the heap within some hundreds of plans.
  parallel_for(400, 4, plan_both);
}

}  // namespace
}  // namespace seaglint
