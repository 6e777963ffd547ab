// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/explorer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <unordered_map>

#include "classify/dataset/format/drawn_columns.h"
#include "tools/page/html.h"
#include "tools/page/plot_json.h"

namespace seaglint {
namespace {

using nlohmann::ordered_json;

constexpr int kColumnDigits = 12;           // binary digits of a real column: 1.2e-4 relative
constexpr double kLargestExact = 16777216;  // integers up to here are exact in single precision

// A column's numbers; empty for texts, and for keys beyond single precision.
std::vector<double> numbers_of(const SampleColumn& column, std::span<const SampleRecord> records) {
  std::vector<double> values;
  values.reserve(records.size());
  const auto* integer = std::get_if<std::int64_t SampleRecord::*>(&column.member);
  const auto* real = std::get_if<double SampleRecord::*>(&column.member);
  if (integer == nullptr && real == nullptr) return {};
  for (const SampleRecord& record : records) {
    values.push_back(real != nullptr ? record.*(*real) : static_cast<double>(record.*(*integer)));
    if (integer != nullptr && std::abs(values.back()) > kLargestExact) return {};
  }
  return values;
}

bool is_feature(std::string_view name) {
  constexpr std::string_view kFeatures[] = {"mwr", "ccf", "sigma_r_m", "sigma_v_mps", "centres"};
  return std::ranges::find(kFeatures, name) != std::end(kFeatures);
}

// Integers, and the values of the maps' titles, have the digits of single precision.
int digits_of(const SampleColumn& column) {
  constexpr std::string_view kOfTitles[] = {"significant_wave_height_m", "azimuth_deg", "elevation_deg"};
  const bool integer = std::holds_alternative<std::int64_t SampleRecord::*>(column.member);
  return integer || std::ranges::find(kOfTitles, column.name) != std::end(kOfTitles) ? 24 : kColumnDigits;
}

ordered_json column_json(const std::string& name, const std::string& unit, const std::vector<double>& values,
                         int digits) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return {{"name", name},
          {"unit", unit},
          {"feature", is_feature(name)},
          {"varies", low < high},
          {"packed", packed_floats(values, digits)}};
}

ordered_json columns_of(std::span<const SampleRecord> records) {
  ordered_json list = ordered_json::array();
  for (const SampleColumn& column : sample_columns()) {
    const std::vector<double> values = numbers_of(column, records);
    if (!values.empty()) list.push_back(column_json(column.name, column.unit, values, digits_of(column)));
  }
  const std::size_t drawn = records.empty() ? 0 : records.front().drawn_numbers.size();
  for (std::size_t i = 0; i < drawn; ++i) {
    const std::string& key = records.front().drawn_numbers[i].key;
    std::vector<double> values;
    for (const SampleRecord& record : records)
      values.push_back(i < record.drawn_numbers.size() ? record.drawn_numbers[i].value : std::nan(""));
    list.push_back(column_json(key, drawn_text(key).units, values, kColumnDigits));
  }
  return list;
}

// Number of the bin of each row; of a row without one that of the first.
std::vector<std::size_t> bin_of_row(std::span<const ColumnBin> bins, std::size_t rows) {
  std::vector<std::size_t> numbers(rows, 0);
  for (std::size_t bin = 0; bin < bins.size(); ++bin)
    for (const std::size_t row : bins[bin].rows) numbers[row] = bin;
  return numbers;
}

// The bins of a quantity by which maps are chosen: their texts, the bin of every row, the one shown first.
ordered_json choices(std::span<const ColumnBin> bins, std::size_t rows, std::size_t first) {
  ordered_json json{{"texts", ordered_json::array()}, {"first", first}};
  for (const ColumnBin& bin : bins) json["texts"].push_back(bin.text);
  std::vector<std::uint8_t> numbers;
  for (const std::size_t bin : bin_of_row(bins, rows)) numbers.push_back(static_cast<std::uint8_t>(bin));
  json["bins"] = packed(numbers);
  return json;
}

}  // namespace

ReducedAxis reduced_axis(std::span<const double> cells, std::size_t at_most) {
  const std::size_t together = std::max<std::size_t>(1, (cells.size() + at_most - 1) / at_most);
  const double step = cells.size() > 1 ? cells[1] - cells[0] : 1;
  return {cells.front() + step * static_cast<double>(together - 1) / 2, step * static_cast<double>(together),
          (cells.size() + together - 1) / together, together};
}

