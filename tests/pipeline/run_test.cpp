// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>

#include "tests/pipeline/program.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

// The main job on ideal points: from scenario to report, and the report in a browser.

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// One finished run for all tests of this file.
class RunOutput : public SharedFolder {
 protected:
  static void SetUpTestSuite() { result_ = run_program(run({})); }
  // `run` with these words more.
  static Words run(const Words& more) {
    return with({"run", kPoints, "-o", directory(), "--set", "learning.epochs=3"}, more);
  }
  static fs::path directory() { return path("run"); }
  // A copy of the run.
  static fs::path copy_in(const TemporaryFolder& folder) {
    fs::copy(directory(), folder.path() / "run", fs::copy_options::recursive);
    return folder.path() / "run";
  }

  static inline ProgramResult result_;
};

nlohmann::json metrics_of(const fs::path& directory) {
  return nlohmann::json::parse(read_file(directory / "metrics.json"));
}

TEST_F(RunOutput, PrintsTheAccuracyTableAndWhereTheReportIs) {
  ASSERT_EQ(result_.code, 0) << result_.err;
  EXPECT_HAS(result_.out, "hand-made");
  EXPECT_HAS(result_.out, "fused");
  EXPECT_HAS(result_.out, "Report: " + (directory() / "report.html").string());
}

TEST_F(RunOutput, EndsInTheFindingThatTheReportBeginsWith) {
  const std::size_t at = result_.out.find("On unseen seas the fused features ");
  ASSERT_NE(at, std::string::npos) << result_.out;
  const std::string finding = result_.out.substr(at, result_.out.find('\n', at) - at);
  EXPECT_THAT(read_file(directory() / "report.html"), HasSubstr("<p class=\"finding\">" + finding + "</p>"));
}

// Every listed row is wrong and listed once, the surest first, and none is missing.
TEST_F(RunOutput, ListsTheMapsThatAreClassifiedWrongly) {
  const nlohmann::json metrics = metrics_of(directory());
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
  const nlohmann::json metrics = metrics_of(directory());
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
  completed({"run", kPoints, "-o", folder.path() / "run", "--threads", "1", "--set", "learning.epochs=3"});
  nlohmann::json a = metrics_of(directory()), b = metrics_of(folder.path() / "run");
  a.erase("run");  // run times and threads
  b.erase("run");
  EXPECT_EQ(a, b);
  EXPECT_EQ(read_file(directory() / "model" / "network.bin"),
            read_file(folder.path() / "run" / "model" / "network.bin"));
}

TEST_F(RunOutput, IsRefusedAsATargetWithoutResumeAndContinuedWithIt) {
  expect_refused(run({}), "--resume");
  const std::string before = read_file(directory() / "model" / "fused.json");
  EXPECT_HAS(completed(run({"--resume"})).out, "40 of 40 maps were there already");
  EXPECT_EQ(read_file(directory() / "model" / "fused.json"), before);
}

TEST_F(RunOutput, IsResumedAfterAKillDuringTraining) {
  for (const char* name : {"network.bin", "splits.csv", "embeddings.csv", "metrics.json"})
    fs::remove(directory() / "model" / name);
  completed(run({"--resume"}));
  EXPECT_TRUE(fs::exists(directory() / "model" / "network.bin"));
}

TEST_F(RunOutput, IsADataSetForTheCommandsOfOne) {
  const TemporaryFolder folder;
  for (const Words& words : {Words{"verify", directory()},
                             {"merge", directory(), "-o", folder.path() / "all.h5"},
                             {"export", directory(), "-o", folder.path() / "all.npz"},
                             {"regenerate", directory(), "--sample", "3"}})
    completed(words);
}

TEST_F(RunOutput, CanBeTrainedOnAndReportedAgain) {
  const TemporaryFolder folder;
  completed({"train", directory(), "-o", folder.path() / "model", "--set", "learning.epochs=2"});
  EXPECT_TRUE(fs::exists(folder.path() / "model" / "network.bin"));
  EXPECT_EQ(run_program({"train", directory(), "-o", folder.path() / "model", "--set", "radar.pulses=64"}).code, 2);
  completed({"report", directory()});
  for (const std::string& data : {directory().string() + "/data", directory().string() + "/data/"})
    EXPECT_EQ(
        run_program({"report", data}).err,
        "seaglint: " + data + ": not the directory of a run: it is the data set of " + directory().string() + "\n");
}

