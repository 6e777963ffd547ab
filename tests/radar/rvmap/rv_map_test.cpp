// SPDX-License-Identifier: BSD-3-Clause
#include "radar/rvmap/rv_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "radar/echo/echo.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "tests/map_levels.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

// The map against its definition and against closed forms of one point.

constexpr double kShipWindow = 239.8;

MapSpec untapered() {
  MapSpec spec;
  spec.range_taper = Taper::kNone;
  return spec;
}

// The echo of points on the line of sight: range and velocity at which the map contains them.
struct MovingPoint {
  double range_m, velocity_mps, amplitude_m;
};
std::vector<Complex> echo_of(const PulseTrain& train, const std::vector<MovingPoint>& points) {
  std::vector<PointSpec> specs;
  for (const MovingPoint& p : points) specs.push_back({{-p.range_m, 0, 0}, p.amplitude_m, {-p.velocity_mps, 0, 0}});
  ClutterSpec clutter;
  clutter.enabled = false;
  return synthesise_echo(train, point_response(specs, Vec3(1, 0, 0), interval_sampling(train, 0)), clutter, 1, 1)
      .target;
}

// One cell of the map directly from the definition (radar/rvmap/README.md): compress, compensate, mean over each
// carrier's pulses, inverse transform over the synthesised band; the band's centre is the phase reference.
Complex by_definition(const std::vector<Complex>& echo, const PulseTrain& train, const MapSpec& spec, bool intra_pulse,
                      double range_m, double velocity_mps) {
  const std::size_t frequencies = train.frequencies();
  std::vector<Complex> band(train.band_bins());
  std::vector<double> covering(train.band_bins());
  std::vector<double> gain(train.band_bins());  // of a point through the compression filter
  const std::vector<double> slow = taper_samples(spec.velocity_taper, train.pulses());
  const std::vector<double> fast = taper_samples(spec.range_taper, band.size());
  double mean_power_of_p = 0;
  for (const Complex& p : train.chirp_spectrum) mean_power_of_p += std::norm(p) / static_cast<double>(frequencies);
  for (int i = 0; i < train.carriers; ++i) {
    double weight = 0;
    for (std::size_t n = 0; n < train.pulses(); ++n) weight += train.code[n] == i ? slow[n] : 0;
    if (weight == 0) continue;
    for (std::size_t b = 0; b < frequencies; ++b) {
      const double f =
          train.carrier_hz.empty() ? 0 : train.first_carrier_hz + i * train.hop_step_hz + train.baseband_hz[b];
      Complex sum;
      for (std::size_t n = 0; n < train.pulses(); ++n) {
        if (train.code[n] != i) continue;
        const Complex p = train.chirp_spectrum[b];
        const Complex x = std::conj(p) * echo[n * frequencies + b] /
                          (spec.compression == Compression::kInverse ? std::norm(p) : mean_power_of_p);
        const double t = train.time_s[n] + (intra_pulse ? train.baseband_hz[b] / train.chirp_rate_hz_s : 0);
        sum += slow[n] * x * std::polar(1.0, 4 * kPi * f * velocity_mps * t / kSpeedOfLight);
      }
      band[i * train.bins_per_hop + b] += sum / weight;
      covering[i * train.bins_per_hop + b] += 1;
      gain[i * train.bins_per_hop + b] +=
          spec.compression == Compression::kInverse ? 1 : std::norm(train.chirp_spectrum[b]) / mean_power_of_p;
    }
  }
  Complex value;
  double total = 0;
  for (std::size_t k = 0; k < band.size(); ++k) {
    if (covering[k] == 0) continue;
    total += fast[k] * gain[k] / covering[k];
    const double offset_hz =
        (static_cast<double>(k) - 0.5 * (static_cast<double>(band.size()) - 1)) * train.baseband_step_hz;
    value += fast[k] * band[k] / covering[k] * std::polar(1.0, 4 * kPi * offset_hz * range_m / kSpeedOfLight);
  }
  return value / total;
}

std::vector<Complex> random_echo(const PulseTrain& train, std::uint64_t index) {
  Random random({99, Stream::kTest, index});
  std::vector<Complex> echo(train.pulses() * train.frequencies());
  for (Complex& value : echo) {
    const double re = random.normal();
    value = {re, random.normal()};
  }
  return echo;
}

