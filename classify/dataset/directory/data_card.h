// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The data card (README.md) of a data set: content, generation, reading, limitations.

#include <string>

#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/sample.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// `plan`: of the scenario.
std::string data_card(const Scenario& scenario, const SamplePlan& plan, const Manifest& manifest,
                      const StoredAxes& axes);

}  // namespace seaglint
