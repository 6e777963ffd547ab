// SPDX-License-Identifier: BSD-3-Clause
// Random realisations of a sea state, and the spreading of their directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/sea/realisation.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/statistics.h"
#include "sim/sea/wave_field.h"
#include "tests/measured.h"
#include "tests/sim/sea/reference_table.h"

namespace seaglint {
namespace {

TEST(RealiseSea, HasTheSignificantWaveHeightExactly) {
  for (const double height : {0.1, 1.0, 2.0, 8.0}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const SeaState state = state_of(height, 10);
      EXPECT_NEAR(summarise(state, realise_sea(state, seed, 0)).significant_wave_height_m, height, 1e-13 * height);
    }
  }
}

TEST(RealiseSea, HasTheEnergyOfTheDensityInEachStratum) {
  const SeaState state = state_of(2, 8);
  const JonswapSpectrum spectrum(2, 8, 3.3);
  const WaveField field = realise_sea(state, 42, 0);
  const double lowest = 0.4 * 2 * kPi / 8, width = (8 - lowest) / 512;
  const double scale = spectrum.energy_above(0) / spectrum.energy(lowest, 8);
  ASSERT_EQ(field.components().size(), 512u);
  for (std::size_t i = 0; i < 512; ++i) {
    const WaveComponent& component = field.components()[i];
    const double lower = lowest + width * static_cast<double>(i);
    EXPECT_GE(component.omega, lower);
    EXPECT_LE(component.omega, lower + width);
    EXPECT_NEAR(component.wavenumber, component.omega * component.omega / kGravity, 1e-15);
    // The density at five points of the stratum, by the midpoint rule: 2 % where it is steepest, at the foot of the
    // peak.
    double expected = 0;
    for (int part = 0; part < 5; ++part) expected += spectrum.density(lower + (part + 0.5) * width / 5) * width / 5;
    EXPECT_NEAR(0.5 * component.amplitude * component.amplitude, scale * expected, 0.02 * expected + 1e-12);
  }
}

TEST(RealiseSea, IsTheSameForTheSameKeyAndAnotherForAnother) {
  const SeaState state = state_of(1, 8);
  const SurfaceState a = realise_sea(state, 42, 3).surface(1, 2, 3);
  const SurfaceState b = realise_sea(state, 42, 3).surface(1, 2, 3);
  EXPECT_EQ(a.elevation, b.elevation);
  EXPECT_EQ(a.slope_x, b.slope_x);
  EXPECT_NE(a.elevation, realise_sea(state, 42, 4).surface(1, 2, 3).elevation);
  EXPECT_NE(a.elevation, realise_sea(state, 43, 3).surface(1, 2, 3).elevation);
}

TEST(RealiseSea, DoesNotRepeatAsEquidistantFrequenciesWould) {
  SeaState state = state_of(1, 8);
  const WaveField field = realise_sea(state, 42, 0);
  const double period = 2 * kPi * 512 / (8 - 0.4 * 2 * kPi / 8);  // of equidistant components
  double difference = 0;
  for (int i = 0; i < 200; ++i)
    difference += std::pow(field.surface(0, 0, i).elevation - field.surface(0, 0, i + period).elevation, 2) / 200;
  EXPECT_GT(difference, 0.5 * 2 * 0.0625);  // twice the variance when the two are independent
}

// Ensemble of 400 independent seas: mean of eta^2 and eta^3 against m0 and the third cumulant, four standard errors.
TEST(RealiseSea, HasTheVarianceAndSkewnessOfItsSpectrum) {
  const SeaState state = state_of(1, 6);
  constexpr int kSeeds = 400, kTimes = 60;
  double variance = 0, variance2 = 0, third = 0, third2 = 0, skewness = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const WaveField field = realise_sea(state, 11, static_cast<std::uint64_t>(seed));
    skewness += summarise(state, field).skewness / kSeeds;
    double m2 = 0, m3 = 0;
    for (int i = 0; i < kTimes; ++i) {
      const SurfaceState surface = field.surface(0, 0, 5.7 * i);
      m2 += surface.elevation_linear * surface.elevation_linear / kTimes;
      // 3 eta1^2 eta2 has the mean of eta^3 to second order, without the scatter of eta1^3.
      m3 += 3 * surface.elevation_linear * surface.elevation_linear * (surface.elevation - surface.elevation_linear) /
            kTimes;
    }
    variance += m2 / kSeeds;
    variance2 += m2 * m2 / kSeeds;
    third += m3 / kSeeds;
    third2 += m3 * m3 / kSeeds;
  }
  EXPECT_NEAR(variance, 1.0 / 16, 4 * std::sqrt((variance2 - variance * variance) / kSeeds));
  const double expected = skewness * std::pow(1.0 / 16, 1.5);
  EXPECT_NEAR(third, expected, 4 * std::sqrt((third2 - third * third) / kSeeds));
  // The cut-off of the quadratic sums and of the spectrum lowers c(3.3) kp Hs a little.
  const double kp = 4 * kPi * kPi / 36 / kGravity;
  EXPECT_NEAR(skewness, 0.783 * kp, 0.05 * 0.783 * kp);
}

