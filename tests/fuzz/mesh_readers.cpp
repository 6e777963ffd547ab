// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "tests/fuzz/readers.h"

namespace seaglint {
namespace {

// What triangle_mesh.h and mesh_io.h promise of a mesh that was read.
void check_mesh(const TriangleMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  SEAGLINT_CHECK(count > 0 && mesh.triangle_part.size() == count && mesh.triangle_material.size() == count, "sizes");
  SEAGLINT_CHECK(mesh.corner_normals.empty() || mesh.corner_normals.size() == count, "normals");
  for (std::size_t t = 0; t < count; ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) SEAGLINT_CHECK(v < mesh.vertices.size(), "a vertex that is none");
    SEAGLINT_CHECK(mesh.triangle_part[t] < mesh.part_names.size(), "a part that is none");
    SEAGLINT_CHECK(mesh.triangle_material[t] < mesh.materials.size(), "a material that is none");
  }
  for (const Vec3& p : mesh.vertices) SEAGLINT_CHECK(p.allFinite(), "a vertex that is not finite");
}

void read_as(const std::string& bytes, const char* name) {
  is_refused([&] {
    const TriangleMesh mesh = read_mesh(file_of(bytes, name));
    check_mesh(mesh);
    diagnostic_messages(diagnose(mesh));
    repair(mesh);
  });
}

}  // namespace

void fuzz_obj(const std::string& bytes) { read_as(bytes, "mesh.obj"); }
void fuzz_stl(const std::string& bytes) { read_as(bytes, "mesh.stl"); }
void fuzz_ply(const std::string& bytes) { read_as(bytes, "mesh.ply"); }
void fuzz_gltf(const std::string& bytes) { read_as(bytes, "mesh.gltf"); }
void fuzz_glb(const std::string& bytes) { read_as(bytes, "mesh.glb"); }
void fuzz_nastran(const std::string& bytes) { read_as(bytes, "mesh.bdf"); }
void fuzz_unv(const std::string& bytes) { read_as(bytes, "mesh.unv"); }
void fuzz_gmsh(const std::string& bytes) { read_as(bytes, "mesh.msh"); }

}  // namespace seaglint
