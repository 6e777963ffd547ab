// SPDX-License-Identifier: BSD-3-Clause
// Several looks of a sample: each is the interval at its time, and the data set has them all.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "classify/dataset/directory/audit.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/export.h"
#include "classify/dataset/format/shard.h"
#include "classify/features/rigidity.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/file.h"
#include "tests/map_levels.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// A small ship in waves beside three points, with clutter; looks: lines of the section.
std::string text_of(const std::string& looks,
                    const std::string& dataset = "maps_per_case: 2, realisations_per_case: 2") {
  return "seaglint: 1\nradar: {pulses: 32}\nview: {azimuth_deg: 40, elevation_deg: 2}\n"
         "sea: {significant_wave_height_m: 1, peak_period_s: 6, components: 64}\n"
         "targets:\n"
         "  ship: {label: 1, ship: {kind: inflatable_boat, detail: hull}, motion: {model: ship, translations: true}}\n"
         "  points: {label: 0, points: [{position_m: [30, 0, 0], amplitude_m: 2, velocity_mps: [1.5, 0, 0]}]}\n"
         "clutter: {scr_db: 20}\n" +
         (looks.empty() ? "" : "looks: {" + looks + "}\n") + "dataset: {" + dataset + "}\n";
}

Pipeline pipeline_of(const std::string& looks,
                     const std::string& dataset = "maps_per_case: 2, realisations_per_case: 2") {
  return Pipeline(parse_scenario(text_of(looks, dataset), "looks.yaml"));
}

std::size_t sample_of(const Pipeline& pipeline, int target) { return pipeline.plan().sample({.target = target}); }

// The response at a time does not depend on how the time is written in the scenario.
TEST(Looks, AreTheIntervalsAtTheirTimes) {
  const Pipeline looks = pipeline_of("count: 3, spacing_s: 0.5"),
                 intervals = pipeline_of("", "maps_per_case: 6, realisations_per_case: 2, interval_spacing_s: 0.5");
  for (int look = 0; look < 3; ++look) {
    const SampleAddress at{.target = 0, .look = look}, interval{.interval = look, .target = 0};
    const PulseTrain train = looks.pulse_train({sample_of(looks, 0), look});
    EXPECT_EQ(looks.plan().start_s(at), 0.5 * look);
    EXPECT_EQ(looks.response(at, train).response.values, intervals.response(interval, train).response.values) << look;
  }
}

// With the clutter at the level of its ratio to the mean over the looks.
TEST(Looks, HaveTheFirstOneOfASampleWithOneLookAndOneLevelOfClutter) {
  const Pipeline many = pipeline_of("count: 4, spacing_s: 0.7"), one = pipeline_of("");
  const std::size_t sample = sample_of(many, 0);
  const std::vector<GeneratedSample> looks = many.generate_looks(sample);
  const GeneratedSample alone = one.generate_sample(sample);
  EXPECT_EQ(looks[0].train.code, alone.train.code);
  EXPECT_EQ(looks[0].stored.record.radar_key, alone.stored.record.radar_key);
  double sum_m2 = 0;
  std::vector<double> target_m2;
  for (const GeneratedSample& look : looks) {
    EXPECT_NEAR(look.received.clutter_power_m2, looks[0].received.clutter_power_m2,
                0.01 * looks[0].received.clutter_power_m2);  // the ratio is exact for the echo with its chirp spectrum
    target_m2.push_back(look.received.clutter_power_m2 * std::pow(10, 0.1 * look.stored.record.scr_per_pulse_db));
    sum_m2 += target_m2.back();
  }
  EXPECT_NEAR(10 * std::log10(sum_m2 / 4 / looks[0].received.clutter_power_m2), 20, 0.05);
  EXPECT_GT(*std::ranges::max_element(target_m2), 1.05 * *std::ranges::min_element(target_m2));
  EXPECT_NE(looks[0].train.code, looks[1].train.code);
  EXPECT_NE(looks[0].stored.record.roll_deg, looks[1].stored.record.roll_deg);
}

