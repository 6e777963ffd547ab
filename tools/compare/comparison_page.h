// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A comparison as a self-contained page.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/compare/comparison.h"

namespace seaglint {

// Pictures of a comparison, each embedded where there is one. They are shown in print and without scripts; elsewhere
// the page's script draws all cuts that the page has room for, by polarisation, frequency and angle.
struct ComparisonFigures {
  std::filesystem::path curves;                   // comparison_plots()
  std::vector<std::filesystem::path> images;      // comparison_images()
  std::filesystem::path profiles;                 // range_profile_plots()
  std::string profiles_plot;                      // the same for the page's script (plot_json())
  std::vector<std::filesystem::path> turntables;  // turntable_pictures()
};

// The verdicts, curves and images, statistics, largest differences, what was fitted and how the files were read. A few
// MB at most, whatever the number of cuts.
std::string comparison_page(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                            const ComparisonFigures& figures);

}  // namespace seaglint
