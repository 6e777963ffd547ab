// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>

#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "tools/bindings/bindings.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, module) {
  module.doc() = "The parts of seaglint in C++; use the package seaglint.";
  module.attr("__version__") = seaglint::kVersion;
  py::register_exception<seaglint::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<seaglint::WorkError>(module, "WorkError", PyExc_RuntimeError);
  module.def("set_data_folder", [](const std::string& folder) { seaglint::set_data_folder(folder); });
  module.def("data_folder", [] { return seaglint::data_folder().string(); });
  seaglint::bind_scenario(module);
  seaglint::bind_mesh(module);
  seaglint::bind_rcs(module);
  seaglint::bind_sample(module);
  seaglint::bind_series(module);
  seaglint::bind_compare(module);
  seaglint::bind_train(module);
  seaglint::bind_evaluate(module);
}
