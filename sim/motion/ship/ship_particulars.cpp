// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/ship_particulars.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr double kRollRadius = 0.40;    // of gyration with added mass, per beam: 10.9 s at GM 1.95 m
constexpr double kPitchRadius = 0.25;   // of gyration of the mass alone, per length, in pitch and yaw
constexpr double kRollDamping = 0.075;  // bilge keels, no speed: 0.05-0.10

double given_or(double value, double derived) { return value > 0 ? value : derived; }

// -w^2 M + C - T of sway, roll and yaw without speed, without the roll inertia about G and additional damping.
Eigen::Matrix3cd lateral_impedance(const ShipParticulars& ship, double omega) {
  const StripTheory::Radiation radiation = ship.strips->radiation(omega, 0);
  Eigen::Matrix3cd z;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      z(i, j) = -omega * omega * ship.lateral_mass(i, j) + ship.lateral_stiffness(i, j) - radiation.lateral[i][j];
  }
  return z;
}

// Roll impedance with sway and yaw free: moment per roll angle.
Complex roll_impedance(const ShipParticulars& ship, double omega) {
  const Eigen::Matrix3cd z = lateral_impedance(ship, omega);
  Eigen::Matrix2cd others;
  others << z(0, 0), z(0, 2), z(2, 0), z(2, 2);
  const Eigen::Vector2cd from_roll(z(0, 1), z(2, 1));
  const Eigen::RowVector2cd to_roll(z(1, 0), z(1, 2));
  const Complex released = to_roll * others.partialPivLu().solve(from_roll);
  return z(1, 1) - released;
}

// Natural frequency w: w^2 inertia = Re impedance(w), for an impedance C - w^2 (added inertia).
template <typename Impedance>
double natural_frequency(double inertia, double stiffness, const Impedance& impedance) {
  double omega = std::sqrt(stiffness / (1.2 * inertia));
  for (int i = 0; i < 100; ++i) {
    const double added = (stiffness - impedance(omega).real()) / (omega * omega);
    omega = 0.5 * (omega + std::sqrt(stiffness / (inertia + added)));
  }
  return omega;
}

// Inertia for a given natural period.
template <typename Impedance>
double inertia_of_period(double omega, const Impedance& impedance, const char* key) {
  const double inertia = impedance(omega).real() / (omega * omega);
  if (!(inertia > 0)) {
    throw InputError(fmt::format("motion.{}: value {:.4g}: too short for this hull, whose added mass alone is slower",
                                 key, 2 * kPi / omega));
  }
  return inertia;
}

void set_roll(ShipParticulars& ship, const MotionSpec& spec, double mass) {
  const double stiffness = ship.lateral_stiffness(1, 1);
  const auto impedance = [&](double omega) { return roll_impedance(ship, omega); };
  double inertia = mass * spec.roll_gyradius_m * spec.roll_gyradius_m;
  if (spec.roll_gyradius_m > 0) {
    ship.roll.omega0 = natural_frequency(inertia, stiffness, impedance);
  } else {
    ship.roll.omega0 =
        2 * kPi /
        given_or(spec.roll_period_s, 2 * kPi * kRollRadius * ship.beam / std::sqrt(kGravity * ship.metacentric_height));
    inertia = inertia_of_period(ship.roll.omega0, impedance, "roll_period_s");
  }
  // Damping ratio to critical; the part beyond radiation represents bilge keels and friction.
  const double omega = ship.roll.omega0;
  const double critical = 2 * stiffness / omega;
  const double radiated = impedance(omega).imag() / omega;
  const double viscous = std::max(0.0, given_or(spec.roll_damping, kRollDamping) * critical - radiated);
  ship.roll.damping = (radiated + viscous) / critical;
  ship.roll.quadratic = spec.roll_quadratic_damping;
  ship.lateral_damping(1, 1) += viscous;
  ship.lateral_mass(1, 1) += inertia;
  ship.radii_of_gyration.x() = std::sqrt(inertia / mass);
}