struct Case {
  const char* what;
  RadarSpec radar;
  MapSpec map;
};

std::vector<Case> cases() {
  std::vector<Case> list(1, {"the paper's radar", {}, {}});
  Case holes{"few pulses on many carriers: holes", {}, {}};
  holes.radar.pulses = 24;
  holes.radar.carrier_count = 16;
  holes.map.velocity_taper = Taper::kHamming;
  list.push_back(holes);
  Case gaps{"chirp narrower than the step", {}, {}};
  gaps.radar.bandwidth_mhz = 14;
  gaps.map.range_oversampling = 2.3;
  gaps.map.velocity_oversampling = 1.7;
  list.push_back(gaps);
  Case overlap{"chirp wider than the step", {}, {}};
  overlap.radar.bandwidth_mhz = 60;
  overlap.radar.sampling_mhz = 100;
  overlap.map.range_taper = Taper::kTaylor;
  list.push_back(overlap);
  Case matched{"matched filter, stepped code", {}, {}};
  matched.radar.hop_code = HopCode::kStepped;
  matched.map.compression = Compression::kMatched;
  matched.map.velocity_taper = Taper::kHann;
  list.push_back(matched);
  Case single{"one pulse", {}, {}};
  single.radar.pulses = 1;
  list.push_back(single);
  return list;
}

TEST(RvMap, AgreesWithTheDefinitionSummedDirectly) {
  double worst = 0;
  for (Case c : cases()) {
    for (const bool intra_pulse : {false, true}) {
      c.radar.intra_pulse_motion = intra_pulse;
      const PulseTrain train = make_pulse_train(c.radar, kShipWindow, 1, 2);
      const std::vector<Complex> echo = random_echo(train, 1);
      const RvMap map = form_rv_map(echo, train, c.map, intra_pulse);
      const double scale = peak_of(map).level;
      for (std::size_t i = 0; i < 12; ++i) {
        const std::size_t v = i * (map.velocity_mps.size() - 1) / 11, r = (i * 7919) % map.columns();
        const Complex expected = by_definition(echo, train, c.map, intra_pulse, map.range_m[r], map.velocity_mps[v]);
        const double error = std::abs(map.at(v, r) - expected) / scale;
        worst = std::max(worst, error);
        EXPECT_LT(error, 1e-9) << c.what << ", intra-pulse " << intra_pulse << ", v " << map.velocity_mps[v] << ", r "
                               << map.range_m[r];
      }
    }
  }
  std::printf("worst relative error %.1e\n", worst);
}

TEST(RvMap, CountsCarriersThatNoPulseUsed) {
  RadarSpec radar;
  radar.pulses = 24;
  radar.carrier_count = 16;
  const PulseTrain train = make_pulse_train(radar, kShipWindow, 1, 2);
  std::vector<int> count(16);
  for (const int c : train.code) ++count[c];
  const int expected = static_cast<int>(std::count(count.begin(), count.end(), 0));
  ASSERT_GT(expected, 0);
  EXPECT_EQ(form_rv_map(random_echo(train, 1), train, {}, false).unused_carriers, expected);
}

TEST(RvMap, APointPeaksInItsCellWithItsAmplitudeWhetherItApproachesOrRecedes) {
  for (const HopCode code : {HopCode::kRandom, HopCode::kBalanced, HopCode::kStepped}) {
    RadarSpec radar;
    radar.hop_code = code;
    const PulseTrain train = make_pulse_train(radar, kShipWindow, 1, 2);
    const double dr = train.range_resolution_m(), dv = train.velocity_resolution_mps();
    for (const MovingPoint& point : {MovingPoint{40 * dr, 5 * dv, 3}, MovingPoint{-61 * dr, -20 * dv, 0.2}}) {
      for (const Taper taper : {Taper::kNone, Taper::kHann, Taper::kHamming, Taper::kTaylor}) {
        MapSpec spec;
        spec.compression = taper == Taper::kHamming ? Compression::kMatched : Compression::kInverse;
        spec.range_taper = taper;
        spec.velocity_taper = taper;
        const Peak peak = peak_of(form_rv_map(echo_of(train, {point}), train, spec, false));
        EXPECT_NEAR(peak.range_m, point.range_m, 1e-9);
        EXPECT_NEAR(peak.velocity_mps, point.velocity_mps, 1e-9);
        EXPECT_NEAR(peak.level, point.amplitude_m, 1e-9 * point.amplitude_m);
      }
    }
  }
}

