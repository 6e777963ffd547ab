// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Quartiles of the features by class, wave height and aspect, for the report's text and figures.

#include <array>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "sim/core/numbers/quantile.h"
#include "tools/report/report_data.h"

namespace seaglint {

// Selects rows; an absent member selects all.
struct RowFilter {
  std::optional<int> label;
  std::optional<double> wave_height_m;
  std::optional<double> azimuth_deg;
};

Quartiles quartiles_of(const ReportData& data, const RowFilter& filter,
                       const std::function<double(const ReportRow&)>& value);

std::vector<double> wave_heights_m(const ReportData& data);  // ascending, unique
std::vector<double> azimuths_deg(const ReportData& data);

// Numbers of the report beyond the study: features by class and wave height, line fit by aspect, maps shown.
nlohmann::ordered_json report_numbers(const ReportData& data);

}  // namespace seaglint
