// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/mesh/triangulate_polygon.h"

namespace seaglint {

namespace {

// Type of numbers in PLY files.
struct PlyNumber {
  std::string_view name, other_name;  // both spellings, "uchar" and "uint8"
  std::size_t bytes;
  double lowest, highest;                         // of an integer type; infinite for the others
  double (*value_at)(const char* at, bool swap);  // swap: in the other byte order than the machine's

  // Whether a number of a text can be of the type: whole and within its limits, or any for floating-point types.
  bool holds(double value) const {
    return std::isinf(highest) || (value >= lowest && value <= highest && value == std::floor(value));
  }
};

template <typename T>
constexpr PlyNumber ply_number(std::string_view name, std::string_view other_name) {
  using Limits = std::numeric_limits<std::conditional_t<std::is_integral_v<T>, T, double>>;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {name,
          other_name,
          sizeof(T),
          std::is_integral_v<T> ? static_cast<double>(Limits::min()) : -kInfinity,
          std::is_integral_v<T> ? static_cast<double>(Limits::max()) : kInfinity,
          [](const char* at, bool swap) -> double { return number_at<T>(at, swap); }};
}

constexpr std::array<PlyNumber, 8> kNumbers{
    ply_number<std::int8_t>("char", "int8"),    ply_number<std::uint8_t>("uchar", "uint8"),
    ply_number<std::int16_t>("short", "int16"), ply_number<std::uint16_t>("ushort", "uint16"),
    ply_number<std::int32_t>("int", "int32"),   ply_number<std::uint32_t>("uint", "uint32"),
    ply_number<float>("float", "float32"),      ply_number<double>("double", "float64")};

// One vertex for each position and normal that occur together, as PLY has one normal per vertex. Welding restores the
// mesh.
struct SplitVertices {
  std::vector<std::uint32_t> vertex;  // of the mesh
  std::vector<Vec3> normal;           // empty for a mesh without normals
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// In order of first use; the mesh as it is where it has no normals.
SplitVertices split_by_normal(const TriangleMesh& mesh) {
  SplitVertices split;
  if (mesh.corner_normals.empty()) {
    split.vertex.resize(mesh.vertices.size());
    std::iota(split.vertex.begin(), split.vertex.end(), 0U);
    split.triangles = mesh.triangles;
    return split;
  }
  std::map<std::tuple<std::uint32_t, double, double, double>, std::uint32_t> number;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::uint32_t, 3>& triangle = split.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t][i];
      const Vec3& n = mesh.corner_normals[t][i];
      const auto [place, is_new] =
          number.try_emplace({v, n.x(), n.y(), n.z()}, static_cast<std::uint32_t>(split.vertex.size()));
      if (is_new) {
        split.vertex.push_back(v);
        split.normal.push_back(n);
      }
      triangle[i] = place->second;
    }
  }
  return split;
}

struct Property {
  std::string name;
  const PlyNumber* value = nullptr;
  const PlyNumber* count = nullptr;  // of a list; null: a single number