// The correlation of two points is int S cos(k dx) dw / m0; one sea's sum over components is its time average.
TEST(RealiseSea, CorrelatesTwoPointsByItsSpectrum) {
  SeaState state = state_of(1, 8);
  state.order = 1;
  const JonswapSpectrum spectrum(1, 8, 3.3);
  for (const double distance : {5.0, 20.0, 40.0}) {
    double expected = 0;
    constexpr int kSteps = 40000;
    for (int i = 0; i < kSteps; ++i) {
      const double omega = (i + 0.5) * 8.0 / kSteps;
      expected += spectrum.density(omega) * std::cos(omega * omega / kGravity * distance) * 8.0 / kSteps * 16;
    }
    double sum = 0;
    const WaveField field = realise_sea(state, 1, 0);
    for (const WaveComponent& c : field.components())
      sum += 8 * c.amplitude * c.amplitude * std::cos(c.wavenumber * distance);
    // A component lies anywhere in its stratum of 0.0149 rad/s: k dx has an uncertainty of 2 w dx 0.0043/g, averaged
    // over some 20 strata of the peak.
    EXPECT_NEAR(sum, expected, 0.01 + 0.001 * distance) << distance << " m";
  }
}

double energy_of(const WaveField& field) {
  double energy = 0;
  for (const WaveComponent& c : field.components()) energy += 0.5 * c.amplitude * c.amplitude;
  return energy;
}

// Fixed amplitudes have the spectrum's energy in every sea; random ones on average, with the scatter of a sum of
// exponential deviates: variance sum e^2.
TEST(RealiseSea, ScattersItsEnergyWithRandomAmplitudes) {
  SeaState state = state_of(1, 8);
  const WaveField fixed = realise_sea(state, 42, 0);
  double expected_variance = 0;
  for (const WaveComponent& c : fixed.components()) expected_variance += std::pow(0.5 * c.amplitude * c.amplitude, 2);
  state.amplitude = WaveAmplitude::kRandom;
  constexpr int kSeeds = 400;
  double mean = 0, square = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const WaveField field = realise_sea(state, 42, static_cast<std::uint64_t>(seed));
    // Frequencies and phases are those of the fixed amplitudes.
    if (seed == 0) {
      EXPECT_EQ(field.components()[100].omega, fixed.components()[100].omega);
    }
    mean += energy_of(field) / kSeeds;
    square += std::pow(energy_of(field), 2) / kSeeds;
  }
  EXPECT_NEAR(mean, 1.0 / 16, 4 * std::sqrt(expected_variance / kSeeds));
  // The variance of 400 draws has a standard error of 1/sqrt(200), more with the exponential's tail: 7 %; three times
  // that.
  EXPECT_NEAR(square - mean * mean, expected_variance, 0.25 * expected_variance);
}

