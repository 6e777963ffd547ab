// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/coordinate.h"
#include "sim/geometry/files/split_vertices.h"
#include "sim/geometry/files/triangulate_polygon.h"
#include "sim/geometry/mesh/mesh_builder.h"

namespace seaglint {
namespace {

enum class Number { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Number value = Number::kFloat;
  bool is_list = false;
  Number count = Number::kUint8;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

std::size_t size_of(Number type) {
  switch (type) {
    case Number::kInt8:
    case Number::kUint8: return 1;
    case Number::kInt16:
    case Number::kUint16: return 2;
    case Number::kInt32:
    case Number::kUint32:
    case Number::kFloat: return 4;
    case Number::kDouble: return 8;
  }
  return 0;
}

template <typename T>
double value_at(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> raw{};
  for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = bytes[swap ? raw.size() - 1 - i : i];
  return static_cast<double>(std::bit_cast<T>(raw));
}

double value_at(Number type, const char* bytes, bool swap) {
  switch (type) {
    case Number::kInt8: return value_at<std::int8_t>(bytes, swap);
    case Number::kUint8: return value_at<std::uint8_t>(bytes, swap);
    case Number::kInt16: return value_at<std::int16_t>(bytes, swap);
    case Number::kUint16: return value_at<std::uint16_t>(bytes, swap);
    case Number::kInt32: return value_at<std::int32_t>(bytes, swap);
    case Number::kUint32: return value_at<std::uint32_t>(bytes, swap);
    case Number::kFloat: return value_at<float>(bytes, swap);
    case Number::kDouble: return value_at<double>(bytes, swap);
  }
  return 0;
}

// Parses a PLY. OpenMesh's own reader does not terminate at a missing end_header, does not check counts, and of binary
// files reads only float coordinates and uchar list counts.
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}

  TriangleMesh read() {
    header();
    for (const Element& element : elements_) {
      min_size(element);
      if (element.name == "vertex") {
        vertices(element);
      } else if (element.name == "face") {
        faces(element);
      } else {
        for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
          for (const Property& property : element.properties) skip(property);
        }
      }
    }
    for (std::uint32_t index : corners_) {
      if (index >= vertex_count_) fail(fmt::format("a face names vertex {}, there are {}", index, vertex_count_));
    }
    std::size_t first = 0;
    for (std::size_t face = 0; face < corner_count_.size(); first += corner_count_[face++])
      split(face, {corners_.data() + first, corner_count_[face]});
    return builder_.take();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", file_, what)); }

  Number type_of(std::string_view name) const {
    constexpr std::array<std::pair<std::string_view, Number>, 16> kNames{{{"char", Number::kInt8},
                                                                          {"int8", Number::kInt8},
                                                                          {"uchar", Number::kUint8},
                                                                          {"uint8", Number::kUint8},
                                                                          {"short", Number::kInt16},
                                                                          {"int16", Number::kInt16},
                                                                          {"ushort", Number::kUint16},
                                                                          {"uint16", Number::kUint16},
                                                                          {"int", Number::kInt32},
                                                                          {"int32", Number::kInt32},
                                                                          {"uint", Number::kUint32},
                                                                          {"uint32", Number::kUint32},
                                                                          {"float", Number::kFloat},
                                                                          {"float32", Number::kFloat},
                                                                          {"double", Number::kDouble},
                                                                          {"float64", Number::kDouble}}};
    for (const auto& [known, type] : kNames) {
      if (name == known) return type;
    }
    fail(fmt::format("the PLY header has the unknown type \"{}\"", name.substr(0, 40)));
  }

