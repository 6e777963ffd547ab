// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "classify/dataset/format/shard.h"
#include "sim/core/numbers/constants.h"
#include "tests/pipeline/program.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

// Three classes with names, from the scenario to the report, the evaluation and single maps; refusals of scenarios,
// data sets and models whose classes do not fit.

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

class ThreeClasses : public SharedFolder {
 protected:
  static void SetUpTestSuite() {
    write_file(path("three.yaml"), scenario_text(kThree, "2"));
    run_ = run_program({"run", path("three.yaml"), "-o", path("run"), "--threads", "2"});
  }
  void SetUp() override { ASSERT_EQ(run_.code, 0) << run_.err; }

  static inline ProgramResult run_;
};

TEST_F(ThreeClasses, AreNamedInTheDataSetAndItsCard) {
  const json manifest = json::parse(read_file(path("run/data/manifest.json")));
  EXPECT_EQ(manifest["classes"], (Words{"decoys", "ship", "guarded ship"}));
  EXPECT_HAS(manifest["columns"].dump(), "0 = decoys, 1 = ship, 2 = guarded ship");
  EXPECT_THAT(read_shard(path("run/data/shard_00000.h5")).classes, ElementsAre("decoys", "ship", "guarded ship"));
  EXPECT_THAT(read_file(path("run/data/README.md")),
              AllOf(HasSubstr("| guarded | 2 (guarded ship) | 20 |"), HasSubstr("0 = decoys, 1 = ship, 2 = guarded")));
  completed({"verify", path("run/data")});
  completed({"merge", path("run/data")});
}

TEST_F(ThreeClasses, AreScoredAndReported) {
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
  EXPECT_THAT(html, AllOf(HasSubstr("Decoys or ship or guarded ship?"), HasSubstr("declared guarded ship"),
                          HasSubstr("must stay near 33 %"), HasSubstr("mean over pairs of classes")));
  completed({"report", path("run")});
}

TEST_F(ThreeClasses, HaveOneModelForAnyNumberOfThreads) {
  completed({"train", path("run/data"), "-o", path("again"), "--threads", "1"});
  for (const char* file : {"network.bin", "fused.json", "metrics.json", "model.json", "embeddings.csv"})
    EXPECT_EQ(read_file(path("again") + "/" + file), read_file(path("run/model/") + file)) << file;
}

TEST_F(ThreeClasses, AreEvaluatedAndClassifiedWithAProbabilityEach) {
  EXPECT_HAS(completed({"evaluate", path("run/model"), path("run/data"), "-o", path("evaluation")}).out,
             "guarded ship declared ship");
  const json evaluation = json::parse(read_file(path("evaluation/evaluation.json")));
  EXPECT_TRUE(evaluation.at("fused").at("calibration").at("bins")[0].contains("right"));
  EXPECT_TRUE(evaluation.at("fused").at("roc").contains("guarded_ship"));
  EXPECT_HAS(read_file(path("evaluation/probabilities.csv")),
             ",probability_fused_decoys,probability_fused_ship,probability_fused_guarded_ship,");

  EXPECT_THAT(run_program({"classify", path("run/model"), path("run/data"), "--sample", "3"}).out,
              AllOf(HasSubstr("P(guarded ship)"), HasSubstr("guarded ship, 5 / 50 / 95 %")));
  const ProgramResult all = run_program({"classify", path("run/model"), path("run/data"), "-o", path("all.csv")});
  EXPECT_HAS(all.out, "P(decision)");
  EXPECT_HAS(read_file(path("all.csv")), "probability_cnn_guarded_ship");
}

