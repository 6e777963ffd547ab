// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Quartiles of the features by class, wave height and aspect: what the report's text and figures argue with.

#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "tools/report/report_data.h"

namespace seaglint {

// Lower quartile, median, upper quartile of the finite values (linear interpolation); NaN without values.
struct Quartiles {
  double lower = 0;
  double median = 0;
  double upper = 0;
};
Quartiles quartiles(std::vector<double> values);

// Which rows count: nothing given means all.
struct RowFilter {
  std::optional<int> label;
  std::optional<double> wave_height_m;
  std::optional<double> azimuth_deg;
};

Quartiles quartiles_of(const ReportData& data, const RowFilter& filter,
                       const std::function<double(const ReportRow&)>& value);

std::vector<double> wave_heights_m(const ReportData& data);  // ascending, once each
std::vector<double> azimuths_deg(const ReportData& data);

// The numbers of the report that are not in the study: features by class and wave height, the line by aspect, the maps
// shown.
nlohmann::ordered_json report_numbers(const ReportData& data);

}  // namespace seaglint
