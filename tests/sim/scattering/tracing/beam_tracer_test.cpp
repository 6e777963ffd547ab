// SPDX-License-Identifier: BSD-3-Clause
// Beams in corners against closed forms, and in random bodies against the beams of the reversed paths.
#include "sim/scattering/tracing/beam_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/tracing/beam_scene.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kRounding = 1e-11;  // of areas of about 1 m^2 after the clips of a path

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
      EXPECT_NEAR(candidate.illuminated.area(), common_area(candidate, *segment.cross_section), kRounding);
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
  const double farthest = width * std::min(1.0, 1 / std::tan(alpha));
  const double shift = std::tan(e) / std::cos(alpha);
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
      EXPECT_NEAR(beams.area_after(1), once, kRounding + beams.left_out()) << azimuth << ' ' << elevation;
      EXPECT_NEAR(beams.area_after(2), twice, kRounding + beams.left_out()) << azimuth << ' ' << elevation;
      EXPECT_LE(beams.area_after(3), kRounding) << azimuth << ' ' << elevation;
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
    EXPECT_NEAR(beams.area_after(1), signed_area(mouth), kRounding + beams.left_out());
    EXPECT_NEAR(beams.area_after(3), signed_area(intersect(mouth, convex_hull(opposite))),
                kRounding + beams.left_out());
    EXPECT_LE(beams.area_after(4), kRounding);
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
    EXPECT_NEAR(beams.area_after(reflections), std::sqrt(3) * kLeg * kLeg, kRounding + beams.left_out()) << reflections;
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
      EXPECT_LE(beams.area_behind(path), beam.area + kRounding + beams.left_out()) << seed;
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
        EXPECT_NEAR(leaving_area(reversed, opposite), leaving_area(beams, path), kRounding + left_out)
            << "body " << seed << ", " << reflections << " reflections";
        compared += leaving_area(beams, path) > 10 * left_out;
      }
    }
  }
  EXPECT_GT(compared, 40);
}

}  // namespace
}  // namespace seaglint
