// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/second_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/sea/wave_field.h"
#include "tests/sim/sea/double_sum.h"
#include "tests/sim/sea/reference_table.h"

namespace seaglint {
namespace {

constexpr double kNoCutoff = std::numeric_limits<double>::infinity();

// A few waves of 3 to 9 s and about a metre in all; spread over `spread` to each side of 30 deg.
std::vector<WaveComponent> some_waves(double depth, double spread, std::size_t count = 24) {
  Random random({7, Stream::kTest, 3});
  std::vector<WaveComponent> waves(count);
  for (std::size_t i = 0; i < count; ++i) {
    WaveComponent& wave = waves[i];
    wave.omega = 0.7 + 1.4 * (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
    wave.amplitude = 0.3 * random.uniform() / std::sqrt(static_cast<double>(count));
    wave.phase = 2 * kPi * random.uniform();
    wave.wavenumber = wavenumber_at(wave.omega, depth);
    const double direction = radians(30) + spread * (2 * random.uniform() - 1);
    wave.direction = {std::cos(direction), std::sin(direction)};
  }
  return waves;
}

struct Case {
  const char* name;
  double depth;
  double spread;  // rad
};

class SecondOrderKernels : public testing::TestWithParam<Case> {};

// Both sides are sums of 1152 terms of at most 1e-3 m, so that rounding is 1e-16 m; the difference waves of components
// of similar frequency lose four digits to cancellation in either.
TEST_P(SecondOrderKernels, EqualADoubleSumFromTheBoundaryConditions) {
  const auto [name, depth, spread] = GetParam();
  const WaveField field(some_waves(depth, spread), 2, kNoCutoff, depth);
  double largest = 0;
  EXPECT_EQ(field.long_crested(), spread == 0);
  for (const auto& [x, y, t] :
       {std::array{0.0, 0.0, 0.0}, std::array{31.0, -12.0, 17.3}, std::array{-200.0, 80.0, 260.0}}) {
    const ReferenceSurface expected = second_order_surface(field.components(), depth, x, y, t);
    const SurfaceState surface = field.surface(x, y, t);
    EXPECT_NEAR(surface.elevation_linear, expected.linear, 1e-12);
    EXPECT_NEAR(surface.elevation - surface.elevation_linear, expected.second, 1e-12);
    const SurfaceState linear = WaveField(field.components(), 1, 0, depth).surface(x, y, t);
    EXPECT_NEAR(surface.slope_x - linear.slope_x, expected.second_slope.x(), 1e-12);
    EXPECT_NEAR(surface.slope_y - linear.slope_y, expected.second_slope.y(), 1e-12);
    EXPECT_NEAR((surface.velocity - expected.velocity).norm(), 0, 1e-12);
    EXPECT_NEAR((surface.acceleration - expected.acceleration).norm(), 0, 1e-12);
    largest = std::max(largest, std::abs(expected.second));
  }
  EXPECT_GT(largest, 1e-3);  // the comparison is not empty
}
INSTANTIATE_TEST_SUITE_P(, SecondOrderKernels,
                         testing::Values(Case{"DeepLongCrested", kDeepWater, 0},
                                         Case{"DeepDirectional", kDeepWater, 1.5}, Case{"LongCrestedIn15Metres", 15, 0},
                                         Case{"DirectionalIn15Metres", 15, 1.5}, Case{"OpposedIn8Metres", 8, 3.1}),
                         [](const auto& one) { return one.param.name; });

TEST(RegularWaves, AreStokesWavesAtEveryGivenDepth) {
  for (const char* table : {"raschii_stokes2_deep.csv", "raschii_stokes2_15m.csv"}) {
    for (const std::vector<double>& row : read_reference(table)) {
      const double height = row[2], depth = row[3], k = 2 * kPi / row[4], x = row[5], eta = row[6];
      const double omega = std::sqrt(kGravity * k * std::tanh(k * depth));
      const WaveField wave({{omega, 0.5 * height, 0, k}}, {1, 0}, 2, kNoCutoff, depth);
      // The table has twelve digits: half a unit of the last one of 1.08 m.
      EXPECT_NEAR(wave.surface(x, 0, 0).elevation, eta, 5e-12 * std::max(1.0, height)) << height << " m, " << x << " m";
    }
  }
}

// Four crossing waves: the same surface for either order of summation of the pairs.
TEST(PairInteractions, EqualTheRunningSumsOfWavesOfOneDirection) {
  const std::vector<WaveComponent> waves = some_waves(kDeepWater, 0, 100);
  const WaveField running(waves, 2, kNoCutoff);
  const PairInteractions pairs(waves, kDeepWater);
  std::vector<double> cosine, sine;
  for (const WaveComponent& w : waves) {
    cosine.push_back(w.amplitude * std::cos(w.phase));
    sine.push_back(w.amplitude * std::sin(w.phase));
  }
  const SecondOrder second = pairs.evaluate(waves, cosine, sine, true);
  const SurfaceState surface = running.surface(0, 0, 0);
  EXPECT_NEAR(surface.elevation - surface.elevation_linear, second.elevation, 1e-13);
  EXPECT_EQ(pairs.evaluate(waves, cosine, sine, false).elevation, second.elevation);
}

// Crossing waves of one frequency have a difference wave of zero frequency, and no singular kernel.
TEST(PairInteractions, OfWavesOfOneFrequencyAreFinite) {
  const double k = 0.1, omega = std::sqrt(kGravity * k);
  for (const double depth : {kDeepWater, 20.0}) {
    const double w = std::isinf(depth) ? omega : std::sqrt(kGravity * k * std::tanh(k * depth));
    const std::vector<WaveComponent> waves{
        {w, 0.5, 0.1, k, {1, 0}}, {w, 0.4, 0.2, k, {1, 0}}, {w, 0.3, 0.3, k, {0, 1}}};
    const SurfaceState surface = WaveField(waves, 2, kNoCutoff, depth).surface(3, 4, 5);
    EXPECT_TRUE(std::isfinite(surface.elevation) && surface.velocity.allFinite() && surface.acceleration.allFinite());
    // The crossing pair alone, next to frequencies that differ a little.
    std::vector<WaveComponent> crossing{waves[0], waves[2]};
    const double together = WaveField(crossing, 2, kNoCutoff, depth).surface(3, 4, 5).elevation;
    crossing[1].omega *= 1 + 1e-7;
    crossing[1].wavenumber = wavenumber_at(crossing[1].omega, depth);
    EXPECT_NEAR(WaveField(crossing, 2, kNoCutoff, depth).surface(3, 4, 5).elevation, together, 1e-6);
  }
}

// Water drifts with a regular wave at a^2 w k, Stokes' drift at the surface of deep water, to the order of a^4.
TEST(SurfaceVelocity, MovesAParticleWithStokesDrift) {
  const double k = 0.15, omega = std::sqrt(kGravity * k), period = 2 * kPi / omega;
  for (const double amplitude : {0.1, 0.4}) {
    const WaveField wave({{omega, amplitude, 0, k}}, {1, 0}, 2, kNoCutoff);
    // Ten of the particle's own periods, which are longer than the wave's, since it drifts with the wave.
    double x = 0, t = 0;
    const double step = period / 4000;
    for (; omega * t - k * x < 20 * kPi; t += step) {
      const double half = x + 0.5 * step * wave.surface(x, 0, t).velocity.x();
      x += step * wave.surface(half, 0, t + 0.5 * step).velocity.x();
    }
    const double drift = x / t;
    const double stokes = amplitude * amplitude * omega * k;
    // The next order is (k a)^2 smaller; the last step's overshoot is a 40000th of the time, at the speed of a crest.
    const double overshoot = amplitude * omega * step / t;
    EXPECT_NEAR(drift, stokes, 3 * k * k * amplitude * amplitude * stokes + overshoot) << amplitude << " m";
  }
}

// The acceleration is that of the water particle: d/dt of the surface velocity along its path, up to terms of third
// order, which decrease eightfold when the waves are halved.
TEST(SurfaceAcceleration, IsTheRateOfTheVelocityOfTheMovingWater) {
  const auto residual = [](double scale, double depth, double spread) {
    std::vector<WaveComponent> waves = some_waves(depth, spread);
    for (WaveComponent& wave : waves) wave.amplitude *= scale;
    const WaveField field(waves, 2, kNoCutoff, depth);
    double sum = 0;
    for (int i = 0; i < 20; ++i) {
      const double x = 13.0 * i, y = -5.0 * i, t = 3.1 * i;
      constexpr double h = 1e-3;
      const SurfaceState here = field.surface(x, y, t);
      const auto velocity = [&](double steps) {
        return field.surface(x + steps * here.velocity.x() * h, y + steps * here.velocity.y() * h, t + steps * h)
            .velocity;
      };
      const Vec3 rate = (velocity(1) - velocity(-1)) / (2 * h);
      sum += (rate - here.acceleration).squaredNorm();
    }
    return std::sqrt(sum / 20);
  };
  for (const auto& [depth, spread] : {std::pair{kDeepWater, 0.0}, std::pair{kDeepWater, 1.0}, std::pair{12.0, 1.0}}) {
    EXPECT_NEAR(residual(1, depth, spread) / residual(0.5, depth, spread), 8, 0.4) << depth << " m, " << spread;
  }
}

TEST(Wavenumber, IsThatOfMhkit) {
  for (const std::vector<double>& row : read_reference("mhkit_dispersion.csv")) {
    // MHKiT's data are w(k) with its own g, 9.80665 or 9.81: compared in the digits that both have in common.
    EXPECT_NEAR(wavenumber_at(row[1], row[0]), row[2], 1e-3 * row[2]);
  }
}

TEST(Wavenumber, SolvesItsDispersionRelation) {
  EXPECT_EQ(wavenumber_at(0, 10), 0);
  EXPECT_EQ(wavenumber_at(2), 4 / kGravity);
  for (const double depth : {0.05, 1.0, 30.0, 4000.0}) {
    for (double omega = 1e-4; omega < 100; omega *= 1.7) {
      const double k = wavenumber_at(omega, depth);
      EXPECT_NEAR(kGravity * k * std::tanh(k * depth) / (omega * omega), 1, 4e-16 * 4) << omega << ", " << depth;
    }
  }
}

}  // namespace
}  // namespace seaglint
