// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Input files that a scenario's keys name: wave spectra, scatter diagrams and hop codes, of this and other programs.

#include <concepts>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/text/text_source.h"

namespace seaglint {

// Contents of a file that a key names, read once and shared. Two specs are equal where their keys are: the contents are
// no part of that.
template <typename T>
struct FileContents : std::shared_ptr<const T> {
  FileContents() = default;
  template <typename U>
  FileContents(std::shared_ptr<U> read) : std::shared_ptr<const T>(std::move(read)) {}

  friend bool operator==(const FileContents&, const std::same_as<FileContents> auto&) { return true; }
};

// One-sided density over angular frequency; piecewise linear, zero outside.
struct SpectrumTable {
  std::vector<double> omega;    // rad/s, ascending, > 0
  std::vector<double> density;  // m^2 s/rad, >= 0, not all zero
  std::string reading{};        // format and units as they were understood, for users

  double energy() const;      // the integral, m^2
  double peak_omega() const;  // frequency of the maximum density, rad/s; the first of equal maxima
};

// Reads one of
// - a table (sim/core/text/text_table.h) with the columns `omega_rad_s` and `density_m2_s`, or `frequency_hz` and
//   `density_m2_hz`, in any order; `freq`, `f` and `w` for frequencies and usual names of densities are read too: with
//   units, or `f` and `S` (Hz, m^2/Hz) and `omega` and `S` (rad/s, m^2 s/rad) without;
// - a CSV file of MHKiT: an index of frequencies in Hz, a column `JONSWAP (2.5m,8.0s)`, in m^2/Hz;
// - NDBC's spectral densities, historical (`#YY MM DD hh mm .0200 .0325 ...`) or real time (`value (frequency)`);
// - a spectral file of SWAN for one location (AFREQ, VaDens or EnDens), 1-D, or 2-D integrated over its directions.
// `time` chooses one of several spectra of NDBC and SWAN: "2018-01-01 00:40", of which the digits count; empty: the
// file has one. Throws InputError "file:line:column: what" for missing columns, what is not a finite number, negative
// frequencies and densities, frequencies that do not ascend, fewer than two rows, and a table of zeros.
SpectrumTable read_spectrum_table(const TextSource& source, const std::string& time = "");

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
ScatterDiagram read_scatter_diagram(const TextSource& source);

// Whole numbers from 0 to carriers - 1 in any notation ("3", "3.", "3.000e+00"), separated by spaces, tabs, commas,
// semicolons, brackets or line ends; comments as in text_source.h, and MATLAB's captions "Columns 1 through 13". Throws
// InputError "file:line:column: what" for anything else, for fewer than `pulses` numbers, and for a count that is not a
// multiple of `pulses`; a file that counts from 1 is named.
std::vector<int> read_hop_code(const TextSource& source, int pulses, int carriers);

}  // namespace seaglint
