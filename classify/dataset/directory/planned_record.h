// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a sample's row says before anything is measured: which sea, view, target and interval it shows, and its label.

#include "classify/dataset/format/sample.h"
#include "sim/scenario/sample_plan.h"

namespace seaglint {

// The columns `sample` to `radar_key`; all measured ones are zero. sample < plan.size(), plan of the same scenario.
SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample);
// The same where the sample's address is known: finding it shuffles a realisation.
SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample,
                            const SampleAddress& address);

// "label 0, by the scenario 1" for every column of `record` that is not as planned.
std::vector<std::string> record_mismatches(const SampleRecord& record, const SampleRecord& planned);

}  // namespace seaglint
