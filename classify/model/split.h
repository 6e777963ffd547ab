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

// Grouping of a row.
struct RowGroup {
  std::int64_t group = 0;      // sea realisation
  std::int64_t sea_state = 0;  // groups are divided within each sea state
};

// Row numbers, ascending.
struct Split {
  std::vector<std::size_t> train;
  std::vector<std::size_t> test;
};

// kRandom: rows are shuffled and divided (as in the paper: maps of one sea are on both sides). kGroup: whole groups are
// shuffled and divided within each sea state, so that no test map shares its sea with a training map. `train_fraction`
// of the rows or groups go to `train`; rounding is carried from state to state, in an order of the states that is
// shuffled for every repeat; each side gets at least one group if there are two.
Split split_rows(std::span<const RowGroup> rows, Protocol protocol, double train_fraction, std::uint64_t seed,
                 std::uint64_t repeat);

// Divides the training rows of a split again by the same method: `train` is for the network, `test` for the trees.
Split split_for_fusion(std::span<const RowGroup> rows, const Split& split, Protocol protocol, double network_fraction,
                       std::uint64_t seed, std::uint64_t repeat);

}  // namespace seaglint
