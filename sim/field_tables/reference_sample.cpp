// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/reference_sample.h"

#include <cmath>

namespace seaglint {

bool fold_direction(double& theta_deg, double& phi_deg) {
  theta_deg = std::remainder(theta_deg, 360);
  const bool negative = theta_deg < 0;
  if (negative) {
    theta_deg = -theta_deg;
    phi_deg += 180;
  }
  phi_deg = std::fmod(phi_deg, 360);
  if (phi_deg < 0) phi_deg += 360;
  return negative;
}

}  // namespace seaglint
