// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/crease_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

// Ratio of widths below which triangles are of similar width.
constexpr double kAlike = 2;

struct Corner {
  std::uint32_t triangle = 0;
  int corner = 0;
};

// Sides at one corner, and the width of the triangle: twice its area over its longest side, m.
struct Shape {
  Vec3 a, b;
  double width = 0;
};

Shape shape_at(const TriangleMesh& mesh, const Corner& at) {
  const auto position = [&](int i) -> const Vec3& { return mesh.vertices[mesh.triangles[at.triangle][i % 3]]; };
  const Vec3 &here = position(at.corner), &next = position(at.corner + 1), &last = position(at.corner + 2);
  const Vec3 a = next - here, b = last - here;
  return {a, b, a.cross(b).norm() / std::max({a.norm(), b.norm(), (last - next).norm()})};
}

double longest_side(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto length = [&](std::uint32_t p, std::uint32_t q) { return (mesh.vertices[q] - mesh.vertices[p]).norm(); };
  return std::max({length(a, b), length(b, c), length(c, a)});
}

Vec3 mean_normal(const TriangleMesh& mesh, const std::vector<Vec3>& normal, const std::vector<Corner>& fan) {
  double narrowest = std::numeric_limits<double>::infinity(), widest = 0;
  for (const Corner& at : fan) {
    narrowest = std::min(narrowest, shape_at(mesh, at).width);
    widest = std::max(widest, shape_at(mesh, at).width);
  }
  Vec3 sum = Vec3::Zero();
  for (const Corner& at : fan) {
    const Shape shape = shape_at(mesh, at);
    sum += corner_weight(shape.a, shape.b, shape.width, widest < kAlike * narrowest) * normal[at.triangle];
  }
  return unit_normal(sum);
}

}  // namespace

double corner_weight(const Vec3& a, const Vec3& b, double width, bool alike) {
  const double twice_area = a.cross(b).norm();
  return alike ? twice_area / (a.squaredNorm() * b.squaredNorm()) : std::atan2(twice_area, a.dot(b)) * width;
}

std::vector<std::array<Vec3, 3>> crease_normals(const TriangleMesh& mesh, double crease_rad, double negligible_m) {
  const TriangleMesh joined = welded(mesh);
  const Topology topology = topology_of(joined);
  const double cos_crease = std::cos(crease_rad);
  std::vector<Vec3> normal;
  for (std::uint32_t t = 0; t < joined.triangles.size(); ++t) normal.push_back(unit_normal(area_vector(joined, t)));
  for (const std::uint32_t t : topology.degenerate) normal[t] = Vec3::Zero();
  // Triangle that continues t smoothly across its side; a degenerate one, whose normal is zero, never does.
  const auto smooth_neighbour = [&](std::uint32_t t, int side) {
    const std::uint32_t other = topology.neighbours[t][side];
    if (other == kNoIndex || normal[t].isZero(0) || normal[other].isZero(0)) return kNoIndex;
    return normal[t].dot(normal[other]) < cos_crease ? kNoIndex : other;
  };

  std::vector<std::array<Vec3, 3>> found(joined.triangles.size(), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  std::vector<std::array<char, 3>> visited(joined.triangles.size(), {0, 0, 0});
  std::vector<Corner> fan;
  for (std::uint32_t t = 0; t < joined.triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      if (visited[t][c] != 0) continue;
      fan = {{t, c}};
      visited[t][c] = 1;
      const std::uint32_t vertex = joined.triangles[t][c];
      for (std::size_t i = 0; i < fan.size(); ++i) {
        const auto [triangle, corner] = fan[i];
        for (const int side : {corner, (corner + 2) % 3}) {
          const std::uint32_t next = smooth_neighbour(triangle, side);
          if (next == kNoIndex) continue;
          const auto& corners = joined.triangles[next];
          const auto there = static_cast<int>(std::ranges::find(corners, vertex) - corners.begin());
          if (there == 3 || visited[next][there] != 0) continue;
          visited[next][there] = 1;
          fan.push_back({next, there});
        }
      }
      if (fan.size() == 1) continue;
      const Vec3 mean = mean_normal(joined, normal, fan);
      const auto is_flat = [&](const Corner& at) {
        return (mean - normal[at.triangle]).norm() * longest_side(joined, at.triangle) / 8 <= negligible_m;
      };
      if (std::ranges::all_of(fan, is_flat)) continue;
      for (const auto& [triangle, corner] : fan) found[triangle][corner] = mean;
    }
  }
  return found;
}

}  // namespace seaglint
