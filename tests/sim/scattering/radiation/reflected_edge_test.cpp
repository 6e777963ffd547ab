// SPDX-License-Identifier: BSD-3-Clause
// Bounding edges of reflectors in the direction of the reflected beam: closed forms.
#include "sim/scattering/radiation/edge_diffraction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/scattering/coefficients/fade_windows.h"

namespace seaglint {
namespace {

// The edge of a right-angled dihedral's arm y = 0, x <= 0, whose other arm is at some x < 0; the wave is incident from
// in front of the edge and leaves the arm at an angle `above` towards the other one.
struct DihedralEdge {
  WedgeFrame wedge;
  EdgeIllumination in, out;
};

DihedralEdge dihedral_edge(double above, double off_specular = 0) {
  const Vec3 x = -Vec3::UnitX(), y = Vec3::UnitY(), t = x.cross(y);
  const double c = std::cos(above), s = std::sin(above), c2 = std::cos(above + off_specular),
               s2 = std::sin(above + off_specular);
  DihedralEdge edge{{{{x, y, t}, {x, -y, -t}}, 2}, {}, {}};
  edge.in.direction = {-c, -s, 0};
  edge.in.E_h = {-s, c, 0};  // hard: normal to the edge
  edge.in.E_v = Vec3::UnitZ();
  // The receiver's wave, reversed, after the other arm: E' = 2 (n.E) n - E.
  edge.out.direction = {c2, -s2, 0};
  edge.out.E_h = {-s2, -c2, 0};
  edge.out.E_v = -Vec3::UnitZ();
  edge.out.reflections = 1;
  edge.out.first_reflector_normal = Vec3::UnitX();
  return edge;
}

// hh and vv of the edge in the direction of the beam, per metre.
std::array<double, 2> coefficients(const DihedralEdge& edge) {
  const auto currents =
      equivalent_edge_currents(edge.wedge, edge.in.direction, {edge.in.E_h, edge.in.E_v}, -edge.out.direction);
  const auto endpoints = endpoint_correction(edge.wedge.face[0], edge.in, edge.out);
  return {edge.out.E_h.dot(currents[0]) + endpoints[0], edge.out.E_v.dot(currents[1]) + endpoints[3]};
}

// Keller's 1 / (2 sin a) less tan(a) / 2 of the other arm's end-point contribution, over 2 pi; soft and hard
// coefficients have opposite signs, as a dihedral's echoes do.
TEST(ReflectedEdge, OfADihedralIsKellersCoefficientLessTheOtherArmsEndPoint) {
  // the sign of the edge of the last reflector, below
  const double sign = std::copysign(1.0, coefficients(dihedral_edge(radians(45)))[0]);
  for (const double above_deg : {10.0, 20.0, 33.0, 45.0, 60.0}) {
    const double above = radians(above_deg), expected = (1 / std::sin(above) - std::tan(above)) / (4 * kPi);
    const auto [hard, soft] = coefficients(dihedral_edge(above));
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
  const auto [hard, soft] = coefficients(first);
  EXPECT_NEAR(first.in.E_h.dot(currents[0]), hard, 1e-6);
  EXPECT_NEAR(first.in.E_v.dot(currents[1]), soft, 1e-6);
}

TEST(ReflectedEdge, NeedsNoCorrectionOnTheLastReflector) {
  const DihedralEdge edge = dihedral_edge(radians(30));
  for (const double end : endpoint_correction(edge.wedge.face[0], edge.out, edge.in)) EXPECT_EQ(end, 0);
}

// At an angle b about the edge off the specular direction: Keller's coefficients of a half-plane less the end-point
// contribution of physical optics on the other arm, whose currents are proportional to the cosine of incidence (soft)
// or of the exit direction (hard).
TEST(ReflectedEdge, ExcludesTheOtherArmsEndPointOffTheSpecularDirection) {
  for (const double above_deg : {20.0, 45.0, 60.0}) {
    const double above = radians(above_deg), sign = std::copysign(1.0, coefficients(dihedral_edge(radians(45)))[0]);
    for (const double off_specular : {-0.15, -0.002, 0.002, 0.05, 0.3}) {
      const double direct = 1 / std::cos(0.5 * (kPi - 2 * above - off_specular)),
                   pole = 1 / std::sin(0.5 * off_specular);
      const double slope_difference = std::sin(above + off_specular) - std::sin(above);
      const auto [hard, soft] = coefficients(dihedral_edge(above, off_specular));
      // Rounding near the poles.
      EXPECT_NEAR(soft, sign * ((direct + pole) / (4 * kPi) - std::cos(above) / (2 * kPi * slope_difference)), 1e-9)
          << above_deg << " " << off_specular;
      EXPECT_NEAR(hard,
                  sign * ((direct - pole) / (4 * kPi) + std::cos(above + off_specular) / (2 * kPi * slope_difference)),
                  1e-9)
          << above_deg << " " << off_specular;
    }
  }
}

// A beam that does not reach the other reflector has no end-point contribution there: the one of physical optics on the
// edge's own face is added back, and the edge has Keller's field.
TEST(ReflectedEdge, EqualsKellerFieldWithoutReflectedBeam) {
  DihedralEdge edge = dihedral_edge(radians(50));
  edge.in.direction = {std::cos(radians(50)), -std::sin(radians(50)), 0};  // both paths via the other arm
  edge.in.E_h = {-std::sin(radians(50)), -std::cos(radians(50)), 0};
  edge.in.reflections = 1;
  edge.in.first_reflector_normal = Vec3::UnitX();
  edge.out = edge.in;
  const auto [hard, soft] = coefficients(edge);
  EXPECT_NEAR(std::abs(soft), std::abs(1 - 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
  EXPECT_NEAR(std::abs(hard), std::abs(1 + 1 / std::cos(radians(50))) / (4 * kPi), 1e-9);
}

// An edge askew to the reflector behind it: in a second direction on Keller's cone psi does not vary across the image
// of the edge's face on the reflector. The end-point contributions are finite there, since that of the reflector is
// left out, as in the direction of the beam, since the poles cancel.
TEST(ReflectedEdge, HasNoPoleAskewToTheReflector) {
  const Vec3 k_hat(0.6338, -0.7686, -0.0872),
      n = Vec3(-0.9415, -0.2414, -0.2354).normalized(),
      t = (Vec3(0, -0.6981, 0.7160) - n.dot(Vec3(0, -0.6981, 0.7160)) * n).normalized(), x = n.cross(t);
  const WedgeFace face{x, n, t};  // t = x cross n
  EdgeIllumination in, out;
  in.direction = k_hat.normalized();
  in.E_h = in.direction.unitOrthogonal();
  in.E_v = in.direction.cross(in.E_h);
  out.reflections = 1;
  out.first_reflector_normal = Vec3::UnitZ();
  const Vec3 beam = in.direction - 2 * n.dot(in.direction) * n;
  double largest = 0;
  for (double off = -0.9; off <= 0.3; off += 1e-4) {
    out.direction = -(axis_rotation(off, t) * beam);
    out.E_h = out.direction.unitOrthogonal();
    out.E_v = out.direction.cross(out.E_h);
    for (const double end : endpoint_correction(face, in, out)) largest = std::max(largest, std::abs(end));
  }
  EXPECT_GT(largest, 0.1);
  // 1 / (2 pi) over the least slope of psi and the sine of the grazing angle at the reflector.
  EXPECT_LT(largest, 1 / (2 * kPi * kSlopeWindow[1] * std::abs(beam.z())));
}

TEST(ReflectedEdge, WeightsVanishWhereNotSeparableFromTheBeam) {
  const auto weights = [](double above, double off_specular, int reflections = 1) {
    DihedralEdge edge = dihedral_edge(above, off_specular);
    edge.out.reflections = static_cast<std::uint8_t>(reflections);
    return reflected_face_weights(edge.wedge, edge.in, edge.out);
  };
  EXPECT_EQ(weights(radians(30), 0)[1], 0);
  for (const double off_specular : {0.0, 0.05, 0.25, -0.2})
    EXPECT_DOUBLE_EQ(weights(radians(30), off_specular)[0], 1) << off_specular;
  // Shadow-boundary lines after three reflectors keep their end-point contributions: corrected only where it makes no
  // difference.
  EXPECT_DOUBLE_EQ(weights(radians(30), 0.05, 3)[0], 1);
  EXPECT_EQ(weights(radians(30), 0.25, 3)[0], 0);
  // Grazing: the face of the edge, the other reflector.
  EXPECT_EQ(weights(radians(1.5), 0)[0], 0);
  EXPECT_EQ(weights(radians(60), radians(29))[0], 0);
  // Off Keller's cone.
  DihedralEdge edge = dihedral_edge(radians(30));
  edge.out.direction = (edge.out.direction + 0.3 * Vec3::UnitZ()).normalized();
  EXPECT_EQ(std::ranges::max(reflected_face_weights(edge.wedge, edge.in, edge.out)), 0);
}

}  // namespace
}  // namespace seaglint
