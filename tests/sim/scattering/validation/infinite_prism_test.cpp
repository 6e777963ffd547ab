// SPDX-License-Identifier: BSD-3-Clause
// Prisms of several cross-sections against integral equations of the infinitely long ones: wedges of any angle,
// monostatic and bistatic.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/reference_bodies.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

struct Deviation {
  double soft = 0, hard = 0;  // relative, of the field in L2
};

struct Echoes {
  Complex soft, hard;
};

// P of sections.py, from the difference of a prism of twice the height and the prism. S per metre is j P / pi, of the
// hard wave with H opposite to the axis.
Echoes echoes_per_metre(const Scatterer& one, const Scatterer& two, double height, const BistaticGeometry& geometry,
                        double k) {
  const auto echo_of = [&](const Scatterer& target) {
    return scattering_matrices(target, geometry, std::array{k}, {7e-5, 8, true})[0];
  };
  const auto long_one = echo_of(two), short_one = echo_of(one);
  const Complex per_metre = kPi / (height * Complex(0, 1));
  return {per_metre * (long_one[kVvChannel] - short_one[kVvChannel]),
          -per_metre * (long_one[kHhChannel] - short_one[kHhChannel])};
}

// Relative error of the echo of 2 m of a prism against the integral equations, over all pairs of directions between
// these angles apart, the receiver's within `about_deg` of azimuth 0. On the cone of an elevation (transmitter above,
// receiver as far below) a prism scatters as at elevation 0 with the wavenumber normal to its axis.
Deviation against_integral_equations(const std::string& section, double min_deg, double max_deg, double elevation_deg,
                                     double about_deg = 180) {
  const double k = wavenumber(10.24e9) / std::cos(radians(elevation_deg)), height = 2;
  const Scatterer one(prism(sections().at(section), height)), two(prism(sections().at(section), 2 * height));
  double error[2] = {0, 0}, power[2] = {0, 0};
  for (const auto& row : read_csv("sections.csv")) {
    if (row[6] != section) continue;
    const double transmit = std::stod(row[0]), receive = std::stod(row[1]);
    const double bistatic_angle = std::abs(std::remainder(transmit - receive, 360));
    if (bistatic_angle < min_deg || bistatic_angle > max_deg || std::abs(std::remainder(receive, 360)) > about_deg)
      continue;
    const auto geometry = bistatic_angle == 0 && elevation_deg == 0
                              ? monostatic(radar_basis(direction(receive, 0)))
                              : bistatic(radar_basis(direction(transmit, elevation_deg)),
                                         radar_basis(direction(receive, -elevation_deg)));
    const auto [soft_P, hard_P] = echoes_per_metre(one, two, height, geometry, k);
    for (const bool hard : {false, true}) {
      const Complex reference(std::stod(row[hard ? 4 : 2]), std::stod(row[hard ? 5 : 3]));
      error[hard] += std::norm((hard ? hard_P : soft_P) - reference);
      power[hard] += std::norm(reference);
    }
  }
  const Deviation deviation{std::sqrt(error[0] / power[0]), std::sqrt(error[1] / power[1])};
  std::printf("%s, %g to %g deg apart, elevation %g deg: soft %.4f, hard %.4f\n", section.c_str(), min_deg, max_deg,
              elevation_deg, deviation.soft, deviation.hard);
  return deviation;
}

Deviation larger(const Deviation& a, const Deviation& b) {
  return {std::max(a.soft, b.soft), std::max(a.hard, b.hard)};
}

// The errors are due to higher diffraction orders and, for the hard field, to the largest elements of the integral
// equations.
TEST(InfinitePrism, BackscatterMatchesIntegralEquation) {
  Deviation worst;
  for (const std::string section : {"box", "knife", "triangle"}) {
    const Deviation back = against_integral_equations(section, 0, 0, 0);
    worst = larger(worst, back);
    EXPECT_LT(back.soft, 0.0015) << section;
    EXPECT_LT(back.hard, 0.003) << section;
  }
  record_figure(worst.soft, 4, "prism_back_soft");
  record_figure(worst.hard, 4, "prism_back_hard");
}

