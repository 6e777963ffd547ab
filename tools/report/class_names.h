// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names of the two classes of a report.

#include <array>
#include <string>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Names of label 0 and label 1: the names of their targets in the scenario's order, "a, b"; of more than three
// "label 0" or "label 1". Plain text.
using ClassNames = std::array<std::string, 2>;
ClassNames class_names(const Scenario& scenario);

}  // namespace seaglint
