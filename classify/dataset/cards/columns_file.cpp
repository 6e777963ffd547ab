// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/cards/columns_file.h"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>
#include <variant>
#include <vector>

#include "classify/dataset/format/layout.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"

namespace seaglint {

namespace {

template <class T>
std::string cell(const T& value) {
  if constexpr (std::is_same_v<T, std::string>) {
    return csv_cell(value);
  } else {
    if constexpr (std::is_same_v<T, double>) {
      if (std::isnan(value)) return "";
    }
    return fmt::format("{}", value);
  }
}

std::string line_of(const SampleRecord& record, const std::string& shard, std::size_t row) {
  std::string line;
  for (const SampleColumn& column : sample_columns())
    std::visit([&](auto member) { line += cell(record.*member) + ','; }, column.member);
  line += fmt::format("{},{}", csv_cell(shard), row);
  visit_drawn(record, [&](const std::string&, const auto& value) { line += ',' + cell(value); });
  return line + '\n';
}

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, std::int64_t>) return "Integer";
  if constexpr (std::is_same_v<T, double>) return "Float";
  if constexpr (std::is_same_v<T, std::string>) return "Text";
}

std::vector<TableEntry> all_entries() {
  std::vector<TableEntry> entries;
  for (const SampleColumn& column : sample_columns()) {
    std::visit(
        [&](auto member) {
          using T = typename MemberType<decltype(member)>::Type;
          const bool is_text = std::is_same_v<T, std::string>;
          entries.push_back({column.name, is_text ? "" : column.unit, column.description, type_name<T>()});
        },
        column.member);
  }
  entries.push_back({"shard", "", "HDF5 file that has the sample's map", "Text"});
  entries.push_back({"row", "1", "row of the sample in the arrays of that file, from 0", "Integer"});
  return entries;
}

}  // namespace

std::span<const TableEntry> table_entries() {
  static const std::vector<TableEntry> entries = all_entries();
  return entries;
}

std::vector<TableEntry> drawn_entries(const DrawnKeys& keys) {
  std::vector<TableEntry> entries;
  for (const std::string& key : keys.numbers)
    entries.push_back({key, drawn_text(key).units, drawn_text(key).description, "Float"});
  for (const std::string& key : keys.words) entries.push_back({key, "", drawn_text(key).description, "Text"});
  return entries;
}

std::string table_header() {
  std::string line;
  for (const TableEntry& entry : table_entries()) line += (line.empty() ? "" : ",") + entry.name;
  return line;
}

void write_columns_file(const DatasetReader& reader, const std::filesystem::path& file, const StopFlag* stop) {
  Progress progress("reading shards", reader.shards());
  write_blocks(file, [&](const AppendText& append) {
    for (std::size_t i = 0; i < reader.shards(); ++i) {
      if (stop && *stop) throw Interrupted();
      const Shard shard = reader.shard(i);
      std::string lines;
      if (i == 0) {
        lines = table_header();
        for (const TableEntry& entry : drawn_entries(drawn_keys(shard.samples.front().record)))
          lines += ',' + entry.name;
        lines += '\n';
      }
      for (std::size_t row = 0; row < shard.samples.size(); ++row)
        lines += line_of(shard.samples[row].record, reader.manifest().shards[i].file, row);
      append(lines);
      progress.advance();
    }
  });
}

}  // namespace seaglint