  bool is_list() const { return count != nullptr; }
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file) : bytes_(bytes), rest_(bytes), file_(file) {}

  TriangleMesh read() {
    header();
    for (const Element& element : elements_) {
      min_size(element);
      if (element.name == "vertex") {
        vertices(element);
      } else if (element.name == "face") {
        faces(element);
      } else if (element.name == "tristrips") {
        strips(element);
      } else {
        for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
          for (const Property& property : element.properties) skip(property);
        }
      }
    }
    if (rest_.find_first_not_of(" \t\r\n") != std::string_view::npos) fail("more follows than the header promises");
    for (std::uint32_t index : corners_) {
      if (index >= vertex_count_) refuse(fmt::format("a face names vertex {}, there are {}", index, vertex_count_));
    }
    std::size_t first = 0;
    for (std::size_t face = 0; face < corner_count_.size(); first += corner_count_[face++])
      split(face, {corners_.data() + first, corner_count_[face]});
    TriangleMesh mesh = builder_.take();
    mesh.findings = odd_.sentences();
    return mesh;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(fmt::format("{}: {}", file_, what)); }

  // Names the line that is being read, where there are lines.
  [[noreturn]] void fail(const std::string& what) const {
    if (!is_ascii_ && !in_header_) refuse(what);
    const auto line = std::count(bytes_.data(), rest_.data(), '\n') + (in_header_ ? 0 : 1);
    throw InputError(fmt::format("{}:{}: {}", file_, std::max<std::ptrdiff_t>(line, 1), what));
  }

  const PlyNumber* type_of(std::string_view name) const {
    const auto known = std::ranges::find_if(
        kNumbers, [&](const PlyNumber& type) { return name == type.name || name == type.other_name; });
    if (known != kNumbers.end()) return &*known;
    fail(fmt::format("the PLY header has the unknown type \"{}\"", shown(name)));
  }

  void header() {
    if (next_line(rest_) != "ply") fail("is not a PLY file");
    bool has_format = false;
    std::unordered_set<std::string_view> names;  // of elements
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
        if (!names.insert(name).second) fail(fmt::format("the PLY header has \"{}\" twice", name));
        elements_.push_back({std::string(name), static_cast<std::uint64_t>(*number), {}});
      } else if (keyword == "property") {
        if (elements_.empty()) fail("the PLY header has a property before any element");
        Property property;
        std::string_view word = next_word(line);
        if (word == "list") {
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
    in_header_ = false;
  }

  // Checks the declared count against the file size before memory is reserved.
  void min_size(const Element& element) const {
    std::uint64_t min_bytes = 0;
    for (const Property& property : element.properties) {
      min_bytes += is_ascii_ ? 2 : (property.is_list() ? property.count : property.value)->bytes;
    }
    const std::uint64_t available = min_bytes == 0 ? 0 : (rest_.size() + 1) / min_bytes;
    if (element.count > available && !element.properties.empty()) {
      fail(fmt::format("promises {} of \"{}\", has room for {} at most", element.count, element.name, available));
    }
  }

  double number(const PlyNumber& type) {
    if (is_ascii_) {
      const std::string_view word = next_word(rest_);
      const auto number = parse_any_number(word);
      if (!number)
        fail(word.empty() ? std::string("ends before its last number")
                          : fmt::format("\"{}\" is not a number", shown(word)));
      if (!type.holds(*number)) {
        fail(fmt::format("\"{}\" where the header promises a whole number within {} and {}", shown(word), type.lowest,
                         type.highest));
      }
      return *number;
    }
    if (rest_.size() < type.bytes) fail("ends before its last number");
    const double value = type.value_at(rest_.data(), swap_);
    rest_.remove_prefix(type.bytes);
    return value;
  }

  std::uint64_t read_count(const Property& property) {
    const double count = number(*property.count);
    if (!(count >= 0 && count <= static_cast<double>(rest_.size()) &&
          count == static_cast<double>(static_cast<std::uint64_t>(count)))) {
      fail(fmt::format("a list of {} entries with {} bytes left", count, rest_.size()));
    }
    return static_cast<std::uint64_t>(count);
  }

  void skip(const Property& property) {
    const std::uint64_t count = property.is_list() ? read_count(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) number(*property.value);
  }

  void vertices(const Element& element) {
    for (const char* axis : {"x", "y", "z"}) {
      const auto count =
          std::count_if(element.properties.begin(), element.properties.end(),
                        [&](const Property& property) { return !property.is_list() && property.name == axis; });
      if (count != 1)
        fail(fmt::format("its vertices have {} properties {}: must have x, y and z once each", count, axis));
    }
    vertex_count_ = element.count;
    if (vertex_count_ > 0x7fffffff) fail(fmt::format("{} vertices are too many", vertex_count_));
    const bool has_normals = std::ranges::any_of(
        element.properties, [](const Property& property) { return !property.is_list() && property.name == "nx"; });
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Vec3 p = Vec3::Zero(), n = Vec3::Zero();
      for (const Property& property : element.properties) {
        const std::string_view name = property.is_list() ? std::string_view() : property.name;
        const bool is_normal = name.size() == 2 && name[0] == 'n';
        const char axis = is_normal ? name[1] : name.size() == 1 ? name[0] : '\0';
        if (axis < 'x' || axis > 'z') {
          skip(property);
          continue;
        }
        const double value = number(*property.value);
        const std::optional<double> coordinate = is_normal ? value : coordinate_of(value);
        if (!coordinate) fail(fmt::format("vertex {} has the coordinate {}", i, value));
        (is_normal ? n : p)[axis - 'x'] = *coordinate;
      }
      builder_.vertex(p);
      if (has_normals) normals_.push_back(n);
    }
  }

  static bool has_corners(const Property& property) {
    return property.is_list() && (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  // Calls use(index of the row, type of the list's values, their number) for every list of corners, of which it reads
  // the values, and skips the other properties. `rows`: in error messages.
  template <typename Use>
  void corner_lists(const Element& element, const char* rows, const Use& use) {
    // Checked before the loop: the count of rows without properties is not bounded by the file size.
    if (element.count > 0 && std::none_of(element.properties.begin(), element.properties.end(), has_corners))
      fail(fmt::format("its {} have no vertex_indices", rows));
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& property : element.properties) {
        if (has_corners(property))
          use(i, *property.value, read_count(property));
        else
          skip(property);
      }
    }
  }

  void faces(const Element& element) {
    corner_lists(element, "faces", [&](std::uint64_t i, const PlyNumber& type, std::uint64_t count) {
      for (std::uint64_t k = 0; k < count; ++k) {
        const double index = number(type);
        corners_.push_back(corner(index, "face", i));
      }
      corner_count_.push_back(static_cast<std::uint32_t>(count));
    });
  }

  std::uint32_t corner(double index, const char* what, std::uint64_t i) const {
    if (!(index >= 0 && index < 2147483648.0 && index == std::floor(index)))
      fail(fmt::format("{} {} names vertex {}", what, i, index));
    return static_cast<std::uint32_t>(index);
  }

  // Triangle strips (Stanford's PLY): -1 ends a strip, every second triangle is turned.
  void strips(const Element& element) {
    corner_lists(element, "triangle strips", [&](std::uint64_t i, const PlyNumber& type, std::uint64_t count) {
      std::vector<std::uint32_t> strip;
      for (std::uint64_t k = 0; k < count; ++k) {
        const double index = number(type);
        if (index == -1 || (type.highest == 4294967295.0 && index == type.highest)) {
          strip.clear();
          continue;
        }
        strip.push_back(corner(index, "triangle strip", i));
        const std::size_t n = strip.size();
        if (n < 3) continue;
        const bool turned = n % 2 == 0;
        corners_.insert(corners_.end(), {strip[turned ? n - 2 : n - 3], strip[turned ? n - 3 : n - 2], strip[n - 1]});
        corner_count_.push_back(3);
      }
    });
  }

  // Called once all vertices are read.
  void split(std::size_t face, std::span<const std::uint32_t> corners) {
    polygon_.clear();
    for (const std::uint32_t v : corners) polygon_.push_back(builder_.vertices()[v]);
    const auto place = [&] { return fmt::format("face {}", face); };
    for (const auto& [i, j, k] : triangles_of_polygon(polygon_, odd_, place)) {
      const std::uint32_t a = corners[i], b = corners[j], c = corners[k];
      if (a == b || b == c || c == a) continue;
      if (normals_.empty()) {
        builder_.triangle(a, b, c);
      } else {
        builder_.triangle(a, b, c, {normals_[a], normals_[b], normals_[c]});
      }
    }
  }

  std::string_view bytes_, rest_;
  const std::string& file_;
  bool in_header_ = true;
  bool is_ascii_ = false;
  bool swap_ = false;
  std::vector<Element> elements_;
  std::uint64_t vertex_count_ = 0;
  std::vector<Vec3> normals_;                // of the vertices; empty: none
  std::vector<std::uint32_t> corners_;       // of all faces
  std::vector<std::uint32_t> corner_count_;  // of each
  std::vector<Vec3> polygon_;
  OddPolygons odd_;
  MeshBuilder builder_;
};

}  // namespace

