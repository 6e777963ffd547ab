// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/beam_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/tracing/edge_illumination.h"
#include "sim/scattering/tracing/transmitted_wave.h"
#include "sim/scattering/tracing/visible_surface.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Scene of one antenna for beams, and bodies of boxes and plates at random places.

struct BeamScene {
  const Scatterer& target;
  TracingSettings settings;
  Aspect aspect;
  RadarBasis basis;
  std::vector<Receiver> receivers;
  SmallestAreas smallest;
  TracingContext context;

  BeamScene(const Scatterer& scatterer, const Vec3& r_hat, int bounces)
      : target(scatterer),
        settings{.max_bounces = bounces},
        aspect(target, radar_basis(r_hat), settings, 1),
        basis(aspect.basis),
        receivers{{monostatic(basis), aspect.visible}},
        smallest(target, settings),
        context{target, basis, receivers, settings, aspect.visible, {}, smallest} {}
  BeamScene(const BeamScene&) = delete;
  BeamScene& operator=(const BeamScene&) = delete;

  // Panels that the antenna sees, by their first facets.
  std::vector<int> seen() const {
    std::vector<int> facets;
    for (int facet = 0; facet < static_cast<int>(target.facets().size()); ++facet)
      if (!aspect.visible.pieces(facet).empty()) facets.push_back(facet);
    return facets;
  }
  Vec2 projected(const Vec3& x) const { return {x.dot(basis.h), x.dot(basis.v)}; }
};

Vec3 random_direction(Random& random) { return Vec3(random.normal(), random.normal(), random.normal()).normalized(); }

// Boxes, some of which run through each other, and plates.
TriangleMesh random_boxes(Random& random, int boxes, int plates) {
  const auto turn = [&] { return axis_rotation(2 * kPi * random.uniform(), random_direction(random)); };
  const auto place = [&] { return Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5); };
  const auto side = [&] { return 0.2 + 0.4 * random.uniform(); };
  MeshBuilder builder;
  builder.begin_part("boxes");
  for (int i = 0; i < boxes; ++i) {
    Pose pose;
    pose.R = turn();
    pose.p = place();
    add_box(builder, pose, {side(), side(), side()});
  }
  TriangleMesh mesh = builder.take();
  for (int i = 0; i < plates; ++i) mesh.append(transformed(make_plate(side(), side()), turn(), place()));
  return mesh;
}

// Distance of a point from the nearest side of a convex polygon, m: positive inside, counted from the sides' lines.
double depth_inside(const MovingPolygon& polygon, const Vec2& p) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i].p, side = polygon[(i + 1) % polygon.size()].p - a, to = p - a;
    if (side.norm() > 0) depth = std::min(depth, (side.x() * to.y() - side.y() * to.x()) / side.norm());
  }
  return depth;
}

// Convex hull of points, counter-clockwise (A. M. Andrew, Inf. Process. Lett. 9, 1979, 216-219).
MovingPolygon convex_hull(std::vector<Vec2> points) {
  const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  std::ranges::sort(points,
                    [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  MovingPolygon hull;
  for (const bool upper : {false, true}) {
    if (upper) std::ranges::reverse(points);
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2].p, hull.back().p, p) <= 0)
        hull.resize(hull.size() - 1);
      hull.push_back({p, Vec2::Zero(), Vec2::Zero()});
    }
    hull.resize(hull.size() - 1);  // the last one is the first of the other side
  }
  return hull;
}

double area_of(std::span<const MovingPolygon> polygons) {
  double area = 0;
  for (const MovingPolygon& polygon : polygons) area += signed_area(polygon);
  return area;
}

// Beams in corners against closed forms, and in random bodies against the beams of the reversed paths.

constexpr double kPathRounding = 1e-11;  // of areas of about 1 m^2 after the clips of a path

using Path = std::vector<int>;  // panels in the order of their reflections

// Illuminated areas of all paths, in the projection plane.
class RecordedBeams : public InteractionVisitor {
 public:
  struct Beam {
    double area = 0;
    std::size_t pieces = 0;
    BeamSegment arriving;  // at the last panel
    Vec3 leaving;          // its direction after the last panel
  };

  explicit RecordedBeams(const BeamScene& scene) : scene_(scene) {
    trace_beams(scene.context, PrismSearch(scene.context), scene.seen(), *this);
  }

