// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Responses of a scenario's targets, and how far two of them are apart.

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/relative_difference.h"
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
  return 20 * std::log10(std::max(relative_difference(a, b), 1e-15));
}

}  // namespace seaglint