TEST(RealiseSea, AddsSwellOfItsOwnDirectionAndEnergy) {
  SeaState state = state_of(1, 5);
  const WaveField wind = realise_sea(state, 42, 0);
  state.propagation_rad = radians(120);
  state.swell = {0.8, 12, 5, radians(40), {}, 128};
  const WaveField both = realise_sea(state, 42, 0);
  ASSERT_EQ(both.components().size(), 512u + 128u);
  EXPECT_FALSE(both.long_crested());
  double swell = 0;
  for (const WaveComponent& c : both.components()) {
    if (c.direction.x() < 0) continue;
    swell += 0.5 * c.amplitude * c.amplitude;
    EXPECT_NEAR(std::atan2(c.direction.y(), c.direction.x()), radians(40), 1e-15);
    EXPECT_LE(c.omega, 4 * 2 * kPi / 12);
  }
  EXPECT_NEAR(swell, 0.04, 1e-15);
  EXPECT_NEAR(energy_of(both) - swell, energy_of(wind), 1e-15);
  EXPECT_NEAR(summarise(state, both).significant_wave_height_m, std::sqrt(1.64), 1e-13);
  // Swell alone, and swell along the wind sea, whose waves then have one direction in common.
  state.significant_wave_height_m = 0;
  EXPECT_EQ(realise_sea(state, 42, 0).components().size(), 128u);
  state.significant_wave_height_m = 1;
  state.swell.propagation_rad = state.propagation_rad;
  EXPECT_TRUE(realise_sea(state, 42, 0).long_crested());
}

TEST(RealiseSea, KeepsTheEnergyOfItsNormalisation) {
  SeaState state = state_of(2, 8);
  state.normalisation = SpectrumNormalisation::kDnv;
  const double dnv = JonswapSpectrum(2, 8, 3.3, SpectrumNormalisation::kDnv).energy_above(0);
  EXPECT_NEAR(energy_of(realise_sea(state, 42, 0)), dnv, 1e-13);
  EXPECT_NEAR(16 * dnv / 4, 1.0024, 0.0001);
}

TEST(RealiseSea, FollowsATable) {
  SeaState state = state_of(1.5, 2 * kPi / 0.8);
  auto table = std::make_shared<SpectrumTable>();
  table->omega = {0.4, 0.8, 1.0, 1.6};
  table->density = {0, 0.5, 0.1, 0};
  state.table = table;
  const WaveField field = realise_sea(state, 42, 0);
  EXPECT_NEAR(energy_of(field), 1.5 * 1.5 / 16, 1e-14);
  EXPECT_GE(field.components().front().omega, 0.4);
  EXPECT_LE(field.components().back().omega, 1.6);
  // Fraction of the energy below 0.8: the first triangle.
  double below = 0;
  for (const WaveComponent& c : field.components()) below += c.omega < 0.8 ? 0.5 * c.amplitude * c.amplitude : 0;
  // The stratum at 0.8 contains 1/160 of the energy and extends to either side.
  EXPECT_NEAR(below / energy_of(field), 0.1 / (0.1 + 0.06 + 0.03), 1.0 / 160);
  const TableSpectrum spectrum(table, 1.5);
  EXPECT_NEAR(spectrum.energy(0, 10), 1.5 * 1.5 / 16, 1e-15);
  EXPECT_NEAR(spectrum.energy(0.5, 1.2) + spectrum.energy_above(1.2), spectrum.energy_above(0.5), 1e-15);
  EXPECT_NEAR(spectrum.density(0.6) / spectrum.density(0.8), 0.5, 1e-14);
  EXPECT_EQ(spectrum.density(1.7), 0);
}

TEST(RealiseSea, HasTheWavenumbersOfItsDepth) {
  SeaState state = state_of(1, 8);
  state.depth_m = 10;
  const WaveField field = realise_sea(state, 42, 0);
  EXPECT_EQ(field.depth(), 10);
  for (const WaveComponent& c : field.components())
    EXPECT_NEAR(kGravity * c.wavenumber * std::tanh(10 * c.wavenumber), c.omega * c.omega, 4e-15 * c.omega * c.omega);
}

TEST(RealiseSea, IsFlatWithoutWaves) {
  const WaveField field = realise_sea(state_of(0, 8), 1, 1);
  const SurfaceState surface = field.surface(3, 4, 5);
  EXPECT_EQ(surface.elevation, 0);
  EXPECT_EQ(surface.slope_x, 0);
  EXPECT_EQ(surface.velocity.norm(), 0);
  EXPECT_EQ(summarise(state_of(0, 8), field).significant_wave_height_m, 0);
}

