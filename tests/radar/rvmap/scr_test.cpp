// SPDX-License-Identifier: BSD-3-Clause
#include "radar/rvmap/rv_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/canonical/point_response.h"

namespace seaglint {
namespace {

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
