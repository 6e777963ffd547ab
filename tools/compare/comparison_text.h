// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A comparison in two sentences, as a table, as JSON and as CSV.

#include <string>
#include <vector>

#include "tools/compare/comparison.h"

namespace seaglint {

// "seaglint solved with flat facets, no edge diffraction, ...", empty for tables.
std::string solver_text(const std::vector<ExportComparison>& comparisons);

// "The RCS computed by seaglint agrees with ship.ffe within 0.3 dB in hh and 0.5 dB in vv at 90 % of the 181 angles,
// phases included (correlation 0.997). The differences lie mainly at azimuth 40 to 52 deg (81 % of their squared sum),
// where part mast, 2 bounces, po contributes most.": how far they agree, then why not, by what is most certain: a mesh
// in another unit, exact values of the target, other settings, an offset, where the differences are. Of an export with
// an element.
std::string verdict(const ExportComparison& comparison);

// For the terminal: the verdicts, one line per export and element, then known values, how each was fitted and its
// warnings.
std::string comparison_table(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings);

// The content of compare.json:
// {"version", "settings", "exports": [{"name", "reader", "convention", "compared", "polarisation", "summary", "pairs",
// "bias_db", "mean_abs_db", "rms_db", "p90_db", "p95_db", "correlation", "fitted": {"phase_deg", "origin_m",
// "origin_error_m", "undetermined", "conjugated", "sign", "offset_db"}, "lobes", "nulls", "worst", "solver": {"like",
// "crease_deg", "edges", "max_bounces", "method"}, "known": {"body", "value", "pairs", "export_bias_db",
// "export_rms_db", "compared_bias_db", "compared_rms_db", "own_error_db", "verdict", "levels"}, "trials", "warnings",
// "interpolation"}]}: one entry per export and polarisation; null where there is no phase, nothing solved, known or
// interpolated.
std::string comparison_json(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings);

// One row per pair: file, line, polarisation, frequency, direction, both levels, their difference, and both amplitudes
// where they have phases (the export's in the fitted phase). A last column known_dbsm where any target is recognised.
std::string comparison_csv(const std::vector<ExportComparison>& comparisons, int threads);

}  // namespace seaglint
