// SPDX-License-Identifier: BSD-3-Clause
// The container ship S175 in waves against the strip theory program VERES.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/text/text_table.h"
#include "sim/motion/ship/rao_files.h"
#include "sim/motion/ship/rao_table.h"
#include "sim/motion/ship/ship.h"
#include "sim/sea/spectrum.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

// S175 with its main particulars (tests/reference/ship_motion/SOURCE.md); its centre of flotation follows from the
// reference's forces of long waves, its sections are Lewis forms of the coefficients' lines.
ShipParticulars s175(double speed) {
  MotionSpec spec;
  spec.model = MotionModel::kShip;
  spec.metacentric_height_m = 0.996;
  spec.roll_gyradius_m = 8.331;
  spec.pitch_gyradius_m = 42;
  spec.yaw_gyradius_m = 42;
  spec.roll_damping = 0.05;
  spec.speed_mps = speed;
  return ship_particulars(spec, sections_of_form(175, 25.4, 9.5, {0.569, 0.709, 0.966, -2.55 / 175, -6.93 / 175}, 40));
}

struct Misfit {
  Vec3 rms = Vec3::Zero(), worst = Vec3::Zero();  // of response ratio - 1: roll, pitch, yaw
};

// RMS responses in JONSWAP seas of Tp 6-10 s towards all of the table's headings but along and across the ship.
Misfit misfit_to(const RaoTable& table, const ShipParticulars& ship) {
  Misfit misfit;
  double cases = 0;
  for (const double mu : table.headings()) {
    const double off_beam = std::abs(std::abs(degrees(mu)) - 90);
    if (mu < 0 || off_beam < 5 || off_beam > 65) continue;
    for (const double period : {6.0, 7.0, 8.0, 9.0, 10.0}) {
      const JonswapSpectrum spectrum(1, period, 3.3);
      Vec3 ours = Vec3::Zero(), theirs = Vec3::Zero();
      // The table's own frequencies from 0.2 to 1.9 rad/s, trapezoidal rule.
      const std::vector<double>& omega = table.omegas();
      for (std::size_t i = 1; i + 2 < omega.size(); ++i) {
        const double energy = spectrum.density(omega[i]) * 0.5 * (omega[i + 1] - omega[i - 1]);
        const double k = omega[i] * omega[i] / kGravity;
        const MotionRao a = ship_rao(ship, {omega[i], k, mu});
        const MotionRao b = table.at(omega[i], k, mu);
        ours += energy * Vec3(std::norm(a.roll), std::norm(a.pitch), std::norm(a.yaw));
        theirs += energy * Vec3(std::norm(b.roll), std::norm(b.pitch), std::norm(b.yaw));
      }
      Vec3 off;
      for (int axis = 0; axis < 3; ++axis) off[axis] = std::sqrt(ours[axis] / theirs[axis]) - 1;
      misfit.rms += off.cwiseProduct(off);
      misfit.worst = misfit.worst.cwiseMax(off.cwiseAbs());
      cases += 1;
    }
  }
  for (double& rms : misfit.rms) rms = std::sqrt(rms / cases);
  std::printf("roll, pitch, yaw: rms %.3f %.3f %.3f, worst %.3f %.3f %.3f\n", misfit.rms.x(), misfit.rms.y(),
              misfit.rms.z(), misfit.worst.x(), misfit.worst.y(), misfit.worst.z());
  return misfit;
}

const char* const kVeres = SEAGLINT_SOURCE_DIR "/tests/reference/ship_motion/s175_veres.re1";

