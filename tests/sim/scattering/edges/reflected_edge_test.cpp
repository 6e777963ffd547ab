// SPDX-License-Identifier: BSD-3-Clause
// Rims of mirrors along the beam that these reflect: closed forms.
#include "sim/scattering/edges/reflected_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// The rim of a right-angled dihedral's arm y = 0, x <= 0, of which the other arm stands at a place x < 0; the wave
// comes from before the rim and leaves the arm at an angle `above` towards the other one.
struct DihedralEdge {
  WedgeFrame wedge;
  EdgeIllumination in, out;
};

DihedralEdge dihedral_edge(double above, double beside = 0) {
  const Vec3 x = -Vec3::UnitX(), y = Vec3::UnitY(), t = x.cross(y);
  const double c = std::cos(above), s = std::sin(above), c2 = std::cos(above + beside), s2 = std::sin(above + beside);
  DihedralEdge rim{{{{x, y, t}, {x, -y, -t}}, 2}, {}, {}};
  rim.in.direction = {-c, -s, 0};
  rim.in.E_h = {-s, c, 0};  // hard: across the rim
  rim.in.E_v = Vec3::UnitZ();
  // The receiver's wave, sent backwards, after the other arm: E' = 2 (n.E) n - E.
  rim.out.direction = {c2, -s2, 0};
  rim.out.E_h = {-s2, -c2, 0};
  rim.out.E_v = -Vec3::UnitZ();
  rim.out.reflections = 1;
  rim.out.first_reflector_normal = Vec3::UnitX();
  return rim;
}

// hh and vv of the rim along the beam, per metre.
std::array<double, 2> answer(const DihedralEdge& rim) {
  const auto currents =
      equivalent_edge_currents(rim.wedge, rim.in.direction, {rim.in.E_h, rim.in.E_v}, -rim.out.direction);
  const auto ends = endpoint_correction(rim.wedge.face[0], rim.in, rim.out);
  return {rim.out.E_h.dot(currents[0]) + ends[0], rim.out.E_v.dot(currents[1]) + ends[3]};
}

// Keller's 1 / (2 sin a) less tan(a) / 2 of the other arm's end, over 2 pi; soft and hard coefficients have opposite
// signs, and so have a dihedral's echoes.
TEST(ReflectedEdge, OfADihedralIsKellersCoefficientLessTheEndOnTheOtherArm) {
  // that of the last mirror's own rim, below
  const double sign = std::copysign(1.0, answer(dihedral_edge(radians(45)))[0]);
  for (const double above_deg : {10.0, 20.0, 33.0, 45.0, 60.0}) {
    const double above = radians(above_deg), expected = (1 / std::sin(above) - std::tan(above)) / (4 * kPi);
    const auto [hard, soft] = answer(dihedral_edge(above));
    // The ends are taken 1e-4 rad to either side of the beam, of a curve that bends by 1 / a^3.
    EXPECT_NEAR(hard, sign * expected, 1e-6) << above_deg;
    EXPECT_NEAR(soft, sign * expected, 1e-6) << above_deg;
  }
}

// On a dihedral's axis both arms are alike, and so are the rims that the beam meets first and last.
TEST(ReflectedEdge, OnADihedralsAxisIsWhatItIsOfTheLastMirror) {
  const DihedralEdge first = dihedral_edge(radians(45));
  const auto currents =
      equivalent_edge_currents(first.wedge, first.out.direction, {first.out.E_h, first.out.E_v}, -first.in.direction);
  const auto [hard, soft] = answer(first);
  EXPECT_NEAR(first.in.E_h.dot(currents[0]), hard, 1e-6);
  EXPECT_NEAR(first.in.E_v.dot(currents[1]), soft, 1e-6);
}

TEST(ReflectedEdge, HasNoOtherEndWhereItsFaceIsTheLastMirror) {
  const DihedralEdge rim = dihedral_edge(radians(30));
  for (const double end : endpoint_correction(rim.wedge.face[0], rim.out, rim.in)) EXPECT_EQ(end, 0);
}

// Off the direction of reflection, by an angle b about the rim: Keller's coefficients of a half-plane less the end of
// physical optics on the other arm, whose currents go with the cosine of incidence (soft) or of the way out (hard).
TEST(ReflectedEdge, LacksTheEndOnTheOtherArmOffTheDirectionOfReflectionToo) {
  for (const double above_deg : {20.0, 45.0, 60.0}) {
    const double above = radians(above_deg), sign = std::copysign(1.0, answer(dihedral_edge(radians(45)))[0]);
    for (const double beside : {-0.15, -0.002, 0.002, 0.05, 0.3}) {
      const double direct = 1 / std::cos(0.5 * (kPi - 2 * above - beside)), pole = 1 / std::sin(0.5 * beside);
      const double run = std::sin(above + beside) - std::sin(above);
      const auto [hard, soft] = answer(dihedral_edge(above, beside));
      // Rounding of the poles.
      EXPECT_NEAR(soft, sign * ((direct + pole) / (4 * kPi) - std::cos(above) / (2 * kPi * run)), 1e-9)
          << above_deg << " " << beside;
      EXPECT_NEAR(hard, sign * ((direct - pole) / (4 * kPi) + std::cos(above + beside) / (2 * kPi * run)), 1e-9)
          << above_deg << " " << beside;
    }
  }
}

// A beam that leaves away from the other mirror ends nowhere: what physical optics of the rim's own face leaves out is
// put back, and the rim's field is Keller's.
TEST(ReflectedEdge, EqualsKellerFieldWithoutReflectedBeam) {
  DihedralEdge rim = dihedral_edge(radians(50));
  rim.in.direction = {std::cos(radians(50)), -std::sin(radians(50)), 0};  // by the other arm too, and back the same way
  rim.in.E_h = {-std::sin(radians(50)), -std::cos(radians(50)), 0};
  rim.in.reflections = 1;
  rim.in.first_reflector_normal = Vec3::UnitX();
  rim.out = rim.in;
  const auto [hard, soft] = answer(rim);
  EXPECT_NEAR(std::abs(soft), std::abs(1 - 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
  EXPECT_NEAR(std::abs(hard), std::abs(1 + 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
}

TEST(ReflectedEdge, IsToldFromTheBeam) {
  const auto share = [](double above, double beside, int mirrors = 1) {
    DihedralEdge rim = dihedral_edge(above, beside);
    rim.out.reflections = static_cast<std::uint8_t>(mirrors);
    return reflected_face_weights(rim.wedge, rim.in, rim.out);
  };
  EXPECT_EQ(share(radians(30), 0)[1], 0);
  for (const double beside : {0.0, 0.05, 0.25, -0.2}) EXPECT_DOUBLE_EQ(share(radians(30), beside)[0], 1) << beside;
  // Shadow lines behind three mirrors keep their ends: only where it makes no difference.
  EXPECT_DOUBLE_EQ(share(radians(30), 0.05, 3)[0], 1);
  EXPECT_EQ(share(radians(30), 0.25, 3)[0], 0);
  // Grazing: the rim's face, the other mirror.
  EXPECT_EQ(share(radians(1.5), 0)[0], 0);
  EXPECT_EQ(share(radians(60), radians(29))[0], 0);
  // Off Keller's cone.
  DihedralEdge rim = dihedral_edge(radians(30));
  rim.out.direction = (rim.out.direction + 0.3 * Vec3::UnitZ()).normalized();
  EXPECT_EQ(std::ranges::max(reflected_face_weights(rim.wedge, rim.in, rim.out)), 0);
}

}  // namespace
}  // namespace seaglint
