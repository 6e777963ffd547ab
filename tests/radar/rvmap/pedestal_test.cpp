// SPDX-License-Identifier: BSD-3-Clause
// The random-hop pedestal of one point against its closed form, by averaging maps over many codes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "radar/echo/echo.h"
#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

constexpr double kPedestalTolerance = 0.5;  // dB: 3.6 standard errors of the mean of 1,000 exponential values
constexpr double kListRounding = 0.2;  // dB: the list gives one figure for both kinds of code, which differ by 0.13 dB
constexpr int kCodes = 1000;

struct Offset {
  double range_m, velocity_mps, balanced_db, random_db;
};
// Random hopping leaves a pedestal (radar/waveform/README.md).
constexpr Offset kListed[] = {
    {1.5, 1.757, -24.1, -24.1}, {0, 1, -34.3, -33.1}, {0, 5, -31.4, -30.7}, {2, 0, -18.09, -18.09}};

// Mean |RV|^2 at one offset from the point's peak over codes, and the mean of its closed form, from a map of one cell
// row.
struct Means {
  double measured = 0, expected = 0;
};
Means mean_response(const RadarSpec& radar, const Offset& offset, double window_m) {
  Means means;
  for (int i = 0; i < kCodes; ++i) {
    const PulseTrain train = make_pulse_train(radar, window_m, 77, i);
    // In the map's cell at 0, 0 the point is at minus the offset.
    const PointSpec point{{offset.range_m, 0, 0}, 1, {offset.velocity_mps, 0, 0}};
    ClutterSpec clutter;
    clutter.enabled = false;
    const Echo echo =
        synthesise_echo(train, point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0)), clutter, 1, 1);
    MapSpec spec;
    spec.range_taper = Taper::kNone;
    spec.range_span_m = spec.velocity_span_mps = 1e-3;
    const RvMap map = form_rv_map(echo.target, train, spec, false);
    EXPECT_EQ(map.values.size(), 1u);
    means.measured += std::norm(map.values[0]) / kCodes;
    means.expected += expected_response_power(train, offset.range_m, offset.velocity_mps) / kCodes;
  }
  return means;
}

double decibel(double power) { return 10 * std::log10(power); }

// One frequency per pulse, for which the closed form is exact.
TEST(Pedestal, OfOneFrequencyPerPulseIsTheClosedForm) {
  for (const HopCode code : {HopCode::kBalanced, HopCode::kRandom}) {
    for (const Offset& offset : kListed) {
      RadarSpec radar;
      radar.hop_code = code;
      const Means means = mean_response(radar, offset, 5.9);
      const double listed = code == HopCode::kBalanced ? offset.balanced_db : offset.random_db;
      std::printf("%s dR %.1f m dv %.3f m/s: measured %.2f, closed form %.2f, listed %.2f dB\n",
                  code == HopCode::kBalanced ? "balanced" : "random  ", offset.range_m, offset.velocity_mps,
                  decibel(means.measured), decibel(means.expected), listed);
      EXPECT_NEAR(decibel(means.measured), decibel(means.expected), kPedestalTolerance);
      EXPECT_NEAR(decibel(means.measured), listed, kPedestalTolerance);
      EXPECT_NEAR(decibel(means.expected), listed, kListRounding);
    }
  }
}

