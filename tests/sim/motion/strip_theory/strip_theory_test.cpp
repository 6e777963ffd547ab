// SPDX-License-Identifier: BSD-3-Clause
// Sections of a hull from tables and meshes, and their radiation.
#include "sim/motion/strip_theory/section_radiation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

// int_0^inf e^{-s} / (z + s) ds, which is e^z E1(z), by the trapezoidal rule in s = e^u.
Complex by_quadrature(Complex z) {
  Complex sum = 0;
  constexpr double kStep = 1e-3;
  for (double u = -25; u < 5; u += kStep) sum += std::exp(u - std::exp(u)) / (z + std::exp(u)) * kStep;
  return sum;
}

TEST(ScaledExponentialIntegral, IsItsIntegral) {
  for (const double size : {0.01, 0.5, 3.0, 5.0, 7.0, 12.0, 20.0, 23.9, 24.1, 60.0}) {
    for (const double angle_deg : {0.0, 45.0, 90.0, 120.0, 150.0, 170.0}) {
      const Complex z = std::polar(size, radians(angle_deg)), expected = by_quadrature(z);
      EXPECT_NEAR(std::abs(scaled_exponential_integral(z) / expected - 1.0), 0, 1e-6) << size << " at " << angle_deg;
    }
  }
  // On the cut: E1(-x + i0) = -Ei(x) - i pi, Ei(1) = 1.8951178163559368 (Abramowitz and Stegun, table 5.1).
  const Complex on_cut = scaled_exponential_integral({-1, 0});
  EXPECT_NEAR(on_cut.real(), -1.8951178163559368 / std::exp(1.0), 1e-9);
  EXPECT_NEAR(on_cut.imag(), -kPi / std::exp(1.0), 1e-9);
}

TEST(LewisForm, HasTheGivenBreadthDraughtAndArea) {
  for (const double draught : {0.3, 1.0, 4.0}) {
    for (const double coefficient : {0.7, 0.785, 0.9}) {
      const LewisForm form = lewis_form(2, draught, coefficient * 2 * draught);
      EXPECT_NEAR(form.point(0).real(), 1, 1e-12);
      EXPECT_NEAR(form.point(0).imag(), 0, 1e-12);
      EXPECT_NEAR(form.point(-0.5 * kPi).real(), 0, 1e-12);
      EXPECT_NEAR(form.point(-0.5 * kPi).imag(), -draught, 1e-12);
      double area = 0;
      for (int i = 0; i < 2000; ++i) {
        const double alpha = -0.5 * kPi * (i + 0.5) / 2000;
        area += 2 * form.point(alpha).real() * form.derivative(alpha).imag() * 0.5 * kPi / 2000;
      }
      EXPECT_NEAR(area, coefficient * 2 * draught, 1e-5);
      EXPECT_NEAR(form.area(), coefficient * 2 * draught, 1e-12);
    }
  }
  // A semicircle's centroid is 4 r / (3 pi) below its diameter.
  EXPECT_NEAR(lewis_form(2, 1, 0.5 * kPi).area_centre(), -4 / (3 * kPi), 1e-6);
}

TEST(LewisForm, DoesNotIntersectItself) {
  for (const double draught : {0.05, 0.3, 1.0, 4.0, 20.0}) {
    for (const double coefficient : {0.1, 0.5, 1.0, 1.5}) {
      const LewisForm form = lewis_form(2, draught, coefficient * 2 * draught);
      const AreaRange range = lewis_area_range(1 / draught);
      EXPECT_GE(form.area() / (2 * draught), range.least - 1e-12);
      for (double alpha = -0.5 * kPi; alpha < 0; alpha += 0.01) {
        EXPECT_GE(form.point(alpha).real(), -1e-12);
        EXPECT_LE(form.point(alpha).imag(), 1e-12);
        // A box's corners are rounded a little outside it.
        if (coefficient <= 1) {
          EXPECT_GE(form.point(alpha).imag(), -draught * 1.15) << draught << " " << coefficient;
        }
      }
    }
  }
}

