// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/view_grids.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

std::vector<ViewGrid> view_grids(std::span<const ViewPoint> points) {
  using Direction = std::pair<double, double>;  // elevation, azimuth
  std::map<Direction, std::vector<double>> frequencies;
  std::vector<ViewPoint> sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const ViewPoint& p : sorted) frequencies[{p.elevation_deg, p.azimuth_deg}].push_back(p.frequency_hz);

  std::map<std::vector<double>, std::map<double, std::vector<double>>> azimuths;  // by frequencies, then elevation
  for (const auto& [direction, list] : frequencies) azimuths[list][direction.first].push_back(direction.second);

  std::vector<ViewGrid> grids;
  for (const auto& [list, rows] : azimuths) {
    std::map<std::vector<double>, std::vector<double>> elevations;  // by azimuths
    for (const auto& [elevation, row] : rows) elevations[row].push_back(elevation);
    for (const auto& [row, column] : elevations) grids.push_back({list, row, column});
  }
  return grids;
}

std::vector<ViewGrid> cuts_of(const ViewGrid& grid) {
  const std::size_t azimuths = grid.azimuth_deg.size(), elevations = grid.elevation_deg.size();
  const bool along_frequency = grid.frequency_hz.size() > std::max(azimuths, elevations);
  std::vector<ViewGrid> cuts;
  const auto add = [&](const std::vector<double>& azimuth_deg, const std::vector<double>& elevation_deg) {
    cuts.push_back({grid.frequency_hz, azimuth_deg, elevation_deg});
  };
  if (along_frequency) {
    for (const double el : grid.elevation_deg) {
      for (const double az : grid.azimuth_deg) add({az}, {el});
    }
  } else if (azimuths >= elevations) {
    for (const double el : grid.elevation_deg) add(grid.azimuth_deg, {el});
  } else {
    for (const double az : grid.azimuth_deg) add({az}, grid.elevation_deg);
  }
  return cuts;
}

double azimuth_of(const RcsCut& cut, double phi_deg) {
  return std::remainder((phi_deg - cut.phi_offset_deg) / cut.phi_scale, 360);
}

ViewPoint view_point(const RcsCut& cut, const FieldValue& value) {
  return {value.frequency_hz, azimuth_of(cut, value.phi_deg), 90 - value.theta_deg};
}

const DeclaredTransmitter& stated_transmitter(const RcsCut& cut) {
  if (cut.transmitter) return *cut.transmitter;
  throw InputError(fmt::format(
      "{}: neither the file nor its name says where the incident wave comes from: give --incidence monostatic "
      "or --incidence THETA,PHI",
      cut.name));
}

std::optional<FixedTransmitter> fixed_transmitter(const RcsCut& cut) {
  const DeclaredTransmitter& transmitter = stated_transmitter(cut);
  if (transmitter.is_monostatic) return std::nullopt;
  return FixedTransmitter{azimuth_of(cut, transmitter.phi_deg), 90 - transmitter.theta_deg};
}

namespace {

// The values of a cut by frequency and direction.
class ValuesByPlace {
 public:
  explicit ValuesByPlace(const RcsCut& cut) : cut_(cut) {}

  // Tries the value after the one found before: tables are mostly in the same order.
  const FieldValue* at(double frequency_hz, double azimuth_deg, double elevation_deg) {
    if (next_ < cut_.values.size() && is_at(cut_.values[next_], frequency_hz, azimuth_deg, elevation_deg))
      return &cut_.values[next_++];
    const FieldValue* found = found_by_key(frequency_hz, azimuth_deg, elevation_deg);
    if (found != nullptr) next_ = static_cast<std::size_t>(found - cut_.values.data()) + 1;
    return found;
  }

 private:
  bool is_at(const FieldValue& value, double frequency_hz, double azimuth_deg, double elevation_deg) const {
    const ViewPoint p = view_point(cut_, value);
    return std::abs(p.frequency_hz - frequency_hz) <= 1e-6 * frequency_hz &&
           std::abs(p.azimuth_deg - azimuth_deg) <= 1e-3 && std::abs(p.elevation_deg - elevation_deg) <= 1e-3;
  }

