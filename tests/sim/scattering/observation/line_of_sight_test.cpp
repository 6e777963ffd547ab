// SPDX-License-Identifier: BSD-3-Clause
// The response of a body under a moving radar, whose direction and image in the sea change over the interval.
#include "sim/scattering/observation/look_directions.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/observation.h"
#include "tests/measured.h"
#include "tests/sim/scattering/moving_radar.h"
#include "tests/sim/scattering/solve_calls.h"

namespace seaglint {
namespace {

using namespace testing_moving_radar;

// A single pulse from the position of the radar at that time.
IntervalSampling only_pulse(const IntervalSampling& sampling, int pulse) {
  IntervalSampling one = sampling;
  one.pulse_first = {0};
  one.pulse_time_s = {sampling.pulse_time_s[pulse]};
  one.line_of_sight_rate = Vec3::Zero();
  return one;
}

TEST(MovingRadar, IntervalResultMatchesPerPulseDirections) {
  const Scatterer scatterer(make_icosahedral_reflector(1.0));
  const Trajectory at_rest = Trajectory::at_rest(Vec3(15, 30, 0.75));
  IntervalSampling sampling = interval();
  sampling.line_of_sight_rate *= 5;  // at 4 km
  const Vec3 r_hat = direction_to_radar(radians(70), radians(2));
  const FrequencyResponse passing =
      interval_response(scatterer, at_rest, r_hat, Polarisation::kVv, sampling, {}).response;
  double difference = 0, power = 0;
  for (const int n : {0, 7, 15}) {
    const IntervalSampling one = only_pulse(sampling, n);
    const double t = sampling.pulse_time_s[n] - sampling.pulse_time_s.front();
    const Vec3 direction = (r_hat + t * sampling.line_of_sight_rate).normalized();
    const FrequencyResponse traced =
        interval_response(scatterer, at_rest, direction, Polarisation::kVv, one, {}).response;
    for (int b = 0; b < sampling.frequencies_per_pulse; ++b) {
      difference += std::norm(passing.at(n, b) - traced.at(0, b));
      power += std::norm(traced.at(0, b));
    }
  }
  // -40 dB of the interval, as for a rotating body; without the change of direction the echo is a different one.
  EXPECT_LT(std::sqrt(difference / power), 0.01);
}

TEST(MovingRadar, IntervalResultOverTheSeaMatchesPerPulseDirections) {
  const Scatterer scatterer(make_icosahedral_reflector(1.0));
  // With a small rotation and heave, off the reference point.
  MotionSample first, last;
  first.angle_rates = last.angle_rates = {0.1, -0.05, 0.02};
  first.translation_rates = last.translation_rates = {0, 0, 0.4};
  last.angles = first.angle_rates;
  last.translation = first.translation_rates;
  const Trajectory body(3, 1, {first, last}, Vec3(15, 30, 4), Vec3::Zero());
  const Vec3 r_hat = direction_to_radar(radians(70), radians(5));
  const SeaReflection sea = rough_water();
  double best_db = 0, worst_db = -1000;
  for (const Vec3& velocity : kVelocities) {
    const IntervalSampling sampling = over_the_sea(velocity);
    const FrequencyResponse passing =
        interval_response(scatterer, body, r_hat, Polarisation::kHh, sampling, {}, 2, &sea).response;
    double difference = 0, power = 0;
    for (const int n : {0, 7, 15}) {
      const IntervalSampling one = only_pulse(sampling, n);
      const Vec3 direction = direction_at(sampling, r_hat, static_cast<std::size_t>(n));
      const FrequencyResponse traced =
          interval_response(scatterer, body, direction, Polarisation::kHh, one, {}, 2, &sea).response;
      for (int b = 0; b < sampling.frequencies_per_pulse; ++b) {
        difference += std::norm(passing.at(n, b) - traced.at(0, b));
        power += std::norm(traced.at(0, b));
      }
    }
    fmt::print("radar at {}, {}, {} m/s over the sea: {:.1f} dB\n", velocity.x(), velocity.y(), velocity.z(),
               10 * std::log10(difference / power));
    EXPECT_LT(std::sqrt(difference / power), 0.01) << velocity.x() << ' ' << velocity.y() << ' ' << velocity.z();
    best_db = std::min(best_db, 10 * std::log10(difference / power));
    worst_db = std::max(worst_db, 10 * std::log10(difference / power));
  }
  record_figure(worst_db, 1, "moving_radar_worst_db");
  record_figure(best_db, 1, "moving_radar_best_db");
}

}  // namespace
}  // namespace seaglint
