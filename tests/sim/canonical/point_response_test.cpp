// SPDX-License-Identifier: BSD-3-Clause
// Ideal points against CONVENTIONS.md, written out term by term.
#include "sim/canonical/point_response.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/observation/observation.h"
#include "tests/sim/scattering/moving_radar.h"

namespace seaglint {
namespace {

using namespace testing_moving_radar;

IntervalSampling two_pulses() {
  IntervalSampling sampling;
  sampling.first_hz = 15.99e9;
  sampling.step_hz = 0.7e6;
  sampling.count = 300;
  sampling.frequencies_per_pulse = 100;
  sampling.pulse_first = {0, 200};
  sampling.pulse_time_s = {7.0, 7.05};
  return sampling;
}

// 30,000 rad of phase carry 30,000 eps = 7e-12; the renewed products add 32 eps.
constexpr double kPhaseRounding = 2e-11;

TEST(PointResponse, APointNearerToTheRadarIsAdvancedInPhase) {
  const IntervalSampling sampling = two_pulses();
  const Vec3 r_hat = direction_to_radar(radians(0), radians(0));
  const PointSpec nearer{{3, 0, 0}, 2.5, {0, 0, 0}};
  const FrequencyResponse response = point_response({&nearer, 1}, r_hat, sampling);
  ASSERT_EQ(response.values.size(), 200u);
  for (int b = 0; b < 100; ++b) {
    const double k = 2 * kPi * (sampling.first_hz + (200 + b) * sampling.step_hz) / kSpeedOfLight;
    EXPECT_NEAR(std::abs(response.at(1, b) - std::polar(2.5, 2 * k * 3)), 0, 2.5 * kPhaseRounding);
  }
}

TEST(PointResponse, AVelocityAwayFromTheRadarDelaysLaterPulses) {
  const IntervalSampling sampling = two_pulses();
  const Vec3 r_hat = direction_to_radar(radians(90), radians(0));
  const PointSpec receding{{10, 0, 0}, 1, {0, -4, 0}};
  const FrequencyResponse response = point_response({&receding, 1}, r_hat, sampling);
  const double range_m = 4 * (7.05 - 7.0);
  for (int b = 0; b < 100; ++b) {
    EXPECT_NEAR(std::abs(response.at(0, b) - Complex(1)), 0, kPhaseRounding);
    const double f = sampling.first_hz + (200 + b) * sampling.step_hz;
    EXPECT_NEAR(std::abs(response.at(1, b) - std::polar(1.0, -4 * kPi * f * range_m / kSpeedOfLight)), 0,
                kPhaseRounding);
  }
}

TEST(PointResponse, AChirpReachesThePointAtTheTimeOfEachFrequency) {
  IntervalSampling sampling = two_pulses();
  sampling.chirp_rate_hz_s = 70e6 / 36e-6;
  const Vec3 r_hat = direction_to_radar(radians(180), radians(0));
  const PointSpec receding{{5, 0, 0}, 1, {12, 0, 0}};
  const FrequencyResponse response = point_response({&receding, 1}, r_hat, sampling);
  for (int n = 0; n < 2; ++n) {
    for (int b = 0; b < 100; ++b) {
      const double baseband = (b - 49.5) * sampling.step_hz;
      const double f = sampling.first_hz + (sampling.pulse_first[n] + b) * sampling.step_hz;
      const double range_m = 5 + 12 * (sampling.pulse_time_s[n] - 7.0 + baseband / sampling.chirp_rate_hz_s);
      EXPECT_NEAR(std::abs(response.at(n, b) - std::polar(1.0, -4 * kPi * f * range_m / kSpeedOfLight)), 0,
                  kPhaseRounding);
    }
  }
}

TEST(PointResponse, DirectionsAreCounterClockwiseFromTheBowAndUpwards) {
  EXPECT_NEAR((direction_to_radar(radians(0), radians(0)) - Vec3(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((direction_to_radar(radians(90), radians(0)) - Vec3(0, 1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((direction_to_radar(radians(30), radians(90)) - Vec3(0, 0, 1)).norm(), 0, 1e-15);
}

TEST(FrequencyResponse, AddsTermByTermAndRefusesOtherShapes) {
  FrequencyResponse a{1, 2, {Complex(1, 2), Complex(3, 4)}};
  const FrequencyResponse b{1, 2, {Complex(10, 0), Complex(0, 10)}};
  a += b;
  EXPECT_EQ(a.values[0], Complex(11, 2));
  EXPECT_EQ(a.values[1], Complex(3, 14));
  const FrequencyResponse other{2, 1, {Complex(), Complex()}};
  EXPECT_THROW(a += other, std::exception);
}

TEST(PointResponse, OverTheSeaIsTheProductOfTwoPaths) {
  PointSpec point;
  point.position_m = {3, -2, 4.5};
  point.amplitude_m = 2;
  IntervalSampling sampling;
  sampling.first_hz = 16e9;
  sampling.step_hz = 1e6;
  sampling.count = sampling.frequencies_per_pulse = 8;
  sampling.pulse_first = {0};
  sampling.pulse_time_s = {0};
  const Vec3 r = direction_to_radar(radians(20), radians(3)), x(3, -2, 4.5);
  const SeaReflection sea(SeaReflectionSpec{}, 0.5);
  const FrequencyResponse response = point_response_over_sea(std::array{point}, r, sampling, Polarisation::kHv, sea);
  for (int b = 0; b < 8; ++b) {
    const double k = 2 * kPi * (16e9 + 1e6 * b) / kSpeedOfLight;
    const SeaReflectionCoefficients rho = sea.at(k, r.z());
    const auto path = [&](const Complex& c) {
      return std::polar(1.0, k * r.dot(x)) + c * std::polar(1.0, k * image_direction(r).dot(x));
    };
    EXPECT_LT(std::abs(response.at(0, b) - 2.0 * path(rho.h) * path(rho.v)), 1e-9) << b;
  }
}

// A moving radar: the directions to it and to its image in the sea change with its relative motion.

TEST(PointResponse, HasTheRangeOfTheRadarsPath) {
  const IntervalSampling sampling = interval();
  const Vec3 r_hat = direction_to_radar(radians(30), radians(3));
  const Vec3 x(25, -40, 12);
  const PointSpec point{{x.x(), x.y(), x.z()}, 1, {0, 0, 0}};
  const FrequencyResponse response = point_response({&point, 1}, r_hat, sampling);
  const auto range_beyond_reference = [&](double t) {
    const Vec3 radar = kRange * r_hat + kVelocity * t;
    return (radar - x).norm() - radar.norm();
  };
  for (std::size_t n = 0; n < sampling.pulse_time_s.size(); ++n) {
    const double t = sampling.pulse_time_s[n] - sampling.pulse_time_s.front();
    const double k = 2 * kPi * (sampling.first_hz + 7 * sampling.step_hz) / kSpeedOfLight;
    const double moved_m = range_beyond_reference(t) - range_beyond_reference(0);
    const double phase = std::arg(response.at(static_cast<int>(n), 7) / response.at(0, 7));
    // Neglected: the change of the wavefront's curvature x^2 / (2 R) with the direction, below x^2 u t / R^2.
    const double curvature_m = x.squaredNorm() * kVelocity.norm() * t / (kRange * kRange);
    EXPECT_NEAR(std::remainder(phase + 2 * k * moved_m, 2 * kPi), 0, 2 * k * curvature_m + 1e-9);
    if (n > 8) {
      EXPECT_GT(std::abs(2 * k * moved_m), 0.5);
    }
  }
}

TEST(PointResponse, OverTheSeaHasFourPathsPerPulseDirection) {
  const Vec3 r_hat = direction_to_radar(radians(10), radians(5)), x(25, -40, 12), v(3, -2, 1);
  const PointSpec point{{x.x(), x.y(), x.z()}, 1, {v.x(), v.y(), v.z()}};
  const SeaReflection sea = rough_water();
  for (const Vec3& velocity : kVelocities) {
    const IntervalSampling sampling = over_the_sea(velocity);
    const FrequencyResponse response = point_response_over_sea({&point, 1}, r_hat, sampling, Polarisation::kHv, sea);
    double difference = 0, power = 0;
    for (std::size_t n = 0; n < sampling.pulse_time_s.size(); ++n) {
      const Vec3 r = direction_at(sampling, r_hat, n), image(r.x(), r.y(), -r.z());
      const Vec3 now = x + (sampling.pulse_time_s[n] - sampling.pulse_time_s.front()) * v;
      for (int b = 0; b < sampling.frequencies_per_pulse; ++b) {
        const double k = 2 * kPi * (sampling.first_hz + b * sampling.step_hz) / kSpeedOfLight;
        const SeaReflectionCoefficients rho = sea.at(k, r.z());
        const auto path = [&](const Complex& c) {
          return std::polar(1.0, k * r.dot(now)) + c * std::polar(1.0, k * image.dot(now));
        };
        const Complex four = path(rho.h) * path(rho.v);
        difference += std::norm(response.at(static_cast<int>(n), b) - four);
        power += std::norm(four);
      }
    }
    // Rounding of directions (1e-16) times phases of 2 k |x|, 3e4 rad.
    EXPECT_LT(std::sqrt(difference / power), 1e-10) << velocity.x() << ' ' << velocity.y() << ' ' << velocity.z();
  }
}

}  // namespace
}  // namespace seaglint