TEST(RvMap, ThePhaseOfAPeakIsThatOfThePointAtTheBandsCentre) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  const double range_m = 40 * train.range_resolution_m();
  const Peak peak = peak_of(form_rv_map(echo_of(train, {{range_m, 0, 1}}), train, {}, false));
  const Complex expected = std::polar(1.0, -4 * kPi * train.band_centre_hz() * range_m / kSpeedOfLight);
  EXPECT_NEAR(std::abs(peak.value - expected), 0, 1e-9);
}

TEST(CompressedPulses, FollowThePhaseOfAPointOverTheWholeInterval) {
  for (const bool intra_pulse_motion : {false, true}) {
    RadarSpec radar;
    radar.intra_pulse_motion = intra_pulse_motion;
    radar.pri_jitter_us = 50;
    const PulseTrain train = make_pulse_train(radar, 239.8, 1, 2);
    const PointSpec point{{-31, 0, 0}, 1, {-7, 0, 0}};
    ClutterSpec off;
    off.enabled = false;
    const Echo echo =
        synthesise_echo(train, point_response({&point, 1}, Vec3(1, 0, 0), interval_sampling(train, 0)), off, 1, 1);
    const std::vector<Complex> compressed = compress_pulses(echo.target, train, Compression::kInverse);
    double worst = 0;
    for (std::size_t n = 0; n < train.pulses(); ++n) {
      for (std::size_t b = 0; b < train.frequencies(); ++b) {
        const double f = train.carrier_hz[n] + train.baseband_hz[b];
        const double t = train.time_s[n] + (intra_pulse_motion ? train.baseband_hz[b] / train.chirp_rate_hz_s : 0);
        const Complex law = std::polar(1.0, -4 * kPi * f * (31 + 7 * t) / kSpeedOfLight);
        worst = std::max(worst, std::abs(std::arg(compressed[n * train.frequencies() + b] / law)));
      }
    }
    std::printf("phase over the interval: worst error %.1e rad\n", worst);
    EXPECT_LT(worst, 1e-9);  // 20,000 rad of phase carry 20,000 eps
  }
}

TEST(RvMap, FastPointsHaveNoRangeMigrationLoss) {
  // 15 m/s: 0.96 m of migration, more than a cell, and a Doppler that differs by 1.25 % over the band.
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  MapSpec spec;
  spec.velocity_span_mps = 37;
  const double velocity = std::round(15 / train.velocity_resolution_mps()) * train.velocity_resolution_mps();
  const Peak peak = peak_of(form_rv_map(echo_of(train, {{0, velocity, 1}}), train, spec, false));
  EXPECT_NEAR(peak.level, 1, 1e-9);
  EXPECT_NEAR(peak.velocity_mps, velocity, 1e-9);
}

// Untapered stepped band: |sin(pi K x / K') / (K sin(pi x / K'))| in range, K bins; its width at half a cell and its
// zeros.
TEST(RvMap, RangeCutIsTheDirichletKernelOfTheBand) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  MapSpec spec = untapered();
  spec.range_oversampling = 8;
  const RvMap map = form_rv_map(echo_of(train, {{0, 0, 1}}), train, spec, false);
  const std::size_t rest = map.velocity_mps.size() / 2;
  const double dr = 2.99792458e8 / 2 / 200e6;
  record_figure(train.range_resolution_m(), 4, "range_resolution_m");
  record_figure(train.velocity_resolution_mps(), 4, "velocity_resolution_mps");
  double worst = 0;
  for (std::size_t r = 0; r < map.columns(); ++r) {
    const double x = map.range_m[r] / dr;
    const double expected = std::abs(x) < 1e-9 ? 1 : std::abs(std::sin(kPi * x) / (320 * std::sin(kPi * x / 320)));
    worst = std::max(worst, std::abs(std::abs(map.at(rest, r)) - expected));
    if (std::abs(std::abs(x) - 0.5) < 1e-6) {
      EXPECT_NEAR(20 * std::log10(std::abs(map.at(rest, r))), -3.92, 0.01);
    }
    if (std::abs(std::abs(x) - 1) < 1e-6) {
      EXPECT_LT(std::abs(map.at(rest, r)), 1e-9);
      EXPECT_NEAR(std::abs(map.range_m[r]), 0.75, 0.001);
    }
  }
  EXPECT_LT(worst, 1e-6);  // -120 dB
}

