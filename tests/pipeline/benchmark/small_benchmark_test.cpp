// SPDX-License-Identifier: BSD-3-Clause
// A small benchmark as a user runs it: its files, figures and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/process/file.h"
#include "tests/pipeline/program.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// An accuracy with its interval, and the same of each wave height.
void expect_accuracies(const std::string& name, const json& entry) {
  const auto expect_inside = [&](const json& figures) {
    const double accuracy = figures.at("accuracy");
    EXPECT_GE(accuracy, figures.at("interval").at(0).get<double>()) << name;
    EXPECT_LE(accuracy, figures.at("interval").at(1).get<double>()) << name;
  };
  expect_inside(entry);
  ASSERT_EQ(entry.at("by").size(), 3u) << name;
  for (const char* height : {"0.1", "1", "2"}) expect_inside(entry.at("by").at(height));
}

// At least 12 maps of unseen seas at each wave height: by chance above 0.75 in 1.9 % of such sets, at both in 0.04 %.
TEST(SmallBenchmark, HasAccuraciesInTheirIntervalsThatMotionAloneExplains) {
  const TemporaryFolder folder;
  const auto run = [&](const char* name, const char* threads) {
    return run_program({"benchmark", "rigid_twin", "--small", "--threads", threads, "-o", folder.path() / name});
  };
  const ProgramResult one = run("one", "1");
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("The paper's claims on this data set"));
  EXPECT_THAT(one.out, HasSubstr((folder.path() / "one" / "report.html").string()));
  const std::string text = read_file(folder.path() / "one" / "benchmark.json");
  const json result = json::parse(text);
  EXPECT_EQ(result.at("benchmark"), "rigid_twin");
  EXPECT_EQ(result.at("small"), true);
  EXPECT_EQ(result.at("maps"), 120);
  EXPECT_EQ(result.at("seas"), 30);
  EXPECT_EQ(result.at("seed"), 42);
  EXPECT_THAT(result.at("division").get<std::string>(), HasSubstr("no test sea was seen in training"));

  for (const char* name : {"handmade", "network", "fused", "handmade_logistic", "network_logistic", "fused_logistic"}) {
    ASSERT_TRUE(result.at("baselines").contains(name));
    expect_accuracies(name, result.at("baselines").at(name));
  }
  for (const char* height : {"1", "2"})
    EXPECT_GT(result.at("baselines").at("handmade").at("by").at(height).at("accuracy").get<double>(), 0.75) << height;
  for (const char* name : {"number of centres", "sigma_r alone", "total power", "blanked map", "hop code"})
    ASSERT_TRUE(result.at("floor").contains(name)) << name;
  for (const auto& [name, entry] : result.at("floor").items()) {
    expect_accuracies(name, entry);
    EXPECT_TRUE(entry.at("leaks").is_boolean()) << name;
  }
  for (const json& claim : result.at("claims")) {
    EXPECT_TRUE(claim.at("held").is_boolean() || claim.at("held").is_null()) << claim;
    EXPECT_FALSE(claim.at("claim").get<std::string>().empty() || claim.at("why").get<std::string>().empty()) << claim;
  }

  // A run shows the benchmarks in its folders: here, as the benchmark is a run, its own copy.
  fs::create_directory(folder.path() / "one" / "copy");
  fs::copy_file(folder.path() / "one" / "benchmark.json", folder.path() / "one" / "copy" / "benchmark.json");
  const ProgramResult report = run_program({"report", folder.path() / "one"});
  ASSERT_EQ(report.code, 0) << report.err;
  const std::string page = read_file(folder.path() / "one" / "report.html");
  EXPECT_THAT(page, HasSubstr("Benchmark <b>rigid_twin</b> at its small size"));
  EXPECT_THAT(page, HasSubstr("href=\"copy/report.html\""));

  const ProgramResult two = run("two", "2");
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_EQ(read_file(folder.path() / "two" / "benchmark.json"), text);
}

// A benchmark leaves out the random split and the other fusion; what it has is that of `run`, to the last digit.
TEST(SmallBenchmark, HasTheFiguresAndTheModelOfARun) {
  for (const char* fusion : {"split", "in_sample"}) {
    const TemporaryFolder folder;
    const auto made = [&](const char* command) {
      const fs::path directory = folder.path() / command;
      const ProgramResult result =
          run_program({command, "scenarios/points.yaml", "-o", directory, "--set", "learning.epochs=2", "--set",
                       "learning.trees=20", "--set", "learning.split_repeats=2", "--set",
                       std::string("learning.fusion=") + fusion});
      EXPECT_EQ(result.code, 0) << result.err;
      return json::parse(read_file(directory / "metrics.json"));
    };
    const json run = made("run"), benchmark = made("benchmark");
    for (const char* group : {"handmade", "cnn", "fused", "extended"}) {
      EXPECT_EQ(benchmark.at(group).at("group"), run.at(group).at("group")) << group;
      EXPECT_EQ(benchmark.at(group).at("gain"), run.at(group).at("gain")) << group;
      EXPECT_TRUE(run.at(group).contains("random"));
      EXPECT_FALSE(benchmark.at(group).contains("random"));
    }
    ASSERT_EQ(benchmark.at("probes").size(), run.at("probes").size());
    for (std::size_t i = 0; i < run.at("probes").size(); ++i)
      EXPECT_EQ(benchmark.at("probes")[i].at("group"), run.at("probes")[i].at("group")) << i;
    for (const char* file : {"network.bin", "handmade.json", "cnn.json", "fused.json", "extended.json", "splits.csv",
                             "embeddings.csv", "model.json"}) {
      EXPECT_EQ(read_file(folder.path() / "benchmark/model" / file), read_file(folder.path() / "run/model" / file))
          << file;
    }
    const std::string page = read_file(folder.path() / "benchmark/report.html");
    EXPECT_THAT(page, HasSubstr("Split by sea realisation"));
    EXPECT_THAT(page, testing::Not(HasSubstr("andom split of the maps")));
    EXPECT_THAT(page, testing::Not(HasSubstr("paper's random split")));
    EXPECT_THAT(page, testing::Not(HasSubstr("in_sample</code>, the paper")));
  }
}

TEST(SmallBenchmark, IsRefusedWithoutAFileLeftBehind) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& name, std::vector<std::string> more, const std::string& message) {
    std::vector<std::string> words{"benchmark", name, "--small", "-o", folder.path() / "refused"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_FALSE(fs::exists(folder.path() / "refused"));
  };
  expect("rigid_twins", {}, "did you mean 'rigid_twin'?");
  expect("no_scenario.yaml", {}, "no_scenario.yaml: no such file");
  expect("rigid_twin", {"--set", "learning.split.hold_out={target_name: rafts}"},
         "learning.split: hold-out target_name=rafts: no map has this value; the data have array, raft");
  expect("sea_transfer", {"--set", "sea.peak_period_s=8"},
         "learning.split.hold_out.sea.peak_period_s: sea.peak_period_s: no column of a data set: did you mean "
         "'peak_period_s'?");
}

}  // namespace
}  // namespace seaglint
