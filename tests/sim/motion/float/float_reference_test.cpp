// SPDX-License-Identifier: BSD-3-Clause
// Floats against a section measured in beam waves (tests/reference/float_motion/SOURCE.md).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim/core/numbers/constants.h"
#include "sim/core/text/text_table.h"
#include "sim/motion/float/float.h"
#include "sim/motion/ship/ship.h"

namespace seaglint {
namespace {

constexpr double kBeam = 0.40, kDraught = 0.20, kBilge = 0.0512;

struct Measured {
  double omega, heave, roll;  // per amplitude, per slope
};
std::vector<Measured> measured() {
  const TextTable table(TextSource::read(SEAGLINT_SOURCE_DIR "/tests/reference/float_motion/ntnu_rao.csv"),
                        {"omega_rad_s", "heave_per_nominal_zeta", "roll_per_k_zeta"});
  std::vector<Measured> rows;
  for (std::size_t n = 0; n < table.rows(); ++n)
    rows.push_back({table.number(n, 0), table.number(n, 1), table.number(n, 2)});
  return rows;
}

// The measured +-35 %, and half a unit of the table's last digit.
double tolerance(double value) { return 0.35 * value + 0.005; }

// The section by strip theory: a cylinder in beam waves, its mass and GM as measured, radiation and diffraction of its
// Lewis form; additional damping of the sharp bilge 0.05 of critical.
TEST(FloatReference, SectionForcesMatchTheMeasuredRollAndHeave) {
  const double area = kBeam * kDraught - 2 * (1 - 0.25 * kPi) * kBilge * kBilge;
  HullSections hull{0.586, {}};
  for (int i = 0; i < 10; ++i) hull.sections.push_back({0.586 * ((i + 0.5) / 10 - 0.5), kBeam, kDraught, area});
  MotionSpec spec;
  spec.metacentric_height_m = 0.0629;
  spec.roll_gyradius_m = 0.360 * kBeam;
  spec.roll_damping = 0.05;
  spec.rotation_centre_m = {0, 0, 0};
  const ShipParticulars ship = ship_particulars(spec, hull);
  std::printf("natural periods: roll %.3f s (1.26), heave %.3f s (1.17)\n", 2 * kPi / ship.roll.omega0,
              2 * kPi / ship.heave.omega0);
  EXPECT_NEAR(2 * kPi / ship.roll.omega0, 1.26, 0.07);
  EXPECT_NEAR(2 * kPi / ship.heave.omega0, 1.17, 0.05);
  for (const Measured& m : measured()) {
    const double k = m.omega * m.omega / kGravity;
    const MotionRao r = ship_rao(ship, {m.omega, k, 0.5 * kPi});
    std::printf("%.3f rad/s: heave %.3f (%.2f), roll %.3f (%.2f)\n", m.omega, std::abs(r.heave), m.heave,
                std::abs(r.roll) / k, m.roll);
    EXPECT_NEAR(std::abs(r.heave), m.heave, tolerance(m.heave)) << m.omega;
    EXPECT_NEAR(std::abs(r.roll) / k, m.roll, tolerance(m.roll)) << m.omega;
  }
}

// A float with the section's periods, width and draught: amplitudes of its series in small regular waves.
TEST(FloatReference, AFloatsOscillatorMatchesTheMeasuredRoll) {
  MotionSpec spec;
  spec.model = MotionModel::kFloat;
  spec.diameter_m = kBeam;
  spec.draught_m = kDraught;
  spec.roll_period_s = 1.26;
  spec.roll_damping = 0.04;
  spec.heave_period_s = 1.17;
  spec.heave_damping = 0.16;
  spec.translations = true;
  const FloatParticulars body = float_particulars(spec, {});
  for (const Measured& m : measured()) {
    const double k = m.omega * m.omega / kGravity;
    const double amplitude = 1e-4;
    const WaveField sea({WaveComponent{.omega = m.omega, .amplitude = amplitude, .wavenumber = k}}, Vec2(0, 1), 1, 10);
    const std::vector<MotionSample> samples = simulate_float(body, spec, sea, 0, 0, 40, 1, 0);
    Complex roll = 0, heave = 0;
    const auto count =
        static_cast<std::size_t>(std::floor(std::floor(40 * m.omega / (2 * kPi)) * 2 * kPi / m.omega / spec.step_s));
    for (std::size_t n = 0; n < count; ++n) {
      const Complex phasor =
          std::polar(2.0 / static_cast<double>(count), -m.omega * spec.step_s * static_cast<double>(n));
      roll += samples[n].angles.x() * phasor;
      heave += samples[n].translation.z() * phasor;
    }
    std::printf("%.3f rad/s: heave %.3f (%.2f), roll %.3f (%.2f)\n", m.omega, std::abs(heave) / amplitude, m.heave,
                std::abs(roll) / (k * amplitude), m.roll);
    EXPECT_NEAR(std::abs(roll) / (k * amplitude), m.roll, tolerance(m.roll)) << m.omega;
    // One oscillator with constant mass and damping has a wrong heave off resonance, in contrast to strip theory.
    if (m.omega > 5 && m.omega < 5.5) {
      EXPECT_NEAR(std::abs(heave) / amplitude, m.heave, tolerance(m.heave)) << m.omega;
    }
  }
}

}  // namespace
}  // namespace seaglint
