// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/text_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

// Longer spellings of units, and the usual one.
constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
    {"degree", "deg"}, {"degrees", "deg"}, {"radian", "rad"}, {"radians", "rad"}, {"sec", "s"},    {"second", "s"},
    {"seconds", "s"},  {"meter", "m"},     {"meters", "m"},   {"metre", "m"},     {"metres", "m"}, {"hertz", "hz"}};

constexpr std::string_view kUsualUnits[] = {"s",        "ms",    "min",  "h",    "deg", "rad",  "m",     "mm",
                                            "cm",       "km",    "ft",   "in",   "hz",  "ghz",  "mhz",   "rad_s",
                                            "m_s",      "deg_s", "m_s2", "m2",   "m3",  "m2_s", "m2_hz", "m2_s_rad",
                                            "m2_rad_s", "n",     "kn",   "dbsm", "db",  "grad", "1"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

// Lower case; everything that is no letter or digit becomes one underscore between them.
std::string spelt(std::string_view written) {
  constexpr std::pair<std::string_view, std::string_view> kSigns[] = {
      {"\xc2\xb2", "2"}, {"\xc2\xb3", "3"}, {"\xc2\xb0", "_deg"}, {"\xcf\x89", "omega"}, {"**", ""}, {"^", ""}};
  const std::string lower = lower_case(written);
  std::string key;
  for (std::string_view text = lower; !text.empty();) {
    const auto sign = std::find_if(std::begin(kSigns), std::end(kSigns),
                                   [&](const auto& known) { return text.starts_with(known.first); });
    if (sign != std::end(kSigns)) {
      const bool doubled = sign->second.starts_with('_') && (key.empty() || key.back() == '_');
      key += sign->second.substr(doubled ? 1 : 0);
      text.remove_prefix(sign->first.size());
      continue;
    }
    if (is_letter(text.front())) {
      key += text.front();
    } else if (!key.empty() && key.back() != '_') {
      key += '_';
    }
    text.remove_prefix(1);
  }
  while (key.ends_with('_')) key.pop_back();
  const std::size_t last = key.rfind('_') + 1;  // 0 without an underscore
  for (const auto& [longer, usual] : kUnits) {
    if (std::string_view(key).substr(last) == longer) return key.replace(last, std::string::npos, usual);
  }
  return key;
}

}  // namespace

std::string column_key(std::string_view name, std::string_view unit) {
  std::string key = spelt(name);
  const std::string of_unit = spelt(unit);
  if (of_unit.empty() || key == of_unit || key.ends_with("_" + of_unit)) return key;
  return key + "_" + of_unit;
}

std::string_view bracketed_unit(std::string_view name) {
  if (!name.ends_with(']') && !name.ends_with(')')) return {};
  const std::size_t open = name.rfind(name.back() == ']' ? '[' : '(');
  return open == std::string_view::npos ? std::string_view() : name.substr(open);
}

bool is_unit(std::string_view cell) {
  if (cell.empty() || cell == "-" || !bracketed_unit(cell).empty()) return true;
  const std::string unit = spelt(cell);
  return std::find(std::begin(kUsualUnits), std::end(kUsualUnits), unit) != std::end(kUsualUnits);
}

namespace {

constexpr std::size_t kLongestQuoted = 65536;  // bytes

// Length of the text in quotes at the front of `text`, whose first character is the quote; npos without an end.
std::size_t quoted_length(std::string_view text) {
  text = text.substr(0, kLongestQuoted);
  for (std::size_t end = text.find('"', 1); end != std::string_view::npos; end = text.find('"', end + 2)) {
    if (end + 1 >= text.size() || text[end + 1] != '"') return end - 1;
  }
  return std::string_view::npos;
}

void skip_blanks(std::string_view& rest, char separator) {
  while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\r' || rest.front() == '\f' ||
                           (rest.front() == '\t' && separator != '\t'))) {
    rest.remove_prefix(1);
  }
}

bool ends_cell(std::string_view rest, char separator) {
  if (rest.empty() || rest.front() == '\n' || rest.front() == separator) return true;
  return separator == ' ' && (rest.front() == '\t' || rest.front() == '\r');
}

}  // namespace

TextRow next_row(std::string_view& rest, char separator) {
  TextRow row;
  next_row(rest, separator, row);
  return row;
}

