// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/value_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/numbers/quantile.h"

namespace seaglint {

bool ValueRange::excludes(double value) const {
  if (std::isnan(value)) return !has_undefined;
  const double margin = 1e-3 * std::max(std::abs(lowest), std::abs(highest));
  return !(value >= lowest - margin && value <= highest + margin);
}

ValueRange range_of(const ColumnOfRows& column, std::span<const std::size_t> rows, std::span<const int> labels,
                    std::size_t classes) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  ValueRange range{column.name, column.unit, kNan, kNan, {}};
  std::vector<std::vector<double>> by_label(classes);
  for (const std::size_t row : rows) {
    const double value = column.numbers[row];
    if (std::isnan(value)) {
      range.has_undefined = true;
      continue;
    }
    range.lowest = std::fmin(range.lowest, value);
    range.highest = std::fmax(range.highest, value);
    by_label[static_cast<std::size_t>(labels[row])].push_back(value);
  }
  for (std::vector<double>& values : by_label) {
    std::sort(values.begin(), values.end());
    range.by_label.push_back({quantile(values, 0.05), quantile(values, 0.5), quantile(values, 0.95)});
  }
  return range;
}

std::vector<std::string> condition_names(std::span<const std::string> features) {
  // A time is no condition, and the features do not depend on the absolute level.
  static const std::vector<std::string> kOthers{"start_s", "peak_m", "energy_m2"};
  const auto is_in = [](const auto& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> names;
  for (const SampleColumn& column : sample_columns()) {
    const bool is_real = std::holds_alternative<double SampleRecord::*>(column.member);
    const std::string name = column.name;
    if ((is_real || name == "centres") && !is_in(kOthers, name) && !is_in(features, name)) names.push_back(name);
  }
  return names;
}

}  // namespace seaglint
