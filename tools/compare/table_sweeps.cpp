// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/table_sweeps.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/scattering/beams/bistatic_geometry.h"
#include "tools/compare/cut_angles.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

// The values of a cut by frequency and direction.
class ValuesByPlace {
 public:
  explicit ValuesByPlace(const RcsCut& cut) {
    places_.reserve(cut.values.size());
    for (const FieldValue& value : cut.values) {
      const Steps s = steps(value.frequency_hz, azimuth_of(cut, value.phi_deg), 90 - value.theta_deg);
      places_.try_emplace(key(s.frequency, s.azimuth, s.elevation), &value);
    }
  }
  // Rounding may give equal values neighbouring keys.
  const FieldValue* at(double frequency_hz, double azimuth_deg, double elevation_deg) const {
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

 private:
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
  std::unordered_map<std::uint64_t, const FieldValue*> places_;
};

}  // namespace

std::vector<RcsSweep> table_sweeps(const RcsCut& cut, const RcsCut& other) {
  const ValuesByPlace values(other);
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
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      std::vector<std::array<Complex, 4>>& row = model.matrices.emplace_back();
      for (const double f : sweep.frequency_hz) {
        const double az = sweep.azimuth_of(view), el = sweep.elevation_of(view);
        const FieldValue& value = *values.at(f, az, el);
        const Vec3 r = direction_to_radar(radians(az), radians(el));
        const Complex turn =
            std::polar(1.0, 2 * kPi * f / kSpeedOfLight * (sweep.transmitter.value_or(r) + r).dot(other.origin_m));
        std::array<Complex, 4>& matrix = row.emplace_back();
        matrix[static_cast<std::size_t>(other.element)] =
            value.amplitude_m ? *value.amplitude_m * turn : Complex(amplitude_of_dbsm(value.level_dbsm));
      }
    }
    sweep.models.push_back(std::move(model));
  }
  return sweeps;
}

}  // namespace seaglint
