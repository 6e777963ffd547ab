// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The data card (README.md) of a data set: content, generation, reading, limitations.

#include <string>

#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/sample.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

std::string data_card(const Scenario& scenario, const Manifest& manifest, const StoredAxes& axes);

}  // namespace seaglint
