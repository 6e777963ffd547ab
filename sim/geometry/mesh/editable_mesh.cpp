// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/editable_mesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

// Smallest height of a triangle that a change may leave, relative to its longest side.
constexpr double kMinHeight = 1e-7;
// Relative to the sum of the terms of the incircle determinant, below which four vertices count as cocircular.
constexpr double kCocircular = 1e-9;

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  return (x - a - std::clamp((x - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e).norm();
}

bool has(const std::array<std::uint32_t, 3>& triangle, std::uint32_t v) {
  return triangle[0] == v || triangle[1] == v || triangle[2] == v;
}

std::uint32_t apex_of(const std::array<std::uint32_t, 3>& triangle, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : triangle) {
    if (v != a && v != b) return v;
  }
  return a;
}

// True when the triangle runs from a to b.
bool runs(const std::array<std::uint32_t, 3>& triangle, std::uint32_t a, std::uint32_t b) {
  for (int i = 0; i < 3; ++i) {
    if (triangle[i] == a && triangle[(i + 1) % 3] == b) return true;
  }
  return false;
}

}  // namespace

EditableMesh::EditableMesh(const TriangleMesh& mesh, std::vector<std::uint32_t> face)
    : vertices_(mesh.vertices),
      triangles_(mesh.triangles),
      face_(std::move(face)),
      at_(mesh.vertices.size()),
      kept_(mesh.vertices.size(), 0) {
  std::vector<std::uint32_t> uses(vertices_.size(), 0);
  for (const Triangle& triangle : triangles_) {
    for (const std::uint32_t v : triangle) ++uses[v];
  }
  for (std::size_t v = 0; v < vertices_.size(); ++v) at_[v].reserve(uses[v]);
  face_normal_.assign(triangles_.size(), Vec3::Zero());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    Triangle& triangle = triangles_[t];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
      triangle = {0, 0, 0};
      continue;
    }
    for (const std::uint32_t v : triangle) at_[v].push_back(t);
    face_normal_[face_[t]] += area_vector(mesh, t);
  }
  for (Vec3& normal : face_normal_) normal.normalize();
}

std::vector<std::uint32_t> EditableMesh::triangles_at(std::uint32_t a, std::uint32_t b) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : at_[a]) {
    if (has(triangles_[t], b)) found.push_back(t);
  }
  return found;
}

std::vector<std::uint32_t> EditableMesh::neighbours(std::uint32_t v) const {
  std::vector<std::uint32_t> found;
  found.reserve(2 * at_[v].size());
  for (const std::uint32_t t : at_[v]) {
    for (const std::uint32_t u : triangles_[t]) {
      if (u != v) found.push_back(u);
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::optional<std::array<std::uint32_t, 2>> EditableMesh::two_triangles_at(std::uint32_t a, std::uint32_t b) const {
  std::array<std::uint32_t, 2> found{};
  std::size_t count = 0;
  for (const std::uint32_t t : at_[a]) {
    if (!has(triangles_[t], b)) continue;
    if (count == 2) return std::nullopt;
    found[count++] = t;
  }
  return count == 2 ? std::optional(found) : std::nullopt;
}

bool EditableMesh::is_boundary(std::uint32_t a, std::uint32_t b) const {
  const auto sides = two_triangles_at(a, b);
  if (!sides) return true;
  const auto [t, g] = *sides;
  return face_[t] != face_[g] || runs(triangles_[t], a, b) == runs(triangles_[g], a, b);
}

bool EditableMesh::is_corner(std::uint32_t v) const {
  std::array<std::uint32_t, 2> ends{};
  std::size_t count = 0;
  for (const std::uint32_t t : at_[v]) {
    if (std::ranges::any_of(at_[v], [&](std::uint32_t g) { return g != t && face_[g] == face_[t]; })) continue;
    for (const std::uint32_t u : triangles_[t]) {
      if (u == v || std::find(ends.begin(), ends.begin() + count, u) != ends.begin() + count) continue;
      if (count == 2) return true;
      ends[count++] = u;
    }
  }
  return false;
}

bool EditableMesh::is_before(std::uint32_t a, std::uint32_t b) const {
  const Vec3 &x = vertices_[a], &y = vertices_[b];
  return std::tuple(x.x(), x.y(), x.z()) < std::tuple(y.x(), y.y(), y.z());
}

void EditableMesh::remove_flat_vertices(double tolerance) {
  std::vector<std::uint32_t> order;
  for (bool changed = true; changed;) {
    order.clear();
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
      if (!kept_[v] && !at_[v].empty() && !is_corner(v)) order.push_back(v);
    }
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return is_before(a, b); });
    changed = false;
    for (const std::uint32_t v : order) changed |= !at_[v].empty() && remove_vertex(v, tolerance);
    if (changed) make_delaunay();
  }
}

