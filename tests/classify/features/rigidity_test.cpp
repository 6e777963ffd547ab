// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "classify/features/look_features.h"
#include "classify/features/rigidity.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr double kRangeError_m = 0.02, kVelocityError_mps = 0.01;

struct RangeAndRate {
  double range_m = 0, velocity_mps = 0;
};
using MotionOfTrack = std::function<RangeAndRate(std::size_t track, double time_s)>;

struct Measurement {
  std::size_t looks = 10, tracks = 8;
  double noise = 1;    // times the standard errors
  double missing = 0;  // part of the entries
};

TrackSet measured_tracks(const Measurement& measurement, const MotionOfTrack& motion, Random& random) {
  TrackSet set;
  for (std::size_t k = 0; k < measurement.looks; ++k) set.time_s.push_back(0.5 * static_cast<double>(k));
  for (std::size_t j = 0; j < measurement.tracks; ++j) {
    Track track{std::vector<TrackPoint>(measurement.looks)};
    for (std::size_t k = 0; k < measurement.looks; ++k) {
      const double size = 0.5 + random.uniform();  // errors differ by a factor of three
      const RangeAndRate exact = motion(j, set.time_s[k]);
      const LookCentre centre{{exact.range_m + measurement.noise * size * kRangeError_m * random.normal(),
                               exact.velocity_mps + measurement.noise * size * kVelocityError_mps * random.normal(), 1},
                              size * kRangeError_m,
                              size * kVelocityError_mps};
      if (random.uniform() >= measurement.missing) track.points[k] = {0, centre};
    }
    set.tracks.push_back(track);
  }
  return set;
}

// A body that rolls, pitches and yaws by sinusoids and drifts; CONVENTIONS.md, "Frames" and "Range and velocity".
struct RandomBody {
  std::vector<Vec3> points_m;
  Vec3 to_radar;
  std::array<double, 3> amplitude{}, frequency{}, phase{};  // roll, pitch, yaw
  double drift_mps = 0;

  RandomBody(Random& random, std::size_t points, double turn_deg) : drift_mps(random.normal()) {
    for (std::size_t j = 0; j < points; ++j)
      points_m.emplace_back(60 * random.uniform() - 30, 20 * random.uniform() - 10, 15 * random.uniform());
    const double azimuth = 2 * kPi * random.uniform(), elevation = radians(2);
    to_radar = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
    for (std::size_t i = 0; i < 3; ++i) {
      amplitude[i] = radians(turn_deg) * (0.7 + 0.6 * random.uniform());
      frequency[i] = 2 * kPi / (5 + 3 * random.uniform());
      phase[i] = 2 * kPi * random.uniform();
    }
  }

  RangeAndRate at(std::size_t j, double time_s) const {
    std::array<double, 3> angle{}, rate{};
    for (std::size_t i = 0; i < 3; ++i) {
      angle[i] = amplitude[i] * std::sin(frequency[i] * time_s + phase[i]);
      rate[i] = amplitude[i] * frequency[i] * std::cos(frequency[i] * time_s + phase[i]);
    }
    const Mat3 R_WB = rotation_from_angles(angle[0], angle[1], angle[2]);
    const Mat3 yawed = rotation_from_angles(0, 0, angle[2]), pitched = rotation_from_angles(0, angle[1], angle[2]);
    const Vec3 w = Vec3(0, 0, 1) * rate[2] + yawed * Vec3(0, 1, 0) * rate[1] + pitched * Vec3(1, 0, 0) * rate[0];
    const Vec3 p = R_WB * points_m[j];
    return {drift_mps * time_s - to_radar.dot(p), drift_mps - to_radar.dot(w.cross(p))};
  }

  TrackSet tracks(const Measurement& measurement, Random& random) const {
    return measured_tracks(
        measurement, [this](std::size_t j, double t) { return at(j, t); }, random);
  }
};

