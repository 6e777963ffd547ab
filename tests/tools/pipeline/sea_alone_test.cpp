// SPDX-License-Identifier: BSD-3-Clause
// A scene without targets: its echo is clutter and noise of absolute level, whatever made of it.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radar/echo/echo.h"
#include "sim/core/numbers/constants.h"
#include "tests/refusal.h"
#include "tools/pipeline/imaging.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/scenario_check.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// 16 GHz, 1 deg, 15 km, waves of 2 m; one carrier; 197.9 m by 236.5 m of the sea in every pulse.
Scenario sea_alone(const std::string& targets = "{}", const std::vector<Override>& overrides = {}) {
  return parse_scenario(
      "seaglint: 1\nradar: {hop_count: 1, pulses: 64, pulse_width_us: 2, range_km: 15, link_budget: {beamwidth_deg: "
      "1.2}}\nview: {azimuth_deg: 0, elevation_deg: 1}\nsea: {significant_wave_height_m: 2, peak_period_s: 8, "
      "propagation_deg: 0}\ntargets: " +
          targets +
          "\nclutter: {level: nrl, texture_shape: 1000, doppler_spread_mps: 2, noise_level: thermal}\n"
          "dataset: {maps_per_case: 100, realisations_per_case: 50}\n",
      "sea.yaml", overrides);
}

Echo echo_of_sample(const Pipeline& pipeline, std::size_t sample) {
  const PulseTrain train = pipeline.pulse_train(sample);
  return pipeline.echo(sample, train, pipeline.response(pipeline.plan().address(sample), train),
                       pipeline.scenario().clutter);
}

// mean |H|^2 = sigma0 A / (4 pi) with the -34.01 dB of the model at this angle and height, within the standard error of
// 100 maps; Y = P H.
TEST(SeaAlone, HasThePowerOfItsReflectivity) {
  const Pipeline pipeline(sea_alone());
  std::vector<double> powers;
  for (std::size_t sample = 0; sample < pipeline.plan().size(); ++sample) {
    const Echo echo = echo_of_sample(pipeline, sample);
    EXPECT_THAT(echo.target, Each(Complex()));
    powers.push_back(mean_power(echo.clutter) / mean_power(pipeline.pulse_train(sample).chirp_spectrum));
  }
  double mean = 0, variance = 0;
  for (const double power : powers) mean += power / static_cast<double>(powers.size());
  for (const double power : powers)
    variance += (power - mean) * (power - mean) / static_cast<double>(powers.size() - 1);
  const double error = std::sqrt(variance / static_cast<double>(powers.size()));
  const double expected = std::pow(10, -3.401) * 197.9 * 236.5 / (4 * kPi);
  EXPECT_LT(error, 0.02 * expected);
  EXPECT_NEAR(mean, expected, 4 * error);
}

// Clutter and noise are, to the bit, those beside a target in the same scene.
TEST(SeaAlone, IsWhatATargetIsIn) {
  const Pipeline alone(sea_alone()),
      beside(sea_alone("{point: {label: 0, points: [{position_m: [0, 0, 0], amplitude_m: 3}]}}"));
  for (const std::size_t sample : {0u, 7u}) {
    const Echo sea = echo_of_sample(alone, sample), both = echo_of_sample(beside, sample);
    EXPECT_EQ(sea.clutter, both.clutter);
    EXPECT_EQ(sea.noise, both.noise);
  }
}

TEST(SeaAlone, HasSamplesWithoutRatiosToATarget) {
  const Pipeline pipeline(sea_alone());
  const GeneratedSample made = pipeline.generate_sample(3);
  const SampleRecord& record = made.stored.record;
  EXPECT_EQ(record.target_name, "sea");
  EXPECT_EQ(record.label, 0);
  EXPECT_EQ(record.bodies, 0);
  for (const double ratio :
       {record.scr_per_pulse_db, record.scr_peak_cell_db, record.scr_extent_db, record.snr_per_pulse_db})
    EXPECT_TRUE(std::isnan(ratio));
  EXPECT_GT(record.energy_m2, 0);
  EXPECT_TRUE(std::isfinite(record.mwr));
  EXPECT_EQ(made.stored.magnitude, pipeline.generate_sample(3).stored.magnitude);
}

