// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// columns.csv: the columns of all samples as one table (RFC 4180), for programs that read no HDF5.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/layout.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// A column of the table: those of the samples, then where the map is: shard (name of the file) and row (in its arrays).
struct TableEntry {
  std::string name;
  std::string unit;  // "1" if dimensionless, "" for text
  std::string description;
  const char* type;  // schema.org's: Integer, Float, Text
};
std::span<const TableEntry> table_entries();

// Those of drawn keys, which follow.
std::vector<TableEntry> drawn_entries(const DrawnKeys& keys);

// The first line of the table.
std::string table_header();

// Reads and checks every shard and writes the table, a line per sample in their order. Numbers are the shortest text of
// the same double; a value that is not a number is an empty cell. Memory holds one shard. Throws InputError naming a
// damaged shard, WorkError when the file cannot be written, Interrupted when *stop becomes true.
void write_columns_file(const DatasetReader& reader, const std::filesystem::path& file, const StopFlag* stop = nullptr);

}  // namespace seaglint
