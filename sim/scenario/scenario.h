// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A scenario file as plain structs, and the cases its sweeps span.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/scenario/files/override.h"
#include "sim/scenario/learning_spec.h"
#include "sim/scenario/radar_spec.h"
#include "sim/scenario/sea_spec.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct ScenarioDocument;

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
  std::filesystem::path folder;  // of the file: relative mesh paths start here, then at the working directory
  std::shared_ptr<const ScenarioDocument> document;  // where its keys stand; null when it was not read
};

// Reads and checks a scenario. Throws InputError "file:line:col: key.path: value ...: bound" for the first thing that
// is wrong: unknown or duplicate keys, wrong types, values out of range, contradictions.
Scenario read_scenario(const std::filesystem::path& file, const std::vector<Override>& overrides = {});
Scenario parse_scenario(const std::string& yaml, const std::string& file_name,
                        const std::vector<Override>& overrides = {});

// "file:line:col: key.path" of a key or of its closest parent in the file; the key path alone when nothing was read.
std::string place_of(const Scenario& scenario, const std::string& key_path);

// The file a target's mesh path names: beside the scenario or below the working directory. Throws InputError when
// neither exists.
std::filesystem::path find_mesh(const Scenario& scenario, const TargetSpec& target);

// A file that a scenario names: what decides its maps beside its own text.
struct InputFile {
  std::string key;             // that names it
  std::filesystem::path path;  // where it was found
};

// All of them, in the order of the targets; a scenario of points alone has none. Throws InputError when one is missing.
std::vector<InputFile> input_files(const Scenario& scenario);

// Reads the file that `sea.table` names, beside the scenario or below the working directory; nothing where no table is
// asked for. Throws InputError when neither exists or it is no spectrum.
std::shared_ptr<const SpectrumTable> find_spectrum_table(const Scenario& scenario);

// Reads the file that `radar.hop_code_file` names, likewise.
std::shared_ptr<const std::vector<int>> find_hop_codes(const Scenario& scenario);

// How long the echo of a range window of this full width lasts with the pulse, us; it must end before the next pulse.
double echo_duration_us(const RadarSpec& radar, double window_m);

// The sea states of the sweeps, significant wave height slowest, then peak period, gamma, propagation.
std::vector<SeaState> sea_states(const SeaSpec& spec);

// Significant wave height of the wind sea and the swell together, m.
double total_wave_height(const SeaState& state);

// The frequency where k Hs = 2, rad/s: components above it would enter the second order as ripples steeper than the
// expansion holds for. The linear cut-off on flat water.
double convergent_cutoff(const SeaState& state);

struct View {
  double azimuth_rad = 0;
  double elevation_rad = 0;
  double azimuth_deg = 0;  // as given: a turn to radians and back moves the last bit
  double elevation_deg = 0;
};

// The views of the sweeps, azimuth slowest.
std::vector<View> views(const ViewSpec& spec);

}  // namespace seaglint