ExplorerMap explorer_map(const Sample& sample, const StoredAxes& axes) {
  const ReducedAxis velocity = reduced_axis(axes.velocity_mps, kExplorerCells[0]),
                    range = reduced_axis(axes.range_m, kExplorerCells[1]);
  const double peak = sample.magnitude.empty() ? 0.0 : *std::ranges::max_element(sample.magnitude);
  const auto decibels = [&](double value) {
    return value > 0 && peak > 0 ? std::max(kMapFloorDb, 20 * std::log10(value / peak)) : kMapFloorDb;
  };
  std::vector<std::uint8_t> levels(velocity.count * range.count, 0);
  for (std::size_t i = 0; i < sample.magnitude.size(); ++i) {
    const std::size_t v = i / axes.range_m.size() / velocity.cells, r = i % axes.range_m.size() / range.cells;
    const auto level = static_cast<std::uint8_t>(std::lround(decibels(sample.magnitude[i]) - kMapFloorDb));
    std::uint8_t& cell = levels[v * range.count + r];
    cell = std::max(cell, level);
  }
  ExplorerMap map{sample.record.sample, packed(levels), sample.centre_list};
  for (StoredCentre& centre : map.centres) centre[2] = static_cast<float>(decibels(centre[2]));
  return map;
}

std::vector<std::size_t> explorer_order(std::span<const SampleRecord> records, std::span<const ColumnBin> heights,
                                        std::span<const ColumnBin> azimuths) {
  using State = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::size_t, std::size_t>;
  const std::vector<std::size_t> of_height = bin_of_row(heights, records.size()),
                                 of_azimuth = bin_of_row(azimuths, records.size());
  std::map<State, int> seen;
  std::vector<std::pair<int, std::size_t>> order;
  for (std::size_t i = 0; i < records.size(); ++i)
    order.emplace_back(seen[{records[i].target, records[i].view, records[i].sea_state, of_height[i], of_azimuth[i]}]++,
                       i);
  std::ranges::sort(order);
  std::vector<std::size_t> rows;
  for (const auto& [turn, row] : order) rows.push_back(row);
  return rows;
}

std::string explorer_json(const ExplorerData& data) {
  const auto& [records, maps, axes, heights, azimuths, height, azimuth] = data;
  ordered_json json;
  std::map<std::int64_t, std::string> names;
  for (const SampleRecord& record : records) names[record.target] = record.target_name;
  json["targets"] = ordered_json::object();
  for (const auto& [target, name] : names) json["targets"][std::to_string(target)] = name;
  for (const auto& [name, axis] : {std::pair{"range", reduced_axis(axes.range_m, kExplorerCells[1])},
                                   {"velocity", reduced_axis(axes.velocity_mps, kExplorerCells[0])}})
    json[name] = {{"first", axis.first}, {"step", axis.step}, {"count", axis.count}, {"cells", axis.cells}};
  json["floor_db"] = kMapFloorDb;
  json["step_db"] = 1;
  json["heights"] = choices(heights, records.size(), height);
  json["azimuths"] = choices(azimuths, records.size(), azimuth);
  json["columns"] = columns_of(records);
  json["maps"] = ordered_json::array();
  std::unordered_map<std::int64_t, const ExplorerMap*> of_sample;
  for (const ExplorerMap& map : maps) of_sample[map.sample] = &map;
  std::size_t bytes = 0;
  for (const std::size_t row : explorer_order(records, heights, azimuths)) {
    const auto found = of_sample.find(records[row].sample);
    if (found == of_sample.end()) continue;
    ordered_json centres = ordered_json::array();
    for (const StoredCentre& c : found->second->centres)
      centres.push_back({std::round(100 * c[0]) / 100, std::round(1000 * c[1]) / 1000, std::round(10 * c[2]) / 10});
    bytes += found->second->packed.size() + centres.dump().size();
    if (bytes > kExplorerBytes) break;
    json["maps"].push_back({{"row", row}, {"packed", found->second->packed}, {"centres", centres}});
  }
  return script_json(json.dump());
}

}  // namespace seaglint
