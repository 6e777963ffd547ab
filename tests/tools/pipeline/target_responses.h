// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Responses of a scenario's targets, and how far two of them are apart.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/pipeline/pipeline.h"

namespace seaglint {

// H of a target in the first interval of the scenario.
inline std::vector<Complex> response_of(const Pipeline& pipeline, int target) {
  SampleAddress at;
  at.target = target;
  return pipeline.response(at, pipeline.pulse_train(0)).response.values;
}

// Relative L2 difference of a from b, dB; at least -300.
inline double relative_difference_db(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  double difference = 0, power = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += std::norm(a[i] - b[i]);
    power += std::norm(b[i]);
  }
  return 10 * std::log10(std::max(difference / power, 1e-30));
}

}  // namespace seaglint