// The concave edge of a chevron diffracts; without it the error of the soft field is 0.04 and, without the waves that
// it launches along its walls, that of the hard one 0.09.
TEST(InfinitePrism, WithAConcaveEdgeMatchesIntegralEquation) {
  const Deviation back = against_integral_equations("chevron", 0, 0, 0);
  EXPECT_LT(back.soft, 0.02);
  EXPECT_LT(back.hard, 0.08);
  record_figure(back.soft, 3, "chevron_soft");
  record_figure(back.hard, 3, "chevron_hard");
}

// The free edge of either arm bounds the beam that it reflects to the other, whose edge coincides with the shadow
// boundary, so that half of the field in the transition region is lost: with a sharp shadow boundary the error is 0.09
// within 8 deg of the axis. Farther off, where the beam leaves an arm at a small angle, the edge radiates along it
// Keller's field less the end-point contribution of physical optics on the other arm (endpoint_correction()); with that
// on its own arm the error is 0.023 within 20 deg and 0.06 within 38. The remaining error, of arms of 5 wavelengths, is
// due to waves along them, most of the hard field.
TEST(InfinitePrism, DihedralMatchesIntegralEquation) {
  for (const double elevation : {0.0, 40.0}) {
    const Deviation axis = against_integral_equations("dihedral", 0, 0, elevation, 8),
                    back = against_integral_equations("dihedral", 0, 0, elevation, 20);
    const Deviation grazing = against_integral_equations("dihedral", 0, 0, elevation, 38);
    EXPECT_LT(axis.soft, 0.006);
    EXPECT_LT(axis.hard, 0.02);
    EXPECT_LT(back.soft, 0.01);
    EXPECT_LT(back.hard, 0.02);
    EXPECT_LT(grazing.soft, 0.03);  // 0.012 except for the bistatic geometry
    EXPECT_LT(grazing.hard, 0.03);
    record_figure(axis.soft, 3, "dihedral_8_deg_cone_{}_soft", elevation);
    record_figure(axis.hard, 3, "dihedral_8_deg_cone_{}_hard", elevation);
    record_figure(back.soft, 3, "dihedral_20_deg_cone_{}_soft", elevation);
    record_figure(back.hard, 3, "dihedral_20_deg_cone_{}_hard", elevation);
    record_figure(grazing.soft, 3, "dihedral_38_deg_cone_{}_soft", elevation);
    record_figure(grazing.hard, 3, "dihedral_38_deg_cone_{}_hard", elevation);
  }
}

// At directions along one arm and beyond, the other arm is in the penumbra of the edge (multiple_diffraction.h): with
// full illumination by physical optics the errors are 0.10 (soft) and 0.055 (hard) for arms of 5 wavelengths, 0.042 and
// 0.023 for arms of 20.
TEST(InfinitePrism, DihedralAlongItsArmsMatchesIntegralEquation) {
  const Deviation near = against_integral_equations("dihedral", 0, 0, 0, 70),
                  far = against_integral_equations("dihedral90long", 0, 0, 0, 70);
  EXPECT_LT(near.soft, 0.015);
  EXPECT_LT(near.hard, 0.03);
  EXPECT_LT(far.soft, 0.003);
  EXPECT_LT(far.hard, 0.01);
  record_figure(near.soft, 3, "dihedral_70_deg_soft");
  record_figure(near.hard, 3, "dihedral_70_deg_hard");
  record_figure(far.soft, 3, "dihedral_long_70_deg_soft");
  record_figure(far.hard, 3, "dihedral_long_70_deg_hard");
}

// For other opening angles than 90 deg the exit paths of edges differ from the beams that they bound: with end-point
// contributions of physical optics on shadow-boundary lines the error is 0.14 to 0.20 (beam_boundary.h).
TEST(InfinitePrism, DihedralOffTheRightAngleMatchesIntegralEquation) {
  for (const std::string section : {"dihedral85", "dihedral95"}) {
    const Deviation axis = against_integral_equations(section, 0, 0, 0, 8),
                    back = against_integral_equations(section, 0, 0, 0, 20);
    EXPECT_LT(axis.soft, 0.03) << section;
    EXPECT_LT(axis.hard, 0.05) << section;
    EXPECT_LT(back.soft, 0.03) << section;
    EXPECT_LT(back.hard, 0.08) << section;
    record_figure(axis.soft, 3, "{}_8_deg_soft", section);
    record_figure(axis.hard, 3, "{}_8_deg_hard", section);
    record_figure(back.soft, 3, "{}_20_deg_soft", section);
    record_figure(back.hard, 3, "{}_20_deg_hard", section);
  }
}

