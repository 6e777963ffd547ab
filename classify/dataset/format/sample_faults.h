// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Faults of a stored sample that are found without its scenario.

#include <string>
#include <vector>

#include "classify/dataset/format/sample.h"

namespace seaglint {

// What is wrong with the numbers of a sample, one sentence each: values of the map that are no magnitudes (negative or
// not finite), a peak or an energy that is not the map's, complex values whose magnitudes are not the map's, scattering
// centres and columns that are not finite (ratios to clutter or noise are NaN where there is none).
std::vector<std::string> sample_faults(const Sample& sample);

}  // namespace seaglint
