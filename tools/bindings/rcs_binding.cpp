// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <variant>

#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "tools/bindings/bindings.h"
#include "tools/compare/comparison_text.h"
#include "tools/options/rcs_arguments.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_uncertainty.h"
#include "tools/rcs/rcs_views.h"

namespace py = pybind11;

namespace seaglint {
namespace {

using MeshOrFile = std::variant<std::shared_ptr<TriangleMesh>, std::string>;

// Throws InputError where the file is not found (find_input()).
void set_target(RcsRequest& request, const MeshOrFile& target) {
  if (const auto* file = std::get_if<std::string>(&target)) {
    request.target = find_input(*file);
  } else {
    request.mesh = std::get<0>(target);
    request.target = "the mesh";
  }
}

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
    if (!prepared.materials_note.empty()) warnings.push_back(prepared.materials_note);
    warnings.insert(warnings.end(), prepared.warnings.begin(), prepared.warnings.end());
    const RcsTarget ready = select_echoes(request, std::move(prepared));
    RcsSweep solved = compute_rcs(request, ready, threads, &stop).sweep;
    const auto uncertain = uncertainty_warnings(solved, ready.prepared.mesh.part_names);
    warnings.insert(warnings.end(), uncertain.begin(), uncertain.end());
    return solved;
  });
  return py::make_tuple(matrices_of(sweep), warnings);
}

ComparisonSettings settings_of(const ReferenceArguments& exports, bool as_is, std::optional<double> radius_m) {
  return {exports.floor_db, as_is, radius_m};
}

// Exports with another table; the text of compare.json.
std::string compare_tables(const ReferenceArguments& exports, const std::string& against, bool as_is,
                           std::optional<double> interpolation_radius_m, int threads) {
  const ComparisonSettings settings = settings_of(exports, as_is, interpolation_radius_m);
  const auto comparisons = interruptible<std::vector<ExportComparison>>([&](const StopFlag& stop) {
    const std::vector<FieldTable> tables = exports.read().tables;
    ReferenceArguments other;
    other.files = {against};
    const FieldTable table = joined_tables(other.read().tables, against);
    std::vector<ExportComparison> compared;
    for (const FieldTable& one : tables) {
      if (stop) throw Interrupted();
      compared.push_back(compare_with_table(one, table, settings, threads));
    }
    check_reciprocity(compared);
    return compared;
  });
  return comparison_json(comparisons, settings);
}

// Exports with a mesh solved at their angles and frequencies; the text of compare.json and the mesh's warnings.
py::tuple compare_target(const ReferenceArguments& exports, RcsRequest request, const MeshOrFile& target, bool as_is,
                         int threads) {
  set_target(request, target);
  const ComparisonSettings settings = settings_of(exports, as_is, std::nullopt);
  std::vector<std::string> warnings;
  const auto comparisons = interruptible<std::vector<ExportComparison>>([&](const StopFlag& stop) {
    const std::vector<FieldTable> tables = exports.read().tables;
    const RcsRequest solved = at_frequencies_of(tables, std::move(request));
    const RcsTarget prepared = prepare_rcs_target(solved);
    warnings = prepared.prepared.warnings;
    if (!prepared.prepared.materials_note.empty()) warnings.push_back(prepared.prepared.materials_note);
    TargetSolutions solutions{threads, stop, [](const std::string&) {}};
    std::vector<ExportComparison> compared;
    for (const FieldTable& table : tables)
      compared.push_back(compare_with_target(table, solved, prepared, settings, solutions));
    check_reciprocity(compared);
    return compared;
  });
  return py::make_tuple(comparison_json(comparisons, settings), warnings);
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
      .def_readwrite("waterline_m", &RcsRequest::waterline_m)
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
  py::class_<ReferenceArguments>(module, "Exports")  // each property: none, one for all files, or one for each
      .def(py::init<>())
      .def_readwrite("files", &ReferenceArguments::files)
      .def_readwrite("polarisation", &ReferenceArguments::polarisation)
      .def_readwrite("phi", &ReferenceArguments::phi)
      .def_readwrite("frequency_ghz", &ReferenceArguments::frequency_ghz)
      .def_readwrite("elevation_deg", &ReferenceArguments::elevation_deg)
      .def_readwrite("incidence", &ReferenceArguments::incidence)
      .def_readwrite("origin_m", &ReferenceArguments::origin_m)
      .def_readwrite("floor_db", &ReferenceArguments::floor_db);
  module.def("compare_tables", &compare_tables);
  module.def("compare_target", &compare_target);
}

}  // namespace seaglint