TEST(RealiseSea, ReportsTheEnergyAboveTheCutoff) {
  SeaState state = state_of(1, 1.25);
  state.significant_wave_height_m = 0.1;
  state.cutoff_rad_s = 8;
  EXPECT_NEAR(summarise(state, realise_sea(state, 1, 0)).energy_fraction_above_cutoff, 0.12, 0.015);
  state.cutoff_rad_s = 0;
  EXPECT_LT(summarise(state, realise_sea(state, 1, 0)).energy_fraction_above_cutoff, 0.005);
}

TEST(RealiseSea, RefusesStatesThatNoSeaCanHave) {
  EXPECT_THROW(realise_sea(state_of(2, 1.5), 1, 0), InputError);
  EXPECT_THROW(realise_sea(state_of(-1, 8), 1, 0), InputError);
  EXPECT_THROW(realise_sea(state_of(1, 0), 1, 0), InputError);
  EXPECT_THROW(realise_sea(state_of(NAN, 8), 1, 0), InputError);
  SeaState state = state_of(1, 8);
  state.cutoff_rad_s = 0.5;
  EXPECT_THROW(realise_sea(state, 1, 0), InputError);
  state = state_of(1, 8);
  state.depth_m = 0;
  EXPECT_THROW(realise_sea(state, 1, 0), InputError);
  state.depth_m = 1;  // waves of 8 s are at most 0.87 m high here
  EXPECT_THROW(realise_sea(state, 1, 0), InputError);
  state = state_of(1, 8);
  state.swell.significant_wave_height_m = 3;
  state.swell.peak_period_s = 3;
  EXPECT_THROW(realise_sea(state, 1, 0), InputError);
}

// Standard deviation of the mean period T1 = 2 pi m0 / m1 of 400 realisations, over that of the finest strata.
double scatter_of_mean_period(SeaState state, int components) {
  constexpr int kSeas = 400;
  state.components = components;
  double sum = 0, square = 0;
  for (int i = 0; i < kSeas; ++i) {
    const WaveField field = realise_sea(state, 7, static_cast<std::uint64_t>(i));
    double m0 = 0, m1 = 0;
    for (const WaveComponent& wave : field.components()) {
      m0 += 0.5 * wave.amplitude * wave.amplitude;
      m1 += 0.5 * wave.amplitude * wave.amplitude * wave.omega;
    }
    const double period = 2 * kPi * m0 / m1;
    sum += period / kSeas;
    square += period * period / kSeas;
  }
  return std::sqrt(std::max(0.0, square - sum * sum)) / sum;
}

// With strata a tenth of the peak frequency wide T1 varies within 1 %; with eight components it varies far more.
TEST(StratumWidths, DetermineTheScatterOfTheMeanPeriod) {
  SeaState state;  // Hs 1 m, Tp 8 s, up to 8 rad/s
  state.order = 1;
  const double peak = 2 * kPi / 8, span = (8 - 0.4 * peak) / peak;
  for (const int components : {512, 98, 8, 1}) {
    state.components = components;
    EXPECT_NEAR(stratum_widths(state).wind_sea, span / components, 1e-12);
  }
  EXPECT_EQ(stratum_widths(state).swell, 0);
  state.swell = {1, 12, 5, 0, {}, 36};
  EXPECT_NEAR(stratum_widths(state).swell, 0.1, 1e-12);  // 0.4 to 4 times the peak
  state.swell = {};
  const double fine = scatter_of_mean_period(state, 512), bound = scatter_of_mean_period(state, 98),
               coarse = scatter_of_mean_period(state, 8);
  std::printf("scatter of T1: %.2f, %.2f, %.1f %%\n", 100 * fine, 100 * bound, 100 * coarse);
  record_figure(100 * fine, 2, "mean_period_512_components_percent");
  record_figure(100 * bound, 2, "mean_period_98_components_percent");
  record_figure(100 * coarse, 0, "mean_period_8_components_percent");
  // Standard error of a standard deviation of 400 seas: 1 / sqrt(800), 3.5 %; three of these.
  EXPECT_LT(fine, 0.001 * 1.1);
  EXPECT_LT(bound, 0.009 * 1.1);
  EXPECT_GT(coarse, 0.2);
}

