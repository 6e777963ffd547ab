// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/data_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "classify/dataset/format/shard.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/text/names.h"

namespace seaglint {
namespace {

constexpr const char* kDataSet = "data_set";
constexpr const char* kSea = "sea";

const SampleColumn* find_column(const std::string& name) {
  for (const SampleColumn& column : sample_columns())
    if (column.name == name) return &column;
  return nullptr;
}

// The value of a numeric column; nothing for a column of text.
std::optional<double> number_in(const SampleRecord& record, const SampleColumn& column) {
  if (const auto* whole = std::get_if<std::int64_t SampleRecord::*>(&column.member))
    return static_cast<double>(record.**whole);
  if (const auto* real = std::get_if<double SampleRecord::*>(&column.member)) return record.**real;
  return std::nullopt;
}

[[noreturn]] void refuse_column(const std::string& name, std::span<const DataRow> rows = {}) {
  std::vector<std::string> names{kSea, kDataSet};
  for (const SampleColumn& column : sample_columns()) names.push_back(column.name);
  if (!rows.empty())
    visit_drawn(rows.front().record, [&](const std::string& key, const auto&) { names.push_back(key); });
  throw InputError(fmt::format("{}: no column of a data set: {}", name, suggestion(name, names)));
}

// The value of a drawn key; null in a row of a scenario that does not draw it.
template <class T>
const T* drawn_value(const std::vector<DrawnValue<T>>& values, const std::string& key) {
  const auto found = std::find_if(values.begin(), values.end(), [&](const auto& drawn) { return drawn.key == key; });
  return found == values.end() ? nullptr : &found->value;
}

// The column of a drawn key; nothing where no row has it.
std::optional<ColumnOfRows> drawn_column(std::span<const DataRow> rows, const std::string& key) {
  ColumnOfRows numbers{key, drawn_text(key).units, false, {}, {}}, words{key, "", true, {}, {}};
  bool has_numbers = false, has_words = false;
  for (const DataRow& row : rows) {
    const double* number = drawn_value(row.record.drawn_numbers, key);
    const std::string* word = drawn_value(row.record.drawn_words, key);
    has_numbers = has_numbers || number != nullptr;
    has_words = has_words || word != nullptr;
    numbers.numbers.push_back(number ? *number : kNan);
    words.texts.push_back(word ? *word : std::string());
  }
  if (has_words) return words;
  if (has_numbers) return numbers;
  return std::nullopt;
}

double mean_of(const ColumnOfRows& column, const std::vector<std::size_t>& rows) {
  double sum = 0;
  for (const std::size_t row : rows) sum += column.numbers[row];
  return sum / static_cast<double>(rows.size());
}

// True for a column of numbers with one value in each case.
bool is_swept(std::span<const DataRow> rows, const ColumnOfRows& column) {
  if (column.is_text) return false;
  std::map<std::tuple<std::size_t, std::int64_t, std::int64_t>, double> value_of_case;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const SampleRecord& record = rows[row].record;
    const double value = column.numbers[row];
    const auto [first, is_new] = value_of_case.try_emplace({rows[row].data_set, record.sea_state, record.view}, value);
    if (!is_new && std::isless(std::min(first->second, value), std::max(first->second, value))) return false;
  }
  return true;
}

std::string interval_text(double lowest, double highest) {
  return lowest == highest ? fmt::format("{:.6g}", lowest) : fmt::format("{:.4g} to {:.4g}", lowest, highest);
}

}  // namespace

void append_rows(std::vector<DataRow>& rows, std::size_t data_set, const Shard& shard) {
  for (const Sample& sample : shard.samples) rows.push_back({data_set, sample.record});
}

std::vector<std::int64_t> sea_numbers(std::span<const DataRow> rows) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> numbers;
  for (const DataRow& row : rows) numbers[{row.record.seed, row.record.sea_key}] = 0;
  std::int64_t next = 0;
  for (auto& entry : numbers) entry.second = next++;
  std::vector<std::int64_t> result;
  result.reserve(rows.size());
  for (const DataRow& row : rows) result.push_back(numbers.at({row.record.seed, row.record.sea_key}));
  return result;
}

ColumnOfRows column_of(std::span<const DataRow> rows, const std::string& name) {
  ColumnOfRows values{name, "1", false, {}, {}};
  if (name == kSea) {
    for (const std::int64_t sea : sea_numbers(rows)) values.numbers.push_back(static_cast<double>(sea));
    return values;
  }
  if (name == kDataSet) {
    for (const DataRow& row : rows) values.numbers.push_back(static_cast<double>(row.data_set));
    return values;
  }
  const SampleColumn* column = find_column(name);
  if (column == nullptr) {
    if (std::optional<ColumnOfRows> drawn = drawn_column(rows, name)) return *drawn;
    refuse_column(name, rows);
  }
  if (const auto* text = std::get_if<std::string SampleRecord::*>(&column->member)) {
    values.is_text = true;
    values.unit.clear();
    for (const DataRow& row : rows) values.texts.push_back(row.record.**text);
    return values;
  }
  values.unit = column->unit;
  for (const DataRow& row : rows) values.numbers.push_back(*number_in(row.record, *column));
  return values;
}

