// SPDX-License-Identifier: BSD-3-Clause
// Named files are found in the folder that is given, the working directory and the data of the program, in this order;
// a name that finds none is refused with the one that it means.
#include "sim/core/text/names.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class NamedFile : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"given", "here", "data/scenarios"}) fs::create_directories(root() / name);
    fs::current_path(root() / "here");
    set_data_folder(root() / "data");
  }
  void TearDown() override {
    fs::current_path(before_);
    set_data_folder(data_before_);
  }
  fs::path root() const { return folder_.path(); }
  void make(const std::string& name) const { write_file(root() / name, "x"); }

  const fs::path before_ = fs::current_path(), data_before_ = data_folder();
  const TemporaryFolder folder_;
};

TEST_F(NamedFile, IsSearchedInTheDataOfTheProgramLast) {
  const auto found = [&] { return find_file("a", root() / "given", "key"); };
  EXPECT_EQ(refusal_of(found), fmt::format("key: value 'a': no such file, neither in {0}/given nor in the working "
                                           "directory nor in {0}/data",
                                           root().string()));
  make("data/a");
  EXPECT_EQ(found(), root() / "data/a");
  make("here/a");
  EXPECT_EQ(found(), "a");
  make("given/a");
  EXPECT_EQ(found(), root() / "given/a");
  EXPECT_EQ(find_file("a", "", "key"), "a");
  EXPECT_EQ(refusal_of([&] { find_file("/none/a", root() / "given", "key"); }), "key: value '/none/a': no such file");
}

TEST_F(NamedFile, OfAScenarioNeedsNoFolder) {
  make("data/scenarios/quick.yaml");
  EXPECT_EQ(find_input("quick.yaml", "scenarios"), root() / "data/scenarios/quick.yaml");
  EXPECT_EQ(find_input("scenarios/quick.yaml", "scenarios"), root() / "data/scenarios/quick.yaml");
  EXPECT_EQ(refusal_of([&] { find_input("quick.yaml"); }),
            fmt::format("quick.yaml: no such file, neither in the working directory nor in {}/data: did you mean "
                        "'scenarios/quick.yaml'?",
                        root().string()));
  make("here/quick.yaml");
  EXPECT_EQ(find_input("quick.yaml", "scenarios"), "quick.yaml");
  set_data_folder("");
  EXPECT_EQ(refusal_of([&] { find_input("none", "scenarios"); }), "none: no such file, not in the working directory");
}

TEST_F(NamedFile, ThatIsMisspeltIsSuggestedAsItMustBeWritten) {
  for (const char* folder : {"data/assets/materials", "given/meshes"}) fs::create_directories(root() / folder);
  for (const char* file : {"data/assets/combatant_144m.glb", "data/assets/materials/steel.yaml", "given/hull.obj",
                           "given/meshes/decoy.stl", "given/.secret.obj", "data/scenarios/quick.yaml"})
    make(file);
  const std::pair<const char*, const char*> meant[] = {{"combatant_144.glb", "assets/combatant_144m.glb"},
                                                       {"combatant_144m.stl", "assets/combatant_144m.glb"},
                                                       {"asset/combatant_144m.glb", "assets/combatant_144m.glb"},
                                                       {"hul.obj", "hull.obj"},
                                                       {"decoy.stl", "meshes/decoy.stl"},
                                                       {"meshes/decoi.stl", "meshes/decoy.stl"},
                                                       {"assets/materials/stel.yaml", "assets/materials/steel.yaml"}};
  for (const auto& [written, right] : meant) {
    const std::string message = refusal_of([&name = written, this] { find_file(name, root() / "given", "key"); });
    EXPECT_TRUE(message.ends_with(fmt::format("/data: did you mean '{}'?", right))) << message;
    EXPECT_NE(find_file(right, root() / "given", "key"), fs::path());
  }
  EXPECT_EQ(refusal_of([&] { find_file((root() / "given/hall.obj").string(), "", "key"); }),
            fmt::format("key: value '{0}/given/hall.obj': no such file: did you mean '{0}/given/hull.obj'?",
                        root().string()));
  for (const char* far : {"secret.obj", "frigate.glb"})
    EXPECT_TRUE(refusal_of([&] { find_file(far, root() / "given", "key"); }).ends_with("/data")) << far;
  const std::string scenario = refusal_of([] { find_input("quik.yaml", "scenarios"); });
  EXPECT_TRUE(scenario.ends_with("/scenarios: did you mean 'scenarios/quick.yaml'?")) << scenario;
}

TEST(DataFolder, IsTheSourceTreeOfAProgramInItsBuildFolder) {
  EXPECT_TRUE(std::filesystem::equivalent(data_folder(), SEAGLINT_SOURCE_DIR)) << data_folder();
}

// A misspelt word means the name that is nearest to it, with or without its unit, or that begins with it.

const std::vector<std::string> kRadar{"carrier_ghz",   "hop_count",      "hop_step_mhz", "hop_code",
                                      "bandwidth_mhz", "pulse_width_us", "sampling_mhz", "pri_us",
                                      "pri_jitter_us", "pulses"};

TEST(Suggestion, IsTheNearestNameByLettersOrByTheNameWithoutItsUnit) {
  const std::pair<const char*, const char*> meant[] = {{"carier_ghz", "carrier_ghz"},
                                                       {"pulse", "pulses"},
                                                       {"bandwidth", "bandwidth_mhz"},
                                                       {"carrier", "carrier_ghz"},
                                                       {"bandwidth_hz", "bandwidth_mhz"},
                                                       {"Pulse_Width", "pulse_width_us"},
                                                       {"pri", "pri_us"},
                                                       {"pri_s", "pri_us"},
                                                       {"bandwith", "bandwidth_mhz"},
                                                       {"sampling_rate_mhz", "sampling_mhz"},
                                                       {"jitter", "pri_jitter_us"},
                                                       {"hop_step_hz", "hop_step_mhz"}};
  for (const auto& [word, name] : meant)
    EXPECT_EQ(suggestion(word, kRadar), "did you mean '" + std::string(name) + "'?");
  EXPECT_EQ(suggestion("--frequency", {"--frequency-ghz", "--facets"}), "did you mean '--frequency-ghz'?");
  EXPECT_EQ(suggestion("bandwidth", {"radar.bandwidth_mhz", "sea.gamma"}), "did you mean 'radar.bandwidth_mhz'?");
}

TEST(Suggestion, NamesSeveralThatBeginWithTheWord) {
  EXPECT_EQ(suggestion("hop", kRadar), "did you mean 'hop_count', 'hop_step_mhz' or 'hop_code'?");
}

TEST(Suggestion, IsTheWholeListWhenNoNameIsNear) {
  EXPECT_EQ(suggestion("colour", {"a", "b"}), "must be one of a, b");
  EXPECT_EQ(near_suggestion("colour", {"a", "b"}), std::nullopt);
  EXPECT_EQ(near_suggestion(std::string(10000, 'a'), {"a"}), std::nullopt);
  EXPECT_EQ(near_suggestion("", {}), std::nullopt);
}

}  // namespace
}  // namespace seaglint