TEST(Looks, OfAPointFollowItsVelocity) {
  const Pipeline pipeline = pipeline_of("count: 3, spacing_s: 2");
  const std::vector<GeneratedSample> looks = pipeline.generate_looks(sample_of(pipeline, 1));
  const double towards_mps = 1.5 * std::cos(radians(40)) * std::cos(radians(2));
  for (std::size_t i = 0; i < looks.size(); ++i) {
    // Within a quarter of a cell of 0.75 m, and half a cell of 1.17 m/s.
    const Peak peak = peak_of(looks[i].received.map);
    EXPECT_NEAR(peak.range_m,
                -30 * std::cos(radians(40)) * std::cos(radians(2)) - 2.0 * static_cast<double>(i) * towards_mps, 0.4);
    EXPECT_NEAR(peak.velocity_mps, -towards_mps, 0.6);
  }
}

// Eight points that move as one, in clutter 3 dB above them in a pulse: every one is a track, and their ranges and
// velocities are those of a rigid body within their standard errors.
TEST(Looks, OfPointsThatMoveAsOneAreTracksOfARigidBody) {
  std::string points;
  for (int i = 0; i < 8; ++i)
    points += fmt::format("{}{{position_m: [{}, 0, 0], amplitude_m: {}, velocity_mps: [0.3, 0, 0]}}",
                          i == 0 ? "" : ", ", 11 * i - 40, 1 + 0.1 * i);
  double value = 0, degrees = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    const Pipeline pipeline(parse_scenario(
        fmt::format("seaglint: 1\nseed: {}\nview: {{azimuth_deg: 0, elevation_deg: 0}}\ntargets: {{body: {{label: 1, "
                    "points: [{}]}}}}\nclutter: {{scr_db: -3, doppler_spread_mps: 2}}\nlooks: {{count: 8, spacing_s: "
                    "0.5}}\ndataset: "
                    "{{maps_per_case: 1, realisations_per_case: 1}}\n",
                    seed, points),
        "body.yaml"));
    const TrackSet tracks = tracks_of(pipeline.generate_looks(0));
    EXPECT_EQ(tracks.tracks.size(), 8u);
    const ChiSquare common = rank_test(tracks, 0);
    value += common.value, degrees += common.degrees;
    EXPECT_GT(fit_rigid_body(tracks).test.p_value(), 1e-3) << seed;
  }
  fmt::print("chi-square over degrees of freedom {:.3f}\n", value / degrees);
  // 224 degrees of freedom: 0.28 is three standard deviations. The error of CLEAN's fit is the largest one: -0.2.
  EXPECT_GT(value / degrees, 1 - 0.28 - 0.2);
  EXPECT_LT(value / degrees, 1 + 0.28);
}