void next_row(std::string_view& rest, char separator, TextRow& row) {
  row.cells.clear();
  row.open_quote = {};
  while (true) {
    skip_blanks(rest, separator);
    const bool at_end = rest.empty() || rest.front() == '\n';
    if (at_end && (separator == ' ' || row.cells.empty())) break;
    std::string_view cell;
    if (rest.starts_with('"')) {
      const std::string_view open = rest.substr(0, 1);
      const std::size_t length = quoted_length(rest);
      if (length != std::string_view::npos) {
        cell = rest.substr(1, length);
        rest.remove_prefix(length + 2);
        if (separator != ' ') skip_blanks(rest, separator);
      }
      if (length == std::string_view::npos || !ends_cell(rest, separator)) {
        row.open_quote = open;
        next_line(rest);
        return;
      }
    } else {
      std::size_t end = 0;
      while (!ends_cell(rest.substr(end), separator)) ++end;
      cell = trimmed(rest.substr(0, end));
      rest.remove_prefix(end);
    }
    row.cells.push_back(cell);
    if (separator == ' ') continue;
    if (rest.empty() || rest.front() == '\n') break;
    rest.remove_prefix(1);
    // A separator at the very end is followed by one more, empty cell.
    skip_blanks(rest, separator);
    if (rest.empty() || rest.front() == '\n') {
      row.cells.push_back(rest.substr(0, 0));
      break;
    }
  }
  if (!rest.empty()) rest.remove_prefix(1);
}

bool is_rule(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.size() >= 3 && text.find_first_not_of("-=_*+| \t") == std::string_view::npos;
}

bool is_empty(std::span<const std::string_view> cells) {
  return std::all_of(cells.begin(), cells.end(), [](std::string_view cell) { return cell.empty(); });
}

namespace {

constexpr int kMaxLinesAbove = 200;  // above the names

// Place of the first decimal mark, npos without one.
std::size_t mark_in(std::string_view cell) {
  const auto mark = std::find_if(cell.begin(), cell.end(), [](char c) { return c == '.' || c == ','; });
  return mark == cell.end() ? std::string_view::npos : static_cast<std::size_t>(mark - cell.begin());
}

bool has_number(const std::vector<std::string_view>& cells) {
  return std::any_of(cells.begin(), cells.end(),
                     [](std::string_view cell) { return parse_written_number(cell).has_value(); });
}

bool all_numbers(const std::vector<std::string_view>& cells) {
  return std::all_of(cells.begin(), cells.end(),
                     [](std::string_view cell) { return parse_written_number(cell).has_value(); });
}

void drop_empty_ends(std::vector<std::string_view>& cells, std::size_t width) {
  while (cells.size() > width && cells.back().empty()) cells.pop_back();
}

std::string name_of_separator(char separator) {
  if (separator == ' ') return "blanks";
  return separator == '\t' ? "tabs" : fmt::format("'{}'", separator);
}

std::size_t required_among(const std::vector<TableColumn>& columns) {
  return static_cast<std::size_t>(
      std::count_if(columns.begin(), columns.end(), [](const TableColumn& column) { return column.required; }));
}

// The keys of a column that name a quantity in some unit, without the quantity: {"deg", "rad"}; none of another
// quantity.
std::vector<std::string> units_of(const TableColumn& column, const std::string& quantity) {
  std::vector<std::string> units;
  for (const std::string& key : column.keys) {
    if (quantity.empty() || key.size() <= quantity.size() || !key.starts_with(quantity + "_")) continue;
    const std::string unit = key.substr(quantity.size() + 1);
    if (is_unit(unit)) units.push_back(unit);
  }
  return units;
}

// The name of a column without the unit in its brackets, as a key.
std::string quantity_of(std::string_view name) {
  return column_key(name.substr(0, name.size() - bracketed_unit(name).size()));
}

// "unit '(grad)' of PtfmRoll: must be deg or rad".
std::string unit_refusal(std::string_view name, std::string_view unit, const std::vector<std::string>& units) {
  const std::string quantity = quantity_of(name);
  return unit.empty()
             ? fmt::format("{} has no unit: must be named {}_{}, or have a row of units below", shown(name), quantity,
                           fmt::join(units, " or " + quantity + "_"))
             : fmt::format("unit {} of {}: must be {}", in_quotes(unit), shown(name), fmt::join(units, " or "));
}

bool has_key(const std::vector<std::string>& keys, const TableColumn& column) {
  return std::any_of(column.keys.begin(), column.keys.end(),
                     [&](const std::string& key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); });
}

}  // namespace

