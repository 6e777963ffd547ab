// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMaterials = 65000;

// Elements of an accessor: floats, quantised integers, replaced (sparse) values.
struct GltfElements {
  const unsigned char* first = nullptr;  // null: all are zero
  std::size_t stride = 0, size = 0;      // bytes from one to the next, and of one
  std::size_t count = 0;
  int component = 0;                                        // componentType of glTF 2.0, section 3.6.2.2
  bool normalised = false;                                  // integers stand for fractions of their largest value
  std::shared_ptr<const std::vector<unsigned char>> own{};  // of replaced values: the memory
};

template <typename Number>
double component_at(const unsigned char* first, int axis, bool normalised) {
  Number value{};
  std::memcpy(&value, first + static_cast<std::size_t>(axis) * sizeof value, sizeof value);
  // glTF 2.0, section 3.6.2.2: fractions of the largest value, -1 at least.
  const auto number = static_cast<double>(value);
  return normalised ? std::max(number / static_cast<double>(std::numeric_limits<Number>::max()), -1.0) : number;
}

// Element i, of three components.
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

// Restricts the files that tinygltf opens to the folder of the glTF; the user data of its callbacks.
struct GltfFolder {
  fs::path root;
  std::vector<fs::path> opened;  // in order

  // True for a name inside root, links resolved.
  bool holds(const std::string& name) const {
    std::error_code error;
    const fs::path file = fs::weakly_canonical(name, error);
    if (error) return false;
    const auto [rest, unused] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
    return rest == root.end();
  }
};

// False with a message in *problem for a file that is outside the folder or cannot be read.
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

// Axes of glTF 2.0, section 3.4: +Y up, +Z forward, so +X is to port. Column i is glTF's axis i in the body frame.
constexpr Mat3 kBodyFromGltf{Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};

// The message of the library on one line; a data URI ends behind its scheme.
std::string one_line(std::string text) {
  constexpr std::string_view kData = "data:";
  for (std::size_t at = text.find(kData); at != std::string::npos; at = text.find(kData, at + kData.size())) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    text.replace(at + kData.size(), end - at - kData.size(), "...");
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// Triangles of primitives without normals, and with normals of 8 bits.
struct GltfFlatTriangles {
  std::vector<std::size_t> without_normals, byte_normals;
};

// Gives triangles of primitives without normals flat ones (glTF 2.0, section 3.7.2.1) where others of the mesh have
// theirs, and those whose normals of 8 bits do not differ from their own by more than rounding.
void flatten_normals(TriangleMesh& mesh, const GltfFlatTriangles& triangles) {
  if (mesh.corner_normals.empty()) return;
  const auto flatten = [&](std::size_t t) { mesh.corner_normals[t].fill(unit_normal(area_vector(mesh, t))); };
  for (const std::size_t t : triangles.without_normals) flatten(t);
  constexpr double kRounding = 0.87 / 127;  // rad: half a step of three components
  for (const std::size_t t : triangles.byte_normals) {
    if (normal_deviation(mesh, t) <= kRounding) flatten(t);
  }
}

struct Loaded {
  tinygltf::Model model;
  std::vector<std::string> findings;
  std::vector<fs::path> buffer_files;  // in the order of the buffers
};

Loaded load(const std::string& bytes, const fs::path& path) {
  SanitisedGltf sanitised = sanitised_gltf(bytes, path.string());
  const std::string& plain = sanitised.bytes;
  std::error_code error;
  GltfFolder folder{fs::canonical(path, error).parent_path(), {}};
  if (error) throw InputError(fmt::format("{}: {}", path.string(), error.message()));

  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(
      {[](const std::string& name, void* user) {
         return static_cast<const GltfFolder*>(user)->holds(name) && is_there(name);
       },
       [](const std::string& name, void*) { return name; }, read_in_folder,
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }, &folder});
  tinygltf::Model model;
  std::string problem, warning;
  const auto size = static_cast<unsigned int>(plain.size());
  const std::string base = folder.root.string();
  bool good = false;
  try {
    good = is_glb(plain) ? loader.LoadBinaryFromMemory(&model, &problem, &warning,
                                                       reinterpret_cast<const unsigned char*>(plain.data()), size, base)
                         : loader.LoadASCIIFromString(&model, &problem, &warning, plain.data(), size, base);
  } catch (const std::exception& thrown) {
    problem = thrown.what();
  }
  if (!good || !problem.empty()) throw InputError(fmt::format("{}: {}", path.string(), one_line(problem)));
  return {std::move(model), std::move(sanitised.findings), std::move(folder.opened)};
}

