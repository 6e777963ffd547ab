// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Divisions of rows into training and test rows, by keyed shuffles (stream kSplit): the same on every machine.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/scenario/learning_spec.h"

namespace seaglint {

enum class Protocol { kRandom, kGroup };
const char* name(Protocol protocol);  // "random", "group"

// What a split must know of a row.
struct RowGroup {
  std::int64_t group = 0;      // sea realisation
  std::int64_t sea_state = 0;  // groups are shared out within each sea state
};

// Row numbers, ascending.
struct Split {
  std::vector<std::size_t> train;
  std::vector<std::size_t> test;
};

// kRandom: rows are shuffled and cut at the share (the paper's way: maps of one sea lie on both sides). kGroup: whole
// groups are shuffled and cut, state by state, so that no test map shares its sea with a training map. `train_fraction`
// of the rows or groups go to `train`; rounding is carried from state to state, in an order of the states that is
// shuffled for every repeat, and both sides get one group at least where there are two.
Split split_rows(std::span<const RowGroup> rows, Protocol protocol, double train_fraction, std::uint64_t seed,
                 std::uint64_t repeat);

// Cuts the training rows of a split once more in the same manner: `train` is for the network, `test` for the trees.
Split split_for_fusion(std::span<const RowGroup> rows, const Split& split, Protocol protocol, double network_fraction,
                       std::uint64_t seed, std::uint64_t repeat);

}  // namespace seaglint