TEST(RvMap, VelocityCutOfOneCarrierIsTheDirichletKernelOfTheInterval) {
  RadarSpec radar;
  radar.carrier_count = 1;
  const PulseTrain train = make_pulse_train(radar, kShipWindow, 1, 2);
  MapSpec spec = untapered();
  spec.velocity_oversampling = 8;
  const RvMap map = form_rv_map(echo_of(train, {{0, 0, 1}}), train, spec, false);
  const std::size_t middle = map.columns() / 2;
  for (std::size_t v = 0; v < map.velocity_mps.size(); ++v) {
    const double x = map.velocity_mps[v] / train.velocity_resolution_mps();
    // The 25 MHz band changes the Doppler by 0.08 %: at 4.7 m/s the zeros move by 0.03 cells, smeared over the band.
    const double migration = std::abs(x) * 25 / 16000.0 * 2;
    const double expected = std::abs(x) < 1e-9 ? 1 : std::abs(std::sin(kPi * x) / (256 * std::sin(kPi * x / 256)));
    EXPECT_NEAR(std::abs(map.at(v, middle)), expected, 1e-9 + migration / std::max(1.0, std::abs(x)));
    if (std::abs(std::abs(x) - 0.5) < 1e-6) {
      EXPECT_NEAR(20 * std::log10(std::abs(map.at(v, middle))), -3.92, 0.01);
    }
  }
}

TEST(RvMap, TwoPointsAtTheResolutionLimitAreResolved) {
  RadarSpec radar;
  radar.hop_code = HopCode::kBalanced;
  const PulseTrain train = make_pulse_train(radar, kShipWindow, 1, 2);
  const double dr = train.range_resolution_m(), dv = train.velocity_resolution_mps();
  MapSpec spec = untapered();
  spec.range_oversampling = spec.velocity_oversampling = 4;
  const auto level = [](const RvMap& map, double range_m, double velocity_mps) {
    const auto r =
        static_cast<std::size_t>(std::lround((range_m - map.range_m[0]) / (map.range_m[1] - map.range_m[0])));
    const auto v = static_cast<std::size_t>(
        std::lround((velocity_mps - map.velocity_mps[0]) / (map.velocity_mps[1] - map.velocity_mps[0])));
    return std::abs(map.at(v, r));
  };
  // In quadrature at the band's centre, so that their sum in the middle depends on magnitudes: 0.64 sqrt 2 = 0.9.
  const double quadrature = kSpeedOfLight / train.band_centre_hz() / 8;
  const double distance = std::round(1.25 * dr / (4 * quadrature)) * 4 * quadrature + quadrature;
  const RvMap ranges = form_rv_map(echo_of(train, {{-distance / 2, 0, 1}, {distance / 2, 0, 1}}), train, spec, false);
  EXPECT_LT(level(ranges, 0, 0), 0.9 * level(ranges, distance / 2, 0));
  EXPECT_LT(level(ranges, 0, 0), 0.9 * level(ranges, -distance / 2, 0));
  const RvMap velocities =
      form_rv_map(echo_of(train, {{0, -0.75 * dv, 1}, {quadrature, 0.75 * dv, 1}}), train, spec, false);
  EXPECT_LT(level(velocities, 0, 0), 0.9 * level(velocities, 0, 0.75 * dv));
  EXPECT_LT(level(velocities, 0, 0), 0.9 * level(velocities, 0, -0.75 * dv));
}

