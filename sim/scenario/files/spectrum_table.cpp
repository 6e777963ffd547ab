// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/spectrum_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/number.h"
#include "sim/core/text/words.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxBytes = 10'000'000;

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

// Indices of the two columns, and their factors to rad/s and m^2 s/rad.
struct Columns {
  std::size_t frequency = 0, density = 0;
  double to_omega = 1;
};

std::optional<Columns> columns_of(const std::vector<std::string_view>& names) {
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  for (const auto& [frequency, density, to_omega] :
       {std::tuple{"omega_rad_s", "density_m2_s", 1.0}, std::tuple{"frequency_hz", "density_m2_hz", 2 * kPi}}) {
    const Columns columns{place(frequency), place(density), to_omega};
    if (columns.frequency < names.size() && columns.density < names.size()) return columns;
  }
  return std::nullopt;
}

}  // namespace

double SpectrumTable::energy() const {
  double sum = 0;
  for (std::size_t i = 1; i < omega.size(); ++i) sum += 0.5 * (density[i - 1] + density[i]) * (omega[i] - omega[i - 1]);
  return sum;
}

double SpectrumTable::peak_omega() const {
  return omega[static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin())];
}

SpectrumTable parse_spectrum_table(const std::string& text, const std::string& file_name) {
  const auto fail = [&](std::size_t line, const std::string& what) {
    throw InputError(fmt::format("{}:{}: {}", file_name, line, what));
  };
  SpectrumTable table;
  std::optional<Columns> columns;
  std::size_t number = 0;
  double previous = -1;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = trimmed(next_line(rest));
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string_view> cells = cells_of(line);
    if (!columns) {
      columns = columns_of(cells);
      if (!columns) {
        fail(number, "must name its columns omega_rad_s and density_m2_s, or frequency_hz and density_m2_hz, here: " +
                         std::string(line.substr(0, 60)));
      }
      continue;
    }
    const auto value = [&](std::size_t column, const char* name) {
      if (column >= cells.size()) fail(number, fmt::format("has {} columns: {} is missing", cells.size(), name));
      const std::optional<double> read = parse_number(cells[column]);
      if (!read || !std::isfinite(*read)) {
        fail(number, fmt::format("{}: value '{}': must be a number", name, cells[column].substr(0, 60)));
      }
      return *read;
    };
    const double frequency = value(columns->frequency, "frequency");
    const double density = value(columns->density, "density");
    if (!(frequency >= 0 && frequency > previous)) {
      fail(number,
           fmt::format("frequency: value '{}': must be {}", frequency,
                       frequency < 0 ? "at least 0" : fmt::format("greater than the row before, {}", previous)));
    }
    if (density < 0) fail(number, fmt::format("density: value '{}': must be at least 0", density));
    previous = frequency;
    table.omega.push_back(frequency * columns->to_omega);
    table.density.push_back(density / columns->to_omega);
  }
  if (!columns) throw InputError(file_name + ": the file is empty: must be a table with a header");
  if (table.omega.size() < 2) {
    throw InputError(fmt::format("{}: {} rows: must be at least 2", file_name, table.omega.size()));
  }
  if (!(table.energy() > 0)) throw InputError(file_name + ": all densities are 0");
  return table;
}

SpectrumTable read_spectrum_table(const std::filesystem::path& file) {
  return parse_spectrum_table(read_file(file, kMaxBytes), file.string());
}

}  // namespace seaglint
