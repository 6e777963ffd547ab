// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/sample_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <variant>

namespace seaglint {

namespace {

// Relative tolerance: peak, energy and magnitude are computed before map and complex values are rounded to single
// precision (6e-8 each).
constexpr double kSinglePrecision = 1e-6;
constexpr double kSmallest = std::numeric_limits<float>::min();  // m; rounding of smaller values is not relative

bool differ(double a, double b, double smallest) {
  return !(std::abs(a - b) <= std::max(smallest, kSinglePrecision * std::max(std::abs(a), std::abs(b))));
}

void check_columns(const SampleRecord& record, std::vector<std::string>& faults) {
  for (const SampleColumn& column : sample_columns()) {
    const auto* member = std::get_if<double SampleRecord::*>(&column.member);
    if (member == nullptr) continue;
    const double value = record.*(*member);
    const std::string_view name = column.name;
    const bool may_be_missing = name.starts_with("scr_") || name.starts_with("snr_");
    if (!std::isfinite(value) && !(may_be_missing && std::isnan(value)))
      faults.push_back(fmt::format("{} {} is not finite", name, value));
  }
  for (const auto& [key, value] : record.drawn_numbers)
    if (!std::isfinite(value)) faults.push_back(fmt::format("{} {} is not finite", key, value));
}

void check_echo(const Sample& sample, std::vector<std::string>& faults) {
  if (!std::all_of(sample.echo.begin(), sample.echo.end(), [](double value) { return std::isfinite(value); }))
    faults.emplace_back("a value of the echo is not finite");
}

// Peak and energy only if every value is a magnitude.
void check_map(const Sample& sample, std::vector<std::string>& faults) {
  double peak = 0, energy = 0;
  for (const float value : sample.magnitude) {
    if (!std::isfinite(value) || value < 0) {
      faults.push_back(fmt::format("{} in the map is no magnitude", value));
      return;
    }
    peak = std::max<double>(peak, value);
    energy += static_cast<double>(value) * value;
  }
  if (differ(peak, sample.record.peak_m, kSmallest))
    faults.push_back(fmt::format("peak_m {:.9g}, the map's {:.9g}", sample.record.peak_m, peak));
  if (differ(energy, sample.record.energy_m2, kSmallest * kSmallest))
    faults.push_back(fmt::format("energy_m2 {:.9g}, the map's {:.9g}", sample.record.energy_m2, energy));
  for (std::size_t i = 0; 2 * i + 1 < sample.complex_values.size(); ++i) {
    const double magnitude = std::hypot(static_cast<double>(sample.complex_values[2 * i]),
                                        static_cast<double>(sample.complex_values[2 * i + 1]));
    if (differ(magnitude, sample.magnitude[i], kSmallest)) {
      faults.push_back(fmt::format("complex value of magnitude {:.9g}, the map's {:.9g}", magnitude,
                                   static_cast<double>(sample.magnitude[i])));
      return;
    }
  }
}

}  // namespace

std::vector<std::string> sample_faults(const Sample& sample) {
  std::vector<std::string> faults;
  check_map(sample, faults);
  check_echo(sample, faults);
  check_columns(sample.record, faults);
  for (const StoredCentre& centre : sample.centre_list) {
    const auto finite = [](float value) { return std::isfinite(value); };
    if (std::all_of(centre.begin(), centre.end(), finite)) continue;
    faults.push_back(
        fmt::format("scattering centre at {} m, {} m/s, {} m is not finite", centre[0], centre[1], centre[2]));
    break;
  }
  return faults;
}

}  // namespace seaglint
