// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace seaglint {

// First difference of two texts, for users: "line 12: `seed: 43` there, `seed: 42` here".
std::string first_difference(const std::string& there, const std::string& here);

}  // namespace seaglint