TEST(Looks, AreStoredTheSameForAnyThreadsAndParts) {
  const TemporaryFolder folder;
  const Pipeline pipeline = pipeline_of("count: 3, spacing_s: 0.5",
                                        "maps_per_case: 4, realisations_per_case: 2, maps_per_shard: 3, complex_maps: "
                                        "true, echoes: true, interval_spacing_s: 2");
  generate_dataset(pipeline, folder.path() / "whole", {1, 1, false, 2});
  for (const int part : {2, 1}) generate_dataset(pipeline, folder.path() / "parts", {part, 2, true, 1});
  const DatasetReader whole(folder.path() / "whole"), parts(folder.path() / "parts");
  ASSERT_EQ(whole.shards(), 3u);
  for (std::size_t i = 0; i < whole.shards(); ++i)
    EXPECT_EQ(whole.manifest().shards[i].sha256, parts.manifest().shards[i].sha256);
  EXPECT_EQ(whole.manifest().looks, 3u);
  EXPECT_THAT(audit(folder.path() / "whole").faults, IsEmpty());
  // What is read is what was made.
  const StoredSample stored = stored_sample(whole, 1);
  ASSERT_EQ(look_count(stored.sample), 3u);
  EXPECT_THAT(differences(stored.sample, pipeline.generate_sample(1).stored, 0), IsEmpty());
  // The stored echoes are those of their looks.
  const StoredEchoes echoes(whole);
  const PulseTrain train = pipeline.pulse_train({1, 2});
  EXPECT_EQ(echoes.response({1, 2}, train).response.values,
            pipeline.response(pipeline.address({1, 2}), train).response.values);
  // One file over all shards has the looks too.
  merge_dataset(folder.path() / "whole", folder.path() / "whole" / kMergedFile, "0");
  EXPECT_THAT(audit(folder.path() / "whole").faults, IsEmpty());
  export_shards(whole, 0, 3, folder.path() / "all.npz");
  EXPECT_EQ(read_npz_array(folder.path() / "all.npz", "maps").shape_text(), "(8, 3, 8, 256)");
  const std::vector<double> start_s = read_npz_array(folder.path() / "all.npz", "looks/start_s").numbers();
  EXPECT_EQ(start_s[2] - start_s[0], 1);
}

TEST(Looks, ThatContradictTheScenarioAreFaultsOfTheirLook) {
  const TemporaryFolder folder;
  const std::filesystem::path data = folder.path() / "data";
  const Pipeline pipeline = pipeline_of("count: 2, spacing_s: 0.5");
  generate_dataset(pipeline, data, {1, 1, false, 1});
  Shard shard = read_shard(data / shard_name(0));
  shard.samples[1].further_looks[0].record.start_s = 0.25;
  shard.samples[2].further_looks[0].magnitude[7] += 1;
  const int centres = pipeline.scenario().features.max_centres;
  const std::string checksum = write_shard(data / shard_name(0), shard, centres);
  std::string manifest = read_file(data / kManifestFile);
  const std::string before = DatasetReader(data).manifest().shards[0].sha256;
  manifest.replace(manifest.find(before), before.size(), checksum);
  write_file(data / kManifestFile, manifest);
  EXPECT_THAT(audit(data).faults, testing::ElementsAre(HasSubstr("sample 1, look 1: start_s 0.25, by the scenario 0.5"),
                                                       HasSubstr("sample 2, look 1: energy_m2")));
}

TEST(Looks, AtDrawnSpacingsStartWhereTheyAreDrawn) {
  const Pipeline pipeline = pipeline_of("count: 2, spacing_s: 'uniform(0.2 0.9)'");
  for (std::size_t sample = 0; sample < pipeline.plan().size(); ++sample) {
    const double spacing_s = pipeline.scenario_of(pipeline.address(sample)).looks.spacing_s;
    EXPECT_GE(spacing_s, 0.2);
    EXPECT_EQ(pipeline.plan().start_s(pipeline.address({sample, 1})), spacing_s);
  }
}

TEST(Looks, ThatOverlapOrExceedTheTimeOfTheirIntervalAreRefused) {
  const auto refused = [](const std::string& looks, const std::string& dataset = "maps_per_case: 1") {
    return refusal_of([&] { parse_scenario(text_of(looks, dataset + ", realisations_per_case: 1"), "looks.yaml"); });
  };
  EXPECT_THAT(refused("count: 2, spacing_s: 0.007"),
              HasSubstr("looks.spacing_s: value '0.007': must be at least 0.008"));
  EXPECT_THAT(refused("count: 30, spacing_s: 0.5", "maps_per_case: 2"),
              HasSubstr("dataset.interval_spacing_s: must be at least 14.508, the time of all looks of a sample"));
  EXPECT_THAT(refused("count: 'integers(2 4)'"), HasSubstr("must be one value for all maps"));
  EXPECT_THAT(refused("count: 0"), HasSubstr("must be a whole number within 1 and 1000"));
}

}  // namespace
}  // namespace seaglint