TEST_F(ThreeClasses, OfAnotherDataSetOrModelAreRefused) {
  for (const auto& [name, classes] :
       {std::pair{"renamed", "[decoys, ship, escort]"}, {"reordered", "[ship, decoys, guarded ship]"}}) {
    completed({"generate", path("three.yaml"), "-o", path(name), "--set", fmt::format("dataset.classes={}", classes),
               "--set", "seed=7"});
    expect_refused({"evaluate", path("run/model"), path(name)}, "maps of other classes: ");
    expect_refused({"classify", path("run/model"), path(name)}, "maps of other classes: ");
    expect_refused({"train", path("run/data"), path(name), "-o", path("both")}, "other classes than ");
    EXPECT_FALSE(fs::exists(path("both")));
  }
  fs::copy(path("run/model"), path("two"));
  json card = json::parse(read_file(path("two/model.json")));
  card["classes"] = {"decoys", "ship"};
  write_file(path("two/model.json"), card.dump());
  expect_refused({"evaluate", path("two"), path("run/data")}, "handmade.json: of 3 classes, by ");
}

TEST_F(ThreeClasses, NeedATargetEachToLearn) {
  write_file(path("lacking.yaml"), scenario_text(kThree, "1"));
  expect_refused({"run", path("lacking.yaml"), "-o", path("none")},
                 "learning needs a target of every class, also of 'guarded ship' (label 2)");
  EXPECT_FALSE(fs::exists(path("none")));
  write_file(path("beyond.yaml"), scenario_text(kThree, "3"));
  expect_refused({"check", path("beyond.yaml")}, "must be within 0 and 2, a class of dataset.classes: decoys, ship");
  write_file(path("default.yaml"), scenario_text("", "2"));
  expect_refused({"check", path("default.yaml")}, "must be 0 or 1, a class of dataset.classes: array, ship");

  const ProgramResult shared = completed({"check", path("lacking.yaml")});
  EXPECT_HAS(shared.err, "label 1 (ship) is shared by 2 targets (line, guarded): 40 of 60 maps");
  completed({"generate", path("lacking.yaml"), "-o", path("lacking")});
  expect_refused({"train", path("lacking"), "-o", path("none")},
                 "none of 60 maps is of class 2 (guarded ship); learning needs all 3 classes");
  // A model of three classes is applied to maps of two of them.
  completed({"evaluate", path("run/model"), path("lacking"), "--trained-rows"});
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
  completed({"generate", path("five.yaml"), "-o", path("five")});
  expect_refused({"train", path("five"), "-o", path("none"), "--by", "target_name", "--set", "dataset.split=1:1"},
                 "leaves no map of class 2 (guarded ship) to train on");
}

// `seaglint classify MODEL ECHO.npz`: an echo over time has the features and probabilities of its sample in the data
// set, to rounding without noise and within the noise with it.

constexpr const char* kFaintNoise = "clutter.cnr_db=200";  // 140 dB below the rounding of single precision
// Two points of one amplitude, receding at +-1.2 m/s, as near to each other as to a line.
constexpr const char* kTwoPoints =
    "targets={pair: {label: 1, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.2, 0, 0]}, "
    "{position_m: [-30, 0, 0], amplitude_m: 2, velocity_mps: [-1.2, 0, 0]}]}, reflectors: {label: 0, points: "
    "[{position_m: [0, 0, 0]}]}}";

class EchoOverTime : public SharedFolder {
 protected:
  static void SetUpTestSuite() {
    run({"generate", kPoints, "-o", path("data"), "--set", kFaintNoise});
    run({"train", path("data"), "-o", path("model"), "--set", "learning.epochs=2", "--set", "learning.trees=20"});
  }
  static std::string run(const Words& words) { return completed(words).out; }

  // The echo of a sample of points.yaml with these settings.
  static std::string echo(int sample, const Words& settings) {
    std::string file = path("echo.npz");
    run(with_settings({"echo", kPoints, "--sample", std::to_string(sample), "-o", file}, settings));
    return file;
  }