// 1,000 codes leave a standard error of 0.14 dB in a cell's mean, 40,000 leave 0.02 dB: the map's estimator, mean over
// each carrier's pulses, then over the carriers that were used, written out.
TEST(Pedestal, OfFortyThousandCodesIsTheClosedFormToATenthOfADecibel) {
  constexpr int kManyCodes = 40000;
  double worst_db = 0;
  for (const HopCode code : {HopCode::kBalanced, HopCode::kRandom}) {
    for (const Offset& offset : kListed) {
      RadarSpec radar;
      radar.hop_code = code;
      PulseTrain train = make_pulse_train(radar, 5.9, 77, 0);
      // e^{j phi} of every pulse on every carrier, and the closed form of one set of counts, which random codes change.
      std::vector<Complex> phasor(256 * 8);
      for (int n = 0; n < 256; ++n) {
        for (int i = 0; i < 8; ++i) {
          const double range = offset.range_m + offset.velocity_mps * train.time_s[n];
          phasor[8 * n + i] = std::polar(1.0, -4 * kPi * (16e9 + 25e6 * i) * range / kSpeedOfLight);
        }
      }
      double measured = 0, expected = 0;
      for (int repeat = 0; repeat < kManyCodes; ++repeat) {
        train.code = hop_code(code, 256, 8, 78, repeat);
        std::array<Complex, 8> sum{};
        std::array<int, 8> count{};
        for (int n = 0; n < 256; ++n) {
          sum[train.code[n]] += phasor[8 * n + train.code[n]];
          ++count[train.code[n]];
        }
        Complex mean;
        for (int i = 0; i < 8; ++i) mean += sum[i] / static_cast<double>(count[i]);  // 256 pulses leave none empty
        measured += std::norm(mean / 8.0) / kManyCodes;
        if (repeat % 100 == 0)
          expected += expected_response_power(train, offset.range_m, offset.velocity_mps) * 100 / kManyCodes;
      }
      std::printf("%s dR %.1f m dv %.3f m/s: %d codes %.3f, closed form %.3f dB\n",
                  code == HopCode::kBalanced ? "balanced" : "random  ", offset.range_m, offset.velocity_mps, kManyCodes,
                  decibel(measured), decibel(expected));
      EXPECT_NEAR(decibel(measured), decibel(expected), 0.1);
      worst_db = std::max(worst_db, std::abs(decibel(measured) - decibel(expected)));
    }
  }
  record_figure(worst_db, 3, "pedestal_db");
}

TEST(Pedestal, OfPulsesThatJitterIsTheClosedFormAtTheirTimes) {
  RadarSpec radar;
  radar.hop_code = HopCode::kBalanced;
  radar.pri_jitter_us = 100;
  for (const Offset& offset : {Offset{1.5, 1.757, 0, 0}, Offset{0, 5, 0, 0}}) {
    const Means means = mean_response(radar, offset, 5.9);
    std::printf("jitter   dR %.1f m dv %.3f m/s: measured %.2f, closed form %.2f dB\n", offset.range_m,
                offset.velocity_mps, decibel(means.measured), decibel(means.expected));
    EXPECT_NEAR(decibel(means.measured), decibel(means.expected), kPedestalTolerance);
  }
}

// The whole chirp: the pedestal is shaped in range by the chirp's own resolution, sinc^2(2 B dR / c).
TEST(Pedestal, OfTheWholeChirpFollowsTheRangeCellOfOnePulse) {
  for (const Offset& offset : {Offset{1.5, 1.757, 0, 0}, Offset{0, 5, 0, 0}, Offset{4, 3.3, 0, 0}}) {
    RadarSpec radar;
    radar.hop_code = HopCode::kBalanced;
    const Means means = mean_response(radar, offset, 59);
    // The range offset grows by dv t during the interval.
    double shape = 0;
    for (int n = 0; n < 256; ++n) {
      const double x = kPi * 2 * 25e6 * (offset.range_m + offset.velocity_mps * n * 250e-6) / kSpeedOfLight;
      shape += (x == 0 ? 1 : std::pow(std::sin(x) / x, 2)) / 256;
    }
    std::printf("whole chirp, dR %.1f m dv %.3f m/s: measured %.2f, closed form with range cell %.2f dB\n",
                offset.range_m, offset.velocity_mps, decibel(means.measured), decibel(means.expected * shape));
    EXPECT_NEAR(decibel(means.measured), decibel(means.expected * shape), kPedestalTolerance);
  }
}

TEST(Pedestal, IsAbsentAtTheVelocityOfThePoint) {
  const PulseTrain train = make_pulse_train({}, 59, 77, 1);
  const PointSpec point{{0, 0, 0}, 1, {0, 0, 0}};
  ClutterSpec clutter;
  clutter.enabled = false;
  const Echo echo =
      synthesise_echo(train, point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0)), clutter, 1, 1);
  MapSpec spec;
  spec.range_taper = Taper::kNone;
  spec.velocity_span_mps = 1e-3;
  const RvMap map = form_rv_map(echo.target, train, spec, false);
  for (std::size_t r = 0; r < map.columns(); ++r) {
    const double expected = map.range_m[r] == 0 ? 1 : 0;   // the Dirichlet kernel at its zeros
    EXPECT_NEAR(std::abs(map.values[r]), expected, 1e-6);  // -120 dB
  }
}

}  // namespace
}  // namespace seaglint
