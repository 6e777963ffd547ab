// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/surface/facets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sim/geometry/mesh/topology.h"

namespace seaglint {

std::vector<Facet> make_facets(const TriangleMesh& mesh, std::span<const std::uint32_t> face) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  std::vector<Facet> facets;
  std::vector<std::array<std::uint32_t, 3>> indices;
  facets.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    Facet facet;
    for (int i = 0; i < 3; ++i) facet.corner[i] = mesh.vertices[triangle[i]];
    const Vec3 across = (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]);
    const double longest =
        std::max({(facet.corner[1] - facet.corner[0]).norm(), (facet.corner[2] - facet.corner[1]).norm(),
                  (facet.corner[0] - facet.corner[2]).norm()});
    // Degenerate triangle: height below 1e-9 m.
    if (!(across.norm() > 1e-9 * longest)) continue;
    facet.normal = across.normalized();
    facet.offset = facet.normal.dot(facet.corner[0]);
    facet.longest_edge = longest;
    facet.part = mesh.triangle_part.empty() ? std::uint16_t{0} : mesh.triangle_part[t];
    facet.material = mesh.triangle_material.empty() ? std::uint16_t{0} : mesh.triangle_material[t];
    if (!mesh.corner_normals.empty()) facet.corner_normal = mesh.corner_normals[t];
    if (!face.empty()) facet.face = static_cast<std::int32_t>(face[t]);
    facets.push_back(facet);
    indices.push_back({first[triangle[0]], first[triangle[1]], first[triangle[2]]});
  }

  // Sides of one edge are linked in a ring.
  const std::vector<EdgeUse> sides = sides_by_edge(indices, mesh.vertices.size());
  DisjointSets surfaces(facets.size());
  std::vector<std::uint32_t> at_boundary;  // facets at free edges or edges where the orientation reverses
  for (std::size_t i = 0; i < sides.size();) {
    const HalfEdge& first_side = sides[i].side;
    std::size_t end = i;
    int forward = 0;
    for (; end < sides.size() && sides[end].vertices == sides[i].vertices; ++end) {
      forward += sides[end].side.forward ? 1 : -1;
      if (end > i) surfaces.unite(first_side.triangle, sides[end].side.triangle);
    }
    for (std::size_t j = i; end - i > 1 && j < end; ++j) {
      const auto& [facet, edge, is_forward] = sides[j].side;
      facets[facet].neighbour[edge] = static_cast<std::int32_t>(sides[j + 1 < end ? j + 1 : i].side.triangle);
    }
    if (forward != 0) at_boundary.push_back(first_side.triangle);
    i = end;
  }
  std::vector<char> open(facets.size(), 0);
  for (const std::uint32_t f : at_boundary) open[surfaces.find(f)] = 1;
  for (std::uint32_t f = 0; f < facets.size(); ++f) facets[f].two_sided = open[surfaces.find(f)] != 0;
  return facets;
}

int corner_at(const Facet& facet, const Vec3& position) {
  const auto found = std::ranges::find(facet.corner, position);
  return found == facet.corner.end() ? -1 : static_cast<int>(found - facet.corner.begin());
}

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

void fill_normals(TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.corner_normals.size(); ++t) {
    const Vec3 own = unit_normal(area_vector(mesh, t));
    for (Vec3& normal : mesh.corner_normals[t]) {
      if (normal.isZero(0)) normal = own;
    }
  }
}

}  // namespace seaglint
