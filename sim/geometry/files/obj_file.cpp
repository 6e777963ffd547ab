// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/mesh/triangulate_polygon.h"

namespace seaglint {
namespace {

constexpr std::size_t kMaxNames = 65000;  // of groups, of materials

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  TriangleMesh read() {
    // Faces may name vertices of later lines, so the vertices are counted first.
    std::string_view all = rest_;
    while (!all.empty()) {
      std::string_view line = next_line(all);
      if (next_word(line) == "v") ++vertex_count_;
    }
    if (vertex_count_ > std::numeric_limits<std::int32_t>::max())
      fail(fmt::format("{} vertices are too many", vertex_count_));

    std::string joined;
    while (!rest_.empty()) {
      ++line_;
      std::string_view line = next_line(rest_);
      // A backslash at the end of a line continues it; comments are not continued.
      if (line.ends_with('\\') && !has_comment(line)) {
        joined += line.substr(0, line.size() - 1);
        joined += ' ';
        continue;
      }
      if (joined.empty()) {
        statement(line);
      } else {
        joined += line;
        statement(joined);
        joined.clear();
      }
    }
    if (!joined.empty()) statement(joined);
    if (vertices_so_far_ != vertex_count_) {
      fail(fmt::format("{} lines begin with v, {} of them are vertices: a backslash joins one to the line before it",
                       vertex_count_, vertices_so_far_));
    }
    for (const Face& face : faces_) triangulate(face);
    TriangleMesh mesh = builder_.take();
    mesh.findings = odd_.sentences();
    if (free_form_ > 0) {
      mesh.findings.push_back(
          fmt::format("{} {} of free-form geometry ({} in line {}, ...): not read, export it as triangles", free_form_,
                      free_form_ == 1 ? "line" : "lines", first_free_form_, first_free_form_line_));
    }
    return mesh;
  }

 private:
  struct Face {
    std::size_t first, count;  // corners
    std::size_t line;
    std::size_t group, material;  // in groups_ and materials_
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line_, what));
  }

  static bool has_comment(std::string_view line) {
    return std::ranges::any_of(words_of(line), [](std::string_view word) { return word.starts_with('#'); });
  }

  void statement(std::string_view line) {
    const std::string_view keyword = next_word(line);
    if (keyword == "v") vertex(line);
    if (keyword == "vn") normal(line);
    if (keyword == "f") face(line);
    if (keyword == "g" || keyword == "o") groups_.begin(name_in(line, "default"));
    if (keyword == "usemtl") materials_.begin(name_in(line, "default"));
    if (groups_.names.size() > kMaxNames) fail(fmt::format("more than {} groups", kMaxNames));
    if (materials_.names.size() > kMaxNames) fail(fmt::format("more than {} materials", kMaxNames));
    if (is_free_form(keyword)) {
      if (free_form_++ == 0) first_free_form_ = keyword, first_free_form_line_ = line_;
    }
    // Texture coordinates and the files of materials are ignored.
  }

  // Curves and surfaces (Wavefront OBJ specification, "Free-form curve/surface attributes").
  static bool is_free_form(std::string_view keyword) {
    constexpr std::string_view kKeywords[] = {"cstype", "curv", "curv2", "surf", "bmat",
                                              "bzp",    "bsp",  "cdc",   "cdp",  "res"};
    return std::find(std::begin(kKeywords), std::end(kKeywords), keyword) != std::end(kKeywords);
  }

  void vertex(std::string_view line) {
    Vec3 position;
    for (double& x : position) {
      const std::string_view word = next_word(line);
      const auto coordinate = coordinate_in(word);
      if (!coordinate) fail(fmt::format("\"{}\" is not a coordinate", shown(word)));
      x = *coordinate;
    }
    builder_.vertex(position);
    ++vertices_so_far_;
  }

  // A normal that is none never refuses a file: it becomes zero.
  void normal(std::string_view line) {
    Vec3 n;
    for (double& x : n) x = parse_any_number(next_word(line)).value_or(0);
    normals_.push_back(n);
  }

  // v, v/t, v//n or v/t/n with an integer t or none; an n that is no integer is no normal.
  static bool is_corner(std::string_view word) {
    const std::size_t first = word.find('/');
    if (first == std::string_view::npos) return true;
    const std::size_t second = std::min(word.find('/', first + 1), word.size());
    const std::string_view texture = word.substr(first + 1, second - first - 1);
    return texture.empty() || parse_integer(texture);
  }

  // The normal of a corner v//n or v/t/n, zero-based, as far as faces may name one; a later line may still define it.
  std::int64_t normal_index(std::string_view corner) const {
    const std::size_t first = corner.find('/'), second = corner.find('/', first + 1);
    if (first == std::string_view::npos || second == std::string_view::npos) return -1;
    const auto value = parse_integer(corner.substr(second + 1));
    if (!value || *value == 0) return -1;
    return *value > 0 ? *value - 1 : static_cast<std::int64_t>(normals_.size()) + *value;
  }

  Vec3 normal_at(std::int64_t index) const {
    if (index < 0 || index >= static_cast<std::int64_t>(normals_.size())) return Vec3::Zero();
    return normals_[static_cast<std::size_t>(index)];
  }

  void face(std::string_view line) {
    const std::size_t first = corners_.size();
    for (std::string_view word = next_word(line); !word.empty() && word[0] != '#'; word = next_word(line)) {
      const auto value = parse_integer(word.substr(0, word.find('/')));
      if (!value || *value == 0 || !is_corner(word)) fail(fmt::format("\"{}\" is not a corner of a face", shown(word)));
      // Negative indices are relative to the vertex before this line.
      const std::int64_t index = *value > 0 ? *value : vertices_so_far_ + *value + 1;
      if (index < 1 || index > vertex_count_)
        fail(fmt::format("the face names vertex {}, there are {}", *value, vertex_count_));
      corners_.push_back(static_cast<std::uint32_t>(index - 1));
      corner_normals_.push_back(normal_index(word));
    }
    faces_.push_back({first, corners_.size() - first, line_, groups_.current, materials_.current});
  }

  // Called once all vertices are read.
  void triangulate(const Face& face) {
    line_ = face.line;
    const std::span<const std::uint32_t> corners(corners_.data() + face.first, face.count);
    polygon_.clear();
    for (const std::uint32_t v : corners) polygon_.push_back(builder_.vertices()[v]);
    const auto place = [&] { return fmt::format("line {}", face.line); };
    for (const auto& [i, j, k] : triangles_of_polygon(polygon_, odd_, place)) {
      const std::uint32_t a = corners[i], b = corners[j], c = corners[k];
      if (a == b || b == c || c == a) continue;
      builder_.begin_part(groups_.any() ? groups_.name(face.group, "body") : materials_.name(face.material, "body"));
      builder_.begin_material(materials_.name(face.material, Material{}.name));
      if (normals_.empty()) {
        builder_.triangle(a, b, c);
      } else {
        const auto at = [&](std::uint32_t corner) { return normal_at(corner_normals_[face.first + corner]); };
        builder_.triangle(a, b, c, {at(i), at(j), at(k)});
      }
    }
  }

  // Names in order of first appearance, those without faces included, and the one of the lines that follow.
  struct Names {
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    std::vector<std::string> names;
    std::unordered_map<std::string, std::size_t> number;
    std::size_t current = kNone;

    bool any() const { return !names.empty(); }
    void begin(const std::string& name) {
      const auto [place, is_new] = number.try_emplace(name, names.size());
      if (is_new) names.push_back(name);
      current = place->second;
    }
    std::string name(std::size_t i, const std::string& without) const { return i == kNone ? without : names[i]; }
  };

  std::string_view rest_;
  const std::string& file_;
  MeshBuilder builder_;
  std::vector<std::uint32_t> corners_;        // vertex indices of all faces
  std::vector<std::int64_t> corner_normals_;  // indices into normals_, below zero: none
  std::vector<Vec3> normals_;
  std::vector<Face> faces_;
  std::vector<Vec3> polygon_;
  OddPolygons odd_;
  std::size_t free_form_ = 0;  // lines
  std::string first_free_form_;
  std::size_t first_free_form_line_ = 0;
  std::int64_t vertex_count_ = 0;
  std::int64_t vertices_so_far_ = 0;
  std::size_t line_ = 0;
  Names groups_;     // groups and objects: the parts
  Names materials_;  // the parts of a file without groups and objects
};