  // Rounding may give equal values neighbouring keys.
  const FieldValue* found_by_key(double frequency_hz, double azimuth_deg, double elevation_deg) {
    if (places_.empty()) fill_places();
    const Steps s = steps(frequency_hz, azimuth_deg, elevation_deg);
    for (const long f : {0L, -1L, 1L}) {
      for (const long az : {0L, -1L, 1L}) {
        for (const long el : {0L, -1L, 1L}) {
          const auto place = places_.find(key(s.frequency + f, s.azimuth + az, s.elevation + el));
          if (place != places_.end()) return place->second;
        }
      }
    }
    return nullptr;
  }

  void fill_places() {
    places_.reserve(cut_.values.size());
    for (const FieldValue& value : cut_.values) {
      const ViewPoint p = view_point(cut_, value);
      const Steps s = steps(p.frequency_hz, p.azimuth_deg, p.elevation_deg);
      places_.try_emplace(key(s.frequency, s.azimuth, s.elevation), &value);
    }
  }

  // A millionth of the frequency, thousandths of a degree.
  struct Steps {
    long frequency, azimuth, elevation;
  };
  static Steps steps(double frequency_hz, double azimuth_deg, double elevation_deg) {
    return {std::lround(std::log(frequency_hz) * 1e6), std::lround(azimuth_deg * 1e3),
            std::lround(elevation_deg * 1e3)};
  }
  static std::uint64_t key(long frequency, long azimuth, long elevation) {
    constexpr long kCircle = 360'000;
    const auto turn = static_cast<std::uint64_t>((azimuth % kCircle + kCircle) % kCircle);
    return (static_cast<std::uint64_t>(frequency) << 37) ^ (turn << 18) ^
           static_cast<std::uint64_t>(elevation + 100'000);
  }

  const RcsCut& cut_;
  std::size_t next_ = 0;  // after the value that was found last
  std::unordered_map<std::uint64_t, const FieldValue*> places_;
};

}  // namespace

std::vector<RcsSweep> table_sweeps(const RcsCut& cut, const RcsCut& other) {
  ValuesByPlace values(other);
  std::vector<ViewPoint> points;
  for (const FieldValue& value : cut.values) {
    const ViewPoint p = view_point(cut, value);
    if (values.at(p.frequency_hz, p.azimuth_deg, p.elevation_deg) != nullptr) points.push_back(p);
  }
  std::vector<RcsSweep> sweeps;
  for (const ViewGrid& grid : view_grids(points)) {
    RcsRequest request;
    request.frequency_hz = grid.frequency_hz;
    request.azimuth_deg = grid.azimuth_deg;
    request.elevation_deg = grid.elevation_deg;
    request.transmitter = fixed_transmitter(cut);
    RcsSweep& sweep = sweeps.emplace_back(requested_sweep(request));
    RcsSweep::Model model{other.name, true, {}};
    model.matrices.assign(sweep.views(), std::vector<std::array<Complex, 4>>(sweep.frequency_hz.size()));
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      const double f = sweep.frequency_hz[q], k = 2 * kPi * f / kSpeedOfLight;
      for (std::size_t view = 0; view < sweep.views(); ++view) {
        const double az = sweep.azimuth_of(view), el = sweep.elevation_of(view);
        const FieldValue& value = *values.at(f, az, el);
        Complex amplitude = value.amplitude_m.value_or(amplitude_of_dbsm(value.level_dbsm));
        if (value.amplitude_m && !other.origin_m.isZero(1e-12)) {
          const Vec3 r = direction_to_radar(radians(az), radians(el));
          amplitude *= std::polar(1.0, k * (sweep.transmitter.value_or(r) + r).dot(other.origin_m));
        }
        model.matrices[view][q][static_cast<std::size_t>(other.element)] = amplitude;
      }
    }
    sweep.models.push_back(std::move(model));
  }
  return sweeps;
}

}  // namespace seaglint