TEST_F(RunOutput, IsNotReportedWithTheModelOfAnotherTrainingOrHalfOfOne) {
  const TemporaryFolder folder;
  const fs::path copy = copy_in(folder), model = copy / "model", metrics = model / "metrics.json";
  completed({"train", copy, "-o", model, "--set", "learning.epochs=2"});
  expect_refused({"report", copy}, "is of another training than " + metrics.string());
  write_file(metrics, "{\"seed\": ");
  expect_refused({"report", copy}, "seaglint: " + metrics.string() + ": no valid JSON");
  fs::remove(metrics);
  expect_refused({"report", copy}, metrics.string() + ": missing");
}

TEST_F(RunOutput, IsNotReportedFromScoresThatAreDamaged) {
  const TemporaryFolder folder;
  const fs::path run = copy_in(folder);
  const nlohmann::json metrics = metrics_of(run);
  const auto refused_with = [&](const std::function<void(nlohmann::json&)>& damage, const char* message) {
    nlohmann::json damaged = metrics;
    damage(damaged["fused"]["group"]);
    write_file(run / "metrics.json", damaged.dump());
    write_file(run / "model" / "metrics.json", nlohmann::json{{"fused", damaged["fused"]}}.dump());
    const ProgramResult result = run_program({"report", run});
    expect_refused(result, message);
    EXPECT_THAT(result.err, testing::StartsWith("seaglint: " + (run / "metrics.json").string() + ": "));
  };
  refused_with([](auto& scores) { scores["accuracy_95"] = nlohmann::json::array(); }, "index 0");
  refused_with([](auto& scores) { scores.erase("auc"); }, "key 'auc' not found");
  refused_with([](auto& scores) { scores["confusion"].erase(scores["confusion"].begin()); },
               "confusion: 3 counts of 2 classes");
  refused_with([](auto& scores) { scores["roc"]["detections"].push_back(1); }, "false_alarms, ");
}

// The stored scenario specifies the contents of the maps.
TEST_F(RunOutput, IsReadWithItsOwnScenarioOnly) {
  const TemporaryFolder folder;
  const fs::path run = copy_in(folder);
  const std::string whole = read_file(run / "scenario.yaml");
  std::string edited = whole;
  edited.replace(edited.find("scr_db: 20"), 10, "scr_db: 26");
  write_file(run / "scenario.yaml", edited);
  const std::string stored = run / "data" / "scenario.yaml";
  const ProgramResult reported = run_program({"report", run});
  expect_refused(reported, (run / "scenario.yaml").string() + ": is not the scenario of " + stored);
  EXPECT_HAS(reported.err, "scr_db: 20` there, `");
  write_file(stored, edited);
  for (const Words& words : {Words{"report", run},
                             {"train", run, "-o", folder.path() / "model"},
                             {"export", run, "-o", folder.path() / "all.npz"},
                             {"regenerate", run, "--sample", "3"},
                             {"merge", run, "-o", folder.path() / "all.h5"}})
    expect_refused(words, stored + ": is not the one that the manifest was written for");
  EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("run"));
}

TEST_F(RunOutput, ReportIsSelfContained) {
  const std::string page = read_file(directory() / "report.html");
  EXPECT_HAS(page, "<h2>Range-velocity maps</h2>");
  for (const char* outside : {"http://", "https://", "src=\"/", "<script src", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  const std::regex source("src=\"([^\"]{0,22})");
  std::size_t pictures = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), source), end; it != end; ++it, ++pictures)
    EXPECT_EQ((*it)[1].str().substr(0, 11), "data:image/") << (*it)[1];
  EXPECT_GE(pictures, 10u);
}

// Runs headless Chromium. A script that is added to a copy of the page writes its result into the title.
TEST_F(RunOutput, EveryPictureOfTheReportLoadsInABrowser) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0) GTEST_SKIP() << "the package chromium is not installed";
  const TemporaryFolder folder;
  std::string page = read_file(directory() / "report.html");
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
  EXPECT_HAS(read_file(run / "report.html"), "Picture of one");
  const ProgramResult elsewhere = completed(
      run_words({"/bin/bash", "-c", "cd / && SEAGLINT_DATA=/ exec \"$@\"", "elsewhere", kProgram, "report", run}));
  EXPECT_HAS(elsewhere.err, "seaglint: warning: ");
  EXPECT_HAS(elsewhere.err, "targets.one.mesh: value 'assets/icosahedral_reflector.glb': no such file");
  const std::string page = read_file(run / "report.html");
  EXPECT_THAT(page, Not(HasSubstr("Picture of one")));
  EXPECT_HAS(page, "Neither the targets nor their motion are drawn");
  EXPECT_HAS(page, "Elevation of the sea and angles of the targets against time");
}

