// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <span>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/npz.h"
#include "classify/dataset/format/shard.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/scenario.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tools/evaluate/classify.h"
#include "tools/evaluate/evaluate.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/train.h"

namespace seaglint {
namespace {

// Labels that are independent of the maps are recognised as by guessing, also by a model that was trained on them; maps
// with values that are not finite are refused.

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
  EXPECT_HAS(
      refusal_of([&] { evaluation_of(folder.path() / "model", folder.path() / "b", folder.path() / "evaluation"); }),
      "shard_00000.h5: sample 3: nan in the map is no magnitude");
  EXPECT_FALSE(fs::exists(folder.path() / "evaluation"));
}

// Intervals as samples over time: an ideal chirp delayed in time becomes the point that it is the echo of; files that
// contradict their scenario are refused.

constexpr std::size_t kPulses = 64, kSamples = 1914;  // 29 times 66 = 50 MHz / (25 MHz / 33)
constexpr double kSampling = 50e6, kWidth = 36e-6, kBandwidth = 25e6, kPri = 250e-6;

template <class T>
NpzArray array(const char* name, const char* type, const std::vector<std::uint64_t>& shape,
               const std::vector<T>& values) {
  return npz_array(name, type, shape, bytes_of_values(std::span<const T>(values)));
}

// The measured echo of a point.
struct Measured {
  std::vector<std::complex<double>> echo;
  std::vector<double> time_s, pulse_time_s, carrier_hz;
  std::vector<std::int64_t> hop_code;
  std::string scenario =
      "seaglint: 1\nname: measured\nradar: {pulses: 64}\n"
      "targets: {point: {label: 0, points: [{position_m: [0, 0, 0]}]}}\n";
  std::string description;
  std::map<std::string, NpzArray> replaced;  // in place of, or beside, the arrays
  std::vector<std::string> left_out;

  Measured(double range_m, double velocity_mps, double amplitude_m) {
    for (std::size_t k = 0; k < kSamples; ++k)
      time_s.push_back((static_cast<double>(k) - (kSamples - 1) / 2.0) / kSampling);
    for (std::size_t n = 0; n < kPulses; ++n) {
      hop_code.push_back(static_cast<std::int64_t>(n * 5 % 8));
      carrier_hz.push_back(16e9 + 25e6 * static_cast<double>(hop_code.back()));
      pulse_time_s.push_back(kPri * static_cast<double>(n));
      const double delay_s = 2 * (range_m + velocity_mps * pulse_time_s.back()) / kSpeedOfLight;
      for (const double t : time_s) {
        const double u = t - delay_s;
        const bool is_on = std::abs(u) < kWidth / 2;
        echo.push_back(
            is_on ? std::polar(amplitude_m, kPi * kBandwidth / kWidth * u * u - 2 * kPi * carrier_hz.back() * delay_s)
                  : 0);
      }
    }
  }

