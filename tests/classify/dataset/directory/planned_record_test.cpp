// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/dataset_writer.h"

#include <gtest/gtest.h>

#include <map>
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

// Data sets of one seed share the random numbers of their seas, and only they do.
TEST(PlannedRecord, NumbersASeaEquallyInAllDataSets) {
  Scenario scenario;
  scenario.targets.resize(2);
  scenario.sea.significant_wave_height_m = {0.5, 1};
  scenario.dataset.maps_per_case = scenario.dataset.realisations_per_case = 3;
  const auto ids = [](const Scenario& of) {
    std::map<std::int64_t, std::int64_t> id_of_group;
    const SamplePlan plan(of);
    for (std::size_t i = 0; i < plan.size(); ++i) {
      const SampleRecord record = planned_record(of, plan, i);
      EXPECT_EQ(id_of_group.emplace(record.group, record.sea_id).first->second, record.sea_id);
      EXPECT_GE(record.sea_id, 0);
      EXPECT_LT(record.sea_id, std::int64_t{1} << 53);
    }
    return id_of_group;
  };
  const auto first = ids(scenario);
  std::set<std::int64_t> all;
  for (const auto& [group, id] : first) all.insert(id);
  EXPECT_EQ(all.size(), 6u);
  Scenario other = scenario;
  other.view.azimuth_deg = {3, 4, 5};
  EXPECT_EQ(ids(other), first);
  other.seed = 43;
  for (const auto& [group, id] : ids(other)) all.insert(id);
  EXPECT_EQ(all.size(), 12u);
}

TEST(PlannedRecord, HasSwellAndDepthOrZeroForDeepWater) {
  Scenario scenario;
  scenario.targets.resize(1);
  const SampleRecord deep = planned_record(scenario, SamplePlan(scenario), 0);
  EXPECT_EQ(deep.depth_m, 0);
  EXPECT_EQ(deep.swell_wave_height_m, 0);
  scenario.sea.depth_m = 20;
  scenario.sea.swell.significant_wave_height_m = 0.5;
  const SampleRecord shallow = planned_record(scenario, SamplePlan(scenario), 0);
  EXPECT_EQ(shallow.depth_m, 20);
  EXPECT_EQ(shallow.swell_wave_height_m, 0.5);
}

}  // namespace
}  // namespace seaglint
