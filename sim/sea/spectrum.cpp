// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/scenario/cases.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

JonswapSpectrum::JonswapSpectrum(double significant_wave_height_m, double peak_period_s, double gamma,
                                 SpectrumNormalisation normalisation)
    : peak_omega_(2 * kPi / peak_period_s),
      gamma_(gamma),
      total_(significant_wave_height_m * significant_wave_height_m / 16) {
  SEAGLINT_CHECK(significant_wave_height_m > 0 && peak_period_s > 0 && gamma >= 1,
                 fmt::format("Hs = {} m, Tp = {} s, gamma = {}", significant_wave_height_m, peak_period_s, gamma));
  // The integral of u^-5 exp(-1.25 u^-4) is exp(-1.25 u^-4) / 5, so Pierson-Moskowitz with scale (5/16) Hs^2 integrates
  // to Hs^2/16.
  scale_ = 5.0 / 16 * significant_wave_height_m * significant_wave_height_m;
  const double enhanced = 1 + 5 * enhancement_integral(0, std::numeric_limits<double>::infinity());
  if (normalisation == SpectrumNormalisation::kExact) {
    scale_ /= enhanced;
  } else {
    const double normalising = 1 - 0.287 * reproducible_log(gamma);  // DNV-RP-C205 (2010), section 3.5.5.2
    scale_ *= normalising;
    total_ *= normalising * enhanced;
  }
}

namespace {

// u^-5 exp(-1.25 u^-4), u > 0.
double pierson_moskowitz(double u) {
  const double u4 = u * u * u * u;
  return reproducible_exp(-1.25 / u4) / (u4 * u);
}

}  // namespace

double JonswapSpectrum::shape(double u) const {
  return u > 0 ? pierson_moskowitz(u) * (1 + jonswap_enhancement(u, gamma_)) : 0;
}

double JonswapSpectrum::density(double omega) const { return scale_ / peak_omega_ * shape(omega / peak_omega_); }

// Contribution of the peak enhancement to the integral of the shape.
double JonswapSpectrum::enhancement_integral(double lower, double upper) const {
  const auto added = [this](double u) { return pierson_moskowitz(u) * jonswap_enhancement(u, gamma_); };
  constexpr double kPiece = 0.02;
  const auto part = [&](double a, double b) {
    const double from = std::max(a, lower);
    const double to = std::min(b, upper);
    return from < to ? integrate(from, to, kPiece, added) : 0.0;
  };
  return part(kEnhancementBegin, 1) + part(1, kEnhancementEnd);  // s jumps at the peak
}

double JonswapSpectrum::energy(double lower, double upper) const {
  const auto cumulative = [](double u) { return u > 0 ? 0.2 * reproducible_exp(-1.25 / (u * u * u * u)) : 0.0; };
  const double a = std::max(0.0, lower / peak_omega_);
  const double b = std::max(a, upper / peak_omega_);
  return scale_ * (cumulative(b) - cumulative(a) + enhancement_integral(a, b));
}

double JonswapSpectrum::energy_above(double omega) const {
  const double u = std::max(0.0, omega / peak_omega_);
  const double without = u > 0 ? -0.2 * std::expm1(-1.25 / (u * u * u * u)) : 0.2;  // without the enhancement
  return scale_ * (without + enhancement_integral(u, std::numeric_limits<double>::infinity()));
}

TableSpectrum::TableSpectrum(std::shared_ptr<const SpectrumTable> table, double significant_wave_height_m)
    : table_(std::move(table)), total_(significant_wave_height_m * significant_wave_height_m / 16) {
  SEAGLINT_CHECK(significant_wave_height_m > 0, fmt::format("Hs = {} m", significant_wave_height_m));
  scale_ = total_ / table_->energy();
}

double TableSpectrum::density(double omega) const {
  const std::vector<double>& w = table_->omega;
  if (!(omega > 0) || omega < w.front() || omega > w.back()) return 0;
  const auto next = static_cast<std::size_t>(std::upper_bound(w.begin(), w.end() - 1, omega) - w.begin());
  const double part = (omega - w[next - 1]) / (w[next] - w[next - 1]);
  return scale_ * (table_->density[next - 1] + part * (table_->density[next] - table_->density[next - 1]));
}

double TableSpectrum::cumulative(double omega) const {
  double sum = 0;
  for (std::size_t i = 1; i < table_->omega.size() && table_->omega[i - 1] < omega; ++i) {
    const double width = table_->omega[i] - table_->omega[i - 1];
    const double part = std::min(1.0, (omega - table_->omega[i - 1]) / width);
    const double begin = table_->density[i - 1], end = begin + part * (table_->density[i] - begin);
    sum += 0.5 * (begin + end) * part * width;
  }
  return sum;
}

double TableSpectrum::energy(double lower, double upper) const {
  return scale_ * (cumulative(upper) - cumulative(std::min(lower, upper)));
}

double TableSpectrum::energy_above(double omega) const { return std::max(0.0, total_ - scale_ * cumulative(omega)); }

double TableSpectrum::lowest_omega() const {
  const auto first = std::find_if(table_->density.begin(), table_->density.end(), [](double s) { return s > 0; });
  const auto row = static_cast<std::size_t>(first - table_->density.begin());
  return table_->omega[row > 0 ? row - 1 : 0];
}

std::unique_ptr<Spectrum> wind_sea_spectrum(const SeaState& state) {
  if (state.significant_wave_height_m == 0) return nullptr;
  if (state.table) return std::make_unique<TableSpectrum>(state.table, state.significant_wave_height_m);
  return std::make_unique<JonswapSpectrum>(state.significant_wave_height_m, state.peak_period_s, state.gamma,
                                           state.normalisation);
}

std::unique_ptr<Spectrum> swell_spectrum(const SeaState& state) {
  if (state.swell.significant_wave_height_m == 0) return nullptr;
  return std::make_unique<JonswapSpectrum>(state.swell.significant_wave_height_m, state.swell.peak_period_s,
                                           state.swell.gamma, state.normalisation);
}

double linear_cutoff(const SeaState& state) {
  if (state.cutoff_rad_s > 0) return state.cutoff_rad_s;
  return state.table ? state.table->omega.back() : std::max(8.0, 8 * kPi / state.peak_period_s);
}

double swell_cutoff(const SeaState& state) {
  return std::min(linear_cutoff(state), 8 * kPi / state.swell.peak_period_s);
}

double second_order_cutoff(const SeaState& state) {
  if (state.second_order_cutoff_rad_s > 0) return state.second_order_cutoff_rad_s;
  return total_wave_height(state) > 0 ? convergent_cutoff(state) : std::numeric_limits<double>::infinity();
}

}  // namespace seaglint
