// SPDX-License-Identifier: BSD-3-Clause
// Bounding edges of reflectors in the direction of the reflected beam: closed forms.
#include "sim/scattering/edges/reflected_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// The edge of a right-angled dihedral's arm y = 0, x <= 0, whose other arm is at some x < 0; the wave is incident from
// in front of the edge and leaves the arm at an angle `above` towards the other one.
struct DihedralEdge {
  WedgeFrame wedge;
  EdgeIllumination in, out;
};

DihedralEdge dihedral_edge(double above, double beside = 0) {
  const Vec3 x = -Vec3::UnitX(), y = Vec3::UnitY(), t = x.cross(y);
  const double c = std::cos(above), s = std::sin(above), c2 = std::cos(above + beside), s2 = std::sin(above + beside);
  DihedralEdge rim{{{{x, y, t}, {x, -y, -t}}, 2}, {}, {}};
  rim.in.direction = {-c, -s, 0};
  rim.in.E_h = {-s, c, 0};  // hard: normal to the edge
  rim.in.E_v = Vec3::UnitZ();
  // The receiver's wave, reversed, after the other arm: E' = 2 (n.E) n - E.
  rim.out.direction = {c2, -s2, 0};
  rim.out.E_h = {-s2, -c2, 0};
  rim.out.E_v = -Vec3::UnitZ();
  rim.out.reflections = 1;
  rim.out.first_reflector_normal = Vec3::UnitX();
  return rim;
}

// hh and vv of the edge in the direction of the beam, per metre.
std::array<double, 2> answer(const DihedralEdge& rim) {
  const auto currents =
      equivalent_edge_currents(rim.wedge, rim.in.direction, {rim.in.E_h, rim.in.E_v}, -rim.out.direction);
  const auto ends = endpoint_correction(rim.wedge.face[0], rim.in, rim.out);
  return {rim.out.E_h.dot(currents[0]) + ends[0], rim.out.E_v.dot(currents[1]) + ends[3]};
}

// Keller's 1 / (2 sin a) less tan(a) / 2 of the other arm's end-point contribution, over 2 pi; soft and hard
// coefficients have opposite signs, as a dihedral's echoes do.
TEST(ReflectedEdge, OfADihedralIsKellersCoefficientLessTheOtherArmsEndPoint) {
  // the sign of the edge of the last reflector, below
  const double sign = std::copysign(1.0, answer(dihedral_edge(radians(45)))[0]);
  for (const double above_deg : {10.0, 20.0, 33.0, 45.0, 60.0}) {
    const double above = radians(above_deg), expected = (1 / std::sin(above) - std::tan(above)) / (4 * kPi);
    const auto [hard, soft] = answer(dihedral_edge(above));
    // The end-point contributions are evaluated 1e-4 rad to either side of the beam, on a curve whose curvature is 1 /
    // a^3.
    EXPECT_NEAR(hard, sign * expected, 1e-6) << above_deg;
    EXPECT_NEAR(soft, sign * expected, 1e-6) << above_deg;
  }
}

// On a dihedral's axis both arms are equivalent, and so are the bounding edges of the first and the last reflector.
TEST(ReflectedEdge, OnADihedralsAxisEqualsThatOfTheLastReflector) {
  const DihedralEdge first = dihedral_edge(radians(45));
  const auto currents =
      equivalent_edge_currents(first.wedge, first.out.direction, {first.out.E_h, first.out.E_v}, -first.in.direction);
  const auto [hard, soft] = answer(first);
  EXPECT_NEAR(first.in.E_h.dot(currents[0]), hard, 1e-6);
  EXPECT_NEAR(first.in.E_v.dot(currents[1]), soft, 1e-6);
}

TEST(ReflectedEdge, NeedsNoCorrectionOnTheLastReflector) {
  const DihedralEdge rim = dihedral_edge(radians(30));
  for (const double end : endpoint_correction(rim.wedge.face[0], rim.out, rim.in)) EXPECT_EQ(end, 0);
}

// At an angle b about the edge off the specular direction: Keller's coefficients of a half-plane less the end-point
// contribution of physical optics on the other arm, whose currents are proportional to the cosine of incidence (soft)
// or of the exit direction (hard).
TEST(ReflectedEdge, ExcludesTheOtherArmsEndPointOffTheSpecularDirection) {
  for (const double above_deg : {20.0, 45.0, 60.0}) {
    const double above = radians(above_deg), sign = std::copysign(1.0, answer(dihedral_edge(radians(45)))[0]);
    for (const double beside : {-0.15, -0.002, 0.002, 0.05, 0.3}) {
      const double direct = 1 / std::cos(0.5 * (kPi - 2 * above - beside)), pole = 1 / std::sin(0.5 * beside);
      const double run = std::sin(above + beside) - std::sin(above);
      const auto [hard, soft] = answer(dihedral_edge(above, beside));
      // Rounding near the poles.
      EXPECT_NEAR(soft, sign * ((direct + pole) / (4 * kPi) - std::cos(above) / (2 * kPi * run)), 1e-9)
          << above_deg << " " << beside;
      EXPECT_NEAR(hard, sign * ((direct - pole) / (4 * kPi) + std::cos(above + beside) / (2 * kPi * run)), 1e-9)
          << above_deg << " " << beside;
    }
  }
}

// A beam that does not reach the other reflector has no end-point contribution there: the one of physical optics on the
// edge's own face is added back, and the edge has Keller's field.
TEST(ReflectedEdge, EqualsKellerFieldWithoutReflectedBeam) {
  DihedralEdge rim = dihedral_edge(radians(50));
  rim.in.direction = {std::cos(radians(50)), -std::sin(radians(50)), 0};  // both paths via the other arm
  rim.in.E_h = {-std::sin(radians(50)), -std::cos(radians(50)), 0};
  rim.in.reflections = 1;
  rim.in.first_reflector_normal = Vec3::UnitX();
  rim.out = rim.in;
  const auto [hard, soft] = answer(rim);
  EXPECT_NEAR(std::abs(soft), std::abs(1 - 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
  EXPECT_NEAR(std::abs(hard), std::abs(1 + 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
}

TEST(ReflectedEdge, WeightsVanishWhereNotSeparableFromTheBeam) {
  const auto share = [](double above, double beside, int mirrors = 1) {
    DihedralEdge rim = dihedral_edge(above, beside);
    rim.out.reflections = static_cast<std::uint8_t>(mirrors);
    return reflected_face_weights(rim.wedge, rim.in, rim.out);
  };
  EXPECT_EQ(share(radians(30), 0)[1], 0);
  for (const double beside : {0.0, 0.05, 0.25, -0.2}) EXPECT_DOUBLE_EQ(share(radians(30), beside)[0], 1) << beside;
  // Shadow-boundary lines after three reflectors keep their end-point contributions: corrected only where it makes no
  // difference.
  EXPECT_DOUBLE_EQ(share(radians(30), 0.05, 3)[0], 1);
  EXPECT_EQ(share(radians(30), 0.25, 3)[0], 0);
  // Grazing: the face of the edge, the other reflector.
  EXPECT_EQ(share(radians(1.5), 0)[0], 0);
  EXPECT_EQ(share(radians(60), radians(29))[0], 0);
  // Off Keller's cone.
  DihedralEdge rim = dihedral_edge(radians(30));
  rim.out.direction = (rim.out.direction + 0.3 * Vec3::UnitZ()).normalized();
  EXPECT_EQ(std::ranges::max(reflected_face_weights(rim.wedge, rim.in, rim.out)), 0);
}

}  // namespace
}  // namespace seaglint
