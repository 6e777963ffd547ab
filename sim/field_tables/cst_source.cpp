// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/cst_source.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "sim/core/text/shown.h"
#include "sim/field_tables/rows/line_reader.h"

namespace seaglint {
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

bool is_cst_source(std::string_view text) { return text.starts_with(kFirstLine); }

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
    RcsCut& cut = table.cuts.emplace_back();
    cut.element = element;
    cut.transmitter = settings.transmitter;
    cut.origin_m = Vec3(position[0], position[1], position[2]);
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
