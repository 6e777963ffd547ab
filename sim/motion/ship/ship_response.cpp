// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/ship_response.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/motion/ship/response_series.h"

namespace seaglint {

namespace {

constexpr Complex kJ{0, 1};

// Lower bound of the encounter frequency, rad/s: sway and yaw have no restoring force, so their responses diverge as it
// goes to zero.
constexpr double kSlowestEncounter = 0.1;

}  // namespace

MotionRao ship_rao(const ShipParticulars& ship, const ShipWave& wave) {
  double omega = encounter_frequency(wave, ship.speed);
  // Does not apply to waves whose own frequency is this low.
  const double slowest = std::min(kSlowestEncounter, 0.5 * wave.omega);
  if (ship.speed > 0 && std::abs(omega) < slowest) omega = std::copysign(slowest, omega);
  const ShipForces force = ship.strips->excitation(wave, ship.speed);
  const StripTheory::Radiation radiation = ship.strips->radiation(omega, ship.speed);

  Eigen::Matrix3cd lateral;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      lateral(i, j) = -omega * omega * ship.lateral_mass(i, j) + kJ * omega * ship.lateral_damping(i, j) +
                      ship.lateral_stiffness(i, j) - radiation.lateral[i][j];
  }
  const Eigen::Vector3cd across = lateral.partialPivLu().solve(Eigen::Vector3cd(force.sway, force.roll, force.yaw));

  Eigen::Matrix2cd vertical;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j)
      vertical(i, j) =
          -omega * omega * ship.vertical_mass(i, j) + ship.vertical_stiffness(i, j) - radiation.vertical[i][j];
  }
  // The total damping is kept non-negative where radiation is lower than at resonance.
  const double damping = std::max(omega * vertical(1, 1).imag() + omega * omega * ship.pitch_damping, 0.0);
  vertical(1, 1) = Complex(vertical(1, 1).real(), damping / omega);
  const Eigen::Vector2cd upright = vertical.partialPivLu().solve(Eigen::Vector2cd(force.heave, force.pitch));

  // Translation of the origin and rotation of the hull; the rotation centre c moves by the translation plus rotation x
  // c.
  const Complex surge = force.surge / (-omega * omega * ship.vertical_mass(0, 0));
  const CVec3 rotation(across(1), upright(1), across(2));
  const CVec3 translation = CVec3(surge, across(0), upright(0)) + rotation.cross(ship.rotation_centre.cast<Complex>());
  return {translation.x(), translation.y(), translation.z(), rotation.x(), rotation.y(), rotation.z()};
}

}  // namespace seaglint
