// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
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

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using Status = OpenMesh::Attributes::StatusInfo;

// Collects vertices and faces unconnected: OpenMesh's own mesh rejects faces at non-manifold edges.
class SoupImporter : public OpenMesh::IO::BaseImporter {
 public:
  SoupImporter(std::size_t triangle_count, const std::string& file) : triangle_count_(triangle_count), file_(file) {}

  TriangleMesh take() { return builder_.take(); }

  VertexHandle add_vertex(const OpenMesh::Vec3f& p) override {
    builder_.vertex({p[0], p[1], p[2]});
    return VertexHandle(static_cast<int>(builder_.vertices().size() - 1));
  }
  FaceHandle add_face(const VHandles& corners) override {
    const std::size_t face = builder_.triangle_count();
    if (corners.size() != 3 || face >= triangle_count_) {
      throw InputError(fmt::format("{}: face {} has {} corners", file_, face, corners.size()));
    }
    for (VertexHandle v : corners) {
      if (v.idx() < 0 || static_cast<std::size_t>(v.idx()) >= builder_.vertices().size()) {
        throw InputError(fmt::format("{}: face {} names vertex {}", file_, face, v.idx()));
      }
    }
    builder_.triangle(static_cast<std::uint32_t>(corners[0].idx()), static_cast<std::uint32_t>(corners[1].idx()),
                      static_cast<std::uint32_t>(corners[2].idx()));
    return FaceHandle(static_cast<int>(face));
  }

  std::size_t n_vertices() const override { return builder_.vertices().size(); }
  std::size_t n_faces() const override { return builder_.triangle_count(); }
  std::size_t n_edges() const override { return 0; }