  // Cells of the only line of the table of `classify`.
  static std::vector<std::string> classified(const Words& what) {
    run(with(with({"classify", path("model")}, what), {"-o", path("one.csv")}));
    std::istringstream lines(read_file(path("one.csv")));
    std::string line;
    std::getline(lines, line);
    EXPECT_HAS(line,
               "sample,label,probability_handmade,probability_cnn,probability_fused,probability_"
               "extended,mwr,ccf,sigma_r_m,sigma_v_mps,outside");
    std::getline(lines, line);
    std::istringstream cells(line + " ");
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    EXPECT_EQ(values.size(), 11u);
    return values;
  }
};

// Samples of an echo are rounded to 24 bits, of the largest amplitude of all points, 8 m, relative to the smallest one
// that is a centre, some 1 m: 5e-7 of a cell at each centre, which the residuals of mwr, a tenth of a cell and more,
// have five times. Single precision of the stored features adds 6e-8.
TEST_F(EchoOverTime, HasTheFeaturesAndProbabilitiesOfItsSampleToRounding) {
  double most = 0;
  for (const int sample : {0, 3, 17, 39}) {
    const std::vector<std::string> of_set = classified({path("data"), "--sample", std::to_string(sample)});
    const std::vector<std::string> of_echo = classified({echo(sample, {kFaintNoise})});
    EXPECT_EQ(of_echo[0], std::to_string(sample));
    for (const std::size_t cell : {0, 1, 2, 3, 4, 5, 10})
      EXPECT_EQ(of_echo[cell], of_set[cell]) << sample << " " << cell;
    for (std::size_t cell = 6; cell < 10; ++cell)
      most = std::max(most, std::abs(std::stod(of_echo[cell]) / std::stod(of_set[cell]) - 1));
  }
  std::printf("features of an echo over time, largest relative difference: %.1e\n", most);
  EXPECT_LT(most, 5e-6);
  // The text is that of the sample of the data set: conditions and measured ratios too.
  EXPECT_EQ(run({"classify", path("model"), echo(5, {kFaintNoise})}),
            run({"classify", path("model"), path("data"), "--sample", "5"}));
}

// Cramer and Rao's bound of a tone's frequency (Rife and Boorstyn 1974): the velocity of a point that is `snr` above
// the noise in its cell has the standard error sqrt(6 / snr) / (2 pi) of a cell of lambda/(2 N T_r), here 0.146 m/s.
// Each of both points has half of the power, Hann's taper in range costs 1.76 dB, and 256 pulses of 33 frequencies are
// summed. sigma_v is half of the difference of both velocities; of two independent noises the difference has sqrt(2) of
// that.
TEST_F(EchoOverTime, WithNoiseDiffersByTheBoundOfCramerAndRao) {
  const Words settings{kTwoPoints, "clutter={enabled: false, noise_level: snr, snr_db: -5}", "view.azimuth_deg=0"};
  run(with_settings({"generate", kPoints, "-o", path("noisy")}, settings));
  const double cell_mps = kSpeedOfLight / 16.0875e9 / (2 * 256 * 250e-6);
  const double snr = std::pow(10, -0.5) * 256 * 33 / 2 / std::pow(10, 0.176);
  const double standard_error = std::sqrt(6 / snr) / (2 * kPi) * cell_mps;
  double squares = 0;
  int count = 0;
  for (int sample = 0; sample < 12; ++sample) {
    const std::vector<std::string> of_set = classified({path("noisy"), "--sample", std::to_string(sample)});
    if (of_set[1] != "1") continue;
    const std::vector<std::string> of_echo = classified({echo(sample, settings)});
    const double difference = std::stod(of_echo[9]) - std::stod(of_set[9]);
    EXPECT_NE(difference, 0) << "one realisation of the noise";
    squares += difference * difference;
    ++count;
  }
  ASSERT_EQ(count, 6);
  const double ratio = std::sqrt(squares / count) / standard_error;
  std::printf("sigma_v, root mean square difference over Cramer and Rao's bound, %d echoes: %.2f\n", count, ratio);
  EXPECT_GT(ratio, 0.25);
  EXPECT_LT(ratio, 2.2);
}