  void header() {
    if (next_line(rest_) != "ply") fail("is not a PLY file");
    bool has_format = false;
    while (true) {
      if (rest_.empty()) fail("the PLY header has no end_header");
      std::string_view line = next_line(rest_);
      const std::string_view keyword = next_word(line);
      if (keyword == "end_header") break;
      if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
      if (keyword == "format") {
        const std::string_view format = next_word(line);
        has_format = true;
        is_ascii_ = format == "ascii";
        swap_ = format == "binary_big_endian";
        if (!is_ascii_ && !swap_ && format != "binary_little_endian")
          fail(fmt::format("the PLY format \"{}\" is unknown", format));
      } else if (keyword == "element") {
        const std::string_view name = next_word(line), count = next_word(line);
        const auto number = parse_integer(count);
        if (!number || *number < 0) fail(fmt::format("the PLY header promises \"{}\" of \"{}\"", count, name));
        for (const Element& element : elements_) {
          if (element.name == name) fail(fmt::format("the PLY header has \"{}\" twice", name));
        }
        elements_.push_back({std::string(name), static_cast<std::uint64_t>(*number), {}});
      } else if (keyword == "property") {
        if (elements_.empty()) fail("the PLY header has a property before any element");
        Property property;
        std::string_view word = next_word(line);
        property.is_list = word == "list";
        if (property.is_list) {
          property.count = type_of(next_word(line));
          word = next_word(line);
        }
        property.value = type_of(word);
        property.name = next_word(line);
        elements_.back().properties.push_back(property);
      } else {
        fail(fmt::format("the PLY header has the unknown line \"{}\"", keyword.substr(0, 40)));
      }
    }
    if (!has_format) fail("the PLY header has no format");
  }

  // Checks the declared count against the file size before memory is reserved.
  void min_size(const Element& element) const {
    std::uint64_t min_bytes = 0;
    for (const Property& property : element.properties) {
      min_bytes += is_ascii_ ? 2 : size_of(property.is_list ? property.count : property.value);
    }
    const std::uint64_t available = min_bytes == 0 ? 0 : (rest_.size() + 1) / min_bytes;
    if (element.count > available && !element.properties.empty()) {
      fail(fmt::format("promises {} of \"{}\", has room for {} at most", element.count, element.name, available));
    }
  }

  double number(Number type) {
    if (is_ascii_) {
      const std::string_view word = next_word(rest_);
      const auto number = parse_any_number(word);
      if (!number)
        fail(word.empty() ? std::string("ends before its last number")
                          : fmt::format("\"{}\" is not a number", word.substr(0, 40)));
      return *number;
    }
    if (rest_.size() < size_of(type)) fail("ends before its last number");
    const double value = value_at(type, rest_.data(), swap_);
    rest_.remove_prefix(size_of(type));
    return value;
  }

  std::uint64_t read_count(const Property& property) {
    const double count = number(property.count);
    if (!(count >= 0 && count <= static_cast<double>(rest_.size()) &&
          count == static_cast<double>(static_cast<std::uint64_t>(count)))) {
      fail(fmt::format("a list of {} entries with {} bytes left", count, rest_.size()));
    }
    return static_cast<std::uint64_t>(count);
  }

  void skip(const Property& property) {
    const std::uint64_t count = property.is_list ? read_count(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) number(property.value);
  }

  void vertices(const Element& element) {
    for (const char* axis : {"x", "y", "z"}) {
      const auto count =
          std::count_if(element.properties.begin(), element.properties.end(),
                        [&](const Property& property) { return !property.is_list && property.name == axis; });
      if (count != 1)
        fail(fmt::format("its vertices have {} properties {}: must have x, y and z once each", count, axis));
    }
    vertex_count_ = element.count;
    if (vertex_count_ > 0x7fffffff) fail(fmt::format("{} vertices are too many", vertex_count_));
    const bool has_normals = std::ranges::any_of(
        element.properties, [](const Property& property) { return !property.is_list && property.name == "nx"; });
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Vec3 p = Vec3::Zero(), n = Vec3::Zero();
      for (const Property& property : element.properties) {
        const int axis = property.is_list || property.name.size() != 1 ? -1 : property.name[0] - 'x';
        if (axis < 0 || axis > 2) {
          const bool is_normal = !property.is_list && property.name.size() == 2 && property.name[0] == 'n' &&
                                 property.name[1] >= 'x' && property.name[1] <= 'z';
          if (is_normal) {
            n[property.name[1] - 'x'] = number(property.value);
          } else {
            skip(property);
          }
          continue;
        }
        const double value = number(property.value);
        const auto coordinate = coordinate_of(value);
        if (!coordinate) fail(fmt::format("vertex {} has the coordinate {}", i, value));
        p[axis] = *coordinate;
      }
      builder_.vertex(p);
      if (has_normals) normals_.push_back(n);
    }
  }

