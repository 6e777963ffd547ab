// SPDX-License-Identifier: BSD-3-Clause
// Three classes with names, from the scenario to the report, the evaluation and single maps; refusals of scenarios,
// data sets and models whose classes do not fit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string_view>

#include "classify/dataset/format/shard.h"
#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using Words = std::vector<std::string>;

// A rotating line, four free points and the line with two points beside it.
std::string scenario_text(const std::string& classes, const std::string& third_label) {
  const auto points = [](const std::string& name, const std::string& label, const std::string& more) {
    return fmt::format("  {}:\n    label: {}\n    points: [{}]\n", name, label, more);
  };
  const auto point = [](double x, double y, double vy) {
    return fmt::format("{{position_m: [{}, {}, 5], amplitude_m: 4, velocity_mps: [0, {}, 0]}}", x, y, vy);
  };
  const std::string line =
      fmt::format("{}, {}, {}, {}", point(-60, 0, -0.5), point(-20, 0, -0.17), point(20, 0, 0.17), point(60, 0, 0.5));
  return "seaglint: 1\nname: three\nview: {azimuth_deg: [30, 80]}\nradar: {pulses: 64}\nclutter: {scr_db: 20}\n"
         "targets:\n" +
         points("free", "0",
                fmt::format("{}, {}, {}, {}", point(-60, 0, 0.31), point(-20, 0, -0.4), point(20, 0, 0.5),
                            point(60, 0, -0.35))) +
         points("line", "1", line) +
         points("guarded", third_label, fmt::format("{}, {}, {}", line, point(-30, 40, 0.4), point(35, 40, -0.3))) +
         "dataset: {" + classes +
         "maps_per_case: 10, realisations_per_case: 5}\n"
         "learning: {epochs: 3, trees: 20}\n";
}

constexpr const char* kThree = "classes: [decoys, ship, guarded ship], ";

class ThreeClasses : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_file(path("three.yaml"), scenario_text(kThree, "2"));
    run_ = run_program({"run", path("three.yaml"), "-o", path("run"), "--threads", "2"});
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string path(const std::string& name) { return folder_->path() / name; }

  static void expect_refusal(const Words& words, const std::string& reason) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_THAT(result.err, HasSubstr(reason));
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline ProgramResult run_;
};

TEST_F(ThreeClasses, AreNamedInTheDataSetAndItsCards) {
  ASSERT_EQ(run_.code, 0) << run_.err;
  const json manifest = json::parse(read_file(path("run/data/manifest.json")));
  EXPECT_EQ(manifest["classes"], (Words{"decoys", "ship", "guarded ship"}));
  EXPECT_THAT(manifest["columns"].dump(), HasSubstr("0 = decoys, 1 = ship, 2 = guarded ship"));
  EXPECT_THAT(read_shard(path("run/data/shard_00000.h5")).classes, ElementsAre("decoys", "ship", "guarded ship"));
  EXPECT_THAT(read_file(path("run/data/README.md")),
              AllOf(HasSubstr("| guarded | 2 (guarded ship) | 20 |"), HasSubstr("0 = decoys, 1 = ship, 2 = guarded")));
  EXPECT_EQ(run_program({"verify", path("run/data")}).code, 0);
  EXPECT_EQ(run_program({"merge", path("run/data")}).code, 0);
  ASSERT_EQ(run_program({"card", path("run/data")}).code, 0);
  EXPECT_THAT(read_file(path("run/data/croissant.json")), HasSubstr("\"classes/name\": \"guarded ship\""));
  EXPECT_EQ(run_program({"verify", path("run/data")}).code, 0);
}

TEST_F(ThreeClasses, AreScoredAndReported) {
  ASSERT_EQ(run_.code, 0) << run_.err;
  const json metrics = json::parse(read_file(path("run/metrics.json")));
  for (const char* protocol : {"random", "group"}) {
    const json& scores = metrics.at("fused").at(protocol);
    std::size_t all = 0, right = 0;
    for (const auto& [name, count] : scores.at("confusion").items()) {
      all += count.get<std::size_t>();
      if (name == "decoys_as_decoys" || name == "ship_as_ship" || name == "guarded_ship_as_guarded_ship")
        right += count.get<std::size_t>();
    }
    EXPECT_EQ(scores.at("confusion").size(), 9u);
    EXPECT_EQ(all, scores.at("rows"));
    EXPECT_NEAR(static_cast<double>(right) / static_cast<double>(all), scores.at("accuracy").get<double>(), 1e-12);
    EXPECT_EQ(scores.at("roc").size(), 3u);
    EXPECT_GT(scores.at("accuracy").get<double>(), 0.5);  // chance is 1/3
  }
  const std::string html = read_file(path("run/report.html"));
  EXPECT_THAT(html, AllOf(HasSubstr("decoys or ship or guarded ship?"), HasSubstr("declared guarded ship"),
                          HasSubstr("must stay near 33 %"), HasSubstr("mean over pairs of classes")));
  EXPECT_EQ(run_program({"report", path("run")}).code, 0);
}

TEST_F(ThreeClasses, HaveOneModelForAnyNumberOfThreads) {
  ASSERT_EQ(run_.code, 0) << run_.err;
  ASSERT_EQ(run_program({"train", path("run/data"), "-o", path("again"), "--threads", "1"}).code, 0);
  for (const char* file : {"network.bin", "fused.json", "metrics.json", "model.json", "embeddings.csv"})
    EXPECT_EQ(read_file(path("again") + "/" + file), read_file(path("run/model/") + file)) << file;
}

