// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/sample_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace seaglint {
namespace {

Scenario small_scenario() {
  Scenario scenario;
  scenario.sea.significant_wave_height_m = {0.1, 1, 2};
  scenario.view.azimuth_deg = {10, 80, 170};
  scenario.targets.resize(2);
  scenario.targets[0].label = 1;
  scenario.dataset.maps_per_case = 6;
  scenario.dataset.realisations_per_case = 3;
  scenario.dataset.interval_spacing_s = 10;
  scenario.dataset.maps_per_shard = 7;
  return scenario;
}

TEST(SamplePlan, CountsMapsPerCaseAndClass) {
  const SamplePlan plan(small_scenario());
  EXPECT_EQ(plan.size(), 3u * 3u * 2u * 6u);
  std::map<std::tuple<int, int, int>, int> maps_of_case_and_class;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    ++maps_of_case_and_class[{at.sea_state, at.view, at.target}];
  }
  EXPECT_EQ(maps_of_case_and_class.size(), 18u);
  for (const auto& [key, count] : maps_of_case_and_class) EXPECT_EQ(count, 6);
}

// Maps of one interval and target are adjacent; intervals keep their order.
TEST(SamplePlan, DividesAnIntervalIntoMaps) {
  Scenario scenario = small_scenario();
  const SamplePlan single(scenario);
  scenario.dataset.maps_per_interval = 3;
  scenario.dataset.maps_per_case = 18;
  const SamplePlan plan(scenario);
  ASSERT_EQ(plan.size(), 3 * single.size());
  EXPECT_EQ(plan.intervals(), single.intervals());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    SampleAddress at = plan.address(i);
    EXPECT_EQ(plan.sample(at), i);
    EXPECT_EQ(at.clutter, static_cast<int>(i % 3));
    EXPECT_EQ(plan.first_of_interval(i), i - i % 3);
    EXPECT_EQ(plan.group(plan.sea_address(i)), plan.group(at));
    at.clutter = 0;
    EXPECT_EQ(at, single.address(i / 3));
  }
}

TEST(SamplePlan, PartsHaveNoSamples) {
  Scenario scenario = small_scenario();
  scenario.targets.insert(scenario.targets.begin() + 1, TargetSpec{});
  scenario.targets[1].role = TargetRole::kPart;
  const SamplePlan plan(scenario), without(small_scenario());
  EXPECT_EQ(plan.classes(), (std::vector<int>{0, 2}));
  ASSERT_EQ(plan.size(), without.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    SampleAddress at = plan.address(i);
    EXPECT_EQ(plan.sample(at), i);
    at.target /= 2;
    EXPECT_EQ(at, without.address(i));
  }
  EXPECT_THROW(plan.sample({0, 0, 0, 0, 1}), std::logic_error);
}

TEST(SamplePlan, NumbersEveryAddressOnce) {
  const SamplePlan plan(small_scenario());
  std::set<std::tuple<int, int, int, int, int>> addresses;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    addresses.insert({at.sea_state, at.realisation, at.view, at.interval, at.target});
    EXPECT_EQ(plan.sample(at), i);
    const SampleAddress sea = plan.sea_address(i);
    EXPECT_EQ(sea.sea_state, at.sea_state);
    EXPECT_EQ(sea.realisation, at.realisation);
    EXPECT_EQ(plan.group(sea), plan.group(at));
  }
  EXPECT_EQ(addresses.size(), plan.size());
}

TEST(SamplePlan, ShardsCoverAllSamplesInOrder) {
  const SamplePlan plan(small_scenario());
  std::size_t next = 0;
  for (std::size_t i = 0; i < plan.shards(); ++i) {
    EXPECT_EQ(plan.shard(i).first, next);
    EXPECT_LE(plan.shard(i).count, 7u);
    next += plan.shard(i).count;
  }
  EXPECT_EQ(next, plan.size());
}

TEST(SamplePlan, BothClassesAndAllViewsHaveTheSeaOfTheirGroup) {
  const SamplePlan plan(small_scenario());
  std::map<std::int64_t, std::set<std::uint64_t>> seas_of_group;
  std::map<std::int64_t, std::set<std::pair<int, int>>> uses_of_group;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const SampleAddress at = plan.address(i);
    seas_of_group[plan.group(at)].insert(
        sea_key(static_cast<std::size_t>(at.sea_state), static_cast<std::size_t>(at.realisation)));
    uses_of_group[plan.group(at)].insert({at.view, at.target});
  }
  EXPECT_EQ(seas_of_group.size(), 9u);
  for (const auto& [group, seas] : seas_of_group) EXPECT_EQ(seas.size(), 1u);
  for (const auto& [group, uses] : uses_of_group) EXPECT_EQ(uses.size(), 6u);
}

TEST(SamplePlan, ClassIsIndependentOfParityAndNeighbour) {
  Scenario scenario = small_scenario();
  scenario.dataset.maps_per_case = 300;
  const SamplePlan plan(scenario);
  const auto samples = static_cast<double>(plan.size());
  int even_ships = 0, changes = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i % 2 == 0) even_ships += plan.address(i).target == 0 ? 1 : 0;
    if (i % 2 == 1) changes += plan.address(i).target != plan.address(i - 1).target ? 1 : 0;
  }
  // Binomial with n = 2700, p = 1/2: four standard deviations are 2 sqrt(n). Half of each block of 600 being ships
  // moves the chance of a change from 1/2 to 300/599, 2.3 of 2700.
  EXPECT_NEAR(even_ships, samples / 4, 2 * std::sqrt(samples / 2));
  EXPECT_NEAR(changes, samples / 4, 2 * std::sqrt(samples / 2) + 3);
}

TEST(SamplePlan, SamplesOfOneSeaAreContiguous) {
  const SamplePlan plan(small_scenario());
  std::int64_t last = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    EXPECT_GE(plan.group(plan.address(i)), last);
    last = plan.group(plan.address(i));
  }
}

}  // namespace
}  // namespace seaglint
