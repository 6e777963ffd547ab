// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/principal_axes.h"

#include <Eigen/Eigenvalues>

namespace seaglint {

PrincipalAxes principal_axes(const Mat3& symmetric) {
  Eigen::Matrix3d matrix;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) matrix(i, j) = symmetric(i, j);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  PrincipalAxes result;
  for (int j = 0; j < 3; ++j) {
    result.values[j] = solver.eigenvalues()[j];
    for (int i = 0; i < 3; ++i) result.axes(i, j) = solver.eigenvectors()(i, j);
  }
  return result;
}

}  // namespace seaglint
