// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxNames = 65536;  // of parts or materials: triangles store 16-bit indices

const std::array<Vec3, 3> kNoNormals{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

}  // namespace

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

std::uint32_t MeshBuilder::vertex(const Vec3& position) {
  mesh_.vertices.push_back(position);
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
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

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

TriangleMesh MeshBuilder::take() { return std::exchange(*this, {}).mesh_; }

namespace {

using Index = std::uint32_t;

std::vector<Index> shuffled(std::size_t count, Random& random) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(static_cast<Index>(i))]);
  return order;
}

// Value of a triangle, 0 where the mesh has none.
std::uint16_t value_of(const std::vector<std::uint16_t>& values, std::size_t triangle) {
  return values.empty() ? std::uint16_t{0} : values[triangle];
}

}  // namespace

TriangleMesh cut_in_four(const TriangleMesh& mesh, bool as_float) {
  TriangleMesh cut = mesh;
  cut.triangles.clear();
  cut.triangle_part.clear();
  cut.triangle_material.clear();
  cut.corner_normals.clear();
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
    for (const auto& triangle :
         {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
      cut.triangles.push_back(triangle);
      cut.triangle_part.push_back(value_of(mesh.triangle_part, t));
      cut.triangle_material.push_back(value_of(mesh.triangle_material, t));
    }
    if (mesh.corner_normals.empty()) continue;
    const auto& [na, nb, nc] = mesh.corner_normals[t];
    const Vec3 nab = unit_normal(na + nb), nbc = unit_normal(nb + nc), nca = unit_normal(nc + na);
    for (const auto& normals :
         {std::array{na, nab, nca}, std::array{nab, nb, nbc}, std::array{nca, nbc, nc}, std::array{nab, nbc, nca}})
      cut.corner_normals.push_back(normals);
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