TEST(RvMap, IsLinear) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  const std::vector<Complex> a = random_echo(train, 1), b = random_echo(train, 2);
  std::vector<Complex> sum(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] = Complex(2, -1) * a[i] + b[i];
  const RvMap of_a = form_rv_map(a, train, {}, false), of_b = form_rv_map(b, train, {}, false),
              of_sum = form_rv_map(sum, train, {}, false);
  for (std::size_t i = 0; i < of_sum.values.size(); ++i)
    EXPECT_NEAR(std::abs(of_sum.values[i] - (Complex(2, -1) * of_a.values[i] + of_b.values[i])), 0, 1e-12);
}

TEST(RvMap, KeepsTheEnergyOfTheSynthesisedBandByParseval) {
  // Over the whole window at one velocity: mean_r |RV|^2 = sum_k |u_k S_k|^2; at v = 0 S_k is the mean of the carrier's
  // pulses.
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  MapSpec spec = untapered();
  spec.range_span_m = 1000;
  const std::vector<Complex> echo = random_echo(train, 3);
  const RvMap map = form_rv_map(echo, train, spec, false);
  ASSERT_EQ(map.columns(), 320u);
  double in_map = 0, in_band = 0;
  for (std::size_t r = 0; r < 320; ++r) in_map += std::norm(map.at(map.velocity_mps.size() / 2, r)) / 320;
  for (int i = 0; i < 8; ++i) {
    for (std::size_t b = 0; b < 40; ++b) {
      Complex sum;
      double count = 0;
      for (std::size_t n = 0; n < 256; ++n) {
        if (train.code[n] != i) continue;
        sum += echo[n * 40 + b] / train.chirp_spectrum[b];
        ++count;
      }
      in_band += std::norm(sum / count / 320.0);
    }
  }
  EXPECT_NEAR(in_map / in_band, 1, 1e-11);
}

TEST(RvMap, IntraPulseMotionMustBeTheSameInEchoAndMap) {
  RadarSpec radar;
  radar.intra_pulse_motion = true;
  const PulseTrain sweeping = make_pulse_train(radar, kShipWindow, 1, 2);
  const double velocity = 100 * sweeping.velocity_resolution_mps();
  MapSpec spec;
  spec.velocity_span_mps = 37;
  const std::vector<Complex> echo = echo_of(sweeping, {{0, velocity, 1}});
  EXPECT_NEAR(peak_of(form_rv_map(echo, sweeping, spec, true)).level, 1, 1e-9);
  // Without compensation f/mu is a phase slope of 4 pi f_c v / (mu c) over each pulse's band: a range shift of f_c v /
  // mu = 0.34 m that the synthesised band cannot compress.
  EXPECT_LT(peak_of(form_rv_map(echo, sweeping, spec, false)).level, 0.999);
}

TEST(RvMap, SpansBeyondTheWindowAndTheAmbiguityAreCutThere) {
  const PulseTrain train = make_pulse_train({}, kShipWindow, 1, 2);
  MapSpec spec;
  spec.range_span_m = 1e6;
  spec.velocity_span_mps = 1e6;
  const MapGrid axes = map_grid(train, spec);
  EXPECT_EQ(axes.range_m.size(), 320u);
  EXPECT_EQ(axes.velocity_mps.size(), 256u);
  EXPECT_NEAR(axes.velocity_mps.front(), -train.unambiguous_velocity_mps(), 1e-9);
  EXPECT_EQ(axes.range_m[160], 0);
  EXPECT_EQ(axes.velocity_mps[128], 0);
}

Echo echo_with_clutter(const PulseTrain& train, const ClutterSpec& clutter) {
  const double dr = train.range_resolution_m();
  const PointSpec points[] = {{{-10 * dr, 0, 0}, 1, {0, 0, 0}}, {{20 * dr, 0, 0}, 0.7, {0, 0, 0}}};
  return synthesise_echo(train, point_response(points, Vec3(1, 0, 0), interval_sampling(train, 0)), clutter, 5, 6);
}

