// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "tools/bindings/bindings.h"
#include "tools/bindings/interruptible.h"
#include "tools/compare/comparison_text.h"
#include "tools/options/reference_arguments.h"

namespace py = pybind11;

namespace seaglint {
namespace {

// Two tables; the text of compare.json.
std::string compare_tables(const std::string& file, const std::string& against, const std::string& polarisation,
                           const std::string& incidence, double floor_db, bool as_is,
                           std::optional<double> interpolation_radius_m, int threads) {
  const auto read = [&](const std::string& name) {
    ReferenceArguments arguments;
    arguments.files = {name};
    if (!polarisation.empty()) arguments.polarisation = {polarisation};
    if (!incidence.empty()) arguments.incidence = {incidence};
    return arguments.read().front();
  };
  const ComparisonSettings settings{floor_db, as_is, interpolation_radius_m};
  const auto comparisons = interruptible<std::vector<ExportComparison>>([&](const StopFlag&) {
    return std::vector<ExportComparison>{compare_with_table(read(file), read(against), settings, threads)};
  });
  return comparison_json(comparisons, settings).dump();
}

}  // namespace

void bind_compare(py::module_& module) { module.def("compare_tables", &compare_tables); }

}  // namespace seaglint
