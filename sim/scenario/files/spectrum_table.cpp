// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/spectrum_table.h"

#include <algorithm>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxBytes = 10'000'000;

}  // namespace

double SpectrumTable::energy() const {
  double sum = 0;
  for (std::size_t i = 1; i < omega.size(); ++i) sum += 0.5 * (density[i - 1] + density[i]) * (omega[i] - omega[i - 1]);
  return sum;
}

double SpectrumTable::peak_omega() const {
  return omega[static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin())];
}

namespace {

SpectrumTable spectrum_of(const TextTable& table) {
  constexpr std::size_t kFrequency = 0, kDensity = 1;
  table.check_ascending(kFrequency);
  // Densities per Hz are those per rad/s times 2 pi.
  const double to_omega = table.key(kFrequency) == "omega_rad_s" ? 1 : 2 * kPi;
  const double to_density = table.key(kDensity) == "density_m2_hz" ? 1 / (2 * kPi) : 1;
  SpectrumTable spectrum;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    spectrum.omega.push_back(table.number(row, kFrequency, 0) * to_omega);
    spectrum.density.push_back(table.number(row, kDensity, 0) * to_density);
  }
  if (!(spectrum.energy() > 0)) throw InputError(table.source().name() + ": all densities are 0");
  return spectrum;
}

std::vector<TableColumn> columns() {
  return {TableColumn::one_of({"omega_rad_s", "frequency_hz"}),
          TableColumn::one_of({"density_m2_s", "density_m2_s_rad", "density_m2_hz"})};
}

}  // namespace

SpectrumTable parse_spectrum_table(const std::string& text, const std::string& file_name) {
  return spectrum_of(TextTable(TextSource(file_name, text), columns()));
}

SpectrumTable read_spectrum_table(const std::filesystem::path& file) {
  return spectrum_of(TextTable(TextSource::read(file, kMaxBytes), columns()));
}

}  // namespace seaglint
