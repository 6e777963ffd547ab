// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Samples of a scenario by the other method of the solver.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// A sample by the method of its scenario and by the other one of beams and rays.
struct SampleDifference {
  std::size_t sample = 0;
  std::string target;
  SolverMethod method = SolverMethod::kBeams, other = SolverMethod::kRays;  // of the target itself
  // |H_other - H| / |H|, both root sums of squares over pulses and frequencies, dB, -300 or more.
  double response_db = 0;
  double strongest_cell_db = 0;  // level of the other map in the strongest cell of the map, less that cell's, dB
};

struct SampleCrossCheck {
  std::vector<SampleDifference> differences;  // in the order of the samples
  std::size_t points = 0;                     // samples of ideal points alone, which have no solver
  double median_response_db() const;          // of the differences; NaN without any
};

// `count` of `size` samples in the middles of equal parts of the set: (2 n + 1) size / (2 count), 0 < count <= size.
std::vector<std::size_t> evenly_spread(std::size_t count, std::size_t size);

// Cross-check of these samples of the scenario, in parallel; the result does not depend on the threads. Throws
// InputError for a target without power by one method, Interrupted when *stop becomes true.
SampleCrossCheck cross_check_samples(const Scenario& scenario, std::span<const std::size_t> samples, int threads,
                                     const StopFlag* stop = nullptr);

// Relative difference of two responses of one shape, dB, within -300 and 300; of a vanishing reference 300, unless both
// vanish.
double relative_difference_db(const FrequencyResponse& reference, const FrequencyResponse& other);

// A line for each sample under one of headings, then median and largest differences and the number of samples left out.
std::string text_of(const SampleCrossCheck& check);

}  // namespace seaglint