TEST_F(EchoOverTime, ThatDoesNotFitIsRefused) {
  const std::string file = echo(0, {kFaintNoise});
  expect_refused({"classify", path("model"), file, "--sample", "0"}, "is the echo of one interval");
  const std::string bytes = read_file(file);
  write_file(path("half.npz"), bytes.substr(0, bytes.size() / 2));
  expect_refused({"classify", path("model"), path("half.npz")}, "half.npz: no .npz archive of NumPy, or truncated");
  const ProgramResult compressed = completed(run_words({kPython, "-c", R"(
import sys, zipfile
with zipfile.ZipFile(sys.argv[1]) as stored, zipfile.ZipFile(sys.argv[2], 'w', zipfile.ZIP_DEFLATED) as archive:
    for name in stored.namelist():
        archive.writestr(name, stored.read(name))
)",
                                                        file, path("compressed.npz")}));
  expect_refused({"classify", path("model"), path("compressed.npz")},
                 "array pulse_time_s: is compressed; numpy.savez writes archives that are not");
  expect_refused({"classify", path("model"), path("none.npz")}, "none.npz: no such file");
  run({"export", path("data"), "-o", path("set.npz")});
  expect_refused({"classify", path("model"), path("set.npz")}, "set.npz: ");
  expect_refused({"classify", path("model"), echo(0, {"features.max_centres=32"})},
                 "echo.npz: features of other settings: features.max_centres: 32 instead of 64");
  expect_refused({"classify", path("model"), echo(0, {"radar.pulses=128"})}, "echo.npz: maps of another grid");
}

// Maps and features made again from stored echoes are those of a data set made anew with the same settings.

// A mesh in waves, so that echoes come from the solver: 24 maps in 3 shards.
constexpr const char* kFloats = R"yaml(seaglint: 1
name: floats
view: {azimuth_deg: [30, 80]}
sea: {significant_wave_height_m: 1, peak_period_s: 8, components: 64}
targets:
  one: {label: 1, mesh: assets/icosahedral_reflector.glb, motion: {model: float}}
  two: {label: 0, mesh: assets/icosahedral_reflector.glb, motion: {model: float}, layout: {area: {count: 2, length_m: 60}}}
clutter: {scr_db: 10}
dataset: {maps_per_case: 6, realisations_per_case: 2, maps_per_interval: 3, maps_per_shard: 8}
)yaml";

class StoredEchoFeatures : public SharedFolder {
 protected:
  static void SetUpTestSuite() {
    write_file(path("floats.yaml"), kFloats);
    make(path("data"), {"--set", "dataset.echoes=true"});
  }
  static std::string place() { return path(testing::UnitTest::GetInstance()->current_test_info()->name()); }
  static void make(const std::string& directory, const Words& more) {
    completed({"generate", path("floats.yaml"), "-o", directory}, more);
  }
  static ProgramResult features(const std::string& directory, const Words& more) {
    return run_program({"features", path("data"), "-o", directory}, more);
  }
  static void expect_equal(const fs::path& a, const fs::path& b) {
    EXPECT_THAT(differences(bytes_of(a), bytes_of(b)), testing::IsEmpty());
  }
};

TEST_F(StoredEchoFeatures, OfTheSameSettingsGiveTheSameBytes) {
  EXPECT_HAS(completed(features(place(), {"--threads", "2"})).out, "24 maps made from stored echoes in ");
  expect_equal(path("data"), place());
}

TEST_F(StoredEchoFeatures, OfOtherSettingsGiveTheBytesOfADataSetMadeAnew) {
  const std::vector<std::string> other{"--set", "clutter.scr_db=25",           "--set", "features.max_centres=20",
                                       "--set", "map.velocity_oversampling=2", "--set", "dataset.echoes=true"};
  completed(features(place(), other));
  make(path("anew"), other);
  expect_equal(path("anew"), place());
}

