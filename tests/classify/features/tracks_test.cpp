// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "classify/features/tracks.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Smallest sum of costs over all assignments of rows from `row` on.
double least_cost(const Matrix<double>& cost, double unassigned, std::size_t row, std::vector<bool>& used) {
  if (row == cost.rows()) return 0;
  double least = unassigned + least_cost(cost, unassigned, row + 1, used);
  for (std::size_t j = 0; j < cost.columns(); ++j) {
    if (used[j] || std::isinf(cost(row, j))) continue;
    used[j] = true;
    least = std::min(least, cost(row, j) + least_cost(cost, unassigned, row + 1, used));
    used[j] = false;
  }
  return least;
}

TEST(Assignment, HasTheLeastCostOfAll) {
  for (std::uint64_t i = 0; i < 500; ++i) {
    Random random({.seed = 1, .index = i});
    Matrix<double> cost(random.below(6), random.below(7));
    for (double& value : cost.values()) value = random.uniform() < 0.3 ? kInfinity : 10 * random.uniform() - 2;
    const double unassigned = 8 * random.uniform() - 1;
    const std::vector<int> columns = assignment(cost, unassigned);
    double sum = 0;
    std::vector<bool> used(cost.columns());
    for (std::size_t row = 0; row < cost.rows(); ++row) {
      sum += columns[row] < 0 ? unassigned : cost(row, static_cast<std::size_t>(columns[row]));
      if (columns[row] < 0) continue;
      EXPECT_FALSE(used[static_cast<std::size_t>(columns[row])]);
      used[static_cast<std::size_t>(columns[row])] = true;
    }
    std::fill(used.begin(), used.end(), false);
    EXPECT_NEAR(sum, least_cost(cost, unassigned, 0, used), 1e-12) << "case " << i;
  }
}

// Standard errors of the maximum of |map| of one point, over the bound of Cramer and Rao: 32 frequencies by 64 pulses,
// white noise 20 dB below the map's peak.
struct ErrorRatios {
  double range = 0, velocity = 0;
};

class PointInNoise {
 public:
  PointInNoise(bool hann, Random& random) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < kFrequencies; ++i) {
      for (std::size_t n = 0; n < kPulses; ++n) {
        const double x = at(i, kFrequencies), y = at(n, kPulses);
        const double weight = hann ? std::pow(std::cos(kPi * x) * std::cos(kPi * y), 2) : 1;
        samples_.push_back({x, y, weight, {random.normal(), random.normal()}});
        sum += weight;
        squares += weight * weight;
      }
    }
    const double noise = sum / std::sqrt(squares) / kAmplitudeOverFloor / std::sqrt(2.0);
    for (Sample& sample : samples_) sample.value = Complex(1, 0) + noise * sample.value;
  }

  // Phase slopes over the whole band and interval at the maximum of |sum|^2, by Newton's method on ln |sum|^2 from the
  // true ones, 0.
  std::array<double, 2> maximum() const {
    std::array<double, 2> slope{};
    for (int i = 0; i < 6; ++i) {
      Complex s, sx, sy, sxx, sxy, syy;
      for (const Sample& sample : samples_) {
        const Complex term = sample.weight * sample.value * std::polar(1.0, -slope[0] * sample.x - slope[1] * sample.y);
        s += term;
        sx += -kJ * sample.x * term;
        sy += -kJ * sample.y * term;
        sxx -= sample.x * sample.x * term;
        sxy -= sample.x * sample.y * term;
        syy -= sample.y * sample.y * term;
      }
      const Complex gx = sx / s, gy = sy / s;
      const double hxx = (sxx / s - gx * gx).real(), hxy = (sxy / s - gx * gy).real(), hyy = (syy / s - gy * gy).real(),
                   determinant = hxx * hyy - hxy * hxy;
      slope[0] -= (hyy * gx.real() - hxy * gy.real()) / determinant;
      slope[1] -= (hxx * gy.real() - hxy * gx.real()) / determinant;
    }
    return slope;
  }

  static constexpr double kAmplitudeOverFloor = 10;

 private:
  static constexpr std::size_t kFrequencies = 32, kPulses = 64;
  struct Sample {
    double x, y, weight;  // frequency and time over band and interval, -0.5 to 0.5
    Complex value;
  };
  static double at(std::size_t i, std::size_t count) {
    return (static_cast<double>(i) + 0.5) / static_cast<double>(count) - 0.5;
  }
  std::vector<Sample> samples_;
};

