// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Access to metrics.json for the report, and tests of accuracies against chance.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace seaglint {

// The first confusion matrix that is not of classes x classes counts, or receiver operating characteristic whose two
// lists differ in length: "roc: 3 false_alarms, 2 detections"; "" if there is none.
std::string scores_fault(const nlohmann::ordered_json& metrics, std::size_t classes);

double value_or_nan(const nlohmann::ordered_json& json);  // JSON has no NaN: an undefined value is null

std::string percent(double fraction);  // "93.3 %", a dash for NaN
// "93.3 % (88–98)" in HTML, with the 95 % interval if there is one
std::string accuracy_cell(const nlohmann::ordered_json& scores);

// Accuracy of a probe under the group protocol; NaN if there is no probe of this name.
double probe_accuracy(const nlohmann::ordered_json& metrics, const std::string& name);

// The group protocol in words, plain text, from learning.split and `division` of metrics.json.
struct DivisionWords {
  bool by_sea = true;   // whole seas on one side
  std::string by;       // "by sea", "by azimuth_deg"
  std::string unseen;   // what is tested: "unseen seas", "values of azimuth_deg that were not trained on"
  std::string heading;  // "Split by sea realisation (no test sea was seen in training)"
};
DivisionWords division_words(const nlohmann::ordered_json& metrics);

// Accuracies reached from the class frequencies alone: from guessing in proportion to them to always naming the largest
// class.
struct Guessing {
  double least = 0.5, most = 0.5;

  std::string text() const;  // in per cent
};
Guessing guessing(
    const nlohmann::ordered_json& scores);  // for the class frequencies of the tested rows, from their confusion matrix

// True if a probe's accuracy is compatible with guessing under both protocols, or the one that it has. A probe that is
// random by construction is independent from map to map: 99 % binomial interval of one split's rows (repeats reuse the
// same maps). Any other probe: its bootstrap interval over seas; below guessing it does not tell either.
bool as_chance(const nlohmann::ordered_json& metrics, const nlohmann::ordered_json& probe);

}  // namespace seaglint
