// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/gltf_elements.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <system_error>
#include <tuple>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"

namespace seaglint {

namespace {

template <typename Number>
double component_at(const unsigned char* first, int axis, bool normalised) {
  Number value{};
  std::memcpy(&value, first + static_cast<std::size_t>(axis) * sizeof value, sizeof value);
  // glTF 2.0, section 3.6.2.2: fractions of the largest value, -1 at least.
  const auto number = static_cast<double>(value);
  return normalised ? std::max(number / static_cast<double>(std::numeric_limits<Number>::max()), -1.0) : number;
}

}  // namespace

Vec3 vector_at(const GltfElements& elements, std::size_t i) {
  if (elements.first == nullptr) return Vec3::Zero();
  const unsigned char* first = elements.first + i * elements.stride;
  Vec3 x;
  for (int axis = 0; axis < 3; ++axis) {
    switch (elements.component) {
      case 5120: x[axis] = component_at<std::int8_t>(first, axis, elements.normalised); break;
      case 5121: x[axis] = component_at<std::uint8_t>(first, axis, elements.normalised); break;
      case 5122: x[axis] = component_at<std::int16_t>(first, axis, elements.normalised); break;
      case 5123: x[axis] = component_at<std::uint16_t>(first, axis, elements.normalised); break;
      default: x[axis] = component_at<float>(first, axis, false);
    }
  }
  return x;
}

std::optional<GltfElements> with_replaced(const GltfElements& elements, std::size_t count, const unsigned char* indices,
                                          std::size_t width, const unsigned char* values) {
  const auto own = std::make_shared<std::vector<unsigned char>>(elements.count * elements.size);
  for (std::size_t i = 0; i < elements.count && elements.first != nullptr; ++i)
    std::memcpy(own->data() + i * elements.size, elements.first + i * elements.stride, elements.size);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t index = 0;
    std::memcpy(&index, indices + i * width, width);
    if (index >= elements.count) return std::nullopt;
    std::memcpy(own->data() + index * elements.size, values + i * elements.size, elements.size);
  }
  GltfElements replaced = elements;
  replaced.first = own->data();
  replaced.stride = elements.size;
  replaced.own = own;
  return replaced;
}

namespace fs = std::filesystem;

bool GltfFolder::holds(const std::string& name) const {
  std::error_code error;
  const fs::path file = fs::weakly_canonical(name, error);
  if (error) return false;
  const auto [rest, unused] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return rest == root.end();
}

bool exists_in_folder(const std::string& name, void* folder) {
  return static_cast<const GltfFolder*>(folder)->holds(name) && is_there(name);
}

std::string same_path(const std::string& name, void*) { return name; }

bool read_in_folder(std::vector<unsigned char>* content, std::string* problem, const std::string& name, void* user) {
  GltfFolder& folder = *static_cast<GltfFolder*>(user);
  if (!folder.holds(name)) {
    *problem += name + " is outside the file's folder";
    return false;
  }
  try {
    const std::string bytes = read_file(name);
    content->assign(bytes.begin(), bytes.end());
    folder.opened.emplace_back(name);
    return true;
  } catch (const InputError& error) {
    *problem += error.what();
    return false;
  }
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

namespace {

bool has_normal(const TriangleMesh& mesh, std::size_t t) {
  return !mesh.corner_normals.empty() &&
         std::ranges::any_of(mesh.corner_normals[t], [](const Vec3& n) { return !n.isZero(0); });
}

// The corner's normal, or that of its triangle; of a degenerate triangle some unit vector, which the format requires.
Vec3 normal_of(const TriangleMesh& mesh, std::size_t t, int corner) {
  if (!mesh.corner_normals[t][corner].isZero(0)) return mesh.corner_normals[t][corner];
  const Vec3 own = unit_normal(area_vector(mesh, t));
  return own.isZero(0) ? Vec3(Vec3::UnitZ()) : own;
}

}  // namespace

std::vector<GltfPiece> pieces_of(const TriangleMesh& mesh) {
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t t) { return std::pair{mesh.triangle_part[t], mesh.triangle_material[t]}; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });

  std::vector<GltfPiece> pieces;
  std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> placed;  // of the current piece
  const auto append = [](std::vector<float>& list, const Vec3& x) {
    const Vec3 in_gltf = body_from_gltf().transpose() * x;
    for (int i = 0; i < 3; ++i) list.push_back(static_cast<float>(in_gltf[i]) + 0.0f);
  };
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    bool has_normals = false;
    for (; end < order.size() && key(order[end]) == key(order[first]); ++end)
      has_normals = has_normals || has_normal(mesh, order[end]);
    const auto [part, material] = key(order[first]);
    GltfPiece& piece = pieces.emplace_back(GltfPiece{part, material, {}, {}, {}});
    placed.clear();
    for (; first < end; ++first) {
      const std::size_t t = order[first];
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t v = mesh.triangles[t][i];
        const Vec3 normal = has_normals ? normal_of(mesh, t, i) : Vec3::Zero();
        const auto [place, is_new] = placed.try_emplace(
            {v, static_cast<float>(normal.x()), static_cast<float>(normal.y()), static_cast<float>(normal.z())},
            static_cast<std::uint32_t>(piece.positions.size() / 3));
        if (is_new) append(piece.positions, mesh.vertices[v]);
        if (is_new && has_normals) append(piece.normals, normal);
        piece.indices.push_back(place->second);
      }
    }
  }
  return pieces;
}

}  // namespace seaglint
