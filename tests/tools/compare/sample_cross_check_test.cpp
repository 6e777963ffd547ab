// SPDX-License-Identifier: BSD-3-Clause
// Samples of a scenario by beams and by rays.
#include "tools/compare/cross_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

// Two aspects of a reflector and of an ideal point: samples 0 and 1 of the mesh, 2 and 3 of the point.
Scenario scenario_by(const std::string& method) {
  return parse_scenario(R"(
seaglint: 1
radar: {pulses: 16}
view: {azimuth_deg: [10, 40], elevation_deg: 2}
targets:
  reflector: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}, solver: {method: )" +
                            method + R"(}}
  point: {label: 1, points: [{position_m: [0, 0, 1]}]}
dataset: {maps_per_case: 1, realisations_per_case: 1}
)",
                        "reflector.yaml");
}

constexpr std::array<std::size_t, 4> kAll{0, 1, 2, 3};

TEST(RelativeDifference, OfAResponseATenthLargerIsMinusTwentyDb) {
  const FrequencyResponse one{1, 2, {{1, 2}, {-3, 0.5}}};
  FrequencyResponse other = one, none = one;
  for (Complex& value : other.values) value *= 1.1;
  for (Complex& value : none.values) value = 0;
  EXPECT_NEAR(relative_difference_db(one, other), -20, 1e-9);
  EXPECT_EQ(relative_difference_db(one, one), -300);
  EXPECT_EQ(relative_difference_db(none, none), -300);
  EXPECT_EQ(relative_difference_db(none, one), 300);
}

TEST(EvenlySpread, SamplesAreTheMiddlesOfEqualParts) {
  EXPECT_THAT(evenly_spread(1, 10), testing::ElementsAre(5));
  EXPECT_THAT(evenly_spread(2, 100), testing::ElementsAre(25, 75));
  EXPECT_THAT(evenly_spread(4, 4), testing::ElementsAre(0, 1, 2, 3));
}

// By definition, from two independent pipelines.
TEST(SampleCrossCheck, ComparesTheResponsesAndTheStrongestCell) {
  const Scenario scenario = scenario_by("beams");
  const SampleCrossCheck check = cross_check_samples(scenario, kAll, 2);
  EXPECT_EQ(check.points, 2u);
  ASSERT_EQ(check.differences.size(), 2u);
  const Pipeline beams(scenario), rays(scenario_by("rays"));
  for (const SampleDifference& one : check.differences) {
    EXPECT_EQ(one.target, "reflector");
    EXPECT_EQ(one.other, SolverMethod::kRays);
    const GeneratedSample sample = beams.generate_sample(one.sample), other = rays.generate_sample(one.sample);
    EXPECT_EQ(one.response_db, relative_difference_db(beams.response(sample.address, sample.train).response,
                                                      rays.response(sample.address, sample.train).response));
    const auto& map = sample.stored.magnitude;
    const auto cell = std::ranges::max_element(map) - map.begin();
    EXPECT_NEAR(
        one.strongest_cell_db,
        20 * std::log10(other.stored.magnitude[static_cast<std::size_t>(cell)] / map[static_cast<std::size_t>(cell)]),
        1e-4);  // single precision
  }
}

// |H_beams - H_rays| is the same from either side, its reference is not.
TEST(SampleCrossCheck, OfRaysComparesBeams) {
  const SampleCrossCheck check = cross_check_samples(scenario_by("rays"), kAll, 1);
  ASSERT_EQ(check.differences.size(), 2u);
  EXPECT_EQ(check.differences[0].method, SolverMethod::kRays);
  EXPECT_EQ(check.differences[0].other, SolverMethod::kBeams);
  const SampleCrossCheck opposite = cross_check_samples(scenario_by("beams"), kAll, 1);
  EXPECT_NEAR(check.differences[0].response_db, opposite.differences[0].response_db, 1);
}

TEST(SampleCrossCheck, DoesNotDependOnThreads) {
  const std::string one = text_of(cross_check_samples(scenario_by("beams"), kAll, 1));
  EXPECT_EQ(one, text_of(cross_check_samples(scenario_by("beams"), kAll, 3)));
  EXPECT_THAT(one, testing::HasSubstr("2 samples of ideal points left out"));
  EXPECT_THAT(one, testing::HasSubstr("response by the other method: median "));
}

}  // namespace
}  // namespace seaglint
