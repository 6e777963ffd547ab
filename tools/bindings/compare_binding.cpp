// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>

#include "sim/core/process/error.h"
#include "tools/bindings/bindings.h"
#include "tools/compare/comparison_text.h"
#include "tools/options/rcs_arguments.h"

namespace py = pybind11;

namespace seaglint {
namespace {

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
  return comparison_json(comparisons, settings).dump();
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
    TargetSolutions solutions{threads, stop, [](const std::string&) {}};
    std::vector<ExportComparison> compared;
    for (const FieldTable& table : tables)
      compared.push_back(compare_with_target(table, solved, prepared, settings, solutions));
    check_reciprocity(compared);
    return compared;
  });
  return py::make_tuple(comparison_json(comparisons, settings).dump(), warnings);
}

}  // namespace

void bind_compare(py::module_& module) {
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