TEST(ChiSquareTail, IsThatOfTheClosedForms) {
  for (const double x : {0.1, 1.0, 7.0, 60.0}) {
    EXPECT_NEAR((ChiSquare{x, 2}.p_value()), std::exp(-x / 2), 1e-14);
    EXPECT_NEAR((ChiSquare{x, 1}.p_value()), std::erfc(std::sqrt(x / 2)), 1e-14);
    EXPECT_NEAR((ChiSquare{x, 4}.p_value()), std::exp(-x / 2) * (1 + x / 2), 1e-14);
  }
  EXPECT_EQ(ChiSquare().p_value(), 1);
  EXPECT_EQ(ChiSquare().ratio(), 0);
  EXPECT_EQ((ChiSquare{1e300, 3}.p_value()), 0);
}

// Exact tracks of a rigid body: no residual, and the distances between its points.
TEST(RigidBodyFit, OfExactTracksIsTheBody) {
  int same = 0;
  constexpr int kBodies = 20;
  for (std::uint64_t i = 0; i < kBodies; ++i) {
    Random random({.seed = 10, .index = i});
    const std::size_t points = 6 + i % 7;
    const RandomBody body(random, points, 8);
    const TrackSet set = body.tracks({.tracks = points, .noise = 0}, random);
    EXPECT_LT(rank_test(set, 3).value, 1e-6);
    EXPECT_GT(rank_test(set, 2).value, 1);
    const RigidBody fit = fit_rigid_body(set);
    EXPECT_EQ(fit.test.degrees, static_cast<int>(20 * points - 60 - 3 * points + 6));
    EXPECT_LT(fit.test.value, 1e-6) << "body " << i;
    double worst = 0;
    for (std::size_t a = 0; a < points; ++a)
      for (std::size_t b = 0; b < a; ++b)
        worst = std::max(
            worst, std::abs((fit.points_m[a] - fit.points_m[b]).norm() - (body.points_m[a] - body.points_m[b]).norm()));
    same += worst < 1e-3;
  }
  EXPECT_EQ(same, kBodies);
}

struct MeanRatios {
  double rank3 = 0, rigid = 0, rejected = 0;  // rejected: part with p < 0.01 of the rigid body
};

MeanRatios mean_ratios(std::uint64_t seed, double turn_deg, double missing, int bodies) {
  MeanRatios mean;
  for (int i = 0; i < bodies; ++i) {
    Random random({.seed = seed, .index = static_cast<std::uint64_t>(i)});
    const std::size_t points = 6 + static_cast<std::size_t>(i) % 7;
    const TrackSet set = RandomBody(random, points, turn_deg).tracks({.tracks = points, .missing = missing}, random);
    const ChiSquare rigid = fit_rigid_body(set).test;
    mean.rank3 += rank_test(set, 3).ratio() / bodies;
    mean.rigid += rigid.ratio() / bodies;
    mean.rejected += (rigid.p_value() < 0.01 ? 1.0 : 0.0) / bodies;
  }
  return mean;
}

TEST(Rigidity, OfABodyWithTheStatedErrorsHasAMeanRatioOfOne) {
  constexpr int kBodies = 100;
  for (const int turn_deg : {2, 5, 10}) {
    for (const int missing : {0, 20}) {
      const MeanRatios mean = mean_ratios(11, turn_deg, 0.01 * missing, kBodies);
      if (turn_deg >= 5) {
        EXPECT_GT(mean.rank3, 0.9) << turn_deg << " deg, missing " << missing;
      }
      EXPECT_LT(mean.rank3, 1.1) << turn_deg << " deg, missing " << missing;
      EXPECT_GT(mean.rigid, 0.9) << turn_deg << " deg, missing " << missing;
      EXPECT_LT(mean.rigid, 1.1) << turn_deg << " deg, missing " << missing;
      // 1 % of 100 is 1; 6 or more have a probability of 0.05 %.
      EXPECT_LT(mean.rejected, 6.0 / kBodies) << turn_deg << " deg, missing " << missing;
      RecordProperty(fmt::format("rigidity_rank3_{}_deg_missing_{}", turn_deg, missing),
                     fmt::format("{:.2f}", mean.rank3));
      RecordProperty(fmt::format("rigidity_body_{}_deg_missing_{}", turn_deg, missing),
                     fmt::format("{:.2f}", mean.rigid));
      RecordProperty(fmt::format("rigidity_rejected_{}_deg_missing_{}", turn_deg, missing),
                     fmt::format("{:.1f}", 100 * mean.rejected));
    }
  }
}