// The required accuracy for a ship without speed.
TEST(S175, ResponsesMatchStripTheoryWithoutSpeed) {
  const ShipParticulars ship = s175(0);
  // Floats as the reference's hull: KG 9.55 m above the keel, 24,610 t.
  EXPECT_NEAR(ship.centre_of_gravity.z(), 0.05, 0.1);
  EXPECT_NEAR(ship.strips->hydrostatics().volume * 1.025, 24610, 100);
  const Misfit misfit = misfit_to(read_veres_rao(kVeres, 0), ship);
  record_figure(100 * misfit.rms.x(), 0, "s175_roll_percent");
  record_figure(100 * misfit.rms.y(), 0, "s175_pitch_percent");
  record_figure(100 * misfit.rms.z(), 0, "s175_yaw_percent");
  EXPECT_LT(misfit.rms.x(), 0.40);
  EXPECT_LT(misfit.rms.y(), 0.15);
  EXPECT_LT(misfit.rms.z(), 0.20);
  EXPECT_LT(misfit.worst.x(), 1.00);
  EXPECT_LT(misfit.worst.y(), 0.25);
  EXPECT_LT(misfit.worst.z(), 0.40);
}

// The roll radiation equals another program's at low frequencies; above, fine V-shaped ends, which the form lacks,
// radiate less.
TEST(S175, RollDampingMatchesAnotherStripTheory) {
  const ShipParticulars ship = s175(0);
  const TextTable reference(
      TextSource::read(SEAGLINT_SOURCE_DIR "/tests/reference/ship_motion/s175_roll_wave_damping.csv"),
      {"w_vec", "b44_vec"});
  for (std::size_t row = 0; row < reference.rows(); ++row) {
    const double omega = reference.number(row, 0);
    if (omega < 0.19 || omega > 0.61) continue;
    const double damping = -ship.strips->radiation(omega, 0).lateral[1][1].imag() / omega;
    // The forms for the lines 25 %, the reference's own rounding 3e4 N m s (its first value is as much below 0).
    EXPECT_NEAR(damping, reference.number(row, 1), 0.25 * reference.number(row, 1) + 4e4) << omega;
  }
}

// At 20 knots. Roll in quartering seas is at its resonance, where the reference's damping (lift, bilge keels) is not
// known; it is not compared.
TEST(S175, ResponsesMatchStripTheoryAtTwentyKnots) {
  const double speed = 20 * 1852.0 / 3600;
  const Misfit misfit = misfit_to(read_veres_rao(kVeres, speed), s175(speed));
  record_figure(100 * misfit.rms.y(), 0, "s175_20_knots_pitch_percent");
  record_figure(100 * misfit.rms.z(), 0, "s175_20_knots_yaw_percent");
  EXPECT_LT(misfit.rms.y(), 0.15);
  EXPECT_LT(misfit.rms.z(), 0.20);
  EXPECT_LT(misfit.worst.y(), 0.25);
  EXPECT_LT(misfit.worst.z(), 0.40);
}

// Signs and phases, in waves longer than the ship (shorter ones pass through zeros).
TEST(S175, PhasesMatchStripTheory) {
  for (const double speed : {0.0, 20 * 1852.0 / 3600}) {
    const RaoTable table = read_veres_rao(kVeres, speed);
    ShipParticulars ship = s175(speed);
    ship.rotation_centre = table.reference();
    for (const double mu_deg : {-150.0, -120.0, -60.0, 60.0, 120.0, 150.0}) {
      for (const double omega : {0.5236, 0.5712, 0.6283}) {
        const double k = omega * omega / kGravity;
        const MotionRao a = ship_rao(ship, {omega, k, radians(mu_deg)});
        const MotionRao b = table.at(omega, k, radians(mu_deg));
        const auto angle = [](Complex p, Complex q) { return std::abs(degrees(std::arg(p / q))); };
        EXPECT_LT(angle(a.heave, b.heave), 15) << mu_deg << " " << omega;
        EXPECT_LT(angle(a.pitch, b.pitch), 15) << mu_deg << " " << omega;
        EXPECT_LT(angle(a.sway, b.sway), 20) << mu_deg << " " << omega;
        EXPECT_LT(angle(a.yaw, b.yaw), 25) << mu_deg << " " << omega;
        if (speed == 0) {
          EXPECT_LT(angle(a.roll, b.roll), 30) << mu_deg << " " << omega;
        }
      }
    }
  }
}

}  // namespace
}  // namespace seaglint
