// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C while gnuplot draws: no temporary file is left, and the command ends as interrupted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

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
    Words words{"/usr/bin/env", "PATH=" + bin().string() + ":/usr/bin:/bin", kProgram};
    words.insert(words.end(), arguments.begin(), arguments.end());
    fs::remove(begun());
    const pid_t process = start_words(words, folder_.path() / "stdout", folder_.path() / "stderr");
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

}  // namespace
}  // namespace seaglint
