// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names of the classes of a report, and parts of its text that name every class.

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Names by label: dataset.classes where the scenario names them; else the names of the targets of each label in the
// scenario's order, "a, b"; of more than three "label 0" or "label 1". Plain text.
using ClassNames = std::vector<std::string>;
ClassNames class_names(const Scenario& scenario);

// Rows of a truth with a decision, from the confusion of an entry of metrics.json with this number of classes.
std::size_t confused(const nlohmann::ordered_json& scores, std::size_t classes, std::size_t truth,
                     std::size_t decision);

// Decisions of the fused features under the group protocol by truth, as HTML.
std::string confusion_table(const nlohmann::ordered_json& metrics, const ClassNames& classes);

// "0.1 (ship) and 0.2 (array)", from the last label to the first; names as HTML.
std::string by_class(const ClassNames& classes, const std::function<std::string(int label)>& value);

}  // namespace seaglint
