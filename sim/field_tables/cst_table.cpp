// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/cst_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/level_unit.h"

namespace seaglint {
namespace {

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

// The columns of a table by name, with units.
class CstTable {
 public:
  CstTable(const TextSource& source, double frequency_hz) : source_(source) {
    std::string_view rest = source.text();
    do header_ = next_line(rest);
    while (is_comment(header_) || !is_cst_header(header_));
    header_ = trimmed(header_);
    columns_ = cst_columns(source, header_);
    wavelength_m_ = kSpeedOfLight / frequency_hz;
    std::vector<std::string> names;
    for (const CstColumn& column : columns_) names.push_back(column.name);
    rows_ = std::make_unique<TextTable>(TextTable::below(source, rest, names, ' '));
  }

  const TextTable& rows() const { return *rows_; }
  std::string_view header() const { return header_; }

  std::optional<std::size_t> find(const std::string& name) const {
    const auto place =
        std::find_if(columns_.begin(), columns_.end(), [&](const CstColumn& c) { return c.name == name; });
    if (place == columns_.end()) return std::nullopt;
    return static_cast<std::size_t>(place - columns_.begin());
  }
  // A column of angles. Throws InputError for another unit, and without it unless it is optional.
  std::optional<std::size_t> find_angle(const std::string& name, bool required) const {
    const std::optional<std::size_t> column = find(name);
    if (!column && required) source_.fail(header_, fmt::format("no column {}[deg.]", name));
    if (column && !columns_[*column].unit.starts_with("deg"))
      source_.fail(header_, fmt::format("{} in [{}]: must be in degrees", name, columns_[*column].unit));
    return column;
  }
  LevelUnit unit_of(std::size_t column) const {
    return LevelUnit(source_, header_, columns_[column].name, columns_[column].unit, wavelength_m_);
  }

 private:
  const TextSource& source_;
  std::string_view header_;
  std::vector<CstColumn> columns_;
  double wavelength_m_ = 0;
  std::unique_ptr<TextTable> rows_;
};

// A field component: level, and phase where the table has it.
struct CstComponent {
  std::size_t magnitude = 0;
  std::optional<std::size_t> phase;
  LevelUnit unit;

  double level_dbsm(const TextTable& rows, std::size_t row) const { return unit.level_dbsm(rows, row, magnitude); }
  Complex field_m(const TextTable& rows, std::size_t row) const {
    return std::polar(amplitude_of_dbsm(level_dbsm(rows, row)), radians(rows.number(row, *phase)));
  }
};

std::optional<CstComponent> find_component(const CstTable& table, const std::string& magnitude,
                                           const std::string& phase) {
  const std::optional<std::size_t> column = table.find(magnitude);
  if (!column) return std::nullopt;
  return CstComponent{*column, table.find_angle(phase, false), table.unit_of(*column)};
}

// The spherical component that an element receives, of a table in spherical components or in Ludwig's third definition.
class ReceivedField {
 public:
  ReceivedField(const TextSource& source, const CstTable& table, bool theta) : theta_(theta) {
    const std::string name = theta ? "Theta" : "Phi";
    spherical_ = find_component(table, "Abs(" + name + ")", "Phase(" + name + ")");
    horizontal_ = find_component(table, "Horiz(Abs)", "Horiz(Phase)");
    vertical_ = find_component(table, "Vert(Abs)", "Vert(Phase)");
    if (spherical_) return;
    const bool ludwig = horizontal_ && vertical_ && horizontal_->phase && vertical_->phase;
    if (!ludwig)
      source.fail(table.header(), fmt::format("no column Abs({0}), nor Horiz and Vert with their phases", name));
  }
  bool has_level() const { return spherical_.has_value(); }  // of its own, in the table's digits
  bool has_phase() const { return !spherical_ || spherical_->phase.has_value(); }
  double level_dbsm(const TextTable& rows, std::size_t row) const { return spherical_->level_dbsm(rows, row); }
  // Ludwig 1973, definition 3: i_horiz = theta^ cos phi - phi^ sin phi, i_vert = theta^ sin phi + phi^ cos phi.
  Complex field_m(const TextTable& rows, std::size_t row, double phi_deg) const {
    if (spherical_) return spherical_->field_m(rows, row);
    const Complex h = horizontal_->field_m(rows, row), v = vertical_->field_m(rows, row);
    const double c = std::cos(radians(phi_deg)), s = std::sin(radians(phi_deg));
    return theta_ ? c * h + s * v : c * v - s * h;
  }

 private:
  bool theta_ = true;
  std::optional<CstComponent> spherical_, horizontal_, vertical_;
};

// The level of the sum over both received polarisations, `Abs(RCS)` or `Abs(E)`, of a table that has it alone.
std::optional<CstComponent> total_of(const CstTable& table) {
  for (const char* component : {"Abs(Theta)", "Abs(Phi)", "Horiz(Abs)", "Vert(Abs)"}) {
    if (table.find(component)) return std::nullopt;
  }
  const std::optional<CstComponent> area = find_component(table, "Abs(RCS)", "Phase(RCS)");
  return area ? area : find_component(table, "Abs(E)", "Phase(E)");
}

}  // namespace

bool is_cst_header(std::string_view line) {
  const auto has = [&](const char* part) { return line.find(part) != std::string_view::npos; };
  return has("Theta") && (has("Abs(") || has("(Abs")) && has("[");
}

void read_cst_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  table.notes.emplace_back("e^{+jwt}; theta^ = -v, phi^ = h");
  const double frequency_hz = settings.frequency_hz.value_or(0);
  if (frequency_hz <= 0) {
    throw InputError(
        fmt::format("{}: a CST table does not say its frequency, nor does its name: give --reference-frequency-ghz",
                    source.name()));
  }
  require_elements(settings, source.name(), "a CST table");
  const CstTable cst(source, frequency_hz);
  const TextTable& rows = cst.rows();
  const std::size_t theta = *cst.find_angle("Theta", true), phi = *cst.find_angle("Phi", true);
  if (const std::optional<CstComponent> total = total_of(cst)) {
    const bool v = total_transmits_v(settings, source.name(), "a CST table");
    table.notes.push_back(fmt::format("total of both received polarisations, {} transmitted", v ? "v" : "h"));
    RcsCut& cut = cut_for(table, quantity_of(element_of(v, v), true), settings.transmitter);
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      FieldValue value{frequency_hz, rows.number(row, theta), rows.number(row, phi), total->level_dbsm(rows, row),
                       {},           rows.line(row)};
      fold_direction(value.theta_deg, value.phi_deg);
      cut.values.push_back(value);
    }
    return;
  }
  for (const Polarisation element : settings.elements) {
    const ReceivedField field(source, cst, receives_v(element));
    RcsCut cut;
    cut.element = element;
    cut.transmitter = settings.transmitter;
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      const double theta_deg = rows.number(row, theta), phi_deg = rows.number(row, phi);
      if (field.has_phase()) {
        FieldValue value =
            field_value(element, frequency_hz, theta_deg, phi_deg, field.field_m(rows, row, phi_deg), rows.line(row));
        if (field.has_level()) value.level_dbsm = field.level_dbsm(rows, row);
        cut.values.push_back(value);
        continue;
      }
      FieldValue value{frequency_hz, theta_deg, phi_deg, field.level_dbsm(rows, row), {}, rows.line(row)};
      fold_direction(value.theta_deg, value.phi_deg);
      cut.values.push_back(value);
    }
    table.cuts.push_back(std::move(cut));
  }
}

}  // namespace seaglint
