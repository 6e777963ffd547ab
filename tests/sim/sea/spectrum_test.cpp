// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sim/core/numbers/constants.h"
#include "sim/sea/realisation.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/statistics.h"
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
    const double omega = (i + 0.5) * step, energy = spectrum.density(omega) * step, k = omega * omega / kGravity;
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
    const double peak = 2 * kPi / 6, kp = peak * peak / kGravity, found = skewness({1, 6, gamma}, 40 * peak) / kp;
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

// All crests of an ensemble, ascending.
std::vector<double> ensemble(const SeaState& state, int seeds, double duration, double step) {
  std::vector<double> crests;
  for (int seed = 0; seed < seeds; ++seed) {
    const WaveField field = realise_sea(state, 5, static_cast<std::uint64_t>(seed));
    SurfaceSeries series(field, 0, 0, 0, step, SurfaceQuantities::kElevationAndSlope);
    std::vector<double> elevation(static_cast<std::size_t>(duration / step));
    for (double& value : elevation) {
      value = series.state().elevation;
      series.advance();
    }
    const std::vector<double> part = crest_heights(elevation);
    crests.insert(crests.end(), part.begin(), part.end());
  }
  std::sort(crests.begin(), crests.end());
  return crests;
}

double exceeded_with(const std::vector<double>& ascending, double probability) {
  return ascending[static_cast<std::size_t>((1 - probability) * static_cast<double>(ascending.size()))];
}

class Crests : public testing::TestWithParam<std::pair<double, double>> {};

// Forristall's fit has an error of a few per cent itself; of 25,000 crests 25 exceed the height of 0.1 %, whose
// standard error is 1.5 %.
TEST_P(Crests, HaveForristallsDistribution) {
  const auto [height, period] = GetParam();
  const SeaState state = state_of(height, period);
  const std::vector<double> crests = ensemble(state, 120, 200 * period, period / 24);
  ASSERT_GT(crests.size(), 25000u);
  const SeaSummary summary = summarise(state, realise_sea(state, 5, 0));
  const ForristallCrests forristall = forristall_crests(height, summary.steepness, 0, true);
  double least = 10, most = 0;
  for (const double probability : {0.1, 0.03, 0.01, 0.003, 0.001}) {
    const double ratio = exceeded_with(crests, probability) / forristall.height(probability);
    least = std::min(least, ratio);
    most = std::max(most, ratio);
    EXPECT_NEAR(ratio, 1, 0.05) << "Hs " << height << " m, exceeded by " << 100 * probability << " %";
    std::printf("Hs %g m, Tp %g s: crest exceeded by %g %% over Forristall's %.3f\n", height, period, 100 * probability,
                ratio);
  }
  record_figure(least, 3, "crests_hs_{}_tp_{}_least", height, period);
  record_figure(most, 3, "crests_hs_{}_tp_{}_most", height, period);
}
INSTANTIATE_TEST_SUITE_P(Deep, Crests, testing::Values(std::pair{1.0, 5.0}, std::pair{2.0, 7.0}, std::pair{2.0, 8.0}));

// Linear crests of a narrow spectrum are Rayleigh's.
TEST(Crests, OfLinearNarrowWavesAreRayleighs) {
  SeaState state = state_of(1, 8);
  state.order = 1;
  state.gamma = 20;
  state.cutoff_rad_s = 1.2;
  const std::vector<double> crests = ensemble(state, 60, 1600, 0.4);
  for (const double probability : {0.3, 0.1, 0.03, 0.01}) {
    // Crests of a spectrum of this width are 2 % below the narrow-band limit.
    EXPECT_NEAR(rayleigh_exceedance(exceeded_with(crests, probability), 1) / probability, 1, 0.2) << probability;
  }
}

TEST(CrestHeights, AreThoseOfASampledWave) {
  std::vector<double> elevation;
  for (int i = 0; i < 1000; ++i) elevation.push_back(1.5 * std::sin(2 * kPi * (i + 0.37) / 12.7));
  const std::vector<double> crests = crest_heights(elevation);
  EXPECT_EQ(crests.size(), 78u);  // of 78.7 periods; the first has no up-crossing
  for (const double crest : crests) EXPECT_NEAR(crest, 1.5, 0.0015 * 1.5);
  EXPECT_TRUE(crest_heights(std::vector<double>(50, -1.0)).empty());
  EXPECT_TRUE(crest_heights({}).empty());
}

TEST(ForristallCrests, HeightIsTheInverseOfExceedance) {
  const ForristallCrests crests = forristall_crests(2, 0.05, 0.1, false);
  for (const double probability : {0.5, 0.01, 1e-4})
    EXPECT_NEAR(crests.exceedance(crests.height(probability)), probability, 1e-12);
  // Without steepness and in deep water it is Rayleigh's, whose alpha is 1/sqrt(8).
  EXPECT_NEAR(forristall_crests(2, 0, 0, true).exceedance(1.5), rayleigh_exceedance(1.5, 2), 1e-4);
}

