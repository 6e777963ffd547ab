// SPDX-License-Identifier: BSD-3-Clause
// Verdicts on the paper's claims, and what a benchmark states, on studies with known scores.
#include "tools/evaluate/claims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/core/process/error.h"
#include "tools/run/benchmark.h"
#include "tools/run/run.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

Scores scores_of(double accuracy, double half = 0.02) {
  Scores scores;
  scores.rows = 1000;
  scores.groups = 50;
  scores.accuracy = accuracy;
  scores.accuracy_95 = {accuracy - half, accuracy + half};
  return scores;
}

Evaluation evaluation_of(std::vector<double> by_height, double half = 0.02) {
  Evaluation evaluation;
  double sum = 0;
  const char* const heights[] = {"0.1", "1", "2"};
  for (std::size_t i = 0; i < by_height.size(); ++i) {
    evaluation.by_wave_height.push_back({heights[i], 0, 0, 0, scores_of(by_height[i], half)});
    sum += by_height[i];
  }
  evaluation.scores = scores_of(sum / static_cast<double>(by_height.size()), half);
  return evaluation;
}

Study study_of(const std::vector<double>& handmade, const std::vector<double>& network,
               const std::vector<double>& fused, const std::vector<double>& linear, double order_probe = 0.5) {
  Study study;
  for (const auto& [name, values] : {std::pair{"handmade", handmade}, {"cnn", network}, {"fused", fused}}) {
    FeatureGroupResult group;
    group.name = name;
    group.outcomes.resize(2);
    group.outcomes[1].primary = evaluation_of(values);
    group.outcomes[1].linear = evaluation_of(linear);
    study.groups.push_back(group);
  }
  const Evaluation chance = evaluation_of({0.5});
  study.probes = {{"sample order", ProbeKind::kBlind, "", {chance, evaluation_of({order_probe})}},
                  {"sigma_r alone", ProbeKind::kFeature, "", {chance, chance}},
                  {"MWR alone", ProbeKind::kFeature, "", {chance, evaluation_of({0.97})}}};
  return study;
}

std::vector<Verdict> verdicts(const Study& study) {
  std::vector<Verdict> all;
  for (const Claim& claim : claims_of(study)) all.push_back(claim.verdict);
  return all;
}

constexpr Verdict kYes = Verdict::kHeld, kNo = Verdict::kNotHeld, kOpen = Verdict::kUndecided;

TEST(BenchmarkClaims, FollowTheFiguresAndTheirIntervals) {
  EXPECT_EQ(verdicts(study_of({0.8, 0.99, 0.99}, {0.7, 0.9, 0.92}, {0.82, 0.99, 0.99}, {0.7, 0.8, 0.9})),
            (std::vector<Verdict>{kYes, kYes, kYes, kYes, kYes}));
  EXPECT_EQ(verdicts(study_of({0.9, 0.8, 0.7}, {0.99, 0.99, 0.99}, {0.9, 0.9, 0.9}, {0.95, 0.95, 0.95}, 0.7)),
            (std::vector<Verdict>{kNo, kNo, kNo, kNo, kNo}));
  EXPECT_EQ(verdicts(study_of({0.86, 0.86, 0.87}, {0.5, 0.5, 0.5}, {0.86, 0.86, 0.86}, {0.5, 0.5, 0.5}))[0], kOpen);
  EXPECT_EQ(verdicts(study_of({0.86, 0.86, 0.87}, {0.5, 0.5, 0.5}, {0.86, 0.86, 0.86}, {0.5, 0.5, 0.5}))[1], kOpen);
  EXPECT_EQ(verdicts(study_of({0.86, 0.86, 0.87}, {0.5, 0.5, 0.5}, {0.86, 0.86, 0.86}, {0.5, 0.5, 0.5}))[2], kOpen);
}

// A bootstrap interval of +-1.96 standard errors over 4 seas is one of +-3.182 sqrt(4/3): 2.7 % about 90 % is 5.06 %.
TEST(BenchmarkClaims, OfFewSeasHaveTheIntervalsOfStudentsDistribution) {
  const auto above = [](double half, std::size_t seas) {
    Study study = study_of({0.9}, {0.9}, {0.9}, {0.9});
    study.groups.front().outcomes[1].primary.scores = scores_of(0.9, half);
    study.groups.front().outcomes[1].primary.scores.groups = seas;
    return claims_of(study).front();
  };
  EXPECT_EQ(above(0.027, 400).verdict, kYes);
  EXPECT_EQ(above(0.027, 4).verdict, kOpen);
  EXPECT_THAT(above(0.027, 4).why, HasSubstr("90.0 (85-95) %"));
  EXPECT_EQ(above(0.021, 4).verdict, kYes);
}

// A probe at 51 % is not rejected: "held" states that, and how far it may be from chance.
TEST(BenchmarkClaims, OfMotionAloneStateThatNothingIsRejected) {
  const Study study = study_of({0.9}, {0.9}, {0.9}, {0.9}, 0.51);
  const Claim claim = claims_of(study).back();
  EXPECT_EQ(claim.verdict, kYes);
  EXPECT_THAT(
      claim.why,
      HasSubstr("chance (50.0 %) is rejected for no quantity, which does not prove it: sample order may reach 53."));
  EXPECT_THAT(benchmark_json(study)["claims"][4]["meaning"].get<std::string>(), HasSubstr("does not prove"));
}

