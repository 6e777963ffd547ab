// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A cross-check of two methods as a table and as text.

#include <span>
#include <string>

#include "tools/cross_check/rcs_cross_check.h"

namespace seaglint {

// CSV of all rows, elevation slowest, then azimuth, then element, after rcs_heading().
std::string cross_check_table(const RcsRequest& request, const RcsTarget& target, const CrossCheck& check,
                              std::span<const std::string> warnings = {});

// All rows for a terminal, a line each under one of headings, then the figures of summary_of() with the rows it names.
std::string cross_check_text(const CrossCheck& check, const RcsTarget& target);

}  // namespace seaglint
