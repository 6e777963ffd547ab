// SPDX-License-Identifier: BSD-3-Clause
// No single surface contribution exceeds what any surface between a facet and its sagitta can give.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/radiation/surface_radiation.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/random_body.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Largest element of the pattern over the footprint.
double largest_pattern(const Contribution& contribution) {
  double pattern = largest(contribution.pattern.value);
  if (const auto& curvature = contribution.footprint()->curvature) {
    for (const auto& at_vertex : curvature->pattern) pattern = std::max(pattern, largest(at_vertex));
  }
  return pattern;
}

// Area of the panel in the projection plane, m^2.
double projected_panel_area(const Scatterer& scatterer, const Contribution& contribution) {
  const std::span<const Vec3> outline = scatterer.panels().outline(contribution.source.facet);
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    twice += (outline[i] - outline[0]).cross(outline[i + 1] - outline[0]);
  return 0.5 * twice.norm() / std::sqrt(1 + contribution.footprint()->plane.slope.squaredNorm());
}

// Area that bent rays illuminate, m^2 in the projection plane, that illuminate `area` where the reflectors are flat: no
// ray moves by more than half the width of the cross-section (a triangle widened so has 5.5 times its area), or all
// stay on the panel (arriving_rays()).
double largest_area(const Scatterer& scatterer, const Contribution& contribution, double area) {
  constexpr double kWidened = 5.5;
  return std::max(kWidened * area, projected_panel_area(scatterer, contribution));
}

// Error of the contour form of an integral over a curved facet.
struct ContourError {
  double relative = 0;  // of the area
  double ends = 0;      // of the sides, m^2
};

// Relative: three second derivatives of psi over the square of its slope, 1 / kContourRatio each, and the difference
// between the slopes of psi and of the vertex normals, over the latter, 1 at most. Sides: `of_sides` of length / (k
// slope), with 1 / (k slope) below the size of the facet.
ContourError contour_error(const Footprint& footprint, double k, double of_sides) {
  constexpr double kSecondDerivatives = 3;
  const CurvedFootprint& curved = *footprint.curvature;
  const Vec2& rise = footprint.plane.slope;
  const double area_ratio = std::sqrt(1 + rise.squaredNorm());
  const auto along_surface = [&](const Vec2& slope) -> Vec2 {
    if (rise.squaredNorm() == 0) return slope;
    return slope - (1 - 1 / area_ratio) * rise.dot(slope) / rise.squaredNorm() * rise;
  };
  double length = 0, least = std::numeric_limits<double>::infinity(), difference = 0;
  for (std::size_t i = 0; i < footprint.polygon.size(); ++i) {
    const Vec2& p = footprint.polygon[i].p;
    length += footprint.surface_length(footprint.polygon[(i + 1) % footprint.polygon.size()].p - p);
    Vec2 of_normals = Vec2::Zero();
    for (int corner = 0; corner < 3; ++corner) of_normals += curved.lambda.at(corner, p) * curved.w[corner];
    const Vec2 of_psi = footprint.w + curved.phase.slope(p);
    least = std::min(least, along_surface(of_normals).norm());
    difference = std::max(difference, along_surface(of_psi - of_normals).norm());
  }
  const double of_slopes = std::min(difference / least, 1.0);
  return {kSecondDerivatives / kContourRatio + of_slopes,
          (of_sides + of_slopes) * length / area_ratio * std::min(1 / (k * least), footprint.panel_size)};
}

// Bound of |S|. Physical optics of unit field on an area A is at most k A pattern / (2 pi). Curved reflectors spread
// the power of a beam over an area A': the integral of the field is at most sqrt(A A') (Cauchy and Schwarz); a caustic
// has A' = 0. The obliquity of rays that they tilt is limited to 2 (CurvedFootprint::divergence_factor()).
double bound(const Scatterer& scatterer, const Contribution& contribution, double k, double of_sides) {
  const Footprint& footprint = *contribution.footprint();
  constexpr double kMaxObliquity = 2, kRounding = 1e-6;
  const double area = std::abs(signed_area(footprint.polygon));
  double integral = (1 + kRounding) * area;
  if (footprint.curvature) {
    const ContourError error = contour_error(footprint, k, of_sides);
    if (footprint.curvature->has_bundle)
      integral = std::sqrt(kMaxObliquity * area * largest_area(scatterer, contribution, area));
    integral = (1 + error.relative) * integral + error.ends;
  }
  return k / (2 * kPi) * largest_pattern(contribution) * integral;
}

