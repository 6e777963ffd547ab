// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/scattering_centres.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "classify/features/residual_echo.h"
#include "radar/rvmap/rv_map.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

// CLEAN (Hogbom, "Aperture synthesis with a non-regular distribution of interferometer baselines", Astron. Astrophys.
// Suppl. 15 (1974) 417), with the map recomputed from the residual echo after each round, so that no point response is
// approximated.
namespace {

// Maxima down to this far below the round's strongest are subtracted in one round, each fitted in the residual of the
// previous ones. A smaller depth saves no map, a larger one spends fits on sidelobes (-13 dB untapered in velocity).
constexpr double kRoundDepthDb = 9;
// Largest underestimation of a maximum between cells by parabolas through ln |RV| (2.8 dB for an untapered lobe half a
// cell away); maxima that are below the threshold even with this margin are not fitted.
constexpr double kParabolaShortfallDb = 3;
// Limit of fits per round, for maps of noise alone.
constexpr std::size_t kMaxFitsPerRound = 256;

double decibel_ratio(double db) { return std::pow(10, db / 10); }

// Widths of the main lobe, -3.9 dB below the peak, in units of the untapered one (1 cell): closer centres are merged.
double lobe_width(Taper taper) {
  switch (taper) {
    case Taper::kNone: return 1;
    case Taper::kHann: return 1.62;
    case Taper::kHamming: return 1.47;
    case Taper::kTaylor: return 1.35;
  }
  return 1;
}

// Power of a point of amplitude 1, summed over the resolution cells of one axis: count sum w^2 / (sum w)^2, the
// equivalent noise bandwidth (Harris, Proc. IEEE 66 (1978) 51, equation 11).
double lobe_power(Taper taper, std::size_t count) {
  double sum = 0, squares = 0;
  for (const double w : taper_samples(taper, count)) {
    sum += w;
    squares += w * w;
  }
  return static_cast<double>(count) * squares / (sum * sum);
}

struct Maximum {
  std::size_t v, r;
  double power;  // estimate between cells
};

// Ratio of the maximum of the parabola through the logarithms of three equally spaced values to the middle value.
double parabola_gain(double before, double middle, double after) {
  if (!(before > 0 && after > 0)) return 1;
  const double l = std::log(before / middle), r = std::log(after / middle);  // both <= 0 at a maximum
  return l + r < 0 ? std::exp(-(l - r) * (l - r) / (8 * (l + r))) : 1;
}

// Local maxima of |RV|^2 that can reach the threshold and `factor` times the floor, strongest first.
std::vector<Maximum> local_maxima(const RvMap& map, double threshold, double factor, const std::vector<double>& floor) {
  const std::size_t rows = map.velocity_mps.size(), columns = map.columns();
  const double shortfall = decibel_ratio(kParabolaShortfallDb);
  std::vector<double> power(map.values.size());
  for (std::size_t i = 0; i < power.size(); ++i) power[i] = std::norm(map.values[i]);
  std::vector<Maximum> maxima;
  for (std::size_t v = 0; v < rows; ++v) {
    for (std::size_t r = 0; r < columns; ++r) {
      const std::size_t i = v * columns + r;
      const double here = power[i];
      if (here <= floor[i]) continue;
      bool highest = true;
      for (std::size_t y = v > 0 ? v - 1 : 0; y <= std::min(v + 1, rows - 1); ++y) {
        for (std::size_t x = r > 0 ? r - 1 : 0; x <= std::min(r + 1, columns - 1); ++x) {
          highest = highest && power[y * columns + x] <= here;
        }
      }
      if (!highest) continue;
      double estimate = here;
      if (r > 0 && r + 1 < columns) estimate *= parabola_gain(power[i - 1], here, power[i + 1]);
      if (v > 0 && v + 1 < rows) estimate *= parabola_gain(power[i - columns], here, power[i + columns]);
      if (estimate * shortfall >= std::max(threshold, factor * floor[i])) maxima.push_back({v, r, estimate});
    }
  }
  std::sort(maxima.begin(), maxima.end(), [](const Maximum& a, const Maximum& b) {
    return a.power != b.power ? a.power > b.power : a.v != b.v ? a.v < b.v : a.r < b.r;
  });
  return maxima;
}

double step_of(const std::vector<double>& axis, double otherwise) {
  return axis.size() > 1 ? axis[1] - axis[0] : otherwise;
}

// Merges the components of one main lobe: those within half a lobe are added (a loop gain below 1 gives several), those
// between half and one lobe are remainders of a stronger one.
std::vector<CleanComponent> merge(std::vector<CleanComponent> components, double lobe_r, double lobe_v) {
  const auto stronger = [](const CleanComponent& a, const CleanComponent& b) {
    return std::norm(a.amplitude_m) > std::norm(b.amplitude_m);
  };
  std::stable_sort(components.begin(), components.end(), stronger);
  std::vector<CleanComponent> merged;
  for (const CleanComponent& part : components) {
    bool taken = false;
    for (CleanComponent& whole : merged) {
      const double distance =
          std::hypot((part.range_m - whole.range_m) / lobe_r, (part.velocity_mps - whole.velocity_mps) / lobe_v);
      if (distance >= 1) continue;
      if (distance < 0.5) whole.amplitude_m += part.amplitude_m;
      taken = true;
      break;
    }
    if (!taken) merged.push_back(part);
  }
  std::stable_sort(merged.begin(), merged.end(), stronger);
  return merged;
}

}  // namespace

