// SPDX-License-Identifier: BSD-3-Clause
// The main job on ideal points: from scenario to report, and the report in a browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/pipeline/program.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// One finished run for all tests of this file.
class RunOutput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    directory_ = folder_->path() / "run";
    result_ = run_program({"run", "scenarios/points.yaml", "-o", directory_, "--set", "learning.epochs=3"});
  }
  static void TearDownTestSuite() { delete folder_; }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline fs::path directory_;
  static inline ProgramResult result_;
};

nlohmann::json metrics_of(const fs::path& directory) {
  return nlohmann::json::parse(read_file(directory / "metrics.json"));
}

TEST_F(RunOutput, PrintsTheAccuracyTableAndWhereTheReportIs) {
  ASSERT_EQ(result_.code, 0) << result_.err;
  EXPECT_THAT(result_.out, HasSubstr("hand-made"));
  EXPECT_THAT(result_.out, HasSubstr("fused"));
  EXPECT_THAT(result_.out, HasSubstr("Report: " + (directory_ / "report.html").string()));
}

TEST_F(RunOutput, EndsInTheFindingThatTheReportBeginsWith) {
  const std::size_t at = result_.out.find("On unseen seas the fused features ");
  ASSERT_NE(at, std::string::npos) << result_.out;
  const std::string finding = result_.out.substr(at, result_.out.find('\n', at) - at);
  EXPECT_THAT(read_file(directory_ / "report.html"), HasSubstr("<p class=\"finding\">" + finding + "</p>"));
}

// Every listed row is wrong and listed once, the surest first, and none is missing.
TEST_F(RunOutput, ListsTheMapsThatAreClassifiedWrongly) {
  const nlohmann::json metrics = metrics_of(directory_);
  for (const char* group : {"handmade", "cnn", "fused"}) {
    const auto& entry = metrics.at(group).at("group");
    const std::size_t errors =
        entry.at("rows").get<std::size_t>() -
        static_cast<std::size_t>(std::lround(entry.at("accuracy").get<double>() * entry.at("rows").get<double>()));
    const nlohmann::json wrong = entry.value("wrong", nlohmann::json::array());
    EXPECT_EQ(wrong.empty(), errors == 0);
    EXPECT_LE(wrong.size(), std::min<std::size_t>(errors, 12));
    std::set<int> rows;
    double last = 1;
    for (const nlohmann::json& map : wrong) {
      EXPECT_NE(map.at("label"), map.at("declared"));
      EXPECT_TRUE(rows.insert(map.at("row").get<int>()).second);
      EXPECT_LE(map.at("probability"), last);
      EXPECT_GE(map.at("probability"), 0.5);
      last = map.at("probability");
    }
  }
}

TEST_F(RunOutput, HasMetricsOfThreeGroupsByWaveHeightUnderBothProtocols) {
  const nlohmann::json metrics = metrics_of(directory_);
  for (const char* group : {"handmade", "cnn", "fused"}) {
    for (const char* protocol : {"random", "group"}) {
      const auto& entry = metrics.at(group).at(protocol);
      const double accuracy = entry.at("accuracy");
      EXPECT_GE(accuracy, 0);
      EXPECT_LE(accuracy, 1);
      ASSERT_EQ(entry.at("by_wave_height").size(), 1u);
      EXPECT_EQ(entry.at("by_wave_height")[0].at("significant_wave_height_m"), 1);
    }
  }
  EXPECT_EQ(metrics.at("data").at("maps"), 40);
}

TEST_F(RunOutput, RepeatsItsNumbersBitForBit) {
  const TemporaryFolder folder;
  completed(
      {"run", "scenarios/points.yaml", "-o", folder.path() / "run", "--threads", "1", "--set", "learning.epochs=3"});
  nlohmann::json a = metrics_of(directory_), b = metrics_of(folder.path() / "run");
  a.erase("run");  // run times and threads
  b.erase("run");
  EXPECT_EQ(a, b);
  EXPECT_EQ(read_file(directory_ / "model" / "network.bin"),
            read_file(folder.path() / "run" / "model" / "network.bin"));
}