// Tanh-sinh rule over [-pi, pi], whose end points may be singular; exact to rounding for these functions.
template <typename Function>
double over_full_circle(const Function& f) {
  double sum = 0;
  constexpr double kStep = 1.0 / 64;
  for (int n = -250; n <= 250; ++n) {
    const double t = n * kStep, inner = 0.5 * kPi * std::sinh(t);
    const double weight = 0.5 * kPi * std::cosh(t) / (std::cosh(inner) * std::cosh(inner));
    sum += kStep * kPi * weight * f(kPi * std::tanh(inner));
  }
  return sum;
}

// First circular moment of the density over the angle from the mean direction, the mean of its cosine: s/(s+1) for
// cos^2s, exp(-width^2/2) for the wrapped normal.
double spreading_r1(const SpreadingSpec& spec, double omega_over_peak) {
  if (spec.kind == Spreading::kNone) return 1;
  if (spec.kind == Spreading::kWrappedNormal) {
    const double sigma = radians(spec.width_deg);
    return std::exp(-0.5 * sigma * sigma);
  }
  const double s = spreading_exponent(spec, omega_over_peak);
  return s / (s + 1);
}

// The energy density of the sampler's angles from the mean direction, 1/rad; integrates to 1 over 2 pi: the wrapped
// normal, or cos^2s(angle/2) over 2 sqrt(pi) Gamma(s + 1/2) / Gamma(s + 1) (Longuet-Higgins, Cartwright and Smith
// 1963).
double spreading_density(const SpreadingSpec& spec, double angle, double omega_over_peak) {
  const double theta = std::remainder(angle, 2 * kPi);
  if (spec.kind == Spreading::kWrappedNormal) {
    const double sigma = radians(spec.width_deg);
    double sum = 0;
    constexpr int kTurns = 6;  // of images: beyond these is less than 1e-20 of the energy up to a width of 180 deg
    for (int turn = -kTurns; turn <= kTurns; ++turn) {
      const double z = (theta + 2 * kPi * turn) / sigma;
      sum += std::exp(-0.5 * z * z);
    }
    return sum / (sigma * std::sqrt(2 * kPi));
  }
  const double s = spreading_exponent(spec, omega_over_peak);
  const double norm = 2 * std::sqrt(kPi) * std::exp(std::lgamma(s + 0.5) - std::lgamma(s + 1));
  return std::pow(std::cos(0.5 * theta), 2 * s) / norm;
}

SpreadingSpec spec_of(Spreading kind, double s, double width_deg = 30) { return {kind, s, width_deg}; }

struct SpreadingCase {
  SpreadingSpec spec;
  double omega_over_peak;
};
const SpreadingCase kSpreadingCases[] = {{spec_of(Spreading::kCos2s, 0.5), 1},
                                         {spec_of(Spreading::kCos2s, 3.7), 1},
                                         {spec_of(Spreading::kCos2s, 10), 2},
                                         {spec_of(Spreading::kCos2s, 200), 1},
                                         {spec_of(Spreading::kMitsuyasu, 10), 0.8},
                                         {spec_of(Spreading::kMitsuyasu, 75), 1},
                                         {spec_of(Spreading::kMitsuyasu, 10), 3},
                                         {spec_of(Spreading::kWrappedNormal, 1, 10), 1},
                                         {spec_of(Spreading::kWrappedNormal, 1, 60), 1},
                                         {spec_of(Spreading::kWrappedNormal, 1, 180), 1}};

TEST(Spreading, IntegratesToOneAndHasItsR1) {
  for (const auto& [spec, u] : kSpreadingCases) {
    const auto density = [&spec = spec, u = u](double angle) { return spreading_density(spec, angle, u); };
    EXPECT_NEAR(over_full_circle(density), 1, 1e-12) << spreading_exponent(spec, u);
    EXPECT_NEAR(over_full_circle([&](double angle) { return density(angle) * std::cos(angle); }), spreading_r1(spec, u),
                1e-12);
    EXPECT_NEAR(over_full_circle([&](double angle) { return density(angle) * std::sin(angle); }), 0, 1e-12);
  }
}