TEST(Run, ReportsErrorsOfLearningAndAMissingGnuplotBeforeAnyWork) {
  const TemporaryFolder folder;
  const Words run{"run", kPoints, "-o", folder.path() / "run", "--set"};
  expect_refused(with(run, {"dataset.maps_per_case=2", "--set", "dataset.realisations_per_case=2"}),
                 "realisations_per_case");
  expect_refused(with(run, {"targets.line.label=0"}), "label");
  EXPECT_FALSE(fs::exists(folder.path() / "run"));
  // without gnuplot
  const ProgramResult result = run_words(
      {"/usr/bin/env", "PATH=" + folder.path().string(), kProgram, "run", kPoints, "-o", folder.path() / "run"});
  EXPECT_EQ(result.code, 1);
  EXPECT_HAS(result.err, "install the package gnuplot-nox");
  EXPECT_FALSE(fs::exists(folder.path() / "run"));
}

TEST(Report, RefusesADirectoryThatIsNoRun) {
  const TemporaryFolder folder;
  expect_refused({"report", folder.path()}, "scenario.yaml");
  EXPECT_EQ(run_program({"train", folder.path(), "-o", folder.path() / "model"}).code, 2);
}

// `seaglint map` on ideal points.

// One approaching point 30 m nearer than the reference point, viewed from ahead.
const Words kOnePoint = {
    "--set", "view={azimuth_deg: 0, elevation_deg: 0}", "--set",
    "targets={line: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.5, 0, 0]}]}}"};

std::vector<std::string> map_of(const std::string& output, Words more = {}) {
  return with({"map", kPoints, "-o", output}, more);
}

// Range, velocity and amplitude of the listed centres.
std::vector<std::array<double, 3>> centres_in(const std::string& list) {
  std::istringstream lines(list);
  std::string header;
  std::getline(lines, header);
  std::vector<std::array<double, 3>> centres;
  for (std::array<double, 3> c{}; lines >> c[0] >> c[1] >> c[2];) centres.push_back(c);
  return centres;
}

std::vector<std::array<double, 3>> cluster_centres(const Words& more) {
  const TemporaryFolder folder;
  return centres_in(completed(map_of(folder.path() / "map.png", more)).out);
}

TEST(MapCommand, DrawsTheMapAndListsTheCentre) {
  const TemporaryFolder folder;
  const ProgramResult result = completed(map_of(folder.path() / "map.png", kOnePoint));
  EXPECT_TRUE(read_file(folder.path() / "map.png").starts_with("\x89PNG"));
  const auto centre = centres_in(result.out).at(0);
  EXPECT_NEAR(centre[0], -30, 0.075);    // a tenth of a cell
  EXPECT_NEAR(centre[1], -1.5, 0.0146);  // approaching
  EXPECT_NEAR(centre[2], 2, 0.04);       // 20 dB of clutter per pulse, 50 dB in the peak cell
  EXPECT_HAS(result.out, "SCR per pulse 20.00 dB");
}

// The text of the figure of a map.
std::string figure_text(const Words& more) {
  const TemporaryFolder folder;
  completed(map_of(folder.path() / "map.svg", with(kOnePoint, more)));
  return read_file(folder.path() / "map.svg");
}

TEST(MapCommand, ShowsTheTargetsWindowUnlessTheWholeIsWanted) {
  const std::string text = figure_text({});
  for (const char* word :
       {"whole map", "1 scattering centre", "line, azimuth 0 deg, Hs", "carrier 16 GHz", "sample 0, seed"})
    EXPECT_HAS(text, word);
  const std::string whole = figure_text({"--whole", "--centres", "off"});
  EXPECT_THAT(whole, Not(HasSubstr("whole map")));
  EXPECT_THAT(whole, Not(HasSubstr("scattering centre")));
  // Clutter 40 dB above the target in every pulse.
  EXPECT_THAT(figure_text({"--set", "clutter.scr_db=-60"}), HasSubstr("whole map: "));
  EXPECT_THAT(figure_text({"--style", "paper"}), HasSubstr("width=\"333\""));
}