TEST_F(RunOutput, IsRefusedAsATargetWithoutResumeAndContinuedWithIt) {
  expect_refused({"run", "scenarios/points.yaml", "-o", directory_, "--set", "learning.epochs=3"}, "--resume");
  const std::string before = read_file(directory_ / "model" / "fused.json");
  EXPECT_THAT(
      completed({"run", "scenarios/points.yaml", "-o", directory_, "--resume", "--set", "learning.epochs=3"}).out,
      HasSubstr("40 of 40 maps were there already"));
  EXPECT_EQ(read_file(directory_ / "model" / "fused.json"), before);
}

TEST_F(RunOutput, IsResumedAfterAKillDuringTraining) {
  for (const char* name : {"network.bin", "splits.csv", "embeddings.csv", "metrics.json"})
    fs::remove(directory_ / "model" / name);
  completed({"run", "scenarios/points.yaml", "-o", directory_, "--resume", "--set", "learning.epochs=3"});
  EXPECT_TRUE(fs::exists(directory_ / "model" / "network.bin"));
}

TEST_F(RunOutput, IsADataSetForTheCommandsOfOne) {
  const TemporaryFolder folder;
  for (const Words& words : {Words{"verify", directory_},
                             {"merge", directory_, "-o", folder.path() / "all.h5"},
                             {"export", directory_, "-o", folder.path() / "all.npz"},
                             {"regenerate", directory_, "--sample", "3"}}) {
    completed(words);
  }
}

TEST_F(RunOutput, CanBeTrainedOnAndReportedAgain) {
  const TemporaryFolder folder;
  completed({"train", directory_, "-o", folder.path() / "model", "--set", "learning.epochs=2"});
  EXPECT_TRUE(fs::exists(folder.path() / "model" / "network.bin"));
  const ProgramResult wrong =
      run_program({"train", directory_, "-o", folder.path() / "model", "--set", "radar.pulses=64"});
  EXPECT_EQ(wrong.code, 2);
  completed({"report", directory_});
  for (const std::string& data : {directory_.string() + "/data", directory_.string() + "/data/"}) {
    const ProgramResult of_data = run_program({"report", data});
    EXPECT_EQ(of_data.code, 2);
    EXPECT_EQ(of_data.err, "seaglint: " + data + ": not the directory of a run: it is the data set of " +
                               directory_.string() + "\n");
  }
}

TEST_F(RunOutput, IsNotReportedWithTheModelOfAnotherTrainingOrHalfOfOne) {
  const TemporaryFolder folder;
  fs::copy(directory_, folder.path() / "run", fs::copy_options::recursive);
  const fs::path model = folder.path() / "run" / "model";
  completed({"train", folder.path() / "run", "-o", model, "--set", "learning.epochs=2"});
  expect_refused({"report", folder.path() / "run"}, "is of another training than " + (model / "metrics.json").string());
  write_file(model / "metrics.json", "{\"seed\": ");
  const ProgramResult damaged = run_program({"report", folder.path() / "run"});
  EXPECT_EQ(damaged.code, 2);
  EXPECT_THAT(damaged.err, testing::StartsWith("seaglint: " + (model / "metrics.json").string() + ": no valid JSON"));
  fs::remove(model / "metrics.json");
  expect_refused({"report", folder.path() / "run"}, (model / "metrics.json").string() + ": missing");
}

