// SPDX-License-Identifier: BSD-3-Clause
// Ropes between floats: closed forms of the constraint, and laws of a tethered line in waves.
#include "sim/motion/float/tether.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/motion/float/float.h"
#include "sim/motion/target_motion.h"

namespace seaglint {
namespace {

double longest(const std::vector<Vec2>& places) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) length = std::max(length, (places[k + 1] - places[k]).norm());
  return length;
}

Vec2 mean(const std::vector<Vec2>& places) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& place : places) sum += place;
  return sum / static_cast<double>(places.size());
}

std::vector<Vec2> random_line(int count, double spacing_m, double deviation_m, std::uint64_t index) {
  Random random({7, Stream::kTest, index});
  std::vector<Vec2> places;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal(), y = random.normal();
    places.push_back(Vec2(i * spacing_m, 0) + deviation_m * Vec2(x, y));
  }
  return places;
}

TEST(HoldPlaces, MovesBothEndsOfARopeByHalfOfItsExcess) {
  std::vector<Vec2> pair{{0, 0}, {6, 8}};
  hold_places(pair, 9);
  EXPECT_LT((pair[0] - Vec2(0.3, 0.4)).norm() + (pair[1] - Vec2(5.7, 7.6)).norm(), 1e-12);
  const std::vector<Vec2> before = pair;
  hold_places(pair, 9.5);
  EXPECT_EQ(pair, before);
}

// The smallest displacement of a straight line with spacings s > L is the line with spacings L about the same mean.
TEST(HoldPlaces, DrawsAStraightLineTogetherAboutItsMean) {
  for (const int count : {2, 3, 4, 30, 300}) {
    std::vector<Vec2> line;
    for (int i = 0; i < count; ++i) line.emplace_back(40.4 * i, 3);
    hold_places(line, 40);
    for (int i = 0; i < count; ++i) {
      const double x = 40.4 * 0.5 * (count - 1) + 40 * (i - 0.5 * (count - 1));
      EXPECT_LT((line[static_cast<std::size_t>(i)] - Vec2(x, 3)).norm(), 1e-8 * count) << count;
    }
  }
}

// Its displacement is that of tensions: along the taut ropes, drawing their ends together, to the turn of the ropes by
// the displacement over the spacing.
TEST(HoldPlaces, LeavesNoRopeTooLongAndTheMeanWhereItIs) {
  for (std::uint64_t index = 0; index < 200; ++index) {
    const std::vector<Vec2> free = random_line(8, 40, 2, index);
    std::vector<Vec2> held = free;
    hold_places(held, 40.5);
    EXPECT_LE(longest(held), 40.5 + 1.01 * kRopeExcess_m) << index;
    EXPECT_LT((mean(held) - mean(free)).norm(), 1e-12);
    Vec2 tension = Vec2::Zero();  // of the rope after body i: the sum of the displacements up to it
    for (std::size_t i = 0; i + 1 < held.size(); ++i) {
      tension += held[i] - free[i];
      const Vec2 rope = held[i + 1] - held[i], along = rope.normalized();
      EXPECT_GE(tension.dot(along), -1e-9);
      EXPECT_LT(std::abs(cross(tension, along)), 0.2 * tension.norm() + 1e-9);
    }
  }
}

// Lines that fold back on themselves: the passes converge from 20 m beyond the ropes.
TEST(HoldPlaces, ConvergesForFoldedLines) {
  for (std::uint64_t index = 0; index < 300; ++index) {
    const std::vector<Vec2> free = random_line(12, 5, 10, index);
    std::vector<Vec2> held = free;
    hold_places(held, 6);
    EXPECT_LE(longest(held), 6 + 1.01 * kRopeExcess_m) << index;
    EXPECT_LT((mean(held) - mean(free)).norm(), 1e-11);
  }
}

TEST(HoldVelocities, KeepTautRopesFromLengtheningAlone) {
  const std::vector<Vec2> places{{0, 0}, {40, 0}, {80, 0}, {119, 0}};  // the last rope is slack
  const auto held = [&](std::vector<Vec2> velocities) {
    hold_velocities(places, 40, velocities);
    return velocities;
  };
  const std::vector<Vec2> turning{{1, -2}, {1, 0}, {1, 2}, {9, 4}}, closing{{1, 0}, {0, 0}, {-1, 0}, {5, 0}};
  EXPECT_EQ(held(turning), turning);
  EXPECT_EQ(held(closing), closing);
  // The mean along the ropes of those that it would draw apart.
  const std::vector<Vec2> apart = held({{-1, 3}, {0, 0}, {4, 0}, {5, 0}});
  const std::array<Vec2, 4> expected{Vec2(1, 3), Vec2(1, 0), Vec2(1, 0), Vec2(5, 0)};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((apart[i] - expected[i]).norm(), 1e-12);
  // The first rope goes slack: its ends draw near as soon as the second holds the body between them.
  const std::vector<Vec2> one = held({{0, 0}, {0, 0}, {-2, 0}, {0, 0}});
  EXPECT_EQ(one[0], Vec2(0, 0));
  EXPECT_EQ(one[1], Vec2(0, 0));
}

