// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/geometry/look_basis.h"

#include <cmath>

namespace seaglint {

Vec3 direction_to_radar(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

RadarBasis radar_basis(const Vec3& r_hat) {
  RadarBasis basis;
  basis.r = r_hat;
  const Vec3 across = Vec3::UnitZ().cross(r_hat);
  basis.h = across.norm() < 1e-12 ? Vec3(Vec3::UnitY()) : Vec3(across.normalized());
  basis.v = r_hat.cross(basis.h);
  return basis;
}

}  // namespace seaglint
