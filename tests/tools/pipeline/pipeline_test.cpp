// SPDX-License-Identifier: BSD-3-Clause
// One sample: the truth in its columns, the products of its interval (with the whole synthetic bandwidth in every pulse
// there is no pedestal, and the target's own motion), and its interruption.
#include "tools/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tests/relative_difference.h"

namespace seaglint {
namespace {

// One point of 2 m, 30 m nearer than the reference point, approaching at 1.5 m/s, viewed from ahead.
const char* const kOnePoint = R"(
seaglint: 1
radar: {pulses: 64}
view: {azimuth_deg: 0, elevation_deg: 0}
targets: {point: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.5, 0, 0]}]}}
map: {range_oversampling: 4, velocity_oversampling: 4}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)";

struct Peak {
  double range_m = 0, velocity_mps = 0, magnitude_m = 0;
};

Peak peak_of(const RvMap& map) {
  Peak peak;
  for (std::size_t v = 0; v < map.velocity_mps.size(); ++v) {
    for (std::size_t r = 0; r < map.columns(); ++r) {
      if (std::abs(map.at(v, r)) > peak.magnitude_m)
        peak = {map.range_m[r], map.velocity_mps[v], std::abs(map.at(v, r))};
    }
  }
  return peak;
}

TEST(FullBand, ImageHasThePointAndNoPedestal) {
  const Pipeline pipeline(parse_scenario(kOnePoint, "point.yaml"));
  const FullBandInterval band = full_band_interval(pipeline, 0);
  const PulseTrain hopping = make_pulse_train(pipeline.scenario().radar, pipeline.window_m(), 42, 0);
  EXPECT_NEAR(band.train.band_centre_hz(), hopping.band_centre_hz(), 1);
  EXPECT_NEAR(band.train.synthetic_bandwidth_hz(), hopping.synthetic_bandwidth_hz(), 1);
  const Peak peak = peak_of(band.image);
  const double cell_m = band.train.range_resolution_m() / 4, cell_mps = band.train.velocity_resolution_mps() / 4;
  EXPECT_NEAR(peak.range_m, -30, cell_m / 2 + 1e-9);
  EXPECT_NEAR(peak.velocity_mps, -1.5, cell_mps / 2 + 1e-9);
  EXPECT_NEAR(peak.magnitude_m, 2, 0.1);  // an eighth of a lobe off its peak, in range and velocity
  // More than two lobes of the Hann taper from the point only the velocity sidelobes remain, at its range and -13 dB or
  // less.
  for (std::size_t v = 0; v < band.image.velocity_mps.size(); ++v) {
    for (std::size_t r = 0; r < band.image.columns(); ++r) {
      if (std::abs(band.image.range_m[r] + 30) > 6) {
        EXPECT_LT(std::abs(band.image.at(v, r)), 2e-2 * peak.magnitude_m);
      }
    }
  }
}

TEST(FullBand, FollowsUncompensatedPlatformMotion) {
  const char* const moving = "platform: {velocity_mps: [0.8, 0, 0], motion_compensated: ";
  double step_mps = 0;
  const auto velocity = [&](const char* compensated) {
    std::string text = kOnePoint;
    text.replace(text.find("pulses: 64"), 10, std::string("pulses: 64, ") + moving + compensated + "}");
    const FullBandInterval band = full_band_interval(Pipeline(parse_scenario(text, "point.yaml")), 0);
    step_mps = band.image.velocity_mps[1] - band.image.velocity_mps[0];
    return peak_of(band.image).velocity_mps;
  };
  // A radar ahead that recedes from the target; each peak lies on the map's cells.
  const double difference = velocity("false") - velocity("true");
  EXPECT_NEAR(difference, 0.8, step_mps);
}

TEST(RangeProfiles, FollowThePoint) {
  const Pipeline pipeline(parse_scenario(kOnePoint, "point.yaml"));
  const RangeProfiles profiles = range_profiles(full_band_interval(pipeline, 0), pipeline.scenario().map);
  ASSERT_EQ(profiles.time_s.size(), 64u);
  const std::size_t cells = profiles.range_m.size();
  ASSERT_EQ(profiles.magnitude_m.size(), 64 * cells);
  for (const std::size_t n : {0u, 63u}) {
    const auto begin = profiles.magnitude_m.begin() + static_cast<std::ptrdiff_t>(n * cells);
    const auto top = std::max_element(begin, begin + static_cast<std::ptrdiff_t>(cells));
    EXPECT_NEAR(profiles.range_m[static_cast<std::size_t>(top - begin)], -30 - 1.5 * profiles.time_s[n],
                0.5 * 0.7495 / 4 + 1e-9);
    EXPECT_NEAR(*top, 2, 0.1);
  }
}

