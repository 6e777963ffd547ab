// SPDX-License-Identifier: BSD-3-Clause
// Ideal points against CONVENTIONS.md, written out term by term.
#include "sim/scattering/solver/point_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {
namespace {

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

}  // namespace
}  // namespace seaglint