// A line of floats with translations in waves.
struct Line {
  MotionSpec spec;
  FloatParticulars body;
  std::vector<Vec2> places;
  double duration_s = 40;

  explicit Line(int count = 4, double spacing_m = 20) {
    spec.model = MotionModel::kFloat;
    spec.translations = true;
    body = float_particulars(spec, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}});
    for (int i = 0; i < count; ++i) places.emplace_back(spacing_m * (i - 0.5 * (count - 1)), 0);
  }
  std::vector<FloatRequest> requests(const WaveField& sea) const {
    std::vector<FloatRequest> line;
    for (std::size_t i = 0; i < places.size(); ++i) line.push_back({body, spec, sea, places[i], 0, 42, i});
    return line;
  }
  std::vector<std::vector<MotionSample>> tethered(const WaveField& sea, double rope_m) const {
    return simulate_tethered_floats(requests(sea), rope_m, duration_s);
  }
  std::vector<std::vector<MotionSample>> free(const WaveField& sea) const {
    std::vector<std::vector<MotionSample>> samples;
    for (const FloatRequest& request : requests(sea)) samples.push_back(simulate_float(request, duration_s));
    return samples;
  }
  std::vector<Vec2> positions(const std::vector<std::vector<MotionSample>>& samples, std::size_t n) const {
    std::vector<Vec2> at;
    for (std::size_t i = 0; i < places.size(); ++i) at.push_back(places[i] + samples[i][n].translation.xy());
    return at;
  }
};

// Waves of twice the spacing, so that neighbours move against each other, with another across.
WaveField waves_of(double length_m, double amplitude_m = 0.5) {
  const double k = 2 * kPi / length_m, omega = std::sqrt(kGravity * k);
  return WaveField({{0.8 * omega, 0.3 * amplitude_m, 1.7, 0.64 * k, {0.8, 0.6}}, {omega, amplitude_m, 0.4, k, {1, 0}}},
                   1, 0);
}

bool are_equal(const MotionSample& a, const MotionSample& b) {
  return a.angles == b.angles && a.angle_rates == b.angle_rates && a.translation == b.translation &&
         a.translation_rates == b.translation_rates;
}

TEST(TetheredFloats, MoveAsFreeOnesWhileNoRopeIsTaut) {
  const Line line;
  const WaveField sea = waves_of(40);
  const auto free = line.free(sea);
  double most = 0;
  for (std::size_t n = 0; n < free[0].size(); ++n) most = std::max(most, longest(line.positions(free, n)));
  EXPECT_GT(most, 20.5);
  for (const double rope_m : {22.0, 1e6}) {
    const auto held = line.tethered(sea, rope_m);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t n = 0; n < free[i].size(); ++n) ASSERT_TRUE(are_equal(held[i][n], free[i][n])) << rope_m;
  }
}

// Between samples a cubic leaves the rope by at most 4/27 h dv, dv the velocity at which a rope becomes taut.
TEST(TetheredFloats, AreNeverFurtherApartThanTheirRopes) {
  const Line line;
  const auto held = line.tethered(waves_of(40), 20.2);
  std::vector<Trajectory> trajectories;
  for (std::size_t i = 0; i < 4; ++i)
    trajectories.emplace_back(0, line.spec.step_s, held[i], Vec3(line.places[i].x(), 0, 0), Vec3::Zero());
  int taut = 0;
  double most = 0;
  for (std::size_t n = 0; n < held[0].size(); ++n) {
    const std::vector<Vec2> at = line.positions(held, n);
    EXPECT_LE(longest(at), 20.2 + 1.1 * kRopeExcess_m);
    taut += longest(at) > 20.2 - kTaut_m ? 1 : 0;
    for (const double u : {0.2, 0.333, 0.5, 0.8}) {
      std::vector<Vec2> between;
      const double t = line.spec.step_s * (static_cast<double>(n) + u);
      for (const Trajectory& one : trajectories)
        if (t < one.end_s()) between.push_back(one.pose(t).p.xy());
      most = std::max(most, longest(between));
    }
  }
  EXPECT_GT(taut, static_cast<int>(held[0].size() / 10));
  const double closing_mps = 2 * 1.3 * 0.5 * std::sqrt(kGravity * 2 * kPi / 40);  // of both waves, at most
  std::printf("longest between samples: rope + %.3g m (bound %.3g)\n", most - 20.2,
              4.0 / 27 * line.spec.step_s * closing_mps);
  EXPECT_LE(most - 20.2, 4.0 / 27 * line.spec.step_s * closing_mps);
}

