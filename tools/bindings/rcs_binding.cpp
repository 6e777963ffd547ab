// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "sim/core/process/data_folder.h"
#include "tools/bindings/arrays.h"
#include "tools/bindings/bindings.h"
#include "tools/bindings/interruptible.h"
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

struct Settings {
  std::string unit;
  std::vector<std::pair<std::string, std::string>> materials;  // part, or "" for all; material
  std::optional<double> crease_deg;
  bool edges;
  int max_bounces;
  double min_patch_m, sheet_thickness_mm, range_m;
  std::optional<std::pair<double, double>> transmitter;  // azimuth, elevation
  std::vector<std::string> cavities, only, without;
};

py::tuple rcs(const std::variant<std::shared_ptr<TriangleMesh>, std::string>& target,
              const std::vector<double>& frequency_hz, const std::vector<double>& azimuth_deg,
              const std::vector<double>& elevation_deg, const Settings& settings, int threads) {
  RcsRequest request;
  if (const auto* file = std::get_if<std::string>(&target)) {
    request.target = find_input(*file);
  } else {
    request.mesh = std::get<0>(target);
    request.target = "the mesh";
  }
  request.unit = settings.unit;
  for (const auto& [part, material] : settings.materials)
    request.materials.push_back({part.empty() ? std::nullopt : std::optional(part), material, "materials"});
  request.frequency_hz = frequency_hz;
  request.azimuth_deg = azimuth_deg;
  request.elevation_deg = elevation_deg;
  request.edges = settings.edges;
  request.crease_deg = settings.crease_deg;
  request.max_bounces = settings.max_bounces;
  request.min_patch_m = settings.min_patch_m;
  request.sheet_thickness_mm = settings.sheet_thickness_mm;
  request.range_m = settings.range_m;
  if (settings.transmitter)
    request.transmitter = FixedTransmitter{settings.transmitter->first, settings.transmitter->second};
  request.cavities.parts = settings.cavities;
  request.selection = {settings.only, settings.without};

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
  py::class_<Settings>(module, "RcsSettings")
      .def(py::init<>())
      .def_readwrite("unit", &Settings::unit)
      .def_readwrite("materials", &Settings::materials)
      .def_readwrite("crease_deg", &Settings::crease_deg)
      .def_readwrite("edges", &Settings::edges)
      .def_readwrite("max_bounces", &Settings::max_bounces)
      .def_readwrite("min_patch_m", &Settings::min_patch_m)
      .def_readwrite("sheet_thickness_mm", &Settings::sheet_thickness_mm)
      .def_readwrite("range_m", &Settings::range_m)
      .def_readwrite("transmitter", &Settings::transmitter)
      .def_readwrite("cavities", &Settings::cavities)
      .def_readwrite("only", &Settings::only)
      .def_readwrite("without", &Settings::without);
  module.def("rcs", &rcs);
}

}  // namespace seaglint
