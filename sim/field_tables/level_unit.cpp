// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/level_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/text/shown.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {
namespace {

// Without dB( ): m^2 of dB(m^2), dBm^2 and dBsm.
std::string without_decibel(const std::string& unit) {
  if (unit == "dBsm") return "m^2";
  if (unit.size() > 4 && unit[2] == '(' && unit.back() == ')') return unit.substr(3, unit.size() - 4);
  return unit.substr(2);
}

}  // namespace

std::string squeezed(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c != ' ' && c != '\t') out += c;
  }
  return out;
}

LevelUnit::LevelUnit(const TextSource& source, std::string_view header, std::string_view column, std::string_view text,
                     double wavelength_m) {
  const std::string unit = squeezed(text);
  decibel_ = unit.starts_with("dB");
  if (unit == "dB") {
    source.fail(header, fmt::format("column {} [dB] is relative to its own maximum: export absolute values, m^2 or "
                                    "dB(m^2)",
                                    shown(column)));
  }
  const std::string area = decibel_ ? without_decibel(unit) : unit;
  is_field_ = area == "V/m";
  if (area == "m^2") {
    offset_db_ = 0;
  } else if (area == "cm^2") {
    offset_db_ = -40;
  } else if (area == "mm^2") {
    offset_db_ = -60;
  } else if (area == "lambda^2") {
    offset_db_ = 20 * std::log10(wavelength_m);
  } else if (is_field_) {
    offset_db_ = 10 * std::log10(4 * kPi);
  } else {
    source.fail(header,
                fmt::format("column {} [{}]: the unit must be m^2, cm^2, mm^2, lambda^2, V/m, or dB() of one of "
                            "them",
                            shown(column), shown(unit)));
  }
}

double LevelUnit::level_dbsm(const TextTable& table, std::size_t row, std::size_t column) const {
  if (decibel_) return std::max(table.level(row, column) + offset_db_, kMinLevel_dbsm);
  const double value = table.number(row, column, 0);
  const double power_db = 10 * std::log10(std::max(value, 1e-300)) * (is_field_ ? 2 : 1);
  return std::max(power_db + offset_db_, kMinLevel_dbsm);
}

}  // namespace seaglint