// Over time it has the powers that its map has, without a map being made: of the same clutter, and of other noise
// within its standard error of 2 %.
TEST(SeaAlone, HasTheLevelsOfItsMapInItsSamplesOverTime) {
  for (const auto& [clutter, noise] :
       std::vector<std::pair<std::string, std::string>>{{"true", "thermal"}, {"true", "cnr"}, {"false", "thermal"}}) {
    SCOPED_TRACE(clutter + noise);
    const Pipeline pipeline(sea_alone("{}", {{"clutter.enabled", clutter}, {"clutter.noise_level", noise}}));
    const SampledInterval interval = sampled_interval(pipeline, 2);
    const GeneratedSample made = pipeline.generate_sample(2);
    EXPECT_EQ(mean_power(interval.target.values), 0);
    ASSERT_EQ(interval.clutter.has_value(), clutter == "true");
    const auto power = [&](const std::optional<SampledEcho>& part) {
      return mean_power(spectrum_of(*part, interval.train));
    };
    if (interval.clutter) {
      EXPECT_NEAR(power(interval.clutter) / made.received.clutter_power_m2, 1, 1e-3);
    }
    ASSERT_TRUE(interval.noise.has_value());
    const PulseTrain fine = train_for_samples(interval.train, pipeline.scenario().radar);
    EXPECT_NEAR(power(interval.noise) / (fine.grid_refinement * made.received.noise_power_m2), 1, 0.08);
    EXPECT_TRUE(std::isnan(interval.record.mwr));
    EXPECT_EQ(interval.record.azimuth_deg, made.stored.record.azimuth_deg);
  }
}

TEST(SeaAlone, IsSaidByCheckAndHasNoWarningsOfTargets) {
  const Pipeline pipeline(sea_alone("{}", {{"view.azimuth_deg", "[0, 90]"}, {"clutter.doppler", "sea_state"}}));
  const std::string summary = scenario_summary(pipeline, estimate_work(pipeline), 1);
  EXPECT_THAT(summary, HasSubstr("moves               the sea alone\n"));
  EXPECT_THAT(summary, HasSubstr("sigma0 -34.01 dB"));
  EXPECT_THAT(summary, HasSubstr("work                about"));
  EXPECT_THAT(map_coverage_warnings(pipeline), IsEmpty());
  EXPECT_THAT(constant_key_warnings(pipeline), IsEmpty());
  // Of the prescribed Doppler and the level of this model neither depends on the direction.
  const std::vector<std::string> lines =
      constant_key_warnings(Pipeline(sea_alone("{}", {{"view.azimuth_deg", "[0, 90]"}})));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines.front(), HasSubstr("view.azimuth_deg (0, 90) changes nothing"));
  EXPECT_THAT(lines.front(), Not(HasSubstr("targets")));
}

TEST(SeaAlone, HasNeitherAnImageNorAMotion) {
  const Scenario scenario = sea_alone();
  const Pipeline pipeline(scenario);
  EXPECT_HAS(refusal_of([&] { isar_plan(pipeline, 0); }),
             "sea.yaml:5:10: targets: the sea alone: an image and a range profile need a target");
  EXPECT_HAS(refusal_of([&] { named_bodies(pipeline.targets(), *pipeline.scene({})); }),
             "targets: {} is the sea alone: a motion needs a target with a mesh");
}

// A few minutes of one range cell: no map is made, whose time would grow with the square of the pulses.
TEST(SeaAlone, IsSampledOverManyPulses) {
  const Pipeline pipeline(sea_alone("{}", {{"radar.pulses", "131072"},
                                           {"radar.bandwidth_mhz", "4"},
                                           {"radar.hop_step_mhz", "4"},
                                           {"radar.sampling_mhz", "4"},
                                           {"map.range_span_m", "37"}}));
  const SampledInterval interval = sampled_interval(pipeline, 0);
  EXPECT_EQ(interval.train.pulses(), 131072u);
  EXPECT_EQ(interval.clutter->pulses, 131072);
  // `check` ends within its limit and says so.
  EXPECT_TRUE(estimate_work(pipeline, {.processor_s = 0.5}).is_bound);
  EXPECT_TRUE(std::isfinite(mean_power(interval.clutter->values)));
}

}  // namespace
}  // namespace seaglint
