// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Text output of a study: the accuracy table for the terminal and the numbers of metrics.json.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "classify/model/study.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

// Table of accuracies by wave height as plain text.
std::string accuracy_table(const Study& study);

// The study as a JSON object with the members handmade, cnn, fused, probes, network.
nlohmann::ordered_json to_json(const Study& study, const LearningSpec& spec);

}  // namespace seaglint
