// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/triangle_mesh.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

const std::array<Vec3, 3> kNoNormals{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

// Index of `name` in `names`, appended when new.
template <typename Item, typename NameOf>
std::uint16_t matched(std::vector<Item>& items, const Item& item, NameOf name_of) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (name_of(items[i]) == name_of(item)) return static_cast<std::uint16_t>(i);
  }
  SEAGLINT_CHECK(items.size() < std::numeric_limits<std::uint16_t>::max(), fmt::format("{} names", items.size()));
  items.push_back(item);
  return static_cast<std::uint16_t>(items.size() - 1);
}

std::size_t hash_of(const std::array<std::uint64_t, 3>& bits) {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  for (std::uint64_t word : bits) {
    hash = (hash ^ word) * 0xff51afd7ed558ccdu;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

// Adding zero turns -0 into +0, so that both are one position.
std::array<std::uint64_t, 3> position_bits(const Vec3& p) {
  return {std::bit_cast<std::uint64_t>(p.x() + 0.0), std::bit_cast<std::uint64_t>(p.y() + 0.0),
          std::bit_cast<std::uint64_t>(p.z() + 0.0)};
}

}  // namespace

void TriangleMesh::append(const TriangleMesh& other) {
  std::vector<std::uint16_t> part;
  for (const std::string& name : other.part_names) {
    part.push_back(matched(part_names, name, [](const std::string& n) -> const std::string& { return n; }));
  }
  std::vector<std::uint16_t> material;
  for (const Material& m : other.materials) {
    material.push_back(matched(materials, m, [](const Material& n) -> const std::string& { return n.name; }));
  }

  SEAGLINT_CHECK(vertices.size() + other.vertices.size() < kUnused, fmt::format("{} vertices", vertices.size()));
  if (!corner_normals.empty() || !other.corner_normals.empty()) {
    corner_normals.resize(triangles.size(), kNoNormals);
    corner_normals.insert(corner_normals.end(), other.corner_normals.begin(), other.corner_normals.end());
    corner_normals.resize(triangles.size() + other.triangles.size(), kNoNormals);
  }
  const auto base = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  for (std::size_t t = 0; t < other.triangles.size(); ++t) {
    const auto& [a, b, c] = other.triangles[t];
    triangles.push_back({base + a, base + b, base + c});
    triangle_part.push_back(part[other.triangle_part[t]]);
    triangle_material.push_back(material[other.triangle_material[t]]);
  }
}

Vec3 unit_normal(const Vec3& normal) {
  const double largest = normal.cwiseAbs().maxCoeff();
  if (!normal.allFinite() || !(largest > 0)) return Vec3::Zero();
  return (normal / largest).normalized();
}

Bounds bounds(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  Bounds box{mesh.vertices[mesh.triangles[0][0]], mesh.vertices[mesh.triangles[0][0]]};
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t v : triangle) {
      box.lower = box.lower.cwiseMin(mesh.vertices[v]);
      box.upper = box.upper.cwiseMax(mesh.vertices[v]);
    }
  }
  return box;
}

Vec3 area_vector(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3& p = mesh.vertices[a];
  return 0.5 * (mesh.vertices[b] - p).cross(mesh.vertices[c] - p);
}

double normal_deviation(const TriangleMesh& mesh, std::size_t triangle) {
  if (mesh.corner_normals.empty()) return 0;
  const Vec3 own = area_vector(mesh, triangle);
  double largest = 0;
  for (const Vec3& n : mesh.corner_normals[triangle]) {
    if (!n.isZero(0) && !own.isZero(0)) largest = std::max(largest, std::atan2(own.cross(n).norm(), own.dot(n)));
  }
  return largest;
}

double surface_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += area_vector(mesh, t).norm();
  return sum;
}

double enclosed_volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += mesh.vertices[mesh.triangles[t][0]].dot(area_vector(mesh, t)) / 3.0;
  }
  return sum;
}

TriangleMesh transformed(const TriangleMesh& mesh, const Mat3& rotation, const Vec3& translation) {
  TriangleMesh moved = mesh;
  for (Vec3& p : moved.vertices) p = rotation * p + translation;
  for (auto& normals : moved.corner_normals) {
    for (Vec3& n : normals) n = rotation * n;
  }
  return moved;
}

TriangleMesh enlarged(TriangleMesh mesh, double factor) {
  for (Vec3& vertex : mesh.vertices) vertex *= factor;
  return mesh;
}

std::vector<std::uint32_t> first_at_position(std::span<const Vec3> vertices) {
  // Hash table with linear probing, at most half full.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * vertices.size() + 1), kUnused), first(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    const std::array<std::uint64_t, 3> bits = position_bits(vertices[v]);
    std::size_t place = hash_of(bits) & (table.size() - 1);
    while (table[place] != kUnused && position_bits(vertices[table[place]]) != bits)
      place = (place + 1) & (table.size() - 1);
    if (table[place] == kUnused) table[place] = v;
    first[v] = table[place];
  }
  return first;
}

