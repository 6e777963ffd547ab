// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/planned_record.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace seaglint {
namespace {

// 30 deg converted to radians and back is 29.999999999999996: a selection by the scenario's own angle would find
// nothing.
TEST(PlannedRecord, HasTheAnglesOfTheScenario) {
  Scenario scenario;
  scenario.targets.resize(2);
  scenario.sea.propagation_deg = {120, -33.3};
  scenario.view = {{30, 80.1, -7}, {2, 0.7}};
  const SamplePlan plan(scenario);
  std::set<std::tuple<double, double, double>> angles;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleRecord record = planned_record(scenario, plan, i);
    angles.insert({record.propagation_deg, record.azimuth_deg, record.elevation_deg});
  }
  std::set<std::tuple<double, double, double>> given;
  for (const double propagation : scenario.sea.propagation_deg) {
    for (const double azimuth : scenario.view.azimuth_deg) {
      for (const double elevation : scenario.view.elevation_deg) given.insert({propagation, azimuth, elevation});
    }
  }
  EXPECT_EQ(angles, given);
}

}  // namespace
}  // namespace seaglint