ErrorRatios error_ratios(bool hann, int trials) {
  const CoherentInterval interval{150e6, 0.064, 0.01875};
  const PointErrors bound = cramer_rao_errors(PointInNoise::kAmplitudeOverFloor, interval);
  ErrorRatios ratios;
  for (int i = 0; i < trials; ++i) {
    Random random({.seed = hann ? 3u : 2u, .index = static_cast<std::uint64_t>(i)});
    const std::array<double, 2> slope = PointInNoise(hann, random).maximum();
    const double range_m = slope[0] * kSpeedOfLight / (4 * kPi * interval.bandwidth_hz);
    const double velocity_mps = slope[1] * interval.wavelength_m / (4 * kPi * interval.duration_s);
    ratios.range += std::pow(range_m / bound.range_m, 2) / trials;
    ratios.velocity += std::pow(velocity_mps / bound.velocity_mps, 2) / trials;
  }
  return {std::sqrt(ratios.range), std::sqrt(ratios.velocity)};
}

TEST(PointErrorBound, IsReachedByTheMaximumOfTheMap) {
  constexpr int kTrials = 1000;
  // Three standard errors of a root mean square, 1/sqrt(2 trials) each, and 2 % of the bound's own limit (20 dB).
  const double tolerance = 3 / std::sqrt(2.0 * kTrials) + 0.02;
  const ErrorRatios uniform = error_ratios(false, kTrials);
  EXPECT_NEAR(uniform.range, 1, tolerance);
  EXPECT_NEAR(uniform.velocity, 1, tolerance);
  // Hann: sqrt(<w^2 x^2> <w>^2 / (<w x^2>^2 <w^2>) / 12) = 1.25 with w = cos^2(pi x).
  const ErrorRatios hann = error_ratios(true, kTrials);
  EXPECT_NEAR(hann.range, 1.25, 1.25 * tolerance);
  EXPECT_NEAR(hann.velocity, 1.25, 1.25 * tolerance);
  RecordProperty("track_range_error_over_bound", fmt::format("{:.2f}", uniform.range));
  RecordProperty("track_velocity_error_over_bound", fmt::format("{:.2f}", uniform.velocity));
}

TEST(PointErrorBound, AddsTheErrorOfTheFit) {
  const CoherentInterval interval{150e6, 0.064, 0.01875};
  const LookCentre strong = with_errors({3, -0.2, 1e6}, 1, interval);
  EXPECT_NEAR(strong.range_error_m, 0.013 * 299792458.0 / 300e6, 1e-9);
  EXPECT_NEAR(strong.velocity_error_mps, 0.013 * 0.01875 / 0.128, 1e-9);
  const LookCentre weak = with_errors({3, -0.2, 4}, 1, interval, 0);
  EXPECT_NEAR(weak.range_error_m, std::sqrt(6.0) / 4 * 299792458.0 / (4 * kPi * 150e6), 1e-12);
  EXPECT_THROW(with_errors({3, -0.2, 4}, 0, interval), InputError);
  EXPECT_THROW(cramer_rao_errors(kNan, interval), InputError);
}

LookCentre ideal_centre(double range_m, double velocity_mps, double amplitude_m = 1) {
  return {{range_m, velocity_mps, amplitude_m}, 0.02, 0.01};
}

std::vector<int> centres_of(const Track& track) {
  std::vector<int> centres;
  for (const TrackPoint& point : track.points) centres.push_back(point.centre);
  return centres;
}

// Two points of one level cross in range between looks 4 and 5, 0.6 m/s apart.
TEST(Tracks, CrossWithTheirVelocities) {
  std::vector<Look> looks;
  for (int k = 0; k < 10; ++k) {
    const double t = 0.5 * k;
    looks.push_back({t, {ideal_centre(0.3 * t, 0.3), ideal_centre(1.3 - 0.3 * t, -0.3)}});
  }
  const TrackSet set = associate(looks);
  ASSERT_EQ(set.tracks.size(), 2u);
  EXPECT_EQ(centres_of(set.tracks[0]), std::vector<int>(10, 0));
  EXPECT_EQ(centres_of(set.tracks[1]), std::vector<int>(10, 1));
  EXPECT_EQ(set.tracks[1].points[3].measured.range_m, looks[3].centres[1].range_m);
  EXPECT_EQ(set.time_s[3], 1.5);
}