// Affine map of a node to its parent, or to the scene.
struct Transform {
  Mat3 linear = Mat3::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 direction(const Vec3& x) const { return linear.col(0) * x.x() + linear.col(1) * x.y() + linear.col(2) * x.z(); }
  Vec3 operator*(const Vec3& x) const { return direction(x) + translation; }
  Transform operator*(const Transform& inner) const {
    return {{direction(inner.linear.col(0)), direction(inner.linear.col(1)), direction(inner.linear.col(2))},
            *this * inner.translation};
  }
};

// glTF 2.0, section 3.5.3: a matrix in column-major order, or translation * rotation * scale with the quaternion as (x,
// y, z, w).
Transform local_transform(const tinygltf::Node& node) {
  const auto at = [](const std::vector<double>& values, std::size_t first) {
    return Vec3(values[first], values[first + 1], values[first + 2]);
  };
  Transform T;
  if (node.matrix.size() == 16)
    return {{at(node.matrix, 0), at(node.matrix, 4), at(node.matrix, 8)}, at(node.matrix, 12)};
  if (node.rotation.size() == 4) {
    const Vec3 v = at(node.rotation, 0);
    const double w = node.rotation[3];
    const double length = std::sqrt((v.x() * v.x() + v.z() * v.z()) + (v.y() * v.y() + w * w));
    if (length > 0) T.linear = Quaternion{w / length, v / length}.matrix();
  }
  if (node.scale.size() == 3) {
    for (std::size_t i = 0; i < 3; ++i) T.linear.col(i) *= node.scale[i];
  }
  if (node.translation.size() == 3) T.translation = at(node.translation, 0);
  return T;
}

class Reader {
 public:
  Reader(const tinygltf::Model& model, std::string file) : model_(model), file_(std::move(file)) {
    // A mesh may be placed by many nodes. Triangles that are placed once take more than eight bytes each, with their
    // vertices.
    constexpr std::size_t kRepeated = 700'000, kMost = 50'000'000;
    std::size_t bytes = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
    max_triangles_ = std::min(kMost, kRepeated + bytes / 8);
  }

  TriangleMesh read() {
    if (model_.materials.size() > kMaxMaterials)
      throw InputError(fmt::format("{}: {} materials are more than {}", file_, model_.materials.size(), kMaxMaterials));
    struct Visit {
      int node;
      Transform parent;
    };
    std::vector<Visit> pending;
    std::vector<bool> visited(model_.nodes.size(), false);
    for (int root : roots()) pending.push_back({root, Transform{}});
    std::reverse(pending.begin(), pending.end());
    while (!pending.empty()) {
      const Visit visit = pending.back();
      pending.pop_back();
      if (visited[visit.node]) throw InputError(fmt::format("{}: nodes[{}] has two parents", file_, visit.node));
      visited[visit.node] = true;
      const tinygltf::Node& node = model_.nodes[visit.node];
      const Transform world = visit.parent * local_transform(node);
      if (node.mesh >= 0) add_mesh(node, world);
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        pending.push_back({*child, world});
    }
    TriangleMesh mesh = builder_.take();
    flatten_normals(mesh, flat_);
    return mesh;
  }