// Each point has a sinusoid of its own: periods 5 to 8 s, amplitudes of Hs / 4 sqrt(2).
TrackSet free_floats(double hs_m, const Measurement& measurement, Random& random) {
  std::vector<std::array<double, 4>> motion;  // range, amplitude, frequency, phase
  for (std::size_t j = 0; j < measurement.tracks; ++j)
    motion.push_back({60 * random.uniform(), hs_m / 4 * std::sqrt(2.0) * (0.7 + 0.6 * random.uniform()),
                      2 * kPi / (5 + 3 * random.uniform()), 2 * kPi * random.uniform()});
  return measured_tracks(
      measurement,
      [&](std::size_t j, double t) {
        const auto& [range, amplitude, frequency, phase] = motion[j];
        return RangeAndRate{range + amplitude * std::sin(frequency * t + phase),
                            amplitude * frequency * std::cos(frequency * t + phase)};
      },
      random);
}

TEST(Rigidity, OfFreeFloatsIsRejected) {
  constexpr int kSequences = 20;  // of each number of tracks
  for (const double hs_m : {0.1, 1.0, 2.0}) {
    int all = 0;
    for (const std::size_t tracks : {6u, 7u, 8u, 10u, 12u}) {
      int rejected = 0;
      for (std::uint64_t i = 0; i < kSequences; ++i) {
        Random random({.seed = 12, .index = i});
        rejected += fit_rigid_body(free_floats(hs_m, {.tracks = tracks, .missing = 0.1}, random)).test.p_value() < 1e-3;
      }
      all += rejected;
      RecordProperty(fmt::format("rigidity_floats_rejected_{}_tracks_hs_{:.0f}_dm", tracks, 10 * hs_m),
                     fmt::format("{:.0f}", 100.0 * rejected / kSequences));
    }
    if (hs_m >= 1) {
      EXPECT_GE(all, 0.95 * 5 * kSequences) << "Hs " << hs_m;
    }
  }
}

TEST(Rigidity, OfPointsOnALineHasRankOne) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    Random random({.seed = 13, .index = i});
    RandomBody body(random, 7, 5);
    for (Vec3& point : body.points_m) point = Vec3(2, 1, 0) + Vec3(0.9, 0.3, 0.1) * (60 * random.uniform() - 30);
    const TrackSet exact = body.tracks({.tracks = 7, .noise = 0, .missing = 0.1}, random);
    EXPECT_LT(rank_test(exact, 1).value, 1e-6);
    EXPECT_GT(rank_test(exact, 0).ratio(), 10);
    const TrackSet noisy = body.tracks({.tracks = 7}, random);
    EXPECT_GT(rank_test(noisy, 1).p_value(), 1e-4);
    EXPECT_GT(fit_rigid_body(noisy).test.p_value(), 1e-4);
  }
}

// degrees = entries - looks (1 + q) - tracks q + q^2 + q, with one look of too few entries left out.
TEST(Rigidity, CountsItsDegreesOfFreedom) {
  Random random({.seed = 14});
  const RandomBody body(random, 8, 5);
  TrackSet set = body.tracks({.tracks = 8, .noise = 0}, random);
  for (int q = 0; q <= 3; ++q) EXPECT_EQ(rank_test(set, q).degrees, 80 - 10 * (1 + q) - 8 * q + q * q + q);
  for (std::size_t j = 2; j < 8; ++j) set.tracks[j].points[4] = {};
  for (int q = 1; q <= 3; ++q) EXPECT_EQ(rank_test(set, q).degrees, 72 - 9 * (1 + q) - 8 * q + q * q + q);
  EXPECT_EQ(rank_test(set, 0).degrees, 74 - 10);
  EXPECT_EQ(fit_rigid_body(set).test.degrees, 144 - 54 - 24 + 6);
  set.tracks.resize(3);
  EXPECT_FALSE(fit_rigid_body(set).test.defined());
  EXPECT_TRUE(std::isnan(fit_rigid_body(set).points_m[0].x()));
}

