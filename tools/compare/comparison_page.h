// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A comparison as a self-contained page.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/compare/comparison.h"

namespace seaglint {

struct ComparisonFigure {
  std::filesystem::path file;  // empty: none
  std::string plot;            // the same for the page's script (plot_json.h); empty: the picture alone
};

// The figures that exist are embedded: curves with their differences, range profiles.
struct ComparisonFigures {
  ComparisonFigure curves, profiles;
};

std::string comparison_page(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                            const ComparisonFigures& figures);

}  // namespace seaglint