  // STL has none of these.
  VertexHandle add_vertex() override { return VertexHandle(); }
  void set_point(VertexHandle, const OpenMesh::Vec3f&) override {}
  HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
  FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<OpenMesh::Vec3f>&) override {}
  void set_face_texindex(FaceHandle, int) override {}
  void set_halfedge(VertexHandle, HalfedgeHandle) override {}
  void set_normal(VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_normal(VertexHandle, const OpenMesh::Vec3d&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_color(VertexHandle, const OpenMesh::Vec4f&) override {}
  void set_texcoord(VertexHandle, const OpenMesh::Vec2f&) override {}
  void set_status(VertexHandle, const Status&) override {}
  void set_next(HalfedgeHandle, HalfedgeHandle) override {}
  void set_face(HalfedgeHandle, FaceHandle) override {}
  void request_face_texcoords2D() override {}
  void set_texcoord(HalfedgeHandle, const OpenMesh::Vec2f&) override {}
  void set_texcoord(VertexHandle, const OpenMesh::Vec3f&) override {}
  void set_texcoord(HalfedgeHandle, const OpenMesh::Vec3f&) override {}
  void set_status(HalfedgeHandle, const Status&) override {}
  void set_color(EdgeHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(EdgeHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(EdgeHandle, const OpenMesh::Vec3f&) override {}
  void set_color(EdgeHandle, const OpenMesh::Vec4f&) override {}
  void set_status(EdgeHandle, const Status&) override {}
  void set_normal(FaceHandle, const OpenMesh::Vec3f&) override {}
  void set_normal(FaceHandle, const OpenMesh::Vec3d&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec3uc&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec4uc&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec3f&) override {}
  void set_color(FaceHandle, const OpenMesh::Vec4f&) override {}
  void set_status(FaceHandle, const Status&) override {}
  void add_texture_information(int, std::string) override {}

 private:
  std::size_t triangle_count_;
  const std::string& file_;
  MeshBuilder builder_;
};

// Counterpart for writing: provides vertices and triangles only.
class SoupExporter : public OpenMesh::IO::BaseExporter {
 public:
  explicit SoupExporter(const TriangleMesh& mesh) : mesh_(mesh) {}

  OpenMesh::Vec3f point(VertexHandle v) const override {
    const Vec3& p = mesh_.vertices[v.idx()];
    // Adding zero turns -0 into +0.
    return {static_cast<float>(p.x()) + 0.0f, static_cast<float>(p.y()) + 0.0f, static_cast<float>(p.z()) + 0.0f};
  }
  unsigned int get_vhandles(FaceHandle f, std::vector<VertexHandle>& corners) const override {
    corners.clear();
    for (std::uint32_t v : mesh_.triangles[f.idx()]) corners.emplace_back(static_cast<int>(v));
    return 3;
  }
  OpenMesh::Vec3f normal(FaceHandle f) const override {
    const Vec3 area = area_vector(mesh_, f.idx());
    const Vec3 n = area.norm() > 0 ? Vec3(area.normalized()) : Vec3::Zero();
    return {static_cast<float>(n.x()) + 0.0f, static_cast<float>(n.y()) + 0.0f, static_cast<float>(n.z()) + 0.0f};
  }
  bool is_triangle_mesh() const override { return true; }
  bool has_face_normals() const override { return true; }
  std::size_t n_vertices() const override { return mesh_.vertices.size(); }
  std::size_t n_faces() const override { return mesh_.triangles.size(); }
  std::size_t n_edges() const override { return 0; }

  bool is_point_double() const override { return false; }
  bool is_normal_double() const override { return false; }
  OpenMesh::Vec3d pointd(VertexHandle v) const override { return OpenMesh::Vec3d(point(v)); }
  OpenMesh::Vec3d normald(FaceHandle f) const override { return OpenMesh::Vec3d(normal(f)); }

  OpenMesh::Vec3f normal(VertexHandle) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec3d normald(VertexHandle) const override { return OpenMesh::Vec3d(0); }
  OpenMesh::Vec3uc color(VertexHandle) const override { return OpenMesh::Vec3uc(0); }
  OpenMesh::Vec4uc colorA(VertexHandle) const override { return OpenMesh::Vec4uc(0); }
  OpenMesh::Vec3ui colori(VertexHandle) const override { return OpenMesh::Vec3ui(0); }
  OpenMesh::Vec4ui colorAi(VertexHandle) const override { return OpenMesh::Vec4ui(0); }
  OpenMesh::Vec3f colorf(VertexHandle) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec4f colorAf(VertexHandle) const override { return OpenMesh::Vec4f(0); }
  OpenMesh::Vec2f texcoord(VertexHandle) const override { return OpenMesh::Vec2f(0); }
  OpenMesh::Vec2f texcoord(HalfedgeHandle) const override { return OpenMesh::Vec2f(0); }
  Status status(VertexHandle) const override { return {}; }
  HalfedgeHandle getHeh(FaceHandle, VertexHandle) const override { return HalfedgeHandle(); }
  unsigned int get_face_texcoords(std::vector<OpenMesh::Vec2f>&) const override { return 0; }
  OpenMesh::Vec3uc color(FaceHandle) const override { return OpenMesh::Vec3uc(0); }
  OpenMesh::Vec4uc colorA(FaceHandle) const override { return OpenMesh::Vec4uc(0); }
  OpenMesh::Vec3ui colori(FaceHandle) const override { return OpenMesh::Vec3ui(0); }
  OpenMesh::Vec4ui colorAi(FaceHandle) const override { return OpenMesh::Vec4ui(0); }
  OpenMesh::Vec3f colorf(FaceHandle) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec4f colorAf(FaceHandle) const override { return OpenMesh::Vec4f(0); }
  Status status(FaceHandle) const override { return {}; }
  OpenMesh::Vec3uc color(EdgeHandle) const override { return OpenMesh::Vec3uc(0); }
  OpenMesh::Vec4uc colorA(EdgeHandle) const override { return OpenMesh::Vec4uc(0); }
  OpenMesh::Vec3ui colori(EdgeHandle) const override { return OpenMesh::Vec3ui(0); }
  OpenMesh::Vec4ui colorAi(EdgeHandle) const override { return OpenMesh::Vec4ui(0); }
  OpenMesh::Vec3f colorf(EdgeHandle) const override { return OpenMesh::Vec3f(0); }
  OpenMesh::Vec4f colorAf(EdgeHandle) const override { return OpenMesh::Vec4f(0); }
  Status status(EdgeHandle) const override { return {}; }
  int get_halfedge_id(VertexHandle) override { return -1; }
  int get_halfedge_id(FaceHandle) override { return -1; }
  int get_next_halfedge_id(HalfedgeHandle) override { return -1; }
  int get_to_vertex_id(HalfedgeHandle) override { return -1; }
  int get_face_id(HalfedgeHandle) override { return -1; }
  Status status(HalfedgeHandle) const override { return {}; }
  const OpenMesh::BaseKernel* kernel() override { return &no_properties_; }

 private:
  const TriangleMesh& mesh_;
  const OpenMesh::BaseKernel no_properties_;
};

// Suppresses the messages of OpenMesh on standard output and error; failures are thrown here.
class Silence {
 public:
  Silence() : log_(omlog().is_enabled()), err_(omerr().is_enabled()) {
    omlog().disable();
    omerr().disable();
  }
  ~Silence() {
    if (log_) omlog().enable();
    if (err_) omerr().enable();
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  bool log_;
  bool err_;
};

// `bytes`: a validated binary STL of `triangle_count` triangles. Throws InputError that names the file.
TriangleMesh read_stl_soup(const std::string& bytes, std::size_t triangle_count, const std::string& file) {
  const Silence silence;
  SoupImporter importer(triangle_count, file);
  OpenMesh::IO::Options options = OpenMesh::IO::Options::Binary;
  std::istringstream stream(bytes);
  if (!OpenMesh::IO::IOManager().read(stream, ".stl", importer, options)) {
    throw InputError(fmt::format("{}: OpenMesh could not read it", file));
  }
  return importer.take();
}

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
TriangleMesh read_binary(std::string bytes, const std::string& file) {
  if (bytes.size() < kHeader)
    throw InputError(fmt::format("{}: {} bytes are no binary STL, which begins with 84", file, bytes.size()));
  const std::uint32_t count = count_in(bytes);
  const std::size_t available = (bytes.size() - kHeader) / kFacet;
  if (count > available)
    throw InputError(fmt::format("{}: promises {} triangles, contains {}", file, count, available));
  const std::size_t end = kHeader + kFacet * count;
  const std::string_view left = std::string_view(bytes).substr(end);
  std::vector<std::string> findings;
  if (!left.empty()) {
    if (are_triangles(left))
      throw InputError(fmt::format("{}: promises {} triangles, which end at byte {}; {} bytes are left over", file,
                                   count, end, left.size()));
    findings.push_back(fmt::format("{} {} left over behind the last of {} triangles: not read", left.size(),
                                   left.size() == 1 ? "byte is" : "bytes are", count));
    bytes.resize(end);
  }
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < 9; ++i) {
      char* at = bytes.data() + kHeader + t * kFacet + 12 + 4 * i;
      float value = 0;
      std::memcpy(&value, at, 4);
      const auto coordinate = coordinate_of(value);
      if (!coordinate) throw InputError(fmt::format("{}: triangle {} has the coordinate {}", file, t, value));
      value = static_cast<float>(*coordinate) + 0.0f;  // turns -0 into +0
      std::memcpy(at, &value, 4);
    }
  }
  TriangleMesh mesh = read_stl_soup(bytes, count, file);
  mesh.findings.insert(mesh.findings.end(), findings.begin(), findings.end());
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
  const Silence silence;
  SoupExporter exporter(mesh);
  OpenMesh::IO::Options options = OpenMesh::IO::Options::Binary;
  std::ostringstream stream;
  if (!OpenMesh::IO::IOManager().write(stream, ".stl", exporter, options)) {
    throw WorkError("OpenMesh could not write the mesh");
  }
  return stream.str();
}

}  // namespace seaglint
