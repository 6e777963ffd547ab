// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/placement/waterline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/geometry/mesh/triangulate_polygon.h"

namespace seaglint {
namespace {

// Distance from the plane below which a vertex counts as in it, relative to the largest height above the origin or half
// the longest side of the mesh: sixteen roundings to float32, the precision of files.
constexpr double kInSurface = 1e-6;

using Side = std::pair<std::uint32_t, std::uint32_t>;

// Sides by their first vertex: the second vertex, and a triangle with this side.
using SidesFrom = std::multimap<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>>;

// A closed polygon of vertices in the water surface. Seen from above, the outline of a body is clockwise, as lids face
// down; that of a hole in its section, as of a moonpool, counter-clockwise.
struct Loop {
  std::vector<std::uint32_t> vertices;
  std::uint32_t triangle = 0;  // one that it bounds
};

// The cut mesh with vertices at one position merged; whether each triangle stays, and whether each vertex is in the
// water surface.
struct DividedMesh {
  TriangleMesh mesh;
  std::vector<bool> stays, in_surface;
};

DividedMesh divided(const TriangleMesh& mesh, double height, double margin) {
  const WaterlineCut cut = cut_at_waterline(mesh, height);
  DividedMesh result{welded(cut.mesh), std::vector<bool>(cut.submerged.size()), {}};
  for (const Vec3& p : result.mesh.vertices) result.in_surface.push_back(std::abs(p.z() - height) <= margin);
  for (std::size_t t = 0; t < cut.submerged.size(); ++t) {
    const bool flat =
        std::ranges::all_of(result.mesh.triangles[t], [&](std::uint32_t v) { return result.in_surface[v]; });
    result.stays[t] = !cut.submerged[t] || (flat && area_vector(result.mesh, t).z() < 0);
  }
  return result;
}

// Sides between triangles that stay and triangles that do not, in the sense of the latter; they are in the surface.
SidesFrom sides_of_cut(const DividedMesh& of) {
  struct Uses {
    int staying = 0, removed = 0;  // traversals in the sense of the side, less those in the other sense
    std::uint32_t triangle = 0;    // that stays
  };
  std::map<Side, Uses> uses;  // by side from the smaller to the larger index
  for (std::uint32_t t = 0; t < of.mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = of.mesh.triangles[t][i], b = of.mesh.triangles[t][(i + 1) % 3];
      if (!of.in_surface[a] || !of.in_surface[b]) continue;
      Uses& side = uses[std::minmax(a, b)];
      (of.stays[t] ? side.staying : side.removed) += a < b ? 1 : -1;
      if (of.stays[t]) side.triangle = t;
    }
  }
  SidesFrom sides;
  for (const auto& [side, use] : uses) {
    const int missing = use.staying * use.removed < 0 ? std::min(std::abs(use.staying), std::abs(use.removed)) : 0;
    for (int i = 0; i < missing; ++i) {
      const auto [from, to] = use.removed > 0 ? side : Side{side.second, side.first};
      sides.emplace(from, std::pair{to, use.triangle});
    }
  }
  return sides;
}

Vec2 plan(const TriangleMesh& mesh, std::uint32_t v) { return mesh.vertices[v].xy(); }

// Traces closed loops along the sides, which it uses up; chains that end are dropped, as those of open surfaces do. At
// a vertex where outlines touch it takes the sharpest turn to the right, where the section is.
std::vector<Loop> loops_of(const TriangleMesh& mesh, SidesFrom sides) {
  std::vector<Loop> loops;
  while (!sides.empty()) {
    Loop loop{{sides.begin()->first}, sides.begin()->second.second};
    bool closed = false;
    while (!closed) {
      const auto [first, last] = sides.equal_range(loop.vertices.back());
      if (first == last) break;
      auto next = first;
      if (loop.vertices.size() > 1) {
        const Vec2 at = plan(mesh, loop.vertices.back()), along = at - plan(mesh, loop.vertices.end()[-2]);
        const auto turn = [&](const auto& side) {
          const Vec2 onwards = plan(mesh, side.second.first) - at;
          return std::atan2(cross(along, onwards), along.dot(onwards));
        };
        next = std::min_element(first, last, [&](const auto& a, const auto& b) { return turn(a) < turn(b); });
      }
      const std::uint32_t to = next->second.first;
      sides.erase(next);
      closed = to == loop.vertices.front();
      if (!closed) loop.vertices.push_back(to);
    }
    if (closed && loop.vertices.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

// Signed, seen from above: positive counter-clockwise, m^2.
double area_of(const TriangleMesh& mesh, const Loop& loop) {
  double twice = 0;
  const Vec2 origin = plan(mesh, loop.vertices.front());
  for (std::size_t i = 0; i < loop.vertices.size(); ++i)
    twice += cross(plan(mesh, loop.vertices[i]) - origin,
                   plan(mesh, loop.vertices[(i + 1) % loop.vertices.size()]) - origin);
  return twice / 2;
}

double length_of(const TriangleMesh& mesh, const Loop& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i)
    length += (plan(mesh, loop.vertices[i]) - plan(mesh, loop.vertices[(i + 1) % loop.vertices.size()])).norm();
  return length;
}

// Whether a point is inside of a loop: crossings of the ray towards +x.
bool contains(const TriangleMesh& mesh, const Loop& loop, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const Vec2 a = plan(mesh, loop.vertices[i]), b = plan(mesh, loop.vertices[(i + 1) % loop.vertices.size()]);
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > point.x()) inside = !inside;
  }
  return inside;
}

// Joins a hole to the outline around it by a slit between their nearest vertices.
void join(const TriangleMesh& mesh, Loop& outline, const Loop& hole) {
  std::size_t from = 0, to = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.vertices.size(); ++i) {
    for (std::size_t k = 0; k < hole.vertices.size(); ++k) {
      const double distance = (plan(mesh, outline.vertices[i]) - plan(mesh, hole.vertices[k])).squaredNorm();
      if (distance < least) std::tie(least, from, to) = std::tuple(distance, i, k);
    }
  }
  std::vector<std::uint32_t> slit;
  for (std::size_t k = 0; k <= hole.vertices.size(); ++k)
    slit.push_back(hole.vertices[(to + k) % hole.vertices.size()]);
  slit.push_back(outline.vertices[from]);
  outline.vertices.insert(outline.vertices.begin() + static_cast<std::ptrdiff_t>(from) + 1, slit.begin(), slit.end());
}

