// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/gltf_output.h"

#include <tiny_gltf.h>

#include <sstream>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/geometry/files/gltf_pieces.h"

namespace seaglint {
namespace {

class Writer {
 public:
  explicit Writer(const TriangleMesh& mesh, std::span<const std::array<double, 3>> colours) {
    model_.asset.version = "2.0";
    model_.asset.generator = "seaglint";
    model_.defaultScene = 0;
    model_.scenes.emplace_back();
    model_.buffers.emplace_back();
    for (const Material& material : mesh.materials) {
      model_.materials.emplace_back();
      model_.materials.back().name = material.name;
      // Viewers must not cull the back of a sheet.
      model_.materials.back().doubleSided = true;
      model_.materials.back().pbrMetallicRoughness.baseColorFactor = {0.56, 0.60, 0.63, 1.0};
      model_.materials.back().pbrMetallicRoughness.metallicFactor = 0.2;
      model_.materials.back().pbrMetallicRoughness.roughnessFactor = 0.8;
      if (model_.materials.size() > colours.size()) continue;
      const auto& [red, green, blue] = colours[model_.materials.size() - 1];
      model_.materials.back().pbrMetallicRoughness.baseColorFactor = {red, green, blue, 1.0};
      model_.materials.back().pbrMetallicRoughness.metallicFactor = 0;
    }
    const std::vector<GltfPiece> pieces = pieces_of(mesh);
    for (std::size_t first = 0; first < pieces.size();) {
      std::size_t end = first;
      while (end < pieces.size() && pieces[end].part == pieces[first].part) ++end;
      add_part(mesh.part_names[pieces[first].part], {pieces.data() + first, end - first});
      first = end;
    }
  }

  std::string bytes(bool binary) {
    tinygltf::TinyGLTF writer;
    std::ostringstream stream;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, binary))
      throw WorkError("tinygltf could not write the mesh");
    return stream.str();
  }

 private:
  void add_part(const std::string& name, std::span<const GltfPiece> pieces) {
    tinygltf::Mesh shape;
    shape.name = name;
    for (const GltfPiece& piece : pieces) shape.primitives.push_back(primitive(piece, piece.material));
    tinygltf::Node node;
    node.name = shape.name;
    node.mesh = static_cast<int>(model_.meshes.size());
    model_.meshes.push_back(std::move(shape));
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  tinygltf::Primitive primitive(const GltfPiece& piece, int material) {
    const std::size_t vertex_count = piece.positions.size() / 3;
    std::vector<std::uint16_t> narrow;
    if (vertex_count <= 65535) narrow.assign(piece.indices.begin(), piece.indices.end());

    tinygltf::Primitive p;
    p.mode = TINYGLTF_MODE_TRIANGLES;
    p.material = material;
    const int positions = add_accessor(piece.positions.data(), piece.positions.size() * sizeof(float), vertex_count,
                                       TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    set_bounds(model_.accessors[positions], piece.positions);
    p.attributes["POSITION"] = positions;
    if (!piece.normals.empty()) {
      p.attributes["NORMAL"] =
          add_accessor(piece.normals.data(), piece.normals.size() * sizeof(float), vertex_count,
                       TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    p.indices = narrow.empty() ? add_accessor(piece.indices.data(), piece.indices.size() * 4, piece.indices.size(),
                                              TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                              TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER)
                               : add_accessor(narrow.data(), narrow.size() * 2, narrow.size(),
                                              TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR,
                                              TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return p;
  }

  // glTF 2.0, section 3.6.2.5: the bounds of positions are required.
  static void set_bounds(tinygltf::Accessor& accessor, const std::vector<float>& positions) {
    accessor.minValues.assign(positions.begin(), positions.begin() + 3);
    accessor.maxValues = accessor.minValues;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      accessor.minValues[i % 3] = std::min(accessor.minValues[i % 3], double{positions[i]});
      accessor.maxValues[i % 3] = std::max(accessor.maxValues[i % 3], double{positions[i]});
    }
  }

  int add_accessor(const void* data, std::size_t size, std::size_t count, int component, int type, int target) {
    auto& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4, 0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = size;
    view.target = target;
    const auto* bytes = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), bytes, bytes + size);

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size() - 1);
  }

  tinygltf::Model model_;
};

}  // namespace

std::string gltf_bytes(const TriangleMesh& mesh, bool binary, std::span<const std::array<double, 3>> material_colours) {
  return Writer(mesh, material_colours).bytes(binary);
}

}  // namespace seaglint