std::vector<float> values_of(const SampleRecord& record, std::span<const std::string> names) {
  std::vector<float> values;
  values.reserve(names.size());
  for (const std::string& name : names) {
    const SampleColumn* column = find_column(name);
    if (column == nullptr) refuse_column(name);
    const std::optional<double> value = number_in(record, *column);
    if (!value) throw InputError(fmt::format("{}: a column of text is no feature", name));
    values.push_back(static_cast<float>(*value));
  }
  return values;
}

std::vector<ColumnBin> bins_of(const ColumnOfRows& column, std::size_t most_values, std::size_t bins) {
  std::vector<ColumnBin> result;
  if (column.is_text) {
    std::map<std::string, std::vector<std::size_t>> by_text;
    for (std::size_t row = 0; row < column.texts.size(); ++row) by_text[column.texts[row]].push_back(row);
    for (auto& [text, rows] : by_text) result.push_back({text, kNan, kNan, kNan, std::move(rows)});
    return result;
  }
  std::map<double, std::vector<std::size_t>> by_value;
  std::vector<std::size_t> undefined;
  std::size_t defined = 0;
  for (std::size_t row = 0; row < column.numbers.size(); ++row) {
    if (std::isnan(column.numbers[row])) {
      undefined.push_back(row);
    } else {
      by_value[column.numbers[row]].push_back(row);
      ++defined;
    }
  }
  // A bin ends with the value after which the rows up to it are closest to its part of all rows.
  const bool every_value = by_value.size() <= most_values;
  std::size_t before = 0;
  bool open = false;
  for (const auto& [value, rows] : by_value) {
    // Closer to the part without this value than with it: part - before < before + rows - part.
    if (open && 2 * result.size() * defined < (2 * before + rows.size()) * bins) open = false;
    if (!open) result.push_back({"", value, value, value, {}});
    ColumnBin& bin = result.back();
    bin.highest = value;
    bin.rows.insert(bin.rows.end(), rows.begin(), rows.end());
    before += rows.size();
    open = !every_value && before * bins < result.size() * defined;
  }
  for (ColumnBin& bin : result) {
    std::sort(bin.rows.begin(), bin.rows.end());
    if (bin.lowest < bin.highest) bin.mean = mean_of(column, bin.rows);
    bin.text = interval_text(bin.lowest, bin.highest);
  }
  if (!undefined.empty()) result.push_back({"undefined", kNan, kNan, kNan, std::move(undefined)});
  return result;
}

Condition condition_of(std::span<const DataRow> rows, const std::string& name) {
  const ColumnOfRows column = column_of(rows, name);
  const std::size_t most_values = is_swept(rows, column) ? kMostSweptBins : kMostBins;
  return {name, column.unit, bins_of(column, most_values, kMostBins)};
}

std::vector<Condition> conditions_of(std::span<const DataRow> rows) {
  if (rows.empty()) return {};
  std::vector<Condition> conditions{condition_of(rows, kWaveHeightColumn)};
  std::set<std::string> keys;
  for (const DataRow& row : rows)
    visit_drawn(row.record, [&](const std::string& key, const auto&) { keys.insert(key); });
  keys.erase("sea.significant_wave_height_m");
  std::erase_if(keys, [](const std::string& key) { return key.ends_with("seed"); });  // their order has no meaning
  for (const std::string& key : keys) conditions.push_back(condition_of(rows, key));
  for (const auto& [name, key] : {std::pair{"azimuth_deg", "view.azimuth_deg"},
                                  {"elevation_deg", "view.elevation_deg"},
                                  {"peak_period_s", "sea.peak_period_s"}}) {
    if (keys.contains(key)) continue;
    Condition swept = condition_of(rows, name);
    if (swept.bins.size() > 1) conditions.push_back(std::move(swept));
  }
  return conditions;
}

bool ValueRange::excludes(double value) const {
  if (std::isnan(value)) return !has_undefined;
  const double margin = 1e-3 * std::max(std::abs(lowest), std::abs(highest));
  return !(value >= lowest - margin && value <= highest + margin);
}

ValueRange range_of(const ColumnOfRows& column, std::span<const std::size_t> rows, std::span<const int> labels,
                    std::size_t classes) {
  ValueRange range{column.name, column.unit, kNan, kNan, {}};
  std::vector<std::vector<double>> by_label(classes);
  for (const std::size_t row : rows) {
    const double value = column.numbers[row];
    if (std::isnan(value)) {
      range.has_undefined = true;
      continue;
    }
    range.lowest = std::fmin(range.lowest, value);
    range.highest = std::fmax(range.highest, value);
    by_label[static_cast<std::size_t>(labels[row])].push_back(value);
  }
  for (std::vector<double>& values : by_label) {
    std::sort(values.begin(), values.end());
    range.by_label.push_back({quantile(values, 0.05), quantile(values, 0.5), quantile(values, 0.95)});
  }
  return range;
}

std::vector<std::string> condition_names(std::span<const std::string> features) {
  // A time is no condition, and the features do not depend on the absolute level.
  static const std::vector<std::string> kOthers{"start_s", "peak_m", "energy_m2"};
  const auto is_in = [](const auto& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> names;
  for (const SampleColumn& column : sample_columns()) {
    const bool is_real = std::holds_alternative<double SampleRecord::*>(column.member);
    const std::string name = column.name;
    if ((is_real || name == "centres") && !is_in(kOthers, name) && !is_in(features, name)) names.push_back(name);
  }
  return names;
}

}  // namespace seaglint