// Names found in a line of the text.
struct TextTable::Header {
  std::string_view line;
  char separator = ',';
  std::vector<std::string_view> names, units;
  std::vector<std::string> keys;
  std::string_view rows;       // the text below
  std::size_t found = 0;       // required columns
  std::size_t quantities = 0;  // required columns in whatever unit

  // The names in the row at the front of `text`, with the row of units below them. Fewer names than `least` have no
  // keys.
  static Header of(std::string_view text, char separator, const std::vector<TableColumn>& columns, std::size_t least) {
    Header header;
    header.line = text.substr(0, text.find('\n'));
    header.separator = separator;
    TextRow row = next_row(text, separator);
    if (!row.open_quote.empty()) return header;
    drop_empty_ends(row.cells, 1);
    const bool cut_at_separator = std::none_of(row.cells.begin(), row.cells.end(), [](std::string_view name) {
      return name.ends_with(',') || name.ends_with(';');
    });
    if (!cut_at_separator) return header;
    header.names = row.cells;
    header.rows = text;
    if (header.names.size() < least) return header;
    std::string_view below = text;
    while (!below.empty() && trimmed(below.substr(0, below.find('\n'))).empty()) next_line(below);
    TextRow units = next_row(below, separator);
    drop_empty_ends(units.cells, header.names.size());
    // Most are usual ones; other columns may have any ("INVALID" of OpenFAST).
    const auto usual = static_cast<std::size_t>(std::count_if(units.cells.begin(), units.cells.end(), is_unit));
    const bool are_units = units.open_quote.empty() && units.cells.size() == header.names.size() &&
                           2 * usual > units.cells.size() && !has_number(units.cells) && !is_empty(units.cells);
    if (are_units) {
      header.units = units.cells;
      header.rows = below;
    }
    for (std::size_t i = 0; i < header.names.size(); ++i)
      header.keys.push_back(column_key(header.names[i], are_units ? header.units[i] : std::string_view()));
    for (const TableColumn& column : columns) {
      if (!column.required) continue;
      header.found += has_key(header.keys, column) ? 1 : 0;
      header.quantities += std::any_of(header.names.begin(), header.names.end(), [&](std::string_view name) {
        return !units_of(column, quantity_of(name)).empty();
      });
    }
    return header;
  }
};

TextTable::TextTable(TextSource source, std::vector<TableColumn> columns, std::size_t min_rows)
    : source_(std::move(source)), columns_(std::move(columns)) {
  std::optional<Header> header = find_names(false);
  if (!header) header = find_names(true);
  if (!header) refuse_names();
  separator_ = header->separator;
  for (const std::string_view name : header->names) names_.push_back(shown(name));
  name_cells_ = header->names;
  unit_cells_ = header->units;
  place_columns(header->keys);
  read_rows(header->rows);
  if (rows() < min_rows) {
    throw InputError(
        fmt::format("{}: {} rows of numbers below the names: must be at least {}", source_.name(), rows(), min_rows));
  }
}

// The first line with all required columns: among those of the table or, with in_comments, among its comments.
std::optional<TextTable::Header> TextTable::find_names(bool in_comments) const {
  const std::size_t required = required_among(columns_);
  std::string_view numbers;  // the first row of numbers above
  std::string_view rest = source_.text();
  for (int n = 0; n < kMaxLinesAbove && !rest.empty();) {
    std::string_view text = rest;
    const std::string_view line = next_line(rest);
    if (is_comment(line) != in_comments || trimmed(line).empty()) continue;
    ++n;
    if (in_comments)
      text.remove_prefix(text.find_first_not_of(" \t#%/!") == std::string_view::npos
                             ? line.size()
                             : std::min(text.find_first_not_of(" \t#%/!"), line.size()));
    for (const char separator : kSeparators) {
      const Header header = Header::of(text, separator, columns_, required);
      if (header.found == required) {
        if (!numbers.empty() && !in_comments)
          source_.fail(numbers,
                       fmt::format("numbers above the names of the columns in line {}", source_.line_of(line)));
        return header;
      }
      if (numbers.empty() && header.names.size() > 1 && all_numbers(header.names)) numbers = line;
    }
  }
  return std::nullopt;
}