// The outlines of the sections, each with the holes directly inside it.
std::vector<Loop> joined(const TriangleMesh& mesh, const std::vector<Loop>& loops) {
  std::vector<Loop> outlines, holes;
  for (const Loop& loop : loops) (area_of(mesh, loop) < 0 ? outlines : holes).push_back(loop);
  std::vector<std::pair<double, std::size_t>> by_size;  // smallest first
  for (std::size_t i = 0; i < outlines.size(); ++i) by_size.emplace_back(-area_of(mesh, outlines[i]), i);
  std::ranges::sort(by_size);
  const std::vector<Loop> alone = outlines;
  for (const Loop& hole : holes) {
    const auto around = std::ranges::find_if(by_size, [&](const auto& outline) {
      return contains(mesh, alone[outline.second], plan(mesh, hole.vertices.front()));
    });
    if (around != by_size.end()) join(mesh, outlines[around->second], hole);
  }
  return outlines;
}

// The triangles that stay, and lids.
TriangleMesh closed_above(const DividedMesh& of, double& open_m) {
  TriangleMesh above = of.mesh;
  above.clear_triangles();
  for (std::size_t t = 0; t < of.mesh.triangles.size(); ++t) {
    if (of.stays[t]) above.add_like(of.mesh, t, of.mesh.triangles[t], of.mesh.normals_of(t));
  }
  for (const Loop& outline : joined(of.mesh, loops_of(of.mesh, sides_of_cut(of)))) {
    std::vector<Vec3> corners;
    for (const std::uint32_t v : outline.vertices) corners.push_back(of.mesh.vertices[v]);
    const auto lid = triangulate_polygon(corners);
    if (!lid) open_m += length_of(of.mesh, outline);
    for (const auto& [a, b, c] : lid.value_or(std::vector<std::array<std::uint32_t, 3>>{})) {
      above.add_like(of.mesh, outline.triangle, {outline.vertices[a], outline.vertices[b], outline.vertices[c]},
                     kNoNormals);
    }
  }
  return welded(above);
}

}  // namespace

