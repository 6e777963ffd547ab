// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/prism_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/scattering/geometry/tolerances.h"

namespace seaglint {

void PrismSearch::find(const BeamSegment& segment, const PolygonSet& cross_section,
                       std::vector<FoundPanel>& found) const {
  const Prism prism = bounding_prism(cross_section.polygons(), segment, scene_.transmit, scene_.scatterer.facets());
  double covered = std::numeric_limits<double>::infinity();
  scene_.scatterer.tree().traverse(prism, [&](const BvhPanel& panel) {
    if (panel.facet == segment.source_facet) return covered;
    const PrismOverlap met = test_overlap(segment, prism, panel);
    if (met.possible) found.push_back({&panel});
    return covered = std::min(covered, met.full_cover_distance);
  });
}

void PrismSearch::find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                               std::vector<MovingPolygon>& visible) const {
  scene_.receivers[receiver].visible.visible_after_reflections(
      candidate.projection.facet, segment.image_transform, candidate.illuminated.polygons(), scene_.transmit, visible);
}

bool PrismSearch::may_be_seen(int facet) const {
  return std::ranges::any_of(
      scene_.receivers, [&](const Receiver& receiver) { return !receiver.visible.pieces(facet).empty(); });
}

Prism bounding_prism(std::span<const MovingPolygon> window, const BeamSegment& segment, const RadarBasis& basis,
                     std::span<const Facet> facets) {
  // The prism's sides are parallel to the longest side of the cross-section, so that the prism around an elongated
  // cross-section of any orientation is narrow.
  const Vec2 longest = along_longest_side(window);
  const std::array<Vec2, 2> axis{longest, Vec2(-longest.y(), longest.x())};
  const Vec2 t(segment.image_transform.t.dot(basis.h), segment.image_transform.t.dot(basis.v));
  Prism prism;
  for (int i = 0; i < 2; ++i) {
    prism.across[i] = segment.image_transform.L.transpose() * (axis[i].x() * basis.h + axis[i].y() * basis.v);
    prism.lower[i] = std::numeric_limits<double>::infinity();
    prism.upper[i] = -prism.lower[i];
    for (const MovingPolygon& piece : window) {
      for (const MovingVertex& vertex : piece) {
        const double at = axis[i].dot(vertex.p - t);
        prism.lower[i] = std::min(prism.lower[i], at);
        prism.upper[i] = std::max(prism.upper[i], at);
      }
    }
  }
  prism.normal = segment.source_normal;
  prism.offset = segment.source_normal.dot(facets[segment.source_facet].corner[0]) + kCoincident;
  prism.along = prism.wave = segment.direction;
  return prism;
}

PrismOverlap test_overlap(const BeamSegment& segment, const Prism& prism, const BvhPanel& panel) {
  // A closed surface is illuminated on the side of its normals only.
  const double facing = panel.normal.dot(segment.direction);
  if (!panel.open && facing >= 0) return {};
  const std::span<const Vec3> outline = panel.outline();
  std::size_t beyond = 0;
  for (const Vec3& x : outline) beyond += prism.normal.dot(x) > prism.offset;
  if (beyond == 0) return {};
  // The prism's rectangle is tested against every side of the panel, projected along the beam: outside one of them
  // there is no overlap, inside all of them the panel covers the prism. `turn` is the sense in which the projected
  // outline runs.
  const Vec2 middle(0.5 * (prism.lower[0] + prism.upper[0]), 0.5 * (prism.lower[1] + prism.upper[1]));
  const Vec2 half(0.5 * (prism.upper[0] - prism.lower[0]), 0.5 * (prism.upper[1] - prism.lower[1]));
  const double turn = prism.across[0].cross(prism.across[1]).dot(panel.normal) > 0 ? 1 : -1;
  const auto across = [&](const Vec3& x) { return Vec2(prism.across[0].dot(x), prism.across[1].dot(x)); };
  bool covers = beyond == outline.size();
  Vec2 p = across(outline.back()), lower = p, upper = p;
  for (const Vec3& x : outline) {
    const Vec2 q = across(x);
    const Vec2 along = q - p, to = middle - p;
    const double centre = turn * (along.x() * to.y() - along.y() * to.x());
    const double reach = std::abs(along.x()) * half.y() + std::abs(along.y()) * half.x();
    if (centre + reach <= 0) return {};
    covers &= centre - reach > 0;
    p = q;
    lower = lower.cwiseMin(q);
    upper = upper.cwiseMax(q);
  }
  for (int i = 0; i < 2; ++i) {
    if (upper[i] <= prism.lower[i] || lower[i] >= prism.upper[i]) return {};
  }
  PrismOverlap result{true};
  if (covers && std::abs(facing) > kEdgeOn) {
    // The farthest point of the panel's plane in the prism: along . x = (offset - across part of normal . x) / (normal
    // . along).
    const double a = panel.normal.dot(prism.across[0]), b = panel.normal.dot(prism.across[1]);
    const double centre = (panel.normal.dot(outline.front()) - a * middle.x() - b * middle.y()) / facing;
    result.full_cover_distance = centre + (std::abs(a) * half.x() + std::abs(b) * half.y()) / std::abs(facing);
  }
  return result;
}

}  // namespace seaglint