TEST_F(RunOutput, IsNotReportedFromScoresThatAreDamaged) {
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  fs::copy(directory_, run, fs::copy_options::recursive);
  const nlohmann::json metrics = metrics_of(run);
  const auto reported_with = [&](const std::function<void(nlohmann::json&)>& damage) {
    nlohmann::json damaged = metrics;
    damage(damaged["fused"]["group"]);
    write_file(run / "metrics.json", damaged.dump());
    write_file(run / "model" / "metrics.json", nlohmann::json{{"fused", damaged["fused"]}}.dump());
    const ProgramResult result = run_program({"report", run});
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("seaglint: " + (run / "metrics.json").string() + ": "));
    return result.err;
  };
  EXPECT_THAT(reported_with([](auto& scores) { scores["accuracy_95"] = nlohmann::json::array(); }),
              HasSubstr("index 0"));
  EXPECT_THAT(reported_with([](auto& scores) { scores.erase("auc"); }), HasSubstr("key 'auc' not found"));
  EXPECT_THAT(reported_with([](auto& scores) { scores["confusion"].erase(scores["confusion"].begin()); }),
              HasSubstr("confusion: 3 counts of 2 classes"));
  EXPECT_THAT(reported_with([](auto& scores) { scores["roc"]["detections"].push_back(1); }),
              HasSubstr("false_alarms, "));
}

// The stored scenario specifies the contents of the maps.
TEST_F(RunOutput, IsReadWithItsOwnScenarioOnly) {
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run";
  fs::copy(directory_, run, fs::copy_options::recursive);
  const std::string whole = read_file(run / "scenario.yaml");
  std::string edited = whole;
  edited.replace(edited.find("scr_db: 20"), 10, "scr_db: 26");
  write_file(run / "scenario.yaml", edited);
  const ProgramResult reported = run_program({"report", run});
  EXPECT_EQ(reported.code, 2);
  EXPECT_THAT(reported.err, HasSubstr((run / "scenario.yaml").string() + ": is not the scenario of " +
                                      (run / "data" / "scenario.yaml").string()));
  EXPECT_THAT(reported.err, HasSubstr("scr_db: 20` there, `"));
  write_file(run / "data" / "scenario.yaml", edited);
  for (const Words& words : {Words{"report", run},
                             {"train", run, "-o", folder.path() / "model"},
                             {"export", run, "-o", folder.path() / "all.npz"},
                             {"regenerate", run, "--sample", "3"},
                             {"merge", run, "-o", folder.path() / "all.h5"}}) {
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 2) << words[0];
    EXPECT_THAT(result.err, HasSubstr((run / "data" / "scenario.yaml").string() +
                                      ": is not the one that the manifest was written for"))
        << words[0];
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST_F(RunOutput, ReportIsSelfContained) {
  const std::string page = read_file(directory_ / "report.html");
  EXPECT_THAT(page, HasSubstr("<h2>Range-velocity maps</h2>"));
  for (const char* outside : {"http://", "https://", "src=\"/", "<script src", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  const std::regex source("src=\"([^\"]{0,22})");
  std::size_t pictures = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), source), end; it != end; ++it, ++pictures) {
    EXPECT_EQ((*it)[1].str().substr(0, 11), "data:image/") << (*it)[1];
  }
  EXPECT_GE(pictures, 10u);
}