// A beam that one arm reflects nearly along the other has a penumbra there, within some 13 deg over 5 wavelengths,
// which physical optics neglects; the concave edge launches it as a wave along the arm (multiple_diffraction.h).
// Without that the errors of the hard field are 0.21 and 0.28, of arms of 20 wavelengths 0.22. The remaining error is
// that of return paths, of which only half is separable from the beams' end-point contributions there, and below a
// right angle of the edges' own fields, which return as rays.
TEST(InfinitePrism, DihedralHasWavesFromItsConcaveEdge) {
  for (const double elevation : {0.0, 40.0}) {
    const double wide = against_integral_equations("dihedral95", 0, 0, elevation, 47).hard;
    EXPECT_LT(wide, 0.12) << elevation;
    record_figure(wide, 3, "dihedral95_47_deg_cone_{}_hard", elevation);
  }
  const double narrow = against_integral_equations("dihedral85", 0, 0, 0, 42).hard,
               long_one = against_integral_equations("dihedral95long", 0, 0, 0, 46).hard;
  EXPECT_LT(narrow, 0.2);
  EXPECT_LT(long_one, 0.16);
  record_figure(narrow, 3, "dihedral85_42_deg_hard");
  record_figure(long_one, 3, "dihedral95_long_46_deg_hard");
}

// At 37.5 deg the wave that one arm of the 95 deg dihedral reflects passes along the other, which it illuminates on one
// side of that direction only. Without waves from the concave edge the echo has a step of 5.5 there; the remaining
// step, 1.2, is due to the edges' paths via the other arm, which are tapered near the forward direction.
TEST(InfinitePrism, DihedralHasASmallStepWhereABeamGrazesAnArm) {
  const double k = wavenumber(10.24e9), height = 2;
  const Scatterer one(prism(sections().at("dihedral95"), height)), two(prism(sections().at("dihedral95"), 2 * height));
  const auto hard_at = [&](double azimuth) {
    return echoes_per_metre(one, two, height, monostatic(radar_basis(direction(azimuth, 0))), k).hard;
  };
  const Complex before = hard_at(37.48), after = hard_at(37.52);
  EXPECT_GT(std::abs(before), 3);
  EXPECT_LT(std::abs(after - before), 1.5);
}

// Illuminated faces that are not visible to the receiver do not radiate to it: without their contribution to the edges'
// field its error is 0.03 to 0.1. Behind the target the error is that of soft waves at grazing incidence on a face
// (slope diffraction); up to 20 deg from the forward direction.
TEST(InfinitePrism, BistaticEchoMatchesIntegralEquation) {
  Deviation worst_before, worst_behind;
  for (const std::string section : {"box", "knife", "triangle"}) {
    for (const double elevation : {0.0, 40.0}) {
      const Deviation before = against_integral_equations(section, 1, 90, elevation),
                      behind = against_integral_equations(section, 90, 160, elevation);
      EXPECT_LT(before.soft, 0.005) << section;
      EXPECT_LT(before.hard, 0.004) << section;
      EXPECT_LT(behind.soft, 0.09) << section;
      EXPECT_LT(behind.hard, 0.01) << section;
      worst_before = larger(worst_before, before);
      worst_behind = larger(worst_behind, behind);
    }
  }
  record_figure(worst_before.soft, 4, "prism_90_deg_soft");
  record_figure(worst_before.hard, 4, "prism_90_deg_hard");
  record_figure(worst_behind.soft, 3, "prism_160_deg_soft");
  record_figure(worst_behind.hard, 3, "prism_160_deg_hard");
}

}  // namespace
}  // namespace seaglint
