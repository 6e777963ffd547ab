// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/look_directions.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/radiation/contribution.h"
#include "tests/measured.h"
#include "tests/sim/scattering/moving_radar.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_moving_radar;
using testing_echoes::RelativeError;

// The response of a body under a moving radar, whose direction and image in the sea change over the interval.

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
  RelativeError error;
  for (const int n : {0, 7, 15}) {
    const IntervalSampling one = only_pulse(sampling, n);
    const double t = sampling.pulse_time_s[n] - sampling.pulse_time_s.front();
    const Vec3 direction = (r_hat + t * sampling.line_of_sight_rate).normalized();
    const FrequencyResponse traced =
        interval_response(scatterer, at_rest, direction, Polarisation::kVv, one, {}).response;
    for (int b = 0; b < sampling.frequencies_per_pulse; ++b) error.add(passing.at(n, b), traced.at(0, b));
  }
  // -40 dB of the interval, as for a rotating body; without the change of direction the echo is a different one.
  EXPECT_LT(error.value(), 0.01);
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
    RelativeError error;
    for (const int n : {0, 7, 15}) {
      const IntervalSampling one = only_pulse(sampling, n);
      const Vec3 direction = direction_at(sampling, r_hat, static_cast<std::size_t>(n));
      const FrequencyResponse traced =
          interval_response(scatterer, body, direction, Polarisation::kHh, one, {}, 2, &sea).response;
      for (int b = 0; b < sampling.frequencies_per_pulse; ++b) error.add(passing.at(n, b), traced.at(0, b));
    }
    fmt::print("radar at {}, {}, {} m/s over the sea: {:.1f} dB\n", velocity.x(), velocity.y(), velocity.z(),
               error.db());
    EXPECT_LT(error.value(), 0.01) << velocity.x() << ' ' << velocity.y() << ' ' << velocity.z();
    best_db = std::min(best_db, error.db());
    worst_db = std::max(worst_db, error.db());
  }
  record_figure(worst_db, 1, "moving_radar_worst_db");
  record_figure(best_db, 1, "moving_radar_best_db");
}

// Paths of look directions: along-track and cross-track components, and the limit of the slide rate of a vertex.

// Directions s h + c s^2 v from r on, s from -reach to reach.
std::vector<Vec3> curved_path(const RadarBasis& basis, double reach, double c) {
  std::vector<Vec3> directions;
  for (int n = -8; n <= 8; ++n) {
    const double s = reach * n / 8;
    directions.push_back((basis.r + s * basis.h + c * s * s * basis.v).normalized());
  }
  return directions;
}

TEST(LookDirectionPath, MonostaticHasAlongTrackAndCrossTrackAxes) {
  const RadarBasis basis = radar_basis(Vec3(0.6, -0.7, 0.2).normalized());
  const double reach = 1e-3, c = 20;
  const LookDirectionPath path =
      look_direction_path(curved_path(basis, reach, c), curved_path(basis, reach, c), basis.r, basis.r);
  ASSERT_EQ(path.s.size(), 17u);
  // Both directions change equally, so that s is sqrt(2) times the change of each.
  EXPECT_NEAR(std::abs(path.s.front()), std::sqrt(2) * reach, 1e-8);
  EXPECT_NEAR(path.s_limit, std::sqrt(2) * reach, 1e-8);
  EXPECT_NEAR(std::abs(path.q.front()), std::sqrt(2) * c * reach * reach, 1e-8);
  EXPECT_NEAR(path.q[8], 0, 1e-15);
  EXPECT_NEAR(path.max_change, reach * std::sqrt(1 + c * c * reach * reach), 1e-8);
  EXPECT_NEAR(path.along_track.transmit.dot(basis.r), 0, 1e-12);
  EXPECT_NEAR(path.cross_track.transmit.dot(path.along_track.transmit), 0, 1e-12);
  // A body-fixed point's phase by both axes equals that by the directions: psi changes by 2 x . (r^ - r^_0).
  const Vec3 x(30, -5, 8);
  const PathGradient gradient{x, x};
  const std::vector<Vec3> directions = curved_path(basis, reach, c);
  for (std::size_t n = 0; n < directions.size(); ++n) {
    const Vec3 moved = directions[n] - basis.r;
    const double across = 2 * x.dot(moved - basis.r * basis.r.dot(moved));
    EXPECT_NEAR(path.s[n] * path.along_track.path_rate(gradient) + path.q[n] * path.cross_track.path_rate(gradient),
                across, 1e-12);
  }
}

TEST(LookDirectionPath, BistaticContainsTheCommonMotion) {
  const RadarBasis to = radar_basis(Vec3(0.9, 0.1, 0.3).normalized()),
                   from = radar_basis(Vec3(0.8, -0.4, -0.3).normalized());
  const double reach = 1e-3;
  const LookDirectionPath path =
      look_direction_path(curved_path(to, reach, 10), curved_path(from, 0.5 * reach, 40), to.r, from.r);
  const PathGradient gradient{Vec3(20, 4, 9), Vec3(-3, 11, 2)};
  const std::vector<Vec3> transmit = curved_path(to, reach, 10), receive = curved_path(from, 0.5 * reach, 40);
  for (std::size_t n = 0; n < transmit.size(); ++n) {
    const Vec3 t = transmit[n] - to.r, r = receive[n] - from.r;
    const double across =
        gradient.transmit.dot(t - to.r * to.r.dot(t)) + gradient.receive.dot(r - from.r * from.r.dot(r));
    // Both curves are proportional, so that one axis contains all of it; unit vectors add terms of third order.
    EXPECT_NEAR(path.s[n] * path.along_track.path_rate(gradient) + path.q[n] * path.cross_track.path_rate(gradient),
                across, 30 * 2e-9);
  }
}

TEST(LookDirectionPath, OfABodyAtRestHasNoCrossTrack) {
  const RadarBasis basis = radar_basis(Vec3(0, 0, 1));
  const std::vector<Vec3> still(5, basis.r);
  const LookDirectionPath path = look_direction_path(still, still, basis.r, basis.r);
  EXPECT_NEAR(path.along_track.transmit.norm(), 1, 1e-12);
  EXPECT_EQ(path.s_limit, 0);
  EXPECT_EQ(path.q_limit, 0);
  EXPECT_EQ(path.max_change, 0);
}

TEST(Footprint, LimitsTheSlideRateOfAVertex) {
  const RadarBasis basis = radar_basis(Vec3(1, 0, 0));
  Footprint footprint;
  footprint.plane = depth_plane(Vec3(0.8, 0.6, 0), 3, basis);
  footprint.w = Vec2(0.3, -0.2);
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) {
    const double z = footprint.plane.at(p);
    footprint.polygon.push_back({p, Vec2(-z, 0), Vec2(0, -z)});
  }
  footprint.polygon[1].d1 += Vec2(300, 0);
  footprint.polygon[1].d2 += Vec2(0, 400);
  footprint.polygon[2].d1 += Vec2(30, 40);
  const MovingPolygon before = footprint.polygon;
  limit_slide_rate(footprint, 100);
  const double z = footprint.plane.at(Vec2(1, 0));
  EXPECT_NEAR((footprint.polygon[1].d1 - Vec2(60 - z, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((footprint.polygon[1].d2 - Vec2(0, 80 - z)).norm(), 0, 1e-12);
  EXPECT_EQ(footprint.polygon[0].d1, before[0].d1);
  EXPECT_EQ(footprint.polygon[2].d1, before[2].d1);  // below the limit
}

}  // namespace
}  // namespace seaglint
