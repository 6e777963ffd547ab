// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/field_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/export_text.h"

namespace seaglint {
namespace {

constexpr double kAngle_deg = 1e-3;   // agreement of two directions
constexpr double kAreaDigits = 1e-4;  // agreement of the printed area with 4 pi |E|^2, relative

// What the lines with # above a block say.
struct BlockHead {
  std::optional<double> frequency_hz;
  std::optional<std::array<double, 2>> incident_deg;  // theta, phi
  std::size_t rows = 0;
  std::string result;
  std::vector<std::string> columns;  // squeezed, without quotes
};

std::optional<std::string_view> value_behind(std::string_view line, std::string_view key) {
  if (!line.starts_with(key)) return std::nullopt;
  return trimmed(line.substr(key.size()));
}

std::vector<std::string> quoted_names(std::string_view line) {
  std::vector<std::string> names;
  for (std::size_t at = line.find('"'); at != std::string_view::npos; at = line.find('"', at + 1)) {
    const std::size_t end = line.find('"', at + 1);
    if (end == std::string_view::npos) break;
    names.emplace_back(line.substr(at + 1, end - at - 1));
    at = end;
  }
  return names;
}

double number_of(const LineReader& lines, std::string_view text, const char* what) {
  const std::optional<double> value = parse_number(text);
  if (!value || !std::isfinite(*value)) lines.fail(fmt::format("{} {}: must be a number", what, in_quotes(text)));
  return *value;
}

// `(  8.5E+001,  0.0E+000)`.
std::array<double, 2> direction_of(const LineReader& lines, std::string_view text) {
  const std::size_t comma = text.find(',');
  if (!text.starts_with('(') || !text.ends_with(')') || comma == std::string_view::npos)
    lines.fail(fmt::format("incident wave {}: must be (theta, phi)", in_quotes(text)));
  return {number_of(lines, trimmed(text.substr(1, comma - 1)), "theta of the incident wave"),
          number_of(lines, trimmed(text.substr(comma + 1, text.size() - comma - 2)), "phi of the incident wave")};
}

// Takes a line with # into the head; true for the line with the names of the columns.
bool read_head_line(const LineReader& lines, BlockHead& head) {
  const std::string_view line = lines.line();
  if (const auto text = value_behind(line, "#Frequency:")) {
    head = {};
    head.frequency_hz = number_of(lines, *text, "frequency");
    if (*head.frequency_hz <= 0) lines.fail("frequency: must be greater than 0");
  } else if (const auto theta = value_behind(line, "#No. of Theta Samples:")) {
    head.rows = lines.count("number of theta samples", number_of(lines, *theta, "number of theta samples"));
  } else if (const auto phi = value_behind(line, "#No. of Phi Samples:")) {
    head.rows *= lines.count("number of phi samples", number_of(lines, *phi, "number of phi samples"));
  } else if (const auto result = value_behind(line, "#Result Type:")) {
    head.result = *result;
  } else if (const auto system = value_behind(line, "#Coordinate System:")) {
    if (*system != "Spherical") lines.fail(fmt::format("coordinates {}: must be Spherical", in_quotes(*system)));
  } else if (const auto wave = value_behind(line, "#Incident Wave Direction:")) {
    head.incident_deg = direction_of(lines, *wave);
  } else if (line.find('"') != std::string_view::npos) {
    head.columns = quoted_names(line);
    return true;
  }
  return false;
}

void require_complete(const LineReader& lines, const BlockHead& head) {
  constexpr std::array<const char*, 9> kColumns{"Theta",    "Phi",        "Re(Etheta)", "Im(Etheta)", "Re(Ephi)",
                                                "Im(Ephi)", "RCS(Theta)", "RCS(Phi)",   "RCS(Total)"};
  if (head.result != "RCS") lines.fail(fmt::format("result type {}: must be RCS", in_quotes(head.result)));
  if (!head.frequency_hz) lines.fail("no #Frequency above the block");
  if (!head.incident_deg) lines.fail("no #Incident Wave Direction above the block");
  if (head.rows == 0) lines.fail("no #No. of Theta Samples and #No. of Phi Samples above the block");
  if (!std::equal(head.columns.begin(), head.columns.end(), kColumns.begin(), kColumns.end())) {
    lines.fail(
        fmt::format("columns {}: must be Theta, Phi, Re(Etheta), Im(Etheta), Re(Ephi), Im(Ephi), RCS(Theta), "
                    "RCS(Phi), RCS(Total)",
                    shown(fmt::format("{}", fmt::join(head.columns, ", ")))));
  }
}

bool same_direction(double theta, double phi, const std::array<double, 2>& other) {
  return std::abs(theta - other[0]) < kAngle_deg && std::abs(std::remainder(phi - other[1], 360)) < kAngle_deg;
}

void require_area(const LineReader& lines, const std::array<double, 9>& v) {
  const double area = 4 * kPi * (v[2] * v[2] + v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
  if (std::abs(area - v[8]) > kAreaDigits * std::max(area, v[8]) + 1e-12)
    lines.fail(fmt::format("RCS(Total) {:g}: must be 4 pi (|Etheta|^2 + |Ephi|^2), {:g} m^2", v[8], area));
}

void read_block(LineReader& lines, const BlockHead& head, const std::vector<Polarisation>& elements,
                FieldTable& table) {
  require_complete(lines, head);
  DeclaredTransmitter transmitter{false, (*head.incident_deg)[0], (*head.incident_deg)[1]};
  fold_direction(transmitter.theta_deg, transmitter.phi_deg);
  std::vector<RcsCut*> cuts;
  for (std::size_t row = 0; row < head.rows; ++row) {
    lines.next("the last row of a block");
    const std::array<double, 9> v = lines.numbers<9>("theta, phi, E and RCS");
    require_area(lines, v);
    if (row == 0) {
      if (head.rows == 1 && same_direction(v[0], v[1], *head.incident_deg)) transmitter = {};
      for (const Polarisation element : elements) cut_for(table, quantity_of(element, false), transmitter);
      for (const Polarisation element : elements)
        cuts.push_back(&cut_for(table, quantity_of(element, false), transmitter));
    }
    for (RcsCut* cut : cuts) {
      // A wave along -theta^, not theta^, where v is transmitted.
      const Complex field = receives_v(cut->element) ? Complex(v[2], v[3]) : Complex(v[4], v[5]);
      cut->values.push_back(field_value(cut->element, *head.frequency_hz, v[0], v[1],
                                        transmits_v(cut->element) ? -field : field, lines.number()));
    }
  }
}

}  // namespace

bool is_feko_table(const TextSource& source) {
  const std::string_view text = source.text();
  return text.starts_with("##File Type: Far field") || text.find("** File exported by FEKO") < 2000;
}

void read_feko_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  std::vector<Polarisation> elements = settings.elements;
  table.notes.emplace_back("e^{+jwt}; E is S in metres; theta^ = -v, phi^ = h");
  if (elements.empty()) {
    elements = {Polarisation::kVv, Polarisation::kHv};
    table.notes.emplace_back("polarisation angle of the incident wave taken as 0: v transmitted");
  }
  LineReader lines(source);
  BlockHead head;
  while (lines.advance()) {
    if (!lines.line().starts_with('#')) {
      if (lines.line().starts_with("**")) continue;
      lines.fail("a row without the names of its columns above");
    }
    if (read_head_line(lines, head)) read_block(lines, head, elements, table);
  }
}

namespace {

constexpr std::string_view kFirstLine = "// CST Farfield Source File";

void require_axis(LineReader& lines, const char* name, const std::array<double, 3>& wanted) {
  lines.seek(fmt::format("// {}", name));
  lines.next(name);
  const std::array<double, 3> axis = lines.numbers<3>(name);
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(axis[i] - wanted[i]) > 1e-9)
      lines.fail(fmt::format("{}: rotated axes are not read: export with {:g} {:g} {:g}", name, wanted[0], wanted[1],
                             wanted[2]));
  }
}

