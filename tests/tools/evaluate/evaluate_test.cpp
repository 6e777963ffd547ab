// SPDX-License-Identifier: BSD-3-Clause
// Labels that are independent of the maps are recognised as by guessing, also by a model that was trained on them; maps
// with values that are not finite are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/shard.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/scenario.h"
#include "tests/temporary_folder.h"
#include "tools/evaluate/evaluate.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/train.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

// Maps of ideal points, 8 in each sea.
void generate(const fs::path& data, const std::string& seed, int seas) {
  const Scenario scenario = read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/points.yaml",
                                          {{"seed", seed},
                                           {"dataset.maps_per_case", std::to_string(2 * seas)},
                                           {"dataset.realisations_per_case", std::to_string(seas)},
                                           {"radar.pulses", "32"}});
  generate_dataset(Pipeline(scenario), data, {1, 1, false, 1});
}

// Changes all samples, shard by shard.
void change_samples(const fs::path& data, const std::function<void(Sample&)>& change) {
  Manifest manifest = read_manifest(data / kManifestFile);
  const Scenario scenario = read_scenario(data / kScenarioFile);
  for (ManifestShard& entry : manifest.shards) {
    Shard shard = read_shard(data / entry.file);
    for (Sample& sample : shard.samples) change(sample);
    entry.sha256 = write_shard(data / entry.file, shard, scenario.features.max_centres);
  }
  write_file(data / kManifestFile, to_json(manifest));
}

// Deals the labels out again, in a random order over all maps.
void permute_labels(const fs::path& data, std::uint64_t seed) {
  std::vector<std::int64_t> labels;
  for (const ManifestShard& entry : read_manifest(data / kManifestFile).shards)
    for (const Sample& sample : read_shard(data / entry.file).samples) labels.push_back(sample.record.label);
  Random random({seed, Stream::kSplit, 0});
  for (std::size_t i = labels.size(); i > 1; --i)
    std::swap(labels[i - 1], labels[random.below(static_cast<std::uint32_t>(i))]);
  change_samples(data, [&](Sample& sample) {
    sample.record.label = labels.back();
    labels.pop_back();
  });
}

nlohmann::json evaluation_of(const fs::path& model, const fs::path& data, const fs::path& output) {
  EvaluateRequest request;
  request.model = model;
  request.data_sets = {data};
  request.output = output;
  evaluate_model(request);
  return nlohmann::json::parse(read_file(output / kEvaluationFile));
}

// Labels that are independent of the maps: decisions are right as by tossing a coin, four standard deviations of the
// binomial distribution; the area under the ROC has the standard deviation sqrt((n0 + n1 + 1) / (12 n0 n1)) (Mann and
// Whitney 1947).
void expect_chance(const nlohmann::json& evaluation) {
  for (const char* model : {"handmade", "cnn", "fused", "extended"}) {
    const nlohmann::json &scores = evaluation.at(model), &confusion = scores.at("confusion");
    const auto count = [&](const char* entry) { return confusion.at(entry).get<double>(); };
    const double n0 = count("array_as_array") + count("array_as_ship"),
                 n1 = count("ship_as_array") + count("ship_as_ship");
    ASSERT_GT(std::min(n0, n1), 10);
    EXPECT_NEAR(scores.at("accuracy").get<double>(), 0.5, 4 * 0.5 / std::sqrt(n0 + n1)) << model;
    EXPECT_NEAR(scores.at("auc").get<double>(), 0.5, 4 * std::sqrt((n0 + n1 + 1) / (12 * n0 * n1))) << model;
  }
}

TEST(PermutedLabels, AreRecognisedAsByGuessing) {
  const TemporaryFolder folder;
  generate(folder.path() / "a", "42", 24);
  generate(folder.path() / "b", "7", 24);
  const std::vector<Override> short_training{{"learning.epochs", "2"}, {"learning.trees", "20"}};
  train_model({{folder.path() / "a"}, folder.path() / "model", short_training});
  // The same model recognises the true labels of 192 maps, beyond four standard deviations of guessing.
  const nlohmann::json truth = evaluation_of(folder.path() / "model", folder.path() / "b", folder.path() / "true");
  EXPECT_GT(truth.at("handmade").at("accuracy").get<double>(), 0.5 + 4 * 0.5 / std::sqrt(192.0));

  fs::copy(folder.path() / "b", folder.path() / "permuted_b");
  permute_labels(folder.path() / "permuted_b", 1);
  expect_chance(evaluation_of(folder.path() / "model", folder.path() / "permuted_b", folder.path() / "data"));

  permute_labels(folder.path() / "a", 2);
  train_model({{folder.path() / "a"}, folder.path() / "permuted_model", short_training});
  expect_chance(evaluation_of(folder.path() / "permuted_model", folder.path() / "a", folder.path() / "held_out"));
}

TEST(Evaluation, OfAMapThatIsNotFiniteNamesTheSample) {
  const TemporaryFolder folder;
  generate(folder.path() / "a", "42", 4);
  generate(folder.path() / "b", "7", 4);
  train_model({{folder.path() / "a"}, folder.path() / "model", {{"learning.epochs", "1"}, {"learning.trees", "3"}}});
  change_samples(folder.path() / "b", [](Sample& sample) {
    if (sample.record.sample == 3) sample.magnitude[5] = std::nanf("");
  });
  try {
    evaluation_of(folder.path() / "model", folder.path() / "b", folder.path() / "evaluation");
    FAIL() << "evaluated";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("shard_00000.h5: sample 3: nan in the map is no magnitude"));
  }
  EXPECT_FALSE(fs::exists(folder.path() / "evaluation"));
}

}  // namespace
}  // namespace seaglint
