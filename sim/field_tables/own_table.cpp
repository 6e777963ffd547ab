// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/own_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/rows/first_rows.h"
#include "sim/field_tables/transmitter_keys.h"

namespace seaglint {
namespace {

// Transmitter that a comment of the table states; empty if none does.
std::optional<DeclaredTransmitter> stated_transmitter(const TextSource& source) {
  for (std::string_view rest = source.text(); !rest.empty();) {
    const std::string_view line = next_line(rest);
    if (!line.starts_with('#')) continue;
    try {
      const std::optional<TransmitterKeys> keys = read_transmitter_line(std::string(line));
      if (!keys) continue;
      if (!keys->fixed) return DeclaredTransmitter{};
      DeclaredTransmitter transmitter{false, 90 - keys->fixed->elevation_deg, keys->fixed->azimuth_deg};
      fold_direction(transmitter.theta_deg, transmitter.phi_deg);
      return transmitter;
    } catch (const InputError& error) {
      source.fail(line, error.what());
    }
  }
  return std::nullopt;
}

// Throws InputError for a table whose head was written by `seaglint rcs`, but states no transmitter.
void require_transmitter(const std::optional<DeclaredTransmitter>& transmitter, const TextSource& source) {
  if (transmitter || !source.text().starts_with("# seaglint ")) return;
  throw InputError(
      fmt::format("{}: its head does not state the transmitter: add the line '{}', or '{}' with its angles, or make "
                  "the table again",
                  source.name(), transmitter_line({}), transmitter_line(FixedTransmitter{})));
}

// Columns of the request: frequency, azimuth, elevation, then three for each element.
constexpr std::size_t kAngles = 3;

std::vector<TableColumn> columns_of_all() {
  std::vector<TableColumn> columns{"frequency_hz", "azimuth_deg", "elevation_deg"};
  for (const char* element : kPolarisationNames) {
    for (const char* part : {"_re", "_im", "_dbsm"})
      columns.emplace_back(std::vector{std::string(element) + part}, false);
  }
  return columns;
}

struct ElementColumns {
  std::size_t re, im, level;
  explicit ElementColumns(Polarisation element)
      : re(kAngles + 3 * static_cast<std::size_t>(element)), im(re + 1), level(re + 2) {}
};

}  // namespace

bool is_own_table(const TextSource& source) {
  const bool has_head = source.text().starts_with("# seaglint ");
  return any_first_row(source, [&](const FirstRow& row) {
    const bool azimuth = row.has("azimuth_deg"), elevation = row.has("elevation_deg");
    const bool phases = std::any_of(row.keys.begin(), row.keys.end(),
                                    [](const std::string& key) { return key.find("phase") != std::string::npos; });
    return row.has("frequency_hz") && (has_head ? azimuth || elevation : azimuth && elevation && !phases);
  });
}

void read_own_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  table.notes.emplace_back("e^{+jwt}, h and v of CONVENTIONS.md");
  std::optional<DeclaredTransmitter> transmitter = stated_transmitter(source);
  require_transmitter(transmitter, source);
  if (!transmitter) transmitter = settings.transmitter;
  const TextTable rows(source, columns_of_all(), 0);
  std::vector<Polarisation> elements = settings.elements;
  const auto is_complex = [&](Polarisation element) {
    const ElementColumns columns(element);
    return rows.has(columns.re) && rows.has(columns.im);
  };
  if (elements.empty()) {
    for (const Polarisation element : {Polarisation::kHh, Polarisation::kHv, Polarisation::kVh, Polarisation::kVv}) {
      if (is_complex(element) || rows.has(ElementColumns(element).level)) elements.push_back(element);
    }
    if (elements.empty()) throw InputError(fmt::format("{}: no column of amplitudes or levels", source.name()));
  }
  for (const Polarisation element : elements) {
    const ElementColumns columns(element);
    const bool complex = is_complex(element);
    if (!complex && !rows.has(columns.level)) {
      const char* name = kPolarisationNames[static_cast<int>(element)];
      throw InputError(fmt::format("{0}: neither columns {1}_re and {1}_im nor {1}_dbsm", source.name(), name));
    }
    RcsCut cut;
    cut.element = element;
    cut.transmitter = transmitter;
    cut.values.reserve(rows.rows());
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      FieldValue value{rows.positive(row, 0), 90 - rows.number(row, 2), rows.number(row, 1), 0, {}, rows.line(row)};
      fold_direction(value.theta_deg, value.phi_deg);
      if (complex) value.amplitude_m = Complex(rows.number(row, columns.re), rows.number(row, columns.im));
      value.level_dbsm = complex ? std::max(dbsm(*value.amplitude_m), kMinLevel_dbsm)
                                 : std::max(rows.level(row, columns.level), kMinLevel_dbsm);
      cut.values.push_back(value);
    }
    table.cuts.push_back(std::move(cut));
  }
}

}  // namespace seaglint