 private:
  // The default scene, else the first, else all nodes without a parent.
  std::vector<int> roots() const {
    if (!model_.scenes.empty()) return model_.scenes[std::max(0, model_.defaultScene)].nodes;
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const auto& node : model_.nodes) {
      for (int child : node.children) is_child[child] = true;
    }
    std::vector<int> found;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) found.push_back(static_cast<int>(i));
    }
    return found;
  }

  // First byte of `count` elements in a view. Ranges were checked in sanitised_gltf; tinygltf guarantees the declared
  // length of a buffer.
  const unsigned char* bytes_of(int view_index, std::size_t offset, std::size_t count, std::size_t stride,
                                std::size_t element, int accessor_index) const {
    const auto& view = model_.bufferViews[view_index];
    const auto& bytes = model_.buffers[view.buffer].data;
    const std::size_t begin = view.byteOffset + offset;
    if (stride == 0 || begin + (count - 1) * stride + element > bytes.size())
      throw InputError(fmt::format("{}: accessors[{}] reaches beyond its buffer", file_, accessor_index));
    return bytes.data() + begin;
  }

  GltfElements data_of(int accessor_index) const {
    const auto& accessor = model_.accessors[accessor_index];
    const std::size_t element = static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(accessor.componentType)) *
                                static_cast<std::size_t>(tinygltf::GetNumComponentsInType(accessor.type));
    GltfElements data{nullptr, element, element, accessor.count, accessor.componentType, accessor.normalized, nullptr};
    if (accessor.bufferView >= 0) {
      const int stride = accessor.ByteStride(model_.bufferViews[accessor.bufferView]);
      data.stride = static_cast<std::size_t>(std::max(stride, 0));
      data.first =
          bytes_of(accessor.bufferView, accessor.byteOffset, accessor.count, data.stride, element, accessor_index);
    }
    return accessor.sparse.isSparse ? with_sparse_values(data, accessor_index) : data;
  }

  GltfElements with_sparse_values(const GltfElements& elements, int accessor_index) const {
    const auto& sparse = model_.accessors[accessor_index].sparse;
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto width = static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(sparse.indices.componentType)));
    const unsigned char* indices =
        bytes_of(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count, width, width,
                 accessor_index);
    const unsigned char* values = bytes_of(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                           count, elements.size, elements.size, accessor_index);
    const auto own = std::make_shared<std::vector<unsigned char>>(elements.count * elements.size);
    for (std::size_t i = 0; i < elements.count && elements.first != nullptr; ++i)
      std::memcpy(own->data() + i * elements.size, elements.first + i * elements.stride, elements.size);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t index = 0;
      std::memcpy(&index, indices + i * width, width);
      if (index >= elements.count) {
        throw InputError(
            fmt::format("{}: accessors[{}] replaces an element beyond its {}", file_, accessor_index, elements.count));
      }
      std::memcpy(own->data() + index * elements.size, values + i * elements.size, elements.size);
    }
    GltfElements replaced = elements;
    replaced.first = own->data();
    replaced.stride = elements.size;
    replaced.own = own;
    return replaced;
  }

  std::vector<std::uint32_t> corners(const tinygltf::Primitive& primitive, std::size_t vertex_count) const {
    std::vector<std::uint32_t> list;
    if (primitive.indices < 0) {
      for (std::size_t i = 0; i < vertex_count; ++i) list.push_back(static_cast<std::uint32_t>(i));
      return list;
    }
    const GltfElements data = data_of(primitive.indices);
    list.reserve(data.count);
    for (std::size_t i = 0; i < data.count; ++i) {
      const unsigned char* at = data.first + i * data.stride;
      std::uint32_t index = 0;
      std::memcpy(&index, at, tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(data.component)));
      if (index >= vertex_count) {
        throw InputError(fmt::format("{}: accessors[{}] names vertex {}, there are {}", file_, primitive.indices, index,
                                     vertex_count));
      }
      list.push_back(index);
    }
    return list;
  }

  void add_mesh(const tinygltf::Node& node, const Transform& world) {
    const tinygltf::Mesh& mesh = model_.meshes[node.mesh];
    builder_.begin_part(!node.name.empty()   ? node.name
                        : !mesh.name.empty() ? mesh.name
                                             : fmt::format("mesh_{}", node.mesh));
    if (builder_.part_count() > kMaxParts)
      throw InputError(fmt::format("{}: its nodes make more than {} parts", file_, kMaxParts));
    const bool is_mirrored = world.linear.determinant() < 0;
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.mode >= TINYGLTF_MODE_TRIANGLES) add_primitive(primitive, world, is_mirrored);
    }
  }

  void add_primitive(const tinygltf::Primitive& primitive, const Transform& world, bool is_mirrored) {
    const std::string material = primitive.material >= 0 ? model_.materials[primitive.material].name : std::string();
    builder_.begin_material(material.empty() ? Material{}.name : material);

    const GltfElements positions = data_of(primitive.attributes.at("POSITION"));
    const auto list = corners(primitive, positions.count);
    const bool apart = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (builder_.triangle_count() + (apart ? list.size() / 3 : list.size()) > max_triangles_) fail_size();

    // Only the vertices that triangles use are placed: primitives may share one long list of positions.
    std::vector<std::uint32_t> used = list;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto base = static_cast<std::uint32_t>(builder_.vertices().size());
    for (const std::uint32_t v : used) {
      const Vec3 placed = world * vector_at(positions, v);
      builder_.vertex(kBodyFromGltf * placed);
    }
    const auto vertex = [&](std::uint32_t v) {
      return base + static_cast<std::uint32_t>(std::ranges::lower_bound(used, v) - used.begin());
    };

    // Normals in the body frame, by the inverse transpose of the node's matrix.
    std::optional<GltfElements> normals;
    if (const auto found = primitive.attributes.find("NORMAL"); found != primitive.attributes.end())
      normals = data_of(found->second);
    const bool has_byte_normals =
        normals && model_.accessors[primitive.attributes.at("NORMAL")].componentType == TINYGLTF_COMPONENT_TYPE_BYTE;
    const Mat3 turn = kBodyFromGltf * world.linear.inverse().transpose();
    const auto normal = [&](std::uint32_t v) -> Vec3 { return turn * vector_at(*normals, v); };
    const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
      if (is_mirrored) std::swap(j, k);
      const std::uint32_t a = list[i], b = list[j], c = list[k];
      if (!normals) {
        flat_.without_normals.push_back(builder_.triangle_count());
        return builder_.triangle(vertex(a), vertex(b), vertex(c));
      }
      if (has_byte_normals) flat_.byte_normals.push_back(builder_.triangle_count());
      builder_.triangle(vertex(a), vertex(b), vertex(c), {normal(a), normal(b), normal(c)});
    };
    if (apart) {
      for (std::size_t i = 0; i + 2 < list.size(); i += 3) add(i, i + 1, i + 2);
    } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (std::size_t i = 0; i + 2 < list.size(); ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
    } else {
      for (std::size_t i = 1; i + 1 < list.size(); ++i) add(i, i + 1, 0);
    }
  }

  [[noreturn]] void fail_size() const {
    throw InputError(
        fmt::format("{}: its nodes place more than {} triangles, the limit for its size", file_, max_triangles_));
  }

  const tinygltf::Model& model_;
  std::string file_;
  std::size_t max_triangles_ = 0;
  MeshBuilder builder_;
  GltfFlatTriangles flat_;
};

