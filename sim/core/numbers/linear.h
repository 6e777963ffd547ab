// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Small fixed-size vectors and matrices.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <complex>

namespace seaglint {

using Complex = std::complex<double>;
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using CVec3 = Eigen::Vector3cd;

}  // namespace seaglint
