// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Wave spectrum read from a file of this or another program.

#include <filesystem>
#include <string>
#include <vector>

namespace seaglint {

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
SpectrumTable read_spectrum_table(const std::filesystem::path& file, const std::string& time = "");
SpectrumTable parse_spectrum_table(const std::string& text, const std::string& file_name, const std::string& time = "");

}  // namespace seaglint
