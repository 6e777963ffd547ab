// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Text output of a study: the accuracy table for the terminal and the numbers of metrics.json.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "classify/model/study.h"
#include "sim/scenario/learning_spec.h"

namespace seaglint {

// Table of accuracies by wave height as plain text.
std::string accuracy_table(const Study& study);

// "93.3 (88-98)": accuracy in % with its 95 % interval, if there is one; "-" without rows.
std::string percent(const Scores& scores);

// The name of a class in names of columns and members: '_' for a space.
std::string one_word(std::string class_name);
// "probability_fused"; of more than two classes "probability_fused_ship", one for each.
std::vector<std::string> probability_columns(const std::string& model, const std::vector<std::string>& classes);

// JSON objects of scores and of roc_curves(), for more than two classes by class name; undefined values are null.
nlohmann::ordered_json to_object(const Scores& scores, const std::vector<std::string>& classes);
nlohmann::ordered_json to_object(const std::vector<std::vector<RocPoint>>& curves,
                                 const std::vector<std::string>& classes);

// The study as a JSON object with the members handmade, cnn, fused, extended, probes, network; without what the scope
// of the study leaves out.
nlohmann::ordered_json to_json(const Study& study, const LearningSpec& spec);

}  // namespace seaglint