// The triangles of one part and one material, with float32 vertices of their own in glTF axes, one for each position
// and normal that occur together. Normals are written where any corner of the piece has one, as the format has it for
// all vertices or none: a corner without takes that of its triangle.
struct GltfPiece {
  std::uint16_t part = 0, material = 0;
  std::vector<float> positions, normals;  // normals: empty, or one per position
  std::vector<std::uint32_t> indices;
};

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

// In ascending order of part, then material.
std::vector<GltfPiece> pieces_of(const TriangleMesh& mesh) {
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t t) { return std::pair{mesh.triangle_part[t], mesh.triangle_material[t]}; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });

  std::vector<GltfPiece> pieces;
  std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> placed;  // of the current piece
  const auto append = [](std::vector<float>& list, const Vec3& x) {
    const Vec3 in_gltf = kBodyFromGltf.transpose() * x;
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
    const auto add_vectors = [&](const std::vector<float>& values) {
      return add_accessor(values, vertex_count, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
    };
    p.attributes["POSITION"] = add_vectors(piece.positions);
    set_bounds(model_.accessors.back(), piece.positions);
    if (!piece.normals.empty()) p.attributes["NORMAL"] = add_vectors(piece.normals);
    p.indices = narrow.empty()
                    ? add_accessor(piece.indices, piece.indices.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                   TINYGLTF_TYPE_SCALAR)
                    : add_accessor(narrow, narrow.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR);
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

  // Vectors of vertices, or scalars that are indices.
  template <typename T>
  int add_accessor(const std::vector<T>& values, std::size_t count, int component, int type) {
    auto& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4, 0);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = type == TINYGLTF_TYPE_SCALAR ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER : TINYGLTF_TARGET_ARRAY_BUFFER;
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    buffer.insert(buffer.end(), bytes, bytes + view.byteLength);

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

TriangleMesh read_gltf(const std::string& bytes, const fs::path& path) {
  const Loaded loaded = load(bytes, path);
  TriangleMesh mesh = Reader(loaded.model, path.string()).read();
  mesh.findings.insert(mesh.findings.end(), loaded.findings.begin(), loaded.findings.end());
  return mesh;
}

std::vector<fs::path> gltf_buffer_files(const std::string& bytes, const fs::path& path) {
  return load(bytes, path).buffer_files;
}

std::string gltf_bytes(const TriangleMesh& mesh, bool binary, std::span<const std::array<double, 3>> material_colours) {
  return Writer(mesh, material_colours).bytes(binary);
}

}  // namespace seaglint
