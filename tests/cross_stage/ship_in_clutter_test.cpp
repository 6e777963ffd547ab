// SPDX-License-Identifier: BSD-3-Clause
// Scattering centres of a ship that exceed the clutter by 20 dB are found in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "classify/features/scattering_centres.h"
#include "radar/echo/echo.h"
#include "sim/scenario/scenario.h"
#include "tests/mean_around.h"
#include "tests/measured.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

// Ships of quick.yaml near broadside in waves of 2 m: a flash of up to 50 dB above clutter, and 20 to 30 centres up to
// 30 dB below it in 30 m. Reference: the centres of the same echo without clutter and noise that are 1 dB inside the
// dynamic range. The two decompositions of a dense target differ in some of the weakest centres, hence the tolerance.
TEST(ShipInClutter, KeepsNineInTenCentresTwentyDecibelsAboveIt) {
  const Scenario scenario =
      read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/quick.yaml", {{"view.azimuth_deg", "[80, 90, 100]"},
                                                                  {"sea.significant_wave_height_m", "2"},
                                                                  {"dataset.maps_per_case", "4"},
                                                                  {"dataset.realisations_per_case", "2"}});
  const SamplePlan plan(scenario);
  const Pipeline pipeline(scenario, plan);
  int ships = 0, strong = 0, lost = 0, halved = 0;
  for (std::size_t sample = 0; sample < plan.size(); ++sample) {
    const SampleAddress at = plan.address(sample);
    if (scenario.targets[static_cast<std::size_t>(at.target)].name != "ship") continue;
    ++ships;
    const PulseTrain train = pipeline.pulse_train(sample);
    const Echo echo =
        synthesise_echo(train, pipeline.response(at, train).response, scenario.clutter, scenario.seed, sample);
    Echo sea = echo;
    std::fill(sea.target.begin(), sea.target.end(), Complex{});
    const RvMap clutter = form_rv_map(sea.total(), train, scenario.map, false);
    const auto reference = clean_map(echo.target, train, scenario.map, false, scenario.features).centres;
    const auto centres = clean_map(echo.total(), train, scenario.map, false, scenario.features).centres;
    const double weakest = reference.empty() ? 0
                                             : reference.front().amplitude_m *
                                                   std::pow(10, -(scenario.features.dynamic_range_db - 1) / 20);
    int of_ship = 0, lost_of_ship = 0;
    for (const ScatteringCentre& t : reference) {
      if (t.amplitude_m < weakest ||
          t.amplitude_m * t.amplitude_m < 100 * mean_around(clutter, t.range_m, t.velocity_mps))
        continue;
      ++of_ship;
      lost_of_ship += std::none_of(centres.begin(), centres.end(), [&](const ScatteringCentre& c) {
        return std::hypot((c.range_m - t.range_m) / train.range_resolution_m(),
                          (c.velocity_mps - t.velocity_mps) / train.velocity_resolution_mps()) < 0.7;
      });
    }
    strong += of_ship;
    lost += lost_of_ship;
    halved += 2 * lost_of_ship > of_ship;
  }
  std::printf(
      "%d ships near broadside, Hs 2 m: %d of %d centres 20 dB above clutter lost, more than half in %d ships\n", ships,
      lost, strong, halved);
  record_figure(100.0 * lost / strong, 0, "ship_centres_lost_percent");
  EXPECT_EQ(ships, 12);
  EXPECT_GE(strong, 12 * 10);
  EXPECT_LE(lost, strong / 10);
  EXPECT_EQ(halved, 0);
}

}  // namespace
}  // namespace seaglint