  static bool has_corners(const Property& property) {
    return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  void faces(const Element& element) {
    // Checked before the loop: the count of faces without properties is not bounded by the file size.
    if (element.count > 0 && std::none_of(element.properties.begin(), element.properties.end(), has_corners))
      fail("its faces have no vertex_indices");
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        if (!has_corners(property)) {
          skip(property);
          continue;
        }
        const std::uint64_t count = read_count(property);
        for (std::uint64_t k = 0; k < count; ++k) {
          const double index = number(property.value);
          if (!(index >= 0 && index < 2147483648.0)) fail(fmt::format("face {} names vertex {}", i, index));
          corners_.push_back(static_cast<std::uint32_t>(index));
        }
        if (count < 3) fail(fmt::format("face {} has {} corners", i, count));
        corner_count_.push_back(static_cast<std::uint32_t>(count));
      }
    }
  }

  // Called once all vertices are read.
  void split(std::size_t face, std::span<const std::uint32_t> corners) {
    polygon_.clear();
    for (const std::uint32_t v : corners) polygon_.push_back(builder_.vertices()[v]);
    const auto triangles = triangulate_polygon(polygon_);
    if (!triangles) fail(fmt::format("face {}: {}", face, untriangulated_message(corners.size())));
    for (const auto& [i, j, k] : *triangles) {
      const std::uint32_t a = corners[i], b = corners[j], c = corners[k];
      if (a == b || b == c || c == a) continue;
      if (normals_.empty()) {
        builder_.triangle(a, b, c);
      } else {
        builder_.triangle(a, b, c, {normals_[a], normals_[b], normals_[c]});
      }
    }
  }

  std::string_view rest_;
  const std::string& file_;
  bool is_ascii_ = false;
  bool swap_ = false;
  std::vector<Element> elements_;
  std::uint64_t vertex_count_ = 0;
  std::vector<Vec3> normals_;                // of the vertices; empty: none
  std::vector<std::uint32_t> corners_;       // of all faces
  std::vector<std::uint32_t> corner_count_;  // of each
  std::vector<Vec3> polygon_;
  MeshBuilder builder_;
};

template <typename T>
void append_raw(std::string& bytes, T value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

TriangleMesh read_ply(std::string_view bytes, const std::string& file) { return PlyReader(bytes, file).read(); }

std::string ply_bytes(const TriangleMesh& mesh) {
  static_assert(std::endian::native == std::endian::little);
  const SplitVertices split = split_by_normal(mesh);
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double "
      "z\n{}element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      split.vertex.size(), split.normal.empty() ? "" : "property double nx\nproperty double ny\nproperty double nz\n",
      mesh.triangles.size());
  const auto append = [&](const Vec3& x) {
    for (const double value : x) append_raw(bytes, value + 0.0);  // turns -0 into +0
  };
  for (std::size_t i = 0; i < split.vertex.size(); ++i) {
    append(mesh.vertices[split.vertex[i]]);
    if (!split.normal.empty()) append(split.normal[i]);
  }
  for (const auto& triangle : split.triangles) {
    append_raw(bytes, std::uint8_t{3});
    for (const std::uint32_t v : triangle) append_raw(bytes, v);
  }
  return bytes;
}

}  // namespace seaglint
