// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/realisation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/sea/wave_field.h"

namespace seaglint {
namespace {

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

struct Case {
  SpreadingSpec spec;
  double omega_over_peak;
};
const Case kCases[] = {{spec_of(Spreading::kCos2s, 0.5), 1},
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
  for (const auto& [spec, u] : kCases) {
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
  for (const auto& [spec, u] : kCases) {
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
