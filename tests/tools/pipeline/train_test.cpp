// SPDX-License-Identifier: BSD-3-Clause
// A model directory is that of one complete training, even when another one is interrupted.
#include "tools/pipeline/train.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/model/learning_table.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tools/pipeline/generate.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class Training : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    temporary_ = std::make_unique<TemporaryFolder>();
    folder_ = temporary_->path();
    const Scenario scenario = read_scenario(
        SEAGLINT_SOURCE_DIR "/scenarios/points.yaml",
        {{"dataset.maps_per_case", "24"}, {"dataset.realisations_per_case", "4"}, {"radar.pulses", "64"}});
    generate_dataset(Pipeline(scenario), folder_ / "data", {1, 1, false, 1});
    train({});
  }
  static void TearDownTestSuite() { temporary_.reset(); }

  static void train(std::vector<Override> overrides, const StopFlag* stop = nullptr) {
    overrides.push_back({"learning.epochs", "1"});
    train_model({.data_sets = {folder_ / "data"},
                 .model_directory = folder_ / "model",
                 .overrides = overrides,
                 .threads = 1,
                 .stop = stop});
  }

  static std::map<std::string, std::string> files() {
    std::map<std::string, std::string> bytes;
    for (const auto& entry : fs::directory_iterator(folder_ / "model"))
      if (entry.is_regular_file()) bytes[entry.path().filename()] = read_file(entry.path());
    return bytes;
  }

  static inline std::unique_ptr<TemporaryFolder> temporary_;
  static inline fs::path folder_;
};

TEST_F(Training, LearnsNothingFromAMapThatIsNotFinite) {
  const auto with_sample_3 = [](const std::function<void(Sample&)>& change) {
    const fs::path data = folder_ / "changed", file = data / shard_name(0);
    fs::remove_all(data);
    fs::copy(folder_ / "data", data);
    Shard shard = read_shard(file);
    change(shard.samples[3]);
    Manifest manifest = read_manifest(data / kManifestFile);
    manifest.shards[0].sha256 = write_shard(file, shard, read_scenario(data / kScenarioFile).features.max_centres);
    write_file(data / kManifestFile, to_json(manifest));
    const std::string message = refusal_of([&] {
      train_model({{data}, folder_ / "no_model", {{"learning.epochs", "1"}}});
    });
    EXPECT_FALSE(fs::exists(folder_ / "no_model"));
    return message;
  };
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto nan = [](Sample& sample) { std::fill(sample.magnitude.begin(), sample.magnitude.end(), std::nanf("")); };
  EXPECT_HAS(with_sample_3(nan), "shard_00000.h5: sample 3: nan in the map is no magnitude");
  EXPECT_HAS(with_sample_3([](Sample& sample) { sample.magnitude[5] = kInfinity; }),
             "sample 3: inf in the map is no magnitude");
  EXPECT_HAS(with_sample_3([](Sample& sample) { sample.magnitude[5] = 3e38F; }), "sample 3: peak_m");
}

TEST_F(Training, ThatIsStoppedEndsSoonAndKeepsTheEarlierModel) {
  const auto before = files();
  ASSERT_TRUE(before.contains(kMetricsFile));
  StopFlag stop = false;
  std::chrono::steady_clock::time_point stopped;
  {
    std::jthread user([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      stopped = std::chrono::steady_clock::now();
      stop = true;
    });
    EXPECT_THROW(train({{"learning.trees", "100000"}}, &stop), Interrupted);
  }
  // One tree of these rows takes far below a millisecond, the three forests of the first job some seconds.
  EXPECT_LT(std::chrono::steady_clock::now() - stopped, std::chrono::seconds(2));
  EXPECT_EQ(files(), before);
}

TEST_F(Training, RecordsItsSettings) {
  const std::vector<Override> overrides{{"learning.epochs", "1"},
                                        {"learning.fusion", "in_sample"},
                                        {"learning.map_floor_db", "-50"},
                                        {"learning.learning_rate", "0.002"},
                                        {"learning.split.hold_out", "{azimuth_deg: 80}"},
                                        {"dataset.split", "5:3"}};
  train_model({{folder_ / "data"}, folder_ / "other", overrides});
  const nlohmann::json metrics = nlohmann::json::parse(read_file(folder_ / "other" / kMetricsFile));
  EXPECT_EQ(metrics.at("dataset").at("split"), "5:3");
  const nlohmann::json& learning = metrics.at("learning");
  EXPECT_EQ(learning.at("fusion"), "in_sample");
  EXPECT_EQ(learning.at("map_floor_db"), -50);
  EXPECT_EQ(learning.at("learning_rate"), 0.002);
  EXPECT_EQ(learning.at("split.by"), "sea");

  // The recorded settings are sufficient to set every key again.
  std::vector<Override> again{{"dataset.split", metrics.at("dataset").at("split")}};
  for (const auto& [key, value] : learning.items())
    again.push_back({"learning." + key, value.is_string() ? value.get<std::string>() : value.dump()});
  EXPECT_EQ(effective_yaml(read_scenario(folder_ / "data" / "scenario.yaml", again)),
            effective_yaml(read_scenario(folder_ / "data" / "scenario.yaml", overrides)));
}

