// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/field_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/export_text.h"

namespace seaglint {
namespace {

// The line with the names of the columns.
bool is_cst_header(std::string_view line) {
  const auto has = [&](const char* part) { return line.find(part) != std::string_view::npos; };
  return has("Theta") && (has("Abs(") || has("(Abs")) && has("[");
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

bool is_cst_table(const TextSource& source) { return any_first_line(source, is_cst_header); }

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
    table.notes.push_back(total_note(v));
    RcsCut& cut = cut_for(table, quantity_of(element_of(v, v), true), settings.transmitter);
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      cut.values.push_back(level_value(frequency_hz, rows.number(row, theta), rows.number(row, phi),
                                       total->level_dbsm(rows, row), rows.line(row)));
    }
    return;
  }
  for (const Polarisation element : settings.elements) {
    const ReceivedField field(source, cst, receives_v(element));
    RcsCut& cut = cut_for(table, quantity_of(element, false), settings.transmitter);
    for (std::size_t row = 0; row < rows.rows(); ++row) {
      const double theta_deg = rows.number(row, theta), phi_deg = rows.number(row, phi);
      if (field.has_phase()) {
        FieldValue value =
            field_value(element, frequency_hz, theta_deg, phi_deg, field.field_m(rows, row, phi_deg), rows.line(row));
        if (field.has_level()) value.level_dbsm = field.level_dbsm(rows, row);
        cut.values.push_back(value);
        continue;
      }
      cut.values.push_back(level_value(frequency_hz, theta_deg, phi_deg, field.level_dbsm(rows, row), rows.line(row)));
    }
  }
}

namespace {

enum class Abscissa { kFrequency, kTheta, kPhi };

// A curve: what its head says, and its rows.
struct Curve {
  std::string parameters;          // {a=1; b=2}
  std::vector<std::string> names;  // of the columns
  int line = 0;                    // of the names
  struct Row {
    std::array<double, 3> cells;
    int line = 0;
  };
  std::vector<Row> rows;
};

bool is_axis(std::string_view name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos) return false;
  const std::string_view quantity = trimmed(name.substr(0, slash));
  return quantity == "Frequency" || quantity == "Theta" || quantity == "Phi";
}

// The names of a line, quoted and tab-separated behind #, or separated by two blanks and more.
std::vector<std::string> names_of(std::string_view line) {
  std::vector<std::string> names;
  if (line.starts_with("#\"")) {
    line.remove_prefix(1);
    for (const std::string_view cell : next_row(line, '\t').cells) names.emplace_back(cell);
    return names;
  }
  while (!(line = trimmed(line)).empty()) {
    const std::size_t gap = std::min(line.find("  "), line.size());
    names.emplace_back(line.substr(0, gap));
    line.remove_prefix(gap);
  }
  return names;
}

bool is_names_line(std::string_view line) {
  const std::vector<std::string> names = names_of(trimmed(line));
  return names.size() >= 2 && names.size() <= 3 && is_axis(names[0]);
}

std::vector<Curve> curves_of(const TextSource& source) {
  std::vector<Curve> curves;
  std::string parameters;
  LineReader lines(source);
  while (lines.advance()) {
    const std::string_view line = lines.line();
    if (line.starts_with("#Parameters")) {
      parameters = line.substr(std::min(line.find('{'), line.size()));
    } else if (is_names_line(line)) {
      curves.push_back({parameters, names_of(line), lines.number(), {}});
    } else if (is_rule(line.starts_with('#') ? line.substr(1) : line)) {
      continue;
    } else if (curves.empty()) {
      lines.fail("a row above the names of the columns");
    } else {
      Curve& curve = curves.back();
      Curve::Row row{{}, lines.number()};
      if (curve.names.size() == 2) {
        const auto [x, y] = lines.numbers<2>("a row");
        row.cells = {x, y, 0};
      } else {
        row.cells = lines.numbers<3>("a row");
      }
      curve.rows.push_back(row);
    }
  }
  return curves;
}

