// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

double CoherentInterval::range_cell_m() const { return kSpeedOfLight / (2 * bandwidth_hz); }
double CoherentInterval::velocity_cell_mps() const { return wavelength_m / (2 * duration_s); }

namespace {

void require_positive(double value, const char* name) {
  if (!(value > 0 && std::isfinite(value))) throw InputError(fmt::format("{} {}: must be positive", name, value));
}

}  // namespace

PointErrors cramer_rao_errors(double amplitude_over_floor, const CoherentInterval& interval) {
  require_positive(amplitude_over_floor, "amplitude over floor");
  require_positive(interval.bandwidth_hz, "bandwidth_hz");
  require_positive(interval.duration_s, "duration_s");
  require_positive(interval.wavelength_m, "wavelength_m");
  const double phase_slope = std::sqrt(6.0) / amplitude_over_floor;  // rad over the whole band or interval
  return {phase_slope * kSpeedOfLight / (4 * kPi * interval.bandwidth_hz),
          phase_slope * interval.wavelength_m / (4 * kPi * interval.duration_s)};
}

LookCentre with_errors(const ScatteringCentre& centre, double floor_m, const CoherentInterval& interval,
                       double fit_error_cells) {
  require_positive(centre.amplitude_m, "amplitude_m");
  require_positive(floor_m, "floor_m");
  const PointErrors bound = cramer_rao_errors(centre.amplitude_m / floor_m, interval);
  return {centre, std::hypot(bound.range_m, fit_error_cells * interval.range_cell_m()),
          std::hypot(bound.velocity_mps, fit_error_cells * interval.velocity_cell_mps())};
}

int Track::looks_seen() const {
  return static_cast<int>(
      std::count_if(points.begin(), points.end(), [](const TrackPoint& point) { return point.seen(); }));
}

// Assignment.

namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();

// Dual variables and the assignment so far. Each row has a column of its own beside those of the costs, for
// `unassigned`, so that a complete assignment always exists.
class ShortestPaths {
 public:
  ShortestPaths(const Matrix<double>& cost, double unassigned)
      : cost_(cost),
        unassigned_(unassigned),
        columns_(cost.columns() + cost.rows()),
        row_dual_(cost.rows()),
        column_dual_(columns_),
        column_of_(cost.rows(), kNone),
        row_of_(columns_, kNone) {}

  // Assigns one more row, by the path of the smallest reduced cost to a free column.
  void add(std::size_t first_row) {
    std::vector<double> distance(columns_, kForbidden);
    std::vector<std::size_t> before(columns_, kNone);  // row that reaches the column
    std::vector<bool> done(columns_);
    double smallest = 0;
    std::size_t row = first_row, column = kNone;
    do {
      for (std::size_t j = 0; j < columns_; ++j) {
        const double through = done[j] ? kForbidden : smallest + at(row, j) - row_dual_[row] - column_dual_[j];
        if (through < distance[j]) std::tie(distance[j], before[j]) = std::pair(through, row);
      }
      column = kNone;
      for (std::size_t j = 0; j < columns_; ++j)
        if (!done[j] && (column == kNone || distance[j] < distance[column])) column = j;
      smallest = distance[column];
      done[column] = true;
      row = row_of_[column];
    } while (row != kNone);
    update_duals(first_row, smallest, distance, done);
    augment(first_row, column, before);
  }

  std::size_t column_of(std::size_t row) const { return column_of_[row]; }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  double at(std::size_t row, std::size_t column) const {
    if (column < cost_.columns()) return cost_(row, column);
    return column == cost_.columns() + row ? unassigned_ : kForbidden;
  }

  void update_duals(std::size_t first_row, double smallest, const std::vector<double>& distance,
                    const std::vector<bool>& done) {
    row_dual_[first_row] += smallest;
    for (std::size_t j = 0; j < columns_; ++j) {
      if (!done[j]) continue;
      column_dual_[j] += distance[j] - smallest;
      if (row_of_[j] != kNone) row_dual_[row_of_[j]] += smallest - distance[j];
    }
  }

  void augment(std::size_t first_row, std::size_t column, const std::vector<std::size_t>& before) {
    for (std::size_t row = kNone; row != first_row;) {
      row = before[column];
      row_of_[column] = row;
      std::swap(column_of_[row], column);
    }
  }

  const Matrix<double>& cost_;
  double unassigned_;
  std::size_t columns_;
  std::vector<double> row_dual_, column_dual_;
  std::vector<std::size_t> column_of_, row_of_;
};

}  // namespace

std::vector<int> assignment(const Matrix<double>& cost, double unassigned) {
  SEAGLINT_CHECK(std::isfinite(unassigned), fmt::format("unassigned = {}", unassigned));
  ShortestPaths paths(cost, unassigned);
  for (std::size_t row = 0; row < cost.rows(); ++row) paths.add(row);
  std::vector<int> result;
  for (std::size_t row = 0; row < cost.rows(); ++row)
    result.push_back(paths.column_of(row) < cost.columns() ? static_cast<int>(paths.column_of(row)) : -1);
  return result;
}

// Association.