  bool needs_last_segment(const BeamSegment&) const override { return true; }
  void illuminated(const Interaction& interaction) override {
    const auto& [segment, candidate] = interaction;
    Path path{candidate.projection.facet};
    for (const BeamSegment* s = &segment; s->source_facet != kNoFacet; s = s->previous) path.push_back(s->source_facet);
    std::ranges::reverse(path);
    EXPECT_EQ(path.size(), static_cast<std::size_t>(segment.bounce));
    EXPECT_FALSE(beams_.contains(path)) << "a path twice";
    const Vec3 n = illuminated_normal(segment, scene_.target.facets()[candidate.projection.facet]);
    beams_[path] = {candidate.illuminated.area(), candidate.illuminated.size(), segment,
                    reflect_direction(segment.direction, n)};
    if (segment.bounce > 1) {
      EXPECT_NEAR(candidate.illuminated.area(), common_area(candidate, *segment.cross_section), kPathRounding);
    }
  }
  void visible(const Interaction&, std::size_t, std::span<const MovingPolygon>) override {}

  const std::map<Path, Beam>& beams() const { return beams_; }
  double area(const Path& path) const {
    const auto found = beams_.find(path);
    return found == beams_.end() ? 0 : found->second.area;
  }
  // Of all paths with this number of reflections.
  double area_after(std::size_t reflections) const {
    double area = 0;
    for (const auto& [path, beam] : beams_) area += path.size() == reflections ? beam.area : 0;
    return area;
  }
  // Of the part of a beam that meets a further panel.
  double area_behind(const Path& path) const {
    double area = 0;
    for (auto next = beams_.upper_bound(path); next != beams_.end() && starts_with(next->first, path); ++next)
      area += next->first.size() == path.size() + 1 ? next->second.area : 0;
    return area;
  }
  // What the smallest areas leave out: of every piece, and of every beam too small to be followed.
  double left_out() const {
    std::size_t pieces = 0;
    for (const auto& [path, beam] : beams_) pieces += beam.pieces;
    return 2 * static_cast<double>(pieces) * scene_.smallest.on(0);
  }

 private:
  static bool starts_with(const Path& path, const Path& start) {
    return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
  }
  // Area that the candidate's polygons have in common with a cross-section.
  static double common_area(const CandidatePanel& candidate, const PolygonSet& cross_section) {
    double area = 0;
    for (const MovingPolygon& part : candidate.illuminated.polygons()) {
      for (const MovingPolygon& piece : cross_section.polygons()) {
        const MovingPolygon both = intersect(part, piece);
        if (!both.empty()) area += signed_area(both);
      }
    }
    return area;
  }

  const BeamScene& scene_;
  std::map<Path, Beam> beams_;
};

// Area, in the projection plane, of the rays that meet a face of a right-angled dihedral of this width and length and
// then its other one. The rays arrive from the angle `alpha` above the first face and from the elevation `e`; a ray at
// the distance s from the seam moves by tan(e) s / cos(alpha) along the seam between the faces.
double twice_reflected_area(double width, double length, double alpha, double e) {
  const double farthest = width * std::min(1.0, 1 / std::tan(alpha)), shift = std::tan(e) / std::cos(alpha);
  return std::sin(alpha) * std::cos(e) * (length * farthest - shift * farthest * farthest / 2);
}

TEST(BeamTracer, ADihedralReflectsTheClosedFormOfItsAreaTwiceAndNothingThrice) {
  constexpr double kWidth = 0.5, kLength = 1.3;
  const Scatterer dihedral(make_dihedral(kLength, kWidth, kPi / 2));
  for (const double azimuth : {0.0, 10.0, 25.0, -37.0}) {
    for (const double elevation : {0.0, 8.0, 30.0}) {
      const BeamScene scene(dihedral, direction(azimuth, elevation), 4);
      const RecordedBeams beams(scene);
      const double alpha = kPi / 4 + radians(azimuth), e = radians(elevation);
      const double once = kWidth * kLength * (std::sin(alpha) + std::cos(alpha)) * std::cos(e);
      const double twice =
          twice_reflected_area(kWidth, kLength, alpha, e) + twice_reflected_area(kWidth, kLength, kPi / 2 - alpha, e);
      EXPECT_NEAR(beams.area_after(1), once, kPathRounding + beams.left_out()) << azimuth << ' ' << elevation;
      EXPECT_NEAR(beams.area_after(2), twice, kPathRounding + beams.left_out()) << azimuth << ' ' << elevation;
      EXPECT_LE(beams.area_after(3), kPathRounding) << azimuth << ' ' << elevation;
    }
  }
}

