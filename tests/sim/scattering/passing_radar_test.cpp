// SPDX-License-Identifier: BSD-3-Clause
// A radar that passes by: the scene turns as the geometry of its way demands.
#include "sim/scattering/passing_radar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/constants.h"
#include "sim/geometry/generators.h"
#include "sim/scattering/point_response.h"
#include "sim/scattering/respond.h"

namespace seaglint {
namespace {

constexpr double kRange = 20e3;
const Vec3 kVelocity(40, 220, -15);  // an aircraft that passes

IntervalSampling interval() {
  IntervalSampling sampling;
  sampling.first_hz = 16e9;
  sampling.step_hz = 5e6;
  sampling.count = 40;
  sampling.per_pulse = 40;
  for (int n = 0; n < 16; ++n) {
    sampling.pulse_first.push_back(0);
    sampling.pulse_time_s.push_back(3 + 4e-3 * n);
  }
  sampling.sight_rate = kVelocity / kRange;
  return sampling;
}

TEST(PassingRadar, PointsChangeTheirRangeAsTheWayDemands) {
  const IntervalSampling sampling = interval();
  const Vec3 r_hat = direction_to_radar({radians(30), radians(3)});
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
    // Neglected: how the wavefront's curvature x^2 / (2 R) changes with the direction, below x^2 u t / R^2.
    const double curvature_m = x.squaredNorm() * kVelocity.norm() * t / (kRange * kRange);
    EXPECT_NEAR(std::remainder(phase + 2 * k * moved_m, 2 * kPi), 0, 2 * k * curvature_m + 1e-9);
    if (n > 8) {
      EXPECT_GT(std::abs(2 * k * moved_m), 0.5);
    }
  }
}

TEST(PassingRadar, BodiesAnswerAsFromTheDirectionsOfItsWay) {
  const Scatterer scatterer(make_icosahedral_reflector(1.0));
  const Trajectory still = Trajectory::at_rest(Vec3(15, 30, 0.75));
  IntervalSampling sampling = interval();
  sampling.sight_rate *= 5;  // 4 km away
  const Vec3 r_hat = direction_to_radar({radians(70), radians(2)});
  const FrequencyResponse passing = respond(scatterer, still, r_hat, Polarisation::kVv, sampling, {}).response;
  double difference = 0, power = 0;
  for (const int n : {0, 7, 15}) {
    IntervalSampling one = sampling;
    one.pulse_first = {0};
    one.pulse_time_s = {sampling.pulse_time_s[n]};
    one.sight_rate = Vec3::Zero();
    const double t = sampling.pulse_time_s[n] - sampling.pulse_time_s.front();
    const Vec3 direction = (r_hat + t * sampling.sight_rate).normalized();
    const FrequencyResponse fresh = respond(scatterer, still, direction, Polarisation::kVv, one, {}).response;
    for (int b = 0; b < sampling.per_pulse; ++b) {
      difference += std::norm(passing.at(n, b) - fresh.at(0, b));
      power += std::norm(fresh.at(0, b));
    }
  }
  // -40 dB of the interval, as for a body that turns itself; without the turn it is another echo.
  EXPECT_LT(std::sqrt(difference / power), 0.01);
}

}  // namespace
}  // namespace seaglint
