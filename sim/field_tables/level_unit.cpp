// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/level_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/text/shown.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {
namespace {

// Without dB( ): m^2 of dB(m^2), dBm^2 and dBsm.
std::string without_decibel(const std::string& unit) {
  if (unit == "dBsm" || unit == "dBsqm") return "m^2";
  if (unit.size() > 4 && unit[2] == '(' && unit.back() == ')') return unit.substr(3, unit.size() - 4);
  return unit.substr(2);
}

// Square metres in a unit of area; nullopt for another unit.
std::optional<double> area_unit_m2(std::string_view unit) {
  if (unit == "sqm") return 1;
  for (const std::string_view square : {"**2", "^2", "\xc2\xb2", "2"}) {
    if (!unit.ends_with(square)) continue;
    const std::optional<double> side_m = length_unit_m(unit.substr(0, unit.size() - square.size()));
    return side_m ? std::optional(*side_m * *side_m) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> length_unit_m(std::string_view unit) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"m", 1},     {"meter", 1}, {"metre", 1}, {"meters", 1},  {"metres", 1},  {"mm", 1e-3},    {"cm", 1e-2},
      {"dm", 1e-1}, {"km", 1e3},  {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}, {"mil", 2.54e-5}};
  for (const auto& [name, metres] : kUnits) {
    if (unit == name) return metres;
  }
  return std::nullopt;
}

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
  if (const std::optional<double> m2 = area_unit_m2(area)) {
    offset_db_ = 10 * std::log10(*m2);
  } else if (area == "lambda^2" && wavelength_m > 0) {
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