TEST(MapCommand, DrawsTheImageAndTheProfileOfTheTarget) {
  const std::string image = figure_text({"--product", "isar"});
  for (const char* word : {"ISAR: line, azimuth 0 deg", "target alone, whole band in every pulse", "no cross range: "})
    EXPECT_THAT(image, HasSubstr(word));
  const std::string profile = figure_text({"--product", "hrrp"});
  for (const char* word : {"range profile: line", "point 1", "RCS (dBsm)", "level to peak (dB)"})
    EXPECT_THAT(profile, HasSubstr(word));
  // 2 m: 17 dBsm.
  EXPECT_THAT(profile, HasSubstr("0 dB below: 17.0 dBsm"));
}

// A chirp narrower than the carrier step leaves gaps in the band, and centres are listed at empty places.
TEST(MapCommand, EchoAndGenerateWarnOfGapsInTheBand) {
  const TemporaryFolder folder;
  const std::string warning =
      "seaglint: warning: radar.bandwidth_mhz: 24 MHz between the bands of neighbouring carriers: range sidelobes "
      "every 5.996 m\n";
  const std::vector<std::string> gaps{"--set", "radar.bandwidth_mhz=1"};
  const Words echo = with({"echo", kPoints, "-o", folder.path() / "echo.npz"}, gaps),
              generate = with(with({"generate", kPoints, "-o", folder.path() / "data"}, gaps),
                              {"--set", "dataset={maps_per_case: 1, realisations_per_case: 1}"});
  for (const Words& words : {map_of(folder.path() / "map.png", gaps), echo, generate})
    EXPECT_HAS(completed(words).err, warning) << words[0];
  EXPECT_EQ(run_program(map_of(folder.path() / "map.png")).err, "");
}

TEST(MapCommand, APointOnAConductingSeaIsFourTimesAsStrong) {
  // On the plane itself all four paths are equal, and rho_v = +1.
  const auto amplitude = [&](const std::string& reflection) {
    return cluster_centres({"--set", "view={azimuth_deg: 0, elevation_deg: 2}", "--set",
                            "targets={line: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2}]}}", "--set",
                            "sea_reflection={" + reflection + "surface: conductor, roughness: none}"})
        .at(0)[2];
  };
  EXPECT_NEAR(amplitude(""), 2, 0.04);
  EXPECT_NEAR(amplitude("enabled: true, "), 8, 0.16);
  EXPECT_NEAR(amplitude("enabled: true, paths: multipath_only, "), 6, 0.12);
}

TEST(MapCommand, RefusesASeaReflectionWithoutAnImageAndARadarThatSinksIntoTheSea) {
  const TemporaryFolder folder;
  const Words map = map_of(folder.path() / "map.png", with(kOnePoint, {"--set", "sea_reflection.enabled=true"}));
  expect_refused(map, "view.elevation_deg: value '0': must be greater than 0 with sea_reflection");
  // 64 ms at 1000 m/s, from 0.2 deg at 10 km.
  expect_refused(
      with_settings(map, {"view.elevation_deg=0.2", "radar.range_km=10", "radar.platform.velocity_mps=[0, 0, -1000]"}),
      "radar.platform.velocity_mps: value -1000 upwards: the radar sinks 64 m in an interval, "
      "must be less than its height, 34.91 m, with sea_reflection");
}

TEST(MapCommand, WarnsAboutPointsOutsideTheMap) {
  const TemporaryFolder folder;
  const Words more = with(kOnePoint, {"--set", "map.velocity_span_mps=2"});
  EXPECT_HAS(completed(map_of(folder.path() / "map.svg", more)).err, "moves at -1.50 to 0.00 m/s, the map shows");
}

