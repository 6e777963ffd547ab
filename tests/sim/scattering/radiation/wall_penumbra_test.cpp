// SPDX-License-Identifier: BSD-3-Clause
// Walls behind edges of faces at grazing incidence, against integrals over the half-plane's field.
#include "sim/scattering/coefficients/amplitude_laws.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/radiation/multiple_diffraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scattering/radiation/edge_diffraction.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// A floor z = 0 with an edge along y at x = 0, and a wall at x = -20 m, as wide as long, viewed along x from 15 deg
// above the floor to as much below.
constexpr double kWallDistance = 20, kWidth = 20;

struct Field {
  Complex soft, hard;  // hh and vv per metre of wall
};

Field closed_form(double sine, double k, double height = 1000) {
  const RadarBasis radar = radar_basis(Vec3(std::sqrt(1 - sine * sine), 0, sine));
  const WallBehindEdge wall{Vec3::Zero(),
                            Vec3::UnitY(),
                            Vec3::UnitZ(),
                            Vec3::UnitX(),
                            height,
                            grazing_taper(radar.r, Vec3::UnitZ()),
                            {Vec3(-kWallDistance, -kWidth / 2, 0), Vec3(-kWallDistance, kWidth / 2, 0)}};
  std::vector<Contribution> contributions;
  append_wall_penumbra(wall, radar, {}, {.k = k}, contributions);
  Field sum{};
  for (const Contribution& contribution : contributions) {
    const auto s = scattered(contribution, monostatic(radar), k);
    // Phase from the foot.
    const Complex per_metre = std::polar(1 / kWidth, 2 * k * kWallDistance * std::sqrt(1 - sine * sine));
    sum.soft += per_metre * s[kHhChannel];
    sum.hard += per_metre * s[kVvChannel];
  }
  return sum;
}

// erfc(e^{j pi/4} u) / 2 by the transition function, which multiple_diffraction_test.cpp compares with its integral.
Complex shadow_field(double u) {
  if (u < 0) return 1.0 - shadow_field(-u);
  return u < 1e-9 ? 0.5 : std::polar(1.0, -u * u - kPi / 4) * transition_function(u * u) / (2 * std::sqrt(kPi) * u);
}

// Sommerfeld's solution for the half-plane (M. Born and E. Wolf, Principles of Optics, 8.7), which is the floor: the
// wave incident from the angle `from`, measured from the floor about the edge, or its image from minus that, at (x, z).
Complex half_plane(double from, double x, double z, double k) {
  const double r = std::hypot(x, z), off = std::atan2(z, -x) - from;
  return std::polar(1.0, k * r * std::cos(off)) * shadow_field(-std::sqrt(2 * k * r) * std::cos(0.5 * off));
}
// The difference of the exact product of the field on the wall and its slope, which by reciprocity is the receiver's,
// from physical optics, which illuminates the wall directly and once more via the floor up to the shadow-boundary line
// of the edge, where the wall's image radiates as well (image_weight()). They agree far above the penumbra except
// for waves of increasing phase rate up the wall, which a taper removes.
Field integral(double sine, double k) {
  const double angle = std::asin(sine), penumbra = std::sqrt(2 * kWallDistance / k),
               shadow = kWallDistance * std::tan(angle);
  // no step of the midpoint rule contains the line
  const double line = shadow != 0 ? std::abs(shadow) : 0.01 * penumbra,
               step = line / std::ceil(line / (0.002 * penumbra));
  const double from = std::abs(shadow) + 12 * penumbra, to = from + 40 * penumbra, h = 1e-5;
  Complex soft = 0, hard = 0;
  for (double z = step / 2; z < to; z += step) {
    const Complex up = std::polar(1.0, -2 * k * kWallDistance * std::cos(angle)) * std::polar(1.0, 2 * k * z * sine);
    const Complex direct = z + shadow > 0 ? up : 0,
                  via_floor = z < shadow ? std::polar(1.0, -2 * k * kWallDistance * std::cos(angle)) : 0,
                  via_image = via_floor * std::polar(1.0, -2 * k * z * sine);
    for (const double sign : {-1.0, 1.0}) {
      const auto field = [&](double x) {
        return half_plane(kPi - angle, x, z, k) + sign * half_plane(angle - kPi, x, z, k);
      };
      const Complex slope = (field(-kWallDistance + h) - field(-kWallDistance - h)) / Complex(0, 2 * h * k);
      (sign < 0 ? soft : hard) +=
          smooth_taper(z, {from, to}) *
          (field(-kWallDistance) * slope -
           std::cos(angle) * (direct + via_image + 2 * sign * (direct == 0.0 ? 0.0 : via_floor)));
    }
  }
  // S is -jk / 2 pi times that; phase from the foot.
  const Complex factor = Complex(0, -k / (2 * kPi)) * step * std::polar(1.0, 2 * k * kWallDistance * std::cos(angle));
  return {factor * soft, factor * hard};
}

