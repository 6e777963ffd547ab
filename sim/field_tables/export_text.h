// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The text of exported files: lines with their numbers, the first rows by which formats are recognised, the units of
// areas and fields, and what the names of files say.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/core/text/text_source.h"
#include "sim/core/text/text_table.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// Goes through a text line by line; every error names the place.
class LineReader {
 public:
  explicit LineReader(const TextSource& source) : source_(source), rest_(source.text()) {}

  // Goes to the next line that is not empty; false at the end.
  bool advance();
  // The same; throws InputError "ends before WANTED" at the end.
  std::string_view next(std::string_view wanted);
  // Goes to the next line that begins so.
  void seek(std::string_view beginning);

  std::string_view line() const { return line_; }  // without blanks at its ends
  int number() const { return number_; }           // of the line, from 1

  // The finite numbers of the present line, which has exactly N of them, separated by blanks.
  template <std::size_t N>
  std::array<double, N> numbers(std::string_view what) const {
    std::array<double, N> values{};
    parse(what, values.data(), N);
    return values;
  }
  // A number of the present line as a count from 1 to 1e8.
  std::size_t count(std::string_view what, double value) const;
  // Throws InputError at the present line.
  [[noreturn]] void fail(const std::string& what) const { source_.fail(line_, what); }

 private:
  void parse(std::string_view what, double* values, std::size_t count) const;

  const TextSource& source_;
  std::string_view rest_, line_;
  int number_ = 0;
};

// Whether one of the first 20 lines that are neither empty nor comments is such a line.
template <class Is>
bool any_first_line(const TextSource& source, Is is) {
  LineReader lines(source);
  for (int n = 0; n < 20 && lines.advance();) {
    if (is_comment(lines.line())) continue;
    ++n;
    if (is(lines.line())) return true;
  }
  return false;
}

// A row at the beginning of a text, cut at one separator.
struct FirstRow {
  std::vector<std::string_view> cells;
  std::vector<std::string> keys;  // column_key() of each

  bool has(std::string_view key) const;
};

// Rows that begin in the first 20 lines that are neither empty nor comments, or that are comments, cut at each
// separator in turn.
std::vector<FirstRow> first_rows(const TextSource& source, bool in_comments = false);

// Whether one of them is such a row.
template <class Is>
bool any_first_row(const TextSource& source, Is is) {
  for (const FirstRow& row : first_rows(source)) {
    if (is(row)) return true;
  }
  return false;
}

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

// `farfield (f = 9.5), theta = (0,180,0.1), phi = (0,270,90), HP (1) [pw].txt` (CST): the frequency in its unit or else
// in GHz, the polarisation transmitted (HP phi^, VP theta^), and a sweep of the incident wave, which is that of a
// monostatic cut; single angles are those of the incident wave. `ref_rcs.H.txt` (Austin RCS Benchmark Suite): hh, with
// V vv.
struct NameFacts {
  std::optional<double> frequency_hz;
  std::optional<bool> transmits_v;
  std::optional<Polarisation> element;
  std::optional<DeclaredTransmitter> transmitter;
};
NameFacts facts_of_name(const std::string& name);

// The text after `word =` in a name, where `word` stands by itself and in any case; nullopt without it.
std::optional<std::string_view> value_in_name(std::string_view name, std::string_view word);
// The number at the front of a text; nullopt without one.
std::optional<double> leading_number(std::string_view text);
// Whether the word stands in a name by itself, in any case.
bool has_word(std::string_view name, std::string_view word);
// Hz in Hz, kHz, MHz, GHz, THz in any case; nullopt for another unit.
std::optional<double> frequency_unit_hz(std::string_view unit);
// Hz of `9.5 GHz`, without a unit in GHz; nullopt unless it is a number above 0.
std::optional<double> frequency_in_name(std::string_view text);

// Settings completed by the name's facts; `notes` gets a sentence for each fact that is used.
FieldTableSettings completed(FieldTableSettings settings, const NameFacts& facts, std::vector<std::string>& notes);

}  // namespace seaglint
