// SPDX-License-Identifier: BSD-3-Clause
// Samples, maps and targets that a report's page draws by scripts.
#include "tools/report/explorer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "sim/scenario/fields.h"
#include "tools/page/html.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<double> cells(std::size_t count, double first, double step) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(first + step * static_cast<double>(i));
  return values;
}

TEST(Explorer, ReducedAxesCoverTheSameInterval) {
  const ReducedAxis axis = reduced_axis(cells(256, -96, 0.75), 128);
  EXPECT_EQ(axis.cells, 2u);
  EXPECT_EQ(axis.count, 128u);
  EXPECT_DOUBLE_EQ(axis.first - axis.step / 2, -96 - 0.375);
  EXPECT_DOUBLE_EQ(axis.first + axis.step * 127.5, -96 + 0.75 * 255.5);
  EXPECT_EQ(reduced_axis(cells(5, 0, 1), 128).cells, 1u);
}

TEST(Explorer, ACellHasTheStrongestOfItsGroupInWholeDecibels) {
  const StoredAxes axes{cells(256, 0, 1), {0}};
  Sample sample;
  sample.magnitude.assign(256, 0);
  sample.magnitude[7] = 2;      // the peak, in cell 3
  sample.magnitude[10] = 0.2F;  // -20 dB in cell 5
  sample.magnitude[11] = 0.1F;
  sample.centre_list = {{7, 0, 2}, {10, 0, 0.2F}};
  std::vector<std::uint8_t> expected(128, 0);
  expected[3] = 40;
  expected[5] = 20;
  const ExplorerMap map = explorer_map(sample, axes);
  EXPECT_EQ(map.packed, packed(expected));
  EXPECT_NEAR(map.centres[1][2], -20, 1e-5);
}

SampleRecord record(std::int64_t sample, std::int64_t target, const char* name) {
  SampleRecord record;
  record.sample = sample;
  record.target = target;
  record.target_name = name;
  record.mwr = 0.5 * static_cast<double>(sample);
  record.seed = 1LL << 40;
  return record;
}

TEST(Explorer, KeepsTheFirstMapOfEveryStateFirst) {
  const std::vector<SampleRecord> records{record(0, 0, "a"), record(1, 0, "a"), record(2, 1, "b"), record(3, 1, "b")};
  EXPECT_EQ(explorer_order(records, {}, {}), (std::vector<std::size_t>{0, 2, 1, 3}));
  // Of one state with drawn wave heights: the first of every bin.
  const std::vector<ColumnBin> heights{{"0.1 to 0.2", 0.1, 0.2, 0.15, {0, 1}}, {"0.3 to 0.4", 0.3, 0.4, 0.35, {2}}};
  const std::vector<SampleRecord> drawn{record(0, 0, "a"), record(1, 0, "a"), record(2, 0, "a")};
  EXPECT_EQ(explorer_order(drawn, heights, {}), (std::vector<std::size_t>{0, 2, 1}));
}

TEST(Explorer, ChoosesAmongBinsByTheBinOfEveryRow) {
  const std::vector<SampleRecord> records{record(0, 0, "a"), record(1, 0, "a"), record(2, 0, "a")};
  const StoredAxes axes{cells(4, 0, 1), cells(4, 0, 1)};
  const std::vector<ColumnBin> heights{{"0.1 to 0.2", 0.1, 0.2, 0.15, {0, 2}}, {"0.3", 0.3, 0.3, 0.3, {1}}};
  const auto json = nlohmann::json::parse(explorer_json({records, {}, axes, heights, {}, 1, 0}));
  EXPECT_EQ(json.at("heights").at("texts"), (std::vector<std::string>{"0.1 to 0.2", "0.3"}));
  EXPECT_EQ(json.at("heights").at("first"), 1);
  EXPECT_EQ(json.at("heights").at("bins"), packed(std::vector<std::uint8_t>{0, 1, 0}));
}

TEST(Explorer, TakesTargetsAndColumnsFromTheRecordsAndOmitsKeysBeyondSinglePrecision) {
  const std::vector<SampleRecord> records{record(0, 0, "</script>"), record(1, 3, "tanker")};
  const StoredAxes axes{cells(4, 0, 1), cells(4, 0, 1)};
  Sample large;
  large.record = records[1];
  large.magnitude.assign(16, 1);
  ExplorerMap too_large = explorer_map(large, axes);
  too_large.sample = 0;
  too_large.packed.assign(kExplorerBytes + 1, 'A');
  const std::vector<ExplorerMap> small{explorer_map(large, axes)}, too_many{too_large};
  const std::string text = explorer_json({records, small, axes, {}, {}});
  EXPECT_EQ(text.find('<'), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json.at("targets"), nlohmann::json::parse(R"({"0": "</script>", "3": "tanker"})"));
  EXPECT_EQ(json.at("maps").at(0).at("row"), 1);
  bool mwr = false;
  for (const auto& column : json.at("columns")) {
    EXPECT_NE(column.at("name"), "seed");
    if (column.at("name") == "mwr") mwr = column.at("varies");
  }
  EXPECT_TRUE(mwr);
  EXPECT_TRUE(nlohmann::json::parse(explorer_json({records, too_many, axes, {}, {}})).at("maps").empty());
}

