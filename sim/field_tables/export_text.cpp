// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/export_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

bool LineReader::advance() {
  while (!rest_.empty()) {
    const std::string_view line = trimmed(next_line(rest_));
    ++number_;
    if (line.empty()) continue;
    line_ = line;
    return true;
  }
  return false;
}

std::string_view LineReader::next(std::string_view wanted) {
  if (!advance()) throw InputError(fmt::format("{}:{}: ends before {}", source_.name(), number_, wanted));
  return line_;
}

void LineReader::seek(std::string_view beginning) {
  const std::string wanted = fmt::format("a line '{}'", beginning);
  while (!next(wanted).starts_with(beginning)) {
  }
}

std::size_t LineReader::count(std::string_view what, double value) const {
  if (value < 1 || value > 1e8 || value != std::floor(value))
    fail(fmt::format("{}: must be a whole number from 1 to 1e8", what));
  return static_cast<std::size_t>(value);
}

void LineReader::parse(std::string_view what, double* values, std::size_t count) const {
  std::string_view words = line_;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view word = next_word(words);
    const std::optional<double> value = parse_written_number(word);
    if (!value || !std::isfinite(*value)) {
      source_.fail(word.empty() ? line_ : word,
                   fmt::format("{}: must be {} finite number{}", what, count, count == 1 ? "" : "s"));
    }
    values[i] = *value;
  }
  if (!trimmed(words).empty())
    source_.fail(trimmed(words), fmt::format("{}: must be {} number{}", what, count, count == 1 ? "" : "s"));
}

bool FirstRow::has(std::string_view key) const { return std::find(keys.begin(), keys.end(), key) != keys.end(); }

std::vector<FirstRow> first_rows(const TextSource& source, bool in_comments) {
  constexpr int kMaxLines = 20;
  std::vector<FirstRow> rows;
  std::string_view rest = source.text();
  for (int n = 0; n < kMaxLines && !rest.empty();) {
    std::string_view text = rest;
    const std::string_view line = next_line(rest);
    if (trimmed(line).empty() || is_comment(line) != in_comments) continue;
    ++n;
    if (in_comments) text = line.substr(std::min(line.find_first_not_of(" \t#%/!"), line.size()));
    for (const char separator : kSeparators) {
      std::string_view row = text;
      FirstRow first{next_row(row, separator).cells, {}};
      for (const std::string_view cell : first.cells) first.keys.push_back(column_key(cell));
      rows.push_back(std::move(first));
    }
  }
  return rows;
}

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

namespace {

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Place of a word that stands by itself, in any case; npos if it does not.
std::size_t find_word(std::string_view text, std::string_view word) {
  const std::string in = lower_case(text), wanted = lower_case(word);
  for (std::size_t at = in.find(wanted); at != std::string::npos; at = in.find(wanted, at + 1)) {
    const std::size_t end = at + wanted.size();
    if ((at == 0 || !is_word_character(in[at - 1])) && (end == in.size() || !is_word_character(in[end]))) return at;
  }
  return std::string_view::npos;
}

}  // namespace

std::optional<std::string_view> value_in_name(std::string_view name, std::string_view word) {
  const std::size_t at = find_word(name, word);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = trimmed(name.substr(at + word.size()));
  if (!rest.starts_with('=')) return std::nullopt;
  return trimmed(rest.substr(1));
}

std::optional<double> leading_number(std::string_view text) {
  return parse_number(text.substr(0, std::min(text.find_first_not_of("+-.0123456789eE"), text.size())));
}

bool has_word(std::string_view name, std::string_view word) { return find_word(name, word) != std::string_view::npos; }

std::optional<double> frequency_unit_hz(std::string_view unit) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"ghz", 1e9}, {"mhz", 1e6}, {"khz", 1e3}, {"thz", 1e12}, {"hz", 1}};
  for (const auto& [name, hz] : kUnits) {
    if (lower_case(unit) == name) return hz;
  }
  return std::nullopt;
}

std::optional<double> frequency_in_name(std::string_view text) {
  const std::size_t digits = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
  const std::optional<double> value = parse_number(text.substr(0, digits));
  if (!value || *value <= 0) return std::nullopt;
  const std::string_view unit = trimmed(text.substr(digits));
  const std::optional<double> of_two = frequency_unit_hz(unit.substr(0, 2));
  return *value * (of_two ? *of_two : frequency_unit_hz(unit.substr(0, 3)).value_or(1e9));
}

NameFacts facts_of_name(const std::string& name) {
  NameFacts facts;
  for (const char* word : {"f", "frequency", "freq"}) {
    const std::optional<std::string_view> text = value_in_name(name, word);
    if (text && !facts.frequency_hz) facts.frequency_hz = frequency_in_name(*text);
  }
  const bool horizontal = has_word(name, "HP"), vertical = has_word(name, "VP");
  if (horizontal != vertical) facts.transmits_v = vertical;
  const bool h = name.find(".H.") != std::string::npos, v = name.find(".V.") != std::string::npos;
  if (h != v) facts.element = v ? Polarisation::kVv : Polarisation::kHh;
  const std::optional<std::string_view> theta = value_in_name(name, "theta"), phi = value_in_name(name, "phi");
  if (theta && phi) {
    const std::optional<double> theta_deg = leading_number(*theta), phi_deg = leading_number(*phi);
    if (theta->starts_with('(') || phi->starts_with('(')) {
      facts.transmitter.emplace();
    } else if (theta_deg && phi_deg) {
      facts.transmitter = DeclaredTransmitter{false, *theta_deg, *phi_deg};
      fold_direction(facts.transmitter->theta_deg, facts.transmitter->phi_deg);
    }
  }
  return facts;
}

FieldTableSettings completed(FieldTableSettings settings, const NameFacts& facts, std::vector<std::string>& notes) {
  if (!settings.frequency_hz && facts.frequency_hz) {
    settings.frequency_hz = facts.frequency_hz;
    notes.push_back(fmt::format("frequency {:g} GHz by the file's name", *facts.frequency_hz * 1e-9));
  }
  if (!settings.transmitter && facts.transmitter) {
    settings.transmitter = facts.transmitter;
    notes.push_back(facts.transmitter->is_monostatic
                        ? "monostatic: the file's name has a sweep of the incident wave"
                        : fmt::format("incident wave from theta {:g} deg, phi {:g} deg by the file's name",
                                      facts.transmitter->theta_deg, facts.transmitter->phi_deg));
  }
  if (settings.elements.empty() && facts.element) {
    settings.elements = {*facts.element};
    notes.push_back(fmt::format("{} by the file's name", kPolarisationNames[static_cast<int>(*facts.element)]));
  } else if (settings.elements.empty() && facts.transmits_v) {
    settings.elements = {element_of(true, *facts.transmits_v), element_of(false, *facts.transmits_v)};
    notes.emplace_back(*facts.transmits_v ? "VP in the file's name: v transmitted"
                                          : "HP in the file's name: h transmitted");
  }
  return settings;
}

}  // namespace seaglint
