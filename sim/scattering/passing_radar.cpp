// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/passing_radar.h"

#include <Eigen/Geometry>

namespace seaglint {

Sight sight_at(const IntervalSampling& sampling, const Vec3& r_hat, double time_s) {
  RadarBasis radar = radar_basis(r_hat);
  if (!sampling.sight_rate.isZero(0)) {
    const Vec3 now = (r_hat + (time_s - sampling.pulse_time_s.front()) * sampling.sight_rate).normalized();
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(r_hat, now).toRotationMatrix();
    radar = {now, turn * radar.h, turn * radar.v};
  }
  return {radar, image_basis(radar)};
}

}  // namespace seaglint