// The frequency or angle in the parameters, in the names of the columns or in the file's name.
std::optional<std::string_view> stated(const Curve& curve, const std::string& file, std::string_view word) {
  if (const auto text = value_in_name(curve.parameters, word)) return text;
  for (std::size_t k = 1; k < curve.names.size(); ++k) {
    if (const auto text = value_in_name(curve.names[k], word)) return text;
  }
  return value_in_name(file, word);
}

// Reads one curve of a file.
class CurveReader {
 public:
  CurveReader(const TextSource& source, const FieldTableSettings& settings, const std::string& file, const Curve& curve)
      : source_(source), settings_(settings), file_(file), curve_(curve) {
    const std::string& axis = curve.names[0];
    const std::string unit = axis.substr(axis.find('/') + 1);
    abscissa_ = axis.starts_with("Frequency") ? Abscissa::kFrequency
                : axis.starts_with("Theta")   ? Abscissa::kTheta
                                              : Abscissa::kPhi;
    if (abscissa_ == Abscissa::kFrequency) {
      const std::optional<double> hz = frequency_in_name("1 " + std::string(trimmed(unit)));
      if (!hz || trimmed(unit).find("Hz") == std::string_view::npos) fail(fmt::format("unit of {}: must be Hz", axis));
      scale_ = *hz;
    } else if (!trimmed(unit).starts_with("deg")) {
      fail(fmt::format("unit of {}: must be degrees", axis));
    }
  }

  RcsCut cut() const {
    RcsCut cut;
    cut.element = element();
    cut.total = is_total();
    cut.transmitter = settings_.transmitter;
    const double frequency_hz = abscissa_ == Abscissa::kFrequency ? 0 : fixed_frequency();
    const double theta = abscissa_ == Abscissa::kTheta ? 0 : fixed_angle("theta");
    const double phi = abscissa_ == Abscissa::kPhi ? 0 : fixed_angle("phi");
    const bool complex = curve_.names.size() == 3;
    const bool parts = complex && curve_.names[1].find("Real") != std::string::npos;
    const bool decibel = !parts && is_decibel(), field = is_field();
    for (const Curve::Row& row : curve_.rows) {
      const double f = abscissa_ == Abscissa::kFrequency ? row.cells[0] * scale_ : frequency_hz;
      const double theta_deg = abscissa_ == Abscissa::kTheta ? row.cells[0] : theta;
      const double phi_deg = abscissa_ == Abscissa::kPhi ? row.cells[0] : phi;
      if (f <= 0) throw InputError(fmt::format("{}:{}: frequency: must be greater than 0", source_.name(), row.line));
      if (parts) {
        cut.values.push_back(field_value(cut.element, f, theta_deg, phi_deg, {row.cells[1], row.cells[2]}, row.line));
        continue;
      }
      const double level = level_dbsm(row, decibel, field);
      if (complex) {
        const Complex s = std::polar(amplitude_of_dbsm(level), radians(row.cells[2]));
        cut.values.push_back(field_value(cut.element, f, theta_deg, phi_deg, s, row.line));
        cut.values.back().level_dbsm = level;
      } else {
        cut.values.push_back(level_value(f, theta_deg, phi_deg, level, row.line));
      }
    }
    return cut;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", source_.name(), curve_.line, shown(what)));
  }

