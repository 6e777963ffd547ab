// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/cst_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/text_rows.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/export_name.h"
#include "sim/field_tables/level_unit.h"
#include "sim/field_tables/rows/line_reader.h"

namespace seaglint {
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
      FieldValue value{abscissa_ == Abscissa::kFrequency ? row.cells[0] * scale_ : frequency_hz,
                       abscissa_ == Abscissa::kTheta ? row.cells[0] : theta,
                       abscissa_ == Abscissa::kPhi ? row.cells[0] : phi,
                       0,
                       {},
                       row.line};
      if (value.frequency_hz <= 0)
        throw InputError(fmt::format("{}:{}: frequency: must be greater than 0", source_.name(), row.line));
      if (parts) {
        cut.values.push_back(field_value(cut.element, value.frequency_hz, value.theta_deg, value.phi_deg,
                                         {row.cells[1], row.cells[2]}, row.line));
        continue;
      }
      value.level_dbsm = level_dbsm(row, decibel, field);
      if (complex) {
        const Complex s = std::polar(amplitude_of_dbsm(value.level_dbsm), radians(row.cells[2]));
        cut.values.push_back(field_value(cut.element, value.frequency_hz, value.theta_deg, value.phi_deg, s, row.line));
        cut.values.back().level_dbsm = value.level_dbsm;
        continue;
      }
      fold_direction(value.theta_deg, value.phi_deg);
      cut.values.push_back(value);
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
      if (cut.total)
        table.notes.push_back(
            fmt::format("total of both received polarisations, {} transmitted", transmits_v(cut.element) ? "v" : "h"));
      table.cuts.push_back(std::move(cut));
    } else {
      same->values.insert(same->values.end(), cut.values.begin(), cut.values.end());
    }
  }
}

}  // namespace seaglint
