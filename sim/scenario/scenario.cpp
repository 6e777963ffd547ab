// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/data_folder.h"
#include "sim/core/process/file.h"
#include "sim/core/process/utf8.h"
#include "sim/scenario/contradictions.h"
#include "sim/scenario/files/document.h"
#include "sim/scenario/files/hop_code_file.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/material_file.h"
#include "sim/scenario/material_spec.h"
#include "sim/scenario/reader.h"

namespace seaglint {

namespace fs = std::filesystem;

std::string place_of(const Scenario& scenario, const std::string& key_path) {
  return scenario.document ? scenario.document->place_of(key_path) : key_path;
}

namespace {

// Default name of a scenario: its file name, printable characters only.
std::string name_of_file(const fs::path& file) {
  std::string name = file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '_');
  for (std::size_t i = utf8_prefix(name); i < name.size(); i = utf8_prefix(name)) name[i] = '_';
  return name.empty() ? "scenario" : name;
}

// The file named by a key.
fs::path file_of(const Scenario& scenario, const std::string& name, const std::string& key) {
  return find_file(name, scenario.folder, place_of(scenario, key));
}

// Reads the file of `sea.table`; null without a table.
std::shared_ptr<const SpectrumTable> find_spectrum_table(const Scenario& scenario) {
  if (scenario.sea.spectrum != SpectrumKind::kTable || scenario.sea.table.empty()) return nullptr;
  return std::make_shared<SpectrumTable>(read_spectrum_table(file_of(scenario, scenario.sea.table, "sea.table")));
}

// Reads the file of `radar.hop_code_file`, likewise.
std::shared_ptr<const std::vector<int>> find_hop_codes(const Scenario& scenario) {
  const RadarSpec& radar = scenario.radar;
  if (radar.hop_code != HopCode::kFile || radar.hop_code_file.empty()) return nullptr;
  const fs::path file = file_of(scenario, radar.hop_code_file, "radar.hop_code_file");
  return std::make_shared<std::vector<int>>(read_hop_code(file, radar.pulses, radar.carrier_count));
}

}  // namespace

Scenario read_scenario(const fs::path& file, const std::vector<Override>& overrides) {
  return parse_scenario(read_file(file, kMaxYamlBytes), file.string(), overrides);
}

Scenario parse_scenario(const std::string& yaml, const std::string& file_name, const std::vector<Override>& overrides) {
  const auto read = std::make_shared<ScenarioDocument>(ScenarioDocument{file_name, {}, parse_yaml(yaml, file_name)});
  ScenarioDocument& document = *read;
  for (const Override& override_value : overrides) apply_override(document, override_value);
  Scenario scenario = read_fields(document);
  scenario.document = read;
  scenario.folder = fs::path(file_name).parent_path();
  scenario.sea.table_values = find_spectrum_table(scenario);
  scenario.radar.hop_codes = find_hop_codes(scenario);
  check_contradictions(scenario, document);
  if (scenario.name.empty()) scenario.name = name_of_file(file_name);
  return scenario;
}

fs::path find_mesh(const Scenario& scenario, const TargetSpec& target) {
  return file_of(scenario, target.mesh, fmt::format("targets.{}.mesh", target.name));
}

std::vector<InputFile> input_files(const Scenario& scenario) {
  std::vector<InputFile> files;
  const auto add = [&](const std::string& name, const std::string& key) {
    if (!name.empty()) files.push_back({key, file_of(scenario, name, key)});
  };
  if (scenario.radar.hop_code == HopCode::kFile) add(scenario.radar.hop_code_file, "radar.hop_code_file");
  if (scenario.sea.spectrum == SpectrumKind::kTable) add(scenario.sea.table, "sea.table");
  for (const TargetSpec& target : scenario.targets) {
    const std::string path = "targets." + target.name;
    add(target.mesh, path + ".mesh");
    add(target.motion.sections, path + ".motion.sections");
    add(target.motion.file, path + ".motion.file");
    const auto add_material = [&](const std::string& name, const std::string& key) {
      if (const auto file = find_material_file(name, scenario.folder, place_of(scenario, key)))
        files.push_back({key, *file});
    };
    add_material(target.material, path + ".material");
    for (std::size_t i = 0; i < target.part_materials.size(); ++i) {
      add_material(target.part_materials[i].material, fmt::format("{}.part_materials.{}.material", path, i));
    }
  }
  return files;
}

}  // namespace seaglint