// 10,200 samples whose columns are all different, and maps of noise, which no packing makes smaller.
TEST(Explorer, OfTenThousandSamplesTakesLessThanHalfOfAPage) {
  const StoredAxes axes{cells(256, -96, 0.75), cells(64, -4, 0.125)};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<SampleRecord> records;
  std::vector<ExplorerMap> maps;
  for (std::int64_t i = 0; i < 10'200; ++i) {
    SampleRecord r = record(i, i % 2, "target");
    r.view = i / 2 % 17;
    r.sea_state = i / 34 % 6;
    r.realisation = i / 204;
    for (double SampleRecord::*member :
         {&SampleRecord::scr_per_pulse_db, &SampleRecord::scr_peak_cell_db, &SampleRecord::scr_extent_db,
          &SampleRecord::snr_per_pulse_db, &SampleRecord::peak_m, &SampleRecord::energy_m2, &SampleRecord::mwr,
          &SampleRecord::ccf, &SampleRecord::sigma_r_m, &SampleRecord::sigma_v_mps, &SampleRecord::start_s})
      r.*member = uniform(random);
    records.push_back(r);
    if (i >= 400) continue;
    Sample sample;
    sample.record = r;
    for (std::size_t n = 0; n < axes.cells(); ++n)
      sample.magnitude.push_back(static_cast<float>(std::exp(-5 * uniform(random))));
    sample.centre_list.assign(40, {1, 2, 0.5F});
    maps.push_back(explorer_map(sample, axes));
  }
  const std::string text = explorer_json({records, maps, axes, {}, {}});
  EXPECT_LT(text.size(), 1'500'000u);  // 820 kB of maps, 14 columns of 10,200 numbers at most 48 kB each
  EXPECT_GT(nlohmann::json::parse(text).at("maps").size(), 100u);
}

class HotSpotsOf : public testing::Test {
 protected:
  static Scenario scenario(const std::string& azimuths, const std::string& mesh = "assets/icosahedral_reflector.glb") {
    return parse_scenario(fmt::format("seaglint: 1\nview: {{azimuth_deg: {}, elevation_deg: 2}}\n"
                                      "targets: {{line: {{label: 1, points: [{{position_m: [0, 0, 0], amplitude_m: "
                                      "1}}]}}, corner: {{label: 0, mesh: {}/{}, motion: {{model: fixed}}}}}}\n"
                                      "dataset: {{maps_per_case: 1, realisations_per_case: 1}}\n",
                                      azimuths, SEAGLINT_SOURCE_DIR, mesh),
                          "hot.yaml");
  }
  static HotSpots of(const Scenario& scenario, int threads = 1) {
    const SamplePlan plan(scenario);
    return hot_spots(scenario, plan, load_targets({.scenario = scenario, .plan = plan}), threads, nullptr);
  }
};

TEST_F(HotSpotsOf, MeshesAreShownAtEveryView) {
  const HotSpots spots = of(scenario("[200, 10, 50]"));
  const auto json = nlohmann::json::parse(spots.json);
  ASSERT_EQ(json.at("targets").size(), 1u);  // ideal points have no facets
  const auto& corner = json.at("targets")[0];
  EXPECT_EQ(corner.at("name"), "corner");
  ASSERT_EQ(corner.at("views").size(), 3u);
  EXPECT_EQ(corner.at("views")[0].at("azimuth_deg"), 10);
  EXPECT_EQ(corner.at("views")[2].at("azimuth_deg"), 200);
  EXPECT_THAT(spots.about, HasSubstr(" GHz, vv, "));
  EXPECT_THAT(spots.about, Not(HasSubstr("views")));
}

TEST_F(HotSpotsOf, AreTheSameForAnyNumberOfThreads) {
  const Scenario both = scenario("[10, 50]");
  EXPECT_EQ(of(both, 1).json, of(both, 2).json);
}

TEST_F(HotSpotsOf, ManyViewsAreThinned) {
  const HotSpots spots = of(scenario("0:49:1"));
  EXPECT_EQ(nlohmann::json::parse(spots.json).at("targets")[0].at("views").size(), 17u);  // every third of 50
  EXPECT_THAT(spots.about, HasSubstr("17 of the scenario’s 50 views"));
}

}  // namespace
}  // namespace seaglint
