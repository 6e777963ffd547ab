// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Accuracy over wave height and receiver operating characteristics, from metrics.json.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "tools/figure/figure.h"

namespace seaglint {

// Accuracy of the three groups of features under a protocol (random, group), %, with 95 % intervals.
LinePlot accuracy_plot(const nlohmann::ordered_json& metrics, const std::string& protocol);

// Detections over false alarms, %; none for the metrics of an earlier version, which have no curves.
std::optional<LinePlot> roc_plot(const nlohmann::ordered_json& metrics, const std::string& protocol);

}  // namespace seaglint