TEST(Scr, TheSelectedDefinitionIsExactAndAllThreeAreMeasured) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  for (const ScrDefinition definition : {ScrDefinition::kPerPulse, ScrDefinition::kPeakCell, ScrDefinition::kExtent}) {
    ClutterSpec clutter;
    clutter.scr_definition = definition;
    clutter.cnr_db = 200;  // the interval contains only target and clutter
    const Echo echo = echo_with_clutter(train, clutter);
    const ReceivedInterval received = form_received_interval(echo, train, clutter, {}, false);
    // Recomputed from the received signal: the target is known, the rest is clutter.
    std::vector<Complex> rest = received.echo;
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= echo.target[i];
    const RvMap target = form_rv_map(echo.target, train, {}, false), disturbance = form_rv_map(rest, train, {}, false);
    double peak = 0;
    for (const Complex& value : target.values) peak = std::max(peak, std::norm(value));
    const double per_pulse = 10 * std::log10(mean_power(echo.target) / mean_power(rest));
    const double peak_cell = 10 * std::log10(peak / mean_power(disturbance.values));
    EXPECT_NEAR(received.scr.per_pulse_db, per_pulse, 1e-6);
    EXPECT_NEAR(received.scr.peak_cell_db, peak_cell, 1e-6);
    if (definition == ScrDefinition::kPerPulse) {
      EXPECT_NEAR(per_pulse, 20, 1e-6);
    }
    if (definition == ScrDefinition::kPeakCell) {
      EXPECT_NEAR(peak_cell, 20, 1e-6);
    }
    if (definition == ScrDefinition::kExtent) {
      EXPECT_NEAR(received.scr.scr_extent_db, 20, 1e-6);
    }
    EXPECT_GT(received.scr.peak_cell_db, received.scr.scr_extent_db);
    EXPECT_GT(received.scr.peak_cell_db, received.scr.per_pulse_db + 20);  // the map integrates what a pulse spreads
  }
}

TEST(Scr, TheReceivedMapIsTheMapOfTheReceivedEcho) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  const ReceivedInterval received = form_received_interval(echo_with_clutter(train, {}), train, {}, {}, false);
  const RvMap again = form_rv_map(received.echo, train, {}, false);
  for (std::size_t i = 0; i < again.values.size(); ++i)
    EXPECT_NEAR(std::abs(again.values[i] - received.map.values[i]), 0, 1e-12);
}

// Without a target there is no ratio to it, and an absolute level remains as it is.
TEST(Scr, OfNoTargetIsNaN) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  ClutterSpec clutter;
  clutter.level = ClutterLevel::kNrl;
  Echo echo = echo_with_clutter(train, {});
  std::ranges::fill(echo.target, Complex());
  const ReceivedInterval received = form_received_interval(echo, train, clutter, {}, false);
  for (const double ratio : {received.scr.per_pulse_db, received.scr.peak_cell_db, received.scr.scr_extent_db,
                             received.scr.snr_per_pulse_db})
    EXPECT_TRUE(std::isnan(ratio));
  EXPECT_EQ(received.clutter_power_m2, mean_power(echo.clutter));
  EXPECT_EQ(received.noise_power_m2, mean_power(echo.noise));
  EXPECT_NEAR(mean_power(received.echo) / (received.clutter_power_m2 + received.noise_power_m2), 1, 0.05);
  std::ranges::fill(echo.clutter, Complex());
  EXPECT_THROW(form_received_interval(echo, train, clutter, {}, false), InputError);
}

TEST(Scr, TheTargetsExtentContainsItsTwoPoints) {
  const PulseTrain train = make_pulse_train({}, 239.8, 1, 2);
  ClutterSpec off;
  off.enabled = false;
  const ReceivedInterval received = form_received_interval(echo_with_clutter(train, off), train, off, {}, false);
  EXPECT_TRUE(std::isnan(received.scr.per_pulse_db));
  const MapExtent box = target_extent(received.map);
  const double dr = train.range_resolution_m();
  EXPECT_NEAR(received.map.range_m[box.range_first], -20 * dr,
              1.01 * dr);  // Hann: neighbours of the peak are 6 dB below it
  EXPECT_NEAR(received.map.range_m[box.range_last], 10 * dr, 1.01 * dr);
  EXPECT_LE(box.velocity_last - box.velocity_first, 2u);
}

}  // namespace
}  // namespace seaglint
