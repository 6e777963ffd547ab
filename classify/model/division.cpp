// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/division.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

// One key per use: repeat, protocol and purpose are digits of the index, the state within it is the lowest.
std::uint64_t key_index(std::uint64_t repeat, Protocol protocol, bool fusion, std::uint64_t state) {
  return ((repeat * 2 + (protocol == Protocol::kGroup ? 1 : 0)) * 2 + (fusion ? 1 : 0)) * 1000000u + state;
}

// Added to the index of state 0: the order of the states has a key above those of the states themselves.
constexpr std::uint64_t kOrderOfStates = std::uint64_t{1} << 32;

template <class T>
void shuffle(std::vector<T>& values, const RandomKey& key) {
  Random random(key);
  shuffle(values, random);
}

Split cut(std::span<const RowGroup> rows, const std::vector<std::size_t>& candidates, Protocol protocol,
          double fraction, std::uint64_t seed, std::uint64_t repeat, bool fusion) {
  Split split;
  if (protocol == Protocol::kRandom) {
    std::vector<std::size_t> order = candidates;
    shuffle(order, {seed, Stream::kSplit, key_index(repeat, protocol, fusion, 0)});
    const auto middle = order.begin() + std::lround(fraction * static_cast<double>(order.size()));
    split.train.assign(order.begin(), middle);
    split.test.assign(middle, order.end());
  } else {
    std::map<std::int64_t, std::set<std::int64_t>> groups_of_state;
    for (const std::size_t row : candidates) groups_of_state[rows[row].sea_state].insert(rows[row].group);
    std::vector<std::int64_t> states;
    for (const auto& [state, groups] : groups_of_state) states.push_back(state);
    // With a fixed order the carried rounding would take the test groups of every repeat from the same states.
    shuffle(states, {seed, Stream::kSplit, kOrderOfStates + key_index(repeat, protocol, fusion, 0)});
    std::set<std::int64_t> chosen;
    double target_count = 0;
    for (const std::int64_t state : states) {
      const std::set<std::int64_t>& groups = groups_of_state[state];
      std::vector<std::int64_t> order(groups.begin(), groups.end());
      shuffle(order, {seed, Stream::kSplit, key_index(repeat, protocol, fusion, static_cast<std::uint64_t>(state))});
      target_count += fraction * static_cast<double>(order.size());
      const long all = static_cast<long>(order.size());
      long count = std::lround(target_count - static_cast<double>(chosen.size()));
      count = all >= 2 ? std::clamp(count, 1L, all - 1) : std::clamp(count, 0L, all);
      chosen.insert(order.begin(), order.begin() + count);
    }
    for (const std::size_t row : candidates)
      (chosen.contains(rows[row].group) ? split.train : split.test).push_back(row);
  }
  std::sort(split.train.begin(), split.train.end());
  std::sort(split.test.begin(), split.test.end());
  return split;
}

}  // namespace

const char* name(Protocol protocol) { return protocol == Protocol::kRandom ? "random" : "group"; }