TriangleMesh welded(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  std::vector<std::uint32_t> number(mesh.vertices.size(), kUnused);
  TriangleMesh result = mesh;
  result.vertices.clear();
  for (auto& triangle : result.triangles) {
    for (std::uint32_t& v : triangle) {
      std::uint32_t& merged = number[first[v]];
      if (merged == kUnused) {
        merged = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
      }
      v = merged;
    }
  }
  return result;
}

TriangleMesh part_of(const TriangleMesh& mesh, std::size_t part) {
  TriangleMesh result;
  result.part_names = {mesh.part_names.at(part)};
  result.materials = mesh.materials;
  std::vector<std::uint32_t> index(mesh.vertices.size(), kUnused);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_part[t] != part) continue;
    std::array<std::uint32_t, 3> triangle{};
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t][i];
      if (index[v] == kUnused) {
        index[v] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
      }
      triangle[i] = index[v];
    }
    result.triangles.push_back(triangle);
    result.triangle_part.push_back(0);
    result.triangle_material.push_back(mesh.triangle_material[t]);
    if (!mesh.corner_normals.empty()) result.corner_normals.push_back(mesh.corner_normals[t]);
  }
  return result;
}

namespace {

constexpr double kOutside = 1e-12;  // of the radius: rounding of a distance
constexpr int kMaxSteps = 1000;     // the radius grows at every step; a mesh needs about ten

// Smallest sphere through one to four points: its centre lies in their affine hull and is as far from each. Empty where
// they are linearly dependent.
std::optional<Sphere> sphere_through(std::span<const Vec3> points) {
  const auto sides = static_cast<Eigen::Index>(points.size()) - 1;
  if (sides == 0) return Sphere{points[0], 0};
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> side(3, sides);
  for (Eigen::Index i = 0; i < sides; ++i) {
    const Vec3 own = points[static_cast<std::size_t>(i) + 1] - points[0];
    side.col(i) << own.x(), own.y(), own.z();
  }
  // c = points[0] + side x with 2 side^T side x = |side|^2.
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram = 2 * side.transpose() * side;
  const Eigen::FullPivLU<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>> lu(gram);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::Vector3d centre = side * lu.solve(gram.diagonal() / 2);
  const Vec3 from_first(centre.x(), centre.y(), centre.z());
  return Sphere{points[0] + from_first, from_first.norm()};
}

// Smallest sphere that contains two to five points, the last of them on it; `support` is reduced to the points that
// determine it.
Sphere sphere_about(std::vector<Vec3>& support) {
  const Vec3 last = support.back();
  Sphere best{last, -1};
  std::vector<Vec3> chosen, of_best{last};
  const unsigned others = static_cast<unsigned>(support.size()) - 1;
  for (unsigned subset = 0; subset < 1U << others; ++subset) {
    chosen = {last};
    for (unsigned i = 0; i < others; ++i) {
      if (subset >> i & 1U) chosen.push_back(support[i]);
    }
    if (chosen.size() > 4) continue;
    const std::optional<Sphere> sphere = sphere_through(chosen);
    if (!sphere || (best.radius >= 0 && sphere->radius >= best.radius)) continue;
    const auto inside = [&](const Vec3& p) { return (p - sphere->centre).norm() <= sphere->radius * (1 + kOutside); };
    if (!std::ranges::all_of(support, inside)) continue;
    best = *sphere;
    of_best = chosen;
  }
  support = of_best;
  return best;
}

}  // namespace

// Each step adds the farthest point to the support of the sphere (E. Welzl, Smallest enclosing disks, LNCS 555, 1991,
// 359-370; with the farthest point as pivot: B. Gaertner, Fast and robust smallest enclosing balls, LNCS 1643, 1999,
// 325-338).
Sphere bounding_sphere(std::span<const Vec3> points) {
  if (points.empty()) return {};
  // Positions relative to the first point keep their digits far from the origin.
  const Vec3 origin = points[0];
  std::vector<Vec3> support{Vec3::Zero()};
  Sphere sphere;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec3* farthest = points.data();
    double distance2 = -1;
    for (const Vec3& p : points) {
      const double here = (p - origin - sphere.centre).squaredNorm();
      if (here > distance2) farthest = &p, distance2 = here;
    }
    if (std::sqrt(distance2) <= sphere.radius * (1 + kOutside)) break;
    support.push_back(*farthest - origin);
    const Sphere larger = sphere_about(support);
    if (!(larger.radius > sphere.radius)) break;
    sphere = larger;
  }
  return {origin + sphere.centre, sphere.radius};
}

}  // namespace seaglint