TEST(Tracks, BridgeTwoLostLooksAndEndAfterThree) {
  const auto track_of = [](std::vector<int> lost, double seen_fraction) {
    std::vector<Look> looks;
    for (int k = 0; k < 10; ++k) {
      looks.push_back({0.5 * k + 0.05 * (k % 3), {}});  // uneven spacing
      if (std::find(lost.begin(), lost.end(), k) == lost.end())
        looks.back().centres.push_back(ideal_centre(5 + 0.2 * looks.back().time_s, 0.2));
    }
    TrackSettings settings;
    settings.seen_fraction = seen_fraction;
    return associate(looks, settings).tracks;
  };
  ASSERT_EQ(track_of({4, 5}, 0.7).size(), 1u);
  EXPECT_EQ(centres_of(track_of({4, 5}, 0.7)[0]), (std::vector<int>{0, 0, 0, 0, -1, -1, 0, 0, 0, 0}));
  EXPECT_EQ(track_of({0, 1, 9}, 0.7).size(), 1u);     // born in look 2, seen in seven
  EXPECT_EQ(track_of({0, 1, 8, 9}, 0.7).size(), 0u);  // seen in six
  EXPECT_EQ(track_of({4, 5, 6}, 0.7).size(), 0u);
  EXPECT_EQ(track_of({4, 5, 6}, 0.3).size(), 2u);
  EXPECT_EQ(track_of({4, 5, 6}, 0.3)[1].looks_seen(), 3);
}

TEST(Tracks, EndAtEachGate) {
  const auto tracks = [](const LookCentre& next) {
    TrackSettings settings;
    settings.seen_fraction = 1;
    const std::vector<Look> looks = {{0, {ideal_centre(0, 0)}}, {0.5, {next}}};
    return associate(looks, settings).tracks.size();
  };
  EXPECT_EQ(tracks(ideal_centre(0.59, 0)), 1u);
  EXPECT_EQ(tracks(ideal_centre(0.61, 0)), 0u);
  EXPECT_EQ(tracks(ideal_centre(1.14 * 0.25, 1.14)), 1u);  // 0.15 + 2 / 2
  EXPECT_EQ(tracks(ideal_centre(1.16 * 0.25, 1.16)), 0u);
  EXPECT_EQ(tracks(ideal_centre(0, 0, std::pow(10, 14.9 / 20))), 1u);
  EXPECT_EQ(tracks(ideal_centre(0, 0, std::pow(10, -15.1 / 20))), 0u);
}

// Points with independent motion in a sea of Hs 2 m, Tp 7 s: orbital velocities of 0.45 m/s rms towards the radar, four
// frequencies about the peak. Points within a cell of a stronger one in range and velocity are lost in that look, and
// others in 2 % of the looks; levels fluctuate by 2 dB.
struct FloatingPoint {
  double range_m = 0, level_db = 0;
  std::array<double, 4> speed_mps{}, frequency{}, phase{};

  explicit FloatingPoint(Random& random) : range_m(60 * random.uniform()), level_db(6 * random.normal()) {
    for (std::size_t i = 0; i < 4; ++i) {
      speed_mps[i] = 0.45 / std::sqrt(4.0) * std::sqrt(-2 * std::log(random.uniform()));  // Rayleigh: sum of variance
      frequency[i] = 2 * kPi / 7 * (0.85 + 0.2 * static_cast<double>(i));
      phase[i] = 2 * kPi * random.uniform();
    }
  }
  LookCentre at(double time_s, Random& random) const {
    double r = range_m, v = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      v += speed_mps[i] * std::cos(frequency[i] * time_s + phase[i]);
      r += speed_mps[i] / frequency[i] * std::sin(frequency[i] * time_s + phase[i]);
    }
    LookCentre centre = ideal_centre(r, v, std::pow(10, (level_db + 2 * random.normal()) / 20));
    centre.range_m += centre.range_error_m * random.normal();
    centre.velocity_mps += centre.velocity_error_mps * random.normal();
    return centre;
  }
};

struct Sequence {
  std::vector<Look> looks;
  std::vector<std::vector<int>> point;  // of each centre
  std::vector<int> seen;                // looks with the point
};

Sequence floating_sequence(std::uint64_t index, std::size_t count) {
  Random random({.seed = 4, .index = index});
  std::vector<FloatingPoint> points;
  for (std::size_t j = 0; j < count; ++j) points.emplace_back(random);
  Sequence sequence{{}, {}, std::vector<int>(count)};
  for (int k = 0; k < 10; ++k) {
    std::vector<LookCentre> all;
    for (const FloatingPoint& point : points) all.push_back(point.at(0.5 * k, random));
    sequence.looks.push_back({0.5 * k, {}});
    sequence.point.emplace_back();
    for (std::size_t j = 0; j < count; ++j) {
      const bool resolved = std::none_of(all.begin(), all.end(), [&](const LookCentre& other) {
        return other.amplitude_m > all[j].amplitude_m && std::abs(other.range_m - all[j].range_m) < 1 &&
               std::abs(other.velocity_mps - all[j].velocity_mps) < 0.15;
      });
      if (random.uniform() < 0.02 || !resolved) continue;
      sequence.looks.back().centres.push_back(all[j]);
      sequence.point.back().push_back(static_cast<int>(j));
      ++sequence.seen[j];
    }
  }
  return sequence;
}