Split split_rows(std::span<const RowGroup> rows, Protocol protocol, double train_fraction, std::uint64_t seed,
                 std::uint64_t repeat) {
  std::vector<std::size_t> all(rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return cut(rows, all, protocol, train_fraction, seed, repeat, false);
}

Split split_for_fusion(std::span<const RowGroup> rows, const Split& split, Protocol protocol, double network_fraction,
                       std::uint64_t seed, std::uint64_t repeat) {
  return cut(rows, split.train, protocol, network_fraction, seed, repeat, true);
}

namespace {

constexpr const char* kBySea = "split by sea realisation (no test sea was seen in training)";

// The values that --hold-out names, of a column of numbers.
std::pair<double, double> held_interval(const HoldOut& held) {
  const std::size_t colon = held.value.find(':');
  const auto low = parse_number(held.value.substr(0, colon));
  const auto high = colon == std::string::npos ? low : parse_number(held.value.substr(colon + 1));
  if (!low || !high || *low > *high) {
    throw InputError(
        fmt::format("hold-out {}={}: must be a number or LOW:HIGH with LOW <= HIGH", held.column, held.value));
  }
  return {*low, *high};
}

std::vector<bool> rows_with(std::span<const DataRow> rows, const HoldOut& held) {
  const ColumnOfRows column = column_of(rows, held.column);
  std::vector<bool> has(rows.size());
  if (column.is_text) {
    for (std::size_t row = 0; row < rows.size(); ++row) has[row] = column.texts[row] == held.value;
  } else {
    const auto [low, high] = held_interval(held);
    for (std::size_t row = 0; row < rows.size(); ++row)
      has[row] = column.numbers[row] >= low && column.numbers[row] <= high;
  }
  if (std::find(has.begin(), has.end(), true) == has.end()) {
    std::vector<std::string> values;
    constexpr std::size_t kMostShown = 6;
    for (const ColumnBin& bin : bins_of(column, kMostShown, 1)) values.push_back(bin.text);
    if (values.size() > kMostShown) {
      values.resize(kMostShown);
      values.push_back("...");
    }
    throw InputError(fmt::format("hold-out {}={}: no map has this value; the data have {}", held.column, held.value,
                                 fmt::join(values, ", ")));
  }
  return has;
}

std::string text_of(const DivisionRequest& request) {
  std::string text = request.by == "sea" ? kBySea : fmt::format("split by {}", request.by);
  if (request.hold_out.empty()) return text;
  std::vector<std::string> values;
  for (const HoldOut& held : request.hold_out) values.push_back(held.column + "=" + held.value);
  return fmt::format("tested on {} only; {}", fmt::join(values, ", "), text);
}

}  // namespace

DivisionRequest division_request(const SplitSpec& split) {
  DivisionRequest request{split.by, {}};
  for (const HoldOutSpec& column : split.hold_out)
    for (const std::string& value : column.values) request.hold_out.push_back({column.column, value});
  return request;
}

Division division_by_sea(std::span<const RowGroup> seas) { return {{seas.begin(), seas.end()}, {}, {}, "sea", kBySea}; }

Division make_division(std::span<const DataRow> rows, std::span<const RowGroup> seas, std::span<const int> labels,
                       const DivisionRequest& request) {
  Division division = division_by_sea(seas);
  division.labels.assign(labels.begin(), labels.end());
  division.by = request.by;
  division.text = text_of(request);
  if (request.by != "sea") {
    constexpr std::size_t kEveryValue = static_cast<std::size_t>(-1);
    const std::vector<ColumnBin> values = bins_of(column_of(rows, request.by), kEveryValue, 1);
    for (std::size_t value = 0; value < values.size(); ++value)
      for (const std::size_t row : values[value].rows) division.units[row] = {static_cast<std::int64_t>(value), 0};
  }
  if (request.hold_out.empty()) return division;

  std::map<std::string, std::vector<bool>> by_column;
  for (const HoldOut& held : request.hold_out) {
    const std::vector<bool> has = rows_with(rows, held);
    std::vector<bool>& any = by_column.try_emplace(held.column, rows.size(), false).first->second;
    for (std::size_t row = 0; row < rows.size(); ++row) any[row] = any[row] || has[row];
  }
  division.held_out.assign(rows.size(), true);
  for (const auto& [column, has] : by_column)
    for (std::size_t row = 0; row < rows.size(); ++row) division.held_out[row] = division.held_out[row] && has[row];
  const auto held = std::count(division.held_out.begin(), division.held_out.end(), true);
  if (held == 0) throw InputError("hold-out: no map has the values of all columns");
  if (static_cast<std::size_t>(held) == rows.size())
    throw InputError(fmt::format("hold-out: all {} maps are held out: nothing is left to train on", rows.size()));
  return division;
}

Split divide(const Division& division, Protocol protocol, double train_fraction, std::uint64_t seed,
             std::uint64_t repeat) {
  if (protocol == Protocol::kRandom || division.held_out.empty())
    return split_rows(division.units, protocol, train_fraction, seed, repeat);

  std::set<int> concerned;
  for (std::size_t row = 0; row < division.units.size(); ++row)
    if (division.held_out[row]) concerned.insert(division.labels[row]);
  struct Count {
    std::size_t with = 0, without = 0;
  };
  std::map<std::int64_t, Count> counts;
  for (std::size_t row = 0; row < division.units.size(); ++row) {
    Count& count = counts[division.units[row].group];
    if (concerned.contains(division.labels[row])) ++(division.held_out[row] ? count.with : count.without);
  }

  std::vector<std::size_t> train, test, divided;
  std::vector<RowGroup> divided_units;
  for (std::size_t row = 0; row < division.units.size(); ++row) {
    const Count& count = counts[division.units[row].group];
    if ((count.with == 0) != (count.without == 0)) {
      (count.with > 0 ? test : train).push_back(row);
      continue;
    }
    divided.push_back(row);
    divided_units.push_back(division.units[row]);
  }
  if (!divided.empty()) {
    const Split split = split_rows(divided_units, protocol, train_fraction, seed, repeat);
    for (const std::size_t i : split.train) train.push_back(divided[i]);
    for (const std::size_t i : split.test) test.push_back(divided[i]);
  }
  Split result;
  for (const std::size_t row : train)
    if (!division.held_out[row]) result.train.push_back(row);
  for (const std::size_t row : test)
    if (division.held_out[row] || !concerned.contains(division.labels[row])) result.test.push_back(row);
  std::sort(result.train.begin(), result.train.end());
  std::sort(result.test.begin(), result.test.end());
  return result;
}

}  // namespace seaglint