TEST_F(ThreeClasses, AreEvaluatedAndClassifiedWithAProbabilityEach) {
  ASSERT_EQ(run_.code, 0) << run_.err;
  const ProgramResult evaluated =
      run_program({"evaluate", path("run/model"), path("run/data"), "-o", path("evaluation")});
  ASSERT_EQ(evaluated.code, 0) << evaluated.err;
  EXPECT_THAT(evaluated.out, HasSubstr("guarded ship declared ship"));
  const json evaluation = json::parse(read_file(path("evaluation/evaluation.json")));
  EXPECT_TRUE(evaluation.at("fused").at("calibration").at("bins")[0].contains("right"));
  EXPECT_TRUE(evaluation.at("fused").at("roc").contains("guarded_ship"));
  EXPECT_THAT(read_file(path("evaluation/probabilities.csv")),
              HasSubstr(",probability_fused_decoys,probability_fused_ship,probability_fused_guarded_ship,"));

  const ProgramResult one = run_program({"classify", path("run/model"), path("run/data"), "--sample", "3"});
  EXPECT_THAT(one.out, AllOf(HasSubstr("P(guarded ship)"), HasSubstr("guarded ship, 5 / 50 / 95 %")));
  const ProgramResult all = run_program({"classify", path("run/model"), path("run/data"), "-o", path("all.csv")});
  EXPECT_THAT(all.out, HasSubstr("P(decision)"));
  EXPECT_THAT(read_file(path("all.csv")), HasSubstr("probability_cnn_guarded_ship"));
}

TEST_F(ThreeClasses, OfAnotherDataSetOrModelAreRefused) {
  ASSERT_EQ(run_.code, 0) << run_.err;
  for (const auto& [name, classes] :
       {std::pair{"renamed", "[decoys, ship, escort]"}, {"reordered", "[ship, decoys, guarded ship]"}}) {
    ASSERT_EQ(run_program({"generate", path("three.yaml"), "-o", path(name), "--set",
                           fmt::format("dataset.classes={}", classes), "--set", "seed=7"})
                  .code,
              0);
    expect_refusal({"evaluate", path("run/model"), path(name)}, "maps of other classes: ");
    expect_refusal({"classify", path("run/model"), path(name)}, "maps of other classes: ");
    expect_refusal({"train", path("run/data"), path(name), "-o", path("both")}, "other classes than ");
    EXPECT_FALSE(fs::exists(path("both")));
  }
  fs::copy(path("run/model"), path("two"));
  json card = json::parse(read_file(path("two/model.json")));
  card["classes"] = {"decoys", "ship"};
  write_file(path("two/model.json"), card.dump());
  expect_refusal({"evaluate", path("two"), path("run/data")}, "handmade.json: of 3 classes, by ");
}

TEST_F(ThreeClasses, NeedATargetEachToLearn) {
  write_file(path("lacking.yaml"), scenario_text(kThree, "1"));
  expect_refusal({"run", path("lacking.yaml"), "-o", path("none")},
                 "learning needs a target of every class, also of 'guarded ship' (label 2)");
  EXPECT_FALSE(fs::exists(path("none")));
  write_file(path("beyond.yaml"), scenario_text(kThree, "3"));
  expect_refusal({"check", path("beyond.yaml")}, "must be within 0 and 2, a class of dataset.classes: decoys, ship");
  write_file(path("default.yaml"), scenario_text("", "2"));
  expect_refusal({"check", path("default.yaml")}, "must be 0 or 1, a class of dataset.classes: array, ship");

  const ProgramResult shared = run_program({"check", path("lacking.yaml")});
  EXPECT_EQ(shared.code, 0);
  EXPECT_THAT(shared.err, HasSubstr("label 1 (ship) is shared by 2 targets (line, guarded): 40 of 60 maps"));
  ASSERT_EQ(run_program({"generate", path("lacking.yaml"), "-o", path("lacking")}).code, 0);
  expect_refusal({"train", path("lacking"), "-o", path("none")},
                 "none of 60 maps is of class 2 (guarded ship); learning needs all 3 classes");
  // A model of three classes is applied to maps of two of them.
  EXPECT_EQ(run_program({"evaluate", path("run/model"), path("lacking"), "--trained-rows"}).code, 0);
}

// Of five targets, three are tested on, among them the only one of a class.
TEST_F(ThreeClasses, AreAllTrainedOn) {
  std::string targets;
  for (const auto& [name, label] : {std::pair{"free", 0}, {"drifting", 0}, {"line", 1}, {"bar", 1}, {"guarded", 2}}) {
    targets += fmt::format(
        "  {}: {{label: {}, points: [{{position_m: [-60, 0, 5], velocity_mps: [0, -0.5, 0]}}, {{position_m: [-20, 0, "
        "5], "
        "velocity_mps: [0, 0.2, 0]}}, {{position_m: [{}, 0, 5], velocity_mps: [0, 0.17, 0]}}]}}\n",
        name, label, 20 + 3 * std::string_view(name).size());
  }
  write_file(path("five.yaml"), "seaglint: 1\nseed: 4\nradar: {pulses: 64}\nclutter: {scr_db: 20}\ntargets:\n" +
                                    targets +
                                    "dataset: {classes: [decoys, ship, guarded ship], maps_per_case: 4, "
                                    "realisations_per_case: 4}\n");
  ASSERT_EQ(run_program({"generate", path("five.yaml"), "-o", path("five")}).code, 0);
  expect_refusal({"train", path("five"), "-o", path("none"), "--by", "target_name", "--set", "dataset.split=1:1"},
                 "leaves no map of class 2 (guarded ship) to train on");
}

}  // namespace
}  // namespace seaglint