// Waves of 6 km, each float in a phase of its own. The forces of the ropes are internal: sum d_i' = sum du/dx d_i - sum
// d_i / tau of the displacements d from the free line, so that their sum is at most tau k u sum |d|.
TEST(TetheredFloats, HaveTheMeanMotionOfFreeOnes) {
  const Line line;
  const double omega = 0.1, k = omega * omega / kGravity, amplitude_m = 3, mooring_s = 10;
  std::vector<WaveField> seas;
  for (const double phase : {0.0, 2.0, 3.0, 5.0})
    seas.push_back(WaveField({{omega, amplitude_m, phase, k, {0.8, 0.6}}}, 1, 0));
  std::vector<FloatRequest> requests;
  std::vector<std::vector<MotionSample>> free;
  for (std::size_t i = 0; i < 4; ++i) {
    requests.push_back({line.body, line.spec, seas[i], line.places[i], 0, 42, i});
    free.push_back(simulate_float(requests[i], 40));
  }
  const auto held = simulate_tethered_floats(requests, 20.1, 40);
  double most_m = 0, mean_m = 0;
  for (std::size_t n = 0; n < held[0].size(); ++n) {
    Vec2 sum = Vec2::Zero();
    double displaced_m = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 displacement = held[i][n].translation - free[i][n].translation;
      sum += displacement.xy();
      displaced_m += displacement.xy().norm();
    }
    most_m = std::max(most_m, displaced_m);
    mean_m = std::max(mean_m, sum.norm());
  }
  std::printf("displaced by the ropes: %.3g m in all, their sum %.3g m\n", most_m, mean_m);
  EXPECT_GT(most_m, 1);
  EXPECT_LT(mean_m, mooring_s * k * omega * amplitude_m * most_m);
}

// First order in the step, at which a rope becomes taut.
TEST(TetheredFloats, ConvergeWithTheStep) {
  Line line;
  line.duration_s = 20;
  const WaveField sea = waves_of(40);
  const auto at = [&](double step_s) {
    line.spec.step_s = step_s;
    const auto held = line.tethered(sea, 20.2);
    std::vector<Vec2> places;
    for (int t = 1; t <= 20; ++t) {
      const auto now = line.positions(held, static_cast<std::size_t>(std::lround(t / step_s)));
      places.insert(places.end(), now.begin(), now.end());
    }
    return places;
  };
  const std::vector<Vec2> fine = at(0.00125);
  const auto error_m = [&](double step_s) {
    const std::vector<Vec2> coarse = at(step_s);
    double largest = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) largest = std::max(largest, (coarse[i] - fine[i]).norm());
    return largest;
  };
  const double usual_m = error_m(0.02), half_m = error_m(0.01), quarter_m = error_m(0.005);
  std::printf("steps of 0.02, 0.01, 0.005 s: %.2g, %.2g, %.2g m\n", usual_m, half_m, quarter_m);
  EXPECT_LT(half_m, 0.7 * usual_m);
  EXPECT_LT(quarter_m, 0.7 * half_m);
  EXPECT_LT(usual_m, 1e-3);
}

// Trapezoidal rule over a step: h^2/12 of the acceleration's change, and h/2 dv where a rope becomes taut.
TEST(TetheredFloats, HaveRatesOfTheirMotion) {
  const Line line;
  const auto held = line.tethered(waves_of(40), 20.2);
  const double h = line.spec.step_s;
  std::vector<double> errors;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t n = 0; n + 1 < held[i].size(); ++n) {
      const Vec3 passed = 0.5 * h * (held[i][n].translation_rates + held[i][n + 1].translation_rates);
      errors.push_back((held[i][n + 1].translation - held[i][n].translation - passed).xy().norm());
    }
  }
  std::ranges::sort(errors);
  const double speed_mps = 1.3 * 0.5 * std::sqrt(kGravity * 2 * kPi / 40);
  EXPECT_LT(errors[errors.size() * 9 / 10], 1e-5);
  EXPECT_LT(errors.back(), 0.5 * h * 2 * speed_mps);
}

TEST(TetheredFloats, OfATargetMoveAsTheLineForAnyNumberOfThreads) {
  TargetSpec target;
  target.motion.model = MotionModel::kFloat;
  target.motion.translations = true;
  target.layout = LayoutSpec{.line = LineLayout{4, 20}, .heights_m = BodyRange{1, 2}, .tether_slack = 0.01};
  const Body body = make_body(target.motion, {{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}, {}});
  const WaveField sea = waves_of(40);
  const auto with_threads = [&](int threads) {
    return simulate_target({.target = target,
                            .models = std::array{&body},
                            .state = {},
                            .sea = sea,
                            .duration_s = 10,
                            .seed = 42,
                            .threads = threads});
  };
  const auto one = with_threads(1), two = with_threads(2);
  const auto line = Line().tethered(sea, 20.2);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(are_equal(one[i].sample(5.01), two[i].sample(5.01)));
    EXPECT_EQ(one[i].sample(5).translation.xy(), line[i][250].translation.xy());
    EXPECT_NEAR(one[i].pose(0).p.z() - one[i].sample(0).translation.z(), 0.75 + body_heights_m(target.layout)[i], 0.2);
  }
}

}  // namespace
}  // namespace seaglint
