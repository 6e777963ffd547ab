// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/receiver_noise.h"

#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {

double thermal_noise_m2(const PulseTrain& train, const RadarSpec& radar) {
  constexpr double kBoltzmann = 1.380649e-23;  // J/K, exact in the SI
  const auto ratio = [](double db) { return std::pow(10, db / 10); };
  const LinkBudgetSpec& budget = radar.link_budget;
  const double wavelength = kSpeedOfLight / train.band_centre_hz();
  const double gain_wavelength = ratio(budget.antenna_gain_db) * wavelength;
  const double range_4 = std::pow(radar.range_km * 1e3, 4);
  const double energy_per_m2 = budget.peak_power_kw * 1e3 * radar.pulse_width_us * 1e-6 * gain_wavelength *
                               gain_wavelength / (16 * kPi * kPi * range_4 * ratio(budget.losses_db));
  const double density = kBoltzmann * budget.reference_temperature_k * ratio(budget.noise_figure_db);
  return static_cast<double>(train.frequencies()) * density / energy_per_m2;
}

}  // namespace seaglint
