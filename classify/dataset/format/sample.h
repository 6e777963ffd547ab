// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// One sample of a data set: a range-velocity map with its label and provenance, and the faults of a stored one that are
// found without its scenario.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace seaglint {

// A value that the scenario draws for a sample (/drawn of shard.h).
template <class T>
struct DrawnValue {
  std::string key;  // its path in the scenario, "sea.peak_period_s"
  T value = {};

  bool operator==(const DrawnValue&) const = default;
};

// The metadata of a sample, one column each (sample_columns() gives units and meaning).
struct SampleRecord {
  std::int64_t sample = 0;
  std::int64_t label = 0;
  std::int64_t target = 0;
  std::string target_name;
  std::string layout;
  std::int64_t bodies = 1;
  std::int64_t group = 0;
  std::int64_t sea_state = 0;
  double significant_wave_height_m = 0;
  double peak_period_s = 0;
  double gamma = 0;
  double propagation_deg = 0;
  double swell_wave_height_m = 0;
  double depth_m = 0;
  std::int64_t view = 0;
  double azimuth_deg = 0;
  double elevation_deg = 0;
  std::int64_t realisation = 0;
  std::int64_t interval = 0;
  double start_s = 0;
  std::int64_t seed = 0;
  std::int64_t sea_key = 0;
  std::int64_t sea_id = 0;
  std::int64_t first_motion_key = 0;
  std::int64_t radar_key = 0;
  std::int64_t unused_carriers = 0;
  double scr_per_pulse_db = 0;
  double scr_peak_cell_db = 0;
  double scr_extent_db = 0;
  double snr_per_pulse_db = 0;
  double peak_m = 0;
  double energy_m2 = 0;
  double mwr = 0;
  double ccf = 0;
  double sigma_r_m = 0;
  double sigma_v_mps = 0;
  std::int64_t centres = 0;
  std::int64_t degenerate = 0;
  std::int64_t aspect_traces = 0;
  double roll_deg = 0;
  double pitch_deg = 0;
  double yaw_deg = 0;
  double heave_m = 0;
  double roll_rate_deg_s = 0;
  double pitch_rate_deg_s = 0;
  double yaw_rate_deg_s = 0;
  double heave_rate_mps = 0;
  std::vector<DrawnValue<double>> drawn_numbers = {};  // by their keys
  std::vector<DrawnValue<std::string>> drawn_words = {};
};

// True if two samples have the same drawn keys and values.
bool same_drawn(const SampleRecord& a, const SampleRecord& b);

struct SampleColumn {
  const char* name;
  const char* unit;  // "1" if dimensionless
  const char* description;
  std::variant<std::int64_t SampleRecord::*, double SampleRecord::*, std::string SampleRecord::*> member;
};

// Every column of a shard's /samples group, in the order of SampleRecord; drawn values have columns of their own.
std::span<const SampleColumn> sample_columns();
// Descriptions of the label and of any column in a data set of these classes (names by label): "0 = decoys, 1 = ship".
std::string label_description(std::span<const std::string> classes);
std::string description_of(const SampleColumn& column, std::span<const std::string> classes);

// A scattering centre as stored: range_m, velocity_mps, amplitude_m.
using StoredCentre = std::array<float, 3>;

struct Sample {
  SampleRecord record;
  std::vector<float> magnitude;  // |RV| in metres, [velocity][range]
  std::vector<float>
      complex_values;  // real and imaginary part alternating, [velocity][range][2]; empty unless dataset.complex_maps
  std::vector<double> echo;  // of the target alone, real and imaginary part alternating, m, [pulse][frequency][2];
                             // empty unless dataset.echoes
  std::vector<std::uint16_t> hop_code;    // C_n of every pulse
  std::vector<StoredCentre> centre_list;  // strongest first
  std::vector<Sample> further_looks;      // the second one on; empty within them
};

inline std::size_t look_count(const Sample& sample) { return 1 + sample.further_looks.size(); }
inline const Sample& look_of(const Sample& sample, std::size_t look) {
  return look == 0 ? sample : sample.further_looks.at(look - 1);
}

// Columns that differ between looks: start and random key, and everything measured or of the motion.
const std::vector<SampleColumn>& look_columns();

// The axes that all maps of a data set share.
struct StoredAxes {
  std::vector<double> range_m;       // relative to the target's reference point, positive = farther
  std::vector<double> velocity_mps;  // positive = receding

  std::size_t cells() const { return range_m.size() * velocity_mps.size(); }
  bool operator==(const StoredAxes&) const = default;
};

// What is wrong with the numbers of a sample, one sentence each: values of the map that are no magnitudes (negative or
// not finite), a peak or an energy that is not the map's, complex values whose magnitudes are not the map's, scattering
// centres and columns that are not finite (ratios to clutter or noise are NaN where there is none).
std::vector<std::string> sample_faults(const Sample& sample);

}  // namespace seaglint