TEST(BenchmarkFloor, LeavesOutTheFeaturesOfMotion) {
  const std::vector<FloorEntry> floor = floor_of(study_of({0.9}, {0.9}, {0.9}, {0.9}, 0.6));
  ASSERT_EQ(floor.size(), 2u);
  EXPECT_EQ(floor[0].name, "sample order");
  EXPECT_TRUE(floor[0].leaks);
  EXPECT_EQ(floor[1].name, "sigma_r alone");
  EXPECT_FALSE(floor[1].leaks);
}

// A third is chance of three classes, where a half leaks.
TEST(BenchmarkFloor, ComparesThreeClassesWithAThird) {
  Study study = study_of({0.9}, {0.9}, {0.9}, {0.9}, 1.0 / 3);
  study.classes = {"decoys", "ship", "guarded ship"};
  const std::vector<FloorEntry> floor = floor_of(study);
  EXPECT_FALSE(floor[0].leaks);
  EXPECT_TRUE(floor[1].leaks);
  EXPECT_THAT(benchmark_text(study), HasSubstr("differs from chance, 33.3 %"));
  EXPECT_EQ(benchmark_json(study)["classes"].size(), 3u);
}

TEST(BenchmarkJson, HasBaselinesFloorAndClaims) {
  const Study study = study_of({0.8, 0.99, 0.98}, {0.7, 0.9, 0.92}, {0.82, 0.99, 0.99}, {0.7, 0.9, 0.95});
  const nlohmann::ordered_json json = benchmark_json(study);
  EXPECT_NEAR(json["baselines"]["handmade"]["by"]["0.1"]["accuracy"].get<double>(), 0.8, 1e-12);
  EXPECT_NEAR(json["baselines"]["fused_logistic"]["by"]["2"]["accuracy"].get<double>(), 0.95, 1e-12);
  EXPECT_EQ(json["baselines"].size(), 6u);
  EXPECT_FALSE(json["floor"]["sample order"]["leaks"].get<bool>());
  ASSERT_EQ(json["claims"].size(), 5u);
  EXPECT_TRUE(json["claims"][2]["held"].get<bool>());
  EXPECT_THAT(json["claims"][2]["why"].get<std::string>(), HasSubstr("80.0 / 99.0 / 98.0 % at Hs 0.1 / 1 / 2 m"));
  EXPECT_THAT(benchmark_text(study), HasSubstr("handmade_logistic"));
  EXPECT_THAT(benchmark_row("a", 720, 60, study), HasSubstr("| `a` | 720, 60 | 80.0 / 99.0 / 98.0 |"));
}

std::string refusal(const std::string& name) {
  try {
    read_benchmark(name, true, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Benchmark, OfAnUnknownNameIsRefusedWithTheNearest) {
  EXPECT_THAT(refusal("rigid_twn"), HasSubstr("did you mean 'rigid_twin'?"));
  EXPECT_THAT(refusal("papr.yaml"), HasSubstr("papr.yaml: no such file"));
}

// The paper's set, small: 5 of its 17 azimuths with both ends, one interval each, the waves as they are.
TEST(Benchmark, OfAScenarioFileIsReducedInSeasAndAzimuths) {
  const Scenario whole = read_benchmark("scenarios/paper.yaml", false, {});
  EXPECT_EQ(whole.view.azimuth_deg.size(), 17u);
  EXPECT_EQ(whole.dataset.maps_per_case, 100);
  const Scenario small = read_benchmark("scenarios/paper.yaml", true, {{"sea.peak_period_s", "9"}});
  EXPECT_EQ(small.view.azimuth_deg, (Sweep{10, 50, 90, 130, 170}));
  EXPECT_EQ(small.sea.significant_wave_height_m, whole.sea.significant_wave_height_m);
  EXPECT_EQ(small.sea.peak_period_s, Sweep{9});
  EXPECT_EQ(small.dataset.realisations_per_case, 10);
  EXPECT_EQ(small.dataset.maps_per_case, 10);
}

// Every benchmark is a valid scenario at both sizes, and learnable, as divided by its own split.
TEST(Benchmark, EveryShippedOneIsAScenarioAtBothSizes) {
  EXPECT_FALSE(benchmark_names().empty());
  for (const std::string& name : benchmark_names()) {
    for (const bool small : {false, true}) {
      const Scenario scenario = read_benchmark(name, small, {});
      EXPECT_EQ(scenario.name, name);
      EXPECT_NO_THROW(check_learnable(scenario, SamplePlan(scenario))) << name;
      std::vector<int> labels(scenario.dataset.classes.size());
      for (const TargetSpec& target : scenario.targets)
        if (target.role == TargetRole::kClass) ++labels[static_cast<std::size_t>(target.label)];
      EXPECT_EQ(labels, std::vector<int>(labels.size(), 1)) << name;
    }
  }
}

}  // namespace
}  // namespace seaglint
