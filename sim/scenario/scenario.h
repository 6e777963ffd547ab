// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A scenario as plain structs, in the units of its keys: read from its file, written with all defaults, and with the
// drawn values of a place.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/cases.h"
#include "sim/scenario/draws/variation.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/learning_spec.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/sea_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Where a scenario was read; no part of its identity.
struct ScenarioOrigin {
  std::filesystem::path folder;  // of the file: first search folder of relative paths, before the working directory
  std::shared_ptr<const ScenarioDocument> document;  // positions of its keys; null when not read from a file

  bool operator==(const ScenarioOrigin&) const { return true; }
};

// Two scenarios are equal where all keys have the same values, or are drawn from the same distributions.
struct Scenario : ScenarioOrigin {
  int version = 1;   // `seaglint: 1`
  std::string name;  // the file's name without extension when not given
  std::uint64_t seed = 42;
  RadarSpec radar;
  ViewSpec view;
  SeaSpec sea;
  SeaReflectionSpec sea_reflection;
  std::vector<TargetSpec> targets;  // in the order of the file; for `targets: {}` the one of is_sea_alone()
  ClutterSpec clutter;
  MapSpec map;
  LookSpec looks;
  DatasetSpec dataset;
  FeatureSpec features;
  LearningSpec learning;
  ReportSpec report;
  // Keys that are drawn; the fields have the middles of their distributions (drawn_scenario()).
  std::vector<Variation> variations;

  bool operator==(const Scenario&) const = default;
};

// Whether the scenario has `targets: {}`: the sea alone. Its class is then kSeaAlone, whatever dataset.classes states.
inline bool is_sea_alone(const Scenario& scenario) {
  return scenario.targets.size() == 1 && is_sea_alone(scenario.targets.front());
}

// Reads and checks a scenario. Throws InputError "file:line:col: key.path: value ...: bound", SeveralInputErrors where
// there are several: unknown or duplicate keys, wrong types, values out of range, inconsistencies of what is read
// without error. Invalid YAML is one error.
Scenario read_scenario(const std::filesystem::path& file, const std::vector<Override>& overrides = {});
Scenario parse_scenario(const std::string& yaml, const std::string& file_name,
                        const std::vector<Override>& overrides = {});

// The scenario with the drawn values of a place for its variations, of which it has none. The same for one without
// variations. Throws InputError for drawn values that contradict each other.
Scenario drawn_scenario(const Scenario& scenario, const DrawPlace& place);

// A scenario that was read, with these values of keys and without variations. Throws InputError for values out of their
// bounds and for those that contradict each other.
Scenario scenario_with(const Scenario& scenario, const std::vector<KeyValue>& values);

// What a text states of a key: "uniform(0.5, 2), drawn per sea" where the scenario draws it, else `value`.
std::string value_text(const Scenario& scenario, const std::string& key_path, std::string value);

// "file:line:col: key.path" of a key or of its closest parent in the file; the key path alone without a file.
std::string place_of(const Scenario& scenario, const std::string& key_path);

// Mesh file of a target: searched in the folder of the scenario, then in the working directory. Throws InputError when
// neither exists.
std::filesystem::path find_mesh(const Scenario& scenario, const TargetSpec& target);

// An input file of a scenario, which affects its maps.
struct InputFile {
  std::string key;             // key that names it
  std::filesystem::path path;  // where it was found
};

// All input files, those of every choice of a drawn key too, in the order of the targets; empty for a scenario of
// points. Throws an InputError of all that are missing.
std::vector<InputFile> input_files(const Scenario& scenario);

// The scenario with all defaults as YAML; read_scenario() reads it back to the same values.
std::string effective_yaml(const Scenario& scenario);

// The keys that the scenario's file gives, each under a comment with its meaning and what it allows. `head` are lines
// before them.
std::string commented_yaml(const Scenario& scenario, const std::string& head);

// Keys of a section of the effective scenario with their values as YAML; the section must not have subsections.
std::vector<std::pair<std::string, std::string>> section_values(const Scenario& scenario, const std::string& section);

}  // namespace seaglint