// The mouth of a square trihedral is the outline of the cube of which it is a corner. Three reflections return a ray
// from the point opposite to where it entered, so that those rays enter where the mouth and its inversion in the apex
// overlap.
TEST(BeamTracer, ATrihedralReturnsTheOverlapOfItsMouthWithItsInversionAntiparallel) {
  constexpr double kLeg = 0.6;
  const Scatterer trihedral(make_square_trihedral(kLeg));
  for (const auto& [azimuth, elevation] :
       {std::pair{45.0, degrees(std::asin(1 / std::sqrt(3)))}, {40.0, 30.0}, {20.0, 50.0}, {70.0, 10.0}}) {
    const BeamScene scene(trihedral, direction(azimuth, elevation), 4);
    const RecordedBeams beams(scene);
    std::vector<Vec2> corners, opposite;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = kLeg * Vec3(i & 1, i >> 1 & 1, i >> 2 & 1);
      corners.push_back(scene.projected(corner));
      opposite.push_back(-scene.projected(corner));
    }
    const MovingPolygon mouth = convex_hull(corners);
    EXPECT_NEAR(beams.area_after(1), signed_area(mouth), kPathRounding + beams.left_out());
    EXPECT_NEAR(beams.area_after(3), signed_area(intersect(mouth, convex_hull(opposite))),
                kPathRounding + beams.left_out());
    EXPECT_LE(beams.area_after(4), kPathRounding);
    int returned = 0;
    for (const auto& [path, beam] : beams.beams()) {
      if (path.size() != 3) continue;
      ++returned;
      EXPECT_LT((beam.leaving - scene.basis.r).norm(), 1e-14);
    }
    EXPECT_EQ(returned, 6);
  }
}

TEST(BeamTracer, OnItsAxisASquareTrihedralReflectsItsWholeMouthThreeTimes) {
  constexpr double kLeg = 0.6;
  const Scatterer trihedral(make_square_trihedral(kLeg));
  const BeamScene scene(trihedral, Vec3(1, 1, 1).normalized(), 4);
  const RecordedBeams beams(scene);
  for (const std::size_t reflections : {1u, 2u, 3u})
    EXPECT_NEAR(beams.area_after(reflections), std::sqrt(3) * kLeg * kLeg, kPathRounding + beams.left_out())
        << reflections;
}

// Of flat boxes and plates at random places.
TEST(BeamTracer, BeamsOnAllPanelsBehindAReflectorHaveNoMoreThanTheAreaThatItReflects) {
  int full = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random({45, Stream::kTest, seed});
    const Scatterer body(random_boxes(random, 8, 5));
    const BeamScene scene(body, random_direction(random), 5);
    const RecordedBeams beams(scene);
    for (const auto& [path, beam] : beams.beams()) {
      EXPECT_LE(beams.area_behind(path), beam.area + kPathRounding + beams.left_out()) << seed;
      full += path.size() < 5 && beam.area > 1e-4 && beams.area_behind(path) > 0.999 * beam.area;
      // A path is one straight ray in image space.
      const Vec3 unfolded = beam.arriving.image_transform.L * beam.arriving.direction;
      EXPECT_LT((unfolded + scene.basis.r).norm(), 1e-13);
    }
  }
  EXPECT_GT(full, 10);  // where the bound is reached
}

// The rays that leave the body after the panels of a path are, reversed, those that leave it after the same panels in
// the opposite order.
TEST(BeamTracer, AReversedPathLeavesTheBodyWithEqualArea) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Random random({46, Stream::kTest, seed});
    const Scatterer body(random_boxes(random, 8, 5));
    const BeamScene scene(body, random_direction(random), 5);
    const RecordedBeams beams(scene);
    const auto leaving_area = [](const RecordedBeams& of, const Path& path) {
      return of.area(path) - of.area_behind(path);
    };
    for (std::size_t reflections = 2; reflections <= 4; ++reflections) {
      int of_length = 0;
      for (const auto& [path, beam] : beams.beams()) {
        if (path.size() != reflections || leaving_area(beams, path) < 1e-4 || of_length == 12) continue;
        ++of_length;
        const BeamScene back(body, beam.leaving, 5);
        const RecordedBeams reversed(back);
        const double left_out = beams.left_out() + reversed.left_out();
        const Path opposite(path.rbegin(), path.rend());
        EXPECT_NEAR(leaving_area(reversed, opposite), leaving_area(beams, path), kPathRounding + left_out)
            << "body " << seed << ", " << reflections << " reflections";
        compared += leaving_area(beams, path) > 10 * left_out;
      }
    }
  }
  EXPECT_GT(compared, 40);
}

