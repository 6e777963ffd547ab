// SPDX-License-Identifier: BSD-3-Clause
// The search of panels in the prism of a beam against a test of every panel.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/tracing/beam_scene.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Part of a polygon in space with normal . x >= offset.
std::vector<Vec3> beyond_plane(std::span<const Vec3> polygon, const Vec3& normal, double offset) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double above_a = normal.dot(a) - offset, above_b = normal.dot(b) - offset;
    if (above_a >= 0) kept.push_back(a);
    if (above_a * above_b < 0) kept.push_back(a + above_a / (above_a - above_b) * (b - a));
  }
  return kept;
}

// Passes every search on and compares it with a test of every panel.
class ComparedSearch : public PanelSearch {
 public:
  explicit ComparedSearch(const BeamScene& scene) : scene_(scene), search_(scene.context) {}

  void find(const BeamSegment& segment, const PolygonSet& cross_section,
            std::vector<FoundPanel>& found) const override {
    const std::size_t before = found.size();
    search_.find(segment, cross_section, found);
    std::vector<int> panels;
    for (std::size_t i = before; i < found.size(); ++i) panels.push_back(found[i].panel->facet);
    std::ranges::sort(panels);
    EXPECT_EQ(std::ranges::adjacent_find(panels), panels.end()) << "a panel twice";
    EXPECT_FALSE(std::ranges::binary_search(panels, segment.source_facet)) << "the panel that the segment leaves";
    ++segments_;
    found_ += panels.size();
    for (int facet = 0; facet < static_cast<int>(scene_.target.facets().size()); ++facet) {
      if (!scene_.target.panels().is_representative(facet) || facet == segment.source_facet) continue;
      const std::vector<Vec2> met = overlap_with(segment, cross_section, facet);
      if (met.empty()) continue;
      ++overlapping_;
      if (std::ranges::binary_search(panels, facet)) continue;
      ++left_out_;
      EXPECT_TRUE(
          std::ranges::any_of(panels, [&](int other) { return covers(segment, cross_section, other, facet, met); }))
          << "panel " << facet << " in the way of a segment of bounce " << segment.bounce;
    }
  }
  void find_visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
                    std::vector<MovingPolygon>& visible) const override {
    search_.find_visible(segment, candidate, receiver, visible);
  }
  bool may_be_seen(int facet) const override { return search_.may_be_seen(facet); }

  int segments() const { return segments_; }
  int overlapping() const { return overlapping_; }  // panels in the way of all segments
  int left_out() const { return left_out_; }        // of these, behind a panel that covers the cross-section
  std::size_t found() const { return found_; }

 private:
  // The panel beyond the last reflector in the projection plane.
  MovingPolygon projected(const BeamSegment& segment, int facet) const {
    const Facet& source = scene_.target.facets()[segment.source_facet];
    const double offset = segment.source_normal.dot(source.corner[0]) + kCoincident;
    std::vector<Vec2> corners;
    for (const Vec3& x : beyond_plane(scene_.target.panels().outline(facet), segment.source_normal, offset))
      corners.push_back(scene_.projected(segment.image_transform.image(x)));
    return corners.size() < 3 ? MovingPolygon{} : convex_hull(corners);
  }

  // Vertices of what the panel and the cross-section have in common; none for less than 1e-10 m^2, and where the panel
  // faces away.
  std::vector<Vec2> overlap_with(const BeamSegment& segment, const PolygonSet& cross_section, int facet) const {
    const Facet& panel = scene_.target.facets()[facet];
    if (!panel.two_sided && panel.normal.dot(segment.direction) >= 0) return {};
    const MovingPolygon polygon = projected(segment, facet);
    std::vector<Vec2> vertices;
    double area = 0;
    if (polygon.size() < 3) return {};
    for (const MovingPolygon& piece : cross_section.polygons()) {
      const MovingPolygon common = intersect(piece, polygon);
      if (common.empty()) continue;
      area += signed_area(common);
      for (const MovingVertex& vertex : common) vertices.push_back(vertex.p);
    }
    return area > 1e-10 ? vertices : std::vector<Vec2>{};
  }

  // Position along the segment at which the ray at p meets the panel's plane, m.
  double distance_to(const BeamSegment& segment, int facet, const Vec2& p) const {
    const Facet& panel = scene_.target.facets()[facet];
    const Vec3 x = segment.image_transform.real(p.x() * scene_.basis.h + p.y() * scene_.basis.v);
    return segment.direction.dot(x) + (panel.offset - panel.normal.dot(x)) / panel.normal.dot(segment.direction);
  }

  // True where `front` covers the whole cross-section and is nearer at all these points of `behind`.
  bool covers(const BeamSegment& segment, const PolygonSet& cross_section, int front, int behind,
              const std::vector<Vec2>& points) const {
    const MovingPolygon polygon = projected(segment, front);
    for (const MovingPolygon& piece : cross_section.polygons()) {
      for (const MovingVertex& vertex : piece) {
        if (polygon.size() < 3 || depth_inside(polygon, vertex.p) < 0) return false;
      }
    }
    return std::ranges::all_of(
        points, [&](const Vec2& p) { return distance_to(segment, front, p) < distance_to(segment, behind, p); });
  }

  const BeamScene& scene_;
  PrismSearch search_;
  mutable int segments_ = 0, overlapping_ = 0, left_out_ = 0;
  mutable std::size_t found_ = 0;
};

class IgnoresAll : public InteractionVisitor {
 public:
  bool needs_last_segment(const BeamSegment&) const override { return true; }
  void illuminated(const Interaction&) override {}
  void visible(const Interaction&, std::size_t, std::span<const MovingPolygon>) override {}
};

TEST(PrismSearch, FindsEveryPanelBeyondTheReflectorThatOverlapsTheCrossSectionOrOneThatCoversIt) {
  int segments = 0, overlapping = 0, left_out = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random({44, Stream::kTest, seed});
    const Scatterer body(random_boxes(random, 14, 5));
    const BeamScene scene(body, random_direction(random), 4);
    const ComparedSearch search(scene);
    IgnoresAll visitor;
    trace_beams(scene.context, search, scene.seen(), visitor);
    segments += search.segments();
    overlapping += search.overlapping();
    left_out += search.left_out();
    // Further panels cost time: the prism is a rectangle around the cross-section.
    EXPECT_LT(search.found(), 5u * static_cast<std::size_t>(search.overlapping())) << seed;
  }
  EXPECT_GT(segments, 500);
  EXPECT_GT(overlapping, 1000);
  EXPECT_GT(left_out, 10);
}

}  // namespace
}  // namespace seaglint
