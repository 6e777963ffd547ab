// SPDX-License-Identifier: BSD-3-Clause
#include "radar/rvmap/scr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr double kBoxDepthDb =
    10;  // dB: above the random-hop pedestal (-15 dB and below), below the stronger centres of a ship

double largest_power(const RvMap& map) {
  double largest = 0;
  for (const Complex& value : map.values) largest = std::max(largest, std::norm(value));
  return largest;
}

double box_power(const RvMap& map, const MapExtent& box) {
  double sum = 0;
  for (std::size_t v = box.velocity_first; v <= box.velocity_last; ++v) {
    for (std::size_t r = box.range_first; r <= box.range_last; ++r) sum += std::norm(map.at(v, r));
  }
  return sum /
         static_cast<double>((box.velocity_last - box.velocity_first + 1) * (box.range_last - box.range_first + 1));
}

double decibel(double ratio) { return 10 * std::log10(ratio); }

}  // namespace

MapExtent target_extent(const RvMap& target) {
  const double threshold = largest_power(target) * std::pow(10, -kBoxDepthDb / 10);
  MapExtent box{target.columns(), 0, target.velocity_mps.size(), 0};
  for (std::size_t v = 0; v < target.velocity_mps.size(); ++v) {
    for (std::size_t r = 0; r < target.columns(); ++r) {
      if (std::norm(target.at(v, r)) < threshold) continue;
      box.range_first = std::min(box.range_first, r);
      box.range_last = std::max(box.range_last, r);
      box.velocity_first = std::min(box.velocity_first, v);
      box.velocity_last = std::max(box.velocity_last, v);
    }
  }
  return box;
}

ReceivedInterval form_received_interval(const Echo& echo, const PulseTrain& train, const ClutterSpec& clutter,
                                        const MapSpec& spec, bool intra_pulse_motion) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  ReceivedInterval received;
  received.echo = echo.target;
  received.map = form_rv_map(echo.target, train, spec, intra_pulse_motion);
  received.scr = {kNone, kNone, kNone, kNone};
  const auto add = [&](const std::vector<Complex>& part, const RvMap& map, double gain) {
    for (std::size_t i = 0; i < part.size(); ++i) received.echo[i] += gain * part[i];
    for (std::size_t i = 0; i < map.values.size(); ++i) received.map.values[i] += gain * map.values[i];
  };

  double gain_db = 0;
  if (!echo.clutter.empty()) {
    const RvMap clutter_map = form_rv_map(echo.clutter, train, spec, intra_pulse_motion);
    const double clutter_cell = mean_power(clutter_map.values);
    const double target_peak = largest_power(received.map);
    if (!(target_peak > 0 && clutter_cell > 0)) {
      throw InputError(
          fmt::format("map: no power in the map's window (target {} m^2, clutter {} m^2)", target_peak, clutter_cell));
    }
    MeasuredRatios& scr = received.scr;
    scr.per_pulse_db = decibel(mean_power(echo.target) / mean_power(echo.clutter));
    scr.peak_cell_db = decibel(target_peak / clutter_cell);
    scr.scr_extent_db = decibel(box_power(received.map, target_extent(received.map)) / clutter_cell);
    const double measured = clutter.scr_definition == ScrDefinition::kPerPulse   ? scr.per_pulse_db
                            : clutter.scr_definition == ScrDefinition::kPeakCell ? scr.peak_cell_db
                                                                                 : scr.scr_extent_db;
    if (clutter.level == ClutterLevel::kScr) gain_db = measured - clutter.scr_db;
    for (double* ratio : {&scr.per_pulse_db, &scr.peak_cell_db, &scr.scr_extent_db}) *ratio -= gain_db;
    add(echo.clutter, clutter_map, std::pow(10, gain_db / 20));
  }
  if (!echo.noise.empty()) {
    const double noise_db = clutter.noise_level == NoiseLevel::kCnr ? gain_db : 0;
    received.scr.snr_per_pulse_db = decibel(mean_power(echo.target) / mean_power(echo.noise)) - noise_db;
    add(echo.noise, form_rv_map(echo.noise, train, spec, intra_pulse_motion), std::pow(10, noise_db / 20));
  }
  return received;
}

}  // namespace seaglint
