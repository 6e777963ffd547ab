// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scene of one antenna for beams, and bodies of boxes and plates at random places.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/tracing/beam_tracer.h"
#include "sim/scattering/tracing/transmitted_wave.h"

namespace seaglint::testing_echoes {

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
    for (int facet = 0; facet < static_cast<int>(target.facets().size()); ++facet) {
      if (!aspect.visible.pieces(facet).empty()) facets.push_back(facet);
    }
    return facets;
  }
  Vec2 projected(const Vec3& x) const { return {x.dot(basis.h), x.dot(basis.v)}; }
};

inline Vec3 random_direction(Random& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

// Boxes, some of which run through each other, and plates.
inline TriangleMesh random_boxes(Random& random, int boxes, int plates) {
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
inline double depth_inside(const MovingPolygon& polygon, const Vec2& p) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i].p, side = polygon[(i + 1) % polygon.size()].p - a, to = p - a;
    if (side.norm() > 0) depth = std::min(depth, (side.x() * to.y() - side.y() * to.x()) / side.norm());
  }
  return depth;
}

// Convex hull of points, counter-clockwise (A. M. Andrew, Inf. Process. Lett. 9, 1979, 216-219).
inline MovingPolygon convex_hull(std::vector<Vec2> points) {
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

inline double area_of(std::span<const MovingPolygon> polygons) {
  double area = 0;
  for (const MovingPolygon& polygon : polygons) area += signed_area(polygon);
  return area;
}

}  // namespace seaglint::testing_echoes
