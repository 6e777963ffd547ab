// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/scenario/scenario.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

TEST(Cases, SeaStatesRunThroughTheSweepsWithTheHeightSlowest) {
  SeaSpec spec;
  spec.significant_wave_height_m = {1, 2};
  spec.peak_period_s = {7, 8};
  spec.gamma = {1, 3.3};
  spec.propagation_deg = {90, 180};
  const auto states = sea_states(spec);
  ASSERT_EQ(states.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(states[i].significant_wave_height_m, i < 8 ? 1 : 2);
    EXPECT_EQ(states[i].peak_period_s, i / 4 % 2 == 0 ? 7 : 8);
    EXPECT_EQ(states[i].gamma, i / 2 % 2 == 0 ? 1 : 3.3);
    EXPECT_DOUBLE_EQ(states[i].propagation_rad, i % 2 == 0 ? kPi / 2 : kPi);
  }
}

TEST(Cases, AutomaticCutoffsFollowTheirFormulas) {
  SeaSpec spec;
  spec.significant_wave_height_m = {0, 2};
  spec.peak_period_s = {2, 8};
  const auto states = sea_states(spec);
  EXPECT_DOUBLE_EQ(states[2].cutoff_rad_s, 4 * kPi);
  EXPECT_DOUBLE_EQ(states[3].cutoff_rad_s, 8);
  EXPECT_DOUBLE_EQ(states[3].second_order_cutoff_rad_s, std::sqrt(kGravity));
  EXPECT_DOUBLE_EQ(states[1].second_order_cutoff_rad_s, 8);
  spec.cutoff_rad_s = 5;
  spec.second_order_cutoff_rad_s = 3;
  EXPECT_EQ(sea_states(spec)[0].cutoff_rad_s, 5);
  EXPECT_EQ(sea_states(spec)[0].second_order_cutoff_rad_s, 3);
}

TEST(Cases, ViewsRunThroughTheSweepsWithTheAzimuthSlowest) {
  const auto all = views({{0, 90}, {1, 2, 3}});
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[2].azimuth_rad, 0);
  EXPECT_DOUBLE_EQ(all[2].elevation_rad, radians(3));
  EXPECT_DOUBLE_EQ(all[3].azimuth_rad, kPi / 2);
}

TEST(Cases, TheFilesThatAScenarioNamesAreListedByTheirKeys) {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  for (const char* name : {"a.glb", "steel.yaml", "moves.csv", "codes.txt"}) std::ofstream(folder / name) << "x";
  Scenario scenario;
  scenario.folder = folder;
  scenario.radar.hop_code = HopCode::kFile;
  scenario.radar.hop_code_file = "codes.txt";
  TargetSpec ship;
  ship.name = "ship";
  ship.mesh = "a.glb";
  ship.part_materials = {{"mast*", "pec"}, {"hull", "steel.yaml"}};
  ship.motion.file = "moves.csv";
  TargetSpec points;
  points.name = "points";
  points.points.push_back({});
  scenario.targets = {ship, points};
  std::string listed;
  for (const InputFile& file : input_files(scenario)) listed += file.key + " " + file.path.filename().string() + "\n";
  EXPECT_EQ(listed,
            "radar.hop_code_file codes.txt\n"
            "targets.ship.mesh a.glb\n"
            "targets.ship.motion.file moves.csv\n"
            "targets.ship.part_materials.1.material steel.yaml\n");
  fs::remove(folder / "moves.csv");
  EXPECT_THROW(input_files(scenario), InputError);
}

TEST(Cases, AMeshIsFoundBesideTheScenarioOrBelowTheWorkingDirectory) {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  std::ofstream(folder / "a.glb") << "x";
  Scenario scenario;
  scenario.folder = folder;
  TargetSpec target;
  target.name = "ship";
  target.mesh = "a.glb";
  EXPECT_EQ(find_mesh(scenario, target), folder / "a.glb");
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  scenario.folder = "elsewhere";
  EXPECT_EQ(find_mesh(scenario, target), "a.glb");
  fs::current_path(before);
  target.mesh = "b.glb";
  try {
    find_mesh(scenario, target);
    ADD_FAILURE() << "a mesh that does not exist was found";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "targets.ship.mesh: value 'b.glb': no such file, " + places_text("elsewhere"));
  }
}

}  // namespace
}  // namespace seaglint
