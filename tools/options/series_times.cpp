// SPDX-License-Identifier: BSD-3-Clause
#include "tools/options/series_times.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

void add_time_options(CommandOptions& command, double& duration_s, double& step_s) {
  command.add_option("--duration-s", duration_s, "Length of the series").show_default().number_within(0, 1e6);
  command.add_option("--step-s", step_s, "Time between its rows").show_default().number_within(1e-4, 1e4);
}

std::size_t uniform_time_count(double duration_s, double step_s) {
  constexpr double kMaxCount = 1e7;
  const double steps = std::floor(duration_s / step_s + 1e-9);
  if (steps >= kMaxCount) {
    throw InputError(fmt::format("--duration-s {} with --step-s {}: {:.3g} rows: must be at most {:.0e}", duration_s,
                                 step_s, steps + 1, kMaxCount));
  }
  return static_cast<std::size_t>(steps) + 1;
}

}  // namespace seaglint