// The root of the quadratic for a3 is 0 at the largest area, whose rounding may fall on either side of it.
TEST(LewisForm, OfTheLargestAreaIsFiniteAtEveryRatio) {
  for (int i = 0; i <= 2000; ++i) {
    const double draught = std::pow(10, -1.5 + 3.0 * i / 2000);
    const LewisForm form = lewis_form(2, draught, 1e3 * draught);
    const double largest = lewis_area_range(1 / draught).largest;
    ASSERT_NEAR(form.a3, -1.0 / 3, 1e-7) << draught;  // the square root of the rounding of 9 - 2 c
    EXPECT_NEAR(form.area() / (2 * draught), largest, 1e-7 * largest) << draught;
    EXPECT_TRUE(std::isfinite(form.area_centre())) << draught;
  }
}

struct Section {
  LewisForm form;
  Contour contour;
  SectionRadiation flow;
  double omega;
  Section(double breadth, double draught, double coefficient, double wavenumber)
      : form(lewis_form(breadth, draught, coefficient * breadth * draught)),
        contour(contour_of(form)),
        flow(solve_radiation(form, contour, wavenumber)),
        omega(std::sqrt(kGravity * wavenumber)) {}
  double added_mass(SectionMode i, SectionMode j) const { return -flow.integral(contour, i, j).real(); }
  double damping(SectionMode i, SectionMode j) const { return omega * flow.integral(contour, i, j).imag(); }
};

constexpr double kCircle = 0.25 * kPi;   // area coefficient of a semicircle
constexpr double kHalfDisc = 0.5 * kPi;  // its mass at radius 1, density 1

// Limits in closed form for a semicircle of radius 1: at high frequencies the water's surface holds no pressure,
// heave's added mass is the displaced mass and sway's 4/pi^2 of it; at low ones the surface is a rigid lid and sway's
// is the displaced mass.
TEST(SectionRadiation, OfASemicircleHasTheLimitsOfHighAndLowFrequency) {
  const Section fast(2, 1, kCircle, 40);
  // To the next order 1 - 4/(3 pi K) (Ursell 1953): 0.989 at K = 40; the series itself 1e-3.
  EXPECT_NEAR(fast.added_mass(kHeave, kHeave) / kHalfDisc, 1 - 4 / (3 * kPi * 40), 2e-3);
  // The limit is approached as 1/K: the residual after subtracting that term is of the order 1/K^2 and of the series.
  const double extrapolated = 2 * fast.added_mass(kSway, kSway) - Section(2, 1, kCircle, 20).added_mass(kSway, kSway);
  EXPECT_NEAR(extrapolated / kHalfDisc, 4 / (kPi * kPi), 3e-3);
  const Section slow(2, 1, kCircle, 1e-4);
  EXPECT_NEAR(slow.added_mass(kSway, kSway) / kHalfDisc, 1, 1e-3);
  // Heave's grows as the logarithm of the frequency: the source 2/pi under the lid adds (8/pi^2) ln(K2/K1).
  const Section slower(2, 1, kCircle, 1e-5);
  EXPECT_NEAR((slower.added_mass(kHeave, kHeave) - slow.added_mass(kHeave, kHeave)) / kHalfDisc,
              8 / (kPi * kPi) * std::log(10.0), 6e-3);  // the series
}

TEST(SectionRadiation, OfACircleInRollVanishes) {
  for (const double k : {0.1, 1.0, 5.0}) {
    const Section circle(2, 1, kCircle, k);
    EXPECT_NEAR(circle.added_mass(kRoll, kRoll), 0, 1e-12);
    EXPECT_NEAR(circle.added_mass(kSway, kRoll), 0, 1e-12);
  }
}

// The work done by damping is radiated as waves: b = rho g^2 A^2 / w^3 with A the waves' amplitude per amplitude of
// motion.
TEST(SectionRadiation, RadiatesTheEnergyOfDamping) {
  for (const double draught : {0.3, 1.0, 3.0}) {
    for (const double coefficient : {0.7, kCircle, 0.95}) {
      for (const double k : {0.01, 0.1, 0.5, 1.0}) {
        const Section section(2, draught, coefficient, k);
        for (const SectionMode mode : {kSway, kHeave, kRoll}) {
          const double radiated =
              std::pow(kGravity * section.flow.radiated_wave_ratio[mode], 2) / std::pow(section.omega, 3);
          if (mode == kRoll && coefficient == kCircle && draught == 1.0) continue;
          // The truncated series: residuals of 1e-3 at the waterline.
          EXPECT_NEAR(section.damping(mode, mode) / radiated, 1, 0.01)
              << draught << " " << coefficient << " " << k << " " << mode;
        }
      }
    }
  }
}

