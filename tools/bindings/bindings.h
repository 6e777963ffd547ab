// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The parts of the Python module seaglint._core; the package beside them gives these functions their names, checks and
// documentation (tools/bindings/seaglint).

#include <pybind11/pybind11.h>

namespace seaglint {

void bind_scenario(pybind11::module_& module);  // Scenario
void bind_mesh(pybind11::module_& module);      // Mesh
void bind_rcs(pybind11::module_& module);       // rcs
void bind_sample(pybind11::module_& module);    // Pipeline
void bind_series(pybind11::module_& module);    // sea, motion
void bind_compare(pybind11::module_& module);   // Exports, compare
void bind_train(pybind11::module_& module);     // train
void bind_evaluate(pybind11::module_& module);  // evaluate

}  // namespace seaglint
