// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/motion/ship.h"

namespace seaglint {

namespace {

// Ratios of a fast displacement hull; model DTMB 5415 (ITTC, L 142 m, B 19.06 m, T 6.15 m) has these.
constexpr double kWaterlineToOverallLength = 0.985;
constexpr double kWaterlineToOverallBeam = 0.95;
constexpr double kBeamToDraught = 3.1;

constexpr double kRollRadius = 0.40;    // of gyration with added mass, per beam: 10.9 s at GM 1.95 m
constexpr double kPitchRadius = 0.25;   // of gyration of the mass alone, per length
constexpr double kRollDamping = 0.075;  // bilge keels, no speed: 0.05-0.10
constexpr double kPitchDamping = 0.25;  // radiation of waves: 0.2-0.35
constexpr double kHeaveDamping = 0.25;

// Two-dimensional added mass in heave as a share of rho pi b^2/8, near the natural periods of pitch and heave, where a
// semicircle has its minimum 0.6 (Ursell 1949) and wider sections have more.
constexpr double kVerticalAddedMass = 0.7;

// Waterplane of half-breadth B/2 (1 - |2x/L|^n), n = Cwp/(1 - Cwp): what of L B/2-sided integrals remains.
struct Waterplane {
  explicit Waterplane(double coefficient) : n(coefficient / (1 - coefficient)) {}
  double n;
  double longitudinal() const { return n / (n + 3); }                                        // of B L^3 / 12
  double transverse() const { return 1 - 3 / (n + 1) + 3 / (2 * n + 1) - 1 / (3 * n + 1); }  // of L B^3 / 12
  double squared_breadth() const { return 1 - 2 / (n + 1) + 1 / (2 * n + 1); }               // of L B^2
  double squared_breadth_moment() const { return 1 - 6 / (n + 3) + 3 / (2 * n + 3); }        // of B^2 L^3 / 12
};

double given_or(double value, double derived) { return value > 0 ? value : derived; }

}  // namespace

ShipParticulars ship_particulars(const MotionSpec& spec, const Bounds& bounds, const HullForm& form) {
  const Vec3 size = bounds.upper - bounds.lower;
  ShipParticulars ship;
  ship.form = form;
  ship.length = given_or(spec.length_m, kWaterlineToOverallLength * size.x());
  ship.beam = given_or(spec.beam_m, kWaterlineToOverallBeam * size.y());
  ship.draught = given_or(spec.draught_m, ship.beam / kBeamToDraught);
  ship.metacentric_height = spec.metacentric_height_m;
  if (!(ship.length > 0) || !(ship.beam > 0)) {
    throw InputError(
        fmt::format("motion.length_m, motion.beam_m: the mesh measures {:.4g} x {:.4g} m, which gives no "
                    "waterline; write them down",
                    size.x(), size.y()));
  }
  if (!(ship.metacentric_height > 0)) {
    throw InputError(fmt::format("motion.metacentric_height_m: value {}: must be > 0", ship.metacentric_height));
  }

  // Centre of gravity: KG = KB + BM - GM, with Morrish's KB = T (5/6 - Cb / (3 Cwp)) and BM = I_T / volume.
  const Waterplane plane(form.waterplane);
  const double kb = ship.draught * (5.0 / 6 - form.block / (3 * form.waterplane));
  const double bm = plane.transverse() * ship.beam * ship.beam / (12 * form.block * ship.draught);
  ship.centre_of_gravity = kb + bm - ship.metacentric_height - ship.draught;

  // Roll: w4^2 = g GM / (k44^2).
  const double roll_period =
      given_or(spec.roll_period_s, 2 * kPi * kRollRadius * ship.beam / std::sqrt(kGravity * ship.metacentric_height));
  // Pitch: w5^2 = C55 / (I55 + A55), all over rho L^3/12: C55 = g B J, I55 = 12 k55^2 Cb B T, A55 = c pi/8 B^2 J2.
  const double i55 = 12 * kPitchRadius * kPitchRadius * form.block * ship.beam * ship.draught;
  const double a55 = kVerticalAddedMass * kPi / 8 * ship.beam * ship.beam * plane.squared_breadth_moment();
  const double pitch_period =
      given_or(spec.pitch_period_s, 2 * kPi * std::sqrt((i55 + a55) / (kGravity * ship.beam * plane.longitudinal())));
  // Heave: w3^2 = C33 / (m + A33), over rho L: C33 = g Cwp B.
  const double a33 = kVerticalAddedMass * kPi / 8 * ship.beam * ship.beam * plane.squared_breadth();
  const double heave_period =
      2 * kPi * std::sqrt((form.block * ship.beam * ship.draught + a33) / (kGravity * form.waterplane * ship.beam));

  ship.roll = {2 * kPi / roll_period, given_or(spec.roll_damping, kRollDamping), spec.roll_quadratic_damping};
  ship.pitch = {2 * kPi / pitch_period, given_or(spec.pitch_damping, kPitchDamping), 0};
  ship.heave = {2 * kPi / heave_period, kHeaveDamping, 0};
  if (spec.yaw_period_s > 0) ship.yaw = {2 * kPi / spec.yaw_period_s, spec.yaw_damping, 0};
  return ship;
}

}  // namespace seaglint