// Skewness of `count` equidistant components of the spectrum, in water of any depth.
double skewness_of(const JonswapSpectrum& spectrum, double cutoff, double depth, int count) {
  std::vector<WaveComponent> components;
  const double lowest = spectrum.lowest_omega(), width = (cutoff - lowest) / count;
  double m0 = 0;
  for (int i = 0; i < count; ++i) {
    const double omega = lowest + (i + 0.5) * width;
    const double energy = spectrum.energy(omega - 0.5 * width, omega + 0.5 * width);
    m0 += energy;
    components.push_back({omega, std::sqrt(2 * energy), 0, wavenumber_at(omega, depth)});
  }
  return WaveField(components, 2, 1e9, depth).third_cumulant() / std::pow(m0, 1.5);
}

// WAFO integrates over the spectrum. N waves of fixed amplitude have half of the self-interaction of each, a deficit of
// 1/N, which the step from N to 2 N removes. Half a per cent: the error of Hs on WAFO's own grid is 0.03 %, and its
// spectrum ends at the cut-off.
TEST(Skewness, IsThatOfWafoAtEveryGivenDepth) {
  double worst = 0;
  for (const std::vector<double>& row : read_reference("wafo_second_order_moments.csv")) {
    const double depth = std::isfinite(row[4]) && row[4] > 0 ? row[4] : kDeepWater;
    const JonswapSpectrum spectrum(row[1], row[2], row[3]);
    const double skewness = 2 * skewness_of(spectrum, row[5], depth, 1600) - skewness_of(spectrum, row[5], depth, 800);
    EXPECT_NEAR(skewness, row[7], 0.005 * row[7]) << row[1] << " m, depth " << depth;
    std::printf("skewness at depth %g m: %.5f, WAFO %.5f\n", depth, skewness, row[7]);
    worst = std::max(worst, std::abs(skewness / row[7] - 1));
  }
  record_figure(100 * worst, 2, "skewness_wafo_percent");
}

// One hundred seas of finite depth and spread directions: the mean of 3 eta1^2 eta2 against the third cumulant.
TEST(Skewness, OfAnEnsembleOfDirectionalSeasLiesWithinItsConfidence) {
  SeaState state = state_of(1.5, 6);
  state.depth_m = 15;
  state.spreading.kind = Spreading::kCos2s;
  state.components = 96;
  state.cutoff_rad_s = 3.5;
  constexpr int kSeeds = 100, kTimes = 60;
  double mean = 0, square = 0, expected = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const WaveField field = realise_sea(state, 17, static_cast<std::uint64_t>(seed));
    expected += field.third_cumulant() / kSeeds;
    double third = 0;
    for (int i = 0; i < kTimes; ++i) {
      const SurfaceState s = field.surface(40.0 * i, 0, 7.7 * i, SurfaceQuantities::kElevationAndSlope);
      third += 3 * s.elevation_linear * s.elevation_linear * (s.elevation - s.elevation_linear) / kTimes;
    }
    mean += third / kSeeds;
    square += third * third / kSeeds;
  }
  // Four standard errors of the mean: a false failure in one of 16,000 runs.
  EXPECT_NEAR(mean, expected, 4 * std::sqrt((square - mean * mean) / kSeeds));
  EXPECT_GT(expected, 0);
}

// The slope variance of a w^-5 sea grows with the logarithm of the cut-off: alpha/2 ... per octave alpha ln 2.
TEST(SeaSummary, ReportsTheSlopeVarianceAboveTheCutoff) {
  SeaState state = state_of(1, 8);
  const SeaSummary at8 = summarise(state, realise_sea(state, 1, 0));
  state.cutoff_rad_s = 16;
  state.components = 1024;
  const SeaSummary at16 = summarise(state, realise_sea(state, 1, 0));
  EXPECT_NEAR(at8.slope_variance + at8.slope_variance_next_octave, at16.slope_variance, 0.01 * at16.slope_variance);
  EXPECT_NEAR(at8.slope_variance_next_octave, at16.slope_variance_next_octave, 0.01 * at8.slope_variance_next_octave);
}

TEST(SeaSummary, HasSteepnessUrsellAndDirection) {
  SeaState state = state_of(2, 7);
  state.depth_m = 15;
  state.spreading = {Spreading::kWrappedNormal, 10, 25};
  state.order = 1;
  const WaveField field = realise_sea(state, 1, 0);
  const SeaSummary summary = summarise(state, field);
  EXPECT_NEAR(summary.mean_period_s, 0.834 * 7, 0.02 * 7);  // T1/Tp of JONSWAP at gamma 3.3 (DNV-RP-C205: 0.834)
  EXPECT_FALSE(summary.long_crested);
  EXPECT_NEAR(summary.steepness, 2 * kPi * 2 / (kGravity * summary.mean_period_s * summary.mean_period_s), 1e-12);
  const double k1 = wavenumber_at(2 * kPi / summary.mean_period_s, 15);
  EXPECT_NEAR(summary.ursell, 2 / (k1 * k1 * 15 * 15 * 15), 1e-12);
  // Thirty adjacent components have the peak's energy, their directions a thirtieth of the distribution apart.
  EXPECT_NEAR(summary.direction_r1, std::exp(-0.5 * radians(25) * radians(25)), 0.01);
}

}  // namespace
}  // namespace seaglint
