// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/ship.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr double kRollRadius = 0.40;         // of gyration with added mass, per beam: 10.9 s at GM 1.95 m
constexpr double kPitchRadius = 0.25;        // of gyration of the mass alone, per length, in pitch and yaw
constexpr double kMetacentricHeight = 1.95;  // m, of model DTMB 5415
constexpr double kRollDamping = 0.075;       // bilge keels, no speed: 0.05-0.10

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
  ship.metacentric_height = given_or(spec.metacentric_height_m, kMetacentricHeight);
  ship.speed = spec.speed_mps;

  // The ship floats on an even keel: G above B, below the metacentre by GM.
  const StripHydrostatics& h = ship.strips->hydrostatics();
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

namespace {

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

namespace {

// Responses to one wave, and the forcing for which the roll oscillator has the roll response of the coupled hull.
ResponseChannels channels(const ShipParticulars& ship, const ShipWave& wave, bool translations) {
  const MotionRao rao = ship_rao(ship, wave);
  const double factor = translations ? 1 : 0;
  const Complex forcing = rao.roll / linear_response(ship.roll, encounter_frequency(wave, ship.speed));
  return {rao.roll, rao.pitch, rao.yaw, factor * rao.surge, factor * rao.sway, factor * rao.heave, forcing};
}

// Roll with quadratic damping, from the linear steady state spin_up_s before t = 0.
std::vector<OscillatorState> nonlinear_roll(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                            double x, double y, long samples) {
  const double step = spec.step_s;
  const auto before = static_cast<long>(std::ceil(spec.spin_up_s / step));
  // Steps are subdivided for short natural periods.
  const auto parts = std::max(1L, static_cast<long>(std::ceil(ship.roll.omega0 * step / kLongestTurn)));
  const double part = step / static_cast<double>(parts);
  const auto response = [&](const ShipWave& wave) { return channels(ship, wave, false); };
  ResponseSynthesis series(sea, response, ship.speed, x, y, -step * static_cast<double>(before), 0.5 * part);
  OscillatorState state{series.value(ResponseChannel::kRoll), series.rate(ResponseChannel::kRoll)};
  std::vector<OscillatorState> roll;
  double begin = series.value(ResponseChannel::kExtra);
  for (long n = -before; n < samples; ++n) {
    if (n >= 0) roll.push_back(state);
    for (long p = 0; p < parts; ++p) {
      series.advance();
      const double middle = series.value(ResponseChannel::kExtra);
      series.advance();
      const double end = series.value(ResponseChannel::kExtra);
      state = advance(ship.roll, state, begin, middle, end, part);
      begin = end;
    }
  }
  return roll;
}

}  // namespace

std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s) {
  const auto response = [&](const ShipWave& wave) { return channels(ship, wave, spec.translations); };
  std::vector<MotionSample> samples =
      ResponseSynthesis(sea, response, ship.speed, x, y, 0, spec.step_s).samples(duration_s);
  if (ship.roll.quadratic > 0) {
    const std::vector<OscillatorState> roll = nonlinear_roll(ship, spec, sea, x, y, static_cast<long>(samples.size()));
    for (std::size_t n = 0; n < samples.size(); ++n) {
      samples[n].angles.x() = roll[n].x;
      samples[n].angle_rates.x() = roll[n].rate;
    }
  }
  return samples;
}

}  // namespace seaglint
