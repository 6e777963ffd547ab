// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/split.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "sim/core/numbers/random.h"

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
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[random.below(static_cast<std::uint32_t>(i))]);
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

}  // namespace seaglint
