// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/canonical/point_response.h"
#include "sim/sea/spectrum.h"
#include "tests/tools/pipeline/target_responses.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

// Propagation over the waves between radar and target in a scenario.

Scenario scenario_with(const std::string& reflection) {
  return parse_scenario(R"(
seaglint: 1
radar: {carrier_ghz: 9.39, pulses: 16, hop_count: 8}
view: {azimuth_deg: 30, elevation_deg: 1}
sea: {significant_wave_height_m: 1, peak_period_s: 5, components: 64}
targets:
  low: {label: 1, points: [{position_m: [3, 2, 0.8], amplitude_m: 1, velocity_mps: [0.5, 0, 0]}]}
dataset: {maps_per_case: 4, realisations_per_case: 2}
sea_reflection: )" + reflection +
                            "\n",
                        "waves.yaml");
}

std::vector<Complex> of_sample(const Pipeline& pipeline, std::size_t sample) {
  return pipeline.response(pipeline.plan().address(sample), pipeline.pulse_train(sample)).response.values;
}

TEST(WavesBetween, ASampleHasTheWavesOfItsOwnSeaAndTime) {
  const Pipeline pipeline(scenario_with("{enabled: true, surface_profile: waves}"));
  const Scenario& scenario = pipeline.scenario();
  const std::size_t last = pipeline.plan().size() - 1;
  const SampleAddress at = pipeline.plan().address(last);
  const auto scene = pipeline.scene(at);
  const IntervalSampling sampling = interval_sampling(pipeline.pulse_train(last), pipeline.plan().start_s(at));
  const View view = pipeline.plan().view(at);
  const double tail_m2 = wind_sea_spectrum(scene->state)->energy_above(linear_cutoff(scene->state));
  const SeaReflection sea(scenario.sea_reflection, 1, WavesBelow{&scene->sea, {}, {}, std::sqrt(tail_m2)});
  const FrequencyResponse expected =
      point_response_over_sea(scenario.targets[0].points, direction_to_radar(view.azimuth_rad, view.elevation_rad),
                              sampling, scenario.radar.polarisation, sea);
  EXPECT_EQ(of_sample(pipeline, last), expected.values);
  EXPECT_NE(of_sample(pipeline, 0), of_sample(pipeline, last));
}

TEST(WavesBetween, TheMeanPlaneIsTheDefault) {
  EXPECT_EQ(of_sample(Pipeline(scenario_with("{enabled: true}")), 0),
            of_sample(Pipeline(scenario_with("{enabled: true, surface_profile: mean}")), 0));
  // Without reflection the profile has no effect.
  EXPECT_EQ(of_sample(Pipeline(scenario_with("{enabled: false}")), 0),
            of_sample(Pipeline(scenario_with("{enabled: false, surface_profile: waves}")), 0));
}

}  // namespace
}  // namespace seaglint