// The next line as one number.
double next_number(LineReader& lines, const char* what) {
  lines.next(what);
  return lines.numbers<1>(what)[0];
}

std::vector<double> read_frequencies(LineReader& lines, std::size_t count) {
  lines.seek("// Radiated");
  std::vector<double> frequency_hz;
  for (std::size_t q = 0; q < count; ++q) {
    for (int power = 0; power < 3; ++power) next_number(lines, "a power");
    frequency_hz.push_back(next_number(lines, "a frequency"));
    if (frequency_hz.back() <= 0) lines.fail("frequency: must be greater than 0");
  }
  return frequency_hz;
}

void require_line(LineReader& lines, std::string_view heading, std::string_view wanted) {
  lines.seek(heading);
  if (lines.next(wanted) != wanted) lines.fail(fmt::format("{}: must be {}", in_quotes(lines.line()), wanted));
}

}  // namespace

bool is_cst_source(const TextSource& source) { return source.text().starts_with(kFirstLine); }

void read_cst_source(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  require_elements(settings, source.name(), "a CST farfield source");
  LineReader lines(source);
  require_line(lines, "// Version", "3.0");
  require_line(lines, "// Data Type", "Farfield");
  lines.seek("// #Frequencies");
  const std::size_t count = lines.count("#Frequencies", next_number(lines, "#Frequencies"));
  lines.seek("// Position");
  lines.next("Position");
  const std::array<double, 3> position = lines.numbers<3>("Position");
  require_axis(lines, "zAxis", {0, 0, 1});
  require_axis(lines, "xAxis", {1, 0, 0});
  const std::vector<double> frequency_hz = read_frequencies(lines, count);
  table.notes.push_back(fmt::format("e^{{+jwt}}; theta^ = -v, phi^ = h; phase origin of the file at {:g}, {:g}, {:g} m",
                                    position[0], position[1], position[2]));
  for (const Polarisation element : settings.elements) {
    cut_for(table, quantity_of(element, false), settings.transmitter).origin_m =
        Vec3(position[0], position[1], position[2]);
  }
  for (const double f : frequency_hz) {
    lines.seek("// >> Total #phi");
    lines.next("the numbers of phi and theta samples");
    const std::array<double, 2> counts = lines.numbers<2>("#phi and #theta samples");
    const std::size_t rows = lines.count("#phi samples", counts[0]) * lines.count("#theta samples", counts[1]);
    lines.seek("// >> Phi, Theta, Re(E_Theta), Im(E_Theta), Re(E_Phi), Im(E_Phi)");
    for (std::size_t row = 0; row < rows; ++row) {
      lines.next("the last row");
      const std::array<double, 6> v = lines.numbers<6>("phi, theta, E_Theta, E_Phi");
      for (RcsCut& cut : table.cuts) {
        const Complex field = receives_v(cut.element) ? Complex(v[2], v[3]) : Complex(v[4], v[5]);
        cut.values.push_back(field_value(cut.element, f, v[1], v[0], field, lines.number()));
      }
    }
  }
  if (lines.advance()) lines.fail("a line below the last block");
}

}  // namespace seaglint
