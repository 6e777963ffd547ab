// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/stl_soup.h"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <cstdint>
#include <sstream>

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/mesh_builder.h"

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

}  // namespace

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
