// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/bindings/bindings.h"
#include "tools/evaluate/evaluate.h"
#include "tools/pipeline/train.h"
#include "tools/rcs/rcs_request.h"

namespace py = pybind11;

namespace seaglint {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

std::vector<Override> overrides_of(const Pairs& pairs) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : pairs) overrides.push_back({key, value});
  return overrides;
}

void bind_scenario(py::module_& module) {
  py::class_<Scenario>(module, "Scenario")
      .def_static("read",
                  [](const std::string& file, const Pairs& set) {
                    return read_scenario(find_input(file, "scenarios"), overrides_of(set));
                  })
      .def_static("parse", [](const std::string& yaml, const std::string& name,
                              const Pairs& set) { return parse_scenario(yaml, name, overrides_of(set)); })
      .def_property_readonly("name", [](const Scenario& scenario) { return scenario.name; })
      .def_property_readonly("seed", [](const Scenario& scenario) { return scenario.seed; })
      .def_property_readonly("targets",
                             [](const Scenario& scenario) {
                               std::vector<std::string> names;
                               for (const TargetSpec& target : scenario.targets) {
                                 if (!is_sea_alone(target)) names.push_back(target.name);
                               }
                               return names;
                             })
      .def("yaml", [](const Scenario& scenario) { return effective_yaml(scenario); })
      .def("__len__", [](const Scenario& scenario) { return SamplePlan(scenario).size(); });
}

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

// `set`: key paths of the data set's scenario with their new values. The text of metrics.json and the warnings.
py::tuple train(const std::string& data_set, const std::string& model_directory, const Pairs& set, int threads) {
  const auto model = interruptible<TrainedModel>([&](const StopFlag& stop) {
    return train_model({.data_sets = {data_set},
                        .model_directory = model_directory,
                        .overrides = overrides_of(set),
                        .threads = threads,
                        .stop = &stop});
  });
  return py::make_tuple(model.metrics, model.warnings);
}

// The text of evaluation.json and the warnings.
py::tuple evaluate(const std::string& model, const std::vector<std::string>& data_sets,
                   const std::vector<std::string>& by, bool trained_rows, bool unseen_seas, const std::string& output) {
  const EvaluateRequest request{model, {data_sets.begin(), data_sets.end()}, by, output, trained_rows, unseen_seas};
  const auto evaluated =
      interruptible<EvaluatedModel>([&](const StopFlag& stop) { return evaluate_model(request, &stop); });
  return py::make_tuple(evaluated.json, evaluated.warnings);
}

}  // namespace
}  // namespace seaglint

PYBIND11_MODULE(_core, module) {
  using namespace seaglint;
  module.doc() = "The parts of seaglint in C++; use the package seaglint.";
  module.attr("__version__") = kVersion;
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<WorkError>(module, "WorkError", PyExc_RuntimeError);
  module.def("set_data_folder", [](const std::string& folder) { set_data_folder(folder); });
  module.def("data_folder", [] { return data_folder().string(); });
  bind_scenario(module);
  bind_mesh(module);
  bind_rcs(module);
  bind_scene(module);
  module.def("train", &train);
  module.def("evaluate", &evaluate);
}