TEST_F(StoredEchoFeatures, AreMadeWithoutEchoesOfTheirOwnOnRequest) {
  completed(features(place(), {"--set", "dataset.echoes=false"}));
  make(path("without"), {});
  expect_equal(path("without"), place());
  expect_refused({"features", place(), "-o", path("none")}, "has no echoes; make it with dataset.echoes: true");
  EXPECT_FALSE(fs::exists(path("none")));
}

TEST_F(StoredEchoFeatures, RefuseWhatNeedsOtherEchoes) {
  for (const auto& [setting, message] :
       {std::pair{"sea.peak_period_s=9", "only clutter, map, features, learning and report can be set"},
        {"seed=3", "`seed: 42` there, `seed: 3` here"},
        {"dataset.maps_per_case=12", "maps_per_case: 6` there, `  maps_per_case: 12` here"},
        {"map.range_span_m=900", "map.range_span_m: the stored echoes are those of a range "},
        {"map.range_span=900", "map.range_span"}}) {
    const ProgramResult result = features(place(), {"--set", setting});
    EXPECT_EQ(result.code, 2) << setting;
    EXPECT_FALSE(fs::exists(place())) << setting;
    EXPECT_HAS(result.err, message);
  }
}

// Models fitted once more to all maps that are not held out (learning.refit).

class Refit : public testing::Test {
 protected:
  void SetUp() override { completed({"generate", kPoints, "-o", path("data"), "--set", "radar.pulses=64"}); }
  std::string path(const std::string& name) const { return folder_.path() / name; }
  std::string text(const std::string& name) const { return read_file(path(name)); }

  void train(const std::string& model, const Words& options) {
    completed({"train", path("data"), "-o", path(model), "--set", "learning.epochs=2", "--set", "learning.trees=20"},
              options);
  }
  TemporaryFolder folder_;
};

TEST_F(Refit, IsFittedToEveryMapWithTheAccuraciesOfTheSplits) {
  train("split", {});
  train("all", {"--set", "learning.refit=true"});
  const json split = json::parse(text("split/metrics.json")), all = json::parse(text("all/metrics.json"));
  for (const char* group : {"handmade", "cnn", "fused", "extended"}) EXPECT_EQ(all.at(group), split.at(group)) << group;
  const std::string rows = text("all/splits.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 41);
  std::size_t trained = 0;
  for (std::size_t at = 0; (at = rows.find(",train\n", at)) != std::string::npos; ++at) ++trained;
  EXPECT_EQ(trained, 40u);
  for (const char* file : {"network.bin", "handmade.json", "cnn.json", "fused.json", "extended.json"})
    EXPECT_NE(text(std::string("all/") + file), text(std::string("split/") + file)) << file;

  const ProgramResult none = run_program({"evaluate", path("all"), path("data"), "-o", path("evaluated")});
  EXPECT_EQ(none.code, 2) << none.out;
  completed({"evaluate", path("all"), path("data"), "-o", path("evaluated"), "--trained-rows"});
}

TEST_F(Refit, LeavesOutWhatIsHeldOut) {
  train("held", {"--set", "learning.refit=true", "--hold-out", "azimuth_deg=30"});
  std::istringstream rows(text("held/splits.csv"));
  std::size_t held = 0;
  for (std::string line; std::getline(rows, line);) {
    held += line.ends_with(",test") ? 1 : 0;
    EXPECT_FALSE(line.ends_with(",unused")) << line;
  }
  EXPECT_EQ(held, 20u);  // one of two azimuths, in every sea
  train("again", {"--set", "learning.refit=true", "--hold-out", "azimuth_deg=30"});
  EXPECT_EQ(text("again/network.bin"), text("held/network.bin"));
  EXPECT_EQ(text("again/fused.json"), text("held/fused.json"));
}

}  // namespace
}  // namespace seaglint