TEST(MapCommand, ACompanionIsInTheSameMap) {
  const std::string targets =
      "targets={one: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1, 0, 0]}], "
      "companions: [{target: other, x_m: -50, y_m: 8}]}, other: {label: 0, points: [{position_m: [5, 0, 0]}]}}";
  const auto centres_in = [&](const std::string& sample) {
    return cluster_centres(with_settings(
        {"--sample", sample}, {"view={azimuth_deg: 0, elevation_deg: 0}", targets,
                               "dataset={maps_per_case: 1, realisations_per_case: 1}", "clutter.scr_db=60"}));
  };
  // Which of the two targets sample 0 contains is random; the companion is placed with one of them.
  const auto first = centres_in("0"), second = centres_in("1");
  const auto& both = first.size() > second.size() ? first : second;
  const auto& alone = first.size() > second.size() ? second : first;
  ASSERT_EQ(both.size(), 2u);
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_NEAR(both[0][0], -30, 0.02);
  EXPECT_NEAR(both[0][1], -1, 0.005);
  EXPECT_NEAR(both[1][0], 45, 0.02);
  EXPECT_NEAR(both[1][2], 1, 0.02);
  EXPECT_NEAR(alone[0][0], -5, 0.02);
}

// A ship at 2 m/s, viewed from 60 deg off the bow: floats and ideal points, which stay in the water, drift astern at 2
// cos 60 = 1 m/s; another ship of the same speed keeps its position.
TEST(MapCommand, CompanionsOfAShipUnderWayStayInTheWater) {
  const std::string corner = "mesh: assets/icosahedral_reflector.glb", hull = "length_m: 140, beam_m: 19, draught_m: 6";
  const auto centres = [&](const std::string& with) {
    const std::string targets = fmt::format(
        "targets={{flagship: {{label: 1, {0}, motion: {{model: ship, speed_mps: 2, {1}}}, companions: [{2}]}}, "
        "consort: {{label: 1, {0}, motion: {{model: ship, speed_mps: 2, {1}}}}}, "
        "decoy: {{label: 0, {0}, motion: {{model: float}}}}, "
        "buoy: {{label: 0, points: [{{position_m: [0, 0, 0], amplitude_m: 4}}]}}}}",
        corner, hull, with);
    std::vector<std::array<double, 3>> most;
    for (const char* sample : {"0", "1", "2", "3"}) {
      const auto found = cluster_centres({"--set", "view={azimuth_deg: 60, elevation_deg: 0}", "--set",
                                          "sea={significant_wave_height_m: 0}", "--set", targets, "--set",
                                          "dataset={maps_per_case: 1, realisations_per_case: 1}", "--set",
                                          "clutter.enabled=false", "--sample", sample});
      if (found.size() > most.size()) most = found;
    }
    return most;
  };
  // Velocity of the strongest centre within a metre of the range of a companion at x = -80 m.
  const auto velocity_at_40_m = [&](const std::string& companion) {
    std::array<double, 3> strongest{0, 99, 0};
    for (const auto& centre : centres("{target: " + companion + ", x_m: -80}"))
      if (std::abs(centre[0] - 40) < 1 && centre[2] > strongest[2]) strongest = centre;
    return strongest[1];
  };
  EXPECT_NEAR(velocity_at_40_m("decoy"), 1, 0.0146);  // a tenth of a cell
  EXPECT_NEAR(velocity_at_40_m("buoy"), 1, 0.0146);
  EXPECT_NEAR(velocity_at_40_m("consort"), 0, 0.0146);
}

// Seen from 60 deg: a current of 1 m/s towards the radar and the leeway of a wind of 20 m/s towards 150 deg, across the
// line of sight. A companion of a ship at 2 m/s drifts astern besides, at 2 cos 60 = 1 m/s; a towed one stays.
TEST(MapCommand, FloatsDriftAndTowedOnesKeepTheirPlace) {
  const auto centres = [&](const std::string& companion, const std::string& drift) {
    const std::string corner = "mesh: assets/icosahedral_reflector.glb",
                      targets = fmt::format(
                          "targets={{ship: {{label: 1, {0}, motion: {{model: ship, speed_mps: 2, length_m: 140, "
                          "beam_m: 19, draught_m: 6}}, companions: [{{target: decoy, x_m: -80, {1}}}]}}, "
                          "decoy: {{role: part, {0}, motion: {{model: float, {2}}}}}}}",
                          corner, companion, drift);
    return cluster_centres({"--set", "view={azimuth_deg: 60, elevation_deg: 0}", "--set",
                            "sea={significant_wave_height_m: 0}", "--set", targets, "--set",
                            "dataset={maps_per_case: 1, realisations_per_case: 1}", "--set", "clutter.enabled=false"});
  };
  const auto velocity_at_40_m = [&](const std::string& companion, const std::string& drift) {
    std::array<double, 3> strongest{0, 99, 0};
    for (const auto& centre : centres(companion, drift))
      if (std::abs(centre[0] - 40) < 1 && centre[2] > strongest[2]) strongest = centre;
    return strongest[1];
  };
  constexpr double kTenthOfCell = 0.0146;
  EXPECT_NEAR(velocity_at_40_m("y_m: 0", ""), 1, kTenthOfCell);
  EXPECT_NEAR(velocity_at_40_m("y_m: 0", "drift: {current_mps: 1, current_towards_deg: 60}"), 0, kTenthOfCell);
  EXPECT_NEAR(velocity_at_40_m("y_m: 0", "drift: {wind_mps: 20, wind_towards_deg: -120, leeway: 0.05}"), 2,
              kTenthOfCell);
  EXPECT_NEAR(velocity_at_40_m("y_m: 0", "drift: {wind_mps: 20, wind_towards_deg: 150, leeway: 0.05}"), 1,
              kTenthOfCell);
  EXPECT_NEAR(velocity_at_40_m("towed: true", ""), 0, kTenthOfCell);
}

