// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The one reader of text tables: separators, decimal commas, quotes, units and comments as the text has them, columns
// by name.

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/text/text_source.h"

namespace seaglint {

// The name and unit of a column in one spelling, lower case with underscores: "roll_deg" for `roll_deg`, `Roll [deg]`,
// `ROLL (degrees)`, and for `roll` with the unit `(deg)` in a row of its own. Squares and cubes are digits:
// `area [m^2]` is "area_m2".
std::string column_key(std::string_view name, std::string_view unit = {});

// The unit in brackets at the end of a name, with its brackets; empty without one.
std::string_view bracketed_unit(std::string_view name);

// A cell of a row of units: a usual unit, anything in brackets, "-" or nothing.
bool is_unit(std::string_view cell);

// Separators of tables, in the order in which they are tried; ' ' means spaces and tabs.
inline constexpr char kSeparators[] = {';', '\t', ',', ' '};

struct TextRow {
  std::vector<std::string_view> cells;  // without blanks around them and without quotes
  std::string_view open_quote;          // a quote that is not closed, or that other text follows; empty: none
};

// The next row, removed from the front of `rest`. A cell in double quotes (RFC 4180) may contain separators and line
// ends; "" in it stands for a quote and is left so.
TextRow next_row(std::string_view& rest, char separator);
// The same into a row, whose memory is used again.
void next_row(std::string_view& rest, char separator, TextRow& row);

// A line that separates parts of a table: at least three of - = _ * + and |, with blanks.
bool is_rule(std::string_view line);

// No cell contains anything.
bool is_empty(std::span<const std::string_view> cells);

// A column that a reader asks for: its keys (column_key()), of which the first that the table has is read.
struct TableColumn {
  TableColumn(const char* key) : keys{key} {}
  explicit TableColumn(std::vector<std::string> all_keys, bool is_required = true)
      : keys(std::move(all_keys)), required(is_required) {}
  static TableColumn one_of(std::initializer_list<const char*> keys) { return TableColumn({keys.begin(), keys.end()}); }

  std::vector<std::string> keys;
  bool required = true;
};

// The requested columns of a table: numbers in rows. Blank lines, comments (text_source.h), rules and rows of empty
// cells are skipped. Numbers have decimal points or, where the separator allows them, decimal commas, one of both in
// the whole table, and exponents e, E, d or D.
class TextTable {
 public:
  // A table with names. They stand in the first line that has all required columns with any separator (; tab , or
  // blanks), below any lines of text, or in a comment as numpy.savetxt writes them; a row of units may follow, most of
  // them usual ones. Other columns are ignored. Throws InputError for a missing column or a requested one that appears
  // twice, for rows of another length, numbers above the names, and fewer than min_rows rows.
  TextTable(TextSource source, std::vector<TableColumn> columns, std::size_t min_rows = 2);
  // A table without names: exactly these columns, by any separator, below any lines without a number.
  static TextTable without_names(TextSource source, std::vector<TableColumn> columns);
  // The rows that begin at `rows`, a part of the source, of a table whose names the caller knows. All columns.
  static TextTable below(TextSource source, std::string_view rows, std::vector<std::string> names, char separator);

  std::size_t rows() const { return lines_.size(); }
  // Of a requested column, by its place in the request:
  bool has(std::size_t column) const { return places_[column].has_value(); }
  void require(std::size_t column) const;  // throws InputError unless has(column)
  // Throws InputError where a column that is not required is in the table in a unit that is not read, or without one.
  void require_unit(std::size_t column) const;
  const std::string& key(std::size_t column) const;  // the key by which the table has it
  std::string_view text(std::size_t row, std::size_t column) const;
  // Throws InputError "FILE:LINE:COLUMN: name: value 'x': must be ..." for anything but a finite number within both.
  double number(std::size_t row, std::size_t column, double lowest = -std::numeric_limits<double>::max(),
                double highest = std::numeric_limits<double>::max()) const;
  double positive(std::size_t row, std::size_t column) const;  // > 0
  double level(std::size_t row, std::size_t column) const;     // or minus infinity, the level of zero
  void check_ascending(std::size_t column) const;              // throws unless the numbers increase strictly
  [[noreturn]] void fail(std::size_t row, std::size_t column, const std::string& what) const;

  const TextSource& source() const { return source_; }
  int line(std::size_t row) const { return lines_[row]; }
  std::string place(std::size_t row) const;  // "FILE:LINE"
  // Names of all columns of the file in their order, without units of a row of their own.
  const std::vector<std::string>& names() const { return names_; }
  char separator() const { return separator_; }
  bool has_decimal_commas() const { return decimal_ == ','; }

 private:
  explicit TextTable(TextSource source) : source_(std::move(source)) {}

  struct Header;
  std::optional<Header> find_names(bool in_comments) const;
  [[noreturn]] void refuse_names() const;
  void place_columns(const std::vector<std::string>& keys);
  void read_rows(std::string_view rest);
  void find_decimal_mark();

  TextSource source_;
  std::vector<TableColumn> columns_;
  std::vector<std::optional<std::size_t>> places_;  // of the requested columns among those of the file
  std::vector<std::string> keys_;                   // of the requested columns
  std::vector<std::string> names_;
  std::vector<std::string_view> name_cells_, unit_cells_;  // of a table with names; units of a row of their own
  char separator_ = ',';
  char decimal_ = 0;                     // . or ,; 0: no number has either
  int decimal_line_ = 0;                 // the first that has it
  std::vector<std::string_view> cells_;  // row by row, as many as names
  std::vector<int> lines_;
};

}  // namespace seaglint
