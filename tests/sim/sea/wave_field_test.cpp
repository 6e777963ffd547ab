// SPDX-License-Identifier: BSD-3-Clause
// The surface as a sum of waves, and the second-order interactions of all pairs.
#include "sim/sea/wave_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/sea/realisation.h"
#include "sim/sea/second_order.h"
#include "tests/sim/sea/double_sum.h"
#include "tests/sim/sea/reference_table.h"

namespace seaglint {
namespace {

constexpr double kNoCutoff = std::numeric_limits<double>::infinity();

SeaState sea_of(double height, double period) {
  SeaState state;
  state.significant_wave_height_m = height;
  state.peak_period_s = period;
  state.propagation_rad = radians(120);
  state.cutoff_rad_s = 0;
  state.second_order_cutoff_rad_s = 0;
  return state;
}

WaveField regular_wave(double amplitude, double wavenumber, const Vec2& direction, int order) {
  return WaveField({{std::sqrt(kGravity * wavenumber), amplitude, 0, wavenumber, direction}}, order, kNoCutoff);
}

class WafoSeries : public testing::TestWithParam<std::string> {};

TEST_P(WafoSeries, IsReproducedToSecondOrder) {
  std::vector<WaveComponent> components;
  for (const std::vector<double>& row : read_reference("wafo_nl_" + GetParam() + "_deep_components.csv"))
    components.push_back({row[0], row[1], row[2], row[3]});
  const WaveField field(components, 2, kNoCutoff);
  // The files hold 12 significant digits of amplitudes and phases.
  for (const std::vector<double>& row : read_reference("wafo_nl_" + GetParam() + "_deep_series.csv")) {
    const SurfaceState surface = field.surface(0, 0, row[0]);
    ASSERT_NEAR(surface.elevation_linear, row[1], 1e-9) << row[0] << " s";
    ASSERT_NEAR(surface.elevation - surface.elevation_linear, row[2] + row[3], 1e-9) << row[0] << " s";
  }
}
INSTANTIATE_TEST_SUITE_P(Deep, WafoSeries, testing::Values("Hs1_Tp5", "Hs2_Tp7"));

TEST(WaveField, IsAStokesWaveOfSecondOrderForOneComponent) {
  for (const std::vector<double>& row : read_reference("raschii_stokes2_deep.csv")) {
    const double height = row[2], length = row[4], x = row[5], eta = row[6];
    const WaveField wave = regular_wave(0.5 * height, 2 * kPi / length, {1, 0}, 2);
    // The table has twelve digits: half a unit of the last one of 1.04 m.
    EXPECT_NEAR(wave.surface(x, 0, 0).elevation, eta, 5e-12 * std::max(1.0, height))
        << "H " << height << " m, x " << x << " m";
  }
}

// The same sums written as the pairs of Sharma and Dean (1981), with their general kernels in very deep water.
double sharma_dean_elevation(const std::vector<WaveComponent>& components, double xi, double t) {
  double eta = 0;
  for (const WaveComponent& a : components) {
    for (const WaveComponent& b : components) {
      const double ra = a.wavenumber, rb = b.wavenumber;  // R = k tanh(k h) = k
      const double kk = ra * rb;                          // k_i . k_j, one direction
      const double theta_a = a.omega * t - a.wavenumber * xi + a.phase;
      const double theta_b = b.omega * t - b.wavenumber * xi + b.phase, root = std::sqrt(ra * rb);
      // In deep water with one direction D+ and D- vanish: every factor k^2 - R^2 and k_i.k_j -+ R_i R_j of D+ is zero,
      // and D- is 4 (sqrt R_i - sqrt R_j)^2 R_i R_j / {(sqrt R_i - sqrt R_j)^2 - |k_i - k_j|}.
      const double difference = std::sqrt(ra) - std::sqrt(rb);
      const double denominator = difference * difference - std::abs(ra - rb);
      const double d_minus = &a == &b ? 0 : 2 * difference * difference * (kk + ra * rb) / denominator;
      const double b_plus = 0.25 * ((-kk + ra * rb) / root + ra + rb);
      const double b_minus = 0.25 * ((d_minus - kk - ra * rb) / root + ra + rb);
      eta += a.amplitude * b.amplitude * b_plus * std::cos(theta_a + theta_b);
      if (&a != &b) eta += a.amplitude * b.amplitude * b_minus * std::cos(theta_a - theta_b);
    }
  }
  return eta;
}

TEST(WaveField, EqualsTheDoubleSumOfSharmaAndDean) {
  SeaState state = sea_of(2, 6);
  state.components = 60;
  state.second_order_cutoff_rad_s = 1000;
  const WaveField field = realise_sea(state, 3, 1);
  for (const double t : {0.0, 17.3, 211.0}) {
    const SurfaceState surface = field.surface(12, -7, t);
    const double xi = 12 * std::cos(radians(120)) - 7 * std::sin(radians(120));
    EXPECT_NEAR(surface.elevation - surface.elevation_linear, sharma_dean_elevation(field.components(), xi, t), 1e-12);
  }
}

TEST(WaveField, SlopesAreTheDerivativesOfItsElevation) {
  const WaveField field = realise_sea(sea_of(1, 5), 42, 0);
  constexpr double kStep = 1e-3;  // central difference: error step^2/6 times the third derivative, about 1e-6 of k^3 a
  for (int i = 0; i < 50; ++i) {
    const double x = 7.1 * i, y = -3.7 * i, t = 1.9 * i;
    const double dx =
        (field.surface(x + kStep, y, t).elevation - field.surface(x - kStep, y, t).elevation) / (2 * kStep);
    const double dy =
        (field.surface(x, y + kStep, t).elevation - field.surface(x, y - kStep, t).elevation) / (2 * kStep);
    const SurfaceState surface = field.surface(x, y, t);
    EXPECT_NEAR(surface.slope_x, dx, 2e-6);
    EXPECT_NEAR(surface.slope_y, dy, 2e-6);
  }
}

TEST(WaveField, WavesTravelTowardsTheirDirection) {
  const double k = 0.1, celerity = std::sqrt(kGravity / k);
  const WaveField wave = regular_wave(1, k, {0, 1}, 2);
  EXPECT_NEAR(wave.surface(0, 0, 0).elevation, wave.surface(0, 3 * celerity, 3).elevation, 1e-12);
  EXPECT_NEAR(wave.surface(-55, 0, 1).elevation, wave.surface(20, 0, 1).elevation, 1e-12);
}

TEST(WaveField, OrbitalVelocityIsThatOfLinearTheory) {
  const double amplitude = 0.5, k = 0.2, omega = std::sqrt(kGravity * k);
  const WaveField wave = regular_wave(amplitude, k, {0.6, 0.8}, 1);
  // Under a crest water moves with the wave, a quarter of a period earlier it rises.
  const Vec3 crest = wave.surface(0, 0, 0).velocity;
  EXPECT_NEAR((crest - amplitude * omega * Vec3(0.6, 0.8, 0)).norm(), 0, 1e-12);
  const Vec3 rising = wave.surface(0, 0, -0.25 * 2 * kPi / omega).velocity;
  EXPECT_NEAR((rising - Vec3(0, 0, amplitude * omega)).norm(), 0, 1e-12);
}

TEST(WaveField, VerticalVelocityIsTheRateOfTheLinearElevation) {
  SeaState state = sea_of(1, 6);
  state.order = 1;
  const WaveField field = realise_sea(state, 1, 2);
  constexpr double kStep = 1e-4;
  for (const double t : {0.0, 3.3, 50.0}) {
    const double rate =
        (field.surface(3, 4, t + kStep).elevation_linear - field.surface(3, 4, t - kStep).elevation_linear);
    EXPECT_NEAR(field.surface(3, 4, t).velocity.z(), rate / (2 * kStep), 1e-6);
  }
}

TEST(WaveField, ComponentsAboveTheSecondOrderCutoffStayLinear) {
  SeaState state = sea_of(2, 6.5);
  const WaveField field = realise_sea(state, 5, 0);
  const WaveComponent& last = field.components()[field.second_order_count() - 1];
  const WaveComponent& next = field.components()[field.second_order_count()];
  EXPECT_LE(last.omega, std::sqrt(2 * kGravity / 2));
  EXPECT_GT(next.omega, std::sqrt(2 * kGravity / 2));
  std::vector<WaveComponent> low(field.components().begin(),
                                 field.components().begin() + static_cast<std::ptrdiff_t>(field.second_order_count()));
  const WaveField quadratic(low, 2, kNoCutoff);
  const SurfaceState all = field.surface(1, 2, 3);
  const SurfaceState part = quadratic.surface(1, 2, 3);
  EXPECT_NEAR(all.elevation - all.elevation_linear, part.elevation - part.elevation_linear, 1e-14);
}

// RMS of the second-order slope at Hs 2 m, Tp 5.6 s: 0.034 at the default limit, unbounded growth when it is 8 rad/s.
TEST(WaveField, SecondOrderSlopeStaysSmallAtTheDefaultCutoff) {
  const auto second_order_slope = [](double cutoff) {
    SeaState state = sea_of(2, 5.6);
    state.second_order_cutoff_rad_s = cutoff;
    double sum = 0;
    constexpr int kSeeds = 20, kTimes = 100;
    for (int seed = 0; seed < kSeeds; ++seed) {
      const WaveField second = realise_sea(state, static_cast<std::uint64_t>(seed), 0);
      const WaveField first(second.components(), 1, 0);
      for (int i = 0; i < kTimes; ++i) {
        const SurfaceState a = second.surface(0, 0, 3.1 * i), b = first.surface(0, 0, 3.1 * i);
        sum += std::pow(std::hypot(a.slope_x - b.slope_x, a.slope_y - b.slope_y), 2);
      }
    }
    return std::sqrt(sum / (kSeeds * kTimes));
  };
  EXPECT_NEAR(second_order_slope(0), 0.034, 0.004);
  EXPECT_GT(second_order_slope(8), 4 * 0.034);
}

TEST(SurfaceSeries, EqualsTheSurfaceAtItsPoint) {
  const WaveField field = realise_sea(sea_of(2, 8), 42, 7);
  SurfaceSeries series(field, 30, -20, -60, 0.01);
  for (int i = 0; i < 5000; ++i, series.advance()) {
    const SurfaceState expected = field.surface(30, -20, -60 + 0.01 * i);
    const SurfaceState state = series.state();
    // 64 rotations of two roundings each, 2e-14 per phasor, summed over 512 of them; angles of 500 rad add 1e-13.
    ASSERT_NEAR(state.elevation, expected.elevation, 1e-12 * 2);
    ASSERT_NEAR(state.elevation_linear, expected.elevation_linear, 1e-12 * 2);
    ASSERT_NEAR(state.slope_x, expected.slope_x, 1e-12);
    ASSERT_NEAR(state.slope_y, expected.slope_y, 1e-12);
    ASSERT_NEAR((state.velocity - expected.velocity).norm(), 0, 1e-11);
  }
}

TEST(SurfaceSeries, EqualsTheSurfaceAlongALine) {
  SeaState spread = sea_of(2, 8);
  spread.spreading.kind = Spreading::kCos2s;
  spread.components = 64;
  for (const SeaState& state : {sea_of(2, 8), spread}) {
    const WaveField field = realise_sea(state, 42, 7);
    SurfaceSeries line = SurfaceSeries::along_line(field, {300, -20}, {-0.15, 0.08}, 1234.5);
    for (int i = 0; i < 500; ++i, line.advance()) {
      const SurfaceState expected = field.surface(300 - 0.15 * i, -20 + 0.08 * i, 1234.5), at = line.state();
      ASSERT_NEAR(at.elevation, expected.elevation, 1e-11);
      ASSERT_NEAR(at.slope_x, expected.slope_x, 1e-11);
      ASSERT_NEAR(at.slope_y, expected.slope_y, 1e-11);
    }
  }
}

// Far from the origin a short wave has more phase than unit_phasors accepts; whole cycles are removed.
TEST(WaveField, IsAccurateFarFromTheOrigin) {
  const WaveComponent wave{100, 0.01, 0.3, 100 * 100 / kGravity, Vec2(1, 0)};
  const WaveField field({wave}, 1, 0);
  const double x = -5e6, t = 7, angle = std::fmod(wave.omega * t - wave.wavenumber * x + wave.phase, 2 * kPi);
  // The rounding of 5e9 rad and of 8e8 times 2 pi.
  const double tolerance = 0.01 * 2e-6;
  EXPECT_NEAR(field.surface(x, 0, t, SurfaceQuantities::kElevationAndSlope).elevation, 0.01 * std::cos(angle),
              tolerance);
  SurfaceSeries series(field, x, 0, t, 0.01, SurfaceQuantities::kElevationAndSlope);
  EXPECT_NEAR(series.state().elevation, 0.01 * std::cos(angle), tolerance);
  // A position at which the rounding of a phase is a fraction of a cycle is an error.
  EXPECT_THROW(field.surface(1e12, 0, t), std::logic_error);
}

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
      const WaveField wave({{omega, 0.5 * height, 0, k}}, 2, kNoCutoff, depth);
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
    const WaveField wave({{omega, amplitude, 0, k}}, 2, kNoCutoff);
    // Ten of the particle's own periods, which are longer than the wave's, since it drifts with the wave.
    double x = 0, t = 0;
    const double step = period / 4000;
    for (; omega * t - k * x < 20 * kPi; t += step) {
      const double half = x + 0.5 * step * wave.surface(x, 0, t).velocity.x();
      x += step * wave.surface(half, 0, t + 0.5 * step).velocity.x();
    }
    const double drift = x / t, stokes = amplitude * amplitude * omega * k;
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
  for (const auto& [depth, spread] : {std::pair{kDeepWater, 0.0}, std::pair{kDeepWater, 1.0}, std::pair{12.0, 1.0}})
    EXPECT_NEAR(residual(1, depth, spread) / residual(0.5, depth, spread), 8, 0.4) << depth << " m, " << spread;
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
