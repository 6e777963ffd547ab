// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Eigenvalues and eigenvectors of a symmetric matrix.

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct PrincipalAxes {
  Vec3 values;  // ascending
  Mat3 axes;    // columns: unit vectors in the order of the values
};

PrincipalAxes principal_axes(const Mat3& symmetric);

}  // namespace seaglint