// Runs headless Chromium. A script that is added to a copy of the page writes its result into the title.
TEST_F(RunOutput, EveryPictureOfTheReportLoadsInABrowser) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) GTEST_SKIP() << "the package chromium is not installed";
  const TemporaryFolder folder;
  std::string page = read_file(directory_ / "report.html");
  const std::string script =
      "<script>addEventListener('load',()=>{const all=[...document.images];const "
      "bad=all.filter(i=>!i.complete||i.naturalWidth<100);"
      "const out=performance.getEntriesByType('resource').filter(e=>!e.name.startsWith('data:'));"
      "const wide=document.documentElement.scrollWidth>document.documentElement.clientWidth;"
      "document.body.setAttribute('data-found','pictures '+all.length+' broken '+bad.length+' requests '+out.length+' "
      "overflow '+wide)})"
      "</script></body>";
  page.replace(page.rfind("</body>"), 7, script);
  std::ofstream(folder.path() / "page.html") << page;
  const std::string command =
      "chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
      "--disable-component-update --disable-sync --window-size=1280,1000 --virtual-time-budget=5000 --user-data-dir='" +
      (folder.path() / "profile").string() + "' --dump-dom 'file://" + (folder.path() / "page.html").string() +
      "' 2>/dev/null >'" + (folder.path() / "dom").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::smatch found;
  const std::string dom = read_file(folder.path() / "dom");
  ASSERT_TRUE(std::regex_search(
      dom, found, std::regex("data-found=\"pictures ([0-9]+) broken ([0-9]+) requests ([0-9]+) overflow (\\w+)\"")));
  EXPECT_GE(std::stoi(found[1]), 10);
  EXPECT_EQ(found[2], "0") << "pictures that do not decode";
  EXPECT_EQ(found[3], "0") << "requests beyond the page";
  EXPECT_EQ(found[4], "false") << "the page is wider than the window";
}

// The page needs the maps; the targets' files are needed only for their figures and motion.
TEST(Report, IsWrittenWithoutMeshesThatAreNotFound) {
  const TemporaryFolder folder;
  const fs::path run = folder.path() / "run", scenario = folder.path() / "scenario.yaml";
  write_file(
      scenario,
      "seaglint: 1\ntargets:\n  one: {label: 1, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}\n"
      "  two: {label: 0, mesh: assets/icosahedral_reflector.glb, layout: {line: {count: 2, spacing_m: 20}}}\n"
      "radar: {pulses: 32}\ndataset: {maps_per_case: 10, realisations_per_case: 5}\nlearning: {epochs: 1}\n");
  completed({"run", scenario, "-o", run});
  EXPECT_THAT(read_file(run / "report.html"), HasSubstr("Picture of one"));
  const ProgramResult elsewhere = completed(
      run_words({"/bin/bash", "-c", "cd / && SEAGLINT_DATA=/ exec \"$@\"", "elsewhere", kProgram, "report", run}));
  EXPECT_THAT(elsewhere.err, HasSubstr("seaglint: warning: "));
  EXPECT_THAT(elsewhere.err, HasSubstr("targets.one.mesh: value 'assets/icosahedral_reflector.glb': no such file"));
  const std::string page = read_file(run / "report.html");
  EXPECT_THAT(page, Not(HasSubstr("Picture of one")));
  EXPECT_THAT(page, HasSubstr("Neither the targets nor their motion are drawn"));
  EXPECT_THAT(page, HasSubstr("Elevation of the sea against time"));
}

TEST(Run, ReportsErrorsOfLearningBeforeAnyWork) {
  const TemporaryFolder folder;
  expect_refused({"run", "scenarios/points.yaml", "-o", folder.path() / "run", "--set", "dataset.maps_per_case=2",
                  "--set", "dataset.realisations_per_case=2"},
                 "realisations_per_case");
  expect_refused({"run", "scenarios/points.yaml", "-o", folder.path() / "run", "--set", "targets.line.label=0"},
                 "label");
  EXPECT_FALSE(fs::exists(folder.path() / "run"));
}

TEST(Run, ReportsAMissingGnuplotBeforeAnyWork) {
  const TemporaryFolder folder;
  const ProgramResult result = run_words({"/usr/bin/env", "PATH=" + folder.path().string(), kProgram, "run",
                                          "scenarios/points.yaml", "-o", folder.path() / "run"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("install the package gnuplot-nox"));
  EXPECT_FALSE(fs::exists(folder.path() / "run"));
}

TEST(Report, RefusesADirectoryThatIsNoRun) {
  const TemporaryFolder folder;
  expect_refused({"report", folder.path()}, "scenario.yaml");
  EXPECT_EQ(run_program({"train", folder.path(), "-o", folder.path() / "model"}).code, 2);
}

}  // namespace
}  // namespace seaglint
