// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A comparison as a self-contained page.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/compare/comparison.h"

namespace seaglint {

// The figures that exist are embedded: curves with their differences, range profiles.
struct ComparisonFigures {
  std::filesystem::path curves, profiles;  // empty: none
  std::string live_curves, live_profiles;  // the same for a browser (live_plot.h); empty: the pictures alone
};

std::string comparison_page(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                            const ComparisonFigures& figures);

}  // namespace seaglint