double waterline_margin(const Bounds& box) {
  return kInSurface *
         std::max({std::abs(box.lower.z()), std::abs(box.upper.z()), 0.5 * (box.upper - box.lower).maxCoeff()});
}

WaterlineCut cut_at_waterline(const TriangleMesh& mesh, double height) {
  WaterlineCut cut;
  cut.mesh = mesh;
  cut.mesh.clear_triangles();
  const double margin = waterline_margin(bounds(mesh));
  const auto above = [&](std::uint32_t v) { return cut.mesh.vertices[v].z() > height + margin; };
  // Interpolated from the lower vertex, so that both triangles of an edge get the same point; the vertex itself where
  // it is in the plane.
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t lower = above(a) ? b : a;
    const Vec3 low = cut.mesh.vertices[lower], high = cut.mesh.vertices[above(a) ? a : b];
    if (low.z() >= height - margin) return lower;
    Vec3 point = low + (height - low.z()) / (high.z() - low.z()) * (high - low);
    point.z() = height;
    cut.mesh.vertices.push_back(point);
    return static_cast<std::uint32_t>(cut.mesh.vertices.size() - 1);
  };
  // Normal at a point of the side between two corners of triangle t, interpolated; none where either corner has none.
  const auto normal_between = [&](std::size_t t, int i, int j, const Vec3& point) -> Vec3 {
    const Vec3 &a = mesh.normals_of(t)[i], &b = mesh.normals_of(t)[j];
    if (a.isZero(0) || b.isZero(0)) return Vec3::Zero();
    const Vec3 &from = mesh.vertices[mesh.triangles[t][i]], side = mesh.vertices[mesh.triangles[t][j]] - from;
    return unit_normal(a + (point - from).dot(side) / side.squaredNorm() * (b - a));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto add = [&](const std::array<std::uint32_t, 3>& triangle, bool below, const std::array<Vec3, 3>& normals) {
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) return;
      cut.mesh.add_like(mesh, t, triangle, normals);
      cut.submerged.push_back(below);
    };
    const auto& corner = mesh.triangles[t];
    const int dry = above(corner[0]) + above(corner[1]) + above(corner[2]);
    const std::array<Vec3, 3>& n = mesh.normals_of(t);
    if (dry == 0 || dry == 3) {
      add(corner, dry == 0, n);
      continue;
    }
    // Rotate so that the single vertex on its side of the plane comes first.
    int first = 0;
    while (above(corner[first]) != (dry == 1)) ++first;
    const std::uint32_t a = corner[first], b = corner[(first + 1) % 3], c = corner[(first + 2) % 3];
    const std::uint32_t ab = crossing(a, b), ac = crossing(a, c);
    const int second = (first + 1) % 3, third = (first + 2) % 3;
    const Vec3 n_ab = normal_between(t, first, second, cut.mesh.vertices[ab]),
               n_ac = normal_between(t, first, third, cut.mesh.vertices[ac]);
    add({a, ab, ac}, dry == 2, {n[first], n_ab, n_ac});
    add({ab, b, c}, dry == 1, {n_ab, n[second], n[third]});
    add({ab, c, ac}, dry == 1, {n_ab, n[third], n_ac});
  }
  return cut;
}

std::string cut_sentence(const SubmergedPart& part) {
  if (part.depth_m <= 0) return "";
  std::string sentence = fmt::format(
      "{:.3g} m^2 of its surface, down to {:.3g} m below the water, is cut off at the waterline, z = {:.6g} m "
      "of the mesh",
      part.area_m2, part.depth_m, part.waterline_m + 0.0);
  if (part.open_m > 0)
    sentence += fmt::format("; {:.3g} m of waterline cross themselves and are left open", part.open_m);
  return sentence;
}

AboveWater above_water(const TriangleMesh& mesh, double height) {
  const Bounds box = bounds(mesh);
  const double margin = waterline_margin(box);
  if (box.lower.z() >= height - margin) return {mesh, {.waterline_m = height}};
  const DividedMesh halves = divided(mesh, height, margin);
  AboveWater result{{}, {.depth_m = height - box.lower.z(), .waterline_m = height}};
  for (std::size_t t = 0; t < halves.stays.size(); ++t) {
    if (!halves.stays[t]) result.below.area_m2 += area_vector(halves.mesh, t).norm();
  }
  result.mesh = closed_above(halves, result.below.open_m);
  return result;
}

}  // namespace seaglint
