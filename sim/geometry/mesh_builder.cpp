// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/core/error.h"

namespace seaglint {

void MeshBuilder::begin_part(const std::string& name) {
  auto& names = mesh_.part_names;
  auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) found = names.insert(names.end(), name);
  const auto index = found - names.begin();
  SEAGLINT_CHECK(index < 65536, fmt::format("{} parts", names.size()));
  part_ = static_cast<std::uint16_t>(index);
}

void MeshBuilder::begin_material(const std::string& name) {
  auto& materials = mesh_.materials;
  auto found = std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.name == name; });
  if (found == materials.end()) found = materials.insert(materials.end(), Material{name});
  const auto index = found - materials.begin();
  SEAGLINT_CHECK(index < 65536, fmt::format("{} materials", materials.size()));
  material_ = static_cast<std::uint16_t>(index);
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
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

TriangleMesh MeshBuilder::take() { return std::exchange(mesh_, {}); }

}  // namespace seaglint
