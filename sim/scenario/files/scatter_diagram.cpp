// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxLabels = 200;
constexpr double kLeastHeight_m = 1e-6;

// A period that columns may be: the key of `sea` that it is, words of it in the first cell, and a name of its column.
struct PeriodName {
  const char* key;
  std::array<std::string_view, 2> words;
  const char* column;
};

constexpr std::array<PeriodName, 3> kPeriods{{{"peak_period_s", {"tp", "peak_period"}, "tp_s"},
                                              {"energy_period_s", {"te", "energy_period"}, "te_s"},
                                              {"zero_crossing_period_s", {"tz", "zero_crossing_period"}, "tz_s"}}};
constexpr std::array<std::string_view, 4> kHeights{"hs", "hm0", "swh", "significant_wave_height"};
constexpr std::array<std::string_view, 3> kSums{"sum", "total", "all"};

template <typename Names>
bool contains(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// Words of letters, digits and '_' in lower case, without a unit at the end: "hs", "tp" of "Hs [m] / Tp_s".
std::vector<std::string> names_in(std::string_view cell) {
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : lower_case(cell)) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
    if (is_letter && !inside) words.emplace_back();
    if (is_letter) words.back() += c;
    inside = is_letter;
  }
  for (std::string& word : words) {
    if (word.ends_with("_m") || word.ends_with("_s")) word.resize(word.size() - 2);
  }
  return words;
}

// What the first cell names: heights in the rows and the key of the periods, or the reverse.
struct Axes {
  bool heights_in_rows = true;
  std::string period_key;
};

std::optional<Axes> axes_of(std::string_view cell) {
  std::optional<std::size_t> height, period;
  std::string key;
  const std::vector<std::string> words = names_in(cell);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (contains(kHeights, words[i])) {
      if (height) return std::nullopt;
      height = i;
    }
    for (const PeriodName& name : kPeriods) {
      if (!contains(name.words, words[i])) continue;
      if (period) return std::nullopt;
      period = i;
      key = name.key;
    }
  }
  if (!height || !period) return std::nullopt;
  return Axes{*height < *period, key};
}

// One height or period: the centre of a cell or both its ends.
struct Label {
  std::string_view text;
  double centre = 0;
  double lowest = 0, highest = 0;
  bool has_ends = false;
};

// "0.5", or "0-1", "0 to 1", "0:1"; nothing for other texts.
std::optional<Label> label_of(std::string_view text) {
  if (const std::optional<double> centre = parse_written_number(text); centre && std::isfinite(*centre))
    return Label{text, *centre};
  for (const std::string_view between : {" to ", "..", ":", "\u2013", "-"}) {
    const std::size_t at = text.find(between, 1);
    if (text.empty() || at == std::string_view::npos) continue;
    const std::optional<double> low = parse_written_number(trimmed(text.substr(0, at)));
    const std::optional<double> high = parse_written_number(trimmed(text.substr(at + between.size())));
    if (low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high)
      return Label{text, (*low + *high) / 2, *low, *high, true};
  }
  return std::nullopt;
}

// Gives labels that are centres the ends of their cells. The cells have one width, of which all distances of centres
// are multiples: rows or columns without counts may be missing.
void find_ends(const TextSource& source, std::vector<Label>& labels, const std::string& what) {
  constexpr double kEqual = 1e-3;  // of a width: centres are printed with few digits
  std::vector<double> centres;
  for (const Label& label : labels) {
    if (label.has_ends != labels.front().has_ends)
      source.fail(label.text, fmt::format("{}: {}s must all be centres of cells, or all cells LOW-HIGH",
                                          in_quotes(label.text), what));
    centres.push_back(label.centre);
  }
  std::ranges::sort(centres);
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < centres.size(); ++i) {
    if (centres[i] > centres[i - 1]) width = std::min(width, centres[i] - centres[i - 1]);
  }
  for (Label& label : labels) {
    if (!label.has_ends) {
      const double steps = (label.centre - centres.front()) / width;
      if (!std::isfinite(width) || std::abs(steps - std::round(steps)) > kEqual)
        source.fail(label.text, fmt::format("{}: {}s must be centres of two or more equal cells, or cells LOW-HIGH",
                                            in_quotes(label.text), what));
      label.lowest = label.centre - width / 2;
      label.highest = label.centre + width / 2;
      if (std::abs(label.lowest) < kEqual * width) label.lowest = 0;
    }
    if (label.lowest < 0)
      source.fail(label.text, fmt::format("{}: its cell, {:g} to {:g}, begins below 0: must be the centre of a cell, "
                                          "or a cell LOW-HIGH",
                                          in_quotes(label.text), label.lowest, label.highest));
  }
}