// Throws for names that lack a required column: at the line that has most of them, or at the first line.
void TextTable::refuse_names() const {
  Header best;
  std::string_view rest = source_.text();
  for (int n = 0; n < kMaxLinesAbove && !rest.empty(); ++n) {
    const std::string_view text = rest, line = next_line(rest);
    if (trimmed(line).empty() || is_comment(line)) continue;
    for (const char separator : kSeparators) {
      Header header = Header::of(text, separator, columns_, 0);
      const auto fit = std::pair(header.found, header.quantities), best_fit = std::pair(best.found, best.quantities);
      const bool better =
          fit > best_fit || (fit == best_fit && best.line == header.line && header.names.size() > best.names.size());
      if (best.line.data() == nullptr || better) best = std::move(header);
    }
  }
  if (best.line.data() == nullptr) {
    throw InputError(fmt::format("{}: 0 rows: the file is empty: must be a table with a header", source_.name()));
  }
  for (const TableColumn& column : columns_) {
    if (!column.required || has_key(best.keys, column)) continue;
    for (std::size_t i = 0; i < best.names.size(); ++i) {
      // The same quantity in another unit.
      const std::vector<std::string> units = units_of(column, quantity_of(best.names[i]));
      if (units.empty()) continue;
      const std::string_view in_name = bracketed_unit(best.names[i]);
      const std::string_view unit = best.units.empty() || !in_name.empty() ? in_name : best.units[i];
      source_.fail(best.names[i], unit_refusal(best.names[i], unit, units));
    }
    constexpr std::size_t kMostNames = 6;
    const std::vector<std::string> others(
        column.keys.begin() + 1, column.keys.begin() + static_cast<long>(std::min(column.keys.size(), kMostNames)));
    source_.fail(trimmed(best.line),
                 fmt::format("no column {}; the columns are {}{}", column.keys.front(),
                             shown(fmt::format("{}", fmt::join(best.names, ", "))),
                             others.empty() ? ""
                                            : fmt::format(" (it may be called {}{})", fmt::join(others, ", "),
                                                          column.keys.size() > kMostNames ? " and more" : "")));
  }
  source_.fail(trimmed(best.line), "no names of columns");
}

// Finds the requested columns among those of the file.
void TextTable::place_columns(const std::vector<std::string>& keys) {
  for (const TableColumn& column : columns_) {
    const auto key = std::find_if(column.keys.begin(), column.keys.end(), [&](const std::string& wanted) {
      return std::find(keys.begin(), keys.end(), wanted) != keys.end();
    });
    keys_.push_back(key == column.keys.end() ? column.keys.front() : *key);
    if (key == column.keys.end()) {
      places_.emplace_back();
      continue;
    }
    const auto first = std::find(keys.begin(), keys.end(), *key);
    places_.emplace_back(static_cast<std::size_t>(first - keys.begin()));
    const auto second = std::find(first + 1, keys.end(), *key);
    if (second == keys.end()) continue;
    throw InputError(fmt::format("{}: column {} appears twice: columns {} and {} of the table", source_.name(),
                                 names_[*places_.back()], first - keys.begin() + 1, second - keys.begin() + 1));
  }
}

void TextTable::read_rows(std::string_view rest) {
  const auto lines = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1;
  lines_.reserve(lines);
  cells_.reserve(std::min(lines * names_.size(), rest.size() / 2));  // a cell and its separator: two characters
  TextRow row;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (trimmed(line).empty() || is_comment(line) || is_rule(line)) {
      next_line(rest);
      continue;
    }
    next_row(rest, separator_, row);
    if (!row.open_quote.empty()) source_.fail(row.open_quote, "a quote that is not closed at the end of its cell");
    if (is_empty(row.cells)) continue;
    drop_empty_ends(row.cells, names_.size());
    if (row.cells.size() != names_.size()) {
      source_.fail(trimmed(line), fmt::format("{} cells where the names are {}, separated by {}", row.cells.size(),
                                              names_.size(), name_of_separator(separator_)));
    }
    lines_.push_back(lines_.empty() ? source_.line_of(line) : 0);
    cells_.insert(cells_.end(), row.cells.begin(), row.cells.end());
  }
  // Lines of the rows by one pass over the text.
  for (std::size_t i = 1; i < lines_.size(); ++i) {
    const char* before = cells_[(i - 1) * names_.size()].data();
    lines_[i] = lines_[i - 1] + static_cast<int>(std::count(before, cells_[i * names_.size()].data(), '\n'));
  }
  find_decimal_mark();
}

void TextTable::find_decimal_mark() {
  for (const std::string_view& cell : cells_) {
    const std::size_t mark = mark_in(cell);
    if (mark == std::string_view::npos || !parse_written_number(cell)) continue;
    decimal_ = cell[mark];
    decimal_line_ = source_.line_of(cell);
    return;
  }
}

