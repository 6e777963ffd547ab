// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/sea/spectrum.h"
#include "sim/sea/wave_field.h"

namespace seaglint {
namespace {

SeaState state_of(double height, double period) {
  SeaState state;
  state.significant_wave_height_m = height;
  state.peak_period_s = period;
  state.cutoff_rad_s = 0;
  state.second_order_cutoff_rad_s = 0;
  return state;
}

TEST(RealizeSea, MeetsTheSignificantWaveHeightExactly) {
  for (const double height : {0.1, 1.0, 2.0, 8.0}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const SeaState state = state_of(height, 10);
      EXPECT_NEAR(summarize(state, realize_sea(state, seed, 0)).significant_wave_height_m, height, 1e-13 * height);
    }
  }
}

TEST(RealizeSea, GivesEachStratumTheEnergyOfItsDensity) {
  const SeaState state = state_of(2, 8);
  const JonswapSpectrum spectrum(2, 8, 3.3);
  const WaveField field = realize_sea(state, 42, 0);
  const double lowest = 0.4 * 2 * kPi / 8;
  const double width = (8 - lowest) / 512;
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

TEST(RealizeSea, IsTheSameForTheSameKeyAndAnotherForAnother) {
  const SeaState state = state_of(1, 8);
  const SurfaceState a = realize_sea(state, 42, 3).surface(1, 2, 3);
  const SurfaceState b = realize_sea(state, 42, 3).surface(1, 2, 3);
  EXPECT_EQ(a.elevation, b.elevation);
  EXPECT_EQ(a.slope_x, b.slope_x);
  EXPECT_NE(a.elevation, realize_sea(state, 42, 4).surface(1, 2, 3).elevation);
  EXPECT_NE(a.elevation, realize_sea(state, 43, 3).surface(1, 2, 3).elevation);
}

TEST(RealizeSea, DoesNotRepeatAsEquidistantFrequenciesWould) {
  SeaState state = state_of(1, 8);
  const WaveField field = realize_sea(state, 42, 0);
  const double period = 2 * kPi * 512 / (8 - 0.4 * 2 * kPi / 8);  // of equidistant components
  double difference = 0;
  for (int i = 0; i < 200; ++i) {
    difference += std::pow(field.surface(0, 0, i).elevation - field.surface(0, 0, i + period).elevation, 2) / 200;
  }
  EXPECT_GT(difference, 0.5 * 2 * 0.0625);  // twice the variance when the two are independent
}

// Ensemble of 400 independent seas: mean of eta^2 and eta^3 against m0 and the third cumulant, four standard errors.
TEST(RealizeSea, HasTheVarianceAndSkewnessOfItsSpectrum) {
  const SeaState state = state_of(1, 6);
  constexpr int kSeeds = 400, kTimes = 60;
  double variance = 0, variance2 = 0, third = 0, third2 = 0;
  double skewness = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const WaveField field = realize_sea(state, 11, static_cast<std::uint64_t>(seed));
    skewness += summarize(state, field).skewness / kSeeds;
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
  // The cut-off of the quadratic sums and of the spectrum takes a little from c(3.3) kp Hs.
  const double kp = 4 * kPi * kPi / 36 / kGravity;
  EXPECT_NEAR(skewness, 0.783 * kp, 0.05 * 0.783 * kp);
}

// The correlation of two points is int S cos(k dx) dw / m0; one sea's sum over components is its time average.
TEST(RealizeSea, CorrelatesTwoPointsAsItsSpectrumSays) {
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
    const WaveField field = realize_sea(state, 1, 0);
    for (const WaveComponent& c : field.components())
      sum += 8 * c.amplitude * c.amplitude * std::cos(c.wavenumber * distance);
    // A component sits anywhere in its stratum of 0.0149 rad/s: k dx is uncertain by 2 w dx 0.0043/g, averaged over
    // some 20 strata of the peak.
    EXPECT_NEAR(sum, expected, 0.01 + 0.001 * distance) << distance << " m";
  }
}

TEST(RealizeSea, IsFlatWithoutWaves) {
  const WaveField field = realize_sea(state_of(0, 8), 1, 1);
  const SurfaceState surface = field.surface(3, 4, 5);
  EXPECT_EQ(surface.elevation, 0);
  EXPECT_EQ(surface.slope_x, 0);
  EXPECT_EQ(surface.velocity.norm(), 0);
  EXPECT_EQ(summarize(state_of(0, 8), field).significant_wave_height_m, 0);
}

TEST(RealizeSea, ReportsWhatIsAboveTheCutoff) {
  SeaState state = state_of(1, 1.25);
  state.significant_wave_height_m = 0.1;
  state.cutoff_rad_s = 8;
  EXPECT_NEAR(summarize(state, realize_sea(state, 1, 0)).energy_share_above_cutoff, 0.12, 0.015);
  state.cutoff_rad_s = 0;
  EXPECT_LT(summarize(state, realize_sea(state, 1, 0)).energy_share_above_cutoff, 0.005);
}

TEST(RealizeSea, RefusesStatesThatNoSeaCanHave) {
  EXPECT_THROW(realize_sea(state_of(2, 1.5), 1, 0), InputError);
  EXPECT_THROW(realize_sea(state_of(-1, 8), 1, 0), InputError);
  EXPECT_THROW(realize_sea(state_of(1, 0), 1, 0), InputError);
  EXPECT_THROW(realize_sea(state_of(NAN, 8), 1, 0), InputError);
  SeaState state = state_of(1, 8);
  state.cutoff_rad_s = 0.5;
  EXPECT_THROW(realize_sea(state, 1, 0), InputError);
}

}  // namespace
}  // namespace seaglint
