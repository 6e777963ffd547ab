// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Numbers of metrics.json as the report reads them, and what is chance among them.

#include <nlohmann/json.hpp>
#include <string>

namespace seaglint {

double value_or_nan(const nlohmann::ordered_json& json);  // JSON has no NaN: what is not defined is null

std::string percent(double share);  // "93.3 %", a dash for NaN
// "93.3 % (88–98)" in HTML, with the interval where there is one
std::string accuracy_cell(const nlohmann::ordered_json& scores);

// What a probe reaches on unseen seas; NaN where there is none of this name.
double probe_accuracy(const nlohmann::ordered_json& metrics, const std::string& name);

// What knowing nothing but the classes' shares reaches: from guessing at those shares to naming the larger class
// always.
struct Guessing {
  double least = 0.5, most = 0.5;

  std::string text() const;  // in per cent
};
Guessing guessing(const nlohmann::ordered_json& scores);  // of the rows tested, by their confusion

// Whether a probe of the metrics is compatible with guessing under both protocols. What is random by construction is
// independent from map to map: the 99 % binomial interval of one split's rows (repeats reuse the same maps). Anything
// else goes by its bootstrap over seas.
bool as_chance(const nlohmann::ordered_json& metrics, const nlohmann::ordered_json& probe);

}  // namespace seaglint
