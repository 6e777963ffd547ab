// SPDX-License-Identifier: BSD-3-Clause
// A sweep, and samples of a scenario, by the two methods of the solver.
#include "tools/compare/cross_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"
#include "tools/pipeline/pipeline.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

// A dihedral near its axis, where two bounces dominate, in physical optics.
class DihedralCrossCheck : public testing::Test {
 protected:
  DihedralCrossCheck() {
    request_.mesh = std::make_shared<const TriangleMesh>(make_dihedral(1, 0.7, kPi / 2));
    request_.edges = false;
    request_.frequency_hz = {9e9, 9.5e9, 10e9};
    request_.azimuth_deg = {-5, 0, 7};
    request_.elevation_deg = {0, 3};
  }
  RcsRequest one_bounce() const {
    RcsRequest request = request_;
    request.max_bounces = 1;
    return request;
  }

  RcsRequest request_;
};

TEST_F(DihedralCrossCheck, HasLevelsAndRelativeDifferenceByTheirDefinition) {
  const RcsTarget target = prepare_rcs_target(request_);
  const CrossCheck check = compare_solutions(request_, one_bounce(), target, 2);
  const auto full = compute_rcs(request_, target, 1).sweep.models.back().matrices,
             single = compute_rcs(one_bounce(), target, 1).sweep.models.back().matrices;
  ASSERT_EQ(check.rows.size(), 12u);
  EXPECT_EQ(check.grouped_hz, 9.5e9);
  for (std::size_t i = 0; i < check.rows.size(); ++i) {
    double beams = 0, rays = 0, difference = 0;
    for (std::size_t q = 0; q < 3; ++q) {
      const Complex b = full[i / 2][q][i % 2 == 0 ? 0 : 3], r = single[i / 2][q][i % 2 == 0 ? 0 : 3];
      beams += std::norm(b);
      rays += std::norm(r);
      difference += std::norm(r - b);
    }
    const CrossCheckRow& row = check.rows[i];
    EXPECT_EQ(row.azimuth_deg, request_.azimuth_deg[i / 2 % 3]);
    EXPECT_EQ(row.elevation_deg, request_.elevation_deg[i / 6]);
    EXPECT_NEAR(row.beams_dbsm, dbsm_of_area(4 * kPi * beams / 3), 1e-9);
    EXPECT_NEAR(row.rays_dbsm, dbsm_of_area(4 * kPi * rays / 3), 1e-9);
    EXPECT_NEAR(row.relative_db, 10 * std::log10(difference / beams), 1e-9);
  }
}

// Without the second bounce nothing else of the contributions changes: all of the difference is that group.
TEST_F(DihedralCrossCheck, AscribesTheMissingBounceToItsGroup) {
  const RcsTarget target = prepare_rcs_target(request_);
  for (const CrossCheckRow& row : compare_solutions(request_, one_bounce(), target).rows) {
    ASSERT_TRUE(row.group);
    EXPECT_EQ(row.group->bounces, 2);
    EXPECT_EQ(row.group->mechanism, Mechanism::kPhysicalOptics);
    EXPECT_NEAR(row.fraction, 1, 1e-12);
  }
}

// Of a bistatic view, too, the groups sum to the field.
TEST_F(DihedralCrossCheck, SumsOfTheGroupsAreTheField) {
  request_.transmitter = FixedTransmitter{10, 0};
  const RcsTarget target = prepare_rcs_target(request_);
  const double hz = 9.5e9, k = 2 * kPi * hz / kSpeedOfLight;
  std::array<Complex, 4> sum{};
  for (const auto& [group, of_group] :
       group_sums(view_contributions(request_, target, {7, 3, hz}).views[0].points, k)) {
    for (std::size_t i = 0; i < 4; ++i) sum[i] += of_group[i];
  }
  // compute_rcs() refers the phase to the body's origin, the groups to the target's centre.
  const auto matrix = compute_rcs(request_, target, 1).sweep.models.back().matrices[5][1];
  for (const std::size_t i : {0u, 3u}) EXPECT_NEAR(std::abs(sum[i]), std::abs(matrix[i]), 1e-5 * std::abs(matrix[i]));
}

