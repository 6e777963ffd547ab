// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A comparison as a table, as JSON, as CSV and as a self-contained page.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/compare/comparison.h"

namespace seaglint {

// "seaglint solved with flat facets, no edge diffraction, ...", empty for tables.
std::string solver_text(const std::vector<ExportComparison>& comparisons);

// For the terminal: one line per export and element, then known values, how each was fitted and its warnings.
std::string comparison_table(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings);

// The content of compare.json:
// {"version", "settings", "exports": [{"name", "reader", "convention", "compared", "polarisation", "pairs", "bias_db",
// "mean_abs_db", "rms_db", "p95_db", "correlation", "fitted": {"phase_deg", "origin_m", "origin_error_m",
// "undetermined", "conjugated", "sign", "offset_db"}, "lobes", "nulls", "worst", "solver": {"like",
// "crease_deg", "edges", "max_bounces", "method"}, "known": {"body", "value", "pairs", "export_bias_db",
// "export_rms_db", "compared_bias_db", "compared_rms_db", "own_error_db", "verdict", "levels"}, "trials", "warnings",
// "interpolation"}]}: one entry per export and polarisation; null where there is no phase, nothing solved, known or
// interpolated.
std::string comparison_json(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings);

// One row per pair: file, line, polarisation, frequency, direction, both levels, their difference, and both amplitudes
// where they have phases (the export's in the fitted phase). A last column known_dbsm where any target is recognised.
std::string comparison_csv(const std::vector<ExportComparison>& comparisons, int threads);

struct ComparisonFigure {
  std::filesystem::path file;  // empty: none
  std::string plot;            // the same for the page's script (plot_json()); empty: the picture alone
};

// The figures that exist are embedded: curves with their differences, range profiles.
struct ComparisonFigures {
  ComparisonFigure curves, profiles;
};

std::string comparison_page(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                            const ComparisonFigures& figures);

}  // namespace seaglint
