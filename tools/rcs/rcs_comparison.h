// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Differences of a computed sweep from a reference: error statistics, figure.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/figure/figure.h"
#include "tools/rcs/paired_cut.h"

namespace seaglint {

struct Difference {
  std::size_t points = 0;
  double mean_db = 0;  // of |computed - reference|
  double rms_db = 0;
  double largest_db = 0;               // with its sign
  double largest_at = 0;               // x there
  double bias_db = 0;                  // mean of computed - reference
  std::optional<Complex> correlation;  // <conj(reference) computed> / (|reference| |computed|)
};

// Sums the differences of pairs of values.
class DifferenceSum {
 public:
  // Both levels are raised to at least floor_dbsm; x is where they stand. Returns computed - reference, dB.
  double add(double computed_dbsm, double reference_dbsm, double floor_dbsm, double x);
  void add_phases(const Complex& computed, const Complex& reference);
  Difference difference() const;  // of at least one pair

 private:
  Difference sums_;
  Complex product_ = 0;
  double computed_power_ = 0, reference_power_ = 0;
};

// Statistics after levels of both are raised to at least floor_db below the reference maximum (error measure of the
// Austin suite, with 80 dB).
Difference error_statistics(const PairedCut& cut, const PairedCut::Model& model, double floor_db);

// Text table with one line per cut and model.
std::string error_table(const std::vector<PairedCut>& cuts, double floor_db);

// Levels above and differences below, one column per frequency and polarisation, at most four; the area between the
// last model and flat facets is filled. Empty if no cut has an axis to draw along.
PlotPanels comparison_plots(const std::vector<PairedCut>& cuts, double floor_db);

// Draws them; false if there are none.
bool draw_comparison(const std::vector<PairedCut>& cuts, double floor_db, const std::string& title,
                     const std::filesystem::path& file);

}  // namespace seaglint
