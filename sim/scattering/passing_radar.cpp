// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/passing_radar.h"

#include <Eigen/Geometry>

namespace seaglint {

Mat3 turn_of_scene(const IntervalSampling& sampling, const Vec3& r_hat, double time_s) {
  if (sampling.sight_rate.isZero(0)) return Mat3::Identity();
  const Vec3 now = (r_hat + (time_s - sampling.pulse_time_s.front()) * sampling.sight_rate).normalized();
  return Eigen::Quaterniond::FromTwoVectors(now, r_hat).toRotationMatrix();
}

Pose seen_pose(const Trajectory& trajectory, const IntervalSampling& sampling, const Vec3& r_hat, double time_s) {
  Pose pose = trajectory.pose(time_s);
  const Mat3 turn = turn_of_scene(sampling, r_hat, time_s);
  pose.R_TB = turn * pose.R_TB;
  pose.p_TB = turn * pose.p_TB;
  return pose;
}

}  // namespace seaglint
