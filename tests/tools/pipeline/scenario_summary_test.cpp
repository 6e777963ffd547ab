// SPDX-License-Identifier: BSD-3-Clause
// What `check` says of a scenario: how much of it there is, what moves and what does not.
#include "tools/pipeline/scenario_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"
#include "tools/pipeline/generate.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

double bytes_of(const std::filesystem::path& directory) {
  double bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  }
  return bytes;
}

TEST(WorkEstimate, HasTheSizeOfTheDataSetWithinAFactorOfTwo) {
  const std::vector<std::vector<Override>> cases{
      {},
      {{"dataset.echoes", "true"}},
      {{"dataset.complex_maps", "true"}, {"dataset.maps_per_shard", "3"}},
      {{"radar.pulses", "16"}, {"map.range_span_m", "20"}, {"features.max_centres", "3"}},
      {{"sea.peak_period_s", "uniform(7, 9)"}, {"radar.hop_code", "choice(random, stepped)"}}};
  for (const std::vector<Override>& overrides : cases) {
    const TemporaryFolder folder;
    const Pipeline pipeline(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/points.yaml", overrides));
    generate_dataset(pipeline, folder.path() / "data", {1, 1, false, 1});
    const double bytes = bytes_of(folder.path() / "data"), estimate = stored_bytes(pipeline);
    EXPECT_LT(estimate, 2 * bytes) << overrides.size();
    EXPECT_GT(estimate, bytes / 2) << overrides.size();
  }
}

TEST(WorkEstimate, OfMoreMapsIsInProportion) {
  const auto estimate = [](const char* maps) {
    return estimate_work(
        Pipeline(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/points.yaml",
                               {{"dataset.maps_per_case", maps}, {"dataset.realisations_per_case", "5"}})));
  };
  const WorkEstimate few = estimate("10"), many = estimate("1000");
  EXPECT_GT(few.processor_s, 0);
  EXPECT_GT(many.processor_s, 10 * few.processor_s);  // 100 times the maps of as many seas
  EXPECT_FALSE(many.is_bound);
}

TEST(WorkEstimate, IsABoundWhereOneMapTakesLongerThanTheLimit) {
  const Pipeline pipeline(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/points.yaml"));
  const WorkEstimate work = estimate_work(pipeline, {.processor_s = 0});
  EXPECT_TRUE(work.is_bound);
  EXPECT_GT(work.processor_s, 0);
  EXPECT_GT(work.bytes, 0);
}

// A plate across the line of sight returns no cross polarisation.
TEST(WorkEstimate, HasTheReasonWhereNoMapCanBeMade) {
  const TemporaryFolder folder;
  write_file(folder.path() / "plate.obj", "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  write_file(folder.path() / "plate.yaml",
             "seaglint: 1\nradar: {polarisation: hv}\nview: {azimuth_deg: 0, elevation_deg: 0}\ntargets:\n  plate: "
             "{label: 1, mesh: plate.obj, solver: {edges: false}}\n");
  const WorkEstimate work = estimate_work(Pipeline(read_scenario(folder.path() / "plate.yaml")));
  EXPECT_THAT(work.failure, HasSubstr("plate.yaml:5:10: targets.plate: sample "));
  EXPECT_THAT(work.failure, HasSubstr("has no power"));
}

TEST(ScenarioSummary, CountsSeasAndMapsAndListsWhatVariesAndMoves) {
  const Pipeline pipeline(parse_scenario(R"(
seaglint: 1
radar: {pulses: 32}
view: {azimuth_deg: 0:350:10, elevation_deg: uniform(1 5)}
sea: {significant_wave_height_m: [0.1, 3], peak_period_s: loguniform(7 9), components: 64}
targets:
  still: {label: 0, mesh: assets/icosahedral_reflector.glb}
  pair: {label: 1, points: [{position_m: [9, 0, 0]}, {position_m: [-9, 0, 0]}]}
dataset: {maps_per_case: 24, realisations_per_case: 4, maps_per_interval: 2, interval_spacing_s: 5}
)",
                                         "summary.yaml"));
  const std::string text = scenario_summary(pipeline, {7200, false, 3.2e6, {}}, 4);
  EXPECT_EQ(
      text,
      "seas                8: 4 realisations of each sea state, 3 intervals of each 5 s apart and view, 2 maps of "
      "each interval\n"
      "swept               view.azimuth_deg 0 to 350 in 36 values\n"
      "                    sea.significant_wave_height_m 0.1, 3\n"
      "drawn               sea.peak_period_s loguniform(7, 9), once per sea\n"
      "                    view.elevation_deg uniform(1, 5), once per observation\n"
      "moves               still: does not move: targets.still.motion.model is fixed\n"
      "                    pair: 2 points with velocities of their own in any sea\n"
      "work                about 2 h of processor, 30 min on 4 threads, 3.2 MB of maps\n");
}

}  // namespace
}  // namespace seaglint