// The division of the scenario, and options in its place.
TEST_F(Training, DividesAsItsScenarioStatesUnlessOptionsReplaceIt) {
  const auto split = [](const std::vector<Override>& of_scenario, const DivisionOptions& options) {
    std::vector<Override> overrides{{"learning.epochs", "1"}, {"learning.trees", "3"}};
    overrides.insert(overrides.end(), of_scenario.begin(), of_scenario.end());
    const fs::path model = folder_ / "divided";
    const TrainedModel trained = train_model({{folder_ / "data"}, model, overrides, options});
    return trained.study.division + "\n" + read_file(model / kSplitsFile);
  };
  const std::vector<Override> of_scenario{{"learning.split.by", "interval"},
                                          {"learning.split.hold_out", "{azimuth_deg: 80}"}};
  const std::string stated = split(of_scenario, {});
  EXPECT_EQ(stated.substr(0, stated.find('\n')), "tested on azimuth_deg=80 only; split by interval");
  EXPECT_EQ(stated, split({}, {"interval", {{"azimuth_deg", {"80"}}}}));
  EXPECT_EQ(split(of_scenario, {"sea", {{"azimuth_deg", {"30"}}}}), split({}, {"sea", {{"azimuth_deg", {"30"}}}}));
  EXPECT_EQ(split({{"learning.split.by", "interval"}}, {"sea", {}}), split({}, {}));

  // A run, which has read its scenario, divides likewise.
  std::vector<Override> short_training{{"learning.epochs", "1"}, {"learning.trees", "3"}};
  short_training.insert(short_training.end(), of_scenario.begin(), of_scenario.end());
  const Scenario scenario = read_scenario(folder_ / "data" / kScenarioFile, short_training);
  const TrainedModel run =
      train_model({.data_sets = {folder_ / "data"}, .model_directory = folder_ / "divided", .scenario = &scenario});
  EXPECT_EQ(run.study.division + "\n" + read_file(folder_ / "divided" / kSplitsFile), stated);
}

TEST_F(Training, DependsNeitherOnItsThreadsNorOnThoseOfANetwork) {
  const std::vector<Override> one{{"learning.epochs", "2"}},
      several{{"learning.epochs", "2"}, {"learning.threads", "3"}};
  train_model({.data_sets = {folder_ / "data"}, .model_directory = folder_ / "one", .overrides = one, .threads = 1});
  train_model(
      {.data_sets = {folder_ / "data"}, .model_directory = folder_ / "several", .overrides = several, .threads = 2});
  for (const std::string& name : model_files())
    EXPECT_EQ(read_file(folder_ / "several" / name), read_file(folder_ / "one" / name)) << name;
  EXPECT_EQ(read_file(folder_ / "several" / kEmbeddingsFile), read_file(folder_ / "one" / kEmbeddingsFile));
  const auto metrics = [](const char* model) {
    nlohmann::json json = nlohmann::json::parse(read_file(folder_ / model / kMetricsFile));
    EXPECT_EQ(json.at("learning").erase("threads"), 1u);
    return json;
  };
  EXPECT_EQ(metrics("several"), metrics("one"));
}

TEST_F(Training, WithoutItsLastFileHasNoMetrics) {
  train({});
  fs::remove(folder_ / "model" / kEmbeddingsFile);
  fs::create_directory(folder_ / "model" / kEmbeddingsFile);
  EXPECT_THROW(train({{"learning.trees", "3"}}), WorkError);
  EXPECT_FALSE(fs::exists(folder_ / "model" / kMetricsFile));

  fs::remove(folder_ / "model" / kEmbeddingsFile);
  train({});
  EXPECT_TRUE(fs::exists(folder_ / "model" / kMetricsFile));
}

// Clutter 20 dB below the target in every map and noise 30 dB below the clutter: 1/R = 10^-2 + 10^-5, 19.9957 dB. Noise
// is measured: 64 pulses of its power scatter by less than a tenth, which is 4e-4 dB here.
TEST_F(Training, ProbesTheRatioOfTargetToClutterAndNoise) {
  const LearningTable table = load_learning_table(DatasetReader(folder_ / "data"));
  const auto probe = std::find_if(table.probes.begin(), table.probes.end(),
                                  [](const Probe& p) { return p.name == "signal to clutter and noise"; });
  ASSERT_NE(probe, table.probes.end());
  EXPECT_STREQ(name(probe->kind), "ratio");
  ASSERT_EQ(probe->features.values.size(), table.rows());
  for (const float ratio_db : probe->features.values) EXPECT_NEAR(ratio_db, 19.9957, 5e-4);
}

}  // namespace
}  // namespace seaglint