// Soft up to 2 deg above the floor, where reflected-edge contributions begin, and to 15 deg below; hard to 2 deg on
// either side, where multiple diffraction begins.
TEST(WallPenumbra, EqualsHalfPlaneFieldLessPhysicalOptics) {
  // soft, at grazing: 2 (l / pi k)^(1/2) k / 2 pi
  const double k = wavenumber(10e9), soft_at_grazing = std::sqrt(k * kWallDistance / kPi) / kPi;
  for (const double sine :
       {-0.25, -0.1, -0.03, -0.01, -0.003, -0.001, -0.00005, 0.0, 0.00005, 0.001, 0.003, 0.01, 0.03}) {
    const Field found = closed_form(sine, k), expected = integral(sine, k);
    // Error of cosines of the angle; the midpoint rule; within 1e-4 of the floor's plane the extrapolation from there
    // with the derivative over 1e-3, which lacks the second order in x.
    const double tolerance = 1.5 * sine * sine * std::abs(expected.soft) + 1e-4 * soft_at_grazing +
                             (std::abs(sine) < 1e-4 ? 2 * k * kWallDistance * 1e-4 * 1e-3 * soft_at_grazing : 0);
    EXPECT_LT(std::abs(found.soft - expected.soft), tolerance) << sine;
    if (std::abs(sine) > 0.03) continue;
    EXPECT_LT(std::abs(found.hard - expected.hard), tolerance + 1.5 * sine * sine * std::abs(expected.hard)) << sine;
  }
}

// At grazing the effective height of the wall is lower by (l / pi k)^(1/2) for the soft wave on either path, and
// unchanged for the hard one.
TEST(WallPenumbra, LowersEffectiveWallHeightAtGrazing) {
  const double k = wavenumber(10e9), soft_at_grazing = std::sqrt(k * kWallDistance / kPi) / kPi;
  const Field field = closed_form(0, k);
  EXPECT_LT(std::abs(field.soft - std::polar(soft_at_grazing, kPi / 4)), 1e-3 * soft_at_grazing);
  EXPECT_LT(std::abs(field.hard), 1e-3 * soft_at_grazing);
}

// The term at the foot and the edge's diffracted field via the wall are weighted where they are computed, each by the
// geometry it has: together they are one field.
TEST(WallPenumbra, FootAndReflectedEdgeSumToOne) {
  const double k = wavenumber(10e9), distance = 20;
  WedgeFrame edge_of_deck;  // the deck z = 0 at x < 0, its edge along y
  edge_of_deck.N = 1.5;
  edge_of_deck.face[0] = {-Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY()};
  edge_of_deck.face[1] = {-Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitY()};
  int shared = 0;
  for (double sine = 0.05; sine < 0.55; sine += 0.01) {
    const Vec3 r(std::sqrt(1 - sine * sine), 0, sine), normal = Vec3::UnitX();
    const WallBehindEdge wall{
        Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ(), normal, 1000, 0, {Vec3(-distance, -1, 0), Vec3(-distance, 1, 0)}};
    std::vector<Contribution> contributions;
    append_wall_penumbra(wall, radar_basis(r), {}, {.k = k}, contributions);
    ASSERT_FALSE(contributions.empty());
    const double foot = std::get<WallPenumbraTerm>(contributions.front().interval()->amplitude).foot_weight;
    EdgeIllumination in, out;
    in.direction = -r;
    out.direction = -(r - 2 * normal.dot(r) * normal);  // of the receiver's wave, after the wall
    out.reflections = 1;
    out.first_reflector_normal = normal;
    const double edge = reflected_face_weights(edge_of_deck, in, out)[0];
    EXPECT_NEAR(foot + edge, 1, 1e-12) << sine;
    shared += edge > 0.01 && edge < 0.99;
  }
  EXPECT_GT(shared, 3);
}

// The penumbra is (2 l / k)^(1/2) = 0.44 m high.
TEST(WallPenumbra, NeedsAWallHigherThanThePenumbra) {
  const double k = wavenumber(10e9);
  const auto in_grazing = [&](double height) { return std::abs(closed_form(0, k, height).soft); };
  EXPECT_EQ(in_grazing(0.25), 0);
  EXPECT_GT(in_grazing(0.5), 10);
}

// The contribution belongs to the parts of wall and floor, so that a filter by part includes it correctly, and a cavity
// can replace it.
TEST(WallPenumbra, BelongsToTheWallAndItsFloor) {
  TriangleMesh corner = make_square_trihedral(0.4);
  for (std::size_t i = 0; i < corner.triangles.size(); ++i) corner.triangle_part[i] = static_cast<std::uint16_t>(i / 2);
  corner.part_names = {"one", "two", "three"};
  const Scatterer scatterer(corner);
  const BistaticGeometry geometry = monostatic(radar_basis(direction(30, 2)));
  const auto illuminations =
      illumination(scatterer, geometry, {0, 4, true}).trace(1, ignore_contributions).edge_illuminations;
  std::vector<Contribution> contributions;
  trace_multiple_diffraction({scatterer, geometry, {}, illuminations, {}}, illuminations.all(), contributions);
  int walls = 0;
  for (const Contribution& contribution : contributions) {
    if (!std::holds_alternative<WallPenumbraTerm>(contribution.interval()->amplitude)) continue;
    ++walls;
    EXPECT_NE(contribution.source.part, contribution.source.other_part);
  }
  EXPECT_GT(walls, 0);
}

}  // namespace
}  // namespace seaglint
