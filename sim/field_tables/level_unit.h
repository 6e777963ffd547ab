// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Units in which programs write the radar cross section or the scattered field.

#include <optional>
#include <string>
#include <string_view>

#include "sim/core/text/text_table.h"

namespace seaglint {

// m^2, cm^2, mm^2 and the like (length_unit_m(); also m2 and meter2), lambda^2, V/m (at 1 m, of a plane wave of 1 V/m:
// sigma = 4 pi |E|^2), or decibels of them: dB(m^2), dBsm, dBm^2, dB(V/m), dBV/m.
class LevelUnit {
 public:
  // The unit with any blanks; the column's name is for the message. Throws InputError at `header` for another unit, dB
  // alone (relative to the maximum) included, and for lambda^2 without a wavelength (0).
  LevelUnit(const TextSource& source, std::string_view header, std::string_view column, std::string_view unit,
            double wavelength_m);
  // Level in dBsm of a cell, at least kMinLevel_dbsm. Throws InputError for a negative area or field.
  double level_dbsm(const TextTable& table, std::size_t row, std::size_t column) const;
  bool is_field() const { return is_field_; }

 private:
  bool decibel_ = false, is_field_ = false;
  double offset_db_ = 0;  // of one unit, dBsm
};

// Metres in a unit of length: m, meter, metre, mm, cm, dm, km, um, in, ft, mil; nullopt for another.
std::optional<double> length_unit_m(std::string_view unit);

// The text without spaces and tabs.
std::string squeezed(std::string_view text);

}  // namespace seaglint
