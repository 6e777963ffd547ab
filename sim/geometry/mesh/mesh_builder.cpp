// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/mesh_builder.h"

#include <fmt/format.h>

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

}  // namespace seaglint
