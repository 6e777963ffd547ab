// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <variant>

#include "sim/scenario/learning_spec.h"

namespace seaglint {
namespace {
constexpr const char* kLabelOfDefault = "1 = ship, 0 = corner-reflector array";
}

bool same_drawn(const SampleRecord& a, const SampleRecord& b) {
  return a.drawn_numbers == b.drawn_numbers && a.drawn_words == b.drawn_words;
}

std::span<const SampleColumn> sample_columns() {
  using R = SampleRecord;
  static const SampleColumn columns[] = {
      {"sample", "1", "number of the sample in the scenario's enumeration", &R::sample},
      {"label", "1", kLabelOfDefault, &R::label},
      {"target", "1", "index of the target in the scenario file", &R::target},
      {"target_name", "1", "name of the target in the scenario file", &R::target_name},
      {"layout", "1", "layout of the target's bodies: single, line, ring, grid or random", &R::layout},
      {"bodies", "1", "number of the target's bodies, without its companions", &R::bodies},
      {"group", "1", "sea realisation; maps of one group belong on one side of a split", &R::group},
      {"sea_state", "1", "index of the sea state in the scenario's sweeps", &R::sea_state},
      {"significant_wave_height_m", "m", "significant wave height Hs", &R::significant_wave_height_m},
      {"peak_period_s", "s", "peak period Tp of the wave spectrum", &R::peak_period_s},
      {"gamma", "1", "JONSWAP peak enhancement", &R::gamma},
      {"propagation_deg", "deg", "direction the waves travel towards, target frame", &R::propagation_deg},
      {"swell_wave_height_m", "m", "significant wave height of the swell", &R::swell_wave_height_m},
      {"depth_m", "m", "water depth; 0 = deep water", &R::depth_m},
      {"view", "1", "index of the view in the scenario's sweeps", &R::view},
      {"azimuth_deg", "deg", "direction to the radar, target frame, 0 = ahead of the bow", &R::azimuth_deg},
      {"elevation_deg", "deg", "elevation of the radar seen from the target", &R::elevation_deg},
      {"realisation", "1", "sea realisation within the sea state", &R::realisation},
      {"interval", "1", "coherent interval within the realisation", &R::interval},
      {"start_s", "s", "time of the interval's first pulse within the realisation", &R::start_s},
      {"seed", "1", "seed of the scenario", &R::seed},
      {"sea_key", "1", "random key of the sea", &R::sea_key},
      {"sea_id", "1", "number of seed and sea_key, equal in every data set with this sea's random numbers", &R::sea_id},
      {"first_motion_key", "1", "random key of the target's first body; further bodies follow", &R::first_motion_key},
      {"radar_key", "1", "random key of clutter and noise, and of the hop code of all maps of its interval",
       &R::radar_key},
      {"unused_carriers", "1", "carriers that no pulse of the interval used (zero band)", &R::unused_carriers},
      {"scr_per_pulse_db", "dB", "target to clutter, mean over pulses and frequencies", &R::scr_per_pulse_db},
      {"scr_peak_cell_db", "dB", "target's largest cell to mean clutter cell", &R::scr_peak_cell_db},
      {"scr_extent_db", "dB", "target to clutter inside the target's own box", &R::scr_extent_db},
      {"snr_per_pulse_db", "dB", "target to receiver noise, mean over pulses and frequencies", &R::snr_per_pulse_db},
      {"peak_m", "m", "largest |RV| of the map", &R::peak_m},
      {"energy_m2", "m2", "sum of |RV|^2 over the map", &R::energy_m2},
      {"mwr", "(m/s)^2", "mean weighted residual of the range-velocity line", &R::mwr},
      {"ccf", "1", "complementary contrast factor of the spreads", &R::ccf},
      {"sigma_r_m", "m", "standard deviation of the centres' ranges", &R::sigma_r_m},
      {"sigma_v_mps", "m/s", "standard deviation of the centres' velocities", &R::sigma_v_mps},
      {"centres", "1", "number of scattering centres", &R::centres},
      {"degenerate", "1", "1 when fewer than 3 centres were found", &R::degenerate},
      {"aspect_traces", "1", "look directions traced, all bodies and propagation paths", &R::aspect_traces},
      {"roll_deg", "deg", "roll of the target's first body (of a rigid raft: the raft) in mid-interval", &R::roll_deg},
      {"pitch_deg", "deg", "its pitch, > 0 = bow down", &R::pitch_deg},
      {"yaw_deg", "deg", "its yaw", &R::yaw_deg},
      {"heave_m", "m", "heave of its centre of rotation", &R::heave_m},
      {"roll_rate_deg_s", "deg/s", "rate of roll_deg", &R::roll_rate_deg_s},
      {"pitch_rate_deg_s", "deg/s", "rate of pitch_deg", &R::pitch_rate_deg_s},
      {"yaw_rate_deg_s", "deg/s", "rate of yaw_deg", &R::yaw_rate_deg_s},
      {"heave_rate_mps", "m/s", "rate of heave_m", &R::heave_rate_mps},
  };
  return columns;
}

const std::vector<SampleColumn>& look_columns() {
  static const std::vector<SampleColumn> columns = [] {
    constexpr std::string_view kOfSample[] = {"seed", "sea_key", "sea_id", "first_motion_key"};
    const auto all = sample_columns();
    auto column = std::ranges::find(all, std::string_view("start_s"), &SampleColumn::name);
    std::vector<SampleColumn> found;
    for (; column != all.end(); ++column)
      if (std::ranges::find(kOfSample, std::string_view(column->name)) == std::end(kOfSample)) found.push_back(*column);
    return found;
  }();
  return columns;
}

std::string label_description(std::span<const std::string> classes) {
  if (std::ranges::equal(classes, default_classes())) return kLabelOfDefault;
  std::string text;
  for (std::size_t label = 0; label < classes.size(); ++label)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", label, classes[label]);
  return text;
}

std::string description_of(const SampleColumn& column, std::span<const std::string> classes) {
  return std::string_view(column.name) == "label" ? label_description(classes) : column.description;
}

namespace {

// Relative tolerance: peak, energy and magnitude are computed before map and complex values are rounded to single
// precision (6e-8 each).
constexpr double kSinglePrecision = 1e-6;
constexpr double kSmallest = std::numeric_limits<float>::min();  // m; rounding of smaller values is not relative

bool differ(double a, double b, double smallest) {
  return !(std::abs(a - b) <= std::max(smallest, kSinglePrecision * std::max(std::abs(a), std::abs(b))));
}

void check_columns(const SampleRecord& record, std::vector<std::string>& faults) {
  for (const SampleColumn& column : sample_columns()) {
    const auto* member = std::get_if<double SampleRecord::*>(&column.member);
    if (member == nullptr) continue;
    const double value = record.*(*member);
    const std::string_view name = column.name;
    const bool may_be_missing = name.starts_with("scr_") || name.starts_with("snr_");
    if (!std::isfinite(value) && !(may_be_missing && std::isnan(value)))
      faults.push_back(fmt::format("{} {} is not finite", name, value));
  }
  for (const auto& [key, value] : record.drawn_numbers)
    if (!std::isfinite(value)) faults.push_back(fmt::format("{} {} is not finite", key, value));
}

// Peak and energy only if every value is a magnitude.
void check_map(const Sample& sample, std::vector<std::string>& faults) {
  double peak = 0, energy = 0;
  for (const float value : sample.magnitude) {
    if (!std::isfinite(value) || value < 0) {
      faults.push_back(fmt::format("{} in the map is no magnitude", value));
      return;
    }
    peak = std::max<double>(peak, value);
    energy += static_cast<double>(value) * value;
  }
  if (differ(peak, sample.record.peak_m, kSmallest))
    faults.push_back(fmt::format("peak_m {:.9g}, the map's {:.9g}", sample.record.peak_m, peak));
  if (differ(energy, sample.record.energy_m2, kSmallest * kSmallest))
    faults.push_back(fmt::format("energy_m2 {:.9g}, the map's {:.9g}", sample.record.energy_m2, energy));
  for (std::size_t i = 0; 2 * i + 1 < sample.complex_values.size(); ++i) {
    const double magnitude = std::hypot(static_cast<double>(sample.complex_values[2 * i]),
                                        static_cast<double>(sample.complex_values[2 * i + 1]));
    if (differ(magnitude, sample.magnitude[i], kSmallest)) {
      faults.push_back(fmt::format("complex value of magnitude {:.9g}, the map's {:.9g}", magnitude,
                                   static_cast<double>(sample.magnitude[i])));
      return;
    }
  }
}

}  // namespace

std::vector<std::string> sample_faults(const Sample& sample) {
  std::vector<std::string> faults;
  check_map(sample, faults);
  if (!std::ranges::all_of(sample.echo, [](double value) { return std::isfinite(value); }))
    faults.emplace_back("a value of the echo is not finite");
  check_columns(sample.record, faults);
  for (const StoredCentre& centre : sample.centre_list) {
    const auto finite = [](float value) { return std::isfinite(value); };
    if (std::all_of(centre.begin(), centre.end(), finite)) continue;
    faults.push_back(
        fmt::format("scattering centre at {} m, {} m/s, {} m is not finite", centre[0], centre[1], centre[2]));
    break;
  }
  return faults;
}

}  // namespace seaglint
