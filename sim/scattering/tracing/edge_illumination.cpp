// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/edge_illumination.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

namespace {

struct IlluminatedInterval {
  std::array<double, 2> s;
  std::array<Vec2, 2> slip;
};

// Joins overlapping and adjoining intervals.
void merge_intervals(std::vector<IlluminatedInterval>& intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const IlluminatedInterval& a, const IlluminatedInterval& b) { return a.s[0] < b.s[0]; });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < intervals.size(); ++i) {
    IlluminatedInterval& last = intervals[kept];
    if (intervals[i].s[0] <= last.s[1] + kCoincident) {
      if (intervals[i].s[1] > last.s[1]) {
        last.s[1] = intervals[i].s[1];
        last.slip[1] = intervals[i].slip[1];
      }
    } else {
      intervals[++kept] = intervals[i];
    }
  }
  if (!intervals.empty()) intervals.resize(kept + 1);
}

// Intervals in which sides of the candidate's illuminated polygons coincide with an edge, given by its image's start
// and direction. a: basis of the projection plane.
std::vector<IlluminatedInterval> illuminated_intervals(const Vec3& image, const Vec3& along, double length,
                                                       const CandidatePanel& candidate, const RadarBasis& a) {
  const Vec2 start(image.dot(a.h), image.dot(a.v)), run(along.dot(a.h), along.dot(a.v));
  const double shortened = run.norm();  // projected length of a metre of edge
  std::vector<IlluminatedInterval> intervals;
  if (shortened < 1e-6) return intervals;  // parallel to the line of sight
  const Vec2 across(-run.y() / shortened, run.x() / shortened);
  const auto place = [&](const MovingVertex& vertex) { return run.dot(vertex.p - start) / (shortened * shortened); };
  // Slide of a vertex along the edge: its motion beyond that of a body-fixed point, -z d_i.
  const auto slip = [&](const MovingVertex& corner) -> Vec2 {
    const double z = candidate.projection.plane.at(corner.p);
    return Vec2(run.dot(corner.d1 + Vec2(z, 0)), run.dot(corner.d2 + Vec2(0, z))) / (shortened * shortened);
  };
  const auto on_edge = [&](const MovingVertex& corner) {
    return std::abs(across.dot(corner.p - start)) <= kCoincident;
  };
  for (const MovingPolygon& piece : candidate.illuminated.polygons()) {
    bool here = on_edge(piece.back());
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const MovingVertex &p = i == 0 ? piece.back() : piece[i - 1], &q = piece[i];
      const bool before = here;
      here = on_edge(q);
      if (!before || !here) continue;
      IlluminatedInterval interval{{place(p), place(q)}, {slip(p), slip(q)}};
      if (interval.s[0] > interval.s[1]) {
        std::swap(interval.s[0], interval.s[1]);
        std::swap(interval.slip[0], interval.slip[1]);
      }
      // A polygon side may continue along the next collinear edge; the interval then ends at the fixed end of this
      // edge.
      if (interval.s[0] < 0) {
        interval.s[0] = 0;
        interval.slip[0] = Vec2::Zero();
      }
      if (interval.s[1] > length) {
        interval.s[1] = length;
        interval.slip[1] = Vec2::Zero();
      }
      if (interval.s[1] - interval.s[0] > kCoincident) intervals.push_back(interval);
    }
  }
  merge_intervals(intervals);
  return intervals;
}

}  // namespace

bool records_edges(const TracingContext& scene, const BeamSegment& segment) {
  return scene.settings.edges && segment.bounce <= kMaxEdgeReflections + 1;
}

void record_edges(const TracingContext& scene, const Interaction& interaction,
                  std::vector<EdgeIllumination>& illuminations) {
  const auto& [segment, candidate] = interaction;
  if (!segment.fields.empty() || candidate.illuminated.empty()) return;
  const bool on_conductor = scene.surface_of(candidate.projection.facet).empty();
  const SharpEdges& edges = scene.scatterer.edges();
  for (const PanelEdge& side : edges.edges_of_panel(candidate.projection.facet)) {
    if (!side.may_record_edge(segment.direction)) continue;
    const SharpEdge& edge = edges.edges[side.edge];
    const WedgeFrame* wedge = illuminated_wedge(edge, segment.direction);
    if (!wedge || !records_edge(edge, *wedge, side.is_first_face, segment.direction)) continue;
    if (wedge->N < 1 && segment.bounce > 1) continue;  // PO of a concave edge includes its reflections
    if (edge.conducts ? !on_conductor : segment.bounce > 1) continue;
    const Vec3 image = segment.image_transform.image(edge.a), along = segment.image_transform.L * edge.along();
    for (const IlluminatedInterval& interval :
         illuminated_intervals(image, along, edge.length(), candidate, scene.transmit)) {
      illuminations.push_back({side.edge, interval.s, interval.slip, image, along, segment.direction, segment.E_h,
                               segment.E_v, static_cast<std::uint8_t>(segment.bounce - 1),
                               segment.first_reflector_normal});
    }
  }
}

IlluminationByEdge::IlluminationByEdge(std::vector<std::vector<EdgeIllumination>> lists, std::size_t edge_count)
    : lists_(std::move(lists)), first_(edge_count + 1, 0) {
  for (const auto& list : lists_) {
    for (const EdgeIllumination& illumination : list) ++first_[static_cast<std::size_t>(illumination.edge) + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  sorted_.resize(first_.back());
  for (const auto& list : lists_) {
    for (const EdgeIllumination& arrival : list) sorted_[next[arrival.edge]++] = &arrival;
  }
}

int IlluminationByEdge::edge_after(std::size_t arrivals) const {
  return static_cast<int>(std::lower_bound(first_.begin(), first_.end(), arrivals) - first_.begin());
}

}  // namespace seaglint