// Three numbers in the fewest digits that read back as the same doubles; -0 becomes +0.
void append_numbers(std::string& text, const Vec3& x) {
  fmt::format_to(std::back_inserter(text), " {} {} {}\n", x.x() + 0.0, x.y() + 0.0, x.z() + 0.0);
}

}  // namespace

TriangleMesh read_obj(std::string bytes, const std::string& file) {
  const std::string text = plain_lines(std::move(bytes));
  return ObjReader(text, file).read();
}

std::string obj_bytes(const TriangleMesh& mesh) {
  std::string text = fmt::format("# {} vertices, {} faces\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.vertices) {
    text += 'v';
    append_numbers(text, p);
  }
  // Distinct normals in order of first use, from 1; a face has all its normals or none: 0.
  std::map<std::array<double, 3>, std::size_t> number_of;
  std::vector<std::array<std::size_t, 3>> number(mesh.corner_normals.size(), {0, 0, 0});
  for (std::size_t t = 0; t < mesh.corner_normals.size(); ++t) {
    const std::array<Vec3, 3>& normals = mesh.corner_normals[t];
    if (std::ranges::any_of(normals, [](const Vec3& n) { return n.isZero(0); })) continue;
    for (int i = 0; i < 3; ++i) {
      const Vec3& n = normals[i];
      const auto [place, is_new] = number_of.try_emplace({n.x(), n.y(), n.z()}, number_of.size() + 1);
      if (is_new) text += "vn";
      if (is_new) append_numbers(text, n);
      number[t][i] = place->second;
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint16_t part = mesh.triangle_part[t];
    if (t == 0 || part != mesh.triangle_part[t - 1]) text += fmt::format("g {}\n", mesh.part_names[part]);
    const auto& [a, b, c] = mesh.triangles[t];
    if (number.empty() || number[t][0] == 0) {
      fmt::format_to(std::back_inserter(text), "f {} {} {}\n", a + 1, b + 1, c + 1);
    } else {
      fmt::format_to(std::back_inserter(text), "f {}//{} {}//{} {}//{}\n", a + 1, number[t][0], b + 1, number[t][1],
                     c + 1, number[t][2]);
    }
  }
  return text;
}

}  // namespace seaglint