TEST(Tracks, KeepTheIdentityOfPointsInWavesOfTwoMetres) {
  int points = 0, kept = 0, tracks = 0, mixed = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Sequence sequence = floating_sequence(i, 8);
    const TrackSet set = associate(sequence.looks);
    std::vector<int> longest(8);
    for (const Track& track : set.tracks) {
      std::vector<int> of_point(8);
      for (std::size_t k = 0; k < track.points.size(); ++k)
        if (track.points[k].seen())
          ++of_point[static_cast<std::size_t>(sequence.point[k][static_cast<std::size_t>(track.points[k].centre)])];
      const auto most = std::max_element(of_point.begin(), of_point.end());
      ++tracks;
      mixed += *most != track.looks_seen();
      if (*most == track.looks_seen()) longest[static_cast<std::size_t>(most - of_point.begin())] = *most;
    }
    for (std::size_t j = 0; j < 8; ++j) {
      if (sequence.seen[j] < 9) continue;  // resolved in its looks
      ++points;
      kept += longest[j] == sequence.seen[j];
    }
  }
  const double share = 100.0 * kept / points;
  EXPECT_GE(share, 99) << kept << " of " << points;
  EXPECT_GE(points, 1500);
  RecordProperty("track_identity_percent", fmt::format("{:.1f}", share));
  RecordProperty("track_mixed_percent", fmt::format("{:.1f}", 100.0 * mixed / tracks));
}

// The centres of each look in another order: the same tracks of the same measured values.
TEST(Tracks, DoNotDependOnTheOrderOfCentres) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    Sequence sequence = floating_sequence(i, 20);
    const TrackSet before = associate(sequence.looks);
    Random random({.seed = 5, .index = i});
    for (Look& look : sequence.looks) shuffle(look.centres, random);
    const TrackSet after = associate(sequence.looks);
    ASSERT_EQ(after.tracks.size(), before.tracks.size());
    for (std::size_t j = 0; j < before.tracks.size(); ++j) {
      for (std::size_t k = 0; k < before.time_s.size(); ++k) {
        const TrackPoint &one = before.tracks[j].points[k], &other = after.tracks[j].points[k];
        EXPECT_EQ(one.seen(), other.seen());
        EXPECT_EQ(one.measured.range_m, other.measured.range_m);
        EXPECT_EQ(one.measured.velocity_mps, other.measured.velocity_mps);
      }
    }
  }
}

// Centres of clutter, uniform over 150 m and the 1 m/s of a clutter ridge, levels within some dB.
double false_tracks(double per_look, std::uint64_t seed, int sequences) {
  double tracks = 0;
  for (int i = 0; i < sequences; ++i) {
    Random random({.seed = seed, .index = static_cast<std::uint64_t>(i)});
    std::vector<Look> looks;
    for (int k = 0; k < 10; ++k) {
      looks.push_back({0.5 * k, {}});
      for (double more = per_look; random.uniform() < more; more -= 1)
        looks.back().centres.push_back(
            ideal_centre(150 * random.uniform(), random.uniform(), std::pow(10, 3 * random.normal() / 20)));
    }
    tracks += static_cast<double>(associate(looks).tracks.size());
  }
  return tracks / sequences;
}

TEST(Tracks, OfClutterAloneAreRarerThanOneInAHundredSequences) {
  for (const int per_look : {1, 2, 4, 8, 16}) {
    const double tracks = false_tracks(per_look, 6, 1000);
    RecordProperty(fmt::format("track_false_of_{}_per_hundred", per_look), fmt::format("{:.1f}", 100 * tracks));
    EXPECT_LE(tracks, 0.01) << per_look << " centres a look";
  }
}

TEST(Tracks, RefuseWhatIsNoMeasurement) {
  const std::vector<Look> none;
  EXPECT_TRUE(associate(none).tracks.empty());
  EXPECT_TRUE(associate(std::vector<Look>(1)).tracks.empty());
  EXPECT_THROW(associate(std::vector<Look>{{1, {}}, {1, {}}}), InputError);
  EXPECT_THROW(associate(std::vector<Look>{{kNan, {}}}), InputError);
  EXPECT_THROW(associate(std::vector<Look>{{0, {ideal_centre(kNan, 0)}}}), InputError);
  EXPECT_THROW(associate(std::vector<Look>{{0, {ideal_centre(0, kInfinity)}}}), InputError);
  EXPECT_THROW(associate(std::vector<Look>{{0, {ideal_centre(0, 0, 0)}}}), InputError);
  EXPECT_THROW(associate(std::vector<Look>{{0, {{{0, 0, 1}, 0, 0.01}}}}), InputError);
}

}  // namespace

}  // namespace seaglint
