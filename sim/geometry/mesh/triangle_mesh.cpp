// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/triangle_mesh.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

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

void TriangleMesh::clear_triangles() {
  triangles.clear();
  triangle_part.clear();
  triangle_material.clear();
  corner_normals.clear();
}

void TriangleMesh::add_like(const TriangleMesh& other, std::size_t t, const std::array<std::uint32_t, 3>& corners,
                            const std::array<Vec3, 3>& normals) {
  triangles.push_back(corners);
  if (!other.triangle_part.empty()) triangle_part.push_back(other.triangle_part[t]);
  if (!other.triangle_material.empty()) triangle_material.push_back(other.triangle_material[t]);
  if (!other.corner_normals.empty()) corner_normals.push_back(normals);
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
    std::array<std::uint32_t, 3> triangle = mesh.triangles[t];
    for (std::uint32_t& v : triangle) {
      if (index[v] == kUnused) {
        index[v] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[v]);
      }
      v = index[v];
    }
    result.add_like(mesh, t, triangle, mesh.normals_of(t));
  }
  result.triangle_part.assign(result.triangles.size(), 0);
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

constexpr std::size_t kMaxNames = 65536;  // of parts or materials: triangles store 16-bit indices

void MeshBuilder::begin_part(const std::string& name) {
  const auto [place, is_new] = part_of_name_.try_emplace(name, mesh_.part_names.size());
  if (is_new) mesh_.part_names.push_back(name);
  SEAGLINT_CHECK(place->second < kMaxNames, fmt::format("{} parts", mesh_.part_names.size()));
  part_ = static_cast<std::uint16_t>(place->second);
}

void MeshBuilder::begin_material(const std::string& name) {
  const auto [place, is_new] = material_of_name_.try_emplace(name, mesh_.materials.size());
  if (is_new) mesh_.materials.push_back(Material{name});
  SEAGLINT_CHECK(place->second < kMaxNames, fmt::format("{} materials", mesh_.materials.size()));
  material_ = static_cast<std::uint16_t>(place->second);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (mesh_.part_names.empty()) begin_part("body");
  if (mesh_.materials.empty()) begin_material(Material{}.name);
  mesh_.triangles.push_back({a, b, c});
  mesh_.triangle_part.push_back(part_);
  mesh_.triangle_material.push_back(material_);
  if (!mesh_.corner_normals.empty()) mesh_.corner_normals.resize(mesh_.triangles.size(), kNoNormals);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const std::array<Vec3, 3>& normals) {
  triangle(a, b, c);
  mesh_.corner_normals.resize(mesh_.triangles.size(), kNoNormals);
  for (int i = 0; i < 3; ++i) mesh_.corner_normals.back()[i] = unit_normal(normals[i]);
}

TriangleMesh MeshBuilder::take() { return std::exchange(*this, {}).mesh_; }

namespace {

using Index = std::uint32_t;

std::vector<Index> shuffled(std::size_t count, Random& random) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  shuffle(order, random);
  return order;
}

}  // namespace

TriangleMesh cut_in_four(const TriangleMesh& mesh, bool as_float) {
  TriangleMesh cut = mesh;
  cut.clear_triangles();
  std::map<std::pair<Index, Index>, Index> middle;
  const auto between = [&](Index a, Index b) {
    const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<Index>(cut.vertices.size()));
    if (is_new) {
      const Vec3 x = 0.5 * (mesh.vertices[a] + mesh.vertices[b]);
      cut.vertices.push_back(as_float ? Vec3(x.cast<float>().cast<double>()) : x);
    }
    return at->second;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const Index ab = between(a, b), bc = between(b, c), ca = between(c, a);
    const auto& [na, nb, nc] = mesh.normals_of(t);
    const Vec3 nab = unit_normal(na + nb), nbc = unit_normal(nb + nc), nca = unit_normal(nc + na);
    cut.add_like(mesh, t, {a, ab, ca}, {na, nab, nca});
    cut.add_like(mesh, t, {ab, b, bc}, {nab, nb, nbc});
    cut.add_like(mesh, t, {ca, bc, c}, {nca, nbc, nc});
    cut.add_like(mesh, t, {ab, bc, ca}, {nab, nbc, nca});
  }
  return cut;
}

TriangleMesh renumbered(const TriangleMesh& mesh, Random& random) {
  TriangleMesh other = mesh;
  const std::vector<Index> place = shuffled(mesh.vertices.size(), random),
                           source = shuffled(mesh.triangles.size(), random);
  for (std::size_t v = 0; v < place.size(); ++v) other.vertices[place[v]] = mesh.vertices[v];
  for (std::size_t t = 0; t < source.size(); ++t) {
    const std::size_t first = random.below(3);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t corner = (first + i) % 3;
      other.triangles[t][i] = place[mesh.triangles[source[t]][corner]];
      if (!mesh.corner_normals.empty()) other.corner_normals[t][i] = mesh.corner_normals[source[t]][corner];
    }
    if (!mesh.triangle_part.empty()) other.triangle_part[t] = mesh.triangle_part[source[t]];
    if (!mesh.triangle_material.empty()) other.triangle_material[t] = mesh.triangle_material[source[t]];
  }
  return other;
}

TriangleMesh with_noise(const TriangleMesh& mesh, double sigma, Random& random) {
  TriangleMesh noisy = mesh;
  for (Vec3& x : noisy.vertices) {
    for (int i = 0; i < 3; ++i) x[i] += sigma * random.normal();
  }
  return noisy;
}

}  // namespace seaglint
