// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scatter diagram: how often sea states of each wave height and period occur.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/numbers/random.h"

namespace seaglint {

// Wave heights and periods of one cell, and how often they occur.
struct ScatterCell {
  double lowest_height_m = 0, highest_height_m = 0;
  double lowest_period_s = 0, highest_period_s = 0;
  double count = 0;  // > 0, in any unit
};

struct SeaPair {
  double significant_wave_height_m = 0;
  double period_s = 0;
};

struct ScatterDiagram {
  std::string period_key;          // key of `sea` whose values the periods are: "peak_period_s"
  std::vector<ScatterCell> cells;  // with counts, by height and then by period; at least one

  std::size_t excluded_cells = 0;  // cells with counts that exclude_cells() has removed
  double excluded_fraction = 0;    // their part of all counts

  double count() const;
  // A cell by the frequency of its count, and a point within it, uniform over both intervals; heights of at least
  // 1e-6 m.
  SeaPair draw(Random& random) const;
  // Centre of the cell with the highest count, the first of equal ones.
  SeaPair likeliest() const;
};

// Removes the cells of numbers i with is_excluded[i].
void exclude_cells(ScatterDiagram& diagram, const std::vector<bool>& is_excluded);

// Reads a table of counts in one of two layouts, with any separator and comments (sim/core/text/text_table.h):
//   wave heights in the first column and periods in the first row, or the reverse; the first cell names both, rows
//   first ("Hs/Tp", "significant_wave_height_m \ peak_period_s"); rows and columns named sum or total are left out;
//   or the columns significant_wave_height_m (hs_m), peak_period_s (tp_s) and count.
// Heights and periods are centres of equal cells, or cells LOW-HIGH. Empty cells count 0. Throws InputError
// "file:line:column: what" for anything else, cells below 0, pairs that appear twice, and counts that are all 0.
ScatterDiagram read_scatter_diagram(const std::filesystem::path& file);
ScatterDiagram parse_scatter_diagram(const std::string& text, const std::string& file_name);

}  // namespace seaglint