// The samples over time are of one solution on their finer grid of frequencies, of which the map's are a part.
TEST(SampledInterval, HasTheColumnsAndTheSpectrumOfTheSamplesMap) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 32}
sea: {significant_wave_height_m: 1, components: 64}
targets:
  reflector: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)",
                                         "reflector.yaml"));
  constexpr double kBand = 1e-4;  // the solver's interpolation over a band whose ends are off by less than a step
  const SampledInterval interval = sampled_interval(pipeline, 0);
  const SampleRecord record = pipeline.generate_sample(0).stored.record;
  EXPECT_NEAR(interval.record.scr_per_pulse_db, record.scr_per_pulse_db, 1e-6);
  EXPECT_NEAR(interval.record.peak_m, record.peak_m, kBand * record.peak_m);
  EXPECT_EQ(interval.record.centres, record.centres);
  const PulseTrain train = pipeline.pulse_train(0);
  std::vector<Complex> expected = pipeline.response(pipeline.plan().address(0), train).response.values;
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] *= train.chirp_spectrum[i % train.frequencies()];
  EXPECT_LT(relative_difference(spectrum_of(interval.target, train), expected), kBand);
}

TEST(MotionColumns, AreTheFirstBodysMotionInMidInterval) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 64, pri_jitter_us: 10}
sea: {significant_wave_height_m: 2, components: 64}
targets:
  array: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float, translations: true, yaw_rate_std_deg_s: 3},
          layout: {line: {count: 2}}}
  points: {label: 1, points: [{position_m: [0, 0, 0], velocity_mps: [1, 0, 0]}]}
dataset: {maps_per_case: 2, realisations_per_case: 1}
)",
                                         "columns.yaml"));
  SampleAddress at;
  at.interval = 1;
  const std::size_t sample = pipeline.plan().sample(at);
  const SampleRecord record = pipeline.generate_sample(sample).stored.record;
  const PulseTrain train = pipeline.pulse_train(sample);
  const double middle_s = record.start_s + 0.5 * (train.time_s.front() + train.time_s.back());
  const Trajectory& first = pipeline.scene(0, 0)->bodies[0].front();
  const auto at_time = [&](double t) {
    const MotionSample motion = first.sample(t);
    return std::array{degrees(motion.angles.x()), degrees(motion.angles.y()), degrees(motion.angles.z()),
                      motion.translation.z()};
  };
  const std::array stored{record.roll_deg, record.pitch_deg, record.yaw_deg, record.heave_m};
  const std::array rates{record.roll_rate_deg_s, record.pitch_rate_deg_s, record.yaw_rate_deg_s, record.heave_rate_mps};
  EXPECT_EQ(stored, at_time(middle_s));
  constexpr double kStep = 1e-4;  // s; the central difference of the cubic, with (kStep w)^2 / 6 of the rate
  for (std::size_t i = 0; i < 4; ++i) {
    const double rate = (at_time(middle_s + kStep)[i] - at_time(middle_s - kStep)[i]) / (2 * kStep);
    EXPECT_NE(rate, 0);
    EXPECT_NEAR(rates[i], rate, 1e-5 * std::abs(rate) + 1e-9) << i;
  }

  at.target = 1;
  const SampleRecord points = pipeline.generate_sample(pipeline.plan().sample(at)).stored.record;
  EXPECT_EQ(points.roll_deg, 0);
  EXPECT_EQ(points.heave_rate_mps, 0);
}

TEST(StoppedSample, ThrowsAndLeavesThePipelineAsItWas) {
  const Scenario scenario = parse_scenario(R"(
seaglint: 1
radar: {pulses: 16}
targets:
  reflector: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)",
                                           "reflector.yaml");
  const Pipeline stopped(scenario), undisturbed(scenario);
  const StopFlag stop = true;
  EXPECT_THROW(stopped.generate_sample(0, &stop), Interrupted);
  EXPECT_EQ(stopped.generate_sample(0).received.map.values, undisturbed.generate_sample(0).received.map.values);
}

}  // namespace
}  // namespace seaglint