TriangleMesh read_ply(std::string bytes, const std::string& file) {
  remove_byte_order_mark(bytes);
  // Line ends \r alone become \n; of a binary file the header only has lines.
  constexpr std::string_view kEnd = "end_header\r";
  const std::size_t found = std::string_view(bytes).find(kEnd);
  if (found != std::string::npos && bytes.find('\n') > found + kEnd.size()) {
    const bool is_text = bytes.find("format ascii") < found;
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(is_text ? bytes.size() : found + kEnd.size());
    std::replace(bytes.begin(), end, '\r', '\n');
  }
  return PlyReader(bytes, file).read();
}

std::string ply_bytes(const TriangleMesh& mesh) {
  const SplitVertices split = split_by_normal(mesh);
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double "
      "z\n{}element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      split.vertex.size(), split.normal.empty() ? "" : "property double nx\nproperty double ny\nproperty double nz\n",
      mesh.triangles.size());
  const auto append = [&](const Vec3& x) {
    for (const double value : x) append_number(bytes, value + 0.0);  // turns -0 into +0
  };
  for (std::size_t i = 0; i < split.vertex.size(); ++i) {
    append(mesh.vertices[split.vertex[i]]);
    if (!split.normal.empty()) append(split.normal[i]);
  }
  for (const auto& triangle : split.triangles) {
    append_number(bytes, std::uint8_t{3});
    for (const std::uint32_t v : triangle) append_number(bytes, v);
  }
  return bytes;
}

}  // namespace seaglint
