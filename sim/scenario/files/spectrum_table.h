// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Wave spectrum read from a table.

#include <filesystem>
#include <string>
#include <vector>

namespace seaglint {

// One-sided density over angular frequency; piecewise linear, zero outside.
struct SpectrumTable {
  std::vector<double> omega;    // rad/s, ascending, > 0
  std::vector<double> density;  // m^2 s/rad, >= 0, not all zero

  double energy() const;      // the integral, m^2
  double peak_omega() const;  // frequency of the maximum density, rad/s; the first of equal maxima
};

// Reads a table (sim/core/text/text_table.h) with the columns `omega_rad_s` and `density_m2_s`, or `frequency_hz` and
// `density_m2_hz`, in any order. Throws InputError "file:line:column: what" for missing columns, what is not a finite
// number, negative frequencies and densities, frequencies that do not ascend, fewer than two rows, and a table of
// zeros.
SpectrumTable read_spectrum_table(const std::filesystem::path& file);
SpectrumTable parse_spectrum_table(const std::string& text, const std::string& file_name);

}  // namespace seaglint