  std::optional<Polarisation> named_element() const {
    for (std::size_t i = 0; i < 4; ++i) {
      if (has_word(curve_.names[1], kPolarisationNames[i]) || has_word(file_, kPolarisationNames[i]))
        return static_cast<Polarisation>(i);
    }
    return std::nullopt;
  }
  // A magnitude without phase, with `abs` of no component in the curve's name, where both received polarisations are
  // wanted and no name has an element.
  bool is_total() const {
    const std::vector<Polarisation>& wanted = settings_.elements;
    const std::string name = squeezed(curve_.names[1]);
    const bool of_component =
        name.find("Abs(Theta)") != std::string::npos || name.find("Abs(Phi)") != std::string::npos;
    return curve_.names.size() == 2 && wanted.size() == 2 && transmits_v(wanted[0]) == transmits_v(wanted[1]) &&
           has_word(curve_.names[1], "abs") && !of_component && !named_element();
  }
  Polarisation element() const {
    if (is_total()) return element_of(transmits_v(settings_.elements[0]), transmits_v(settings_.elements[0]));
    if (settings_.elements.size() == 1) return settings_.elements[0];
    if (const std::optional<Polarisation> element = named_element()) return *element;
    fail(
        "neither the curve's nor the file's name says the polarisation (HH, HV, VH, VV): give "
        "--reference-polarisation, of a total (abs) h or v");
  }
  double fixed_frequency() const {
    for (const char* word : {"f", "frequency", "freq"}) {
      const std::optional<std::string_view> text = stated(curve_, file_, word);
      const std::optional<double> hz = text ? frequency_in_name(*text) : std::nullopt;
      if (hz) return *hz;
    }
    if (settings_.frequency_hz) return *settings_.frequency_hz;
    fail("the curve does not say its frequency: give --reference-frequency-ghz");
  }
  double fixed_angle(const char* word) const {
    const std::optional<std::string_view> text = stated(curve_, file_, word);
    const std::optional<double> value = text ? leading_number(*text) : std::nullopt;
    if (value) return *value;
    fail(fmt::format("the curve does not say its {0}: add '{0} = ...' in degrees to the file's name", word));
  }
  bool names_have(std::string_view part) const {
    return curve_.names[1].find(part) != std::string::npos || file_.find(part) != std::string::npos;
  }
  bool is_field() const { return names_have("V/m"); }
  bool is_decibel() const {
    if (names_have("dB")) return true;
    if (names_have("m^2") || names_have("m2") || names_have("V/m")) return false;
    if (std::any_of(curve_.rows.begin(), curve_.rows.end(), [](const Curve::Row& row) { return row.cells[1] < 0; }))
      return true;
    fail("[Magnitude] stands for decibels too and no value is negative: add 'dBsm' or 'm^2' to the file's name");
  }
  double level_dbsm(const Curve::Row& row, bool decibel, bool field) const {
    const double value = row.cells[1], of_field = field ? 10 * std::log10(4 * kPi) : 0;
    if (!decibel && value < 0)
      throw InputError(fmt::format("{}:{}: value {}: must not be negative", source_.name(), row.line, value));
    const double level = decibel ? value : (field ? 20 : 10) * std::log10(std::max(value, 1e-300));
    return std::max(level + of_field, kMinLevel_dbsm);
  }

  const TextSource& source_;
  const FieldTableSettings& settings_;
  const std::string& file_;
  const Curve& curve_;
  Abscissa abscissa_ = Abscissa::kFrequency;
  double scale_ = 1;
};

}  // namespace

bool is_cst_curves(const TextSource& source) {
  constexpr int kMaxLines = 20;
  LineReader lines(source);
  for (int n = 0; n < kMaxLines && lines.advance(); ++n) {
    if (is_names_line(lines.line())) return true;
  }
  return false;
}

void read_cst_curves(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  table.notes.emplace_back("e^{+jwt}; theta^ = -v, phi^ = h");
  for (const Curve& curve : curves_of(source)) {
    RcsCut cut = CurveReader(source, settings, table.name, curve).cut();
    const auto same = std::find_if(table.cuts.begin(), table.cuts.end(),
                                   [&](const RcsCut& other) { return other.quantity() == cut.quantity(); });
    if (same == table.cuts.end()) {
      if (cut.total) table.notes.push_back(total_note(transmits_v(cut.element)));
      table.cuts.push_back(std::move(cut));
    } else {
      same->values.insert(same->values.end(), cut.values.begin(), cut.values.end());
    }
  }
}

}  // namespace seaglint