TEST(LookFeatures, AreFiniteForAnyTracks) {
  const auto finite = [](const TrackSet& set) {
    for (const double value : look_feature_values(look_features(set))) EXPECT_TRUE(std::isfinite(value));
  };
  finite({});
  finite({{0, 0.5, 1}, {}});
  for (std::uint64_t i = 0; i < 60; ++i) {
    Random random({.seed = 15, .index = i});
    const Measurement measurement{1 + random.below(8), random.below(9), static_cast<double>(i % 2), random.uniform()};
    const RandomBody body(random, 9, i % 3 == 0 ? 0.0 : 5.0);
    finite(body.tracks(measurement, random));
    const double far = std::pow(10, 300 * random.uniform() - 150);
    finite(measured_tracks(
        measurement,
        [&](std::size_t j, double t) {
          return RangeAndRate{far * std::sin(3.0 * static_cast<double>(j) + t), far};
        },
        random));
    finite(measured_tracks(
        measurement,
        [&](std::size_t, double) {
          return RangeAndRate{1, 2};
        },
        random));
  }
  EXPECT_EQ(look_features({}).rigid_log10_p, 0);
  EXPECT_EQ(look_features({}).share_median, kUndefinedLookFeature);
}

TEST(LookFeatures, TellABodyFromFloats) {
  Random random({.seed = 16});
  const Measurement measurement{.looks = 10, .tracks = 9, .missing = 0.1};
  const LookFeatures body = look_features(RandomBody(random, 9, 3).tracks(measurement, random));
  const LookFeatures floats = look_features(free_floats(1, measurement, random));
  EXPECT_GT(body.rigid_log10_p, -3);
  EXPECT_LT(floats.rigid_log10_p, -30);
  EXPECT_LT(body.share_median, 0.1);
  EXPECT_GT(floats.share_median, 0.1);
  EXPECT_LE(floats.share_lower_quartile, floats.share_median);
  EXPECT_LE(floats.share_median, floats.share_upper_quartile);
  EXPECT_GT(floats.rank_deviation[0], floats.rank_deviation[2]);
  EXPECT_EQ(floats.tracks, 9);
  EXPECT_NEAR(floats.seen_fraction, 0.9, 0.1);
}

// One track of nine with velocities of its own: Huber's weights leave its residual to it.
TEST(LookFeatures, OfOneWrongTrackHaveALargeShareOfItAlone) {
  Random random({.seed = 17});
  TrackSet set = RandomBody(random, 9, 5).tracks({.tracks = 9}, random);
  for (TrackPoint& point : set.tracks[4].points) point.measured.velocity_mps += 0.2 * random.normal();
  std::array<double, 9> squares{};
  for (const VelocityResidual& residual : rank_residuals(set, 2, FitWeights::kHuber))
    squares[residual.track] += residual.value_mps * residual.value_mps;
  for (std::size_t j = 0; j < 9; ++j)
    if (j != 4) {
      EXPECT_LT(4 * squares[j], squares[4]);
    }
}

// Sinusoids of one frequency and all phases: 2 sin(w dt / 2) / dt by the differences, with the medians of |sin|.
TEST(LookFeatures, HaveTheFrequencyOfTheMotionAsTempo) {
  Random random({.seed = 18});
  const double w = 2 * kPi / 6.3;
  const TrackSet set = measured_tracks(
      {.looks = 40, .tracks = 24, .noise = 0},
      [&](std::size_t j, double t) {
        return RangeAndRate{0, std::cos(w * t + 2 * kPi * static_cast<double>(j) / 24)};
      },
      random);
  // Errors spread by 29 %, so that the weighted mean of 24 phases is 0.29 / sqrt(2 * 24) = 4 % of the amplitude.
  EXPECT_NEAR(look_features(set).tempo_per_s, 2 * std::sin(w * 0.25) / 0.5, 0.04);
}

}  // namespace

}  // namespace seaglint
