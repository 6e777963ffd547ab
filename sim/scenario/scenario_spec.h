// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A scenario file as plain structs, in the units of its keys.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/scenario/draws/variation.h"
#include "sim/scenario/learning_spec.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/sea_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct Scenario {
  int version = 1;   // `seaglint: 1`
  std::string name;  // the file's name without extension when not given
  std::uint64_t seed = 42;
  RadarSpec radar;
  ViewSpec view;
  SeaSpec sea;
  SeaReflectionSpec sea_reflection;
  std::vector<TargetSpec> targets;  // in the order of the file
  ClutterSpec clutter;
  MapSpec map;
  DatasetSpec dataset;
  FeatureSpec features;
  LearningSpec learning;
  std::filesystem::path folder;  // of the file: first search folder of relative paths, before the working directory
  std::shared_ptr<const ScenarioDocument> document;  // positions of its keys; null when not read from a file
  // Keys that are drawn; the fields have the middles of their distributions (drawn_scenario()).
  std::vector<Variation> variations;
};

}  // namespace seaglint