TextTable TextTable::without_names(TextSource source, std::vector<TableColumn> columns) {
  TextTable table(std::move(source));
  std::vector<std::string> keys;
  keys.reserve(columns.size());
  for (const TableColumn& column : columns) keys.push_back(column.keys.front());
  table.columns_ = std::move(columns);
  table.names_ = keys;
  table.place_columns(keys);
  table.separator_ = ' ';
  for (std::string_view rest = table.source_.text(); !rest.empty();) {
    const std::string_view above = rest, line = next_line(rest);
    if (trimmed(line).empty() || is_comment(line) || is_rule(line)) continue;
    bool numbers = false;
    for (const char separator : kSeparators) {
      std::string_view text = above;
      TextRow row = next_row(text, separator);
      drop_empty_ends(row.cells, keys.size());
      numbers = numbers || has_number(row.cells);
      if (row.cells.size() != keys.size() || !all_numbers(row.cells)) continue;
      table.separator_ = separator;
      break;
    }
    if (!numbers) continue;
    table.read_rows(above);
    break;
  }
  return table;
}

TextTable TextTable::below(TextSource source, std::string_view rows, std::vector<std::string> names, char separator) {
  TextTable table(std::move(source));
  for (const std::string& name : names) table.columns_.push_back(TableColumn({name}));
  table.separator_ = separator;
  table.names_ = std::move(names);
  table.place_columns(table.names_);
  table.read_rows(rows);
  return table;
}

void TextTable::require(std::size_t column) const {
  if (has(column)) return;
  throw InputError(fmt::format("{}: no column {}; the columns are {}", source_.name(), columns_[column].keys.front(),
                               shown(fmt::format("{}", fmt::join(names_, ", ")))));
}

void TextTable::require_unit(std::size_t column) const {
  if (has(column)) return;
  for (std::size_t i = 0; i < name_cells_.size(); ++i) {
    const std::vector<std::string> units = units_of(columns_[column], quantity_of(name_cells_[i]));
    if (units.empty()) continue;
    const std::string_view in_name = bracketed_unit(name_cells_[i]);
    const std::string_view unit = unit_cells_.empty() || !in_name.empty() ? in_name : unit_cells_[i];
    source_.fail(name_cells_[i], unit_refusal(name_cells_[i], unit, units));
  }
}

const std::string& TextTable::key(std::size_t column) const { return keys_[column]; }

std::string_view TextTable::text(std::size_t row, std::size_t column) const {
  return cells_[row * names_.size() + places_[column].value()];
}

std::string TextTable::place(std::size_t row) const { return fmt::format("{}:{}", source_.name(), lines_[row]); }

void TextTable::fail(std::size_t row, std::size_t column, const std::string& what) const {
  const std::string_view cell = text(row, column);
  source_.fail(cell, fmt::format("{}: value {}: {}", names_[*places_[column]], in_quotes(cell), what));
}

double TextTable::number(std::size_t row, std::size_t column, double lowest, double highest) const {
  const std::string_view cell = text(row, column);
  const std::optional<double> value = parse_written_number(cell);
  if (!value || !std::isfinite(*value)) fail(row, column, "must be a finite number" + lookalike_note(cell));
  const std::size_t mark = mark_in(cell);
  if (mark != std::string_view::npos && cell[mark] != decimal_) {
    fail(row, column,
         fmt::format("a decimal {}, where line {} has a decimal {}", cell[mark] == ',' ? "comma" : "point",
                     decimal_line_, decimal_ == ',' ? "comma" : "point"));
  }
  if (*value < lowest || *value > highest) {
    const bool above_only = highest == std::numeric_limits<double>::max();
    fail(row, column,
         above_only ? fmt::format("must be at least {}", lowest)
                    : fmt::format("must be within {} and {}", lowest, highest));
  }
  return *value;
}

double TextTable::positive(std::size_t row, std::size_t column) const {
  const double value = number(row, column);
  if (!(value > 0)) fail(row, column, "must be greater than 0");
  return value;
}

double TextTable::level(std::size_t row, std::size_t column) const {
  const std::optional<double> value = parse_any_number(text(row, column));
  return value && std::isinf(*value) && *value < 0 ? *value : number(row, column);
}

void TextTable::check_ascending(std::size_t column) const {
  for (std::size_t row = 1; row < rows(); ++row) {
    if (number(row, column) > number(row - 1, column)) continue;
    fail(row, column, fmt::format("must be greater than {} of line {}", number(row - 1, column), lines_[row - 1]));
  }
}

}  // namespace seaglint