ScatterDiagram finished(const TextSource& source, ScatterDiagram diagram) {
  if (diagram.cells.empty()) throw InputError(source.name() + ": all counts are 0");
  std::ranges::sort(diagram.cells, {},
                    [](const ScatterCell& cell) { return std::pair(cell.lowest_height_m, cell.lowest_period_s); });
  return diagram;
}

double count_of(const TextSource& source, std::string_view text) {
  if (text.empty() || text == "-") return 0;
  const std::optional<double> count = parse_written_number(text);
  if (!count || !(*count >= 0) || !std::isfinite(*count))
    source.fail(text, fmt::format("{}: must be a count, 0 or more", in_quotes(text)));
  return *count;
}

// Labels of a row or column, and their places among its cells; sums are left out.
struct Labels {
  std::vector<Label> labels;
  std::vector<std::size_t> places;

  void add(const TextSource& source, std::string_view text, std::size_t place, const std::string& what) {
    const std::vector<std::string> words = names_in(text);
    if (words.size() == 1 && contains(kSums, words.front())) return;
    const std::optional<Label> label = label_of(text);
    if (!label)
      source.fail(
          text, fmt::format("{}: must be a {}, as the centre of a cell or LOW-HIGH, or `sum`", in_quotes(text), what));
    for (const Label& other : labels) {
      if (other.centre == label->centre) source.fail(text, fmt::format("{}: appears twice", in_quotes(text)));
    }
    if (labels.size() == kMaxLabels) source.fail(text, fmt::format("more than {} rows or columns", kMaxLabels));
    labels.push_back(*label);
    places.push_back(place);
  }
};

// The rows of a diagram, separated by `separator`; without comments, rules and empty lines.
std::vector<std::vector<std::string_view>> rows_of(const TextSource& source, char separator) {
  std::vector<std::vector<std::string_view>> rows;
  for (std::string_view rest = source.text(); !rest.empty();) {
    std::string_view after = rest;
    const std::string_view line = next_line(after);
    if (is_comment(line) || is_rule(line)) {
      rest = after;
      continue;
    }
    const TextRow row = next_row(rest, separator);
    if (!row.open_quote.empty()) source.fail(row.open_quote, "a quote that is not closed");
    if (!is_empty(row.cells)) rows.push_back(row.cells);
  }
  return rows;
}

// A diagram with heights and periods along its sides; nothing if its first cell names no axes with this separator.
std::optional<ScatterDiagram> diagram_of_sides(const TextSource& source, char separator) {
  const std::vector<std::vector<std::string_view>> rows = rows_of(source, separator);
  if (rows.empty() || rows.front().size() < 2) return std::nullopt;
  const std::optional<Axes> axes = axes_of(rows.front().front());
  if (!axes) return std::nullopt;
  const char *in_rows = axes->heights_in_rows ? "wave height" : "period",
             *in_columns = axes->heights_in_rows ? "period" : "wave height";
  Labels across, down;
  for (std::size_t i = 1; i < rows.front().size(); ++i) {
    const bool is_end = i + 1 == rows.front().size() && rows.front()[i].empty();  // a separator at the end
    if (!is_end) across.add(source, rows.front()[i], i, in_columns);
  }
  for (std::size_t i = 1; i < rows.size(); ++i) down.add(source, rows[i].front(), i, in_rows);
  find_ends(source, across.labels, in_columns);
  find_ends(source, down.labels, in_rows);
  ScatterDiagram diagram{.period_key = axes->period_key, .cells = {}};
  for (std::size_t r = 0; r < down.labels.size(); ++r) {
    const std::vector<std::string_view>& row = rows[down.places[r]];
    if (row.size() > rows.front().size() && !(row.size() == rows.front().size() + 1 && row.back().empty()))
      source.fail(row.back(), fmt::format("{} cells where the first row has {}", row.size(), rows.front().size()));
    for (std::size_t c = 0; c < across.labels.size(); ++c) {
      if (across.places[c] >= row.size())
        source.fail(row.front(), fmt::format("{} cells where the first row has {}", row.size(), rows.front().size()));
      const double count = count_of(source, row[across.places[c]]);
      if (count == 0) continue;
      const Label& height = axes->heights_in_rows ? down.labels[r] : across.labels[c];
      const Label& period = axes->heights_in_rows ? across.labels[c] : down.labels[r];
      diagram.cells.push_back({height.lowest, height.highest, period.lowest, period.highest, count});
    }
  }
  return finished(source, std::move(diagram));
}

