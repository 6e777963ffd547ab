// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/cst_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

Complex amplitude_of(double level_dbsm, double phase_rad) {
  return std::polar(std::sqrt(std::pow(10.0, level_dbsm / 10) / (4 * kPi)), phase_rad);
}

bool transmits_v(Polarisation element) { return element == Polarisation::kHv || element == Polarisation::kVv; }
bool receives_v(Polarisation element) { return element == Polarisation::kVh || element == Polarisation::kVv; }

std::string squeezed(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c != ' ' && c != '\t') out += c;
  }
  return out;
}

struct CstColumn {
  std::string name, unit;  // without spaces
};

// `Theta [deg.] Phi [deg.] Abs(RCS )[dB(m^2)] ...`: names and units contain padding, so that only brackets separate
// them.
std::vector<CstColumn> cst_columns(const TextSource& source, std::string_view header) {
  std::vector<CstColumn> columns;
  for (std::size_t at = 0;;) {
    const std::size_t open = header.find('[', at);
    if (open == std::string::npos) return columns;
    const std::size_t close = header.find(']', open);
    if (close == std::string::npos) source.fail(header.substr(open), "a unit's bracket is not closed");
    columns.push_back({squeezed(header.substr(at, open - at)), squeezed(header.substr(open + 1, close - open - 1))});
    at = close + 1;
  }
}

// Level in dBsm of a value in the column's unit.
class CstUnit {
 public:
  CstUnit(const TextSource& source, std::string_view header, const CstColumn& column, double wavelength_m) {
    std::string unit = column.unit;
    decibel_ = unit.starts_with("dB");
    if (unit == "dB") {
      source.fail(header,
                  fmt::format("column {} [dB] is relative to its own maximum: export absolute values, m^2 or dB(m^2)",
                              column.name));
    }
    if (unit == "dBsm") unit = "dB(m^2)";
    if (decibel_) unit = unit.size() > 4 && unit[2] == '(' ? unit.substr(3, unit.size() - 4) : unit.substr(2);
    if (unit == "m^2") {
      offset_db_ = 0;
    } else if (unit == "mm^2") {
      offset_db_ = -60;
    } else if (unit == "cm^2") {
      offset_db_ = -40;
    } else if (unit == "lambda^2") {
      offset_db_ = 20 * std::log10(wavelength_m);
    } else {
      source.fail(header,
                  fmt::format("column {} [{}]: the unit must be m^2, cm^2, mm^2, lambda^2, or dB() of one of them",
                              column.name, column.unit));
    }
  }
  double level(const TextTable& table, std::size_t row, std::size_t column) const {
    if (decibel_) return std::max(table.level(row, column), kMinLevel_dbsm) + offset_db_;
    const double area = table.number(row, column, 0);
    return std::max(10 * std::log10(std::max(area, 1e-300)) + offset_db_, kMinLevel_dbsm);
  }

 private:
  bool decibel_ = false;
  double offset_db_ = 0;
};

}  // namespace

bool is_cst_header(std::string_view line) {
  const auto has = [&](const char* part) { return line.find(part) != std::string_view::npos; };
  return has("Theta") && has("Abs(") && has("[");
}

std::vector<ReferenceSample> read_cst_table(const TextSource& source, Polarisation element,
                                            std::optional<double> given_frequency_hz) {
  std::string_view rest = source.text(), header;
  do header = next_line(rest);
  while (is_comment(header) || !is_cst_header(header));
  header = trimmed(header);
  const std::vector<CstColumn> columns = cst_columns(source, header);
  if (!given_frequency_hz)
    source.fail(header, "a CST table does not say its frequency: give --reference-frequency-ghz");
  const double frequency_hz = *given_frequency_hz;

  std::vector<std::string> names;
  for (const CstColumn& column : columns) names.push_back(column.name);
  const auto column = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto place = std::find(names.begin(), names.end(), name);
    if (place == names.end()) return std::nullopt;
    return static_cast<std::size_t>(place - names.begin());
  };
  const std::string component = receives_v(element) ? "Theta" : "Phi";
  const auto theta = column("Theta"), phi = column("Phi"), magnitude = column("Abs(" + component + ")"),
             phase = column("Phase(" + component + ")");
  if (!theta || !phi) source.fail(header, "no columns Theta[deg.] and Phi[deg.]");
  for (const std::size_t angle : {*theta, *phi, phase.value_or(*phi)}) {
    if (columns[angle].unit.starts_with("deg")) continue;
    source.fail(header, fmt::format("{} in [{}]: must be in degrees", columns[angle].name, columns[angle].unit));
  }
  if (!magnitude) {
    source.fail(header, fmt::format("no column Abs({}), which {} needs", component,
                                    kPolarisationNames[static_cast<int>(element)]));
  }
  const CstUnit unit(source, header, columns[*magnitude], kSpeedOfLight / frequency_hz);

  const bool cross = transmits_v(element) != receives_v(element);
  std::vector<ReferenceSample> samples;
  const TextTable table = TextTable::below(source, rest, names, ' ');
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ReferenceSample sample;
    sample.frequency_hz = frequency_hz;
    sample.theta_deg = table.number(row, *theta);
    sample.phi_deg = table.number(row, *phi);
    const bool folded = fold_direction(sample.theta_deg, sample.phi_deg);
    sample.level_dbsm = unit.level(table, row, *magnitude);
    if (phase) {
      sample.amplitude_m = amplitude_of(sample.level_dbsm, radians(table.number(row, *phase))) * (folded ? -1.0 : 1.0) *
                           (cross ? -1.0 : 1.0);
    }
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace seaglint