// The visible surface against areas in closed form, and against rays.

constexpr double kRounding = 1e-12;  // of areas of about 1 m^2 after a few clips

double visible_area(const BeamScene& scene, int facet) { return area_of(scene.aspect.visible.pieces(facet)); }

// Area of everything that the antenna sees.
double visible_area(const BeamScene& scene) {
  double area = 0;
  for (const int facet : scene.seen()) area += visible_area(scene, facet);
  return area;
}

// Panel of the part with this number, which is one panel.
int only_panel(const Scatterer& scatterer, int part) {
  const auto facet = std::ranges::find(scatterer.facets(), part, &Facet::part);
  return scatterer.panels().representative(static_cast<int>(facet - scatterer.facets().begin()));
}

double overlap_of_intervals(double centre_a, double width_a, double centre_b, double width_b) {
  return std::max(0.0, std::min(centre_a + width_a / 2, centre_b + width_b / 2) -
                           std::max(centre_a - width_a / 2, centre_b - width_b / 2));
}

TEST(VisibleSurface, OfAPlateBehindAnotherIsItsAreaLessTheirOverlap) {
  Random random({41, Stream::kTest, 0});
  int partly = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double length = 0.3 + random.uniform(), width = 0.3 + random.uniform();       // of the plate in front
    const double x = 0.1 + random.uniform(), y = random.normal(), z = random.normal();  // its place
    const Vec3 r = Vec3(1, random.uniform() - 0.5, random.uniform() - 0.5).normalized();
    TriangleMesh mesh = make_plate(1, 0.8);
    TriangleMesh front = transformed(make_plate(length, width), Mat3::Identity(), {x, 0.3 * y, 0.3 * z});
    front.part_names = {"front"};
    mesh.append(front);
    const Scatterer plates(mesh);
    const BeamScene scene(plates, r, 1);
    // The front plate along the ray on the plane of the other.
    const double hidden = overlap_of_intervals(0, 1, 0.3 * y - x * r.y() / r.x(), length) *
                          overlap_of_intervals(0, 0.8, 0.3 * z - x * r.z() / r.x(), width);
    partly += hidden > 0.05 && hidden < 0.75;
    const double left_out = 4 * scene.smallest.on(0);  // a hole leaves four pieces at most
    EXPECT_NEAR(visible_area(scene, only_panel(plates, 0)), r.x() * (0.8 - hidden), kRounding + left_out) << trial;
    EXPECT_NEAR(visible_area(scene, only_panel(plates, 1)), r.x() * length * width, kRounding) << trial;
  }
  EXPECT_GT(partly, 50);
}

TEST(VisibleSurface, OfAConvexBodyFillsTheHullOfItsProjectedVertices) {
  Random random({41, Stream::kTest, 1});
  const TriangleMesh ball = make_sphere(0.5, 2);
  for (const TriangleMesh& mesh : {random_boxes(random, 1, 0), make_cylinder(0.3, 0.8, 17), ball}) {
    const Scatterer body(mesh, {}, 0.0);
    for (int trial = 0; trial < 20; ++trial) {
      const BeamScene scene(body, random_direction(random), 1);
      std::vector<Vec2> vertices;
      for (const Vec3& x : mesh.vertices) vertices.push_back(scene.projected(x - body.centre()));
      // Panels that are nearly edge-on, and pieces of panels next to the outline, may be left out.
      const double left_out = 2 * static_cast<double>(scene.seen().size()) * scene.smallest.on(0);
      EXPECT_NEAR(visible_area(scene), signed_area(convex_hull(vertices)), kRounding + left_out) << trial;
    }
  }
}

