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

// "93.3 (88-98)": accuracy in % with its 95 % interval, if there is one; "-" without rows.
std::string percent(const Scores& scores);

// JSON objects of scores and of a receiver operating characteristic; undefined values are null.
nlohmann::ordered_json to_object(const Scores& scores);
nlohmann::ordered_json to_object(const std::vector<RocPoint>& curve);

// The study as a JSON object with the members handmade, cnn, fused, extended, probes, network.
nlohmann::ordered_json to_json(const Study& study, const LearningSpec& spec);

}  // namespace seaglint