void set_pitch_and_heave(ShipParticulars& ship, const MotionSpec& spec, double mass) {
  const double stiffness = ship.vertical_stiffness(1, 1);
  const auto impedance = [&](double omega) -> Complex {
    return stiffness - omega * omega * ship.vertical_mass(1, 1) - ship.strips->radiation(omega, 0).vertical[1][1];
  };
  const double radius = given_or(spec.pitch_gyradius_m, kPitchRadius * ship.length);
  double inertia = mass * radius * radius;
  if (spec.pitch_period_s > 0 && !(spec.pitch_gyradius_m > 0)) {
    inertia = inertia_of_period(2 * kPi / spec.pitch_period_s, impedance, "pitch_period_s");
  }
  ship.pitch.omega0 = natural_frequency(inertia, stiffness, impedance);
  const double critical = 2 * stiffness / ship.pitch.omega0;
  const double radiated = impedance(ship.pitch.omega0).imag() / ship.pitch.omega0;
  ship.pitch.damping = given_or(spec.pitch_damping, radiated / critical);
  ship.pitch_damping = ship.pitch.damping * critical - radiated;
  ship.vertical_mass(1, 1) += inertia;
  ship.radii_of_gyration.y() = std::sqrt(inertia / mass);

  const auto heave = [&](double omega) -> Complex {
    return ship.vertical_stiffness(0, 0) - ship.strips->radiation(omega, 0).vertical[0][0];
  };
  ship.heave.omega0 = natural_frequency(mass, ship.vertical_stiffness(0, 0), heave);
  ship.heave.damping = heave(ship.heave.omega0).imag() / (2 * ship.vertical_stiffness(0, 0));
}

}  // namespace

ShipParticulars ship_particulars(const MotionSpec& spec, const HullSections& hull) {
  ShipParticulars ship;
  ship.strips = std::make_shared<StripTheory>(hull);
  ship.length = hull.length;
  ship.beam = hull.beam();
  ship.draught = hull.draught();
  ship.metacentric_height = spec.metacentric_height_m;
  ship.speed = spec.speed_mps;
  if (!(ship.metacentric_height > 0)) {
    throw InputError(fmt::format("motion.metacentric_height_m: value {}: must be > 0", ship.metacentric_height));
  }

  // The ship floats on an even keel: G above B, below the metacentre by GM.
  const Hydrostatics& h = ship.strips->hydrostatics();
  ship.centre_of_gravity = {h.buoyancy_x, 0, h.buoyancy_z + h.waterplane_yy / h.volume - ship.metacentric_height};
  ship.rotation_centre = ship.centre_of_gravity;
  if (spec.rotation_centre_m) ship.rotation_centre = Vec3(*spec.rotation_centre_m);

  const double mass = kSeaWaterDensity * h.volume;
  const double x = ship.centre_of_gravity.x();
  const double z = ship.centre_of_gravity.z();
  const double weight = kSeaWaterDensity * kGravity;
  const double yaw_radius = given_or(spec.yaw_gyradius_m, kPitchRadius * ship.length);
  ship.radii_of_gyration.z() = yaw_radius;
  // Mass matrix with G away from the origin; the moments of inertia in roll and pitch are added below.
  ship.lateral_mass = mass * Mat3({1, -z, x}, {-z, z * z, -x * z}, {x, -x * z, x * x + yaw_radius * yaw_radius});
  ship.lateral_stiffness(1, 1) = weight * h.volume * ship.metacentric_height;
  ship.vertical_mass = {{mass, -mass * x}, {-mass * x, mass * x * x}};
  // Slender hull: pitch neglects BG against BM, consistent with the wave forces.
  ship.vertical_stiffness = weight * Mat2({h.waterplane, -h.waterplane_x}, {-h.waterplane_x, h.waterplane_xx});

  if (spec.yaw_period_s > 0) {
    const double omega = 2 * kPi / spec.yaw_period_s;
    const double yaw_inertia =
        ship.lateral_mass(2, 2) + ship.strips->radiation(omega, 0).lateral[2][2].real() / (omega * omega);
    ship.lateral_stiffness(2, 2) = omega * omega * yaw_inertia;
    ship.lateral_damping(2, 2) = 2 * spec.yaw_damping * omega * yaw_inertia;
  }
  set_roll(ship, spec, mass);
  set_pitch_and_heave(ship, spec, mass);
  return ship;
}

}  // namespace seaglint