// Every ray meets one piece, that of the panel that Embree finds first, or none.
TEST(VisibleSurface, OfRandomBodiesHasOnePieceAtEveryRayThatHits) {
  constexpr int kRays = 4000;
  constexpr double kBorder = 1e-5;  // Embree's single precision, 6e-8 of a metre, at a panel inclined by 1 / 100
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random({42, Stream::kTest, seed});
    const Scatterer body(random_boxes(random, 6, 4));
    const BeamScene scene(body, random_direction(random), 1);
    std::vector<std::pair<int, MovingPolygon>> pieces;
    for (const int facet : scene.seen())
      for (const MovingPolygon& piece : scene.aspect.visible.pieces(facet)) pieces.emplace_back(facet, piece);
    int hits = 0, at_border = 0;
    for (int n = 0; n < kRays; ++n) {
      const Vec2 p = body.radius() * Vec2(2 * random.uniform() - 1, 2 * random.uniform() - 1);
      const Ray ray{p.x() * scene.basis.h + p.y() * scene.basis.v + 2 * body.radius() * scene.basis.r, -scene.basis.r};
      int hit = kNoFacet;
      body.ray_scene().first_hits({&ray, 1}, {&hit, 1});
      std::vector<int> met;
      bool near_border = false;
      for (const auto& [facet, piece] : pieces) {
        const double depth = depth_inside(piece, p);
        near_border |= std::abs(depth) < kBorder;
        if (depth > 0) met.push_back(facet);
      }
      if (near_border) {
        ++at_border;
        continue;
      }
      hits += hit != kNoFacet;
      const std::vector<int> expected =
          hit == kNoFacet ? std::vector<int>{} : std::vector<int>{body.panels().representative(hit)};
      EXPECT_EQ(met, expected) << "body " << seed << ", ray " << n;
    }
    EXPECT_GT(hits, kRays / 10);
    EXPECT_LT(at_border, kRays / 100);
  }
}

TEST(VisibleSurface, HasPiecesWithoutCommonAreaThatLieWithinTheirPanels) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random({43, Stream::kTest, seed});
    const Scatterer body(random_boxes(random, 6, 4));
    const BeamScene scene(body, random_direction(random), 1);
    std::vector<MovingPolygon> pieces;
    for (const int facet : scene.seen()) {
      std::vector<Vec2> corners;
      for (const Vec3& x : body.panels().outline(facet)) corners.push_back(scene.projected(x));
      const MovingPolygon panel = convex_hull(corners);
      for (const MovingPolygon& piece : scene.aspect.visible.pieces(facet)) {
        for (const MovingVertex& vertex : piece) EXPECT_GT(depth_inside(panel, vertex.p), -kLineTolerance - kRounding);
        pieces.push_back(piece);
      }
    }
    double common = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const MovingPolygon both = intersect(pieces[i], pieces[j]);
        if (!both.empty()) common += signed_area(both);
      }
    }
    // Holes of less than the smallest area stay.
    const double uncut = static_cast<double>(pieces.size()) * scene.smallest.on(0);
    EXPECT_LE(common, kRounding + uncut) << seed;
    EXPECT_GT(pieces.size(), 20u);
  }
}

// The search of panels in the prism of a beam against a test of every panel.

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
      for (const MovingVertex& vertex : piece)
        if (polygon.size() < 3 || depth_inside(polygon, vertex.p) < 0) return false;
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

// Edge illuminations indexed by edge against the lists that they come from.

TEST(IlluminationByEdge, ContainsAllOfEachEdgeInTheOrderOfTheirLists) {
  constexpr int kEdges = 50;
  Random random({3, Stream::kTest, 0});
  std::vector<std::vector<EdgeIllumination>> lists(7);
  std::vector<std::vector<double>> expected(kEdges);
  std::size_t count = 0;
  for (auto& list : lists) {
    for (int i = 0; i < 20; ++i) {
      const int edge = 2 * static_cast<int>(0.5 * kEdges * random.uniform());  // every other one has none
      const Vec3 x = Vec3::Zero();
      const EdgeIllumination illumination{
          edge, {static_cast<double>(count++), 0}, {Vec2::Zero(), Vec2::Zero()}, x, x, x, x, x};
      expected[illumination.edge].push_back(illumination.s[0]);
      list.push_back(illumination);
    }
  }
  const IlluminationByEdge illuminations(std::move(lists), kEdges);
  EXPECT_EQ(illuminations.all().size(), count);
  for (int edge = 0; edge < kEdges; ++edge) {
    const auto found_at = [](const EdgeIllumination* illumination) { return illumination->s[0]; };
    EXPECT_TRUE(std::ranges::equal(illuminations.of(edge), expected[edge], {}, found_at)) << edge;
  }
  for (std::size_t n = 0; n <= count; ++n) {
    int edge = 0;
    for (std::size_t before = 0; before < n; ++edge) before += expected[edge].size();
    EXPECT_EQ(illuminations.edge_after(n), edge) << n;
  }
}

TEST(IlluminationByEdge, IsEmptyWithoutIlluminations) {
  const IlluminationByEdge illuminations({}, 3);
  EXPECT_TRUE(illuminations.all().empty());
  EXPECT_TRUE(illuminations.of(2).empty());
  EXPECT_EQ(illuminations.edge_after(0), 0);
}

}  // namespace
}  // namespace seaglint