void EditableMesh::keep_vertices(std::uint32_t triangle) {
  for (const std::uint32_t v : triangles_[triangle]) kept_[v] = 1;
}

bool EditableMesh::remove_vertex(std::uint32_t v, double tolerance) {
  std::vector<std::uint32_t> around = neighbours(v), ends;
  for (const std::uint32_t u : around) {
    if (is_boundary(v, u)) ends.push_back(u);
  }
  if (ends.empty()) {
    // Inside a face: any neighbour, in an order that does not depend on numbers.
    std::ranges::sort(around, [&](std::uint32_t a, std::uint32_t b) { return is_before(a, b); });
    return std::ranges::any_of(around, [&](std::uint32_t u) { return collapse(v, u); });
  }
  if (ends.size() != 2) return false;
  const Vec3 &x = vertices_[v], &a = vertices_[ends[0]], &b = vertices_[ends[1]];
  if ((a - x).dot(b - x) >= 0) return false;
  const Edge before = std::minmax(v, ends[0]), after = std::minmax(v, ends[1]);
  std::vector<Vec3> removed{x};
  for (const Edge& edge : {before, after}) {
    if (const auto at = removed_.find(edge); at != removed_.end())
      removed.insert(removed.end(), at->second.begin(), at->second.end());
  }
  if (!std::ranges::all_of(removed, [&](const Vec3& p) { return distance_to_segment(p, a, b) <= tolerance; }))
    return false;
  if (is_before(ends[1], ends[0])) std::swap(ends[0], ends[1]);
  if (!collapse(v, ends[0]) && !collapse(v, ends[1])) return false;
  removed_.erase(before);
  removed_.erase(after);
  removed_[std::minmax(ends[0], ends[1])] = std::move(removed);
  return true;
}

bool EditableMesh::collapse(std::uint32_t v, std::uint32_t u) {
  const std::vector<std::uint32_t> vanish = triangles_at(v, u);
  // Link condition: v and u have no common neighbours but the apexes of the triangles at their edge.
  std::vector<std::uint32_t> of_v = neighbours(v), of_u = neighbours(u), common;
  std::ranges::set_intersection(of_v, of_u, std::back_inserter(common));
  if (common.size() != vanish.size()) return false;
  for (const std::uint32_t t : at_[v]) {
    if (has(triangles_[t], u)) continue;
    std::array<Vec3, 3> corner;
    for (int i = 0; i < 3; ++i) corner[i] = vertices_[triangles_[t][i] == v ? u : triangles_[t][i]];
    const Vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const double longest = std::max({e1.squaredNorm(), e2.squaredNorm(), (corner[2] - corner[1]).squaredNorm()});
    if (!(e1.cross(e2).dot(face_normal_[face_[t]]) > kMinHeight * longest)) return false;
  }
  for (const std::uint32_t t : vanish) {
    for (const std::uint32_t w : triangles_[t]) std::erase(at_[w], t);
    triangles_[t] = {0, 0, 0};
  }
  for (const std::uint32_t t : at_[v]) {
    std::ranges::replace(triangles_[t], v, u);
    at_[u].push_back(t);
  }
  at_[v].clear();
  return true;
}

void EditableMesh::make_delaunay() {
  std::vector<std::uint32_t> triangles_of_face(triangles_.size(), 0);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) triangles_of_face[face_[t]] += is_alive(t);
  std::vector<Edge> open;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (!is_alive(t) || triangles_of_face[face_[t]] == 1) continue;
    for (int i = 0; i < 3; ++i) open.push_back(std::minmax(triangles_[t][i], triangles_[t][(i + 1) % 3]));
  }
  std::ranges::sort(open);
  open.erase(std::unique(open.begin(), open.end()), open.end());
  // Lawson's flips end; the bound is for the rounding of nearly cocircular vertices.
  for (std::size_t flips = 0, most = 100 * open.size(); !open.empty() && flips < most;) {
    const auto [a, b] = open.back();
    open.pop_back();
    flips += flip_if_needed(a, b, open);
  }
}

