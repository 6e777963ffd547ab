// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Division of rows into training and test rows by keyed shuffles (stream kSplit), the same on every machine: by rows,
// by whole seas, or by the values of any column, with values that are held out for testing.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "classify/model/data_rows.h"
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

// Rows that are held out: those whose column has this value, text or number, or lies within LOW:HIGH, both included.
struct HoldOut {
  std::string column;
  std::string value;
};

struct DivisionRequest {
  std::string by = "sea";         // column whose values are on one side each
  std::vector<HoldOut> hold_out;  // values of one column: any of them; several columns: all of them
  bool is_default() const { return by == "sea" && hold_out.empty(); }
};

// That of a scenario's learning.split.
DivisionRequest division_request(const SplitSpec& split);

// How the group protocol divides rows. A unit is all rows with one value of the column `by`.
struct Division {
  std::vector<RowGroup> units;  // of every row
  std::vector<bool> held_out;   // of every row; empty without values held out
  std::vector<int> labels;      // of every row; needed where values are held out
  std::string by = "sea";
  std::string text;  // "split by sea realisation (no test sea was seen in training)"
};

// Whole seas within each sea state, nothing held out.
Division division_by_sea(std::span<const RowGroup> seas);

// `seas`: sea and sea state of every row. Values of other columns than the sea are divided without regard to the sea
// state. Throws InputError for an unknown column, a value that is not a number in a column of numbers, a value that no
// row has, and values that all rows have.
Division make_division(std::span<const DataRow> rows, std::span<const RowGroup> seas, std::span<const int> labels,
                       const DivisionRequest& request);

// Rows of a split that are on neither side are unused. kRandom: split_rows() of all rows. kGroup: units are divided by
// split_rows(). With values held out, the classes concerned are those with a row that has them. A unit whose rows of
// these classes all have them is tested, one in which none has them is trained on; the others are divided, and of the
// classes concerned only rows without them are trained on and only rows with them tested. So no unit is on both sides,
// and a class that is not concerned (the ship, where a layout of reflectors is held out) is on both.
Split divide(const Division& division, Protocol protocol, double train_fraction, std::uint64_t seed,
             std::uint64_t repeat);

}  // namespace seaglint
