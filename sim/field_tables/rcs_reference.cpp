// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/rcs_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/text/column_key.h"
#include "sim/core/text/number.h"
#include "sim/core/text/text_rows.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/cst_table.h"
#include "sim/field_tables/transmitter_keys.h"

namespace seaglint {
namespace {

// A level of the table in dBsm; that of an exact zero, minus infinity, becomes kMinLevel_dbsm.
double level_dbsm(const TextTable& table, std::size_t row, std::size_t column) {
  return std::max(table.level(row, column), kMinLevel_dbsm);
}

// Frequency, theta, phi and level, by their names or, without names, in this order in Hz.
void read_four_columns(const TextTable& table, RcsReference& reference) {
  const double to_hz = table.key(0).ends_with("_ghz") ? 1e9 : table.key(0).ends_with("_mhz") ? 1e6 : 1;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ReferenceSample sample{
        table.positive(row, 0) * to_hz, table.number(row, 1), table.number(row, 2), level_dbsm(table, row, 3), {}};
    fold_direction(sample.theta_deg, sample.phi_deg);
    reference.samples.push_back(sample);
  }
}

std::vector<TableColumn> four_columns() {
  return {TableColumn::one_of({"frequency_hz", "frequency_ghz", "frequency_mhz"}), "theta_deg", "phi_deg",
          TableColumn::one_of({"dbsm", "level_dbsm", "rcs_dbsm"})};
}

// Transmitter that a comment of a `seaglint rcs` table states; empty if none does.
std::optional<DeclaredTransmitter> stated_transmitter(const TextSource& source) {
  for (std::string_view rest = source.text(); !rest.empty();) {
    const std::string_view line = next_line(rest);
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
void require_transmitter(const RcsReference& reference, const TextSource& source) {
  if (reference.transmitter || !source.text().starts_with("# seaglint ")) return;
  throw InputError(
      fmt::format("{}: its head does not state the transmitter: add the line '{}', or '{}' with its angles, or make "
                  "the table again",
                  source.name(), transmitter_line({}), transmitter_line(FixedTransmitter{})));
}

// The table of `seaglint rcs`.
void read_own_table(const TextSource& source, RcsReference& reference) {
  reference.transmitter = stated_transmitter(source);
  const std::string element = kPolarisationNames[static_cast<int>(reference.element)];
  const auto optional = [&](const char* part) { return TableColumn({element + part}, false); };
  const TextTable table(
      source, {"frequency_hz", "azimuth_deg", "elevation_deg", optional("_re"), optional("_im"), optional("_dbsm")}, 0);
  constexpr std::size_t kRe = 3, kIm = 4, kLevel = 5;
  const bool complex = table.has(kRe) && table.has(kIm);
  if (!complex && !table.has(kLevel)) {
    throw InputError(fmt::format("{0}: neither columns {1}_re and {1}_im nor {1}_dbsm", source.name(), element));
  }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ReferenceSample sample;
    sample.frequency_hz = table.positive(row, 0);
    sample.theta_deg = 90 - table.number(row, 2);
    sample.phi_deg = table.number(row, 1);
    fold_direction(sample.theta_deg, sample.phi_deg);
    if (complex) sample.amplitude_m = Complex(table.number(row, kRe), table.number(row, kIm));
    sample.level_dbsm = complex ? dbsm(*sample.amplitude_m) : level_dbsm(table, row, kLevel);
    reference.samples.push_back(sample);
  }
  require_transmitter(reference, source);
}

enum class Format { kFourColumns, kFourNamedColumns, kOwnTable, kCstTable };

constexpr const char* name_of(Format format) {
  if (format == Format::kOwnTable) return "a table of seaglint rcs";
  return format == Format::kCstTable ? "a CST farfield table" : "four columns";
}

// The format by the first line that is no comment and, for names below lines of text, by the following ones.
Format format_of(const TextSource& source) {
  constexpr int kMaxLines = 20;
  std::string_view rest = source.text();
  for (int n = 0; n < kMaxLines && !rest.empty();) {
    const std::string_view text = rest, line = next_line(rest);
    if (line.starts_with("// CST Farfield Source")) {
      throw InputError(
          fmt::format("{}: a CST farfield source (.ffs) is not read: export the RCS as an ASCII table", source.name()));
    }
    if (trimmed(line).empty() || is_comment(line)) continue;
    ++n;
    if (is_cst_header(line)) return Format::kCstTable;
    for (const char separator : kSeparators) {
      std::string_view row = text;
      const std::vector<std::string_view> cells = next_row(row, separator).cells;
      std::vector<std::string> keys;
      for (const std::string_view cell : cells) keys.push_back(column_key(cell));
      const auto has = [&](const char* key) { return std::find(keys.begin(), keys.end(), key) != keys.end(); };
      if (has("frequency_hz") && (has("azimuth_deg") || has("elevation_deg"))) return Format::kOwnTable;
      if (has("theta_deg") && has("phi_deg")) return Format::kFourNamedColumns;
      if (cells.size() >= 3 && cells.size() <= 5 && parse_number(cells[0])) return Format::kFourColumns;
    }
  }
  throw InputError(
      fmt::format("{}: not a cut of the radar cross section: neither four columns (frequency_hz theta_deg phi_deg "
                  "dBsm), nor a table of seaglint "
                  "rcs, nor a CST farfield table",
                  source.name()));
}

Polarisation polarisation_of(const std::string& name, const ReferenceSettings& settings) {
  if (settings.element) return *settings.element;
  if (name.find(".H.") != std::string::npos) return Polarisation::kHh;
  if (name.find(".V.") != std::string::npos) return Polarisation::kVv;
  throw InputError(fmt::format("{}: its name does not say the polarisation: give --reference-polarisation", name));
}

// Throws InputError if a frequency is given that differs from the file's.
void require_own_frequency(const RcsReference& reference, const std::string& file) {
  if (!reference.settings.frequency_hz) return;
  constexpr double kTolerance = 1e-6;
  for (const ReferenceSample& sample : reference.samples) {
    if (std::abs(sample.frequency_hz - *reference.settings.frequency_hz) <= kTolerance * sample.frequency_hz) continue;
    throw InputError(fmt::format("{}: declares {:g} GHz: remove --reference-frequency-ghz {:g}", file,
                                 sample.frequency_hz * 1e-9, *reference.settings.frequency_hz * 1e-9));
  }
}

}  // namespace

RcsReference read_reference(const std::filesystem::path& file, const ReferenceSettings& settings) {
  RcsReference reference;
  const TextSource source = TextSource::read(file);
  const Format format = format_of(source);
  reference.name = file.filename().string();
  reference.settings = settings;
  reference.element = polarisation_of(reference.name, settings);
  try {
    switch (format) {
      case Format::kFourColumns: read_four_columns(TextTable::without_names(source, four_columns()), reference); break;
      case Format::kFourNamedColumns: read_four_columns(TextTable(source, four_columns(), 0), reference); break;
      case Format::kOwnTable: read_own_table(source, reference); break;
      case Format::kCstTable:
        reference.samples = read_cst_table(source, reference.element, settings.frequency_hz);
        break;
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} (read as {})", error.what(), name_of(format)));
  }
  if (reference.samples.empty()) throw InputError(fmt::format("{}: contains no values", file.string()));
  require_own_frequency(reference, file.string());
  return reference;
}

}  // namespace seaglint