bool EditableMesh::flip_if_needed(std::uint32_t a, std::uint32_t b, std::vector<Edge>& around) {
  const auto both = two_triangles_at(a, b);
  if (!both || face_[both->front()] != face_[both->back()]) return false;
  std::array<std::uint32_t, 2> sides = *both;
  if (!runs(triangles_[sides[0]], a, b)) std::swap(sides[0], sides[1]);
  if (!runs(triangles_[sides[0]], a, b) || !runs(triangles_[sides[1]], b, a)) return false;
  const std::uint32_t c = apex_of(triangles_[sides[0]], a, b), d = apex_of(triangles_[sides[1]], a, b);
  if (c == d || std::ranges::any_of(at_[c], [&](std::uint32_t t) { return has(triangles_[t], d); })) return false;
  const Vec3 &A = vertices_[a], &B = vertices_[b], &C = vertices_[c], &D = vertices_[d];
  // The new triangles c, a, d and d, b, c must have the face's sense.
  const Vec3& n = face_normal_[face_[sides[0]]];
  const double longest = std::max((B - A).squaredNorm(), (D - C).squaredNorm());
  if (!((A - C).cross(D - C).dot(n) > kMinHeight * longest) || !((B - D).cross(C - D).dot(n) > kMinHeight * longest))
    return false;
  // Angles at c and d opposite the edge: their sum exceeds pi where d is inside the circle through a, b, c.
  const double sin_c = (A - C).cross(B - C).dot(n), cos_c = (A - C).dot(B - C);
  const double sin_d = (B - D).cross(A - D).dot(n), cos_d = (B - D).dot(A - D);
  const double sum = sin_c * cos_d + cos_c * sin_d;
  const double scale = std::sqrt((sin_c * sin_c + cos_c * cos_c) * (sin_d * sin_d + cos_d * cos_d));
  if (sum > kCocircular * scale) return false;
  if (sum > -kCocircular * scale) {
    const auto lower = [&](std::uint32_t x, std::uint32_t y) { return is_before(x, y) ? x : y; };
    const std::uint32_t first = lower(lower(a, b), lower(c, d));
    if (first == a || first == b) return false;
  }
  triangles_[sides[0]] = {c, a, d};
  triangles_[sides[1]] = {d, b, c};
  std::erase(at_[b], sides[0]);
  std::erase(at_[a], sides[1]);
  at_[d].push_back(sides[0]);
  at_[c].push_back(sides[1]);
  for (const Edge edge : {std::minmax(c, a), std::minmax(a, d), std::minmax(d, b), std::minmax(b, c)})
    around.push_back(edge);
  return true;
}

void EditableMesh::store(TriangleMesh& mesh, std::vector<std::uint32_t>& face) const {
  std::vector<std::uint32_t> number(triangles_.size(), kNoIndex);
  std::uint32_t faces = 0, count = 0;
  face.resize(triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (!is_alive(t)) continue;
    if (!mesh.corner_normals.empty()) {
      mesh.corner_normals[count] = triangles_[t] == mesh.triangles[t]
                                       ? mesh.corner_normals[t]
                                       : std::array{Vec3(Vec3::Zero()), Vec3(Vec3::Zero()), Vec3(Vec3::Zero())};
    }
    mesh.triangles[count] = triangles_[t];
    mesh.triangle_part[count] = mesh.triangle_part[t];
    mesh.triangle_material[count] = mesh.triangle_material[t];
    if (number[face_[t]] == kNoIndex) number[face_[t]] = faces++;
    face[count++] = number[face_[t]];
  }
  face.resize(count);
  mesh.triangles.resize(count);
  mesh.triangle_part.resize(count);
  mesh.triangle_material.resize(count);
  if (!mesh.corner_normals.empty()) mesh.corner_normals.resize(count);
}

}  // namespace seaglint
