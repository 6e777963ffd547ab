// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/waterline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seaglint {
namespace {

// Distance from the plane below which a vertex counts as in it, relative to the largest height above the origin or half
// the longest side of the mesh: sixteen roundings to float32, the precision of files.
constexpr double kInSurface = 1e-6;

}  // namespace

double waterline_margin(const Bounds& box) {
  return kInSurface *
         std::max({std::abs(box.lower.z()), std::abs(box.upper.z()), 0.5 * (box.upper - box.lower).maxCoeff()});
}

WaterlineCut cut_at_waterline(const TriangleMesh& mesh, double height) {
  WaterlineCut cut;
  cut.mesh = mesh;
  cut.mesh.triangles.clear();
  cut.mesh.triangle_part.clear();
  cut.mesh.triangle_material.clear();
  cut.mesh.corner_normals.clear();
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
    const Vec3 &a = mesh.corner_normals[t][i], &b = mesh.corner_normals[t][j];
    if (a.isZero(0) || b.isZero(0)) return Vec3::Zero();
    const Vec3 &from = mesh.vertices[mesh.triangles[t][i]], side = mesh.vertices[mesh.triangles[t][j]] - from;
    return unit_normal(a + (point - from).dot(side) / side.squaredNorm() * (b - a));
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto add = [&](const std::array<std::uint32_t, 3>& triangle, bool below, const std::array<Vec3, 3>& normals) {
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) return;
      cut.mesh.triangles.push_back(triangle);
      if (!mesh.triangle_part.empty()) cut.mesh.triangle_part.push_back(mesh.triangle_part[t]);
      if (!mesh.triangle_material.empty()) cut.mesh.triangle_material.push_back(mesh.triangle_material[t]);
      if (!mesh.corner_normals.empty()) cut.mesh.corner_normals.push_back(normals);
      cut.submerged.push_back(below);
    };
    const auto& corner = mesh.triangles[t];
    const int dry = above(corner[0]) + above(corner[1]) + above(corner[2]);
    std::array<Vec3, 3> n{};
    if (!mesh.corner_normals.empty()) n = mesh.corner_normals[t];
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
    Vec3 n_ab = Vec3::Zero(), n_ac = Vec3::Zero();
    if (!mesh.corner_normals.empty()) {
      n_ab = normal_between(t, first, second, cut.mesh.vertices[ab]);
      n_ac = normal_between(t, first, third, cut.mesh.vertices[ac]);
    }
    add({a, ab, ac}, dry == 2, {n[first], n_ab, n_ac});
    add({ab, b, c}, dry == 1, {n_ab, n[second], n[third]});
    add({ab, c, ac}, dry == 1, {n_ab, n[third], n_ac});
  }
  return cut;
}

}  // namespace seaglint
