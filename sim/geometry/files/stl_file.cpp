// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/mesh/triangulate_polygon.h"

namespace seaglint {

namespace {

constexpr std::size_t kHeader = 84,
                      kFacet = 50;  // bytes: 80 of comment and the count; normal, three vertices, attribute

std::uint32_t count_in(std::string_view bytes) {
  return bytes.size() >= kHeader ? number_at<std::uint32_t>(bytes.data() + 80) : 0;
}

// Whether bytes behind the last triangle hold geometry: further triangles where the count is wrong, or a second file.
bool are_triangles(std::string_view left) {
  const bool is_file =
      left.size() >= kHeader + kFacet && count_in(left) > 0 && count_in(left) <= (left.size() - kHeader) / kFacet;
  return left.size() % kFacet == 0 || is_file;
}

bool is_degenerate(const std::array<Vec3, 3>& corners) {
  return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

// Adds a triangle with vertices of its own.
void add_triangle(MeshBuilder& builder, const std::array<Vec3, 3>& corners) {
  const std::uint32_t a = builder.vertex(corners[0]), b = builder.vertex(corners[1]), c = builder.vertex(corners[2]);
  builder.triangle(a, b, c);
}

// Header, count, then facets of a normal and three vertices as little-endian float32. Other bytes behind them are a
// finding.
TriangleMesh read_binary(std::string_view bytes, const std::string& file) {
  if (bytes.size() < kHeader)
    throw InputError(fmt::format("{}: {} bytes are no binary STL, which begins with 84", file, bytes.size()));
  const std::uint32_t count = count_in(bytes);
  const std::size_t available = (bytes.size() - kHeader) / kFacet;
  if (count > available)
    throw InputError(fmt::format("{}: promises {} triangles, contains {}", file, count, available));
  const std::size_t end = kHeader + kFacet * count;
  const std::string_view left = bytes.substr(end);
  if (are_triangles(left) && !left.empty())
    throw InputError(fmt::format("{}: promises {} triangles, which end at byte {}; {} bytes are left over", file, count,
                                 end, left.size()));
  MeshBuilder builder;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 9; ++i) {
      const auto value = number_at<float>(bytes.data() + kHeader + t * kFacet + 12 + 4 * i);
      const auto coordinate = coordinate_of(value);
      if (!coordinate) throw InputError(fmt::format("{}: triangle {} has the coordinate {}", file, t, value));
      corners[i / 3][i % 3] = *coordinate + 0.0;  // turns -0 into +0
    }
    if (!is_degenerate(corners)) add_triangle(builder, corners);
  }
  TriangleMesh mesh = builder.take();
  if (!left.empty())
    mesh.findings.push_back(fmt::format("{} {} left over behind the last of {} triangles: not read", left.size(),
                                        left.size() == 1 ? "byte is" : "bytes are", count));
  return mesh;
}

class AsciiStl {
 public:
  AsciiStl(std::string text, const std::string& file) : text_(std::move(text)), rest_(text_), file_(file) {}

  TriangleMesh read() {
    for (std::string word = keyword(); !word.empty(); word = keyword()) {
      if (word == "solid") {
        begin_solid();
      } else if (word == "facet") {
        facet();
      } else if (word == "endsolid") {
        next_line(rest_);
        in_solid_ = false;
      } else {
        fail(fmt::format("\"{}\" where facet or endsolid belongs", shown(word)));
      }
    }
    if (in_solid_) fail("ends without endsolid: the file is cut off");
    return builder_.take();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto line = std::count(text_.begin(), text_.end() - static_cast<std::ptrdiff_t>(rest_.size()), '\n') + 1;
    throw InputError(fmt::format("{}:{}: {}", file_, line, what));
  }

  // The next keyword in lower case; "end loop" is endloop.
  std::string keyword() {
    const std::string word = lower_case(next_word(rest_));
    return word == "end" ? word + lower_case(next_word(rest_)) : word;
  }

  void expect(const char* word) {
    const std::string found = keyword();
    if (found != word) fail(fmt::format("\"{}\" where {} belongs", shown(found), word));
  }

  void begin_solid() {
    if (in_solid_) fail("solid where endsolid belongs");
    in_solid_ = true;
    solid_ = name_in(next_line(rest_), "body");
  }

  double coordinate() {
    const std::string_view word = next_word(rest_);
    const auto value = coordinate_in(word);
    if (!value) fail(fmt::format("\"{}\" is not a coordinate", shown(word)));
    return *value;
  }

  void facet() {
    expect("normal");
    // The normal is ignored: it follows from the vertices, and some exporters write nan for slivers.
    for (int i = 0; i < 3; ++i) next_word(rest_);
    expect("outer");
    expect("loop");
    std::array<Vec3, 3> corners;
    for (Vec3& corner : corners) {
      expect("vertex");
      for (double& value : corner) value = coordinate();
    }
    expect("endloop");
    expect("endfacet");
    if (is_degenerate(corners)) return;
    builder_.begin_part(solid_);
    if (builder_.part_count() > kMaxParts) fail(fmt::format("more than {} solids", kMaxParts));
    add_triangle(builder_, corners);
  }

  const std::string text_;
  std::string_view rest_;
  const std::string& file_;
  MeshBuilder builder_;
  std::string solid_ = "body";
  bool in_solid_ = false;
};

// "solid" comes first, behind a byte order mark perhaps; no text has bytes such as 0 at its beginning.
bool is_text(std::string_view bytes) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  std::string_view start = bytes;
  if (start.starts_with(kMark)) start.remove_prefix(kMark.size());
  const bool says_solid = lower_case(next_word(start)) == "solid";
  const std::string_view head = bytes.substr(0, 512);
  const bool has_other_bytes = std::any_of(head.begin(), head.end(), [](char c) {
    return (c >= 0 && c < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f') || c == 0x7f;
  });
  return says_solid && !has_other_bytes;
}

}  // namespace

TriangleMesh read_stl(std::string bytes, const std::string& file) {
  // Binary files may also begin with "solid": then their size decides.
  const bool has_binary_size =
      bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * std::size_t{count_in(bytes)};
  if (!has_binary_size && is_text(bytes)) return AsciiStl(plain_lines(std::move(bytes)), file).read();
  return read_binary(bytes, file);
}

std::string stl_bytes(const TriangleMesh& mesh) {
  const auto to_float = [](const Vec3& x) {
    // Adding zero turns -0 into +0.
    return OpenMesh::Vec3f(static_cast<float>(x.x()) + 0.0f, static_cast<float>(x.y()) + 0.0f,
                           static_cast<float>(x.z()) + 0.0f);
  };
  // Triangles with vertices of their own: OpenMesh rejects faces at non-manifold edges.
  OpenMesh::TriMesh_ArrayKernelT<> soup;
  soup.request_face_normals();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const auto vertex = [&](std::uint32_t v) { return soup.add_vertex(to_float(mesh.vertices[v])); };
    const auto face = soup.add_face(vertex(a), vertex(b), vertex(c));
    const Vec3 area = area_vector(mesh, t);
    soup.set_normal(face, to_float(area.norm() > 0 ? area.normalized() : Vec3::Zero()));
  }
  // Its messages go to standard output and error.
  omlog().disable();
  omerr().disable();
  std::ostringstream stream;
  const OpenMesh::IO::Options options = OpenMesh::IO::Options::Binary | OpenMesh::IO::Options::FaceNormal;
  if (!OpenMesh::IO::write_mesh(soup, stream, ".stl", options)) throw WorkError("OpenMesh could not write the mesh");
  return stream.str();
}

}  // namespace seaglint
