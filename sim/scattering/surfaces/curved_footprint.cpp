// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/surfaces/curved_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seaglint {
namespace {

// Behind curved mirrors rays are followed to second order while a bundle's width grows to less than this. Farther away
// it lands beside the window it was measured in by more than its own width, and the mirrors count as flat: the parting
// of their facets' bundles is then all that spreads them.
constexpr double kMostSpread = 4;

// The triangle of a flat panel's first facet, enlarged about a point of its own until it holds the whole panel. It
// belongs to the panel, not to a footprint: pieces that meet on the panel are then cut alike, and their contours
// cancel.
std::array<Vec2, 3> around_panel(const Curving& on, const Leg& leg, std::span<const Vec3> outline,
                                 const std::array<Vec2, 3>& first) {
  if (outline.size() == 3) return first;
  const Barycentric lambda(first);
  std::array<double, 3> least{};
  for (const Vec3& x : outline) {
    const Vec2 p = projected(on, leg, x);
    for (int i = 0; i < 3; ++i) least[i] = std::min(least[i], lambda.at(i, p));
  }
  std::array<Vec2, 3> corner;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    corner[i] = (1 - least[j] - least[l]) * first[i] + least[j] * first[j] + least[l] * first[l];
  }
  return corner;
}

// Cosine of the incidence at a normal of the smooth surface. Beyond the shadow boundary, where currents have faded, it
// stays positive.
double smooth_cosine(const Leg& leg, const Facet& flat, const Vec3& normal) {
  return std::max(-normal.dot(leg.direction), 0.25 * std::abs(flat.normal.dot(leg.direction)));
}

}  // namespace

std::shared_ptr<const Curvature> curvature_of(const Curving& on, const Panels& panels, const AntennaPair& antennas,
                                              const Leg& leg, const Candidate& candidate, const Footprint& footprint) {
  const auto& [transmit, receive, is_monostatic] = antennas;
  const int facet = candidate.image.facet;
  const CurvedFacet* curved = on.surface.curved(facet);
  BentRays rays;
  if (leg.bent) rays = travelled(leg, candidate);
  const bool bent = leg.bent && rays.landing.matrix.norm() < kMostSpread;
  if (!bent) rays = {};
  if (!curved && !bent) return nullptr;
  auto corner = projected(on, leg, facet);
  if (!curved) corner = around_panel(on, leg, panels.outline(facet), corner);
  const Barycentric lambda(corner);

  // The surface stands higher by z / cos(incidence) along the ray, both ways.
  const Mat3& L = leg.mirrors.L;
  const Vec3 both = transmit.r + L * receive.r;
  const double both_ways = both.dot(transmit.r);
  Quadratic standing;
  if (curved) standing = bump(lambda, over_edges(on, leg, facet, [&](double cosine) { return both_ways / cosine; }));

  Curvature c{corner, lambda, rays.phase, {}, {}, {}, {}, {}, {}};
  c.phase += compose({0, footprint.w, Mat2::Zero()}, {rays.landing.offset, rays.landing.matrix - Mat2::Identity()});
  c.phase += compose(standing, rays.landing);
  // A bundle that widens by det lights as much area more with a field as much weaker: the square root of it. Behind one
  // focus the phase has advanced by a quarter, behind two by a half of a cycle.
  const double widened = rays.landing.matrix.determinant();
  c.spread = std::sqrt(std::abs(widened)) * (widened < 0                       ? Complex(0, 1)
                                             : rays.landing.matrix.trace() < 0 ? Complex(-1)
                                                                               : Complex(1));
  const double side = on.facets[facet].normal.dot(leg.direction) < 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    c.lit[i] = c.seen[i] = std::numeric_limits<double>::infinity();
    c.w[i] = c.slope[i] = footprint.w + c.phase.slope(corner[i]);
    c.pattern[i] = footprint.pattern;
    if (curved) {
      const int vertex = curved->vertex[i];
      c.lit[i] = on.surface.terminator_distance(vertex, -leg.direction, side);
      if (!is_monostatic || leg.bounce > 1) c.seen[i] = on.surface.terminator_distance(vertex, receive.r, side);
      const Vec3 n = side * on.surface.vertex(vertex).normal;
      const double cosine = smooth_cosine(leg, on.facets[facet], n);
      const Vec3 image = L * n;
      const Vec2 slope = -Vec2(image.dot(transmit.h), image.dot(transmit.v)) / cosine;
      c.w[i] += both_ways * (slope - footprint.plane.slope) - standing.slope(corner[i]);
      const Vec3 tangential = both - image * image.dot(both);
      c.slope[i] += Vec2(tangential.dot(transmit.h), tangential.dot(transmit.v)) +
                    tangential.dot(transmit.r) * footprint.plane.slope - footprint.w - standing.slope(corner[i]);
      if (footprint.patterns.empty()) c.pattern[i] = conductor_pattern(leg, n, cosine, receive);
    }
  }
  return std::make_shared<const Curvature>(c);
}

}  // namespace seaglint
