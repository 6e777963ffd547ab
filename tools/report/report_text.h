// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Texts and tables of a report, from metrics.json.

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Access to metrics.json for the report, and tests of accuracies against chance.

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

// Names of the classes of a report, and parts of its text that name every class.

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

// Report texts on the probes, quantities that could reveal the class, and on the absolute level.

// Both return HTML, from metrics.json and the scenario's clutter and noise settings.
std::string probes_table(const nlohmann::ordered_json& metrics, const Scenario& scenario);
std::string note_of_level(const nlohmann::ordered_json& metrics, const Scenario& scenario);

// Texts and tables of a report, all from metrics.json: results, comparison with the paper's statements, expert notes.

// Each returns HTML.
std::string summary_tiles(const nlohmann::ordered_json& metrics);
std::string accuracy_tables(const nlohmann::ordered_json& metrics, const ClassNames& classes);
std::string claims_table(const nlohmann::ordered_json& metrics, const ClassNames& classes);
std::string feature_table(const nlohmann::ordered_json& metrics, const ClassNames& classes);
// expert note on the number of seas that the splits test
std::string note_of_seas(const nlohmann::ordered_json& metrics);
std::string expert_notes(const nlohmann::ordered_json& metrics, const Scenario& scenario);

// Section of a report with the result of a benchmark (tools/run), whose directory is within that of the run.

inline constexpr const char* kBenchmarkFile = "benchmark.json";

// HTML from the content of benchmark.json: accuracies of baselines and floor, in total and by wave height, and the
// claims of the paper. `report`: relative address of the benchmark's own report; no link if empty.
std::string benchmark_section(const nlohmann::ordered_json& benchmark, const std::string& report);

}  // namespace seaglint