CleanedMap clean_map(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& map_spec,
                     bool intra_pulse_motion, const FeatureSpec& spec, const StopFlag* stop) {
  const double cell_r = train.range_resolution_m(), cell_v = train.velocity_resolution_mps();
  const double lobe_r = cell_r * lobe_width(map_spec.range_taper),
               lobe_v = cell_v * lobe_width(map_spec.velocity_taper);
  const double depth = decibel_ratio(-spec.dynamic_range_db);
  const auto max_components = static_cast<std::size_t>(std::ceil(4 * spec.max_centres / spec.clean_gain));

  ResidualEcho residual(echo, train, map_spec, intra_pulse_motion);
  RvMap map = residual.map(stop);
  const double step_r = step_of(map.range_m, cell_r), step_v = step_of(map.velocity_mps, cell_v);
  const double factor = threshold_factor(static_cast<double>(map.values.size()) /
                                         (map_spec.range_oversampling * map_spec.velocity_oversampling));
  std::vector<CleanComponent> components;
  std::vector<double> floor = residual_floor(map);
  double strongest = 0;  // power
  bool found = true;
  while (found && components.size() < max_components) {
    found = false;
    const std::vector<Maximum> maxima = local_maxima(map, depth * strongest, factor, floor);
    if (maxima.empty()) break;
    // A maximum below the round's depth, relative to the strongest accepted maximum, may be a sidelobe or pedestal of a
    // stronger one and is left to the next map. A rejected maximum, such as a ridge of clutter, does not set this
    // level.
    double round_floor = 0;
    std::size_t fits = 0;
    for (const Maximum& cell : maxima) {
      if (stop != nullptr && *stop) throw Interrupted();
      if (cell.power < round_floor) break;
      if (++fits > kMaxFitsPerRound || components.size() >= max_components) break;
      CleanComponent point = residual.fit(map.range_m[cell.r], map.velocity_mps[cell.v], step_r, step_v);
      const double power = std::norm(point.amplitude_m);
      if (power < depth * strongest || power < factor * floor[cell.v * map.columns() + cell.r]) continue;
      if (power < round_floor) continue;
      if (!found) round_floor = cell.power * decibel_ratio(-kRoundDepthDb);
      strongest = std::max(strongest, power);
      point.amplitude_m *= spec.clean_gain;
      residual.subtract(point);
      components.push_back(point);
      found = true;
    }
    if (!found) break;
    if (merge(components, lobe_r, lobe_v).size() >= static_cast<std::size_t>(spec.max_centres) && spec.clean_gain == 1)
      break;
    map = residual.map(stop);
    floor = residual_floor(map);
  }

  // Accepted by the final residual, in which no centre's pedestal raises the floor.
  if (!components.empty()) {
    map = residual.map(stop);
    floor = residual_floor(map);
  }
  std::vector<CleanComponent> points = merge(components, lobe_r, lobe_v);
  // With a loop gain below 1 a part of every centre remains in the residual.
  for (CleanComponent& point : points) {
    if (spec.clean_gain < 1) point.amplitude_m += residual.value(point.range_m, point.velocity_mps);
  }
  const CellSizes cells{cell_r,
                        cell_v,
                        map_spec.range_oversampling,
                        map_spec.velocity_oversampling,
                        lobe_power(map_spec.range_taper, static_cast<std::size_t>(train.band_bins())),
                        lobe_power(map_spec.velocity_taper, train.pulses())};
  const std::vector<bool> stays = exceeds_local_level(points, map, floor, factor, depth * strongest, cells);
  std::vector<ScatteringCentre> centres;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!stays[i]) continue;
    if (centres.size() >= static_cast<std::size_t>(spec.max_centres)) break;
    centres.push_back({points[i].range_m, points[i].velocity_mps, std::abs(points[i].amplitude_m)});
  }
  return {std::move(centres), std::move(components), std::move(map)};
}

namespace {

// sum of w_i e^{j a (x_i - x_0)} over i, for weights that add up to 1.
Complex lobe(const std::vector<double>& weight, const std::vector<double>& x, double a, double x_0) {
  Complex sum;
  for (std::size_t i = 0; i < x.size(); ++i) sum += weight[i] * std::polar(1.0, a * (x[i] - x_0));
  return sum;
}

std::vector<double> normalised(std::vector<double> weight) {
  double total = 0;
  for (const double w : weight) total += w;
  for (double& w : weight) w /= total;
  return weight;
}

}  // namespace

RvMap restored_map(const CleanedMap& cleaned, const PulseTrain& train, const MapSpec& map_spec) {
  const auto bins = static_cast<std::size_t>(train.band_bins());
  std::vector<double> frequency_hz(bins);
  for (std::size_t k = 0; k < bins; ++k)
    frequency_hz[k] =
        train.first_carrier_hz + train.baseband_hz.front() + static_cast<double>(k) * train.baseband_step_hz;
  const std::vector<double> range_weight = normalised(taper_samples(map_spec.range_taper, bins));
  const std::vector<double> velocity_weight = normalised(taper_samples(map_spec.velocity_taper, train.pulses()));

  RvMap map = cleaned.residual;
  const double centre_hz = train.band_centre_hz(), per_hz = 4 * kPi / kSpeedOfLight;
  for (const CleanComponent& point : cleaned.components) {
    std::vector<Complex> along_range, along_velocity;
    for (const double r : map.range_m)
      along_range.push_back(lobe(range_weight, frequency_hz, per_hz * (r - point.range_m), centre_hz));
    for (const double v : map.velocity_mps)
      along_velocity.push_back(lobe(velocity_weight, train.time_s, per_hz * centre_hz * (v - point.velocity_mps), 0));
    for (std::size_t v = 0; v < along_velocity.size(); ++v) {
      for (std::size_t r = 0; r < along_range.size(); ++r)
        map.values[v * map.columns() + r] += point.amplitude_m * along_velocity[v] * along_range[r];
    }
  }
  return map;
}

}  // namespace seaglint
