// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "tools/bindings/bindings.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_uncertainty.h"
#include "tools/rcs/rcs_views.h"

namespace py = pybind11;

namespace seaglint {
namespace {

// [frequency][elevation][azimuth][received h, v][transmitted h, v] in metres.
py::array_t<Complex> matrices_of(const RcsSweep& sweep) {
  const std::size_t frequencies = sweep.frequency_hz.size(), views = sweep.views();
  std::vector<Complex> values(frequencies * views * 4);
  for (std::size_t view = 0; view < views; ++view) {
    for (std::size_t q = 0; q < frequencies; ++q) {
      for (std::size_t element = 0; element < 4; ++element)
        values[(q * views + view) * 4 + element] = sweep.models.back().matrices[view][q][element];
    }
  }
  const auto size = [](const std::vector<double>& axis) { return static_cast<py::ssize_t>(axis.size()); };
  return array_of(std::move(values),
                  {size(sweep.frequency_hz), size(sweep.elevation_deg), size(sweep.azimuth_deg), 2, 2});
}

// Solves `request` for a mesh or file; its other members are set. Returns the matrices and the warnings.
py::tuple rcs(RcsRequest request, const MeshOrFile& target, int threads) {
  set_target(request, target);
  std::vector<std::string> warnings = request_warnings(request);
  const RcsSweep sweep = interruptible<RcsSweep>([&](const StopFlag& stop) {
    PreparedTarget prepared = prepare_mesh(request);
    warnings.insert(warnings.end(), prepared.warnings.begin(), prepared.warnings.end());
    const RcsTarget ready = select_echoes(request, std::move(prepared));
    RcsSweep solved = compute_rcs(request, ready, threads, &stop).sweep;
    const auto uncertain = uncertainty_warnings(solved, ready.prepared.mesh.part_names);
    warnings.insert(warnings.end(), uncertain.begin(), uncertain.end());
    return solved;
  });
  return py::make_tuple(matrices_of(sweep), warnings);
}

}  // namespace

void bind_rcs(py::module_& module) {
  using Materials = std::vector<std::pair<std::string, std::string>>;
  py::class_<RcsRequest>(module, "RcsRequest")
      .def(py::init<>())
      .def_readwrite("unit", &RcsRequest::unit)
      .def_readwrite("forward", &RcsRequest::forward)
      .def_readwrite("up", &RcsRequest::up)
      .def_readwrite("scale", &RcsRequest::scale)
      .def_readwrite("offset_m", &RcsRequest::offset_m)
      .def_readwrite("frequency_hz", &RcsRequest::frequency_hz)
      .def_readwrite("azimuth_deg", &RcsRequest::azimuth_deg)
      .def_readwrite("elevation_deg", &RcsRequest::elevation_deg)
      .def_readwrite("crease_deg", &RcsRequest::crease_deg)
      .def_readwrite("edges", &RcsRequest::edges)
      .def_readwrite("max_bounces", &RcsRequest::max_bounces)
      .def_readwrite("min_patch_m", &RcsRequest::min_patch_m)
      .def_readwrite("ray_spacing_m", &RcsRequest::ray_spacing_m)
      .def_property(
          "method", [](const RcsRequest& request) { return kSolverMethodNames[static_cast<int>(request.method)]; },
          [](RcsRequest& request, const std::string& name) { request.method = solver_method_of(name); })
      .def_readwrite("sheet_thickness_mm", &RcsRequest::sheet_thickness_mm)
      .def_readwrite("range_m", &RcsRequest::range_m)
      .def("set_materials",  // of parts, "" for all others
           [](RcsRequest& request, const Materials& materials) {
             for (const auto& [part, material] : materials)
               request.materials.push_back({part.empty() ? std::nullopt : std::optional(part), material, "materials"});
           })
      .def("set_transmitter",
           [](RcsRequest& request, double azimuth_deg, double elevation_deg) {
             request.transmitter = FixedTransmitter{azimuth_deg, elevation_deg};
           })
      .def("set_cavities",
           [](RcsRequest& request, const std::vector<std::string>& parts) { request.cavities.parts = parts; })
      .def("select",
           [](RcsRequest& request, const std::vector<std::string>& only, const std::vector<std::string>& without) {
             request.selection = {only, without};
           });
  module.attr("max_bounces") = kMaxBounces;
  module.attr("default_bounces") = kDefaultBounces;
  module.def("solved_like",  // the request with the settings of another program, except those given
             [](const RcsRequest& request, const std::string& name, bool crease, bool edges, bool max_bounces) {
               return solved_like(request, like_program(name),
                                  {.crease = crease, .edges = edges, .max_bounces = max_bounces});
             });
  module.def("rcs", &rcs);
}

}  // namespace seaglint
