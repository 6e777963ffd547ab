// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The part of a sample's row that the scenario determines: sea, view, target, interval, keys and label.

#include <span>

#include "classify/dataset/format/drawn_columns.h"
#include "classify/dataset/format/sample.h"
#include "sim/scenario/sample_plan.h"

namespace seaglint {

// Keys that a scenario draws, in the order of their columns.
DrawnKeys drawn_keys(const Scenario& scenario);

// Fills the columns `sample` to `radar_key`; measured columns are zero. sample < plan.size(); plan of the same
// scenario.
SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample);
// The same with a known address of the sample, which saves the shuffle that finds it.
SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample,
                            const SampleAddress& address);

// The columns that planned_record() fills.
std::span<const SampleColumn> planned_columns();

// "label 0, by the scenario 1" for every column of `record` that differs from the planned value.
std::vector<std::string> record_mismatches(const SampleRecord& record, const SampleRecord& planned);

}  // namespace seaglint
