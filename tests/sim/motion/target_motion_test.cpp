// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/target_motion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "sim/sea/realisation.h"

namespace seaglint {
namespace {

const Bounds kReflector{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};

TargetSpec array_of(int count) {
  TargetSpec target;
  target.layout = LayoutSpec{.line = LineLayout{count, 40}};
  target.motion.model = MotionModel::kFloat;
  return target;
}

Body body_of(const TargetSpec& target) { return make_body(target.motion, {kReflector, {}}); }

// With one motion model for all bodies.
std::vector<Trajectory> simulate(const TargetSpec& target, const Body& body, const SeaState& state,
                                 const WaveField& sea, double duration_s, std::uint64_t seed, std::uint64_t index,
                                 std::size_t first_body = 0, int threads = 1) {
  return simulate_target({target, std::array{&body}, state, sea, duration_s, seed, index, first_body, threads});
}

SeaState state_of(double height, double period) {
  SeaState state;
  state.significant_wave_height_m = height;
  state.peak_period_s = period;
  state.propagation_rad = 2;
  return state;
}

TEST(LayoutPositions, AreCentredOnTheOriginAlongX) {
  const std::vector<Vec2> places = layout_positions(array_of(4).layout);
  ASSERT_EQ(places.size(), 4u);
  EXPECT_EQ(places[0], Vec2(-60, 0));
  EXPECT_EQ(places[3], Vec2(60, 0));
  EXPECT_EQ(layout_positions(TargetSpec{}.layout), std::vector<Vec2>{Vec2(0, 0)});
}

TEST(SimulateTarget, MovesEachBodyAtItsOwnPlaceInTheSameSea) {
  const SeaState state = state_of(1, 5);
  const WaveField sea = realise_sea(state, 42, 7);
  const std::vector<Trajectory> bodies = simulate(array_of(4), body_of(array_of(4)), state, sea, 3, 42, 7, 0, 2);
  ASSERT_EQ(bodies.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Pose pose = bodies[i].pose(2.5);
    // The centre of flotation is at rest.
    EXPECT_NEAR((pose.R * Vec3(0, 0, -0.75) + pose.p - Vec3(-60 + 40.0 * static_cast<double>(i), 0, 0)).norm(), 0,
                1e-12);
  }
  EXPECT_GT((bodies[0].sample(2).angles - bodies[1].sample(2).angles).norm(), 1e-3);
}

TEST(SimulateTarget, DoesNotDependOnThreads) {
  const SeaState state = state_of(1, 5);
  const WaveField sea = realise_sea(state, 42, 7);
  const auto one = simulate(array_of(3), body_of(array_of(3)), state, sea, 2, 42, 7, 0, 1);
  const auto two = simulate(array_of(3), body_of(array_of(3)), state, sea, 2, 42, 7, 0, 2);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(one[i].sample(1.7).angles, two[i].sample(1.7).angles);
}

// In waves of hundreds of metres adjacent floats move alike, unless each has an independent sea.
TEST(SimulateTarget, IndependentBodiesHaveSeparateSeas) {
  const SeaState state = state_of(1, 20);
  SeaState long_waves = state;
  long_waves.cutoff_rad_s = 0.7;
  const WaveField sea = realise_sea(long_waves, 42, 7);
  TargetSpec target = array_of(2);
  target.layout->line->spacing_m = 1;
  const auto difference = [&] {
    const auto bodies = simulate(target, body_of(target), long_waves, sea, 30, 42, 7);
    double sum = 0;
    for (double t = 0; t <= 30; t += 1) sum += (bodies[0].sample(t).angles - bodies[1].sample(t).angles).norm();
    double size = 0;
    for (double t = 0; t <= 30; t += 1) size += bodies[0].sample(t).angles.norm();
    return sum / size;
  };
  EXPECT_LT(difference(), 0.1);
  target.motion.waves = WaveSharing::kIndependent;
  EXPECT_GT(difference(), 0.5);
}

// A raft that turns about a point of its own carries its reflectors along: p_i = c + R (s_i - c).
TEST(SimulateTarget, CarriesTheReflectorsOfARaftOnALever) {
  TargetSpec target = array_of(3);
  target.layout->bodies = LayoutBodies::kRigid;
  target.layout->line->centre_x_m = 7;
  target.layout->line->centre_y_m = -2;
  target.motion.diameter_m = 5;
  target.motion.rotation_centre_m = {1, 2, 3};
  target.motion.origin_above_waterline_m = 4;
  const SeaState state = state_of(1, 5);
  const WaveField sea = realise_sea(state, 42, 7);
  const Body raft = make_body(target.motion, {.box = {}, .hull = {}, .is_raft = true});
  const std::vector<Trajectory> bodies = simulate(target, raft, state, sea, 3, 42, 7);
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_GT(bodies[0].sample(2.5).angles.norm(), 1e-3);
  for (int i = 0; i < 3; ++i) {
    const Vec3 s(40.0 * (i - 1), 0, 4), c(1, 2, 3), origin(7, -2, 0);
    const Trajectory& body = bodies[static_cast<std::size_t>(i)];
    EXPECT_EQ(body.sample(2.5).angles, bodies[0].sample(2.5).angles);
    const Mat3 R = body.pose(2.5).R;
    EXPECT_LT((body.pose(2.5).p - (origin + c + R * (s - c))).norm(), 1e-12);
  }
}

// A mast of height h on a float: p = c + R (s - c) with the float's own rotation, its axes turned by the heading.
TEST(SimulateTarget, CarriesAFreeBodyAtItsHeightAndHeading) {
  TargetSpec target = array_of(3);
  const SeaState state = state_of(1, 5);
  const WaveField sea = realise_sea(state, 42, 7);
  const Body body = body_of(target);
  const std::vector<Trajectory> low = simulate(target, body, state, sea, 3, 42, 7);
  target.layout->heights_m = BodyRange{5, 19};
  target.layout->headings_deg = BodyRange{30, 60};
  const std::vector<Trajectory> high = simulate(target, body, state, sea, 3, 42, 7);
  const std::vector<double> heights_m = body_heights_m(target.layout), headings = body_headings_rad(target.layout);
  const std::vector<Vec3> rests = rest_positions(target);
  for (std::size_t i = 0; i < 3; ++i) {
    const Pose foot = low[i].pose(2.5), top = high[i].pose(2.5);
    EXPECT_LT((top.p - foot * Vec3(0, 0, heights_m[i])).norm(), 1e-12);
    EXPECT_LT((top.R - foot.R * rotation_from_angles(0, 0, headings[i])).norm(), 1e-12);
    EXPECT_EQ(high[i].sample(2.5).angles, low[i].sample(2.5).angles);
    EXPECT_NEAR(rests[i].z(), 0.75 + heights_m[i], 1e-12);
  }
}

// Leeway of 3 % of 10 m/s towards 90 deg, and a current of 0.5 m/s towards 180 deg.
TEST(DriftVelocities, AreLeewayCurrentAndADeviationOfEachBody) {
  TargetSpec target = array_of(1000);
  EXPECT_EQ(drift_velocities_mps(target, 1, 0, 0), std::vector<Vec3>(1000, Vec3::Zero()));
  target.motion.drift =
      DriftSpec{.wind_mps = 10, .wind_towards_deg = 90, .current_mps = 0.5, .current_towards_deg = 180};
  EXPECT_LT((mean_drift_mps(target.motion) - Vec3(-0.5, 0.3, 0)).norm(), 1e-12);
  EXPECT_LT((current_mps(target.motion) - Vec3(-0.5, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(drift_velocities_mps(target, 1, 0, 0), std::vector<Vec3>(1000, mean_drift_mps(target.motion)));
  target.motion.drift->spread_mps = 0.1;
  const std::vector<Vec3> each = drift_velocities_mps(target, 1, 0, 0);
  Vec3 sum = Vec3::Zero();
  double squares = 0, product = 0;
  for (const Vec3& velocity : each) {
    const Vec3 own = (velocity - mean_drift_mps(target.motion)) / 0.1;
    sum += own;
    squares += own.squaredNorm();
    product += own.x() * own.y();
    EXPECT_EQ(velocity.z(), 0);
  }
  // Five standard errors.
  EXPECT_LT(sum.norm() / 1000, 5 * std::sqrt(2 / 1000.0));
  EXPECT_NEAR(squares / 2000, 1, 5 * std::sqrt(2 / 2000.0));
  EXPECT_NEAR(product / 1000, 0, 5 * std::sqrt(1 / 1000.0));
  EXPECT_EQ(drift_velocities_mps(target, 1, 0, 0), each);
  EXPECT_NE(drift_velocities_mps(target, 1, 1, 0), each);
  EXPECT_NE(drift_velocities_mps(target, 2, 0, 0), each);
  EXPECT_EQ(drift_velocities_mps(target, 1, 0, 3)[0], each[3]);
  target.layout->bodies = LayoutBodies::kRigid;
  EXPECT_EQ(drift_velocities_mps(target, 1, 0, 0), std::vector<Vec3>(1000, each[0]));
}

TEST(BodyIndex, IsUniqueAmongRealisations) {
  EXPECT_EQ(body_index(3, 0), body_index(2, 65535) + 1);
  EXPECT_THROW(body_index(0, 65536), std::logic_error);
}

}  // namespace
}  // namespace seaglint
