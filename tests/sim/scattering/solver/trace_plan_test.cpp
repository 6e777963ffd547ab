// SPDX-License-Identifier: BSD-3-Clause
// Traced look directions over an interval: their interpolation weights and their number.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/solver/trace_plan.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

const std::vector<PropagationPath> kDirect{PropagationPath{}};

// Pitch and yaw by `angle` rad about their means along a circle, once in period_s: directions ahead follow a circle.
Trajectory circling(double angle, double period_s) {
  const double omega = 2 * kPi / period_s, step = 0.001;
  std::vector<MotionSample> samples(1000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double phase = omega * step * static_cast<double>(i);
    samples[i].angles = Vec3(0, angle * std::sin(phase), angle * std::cos(phase));
    samples[i].angle_rates = omega * angle * Vec3(0, std::cos(phase), -std::sin(phase));
  }
  return Trajectory(0, step, samples, Vec3::Zero(), Vec3::Zero());
}

void expect_weights_sum_to_one(const TracePlan& plan, int pulses) {
  for (int n = 0; n < pulses; ++n) {
    double sum = 0;
    for (std::size_t i = 0; i < plan.traces().size(); ++i) {
      const PlannedTrace& trace = plan.traces()[i];
      const double weight = plan.interpolation_weight(i, n);
      sum += weight;
      EXPECT_EQ(weight > 0, trace.first <= n && n <= trace.last) << "trace " << i << ", pulse " << n;
    }
    EXPECT_NEAR(sum, 1, 1e-12) << "pulse " << n;
  }
}

// From the positions, and along its own direction, which changes as the body drifts.
TEST(TracePlan, HasTheDirectionsOfABodyOffTheReferencePoint) {
  const Vec3 r = direction(30, 2), rest(-40, 45, 3), velocity(0, 10, 0);
  const double range_m = 1000;
  const IntervalSampling sampling = paper_interval(0.2);
  const TracePlan plan({Trajectory::at_rest(rest).with_drift(velocity, 0.2), sampling, r, range_m}, kDirect,
                       {1e-4, 1e-6});
  EXPECT_GT(plan.traces().size(), 1u);
  for (const int pulse : {0, 100, 255}) {
    const Vec3 x = rest + (sampling.pulse_time_s[static_cast<std::size_t>(pulse)] - 0.2) * velocity;
    EXPECT_NEAR(plan.path_advance(kDirect[0], pulse), 2 * (range_m - (range_m * r - x).norm()), 1e-12 * range_m);
  }
  const Vec3 middle = rest + 0.5 * (sampling.pulse_time_s.back() - 0.2) * velocity;
  const TracePlan still({Trajectory::at_rest(middle), sampling, r, range_m}, kDirect, {1, 1});
  const RadarBasis& traced = still.traces()[0].paths[0].geometry.transmit;
  EXPECT_LT((traced.r - (range_m * r - middle).normalized()).norm(), 1e-12);
  EXPECT_NEAR(traced.h.dot(traced.r), 0, 1e-12);
  EXPECT_LT((traced.r.cross(traced.h) - traced.v).norm(), 1e-12);
}

TEST(TracePlan, OfABodyAtRestIsOneTrace) {
  const TracePlan plan({Trajectory::at_rest(Vec3(1, 2, 3)), paper_interval(0.2), direction(30, 2), 0}, kDirect,
                       {1e-3, 1e-6});
  ASSERT_EQ(plan.traces().size(), 1u);
  EXPECT_EQ(plan.traces()[0].last, 255);
  EXPECT_DOUBLE_EQ(plan.path_advance(kDirect[0], 255), 2 * direction(30, 2).dot(Vec3(1, 2, 3)));
  expect_weights_sum_to_one(plan, 256);
}

TEST(TracePlan, OfOnePulseIsOneTrace) {
  IntervalSampling sampling = paper_interval(0.2);
  sampling.pulse_first.resize(1);
  sampling.pulse_time_s.resize(1);
  const TracePlan plan({circling(0.01, 1), sampling, Vec3::UnitX(), 0}, kDirect, {1e-3, 1e-9});
  ASSERT_EQ(plan.traces().size(), 1u);
  expect_weights_sum_to_one(plan, 1);
}

TEST(TracePlan, HasTheNumberOfTracesOfTheAspectChange) {
  // 64 ms of 2 pi 0.01 rad/s: 4.0 mrad.
  const double aspect_change = 2 * kPi * 0.01 * 255 * 250e-6;
  for (const int count : {1, 2, 5}) {
    const TracePlan plan({circling(0.01, 1), paper_interval(0.2), Vec3::UnitX(), 0}, kDirect,
                         {aspect_change / (count - 0.5), 1});
    EXPECT_EQ(plan.traces().size(), static_cast<std::size_t>(count));
    expect_weights_sum_to_one(plan, 256);
  }
}

TEST(TracePlan, HasMoreTracesForACurvedPath) {
  // A quarter of a circle in the interval.
  const double radius = 0.01;
  const Trajectory trajectory = circling(radius, 4 * 255 * 250e-6);
  std::size_t before = 1;
  for (const double cross_track_limit : {1.0, 0.1 * radius, 0.01 * radius}) {
    const TracePlan plan({trajectory, paper_interval(0.2), Vec3::UnitX(), 0}, kDirect, {1, cross_track_limit});
    EXPECT_GE(plan.traces().size(), before) << cross_track_limit;
    before = plan.traces().size();
    for (const PlannedTrace& trace : plan.traces()) {
      for (const PlannedPath& path : trace.paths) EXPECT_LE(path.look_path.q_limit, cross_track_limit);
    }
    expect_weights_sum_to_one(plan, 256);
  }
  EXPECT_GT(before, 4u);
}

}  // namespace
}  // namespace seaglint
