// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/frequency_response.h"

#include <fmt/format.h>

#include "sim/core/process/error.h"

namespace seaglint {

FrequencyResponse& operator+=(FrequencyResponse& sum, const FrequencyResponse& term) {
  SEAGLINT_CHECK(sum.pulses == term.pulses && sum.frequencies_per_pulse == term.frequencies_per_pulse &&
                     sum.values.size() == term.values.size(),
                 fmt::format("{} x {} against {} x {}", sum.pulses, sum.frequencies_per_pulse, term.pulses,
                             term.frequencies_per_pulse));
  for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += term.values[i];
  return sum;
}

}  // namespace seaglint
