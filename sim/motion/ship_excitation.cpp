// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "sim/core/constants.h"
#include "sim/motion/ship.h"

namespace seaglint {

namespace {

constexpr int kStrips = 200;               // of half the hull, midpoint rule
constexpr double kYawRadius = 0.25;        // of gyration of the mass, per length
constexpr double kLateralAddedMass = 0.5;  // share of rho pi T^2/2 per metre, uniform along the hull

constexpr Complex kJ{0, 1};

// 3 (sin x - x cos x) / x^3, the mean of a slope weighted with y^2 over a breadth: 1 for long waves.
double breadth_mean(double x) {
  if (std::abs(x) < 1e-2) return 1 - x * x / 10;
  return 3 * (std::sin(x) - x * std::cos(x)) / (x * x * x);
}

// Integrals over the hull, x = u L/2: of w(u) cos(kappa u) and of w(u) sin(kappa u) u / kappa, each over what it is for
// long waves, for the waterplane's breadth and for the lateral mass (displaced and added water).
struct HullAverages {
  double level = 0;    // mean elevation
  double slope = 0;    // mean slope along x, weighted with x^2
  double lateral = 0;  // mean sideways acceleration
  double turning = 0;  // mean of its gradient along x, weighted with x^2 lateral mass, over the true inertia's yaw
};

HullAverages average(const ShipParticulars& ship, double kappa) {
  const double n_plane = ship.form.waterplane / (1 - ship.form.waterplane);
  const double prismatic = ship.form.block / ship.form.midship;
  const double n_area = prismatic / (1 - prismatic);
  const double area = ship.form.midship * ship.beam * ship.draught;
  const double added = kLateralAddedMass * kPi / 2 * ship.draught * ship.draught;
  double level = 0, plane = 0, slope = 0, plane_moment = 0;
  double lateral = 0, mass = 0, turning = 0, added_moment = 0;
  for (int i = 0; i < kStrips; ++i) {
    const double u = (i + 0.5) / kStrips;
    const double breadth = 1 - std::pow(u, n_plane);
    const double water = area * (1 - std::pow(u, n_area)) + added;
    const double cosine = std::cos(kappa * u);
    // sin(kappa u) / kappa, u for long waves.
    const double sine = kappa < 1e-6 ? u : std::sin(kappa * u) / kappa;
    level += breadth * cosine;
    plane += breadth;
    slope += breadth * u * sine;
    plane_moment += breadth * u * u;
    lateral += water * cosine;
    mass += water;
    turning += water * u * sine;
    added_moment += added * u * u;
  }
  // Inertia in the units of the sums: volume k66^2 / (L/2)^2 over both halves, 2 ds = 1.
  const double inertia = 4 * kYawRadius * kYawRadius * ship.form.block * ship.beam * ship.draught * kStrips;
  return {level / plane, slope / plane_moment, lateral / mass, turning / (inertia + added_moment)};
}

}  // namespace

// Effective slope with Smith's correction: the pressure under a wave falls as e^{-kz}, so that a hull feels the slope
// at a depth: half the draught for heave and pitch, the draught itself for roll (kappa = e^{-kT} of Jensen,
// Mansour and Olsen 2004, Ocean Engineering 31, 61, eq. 3). Yaw, surge and sway: Froude-Krylov force and the same
// acceleration on the added mass (long-wave diffraction), the mean of e^{-kz} over the draught.
ShipExcitation ship_excitation(const ShipParticulars& ship, double omega, double mu) {
  const double k = omega * omega / kGravity;
  const double cos_mu = std::cos(mu);
  const double sin_mu = std::sin(mu);
  const HullAverages hull = average(ship, std::abs(0.5 * k * ship.length * cos_mu));
  const double beam_argument = 0.5 * k * ship.beam * sin_mu;
  const double beam_level = std::abs(beam_argument) < 1e-6 ? 1 : std::sin(beam_argument) / beam_argument;
  const double at_keel = std::exp(-k * ship.draught);
  const double at_half_draught = std::exp(-0.5 * k * ship.draught);
  const double over_draught = k * ship.draught < 1e-6 ? 1 : (1 - at_keel) / (k * ship.draught);
  const auto squared = [](double x) { return x * x; };

  ShipExcitation excitation;
  // roll = +d eta/dy, pitch = -d eta/dx.
  excitation.roll = squared(ship.roll.omega0) * (-kJ * k * sin_mu) * breadth_mean(beam_argument) * hull.level * at_keel;
  excitation.pitch = squared(ship.pitch.omega0) * (kJ * k * cos_mu) * hull.slope * beam_level * at_half_draught;
  // Water at the surface accelerates by -g grad eta = +j g k (cos mu, sin mu) eta; its gradient along x turns the hull.
  const double sideways = kGravity * k * beam_level * over_draught;
  excitation.yaw = sideways * k * sin_mu * cos_mu * hull.turning;
  excitation.surge = kJ * sideways * cos_mu * hull.lateral;
  excitation.sway = kJ * sideways * sin_mu * hull.lateral;
  excitation.heave = squared(ship.heave.omega0) * hull.level * beam_level * at_half_draught;
  return excitation;
}

ShipExcitation ship_rao(const ShipParticulars& ship, double omega, double mu) {
  ShipExcitation rao = ship_excitation(ship, omega, mu);
  rao.roll *= linear_response(ship.roll, omega);
  rao.pitch *= linear_response(ship.pitch, omega);
  rao.yaw *= linear_response(ship.yaw, omega);
  rao.surge *= linear_response(ship.surge, omega);
  rao.sway *= linear_response(ship.sway, omega);
  rao.heave *= linear_response(ship.heave, omega);
  return rao;
}

}  // namespace seaglint