// A diagram with a cell in each row.
ScatterDiagram diagram_of_columns(const TextSource& source) {
  std::vector<std::string> names;
  for (const PeriodName& name : kPeriods) {
    names.emplace_back(name.key);
    names.emplace_back(name.column);
  }
  const TextTable table(source, {TableColumn::one_of({"significant_wave_height_m", "hs_m", "hm0_m"}),
                                 TableColumn(names), TableColumn::one_of({"count", "counts", "occurrences"})});
  const auto is_column = [&](const PeriodName& name) {
    return table.key(1) == name.key || table.key(1) == name.column;
  };
  const std::string period_key = std::ranges::find_if(kPeriods, is_column)->key;
  std::vector<Label> heights, periods;
  std::map<std::pair<double, double>, std::size_t> pairs;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    heights.push_back({table.text(row, 0), table.number(row, 0, 0)});
    periods.push_back({table.text(row, 1), table.number(row, 1, 0)});
    if (!pairs.emplace(std::pair(heights.back().centre, periods.back().centre), row).second)
      table.fail(row, 0, "this pair of height and period appears twice");
  }
  find_ends(table.source(), heights, "wave height");
  find_ends(table.source(), periods, "period");
  ScatterDiagram diagram{.period_key = period_key, .cells = {}};
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double count = table.number(row, 2, 0);
    if (count == 0) continue;
    diagram.cells.push_back(
        {heights[row].lowest, heights[row].highest, periods[row].lowest, periods[row].highest, count});
  }
  return finished(table.source(), std::move(diagram));
}

// True if the first line that is no comment names a column of counts.
bool has_columns(const TextSource& source) {
  for (std::string_view rest = source.text(); !rest.empty();) {
    const std::string_view line = next_line(rest);
    if (is_comment(line) || trimmed(line).empty()) continue;
    const std::vector<std::string> words = names_in(line);
    return contains(words, "count") || contains(words, "counts") || contains(words, "occurrences");
  }
  return false;
}

}  // namespace

double ScatterDiagram::count() const {
  double sum = 0;
  for (const ScatterCell& cell : cells) sum += cell.count;
  return sum;
}

SeaPair ScatterDiagram::draw(Random& random) const {
  double left = random.uniform() * count();
  const ScatterCell* chosen = &cells.back();  // rounding may leave a rest
  for (const ScatterCell& cell : cells) {
    left -= cell.count;
    if (left < 0) {
      chosen = &cell;
      break;
    }
  }
  const auto within = [&](double lowest, double highest) { return lowest + (highest - lowest) * random.uniform(); };
  SeaPair pair;
  pair.significant_wave_height_m = std::max(kLeastHeight_m, within(chosen->lowest_height_m, chosen->highest_height_m));
  pair.period_s = within(chosen->lowest_period_s, chosen->highest_period_s);
  return pair;
}

SeaPair ScatterDiagram::likeliest() const {
  const ScatterCell& cell = *std::ranges::max_element(cells, {}, &ScatterCell::count);
  return {(cell.lowest_height_m + cell.highest_height_m) / 2, (cell.lowest_period_s + cell.highest_period_s) / 2};
}

void exclude_cells(ScatterDiagram& diagram, const std::vector<bool>& is_excluded) {
  SEAGLINT_CHECK(is_excluded.size() == diagram.cells.size(),
                 fmt::format("{} of {} cells", is_excluded.size(), diagram.cells.size()));
  const double all = diagram.count();
  std::vector<ScatterCell> kept;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i) {
    if (!is_excluded[i]) kept.push_back(diagram.cells[i]);
  }
  diagram.excluded_cells = diagram.cells.size() - kept.size();
  diagram.cells = std::move(kept);
  diagram.excluded_fraction = 1 - diagram.count() / all;
}

ScatterDiagram read_scatter_diagram(const TextSource& source) {
  if (has_columns(source)) return diagram_of_columns(source);
  for (const char separator : kSeparators) {
    if (std::optional<ScatterDiagram> diagram = diagram_of_sides(source, separator)) return std::move(*diagram);
  }
  throw InputError(fmt::format(
      "{}: no scatter diagram: its first cell must name its rows and columns, as Hs/Tp (significant wave height, peak "
      "period), or its first row the columns significant_wave_height_m, peak_period_s, count",
      source.name()));
}

}  // namespace seaglint