  void write(const std::filesystem::path& file) const {
    std::map<std::string, NpzArray> arrays{
        {"echo", array("echo", "<c16", {kPulses, kSamples}, echo)},
        {"time_s", array("time_s", "<f8", {time_s.size()}, time_s)},
        {"pulse_time_s", array("pulse_time_s", "<f8", {pulse_time_s.size()}, pulse_time_s)},
        {"carrier_hz", array("carrier_hz", "<f8", {carrier_hz.size()}, carrier_hz)},
        {"hop_code", array("hop_code", "<i8", {hop_code.size()}, hop_code)}};
    for (const auto& [name, other] : replaced) arrays[name] = other;
    for (const std::string& name : left_out) arrays.erase(name);
    std::vector<NpzArray> list;
    for (const auto& [name, one] : arrays) list.push_back(one);
    std::vector<NpzText> texts;
    if (!scenario.empty()) texts.push_back({"scenario.yaml", scenario});
    if (!description.empty()) texts.push_back({"description.json", description});
    write_npz(file, list, texts);
  }
};

class EchoFiles : public testing::Test {
 protected:
  std::string refusal(const std::function<void(Measured&)>& change) {
    Measured measured(20, 1, 2);
    change(measured);
    measured.write(file_);
    std::string text = refusal_of([&] { read_echo_file(file_); });
    EXPECT_TRUE(text.starts_with(file_.string()) && text.find('\n') == std::string::npos) << text;
    return text;
  }
  // With another array under this name.
  template <class T>
  std::string refusal_with(const char* name, const char* type, const std::vector<std::uint64_t>& shape,
                           const std::vector<T>& values) {
    return refusal([&](Measured& echo) { echo.replaced[name] = array(name, type, shape, values); });
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "echo.npz";
};

// Bounds: the ideal chirp has 1.16 % RMS of aliasing in band (radar/echo/README.md).
TEST_F(EchoFiles, OfADelayedChirpHaveItsPoint) {
  Measured(31.5, -1.2, 2).write(file_);
  const EchoFile read = read_echo_file(file_);
  EXPECT_TRUE(read.is_measured);
  EXPECT_TRUE(read.given.empty());
  const GeneratedSample made = sample_of_echo(read.echo, read.train, read.scenario, {}, read.record);
  ASSERT_FALSE(made.centres.empty());
  EXPECT_NEAR(made.centres.front().amplitude_m, 2, 0.03 * 2);
  EXPECT_NEAR(made.centres.front().range_m, 31.5, 0.03 * 0.75);
  EXPECT_NEAR(made.centres.front().velocity_mps, -1.2, 0.03 * read.train.velocity_resolution_mps());
  EXPECT_TRUE(std::isnan(made.stored.record.scr_peak_cell_db));
}

TEST_F(EchoFiles, HaveTheColumnsOfTheirDescription) {
  Measured measured(10, 0, 1);
  measured.description =
      R"({"columns": {"azimuth_deg": 30, "label": 1, "target_name": "ferry", "scr_peak_cell_db": null}})";
  measured.write(file_);
  const EchoFile read = read_echo_file(file_);
  EXPECT_THAT(read.given, testing::ElementsAre("azimuth_deg", "label", "target_name"));
  EXPECT_EQ(read.record.azimuth_deg, 30);
  EXPECT_EQ(read.record.label, 1);
  EXPECT_EQ(read.record.target_name, "ferry");
  const auto with = [&](const std::string& text) { return refusal([&](Measured& echo) { echo.description = text; }); };
  EXPECT_HAS(with(R"({"columns": {"azimut_deg": 30}})"), "did you mean 'azimuth_deg'?");
  EXPECT_HAS(with(R"({"columns": {"label": 0.5}})"), "label: 0.5: of another type");
  EXPECT_HAS(with(R"({"columns": {"layout": 3}})"), "layout: 3: of another type");
  EXPECT_HAS(with(R"({"columns": {"depth_m": 1e400}})"), "description.json: ");
  EXPECT_HAS(with("{\"columns\": "), "no valid JSON");
  EXPECT_HAS(with("{}" + std::string(4 << 20, ' ')), "no archive with a description.json inside");
  EXPECT_HAS(with(std::string(100, '[') + std::string(100, ']')), "nested more than 64 levels");
}

TEST_F(EchoFiles, ThatLackSomethingAreRefused) {
  for (const char* name : {"time_s", "pulse_time_s", "carrier_hz", "hop_code"})
    EXPECT_HAS(refusal([&](Measured& echo) { echo.left_out = {name}; }), std::string("array ") + name + ": is missing");
  EXPECT_HAS(refusal([](Measured& echo) { echo.left_out = {"echo"}; }), "no array target");
  EXPECT_HAS(refusal([](Measured& echo) { echo.scenario.clear(); }), "no scenario.yaml inside");
  EXPECT_HAS(refusal([](Measured& echo) { echo.scenario += "radr: {}\n"; }), "scenario.yaml:5:1: radr");
  const std::vector<std::complex<double>> values = Measured(20, 1, 2).echo;
  EXPECT_HAS(refusal_with("target", "<c16", {kPulses, kSamples}, values), "array echo beside target");
  EXPECT_HAS(refusal([&](Measured& echo) {
               echo.left_out = {"echo"};
               echo.replaced["target"] = array("target", "<c16", {kPulses, kSamples}, values);
             }),
             "array frequency_hz: is missing");
}

TEST_F(EchoFiles, OfAnotherTypeOrShapeAreRefused) {
  constexpr std::size_t kCount = kPulses * kSamples;
  EXPECT_HAS(refusal_with("echo", "<f8", {kPulses, 2 * kSamples}, std::vector<double>(2 * kCount)),
             "array echo: shape (64, 3828), must be (64, 1914)");
  EXPECT_HAS(refusal_with("echo", "<f8", {kPulses, kSamples}, std::vector<double>(kCount)),
             "array echo: type <f8: must be <c8 or <c16");
  EXPECT_HAS(refusal_with("echo", "<c16", {kSamples, kPulses}, std::vector<std::complex<double>>(kCount, 1)),
             "array echo: shape (1914, 64)");
  EXPECT_HAS(refusal_with("carrier_hz", "|S8", {kPulses}, std::vector<double>(kPulses)), "array carrier_hz: type |S8");
  EXPECT_HAS(refusal([](Measured& echo) { echo.pulse_time_s.pop_back(); }),
             "array pulse_time_s: 63 pulses, by radar.pulses 64");
  EXPECT_HAS(refusal([](Measured& echo) { echo.pulse_time_s.clear(); }), "0 pulses");
  EXPECT_HAS(refusal([](Measured& echo) { echo.hop_code.pop_back(); }), "array hop_code: shape (63,)");
}

TEST_F(EchoFiles, ThatContradictTheirScenarioAreRefused) {
  EXPECT_HAS(refusal([](Measured& echo) { echo.carrier_hz[5] += 1e6; }),
             "array carrier_hz: [5] is 16026000000, by hop_code, radar.carrier_ghz and radar.hop_step_mhz "
             "16025000000");
  EXPECT_HAS(refusal([](Measured& echo) { echo.hop_code[9] = 8; }), "array hop_code: [9] is 8, must be 0 to 7");
  EXPECT_HAS(refusal([](Measured& echo) { echo.hop_code[9] = -1; }), "array hop_code: [9] is -1");
  EXPECT_HAS(refusal([](Measured& echo) { echo.pulse_time_s[3] += 1e-6; }), "array pulse_time_s: [3]");
  EXPECT_HAS(refusal([](Measured& echo) { echo.time_s[0] -= 1e-8; }), "array time_s: [0]");
  EXPECT_HAS(refusal([](Measured& echo) { echo.time_s.resize(1850); }),
             "1850 samples of each pulse, must be an odd multiple of 66, as 1914 are");
  EXPECT_HAS(refusal([](Measured& echo) { echo.time_s.resize(66); }), "shorter than radar.pulse_width_us");
  EXPECT_HAS(refusal([](Measured& echo) { echo.time_s.clear(); }), "shorter than radar.pulse_width_us");
  for (const auto& [first, second, step] :
       {std::tuple{0.0, -1e6, "-1e+06"}, {-5e5, 5e5, "1e+06"}, {0.0, 1e-30, "1e-30"}})
    EXPECT_HAS(refusal_with("frequency_hz", "<f8", {2}, std::vector{first, second}),
               std::string("2 frequencies in steps of ") + step + " Hz");
}

TEST_F(EchoFiles, WithValuesThatAreNoEchoAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_HAS(refusal([&](Measured& echo) {
               echo.echo[2 * kSamples + 7] = {0, kNan};
             }),
             "array echo: [2][7] is not finite");
  EXPECT_HAS(refusal([&](Measured& echo) { echo.carrier_hz[1] = kNan; }), "array carrier_hz: [1] is nan");
  EXPECT_HAS(refusal([&](Measured& echo) { echo.pulse_time_s[1] = kNan; }), "[1] is nan");
  EXPECT_HAS(refusal([&](Measured& echo) { echo.time_s[1] = kNan; }), "array time_s: [1] is nan");
  EXPECT_HAS(refusal([](Measured& echo) { echo.echo.assign(kPulses * kSamples, 0); }),
             "samples without a power: 0 m^2");
  EXPECT_HAS(refusal([](Measured& echo) { echo.echo.assign(kPulses * kSamples, 1e200); }),
             "samples without a power: inf m^2");
}

}  // namespace
}  // namespace seaglint
