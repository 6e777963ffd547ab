// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/text_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/text_table.h"
#include "sim/field_tables/rows/first_rows.h"

namespace seaglint {
namespace {

std::vector<TableColumn> four_columns() {
  return {TableColumn::one_of({"frequency_hz", "frequency_ghz", "frequency_mhz"}), "theta_deg", "phi_deg",
          TableColumn::one_of({"dbsm", "level_dbsm", "rcs_dbsm"})};
}

// Throws InputError unless exactly one element is wanted.
Polarisation only_element(const std::string& file, const FieldTableSettings& settings) {
  if (settings.elements.size() == 1) return settings.elements[0];
  throw InputError(
      fmt::format("{}: its name does not say the polarisation: give --reference-polarisation hh, hv, vh or vv", file));
}

void read_levels(const TextTable& rows, const FieldTableSettings& settings, FieldTable& table) {
  RcsCut cut;
  cut.element = only_element(rows.source().name(), settings);
  cut.transmitter = settings.transmitter;
  const double to_hz = rows.key(0).ends_with("_ghz") ? 1e9 : rows.key(0).ends_with("_mhz") ? 1e6 : 1;
  for (std::size_t row = 0; row < rows.rows(); ++row) {
    FieldValue value{rows.positive(row, 0) * to_hz,
                     rows.number(row, 1),
                     rows.number(row, 2),
                     std::max(rows.level(row, 3), kMinLevel_dbsm),
                     {},
                     rows.line(row)};
    fold_direction(value.theta_deg, value.phi_deg);
    cut.values.push_back(value);
  }
  table.cuts.push_back(std::move(cut));
}

}  // namespace

bool is_four_columns(const TextSource& source) {
  return any_first_row(source, [](const FirstRow& row) {
    return row.cells.size() >= 3 && row.cells.size() <= 5 && parse_number(row.cells[0]).has_value();
  });
}

bool has_named_angles(const TextSource& source) {
  return any_first_row(source, [](const FirstRow& row) { return row.has("theta_deg") && row.has("phi_deg"); });
}

void read_four_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  read_levels(TextTable::without_names(source, four_columns()), settings, table);
}

void read_named_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  read_levels(TextTable(source, four_columns(), 0), settings, table);
}

}  // namespace seaglint
