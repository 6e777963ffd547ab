// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/scenario/material_spec.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using ::testing::StartsWith;

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
  EXPECT_EQ(refusal_of([&] { find_mesh(scenario, target); }),
            "targets.ship.mesh: value 'b.glb': no such file, " + places_text("elsewhere"));
}

// Material files: their contents are read into the struct, and every error is reported with its place.

const std::string kCoating = R"(material: coating
source: a test
kind: layers
backing: pec
roughness_mm: 0.2
layers:
  - thickness_mm: 1.2
    permittivity: {real: 5, debye: [{strength: 3, relaxation_ghz: 12}], conductivity_s_m: 0.1}
    permeability: {table: [{frequency_ghz: 8, real: 1.4, loss: 0.5}, {frequency_ghz: 18, real: 1.1, loss: 0.7}]}
)";

std::string refusal(const std::string& yaml) {
  return refusal_of([&] { parse_material(yaml, "m.yaml"); });
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(MaterialFile, IsReadIntoTheStruct) {
  const MaterialSpec spec = parse_material(kCoating, "m.yaml");
  EXPECT_EQ(spec.name, "coating");
  EXPECT_EQ(spec.kind, SurfaceKind::kLayers);
  EXPECT_EQ(spec.backing, Backing::kPec);
  EXPECT_EQ(spec.roughness_mm, 0.2);
  ASSERT_EQ(spec.layers.size(), 1u);
  EXPECT_EQ(spec.layers[0].thickness_mm, 1.2);
  EXPECT_EQ(spec.layers[0].permittivity.debye[0].relaxation_ghz, 12);
  EXPECT_EQ(spec.layers[0].permittivity.conductivity_s_m, 0.1);
  EXPECT_EQ(spec.layers[0].permeability.table[1].loss, 0.7);
}

TEST(MaterialFile, RefusesMediaThatWouldAmplify) {
  EXPECT_THAT(
      refusal(with(kCoating, "real: 5", "real: 5, loss: -0.1")),
      StartsWith("m.yaml:8:35: layers.0.permittivity.loss: value '-0.1': must be a number within 0 and 100000"));
  EXPECT_HAS(refusal(with(kCoating, "strength: 3", "strength: -3")), "layers.0.permittivity.debye.0.strength");
  EXPECT_HAS(refusal(with(kCoating, "loss: 0.5", "loss: -0.5")), "layers.0.permeability.table.0.loss");
  EXPECT_HAS(refusal(with(kCoating, "conductivity_s_m: 0.1", "conductivity_s_m: -1")), "conductivity_s_m");
  EXPECT_THAT(refusal("material: x\nsource: y\nkind: impedance\nresistance: -0.2\n"),
              StartsWith("m.yaml:4:13: resistance: value '-0.2'"));
}

TEST(MaterialFile, NamesEveryOtherMistake) {
  EXPECT_HAS(refusal(with(kCoating, "kind: layers", "kind: layer")), "m.yaml:3:7: kind: value 'layer'");
  EXPECT_HAS(refusal(with(kCoating, "backing: pec", "resistance: 1")), "valid only with kind: impedance");
  EXPECT_HAS(refusal(with(kCoating, "thickness_mm", "thicknes_mm")), "did you mean 'thickness_mm'?");
  EXPECT_HAS(refusal(with(kCoating, "thickness_mm: 1.2", "thickness_mm: 0")), "greater than 0");
  EXPECT_HAS(refusal(with(kCoating, "frequency_ghz: 18", "frequency_ghz: 8")), "must be greater than the row before");
  EXPECT_HAS(refusal(with(kCoating, "permeability: {table", "permeability: {conductivity_s_m: 1, table")),
             "valid only with a permittivity");
  EXPECT_HAS(refusal("material: x\nsource: y\nkind: layers\n"), "layers: this key is missing");
  EXPECT_HAS(refusal("material: x\nkind: pec\n"), "source: this key is missing");
  EXPECT_HAS(refusal("material: x\nsource: y\nkind: sea_water\ntemperature_c: 40\n"), "temperature_c");
  EXPECT_HAS(refusal("material: x\nsource: y\nkind: pec\nlowest_ghz: 5\nhighest_ghz: 4\n"), "at least lowest_ghz");
  EXPECT_HAS(refusal(""), "the file is empty");
}

TEST(MaterialFile, IsFoundByNameOrPath) {
  const std::string root = SEAGLINT_SOURCE_DIR;
  EXPECT_EQ(find_material("pec", "", "x").kind, SurfaceKind::kPec);
  EXPECT_EQ(find_material("sea_water", root, "x").kind, SurfaceKind::kSeaWater);
  EXPECT_EQ(find_material(root + "/assets/materials/aluminium.yaml", "", "x").conductivity_s_m, 3.816e7);
  EXPECT_EQ(refusal_of([&] { find_material("aluminum", root, "targets.ship.material"); }),
            "targets.ship.material: value 'aluminum': no such material in assets/materials, " + places_text(root) +
                ": did you mean 'aluminium'?");
  const auto refusal = [](const std::string& name, const std::string& folder) {
    return refusal_of([&] { find_material(name, folder, "x"); });
  };
  EXPECT_HAS(refusal("unobtainium", ""),
             "no such material in assets/materials, neither in the working directory nor in ");
  EXPECT_EQ(refusal("none.yaml", "/there"), "x: value 'none.yaml': no such material file, " + places_text("/there"));
  EXPECT_EQ(refusal("none.yaml", ""), "x: value 'none.yaml': no such material file, " + places_text(""));
}

TEST(MaterialFile, BrokenFilesAreReadOrRefusedWithAnInputError) {
  for (std::uint64_t i = 0; i < 5000; ++i) {
    Random random({4, Stream::kTest, i});
    std::string text = kCoating;
    for (std::uint32_t change = 0; change < 1 + random.below(4); ++change) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
      switch (random.below(3)) {
        case 0: text.erase(at, random.below(12)); break;
        case 1: text[at] = static_cast<char>(random.below(256)); break;
        default: text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(text.size())), random.below(20)));
      }
    }
    try {
      parse_material(text, "m.yaml");
    } catch (const InputError&) {
    }
  }
}

// The scenarios of the project are valid and have the sizes of their table.

std::size_t map_count(const Scenario& scenario) {
  return sea_states(scenario.sea).size() * views(scenario.view).size() * scenario.targets.size() *
         static_cast<std::size_t>(scenario.dataset.maps_per_case);
}

TEST(ShippedScenarios, AreValidAndRoundTripThroughTheirEffectiveForm) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SEAGLINT_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    ++count;
    const Scenario scenario = read_scenario(entry.path());
    const std::string effective = effective_yaml(scenario);
    EXPECT_EQ(effective_yaml(parse_scenario(effective, entry.path())), effective) << entry.path();
    EXPECT_TRUE(parse_scenario(effective, entry.path()) == scenario) << entry.path();
    EXPECT_EQ(scenario.name, entry.path().stem()) << entry.path();
  }
  EXPECT_GE(count, 3);
}

TEST(ShippedScenarios, HaveTheSizesOfTheirTable) {
  const std::map<std::string, std::size_t> sizes{{"quick", 300}, {"paper", 10200}, {"realistic", 180},
                                                 {"points", 40}, {"clutter", 16},  {"fleet", 2000}};
  for (const auto& [name, maps] : sizes)
    EXPECT_EQ(map_count(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/" + name + ".yaml")), maps) << name;
}

}  // namespace
}  // namespace seaglint
