// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "sim/core/text/names.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/placement/target_mesh.h"
#include "tools/bindings/bindings.h"
#include "tools/rcs/rcs_request.h"

namespace py = pybind11;

namespace seaglint {
namespace {

// Views of the mesh's own memory, which stays as long as they do.
py::array vertices_of(const py::object& self) {
  const auto& mesh = *self.cast<std::shared_ptr<TriangleMesh>>();
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return py::array_t<double>({static_cast<py::ssize_t>(mesh.vertices.size()), py::ssize_t{3}},
                             mesh.vertices.empty() ? nullptr : mesh.vertices[0].data(), self);
}

py::array triangles_of(const py::object& self) {
  const auto& mesh = *self.cast<std::shared_ptr<TriangleMesh>>();
  return py::array_t<std::uint32_t>({static_cast<py::ssize_t>(mesh.triangles.size()), py::ssize_t{3}},
                                    mesh.triangles.empty() ? nullptr : mesh.triangles[0].data(), self);
}

py::array parts_of(const py::object& self) {
  const auto& mesh = *self.cast<std::shared_ptr<TriangleMesh>>();
  using Part = std::remove_reference_t<decltype(mesh.triangle_part[0])>;
  return py::array_t<std::remove_const_t<Part>>(static_cast<py::ssize_t>(mesh.triangle_part.size()),
                                                mesh.triangle_part.data(), self);
}

// Arrays are checked by the package: [vertex][3], [triangle][3], indices below the number of vertices.
std::shared_ptr<TriangleMesh> mesh_of_arrays(
    const py::array_t<double, py::array::c_style | py::array::forcecast>& vertices,
    const py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>& triangles) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (py::ssize_t i = 0; i < vertices.shape(0); ++i)
    mesh->vertices.emplace_back(vertices.at(i, 0), vertices.at(i, 1), vertices.at(i, 2));
  for (py::ssize_t i = 0; i < triangles.shape(0); ++i)
    mesh->triangles.push_back({triangles.at(i, 0), triangles.at(i, 1), triangles.at(i, 2)});
  mesh->part_names = {"mesh"};
  mesh->materials = {Material{}};
  mesh->triangle_part.assign(mesh->triangles.size(), 0);
  mesh->triangle_material.assign(mesh->triangles.size(), 0);
  return mesh;
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<TriangleMesh, std::shared_ptr<TriangleMesh>>(module, "Mesh")
      .def_static("read",
                  [](const std::string& file, const RcsRequest& placement) {
                    return std::make_shared<TriangleMesh>(read_placed_mesh(find_input(file), placement));
                  })
      .def_static("of_arrays", &mesh_of_arrays)
      .def("write", [](const TriangleMesh& mesh, const std::string& file) { write_mesh(file, mesh); })
      .def_property_readonly("vertices", &vertices_of)
      .def_property_readonly("triangles", &triangles_of)
      .def_property_readonly("parts", &parts_of)
      .def_property_readonly("part_names", [](const TriangleMesh& mesh) { return mesh.part_names; });
}

}  // namespace seaglint
