// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "tools/bindings/bindings.h"
#include "tools/evaluate/evaluate.h"

namespace py = pybind11;

namespace seaglint {
namespace {

// The text of evaluation.json and the warnings.
py::tuple evaluate(const std::string& model, const std::vector<std::string>& data_sets,
                   const std::vector<std::string>& by, bool trained_rows, bool unseen_seas, const std::string& output) {
  const EvaluateRequest request{model, {data_sets.begin(), data_sets.end()}, by, output, trained_rows, unseen_seas};
  const auto evaluated =
      interruptible<EvaluatedModel>([&](const StopFlag& stop) { return evaluate_model(request, &stop); });
  return py::make_tuple(evaluated.json, evaluated.warnings);
}

}  // namespace

void bind_evaluate(py::module_& module) { module.def("evaluate", &evaluate); }

}  // namespace seaglint
