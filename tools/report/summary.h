// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Quartiles of the features by class, wave height and aspect, for the report's text and figures.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "sim/core/numbers/quantile.h"
#include "tools/report/report_data.h"

namespace seaglint {

// Selects rows; an absent member selects all. Bins are those of `heights` and `azimuths` of the data.
struct RowFilter {
  std::optional<int> label;
  const ColumnBin* height = nullptr;
  const ColumnBin* azimuth = nullptr;
};

Quartiles quartiles_of(const ReportData& data, const RowFilter& filter,
                       const std::function<double(const ReportRow&)>& value);

// Numbers of the report beyond the study: features by class and wave height, line fit by aspect, maps shown.
nlohmann::ordered_json report_numbers(const ReportData& data);

}  // namespace seaglint