namespace {

// A track that may continue, or has ended.
struct OpenTrack {
  Track track;
  std::size_t last = 0;  // look in which it was last seen

  const LookCentre& latest() const { return track.points[last].measured; }
};

struct PairCost {
  double value = 0;  // sum of the deviations over their scales
  bool in_gate = false;
};

PairCost pair_cost(const LookCentre& from, const LookCentre& to, double dt_s, const TrackSettings& settings) {
  const double dr = std::abs(to.range_m - from.range_m - dt_s * (from.velocity_mps + to.velocity_mps) / 2);
  const double dv = std::abs(to.velocity_mps - from.velocity_mps);
  const double dl = std::abs(20 * std::log10(to.amplitude_m / from.amplitude_m));
  return {dr / settings.range_scale_m + dv / (settings.velocity_scale_mps + settings.acceleration_scale_mps2 * dt_s) +
              dl / settings.level_scale_db,
          dr <= settings.range_gate_m && dv <= settings.velocity_gate_mps + settings.acceleration_gate_mps2 * dt_s &&
              dl <= settings.level_gate_db};
}

// Indices of a look's centres by range, velocity and amplitude.
std::vector<std::size_t> by_range(const Look& look) {
  std::vector<std::size_t> order(look.centres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [&](std::size_t i) {
      const LookCentre& centre = look.centres[i];
      return std::tuple(centre.range_m, centre.velocity_mps, centre.amplitude_m, i);
    };
    return key(a) < key(b);
  });
  return order;
}

void require_valid(std::span<const Look> looks) {
  for (std::size_t k = 0; k < looks.size(); ++k) {
    const double time_s = looks[k].time_s;
    if (!std::isfinite(time_s) || (k > 0 && !(time_s > looks[k - 1].time_s)))
      throw InputError(fmt::format("look {}: time_s {}: must be finite and increase", k, time_s));
    for (const LookCentre& centre : looks[k].centres) {
      if (!std::isfinite(centre.range_m) || !std::isfinite(centre.velocity_mps))
        throw InputError(
            fmt::format("look {}: centre at {} m, {} m/s: must be finite", k, centre.range_m, centre.velocity_mps));
      require_positive(centre.amplitude_m, "amplitude_m");
      require_positive(centre.range_error_m, "range_error_m");
      require_positive(centre.velocity_error_mps, "velocity_error_mps");
    }
  }
}

// Costs of the centres (columns, in the given order) for the open tracks (rows). A row without a column costs more than
// every set of pairs that could replace it, so that the assignment has the most pairs.
struct Costs {
  Matrix<double> pairs;
  double unassigned = 1;
};

Costs pair_costs(const std::vector<OpenTrack>& tracks, const std::vector<std::size_t>& open,
                 std::span<const Look> looks, std::size_t k, const std::vector<std::size_t>& order,
                 const TrackSettings& settings) {
  Costs costs{Matrix<double>(open.size(), order.size())};
  double largest = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const OpenTrack& track = tracks[open[i]];
    for (std::size_t j = 0; j < order.size(); ++j) {
      const double dt_s = looks[k].time_s - looks[track.last].time_s;
      const PairCost cost = pair_cost(track.latest(), looks[k].centres[order[j]], dt_s, settings);
      costs.pairs(i, j) = cost.in_gate ? cost.value : kForbidden;
      if (cost.in_gate) largest = std::max(largest, cost.value);
    }
  }
  costs.unassigned = 1 + largest * static_cast<double>(open.size());
  return costs;
}

}  // namespace

TrackSet associate(std::span<const Look> looks, const TrackSettings& settings) {
  require_valid(looks);
  std::vector<OpenTrack> tracks;
  for (std::size_t k = 0; k < looks.size(); ++k) {
    const std::vector<std::size_t> order = by_range(looks[k]);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < tracks.size(); ++i)
      if (k - tracks[i].last <= static_cast<std::size_t>(settings.missed_looks) + 1) open.push_back(i);

    const Costs costs = pair_costs(tracks, open, looks, k, order, settings);
    const std::vector<int> column = assignment(costs.pairs, costs.unassigned);
    std::vector<bool> continues(order.size());
    const auto see = [&](OpenTrack& track, std::size_t centre) {
      track.track.points[k] = {static_cast<int>(centre), looks[k].centres[centre]};
      track.last = k;
    };
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (column[i] < 0) continue;
      const auto j = static_cast<std::size_t>(column[i]);
      see(tracks[open[i]], order[j]);
      continues[j] = true;
    }
    for (std::size_t j = 0; j < order.size(); ++j) {
      if (continues[j]) continue;
      tracks.push_back({Track{std::vector<TrackPoint>(looks.size())}});
      see(tracks.back(), order[j]);
    }
  }

  TrackSet result;
  for (const Look& look : looks) result.time_s.push_back(look.time_s);
  const double least = settings.seen_fraction * static_cast<double>(looks.size()) - 1e-9;  // rounding of the product
  for (OpenTrack& track : tracks)
    if (track.track.looks_seen() >= least) result.tracks.push_back(std::move(track.track));
  return result;
}

}  // namespace seaglint