// Part of its sides' terms that the contour of a facet may leave: the change of the slope across and along a side, at
// either end. All of it where the crease rule gives a facet normals that contradict its sides.
constexpr double kResolvedSides = 4 / kContourRatio, kAnySides = 1;

struct Excess {
  double flat = 0, curved = 0, bent = 0;  // largest |S| / bound: flat facets, curved ones, behind curved reflectors
  std::size_t count = 0;
};

Excess largest_excess(const Scatterer& scatterer, double frequency_hz, std::span<const Vec3> views, double of_sides,
                      double min_patch_m = 0) {
  const std::array k{wavenumber(frequency_hz)};
  const TracingSettings settings{min_patch_m, kDefaultBounces, false};
  Excess excess;
  for (const Vec3& r_hat : views) {
    const BistaticGeometry pair = monostatic(radar_basis(r_hat));
    illumination(scatterer, pair, settings, k)
        .trace(1, [&](std::size_t, std::size_t, std::span<const Contribution> contributions) {
          for (const Contribution& contribution : contributions) {
            const auto& curvature = contribution.footprint()->curvature;
            double& of_kind = !curvature ? excess.flat : curvature->has_bundle ? excess.bent : excess.curved;
            of_kind = std::max(
                of_kind, largest(scattered(contribution, pair, k[0])) / bound(scatterer, contribution, k[0], of_sides));
            ++excess.count;
          }
        });
  }
  return excess;
}

void expect_bounded(const char* name, const Excess& excess) {
  std::printf(
      "%s: %zu contributions, at most %.4f (flat), %.3f (curved), %.3f (behind curved reflectors) of the bound\n", name,
      excess.count, excess.flat, excess.curved, excess.bent);
  EXPECT_GT(excess.count, 0u);
  for (const double ratio : {excess.flat, excess.curved, excess.bent}) EXPECT_LE(ratio, 1);
}

TEST(ContributionBound, HoldsOnTheShip) {
  const Scatterer ship(repair(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb")));
  std::vector<Vec3> views;
  for (int i = 0; i < 8; ++i) views.push_back(direction(10 + 47.0 * i, 2 + i % 3));
  expect_bounded("ship", largest_excess(ship, 10e9, views, kResolvedSides));
}

// The crease rule takes more of this ship's facets for curved than its shape does, and cavities between them reflect
// up to 40 times.
TEST(ContributionBound, HoldsOnADefectiveMeshWithTheCreaseRule) {
  const Scatterer moskva(repair(read_mesh(SEAGLINT_SOURCE_DIR "/tests/reference/meshes/moskva.glb")), {}, radians(20));
  expect_bounded(
      "moskva",
      largest_excess(moskva, 635.49e9, std::array{direction(45, 5), direction(130, 5), direction(260, 5)}, kAnySides));
}

TEST(ContributionBound, HoldsOnRandomBodies) {
  std::vector<Vec3> views;
  for (int i = 0; i < 4; ++i) views.push_back(direction(17 + 97.0 * i, 1 + 15 * i));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    expect_bounded("random body", largest_excess(Scatterer(random_body(seed)), 10e9, views, kResolvedSides, 1e-3));
  }
}

// A bundle that a concave reflector focuses, on a panel square to it and on an oblique one: |factor|^2 is at most the
// area across the ray over that of the flat bundle, times the square of the obliquity, 2.
TEST(ContributionBound, TheDivergenceFactorTendsToZeroAtACaustic) {
  for (const double tilt : {0.0, 0.3}) {
    for (const Vec2& path_slope : {Vec2(0, 0), Vec2(3, -2)}) {
      for (const double width : {1e-1, 1e-3, 1e-5}) {
        const std::array corner{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
        CurvedFootprint footprint{corner, Barycentric(corner), {}, {}, {}, {}, {}, true, true, {}, {}, {}};
        footprint.rays.bundle.position_map.matrix = Mat2({width, 0}, {0, 1});
        footprint.rays.bundle.direction_map = {Vec2(tilt, -tilt), Mat2({-1, 0}, {0, 0})};
        footprint.rays.path_slope = path_slope;
        EXPECT_LE(std::abs(footprint.divergence_factor(Vec2::Zero())), 2 * std::sqrt(width) * (1 + 1e-12));
      }
    }
  }
}

}  // namespace
}  // namespace seaglint