TEST_F(DihedralCrossCheck, OfEqualSolutionsHasNoDifference) {
  const RcsTarget target = prepare_rcs_target(request_);
  const CrossCheck check = compare_solutions(request_, request_, target);
  for (const CrossCheckRow& row : check.rows) {
    EXPECT_EQ(row.relative_db, -kMostRelativeDb);
    EXPECT_FALSE(row.group);
  }
  EXPECT_TRUE(summary_of(check).large.empty());
}

TEST_F(DihedralCrossCheck, DoesNotDependOnTheThreads) {
  const RcsTarget target = prepare_rcs_target(request_);
  const std::string one = cross_check_table(request_, target, compare_solutions(request_, one_bounce(), target, 1)),
                    three = cross_check_table(request_, target, compare_solutions(request_, one_bounce(), target, 3));
  EXPECT_EQ(one, three);
  EXPECT_THAT(one, testing::HasSubstr(",2,po,1.0000\n"));
}

TEST_F(DihedralCrossCheck, ComparesTheMethodsWhateverThatOfTheRequest) {
  const RcsTarget target = prepare_rcs_target(request_);
  request_.method = SolverMethod::kRays;
  request_.ray_spacing_m = 0.02;
  RcsRequest beams = request_;
  beams.method = SolverMethod::kBeams;
  beams.ray_spacing_m = 0;
  EXPECT_EQ(cross_check_table(request_, target, cross_check_rcs(request_, target)),
            cross_check_table(request_, target, compare_solutions(beams, request_, target)));
}

TEST_F(DihedralCrossCheck, OfCavitiesUncertaintyAndExportsIsRefused) {
  const RcsTarget target = prepare_rcs_target(request_);
  RcsRequest cavity = request_, uncertain = request_, exports = request_;
  cavity.cavities.parts = {"plates"};
  uncertain.uncertainty = true;
  exports.exports.centres = "centres.csv";
  for (const RcsRequest& request : {cavity, uncertain, exports})
    EXPECT_THROW(cross_check_rcs(request, target), InputError);
}

CrossCheckRow row(double beams_dbsm, double rays_dbsm, double relative_db) {
  CrossCheckRow made;
  made.beams_dbsm = beams_dbsm;
  made.rays_dbsm = rays_dbsm;
  made.relative_db = relative_db;
  return made;
}

// Levels (of the higher method) 10, 0, 20, -30, 5: median 5. Of rows at least as high the first and third differ by
// more than 3 dB; the second and fourth, which are lower, do not count.
TEST(CrossCheckSummary, CountsLargeDifferencesAtHighLevelsOnly) {
  const CrossCheck check{{row(10, 6, -8), row(0, -20, -1), row(16, 20, -3), row(-300, -30, 300), row(5, 4, -20)}, 1e9};
  const CrossCheckSummary summary = summary_of(check);
  EXPECT_EQ(summary.large, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(summary.worst, (std::vector<std::size_t>{2, 0, 4}));
  EXPECT_EQ(summary.median_relative_db, -3);
  EXPECT_NEAR(summary.p90_relative_db, -1 + 0.6 * 301, 1e-9);  // between ranks 3 and 4, at 3.6
}

TEST_F(DihedralCrossCheck, HasCurvesOfBothMethodsAlongTheOneAxisThatVaries) {
  EXPECT_TRUE(
      cross_check_plots(compare_solutions(request_, one_bounce(), prepare_rcs_target(request_), 2)).plots.empty());
  request_.elevation_deg = {3};
  const CrossCheck check = compare_solutions(request_, one_bounce(), prepare_rcs_target(request_), 2);
  const std::vector<LinePlot> plots = cross_check_plots(check).plots;
  ASSERT_EQ(plots.size(), 4u);
  EXPECT_EQ(plots[1].title, "vv");
  EXPECT_EQ(plots[1].x.label, "azimuth (deg)");
  for (std::size_t view = 0; view < 3; ++view) {
    const CrossCheckRow& vv = check.rows[2 * view + 1];
    EXPECT_EQ(plots[1].series[0].x[view], request_.azimuth_deg[view]);
    EXPECT_EQ(plots[1].series[0].y[view], vv.beams_dbsm);
    EXPECT_EQ(plots[1].series[1].y[view], vv.rays_dbsm);
    EXPECT_EQ(plots[3].series[0].y[view], vv.relative_db);
  }
}

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