// As a lever of roll's force in sway: within 1 % of the breadth.
TEST(SectionRadiation, IsReciprocal) {
  for (const double k : {0.1, 0.5, 2.0}) {
    for (const double draught : {0.3, 0.8, 3.0}) {
      const Section s(2, draught, 0.9, k);
      EXPECT_NEAR(s.added_mass(kSway, kRoll), s.added_mass(kRoll, kSway), 0.02 * s.added_mass(kSway, kSway));
      EXPECT_NEAR(s.damping(kSway, kRoll), s.damping(kRoll, kSway), 0.02 * s.damping(kSway, kSway));
    }
  }
}

// The force of a beam sea of amplitude 1 and the radiated waves are related by Haskind's relation, in two dimensions
// |F|^2 = rho g^2 b / w for a symmetric body (Newman 1962).
TEST(SectionRadiation, SatisfiesHaskindsRelation) {
  for (const double draught : {0.4, 1.0, 2.0}) {
    for (const double k : {0.05, 0.3, 1.0}) {
      const Section s(2, draught, 0.9, k);
      Complex heave = 0, sway = 0;
      const double w = s.omega;
      for (std::size_t p = 0; p < kContourPoints; ++p) {
        const Contour& c = s.contour;
        const double cosine = std::exp(k * c.z[p]) * std::cos(k * c.y[p]);
        const double sine = std::exp(k * c.z[p]) * std::sin(k * c.y[p]), n_y = 2 * c.dz[p], n_z = -2 * c.dy[p];
        // Froude-Krylov and diffraction force of a beam sea, as in StripTheory::excitation.
        heave += -kGravity * cosine * n_z + w * w * s.flow.potential[kHeave][p] * (n_z * cosine - n_y * sine);
        sway += Complex(0, kGravity) * sine * n_y -
                Complex(0, w * w) * s.flow.potential[kSway][p] * (n_z * sine + n_y * cosine);
      }
      EXPECT_NEAR(std::norm(heave) / (kGravity * kGravity * s.damping(kHeave, kHeave) / w), 1, 0.02)
          << draught << " " << k;
      EXPECT_NEAR(std::norm(sway) / (kGravity * kGravity * s.damping(kSway, kSway) / w), 1, 0.02)
          << draught << " " << k;
    }
  }
}

TEST(SectionRadiation, SatisfiesItsBoundaryCondition) {
  for (const double draught : {0.2, 1.0, 4.5}) {
    for (const double k : {0.05, 0.5, 2.0}) {
      const Section section(2, draught, 0.8, k);
      for (const double residual : section.flow.residual) EXPECT_LT(residual, 0.02) << draught << " " << k;
    }
  }
}

TEST(ReadSections, IgnoresAByteOrderMark) {
  const HullSections plain = read_sections(SEAGLINT_SOURCE_DIR "/tests/reference/ship_motion/s175_sections.csv", 40);
  const HullSections marked = read_sections(SEAGLINT_SOURCE_DIR "/tests/cases/tables/sections_bom.csv", 40);
  EXPECT_EQ(marked.length, plain.length);
  ASSERT_EQ(marked.sections.size(), plain.sections.size());
  for (std::size_t i = 0; i < plain.sections.size(); ++i)
    EXPECT_EQ(marked.sections[i].area, plain.sections[i].area) << i;
}

TEST(ReadSections, RefusesWhatIsNoHull) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& rows) -> std::string {
    const std::filesystem::path file = folder.path() / "s.csv";
    std::ofstream(file) << "x_m;breadth_m;draught_m;area_m2\n" + rows;
    try {
      read_sections(file, 4);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder.path().string().size() + 1);
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("0;1;1;0,5\n1;1;1;0,5\n"), "accepted");
  EXPECT_EQ(refusal("0;1;1;1\n1;1;1;1.5\n"),
            "s.csv:3:7: area_m2: value '1.5': must be at most breadth times draught, 1");
  EXPECT_EQ(refusal("0;1;1;1\n1;-1;1;1\n"), "s.csv:3:3: breadth_m: value '-1': must be within 0 and 100000");
  EXPECT_EQ(refusal("1;1;1;1\n0;1;1;1\n"), "s.csv:3:1: x_m: value '0': must be greater than 1 of line 2");
}

}  // namespace
}  // namespace seaglint