TEST(MapCommand, PlatformMotionIsVisibleUnlessCompensated) {
  const Words moving = with(
      kOnePoint,
      {"--set", "radar.platform={velocity_mps: [2.5, 0, 0], motion_compensated: false}", "--set", "clutter.scr_db=60"});
  const auto detected = cluster_centres(moving);
  ASSERT_GE(detected.size(), 1u);
  EXPECT_NEAR(detected[0][1], -1.5 + 2.5, 0.005);  // the radar ahead recedes
  EXPECT_NEAR(detected[0][0], -30, 0.02);
  EXPECT_NEAR(cluster_centres(with(moving, {"--set", "radar.platform.motion_compensated=true"}))[0][1], -1.5, 0.005);
}

// `seaglint echo`: the samples that NumPy reads are the chirp of the scenario, delayed by the point's range.

// One point of 2 m, 30 m nearer than the reference point, approaching at 1.5 m/s.
std::vector<std::string> echo_of(const std::string& output, Words more = {}) {
  return with(with({"echo", kPoints, "-o", output}, kOnePoint), more);
}

TEST(EchoCommand, WritesSamplesThatNumpyCompressesToThePoint) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "echo.npz";
  EXPECT_HAS(completed(echo_of(file)).out, "256 pulses of");
  if (run_words({kPython, "-c", "import numpy"}).code != 0) GTEST_SKIP() << "needs the package python3-numpy";
  // Correlates pulses with the ideal chirp, delayed, and removes the carrier's phase of the point's range.
  const ProgramResult read = completed(run_words({kPython, "-c", R"(
import sys, numpy as np
a = np.load(sys.argv[1])
c, mu, width = 299792458.0, 25e6 / 36e-6, 36e-6
t = a['time_s']
def correlation(n, r):
    u = t - 2 * r / c
    return np.vdot(np.where(abs(u) < width / 2, np.exp(1j * np.pi * mu * u * u), 0), a['target'][n]) / (width * 50e6)
ranges = np.arange(-60, 60, 0.25)
best = ranges[np.argmax([abs(correlation(0, r)) for r in ranges])]
assert abs(best + 30) <= 0.5, best
for n in (0, 100, 255):
    r = -30 - 1.5 * a['pulse_time_s'][n]
    z = correlation(n, r) * np.exp(4j * np.pi * a['carrier_hz'][n] * r / c)
    assert abs(z - 2) < 0.04, z   # the ideal chirp has a few percent of its energy beyond the band
assert a['clutter'].shape == a['noise'].shape == a['target'].shape
print('point found')
)",
                                                  file}));
  EXPECT_EQ(read.out, "point found\n");
}

TEST(EchoCommand, RefusesSamplesThatDoNotExistAndMoreThanFitIntoMemory) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_program(map_of(folder.path() / "map.png", {"--sample", "1000000"})).code, 2);
  expect_refused(echo_of(folder.path() / "echo.npz", {"--sample", "1000000"}),
                 "--sample 1000000: the scenario has samples 0 to");
  const std::string file = folder.path() / "echo.npz";
  expect_refused(echo_of(file, {"--set", "radar.pulses=65536", "--set", "radar.sampling_mhz=1000"}),
                 "--set radar.pulses: value 65536: with 38280 samples of each pulse at most 3506 "
                 "pulses make an echo");
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace seaglint
