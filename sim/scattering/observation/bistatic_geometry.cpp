// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/bistatic_geometry.h"

namespace seaglint {

BistaticGeometry monostatic(const RadarBasis& basis) { return {basis, basis, true}; }

BistaticGeometry bistatic(const RadarBasis& transmit, const RadarBasis& receive) { return {transmit, receive, false}; }

PathGradient interpolate(const PathGradient& a, const PathGradient& b, double s) {
  const auto mean = [s](const Vec3& from, const Vec3& to) -> Vec3 { return from + s * (to - from); };
  return {mean(a.transmit, b.transmit), mean(a.receive, b.receive), mean(a.transmit_slide, b.transmit_slide),
          mean(a.receive_slide, b.receive_slide)};
}

}  // namespace seaglint