// Mitsuyasu et al. (1975): widest above the peak, narrowest at it.
TEST(Spreading, OfMitsuyasuIsNarrowestAtThePeak) {
  const SpreadingSpec spec = spec_of(Spreading::kMitsuyasu, 10);
  EXPECT_NEAR(spreading_exponent(spec, 1), 10, 1e-13);
  EXPECT_NEAR(spreading_exponent(spec, 0.9), 10 * std::pow(0.9, 5), 1e-13);
  EXPECT_NEAR(spreading_exponent(spec, 2), 10 * std::pow(2, -2.5), 1e-13);
}

TEST(Spreading, QuantileIsTheInverseOfTheFraction) {
  for (const auto& [spec, u] : kSpreadingCases) {
    for (const double probability : {1e-6, 0.02, 0.3, 0.5, 0.77, 0.999}) {
      const double angle = spreading_quantile(spec, probability, u);
      if (spec.kind == Spreading::kWrappedNormal) {
        // Before wrapping: the normal's fraction.
        EXPECT_NEAR(0.5 * std::erfc(-angle / radians(spec.width_deg) / std::sqrt(2.0)), probability, 1e-12);
        continue;
      }
      // The fraction between 0 and the angle by Simpson's rule, for which the density is smooth enough.
      double sum = 0;
      constexpr int kSteps = 4000;
      for (int i = 0; i <= kSteps; ++i) {
        const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * spreading_density(spec, angle * i / kSteps, u) * angle / kSteps / 3;
      }
      EXPECT_NEAR(0.5 + sum, probability, 1e-8) << spreading_exponent(spec, u);
    }
  }
}

TEST(Spreading, OfARealisationHasItsR1) {
  for (const auto& [kind, s] : {std::pair{Spreading::kCos2s, 4.0}, std::pair{Spreading::kMitsuyasu, 10.0},
                                std::pair{Spreading::kWrappedNormal, 1.0}}) {
    SeaState state;
    state.significant_wave_height_m = 1;
    state.peak_period_s = 8;
    state.propagation_rad = radians(120);
    state.order = 1;
    state.cutoff_rad_s = 8;
    state.spreading = spec_of(kind, s);
    const WaveField field = realise_sea(state, 42, 0);
    EXPECT_FALSE(field.long_crested());
    Vec2 mean = Vec2::Zero();
    double expected = 0;
    for (const WaveComponent& c : field.components()) {
      EXPECT_NEAR(c.direction.norm(), 1, 1e-14);
      const double fraction = 8 * c.amplitude * c.amplitude;
      mean += fraction * c.direction;
      expected += fraction * spreading_r1(state.spreading, c.omega * 8 / (2 * kPi));
    }
    // Thirty adjacent components have the peak's energy, their directions a thirtieth of the distribution apart.
    EXPECT_NEAR(mean.norm(), expected, 0.01);
    EXPECT_NEAR(std::atan2(mean.y(), mean.x()), radians(120), 0.02);
  }
}

// Correlation of two points across the waves: int int S D cos(k dx sin(angle)) / m0.
TEST(Spreading, CorrelationAcrossTheWavesEqualsItsIntegral) {
  SeaState state;
  state.significant_wave_height_m = 1;
  state.peak_period_s = 8;
  state.propagation_rad = 0;
  state.order = 1;
  state.cutoff_rad_s = 4;
  state.spreading = spec_of(Spreading::kCos2s, 4);
  constexpr int kSeeds = 40;
  for (const double distance : {20.0, 40.0, 80.0}) {
    double sum = 0, square = 0, expected = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      double one = 0;
      const WaveField field = realise_sea(state, seed, 0);
      for (const WaveComponent& c : field.components()) {
        const double fraction = 8 * c.amplitude * c.amplitude;
        one += fraction * std::cos(c.wavenumber * distance * c.direction.y());
        expected +=
            fraction / kSeeds * over_full_circle([&](double angle) {
              return spreading_density(state.spreading, angle, 1) * std::cos(c.wavenumber * distance * std::sin(angle));
            });
      }
      sum += one / kSeeds;
      square += one * one / kSeeds;
    }
    EXPECT_NEAR(sum, expected, 4 * std::sqrt((square - sum * sum) / kSeeds)) << distance << " m";
  }
}

}  // namespace
}  // namespace seaglint
