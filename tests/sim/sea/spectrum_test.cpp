// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/core/numbers/constants.h"
#include "tests/measured.h"
#include "tests/sim/sea/reference_table.h"

namespace seaglint {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kDnv = SpectrumNormalisation::kDnv;

// Gamma of the DNV rule at Tp/sqrt(Hs) = 4.95 (DNV-RP-C205, section 3.5.5.5).
const double kGammaRule = std::exp(5.75 - 1.15 * 7 / std::sqrt(2.0));

TEST(JonswapSpectrum, EqualsTheTableOfMssInDnvMode) {
  const JonswapSpectrum spectra[] = {
      {0.1, 3, 3.3, kDnv}, {1, 5, 3.3, kDnv}, {2, 7, 3.3, kDnv}, {2, 7, kGammaRule, kDnv}, {1, 5, 1, kDnv}};
  for (const std::vector<double>& row : read_reference("mss_jonswap.csv")) {
    for (std::size_t i = 0; i < 5; ++i) {
      // The table has ten digits.
      EXPECT_NEAR(spectra[i].density(row[0]), row[i + 1], 1e-9 * row[i + 1] + 1e-15) << row[0] << " rad/s, case " << i;
    }
  }
}

TEST(JonswapSpectrum, EqualsTheTableOfMhkitInDnvMode) {
  const JonswapSpectrum spectra[] = {
      {0.1, 3, 3.3, kDnv}, {1, 5, 3.3, kDnv}, {2, 7, 3.3, kDnv}, {2, 7, kGammaRule, kDnv}, {1, 5, 1, kDnv}};
  for (const std::vector<double>& row : read_reference("mhkit_jonswap.csv")) {
    for (std::size_t i = 0; i < 5; ++i) {
      const double density = 2 * kPi * spectra[i].density(2 * kPi * row[0]);
      EXPECT_NEAR(density, row[i + 1], 1e-9 * row[i + 1] + 1e-15) << row[0] << " Hz, case " << i;
    }
  }
}

TEST(JonswapSpectrum, HasASixteenthOfTheSquaredHeightWhenExact) {
  for (const double gamma : {1.0, 2.0, 3.3, 7.0, 20.0}) {
    const JonswapSpectrum spectrum(2, 9, gamma);
    EXPECT_NEAR(spectrum.energy(0, kInfinity), 0.25, 0.25 * 1e-12) << "gamma " << gamma;
    EXPECT_NEAR(spectrum.energy_above(0), 0.25, 0.25 * 1e-12) << "gamma " << gamma;
  }
}

TEST(JonswapSpectrum, HasTheKnownErrorsInDnvMode) {
  EXPECT_NEAR(JonswapSpectrum(1, 5, 3.3, kDnv).energy_above(0) * 16, 1.0024, 0.0001);
  EXPECT_NEAR(JonswapSpectrum(1, 5, 7, kDnv).energy_above(0) * 16, 0.982, 0.001);
}

TEST(JonswapSpectrum, EnergyIsTheIntegralOfItsDensity) {
  const JonswapSpectrum spectrum(1.5, 6, 3.3);
  for (const auto& [lower, upper] :
       {std::pair{0.5, 0.9}, std::pair{0.9, 1.3}, std::pair{1.0, 1.1}, std::pair{3.0, 8.0}}) {
    // Midpoint rule: its error is h^2/24 times the change of the slope, here below 1e-7 of the integral.
    constexpr int kSteps = 20000;
    const double step = (upper - lower) / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += step * spectrum.density(lower + (i + 0.5) * step);
    EXPECT_NEAR(spectrum.energy(lower, upper), sum, 2e-7 * sum) << lower << " to " << upper;
  }
  EXPECT_NEAR(spectrum.energy(0, 2) + spectrum.energy_above(2), spectrum.energy_above(0), 1e-15);
}

TEST(JonswapSpectrum, IsPiersonMoskowitzAtGammaOne) {
  const JonswapSpectrum spectrum(1, 5, 1);
  const double peak = 2 * kPi / 5;
  EXPECT_NEAR(spectrum.energy(0, 2 * peak) * 16, std::exp(-1.25 / 16), 1e-12);
  EXPECT_EQ(spectrum.density(0), 0);
  EXPECT_EQ(spectrum.density(-1), 0);
}

// c(gamma) of skewness = c kp Hs, in integral form: 3 int int S S' min(k, k') / m0^1.5.
double skewness(const JonswapSpectrum& spectrum, double cutoff) {
  const double m0 = spectrum.energy_above(0);
  constexpr int kSteps = 20000;
  const double step = cutoff / kSteps;
  double below = 0;  // integral of k S up to here
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double omega = (i + 0.5) * step;
    const double energy = spectrum.density(omega) * step;
    const double k = omega * omega / kGravity;
    sum += energy * (2 * below + k * energy);
    below += k * energy;
  }
  return 3 * sum / std::pow(m0, 1.5);
}

TEST(JonswapSpectrum, HasTheSkewnessOfWafo) {
  for (const std::vector<double>& row : read_reference("wafo_second_order_moments.csv")) {
    const double height = row[1], period = row[2], gamma = row[3], depth = row[4], cutoff = row[5], expected = row[7];
    if (std::isfinite(depth) && depth > 0) continue;
    // Half a per cent: the error of Hs on WAFO's own grid is 0.03 %, and its spectrum ends at the cut-off.
    EXPECT_NEAR(skewness({height, period, gamma}, cutoff), expected, 0.005 * expected) << "Hs " << height;
  }
}

TEST(JonswapSpectrum, HasTheSkewnessCoefficientsOfDeepWater) {
  double worst = 0;
  for (const auto& [gamma, c] : {std::pair{1.0, 0.871}, std::pair{3.3, 0.783}, std::pair{7.0, 0.748}}) {
    const double peak = 2 * kPi / 6;
    const double kp = peak * peak / kGravity;
    const double found = skewness({1, 6, gamma}, 40 * peak) / kp;
    EXPECT_NEAR(found, c, 0.005 * c) << "gamma " << gamma;
    worst = std::max(worst, std::abs(found / c - 1));
  }
  record_figure(100 * worst, 2, "skewness_coefficient_percent");
}

TEST(Cutoff, FollowsTheStateWhereItIsNotGiven) {
  SeaState state;
  state.cutoff_rad_s = 0;
  state.second_order_cutoff_rad_s = 0;
  state.peak_period_s = 8;
  EXPECT_EQ(linear_cutoff(state), 8);
  state.peak_period_s = 2;
  EXPECT_NEAR(linear_cutoff(state), 4 * kPi, 1e-12);
  for (const auto& [height, expected] : {std::pair{0.1, 14.0}, std::pair{1.0, 4.43}, std::pair{2.0, 3.13}}) {
    state.significant_wave_height_m = height;
    EXPECT_NEAR(second_order_cutoff(state), expected, 0.01);
  }
  state.cutoff_rad_s = 6;
  state.second_order_cutoff_rad_s = 5;
  EXPECT_EQ(linear_cutoff(state), 6);
  EXPECT_EQ(second_order_cutoff(state), 5);
}

}  // namespace
}  // namespace seaglint
