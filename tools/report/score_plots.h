// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Accuracy over wave height and receiver operating characteristics, from metrics.json.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/figure/figure.h"

namespace seaglint {

// Accuracy of the three groups of features under a protocol (random, group), %, with 95 % intervals.
LinePlot accuracy_plot(const nlohmann::ordered_json& metrics, const std::string& protocol);

// The same under the group protocol over the drawn keys of numbers, by key: over the means of their bins.
std::vector<std::pair<std::string, LinePlot>> drawn_accuracy_plots(const nlohmann::ordered_json& metrics);

// Detections over false alarms of the fused features under the group protocol, %, a curve for each bin of the wave
// height; none of more than two classes, and with one bin.
std::optional<LinePlot> roc_by_wave_height_plot(const nlohmann::ordered_json& metrics);

// Detections over false alarms, %.
LinePlot roc_plot(const nlohmann::ordered_json& metrics, const std::string& protocol);

}  // namespace seaglint
