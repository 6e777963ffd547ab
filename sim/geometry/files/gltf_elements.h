// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Between tinygltf and a mesh: elements of accessors as they lie in memory, the files that tinygltf may open, and the
// primitives that a mesh becomes.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Elements of an accessor: floats, quantised integers, replaced (sparse) values.
struct GltfElements {
  const unsigned char* first = nullptr;  // null: all are zero
  std::size_t stride = 0, size = 0;      // bytes from one to the next, and of one
  std::size_t count = 0;
  int component = 0;                                        // componentType of glTF 2.0, section 3.6.2.2
  bool normalised = false;                                  // integers stand for fractions of their largest value
  std::shared_ptr<const std::vector<unsigned char>> own{};  // of replaced values: the memory
};

// Element i, of three components.
Vec3 vector_at(const GltfElements& elements, std::size_t i);

// The elements with `count` of them replaced by `values`, at indices of `width` bytes each; nullopt where one is beyond
// the elements.
std::optional<GltfElements> with_replaced(const GltfElements& elements, std::size_t count, const unsigned char* indices,
                                          std::size_t width, const unsigned char* values);

// Restricts the files that tinygltf opens to the folder of the glTF; its callbacks below get a GltfFolder as user data.
struct GltfFolder {
  std::filesystem::path root;
  std::vector<std::filesystem::path> opened;  // in order

  // True for a name inside root, links resolved.
  bool holds(const std::string& name) const;
};

bool exists_in_folder(const std::string& name, void* folder);
std::string same_path(const std::string& name, void* folder);
// False with a message in *problem for a file that is outside the folder or cannot be read.
bool read_in_folder(std::vector<unsigned char>* content, std::string* problem, const std::string& name, void* folder);
bool write_nothing(std::string* problem, const std::string& name, const std::vector<unsigned char>& content,
                   void* folder);

// Axes of glTF 2.0, section 3.4: +Y up, +Z forward, so +X is to port. Column i is glTF's axis i in the body frame.
inline const Mat3& body_from_gltf() {
  static constexpr Mat3 R{Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  return R;
}

// The triangles of one part and one material, with float32 vertices of their own in glTF axes, one for each position
// and normal that occur together. Normals are written where any corner of the piece has one, as the format has it for
// all vertices or none: a corner without takes that of its triangle.
struct GltfPiece {
  std::uint16_t part = 0, material = 0;
  std::vector<float> positions, normals;  // normals: empty, or one per position
  std::vector<std::uint32_t> indices;
};

// In ascending order of part, then material.
std::vector<GltfPiece> pieces_of(const TriangleMesh& mesh);

}  // namespace seaglint
