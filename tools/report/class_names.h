// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names of the classes of a report.

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Names by label: dataset.classes where the scenario names them; else the names of the targets of each label in the
// scenario's order, "a, b"; of more than three "label 0" or "label 1". Plain text.
using ClassNames = std::vector<std::string>;
ClassNames class_names(const Scenario& scenario);

}  // namespace seaglint
