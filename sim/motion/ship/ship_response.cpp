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

// A ship that travels with a wave meets no frequency at which its sway and yaw, which nothing holds, would be finite:
// slower encounters are treated as this one, rad/s.
constexpr double kSlowestEncounter = 0.1;

}  // namespace

MotionRao ship_rao(const ShipParticulars& ship, const ShipWave& wave) {
  double omega = encounter_frequency(wave, ship.speed);
  // A wave that is as slow by itself is none of these.
  const double slowest = std::min(kSlowestEncounter, 0.5 * wave.omega);
  if (ship.speed > 0 && std::abs(omega) < slowest) omega = std::copysign(slowest, omega);
  const ShipForces force = ship.strips->excitation(wave, ship.speed);
  const StripTheory::Radiation radiation = ship.strips->radiation(omega, ship.speed);

  const Eigen::Matrix3cd lateral = -omega * omega * ship.lateral_mass.cast<Complex>() +
                                   kJ * omega * ship.lateral_damping.cast<Complex>() +
                                   ship.lateral_stiffness.cast<Complex>() - radiation.lateral;
  const Eigen::Vector3cd across = lateral.partialPivLu().solve(Eigen::Vector3cd(force.sway, force.roll, force.yaw));

  Eigen::Matrix2cd vertical = -omega * omega * ship.vertical_mass.cast<Complex>() +
                              ship.vertical_stiffness.cast<Complex>() - radiation.vertical;
  // Damping as the user wants it never becomes negative where radiation is less than at resonance.
  const double damping = std::max(omega * vertical(1, 1).imag() + omega * omega * ship.pitch_damping, 0.0);
  vertical(1, 1) = Complex(vertical(1, 1).real(), damping / omega);
  const Eigen::Vector2cd upright = vertical.partialPivLu().solve(Eigen::Vector2cd(force.heave, force.pitch));

  // Where the origin goes and how the hull turns; the rotation centre c moves by that plus the turn crossed with c.
  const Complex surge = force.surge / (-omega * omega * ship.vertical_mass(0, 0));
  const CVec3 turn(across(1), upright(1), across(2));
  const CVec3 shift = CVec3(surge, across(0), upright(0)) + turn.cross(CVec3(ship.rotation_centre.cast<Complex>()));
  return {shift.x(), shift.y(), shift.z(), turn.x(), turn.y(), turn.z()};
}

}  // namespace seaglint
