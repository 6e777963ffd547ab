// SPDX-License-Identifier: BSD-3-Clause
// Holm's procedure on its definition, and its family-wise error over many sets of chance accuracies; verdicts on the
// paper's claims, and what a benchmark states, on studies with known scores.
#include "tools/evaluate/claims.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/core/numbers/random.h"
#include "tests/refusal.h"
#include "tests/tools/study_with_scores.h"
#include "tools/run/benchmark.h"
#include "tools/run/run.h"

namespace seaglint {
namespace {

TEST(HolmIntervals, OfOneEstimateAreThoseOfTheNormalDistribution) {
  const Estimate one{0.55, 0.02};
  const ConfidenceInterval interval = holm_intervals(std::span(&one, 1))[0];
  EXPECT_NEAR(interval.low, 0.55 - 1.959963984540054 * 0.02, 1e-12);
  EXPECT_NEAR(interval.high, 0.55 + 1.959963984540054 * 0.02, 1e-12);
}

// Tables of Student's distribution, 97.5 %: 2.571, 2.262 and 2.045 for 5, 9 and 29 degrees of freedom.
TEST(HolmIntervals, OfFewSeasAreThoseOfStudentsDistribution) {
  for (const auto& [degrees, t] : {std::pair{5.0, 2.571}, {9.0, 2.262}, {29.0, 2.045}}) {
    const Estimate one{0.5, 0.02, degrees};
    EXPECT_NEAR(holm_intervals(std::span(&one, 1))[0].high, 0.5 + t * 0.02, 3e-5) << degrees;
  }
}

// Welch's example of equal errors has twice the degrees of freedom; one error alone has its own.
TEST(DifferenceOfEstimates, HasTheDegreesOfFreedomOfWelch) {
  const Estimate equal = difference_of({0.8, 0.03, 9}, {0.7, 0.03, 9});
  EXPECT_NEAR(equal.value, 0.1, 1e-15);
  EXPECT_NEAR(equal.standard_error, 0.03 * std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(equal.degrees_of_freedom, 18, 1e-9);
  const Estimate alone = difference_of({0.8, 0.03, 9}, {1, 0, 29});
  EXPECT_NEAR(alone.degrees_of_freedom, 9, 1e-9);
  EXPECT_NEAR(half_width(alone), 2.262 * 0.03, 3e-5);
  EXPECT_EQ(half_width(difference_of({1, 0, 9}, {0.9, 0, 9})), 0);
  EXPECT_TRUE(std::isnan(half_width(difference_of({1, std::nan(""), 9}, {0.9, 0.1, 9}))));
}

// Means of 10 seas that are each right or wrong by chance, with the standard error of these 10: 5 % of sets of 11 such
// quantities have one that differs from chance. With the normal quantiles it would be 19 %.
TEST(HolmRejections, ErrInAtMostFivePercentOfSetsOfFewSeas) {
  constexpr int kSets = 4000, kSeas = 10;
  int wrong = 0;
  for (std::uint64_t i = 0; i < kSets; ++i) {
    Random random({12, Stream::kTest, i});
    std::vector<Estimate> estimates(11);
    for (Estimate& estimate : estimates) {
      double sum = 0, squares = 0;
      for (int sea = 0; sea < kSeas; ++sea) {
        const double accuracy = 0.5 + 0.15 * random.normal();
        sum += accuracy;
        squares += accuracy * accuracy;
      }
      const double mean = sum / kSeas;
      estimate = {mean, std::sqrt((squares / kSeas - mean * mean) / (kSeas - 1)), kSeas - 1};
    }
    const std::vector<bool> rejected = holm_rejections(estimates);
    wrong += std::find(rejected.begin(), rejected.end(), true) != rejected.end() ? 1 : 0;
  }
  EXPECT_NEAR(wrong / static_cast<double>(kSets), 0.0489, 5 * std::sqrt(0.0489 * 0.9511 / kSets));
}

// z of 0.05/6, 0.05/4 and 0.05/2 two-sided: 2.3940, 2.2414, 1.9600.
TEST(HolmIntervals, HaveTheLevelsOfTheirRanks) {
  const std::vector<Estimate> estimates{{0.51, 0.01}, {0.60, 0.01}, {0.45, 0.01}};
  const std::vector<ConfidenceInterval> intervals = holm_intervals(estimates);
  const double expected[] = {1.95996, 2.39398, 2.24140};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR((intervals[i].high - intervals[i].low) / 0.02, expected[i], 1e-4) << i;
}

// 2.3 errors from the null: rejected as the second of two, not as the first of three.
TEST(HolmRejections, StopAtTheFirstThatIsNotRejected) {
  EXPECT_EQ(holm_rejections(std::vector<Estimate>{{0.523, 0.01}, {0.6, 0.01}}), (std::vector<bool>{true, true}));
  EXPECT_EQ(holm_rejections(std::vector<Estimate>{{0.523, 0.01}, {0.52, 0.01}, {0.5, 0.01}}),
            (std::vector<bool>{false, false, false}));
}

TEST(HolmRejections, ErrInFivePercentOfSetsOfChanceAccuracies) {
  constexpr int kSets = 4000;
  int wrong = 0;
  for (std::uint64_t i = 0; i < kSets; ++i) {
    Random random({11, Stream::kTest, i});
    std::vector<Estimate> estimates(20);
    for (Estimate& estimate : estimates) estimate = {0.5 + 0.03 * random.normal(), 0.03};
    const std::vector<bool> rejected = holm_rejections(estimates);
    wrong += std::find(rejected.begin(), rejected.end(), true) != rejected.end() ? 1 : 0;
  }
  // 1 - (1 - 0.05/20)^20 = 0.0488, five standard errors.
  EXPECT_NEAR(wrong / static_cast<double>(kSets), 0.0488, 5 * std::sqrt(0.0488 * 0.9512 / kSets));
}

TEST(HolmIntervals, OfAMissingEstimateAreMissingAndDoNotCount) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Estimate> estimates{{none, 0.1}, {0.55, 0.02}, {0.5, none}};
  EXPECT_TRUE(std::isnan(holm_intervals(estimates)[0].low));
  EXPECT_NEAR(holm_intervals(estimates)[1].low, 0.55 - 1.959963984540054 * 0.02, 1e-12);
  EXPECT_EQ(holm_rejections(estimates), (std::vector<bool>{false, true, false}));
}

std::vector<Verdict> verdicts(const Study& study) {
  std::vector<Verdict> all;
  for (const Claim& claim : claims_of(study)) all.push_back(claim.verdict);
  return all;
}

const BenchmarkRecord kRecord{"a", false, 1, 720, 60, 2};

nlohmann::ordered_json json_of(const Study& study) {
  return nlohmann::ordered_json::parse(benchmark_json(kRecord, study));
}

constexpr Verdict kYes = Verdict::kHeld, kNo = Verdict::kNotHeld, kOpen = Verdict::kUndecided;

TEST(BenchmarkClaims, AreHeldAndNotHeldWithSignificanceOnly) {
  EXPECT_EQ(verdicts(study_of({0.8, 0.99, 0.99}, {0.7, 0.9, 0.92}, {0.97, 0.99, 0.99}, {0.6, 0.7, 0.7})),
            (std::vector<Verdict>{kYes, kYes, kYes, kYes, kYes}));
  EXPECT_EQ(verdicts(study_of({0.9, 0.8, 0.7}, {0.99, 0.99, 0.99}, {0.9, 0.9, 0.9}, {0.95, 0.95, 0.95}, 0.7)),
            (std::vector<Verdict>{kNo, kNo, kNo, kNo, kNo}));
  EXPECT_EQ(verdicts(study_of({0.86, 0.86, 0.87}, {0.86, 0.86, 0.86}, {0.86, 0.86, 0.86}, {0.86, 0.86, 0.86}, 0.51)),
            (std::vector<Verdict>{kOpen, kOpen, kOpen, kOpen, kYes}));
}

// The claims of exchanged figures have the opposite verdicts, and an undecided one stays so.
TEST(BenchmarkClaims, AreSymmetric) {
  for (const double more : {0.91, 0.92, 0.99}) {
    const std::vector<Verdict> up = verdicts(study_of({0.9, more}, {0.9}, {0.9}, {0.9})),
                               down = verdicts(study_of({more, 0.9}, {0.9}, {0.9}, {0.9}));
    EXPECT_EQ(up[2], more == 0.99 ? kYes : kOpen);
    EXPECT_EQ(down[2], more == 0.99 ? kNo : kOpen);
  }
}

TEST(BenchmarkClaims, OfAProtocolAreThoseOfItsFigures) {
  const Study study = study_of({0.7}, {0.7}, {0.7}, {0.7});
  EXPECT_EQ(claims_of(study).front().verdict, kNo);
  EXPECT_EQ(claims_of(study, Protocol::kRandom).front().verdict, kYes);
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
  EXPECT_HAS(above(0.027, 4).why, "90.0 (85-95) %");
  EXPECT_EQ(above(0.021, 4).verdict, kYes);
}

// Chance is not rejected for a probe at 51 %: held where the interval is within 10 % of chance, else undecided.
TEST(BenchmarkClaims, OfMotionAloneAreHeldWhereAllQuantitiesAreNearChance) {
  Study study = study_of({0.9}, {0.9}, {0.9}, {0.9}, 0.51);
  EXPECT_EQ(claims_of(study).back().verdict, kYes);
  EXPECT_HAS(claims_of(study).back().why,
             "chance (50.0 %) is rejected for no quantity; sample order may be 48.6 to 53.4 %");
  study.probes[0].evaluations[1] = evaluation_of({0.51}, 0.12);
  EXPECT_EQ(claims_of(study).back().verdict, kOpen);
  study.probes[0].evaluations[1].scores.accuracy_95 = {std::nan(""), std::nan("")};
  EXPECT_EQ(claims_of(study).back().verdict, kOpen);
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
  EXPECT_HAS(benchmark_text(study), "differs from chance, 33.3 %");
  EXPECT_EQ(json_of(study)["classes"].size(), 3u);
}

TEST(BenchmarkJson, HasBaselinesFloorAndClaims) {
  const Study study = study_of({0.8, 0.99, 0.98}, {0.7, 0.9, 0.92}, {0.82, 0.99, 0.99}, {0.7, 0.9, 0.95});
  const nlohmann::ordered_json json = json_of(study);
  EXPECT_NEAR(json["baselines"]["handmade"]["by"]["0.1"]["accuracy"].get<double>(), 0.8, 1e-12);
  EXPECT_NEAR(json["baselines"]["fused_logistic"]["by"]["2"]["accuracy"].get<double>(), 0.95, 1e-12);
  EXPECT_EQ(json["baselines"].size(), 6u);
  EXPECT_FALSE(json["floor"]["sample order"]["leaks"].get<bool>());
  ASSERT_EQ(json["claims"].size(), 5u);
  EXPECT_EQ(json["claims"][2]["verdict"], "held");
  EXPECT_HAS(json["claims"][2]["why"].get<std::string>(), "80.0 / 99.0 / 98.0 % at Hs 0.1 / 1 / 2 m");
  EXPECT_HAS(benchmark_text(study), "handmade_logistic");
  EXPECT_HAS(benchmark_row(kRecord, study), "| `a` | 720, 60 | 80.0 / 99.0 / 98.0 |");
}

std::string refusal(const std::string& name) {
  return refusal_of([&] { read_benchmark(name, true, {}); });
}

TEST(Benchmark, OfAnUnknownNameIsRefusedWithTheNearest) {
  EXPECT_HAS(refusal("rigid_twn"), "did you mean 'rigid_twin'?");
  EXPECT_HAS(refusal("papr.yaml"), "papr.yaml: no such file");
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
