// SPDX-License-Identifier: BSD-3-Clause
// Divisions by columns, bins of columns and ranges over the training maps.
#include "classify/model/division.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "classify/model/data_rows.h"
#include "classify/model/scores.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Ten seas; in each a ship, a ring and a line of reflectors at two azimuths.
struct Maps {
  std::vector<DataRow> rows;
  std::vector<RowGroup> seas;
  std::vector<int> labels;

  Maps() {
    for (int sea = 0; sea < 10; ++sea) {
      for (const char* target : {"ship", "ring", "line"}) {
        for (const double azimuth_deg : {30.0, 80.0}) {
          DataRow row;
          row.record.target_name = target;
          row.record.label = row.record.target_name == "ship" ? 1 : 0;
          row.record.azimuth_deg = azimuth_deg;
          row.record.seed = 42;
          row.record.sea_key = 1000000 * (sea / 5) + sea % 5;
          row.record.significant_wave_height_m = sea < 5 ? 1 : 2;
          rows.push_back(row);
          seas.push_back({sea, sea / 5});
          labels.push_back(static_cast<int>(row.record.label));
        }
      }
    }
  }
  Division division(const DivisionRequest& request) const { return make_division(rows, seas, labels, request); }
};

std::set<std::int64_t> seas_of(const Maps& maps, const std::vector<std::size_t>& rows) {
  std::set<std::int64_t> seas;
  for (const std::size_t row : rows) seas.insert(maps.seas[row].group);
  return seas;
}

std::set<std::string> targets_of(const Maps& maps, const std::vector<std::size_t>& rows) {
  std::set<std::string> names;
  for (const std::size_t row : rows) names.insert(maps.rows[row].record.target_name);
  return names;
}

std::string refusal(const Maps& maps, const DivisionRequest& request) {
  try {
    maps.division(request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Division, BySeaIsTheSplitOfSeas) {
  const Maps maps;
  const Split a = divide(maps.division({}), Protocol::kGroup, 0.7, 42, 3);
  const Split b = split_rows(maps.seas, Protocol::kGroup, 0.7, 42, 3);
  EXPECT_EQ(a.train, b.train);
  EXPECT_EQ(a.test, b.test);
}

TEST(Division, ByAColumnKeepsEveryValueOnOneSide) {
  const Maps maps;
  const Split split = divide(maps.division({"azimuth_deg", {}}), Protocol::kGroup, 0.5, 42, 0);
  ASSERT_EQ(split.train.size(), 30u);
  ASSERT_EQ(split.test.size(), 30u);
  const double trained = maps.rows[split.train.front()].record.azimuth_deg;
  for (const std::size_t row : split.train) EXPECT_EQ(maps.rows[row].record.azimuth_deg, trained);
  for (const std::size_t row : split.test) EXPECT_NE(maps.rows[row].record.azimuth_deg, trained);
}

// Every sea has rings, lines and ships: seas are divided 7:3, so that ships are on both sides, in different seas.
TEST(Division, HoldsALayoutOutOfTheTrainingAndTestsNoOtherLayout) {
  const Maps maps;
  for (std::uint64_t repeat = 0; repeat < 20; ++repeat) {
    const Split split = divide(maps.division({"sea", {{"target_name", "ring"}}}), Protocol::kGroup, 0.7, 42, repeat);
    EXPECT_THAT(targets_of(maps, split.train), ElementsAre("line", "ship"));
    EXPECT_THAT(targets_of(maps, split.test), ElementsAre("ring", "ship"));
    const std::set<std::int64_t> trained = seas_of(maps, split.train), tested = seas_of(maps, split.test);
    EXPECT_EQ(trained.size(), 7u);
    EXPECT_EQ(tested.size(), 3u);
    for (const std::int64_t sea : tested) EXPECT_FALSE(trained.contains(sea));
  }
}

// A wave height is that of whole seas: all of these are tested and all others trained on.
TEST(Division, HoldsAWaveHeightOutWithAllItsSeas) {
  const Maps maps;
  for (const char* value : {"2", "1.5:2.5"}) {
    const Split split =
        divide(maps.division({"sea", {{"significant_wave_height_m", value}}}), Protocol::kGroup, 0.7, 42, 0);
    EXPECT_THAT(seas_of(maps, split.train), ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(seas_of(maps, split.test), ElementsAre(5, 6, 7, 8, 9));
  }
}

TEST(Division, HoldsOutAnyValueOfAColumnAndAllColumns) {
  const Maps maps;
  const std::vector<bool> either = maps.division({"sea", {{"target_name", "ring"}, {"target_name", "line"}}}).held_out;
  EXPECT_EQ(std::count(either.begin(), either.end(), true), 40);
  const std::vector<bool> both = maps.division({"sea", {{"target_name", "ring"}, {"azimuth_deg", "80"}}}).held_out;
  EXPECT_EQ(std::count(both.begin(), both.end(), true), 10);
}

TEST(Division, RefusesWhatLeavesNothing) {
  const Maps maps;
  EXPECT_THAT(refusal(maps, {"azimut_deg", {}}), HasSubstr("azimut_deg: no column of a data set: did you mean"));
  EXPECT_THAT(refusal(maps, {"sea", {{"target_name", "grid"}}}),
              HasSubstr("target_name=grid: no map has this value; the data have line, ring, ship"));
  EXPECT_THAT(refusal(maps, {"sea", {{"azimuth_deg", "0:90"}}}), HasSubstr("all 60 maps are held out"));
  EXPECT_THAT(refusal(maps, {"sea", {{"azimuth_deg", "east"}}}), HasSubstr("must be a number or LOW:HIGH"));
  EXPECT_THAT(refusal(maps, {"sea", {{"azimuth_deg", "90:0"}}}), HasSubstr("must be a number or LOW:HIGH"));
}

TEST(DataRows, OfOneSeedAndKeyAreInOneSeaWhateverTheirDataSet) {
  std::vector<DataRow> rows(4);
  rows[0].record.seed = 42;
  rows[0].record.sea_key = 3;
  rows[1] = rows[0];
  rows[1].data_set = 1;
  rows[2] = rows[0];
  rows[2].record.sea_key = 1;
  rows[3] = rows[0];
  rows[3].record.seed = 7;
  EXPECT_THAT(sea_numbers(rows), ElementsAre(2, 2, 1, 0));
}

TEST(DataRows, HaveTheKeysThatTheirScenariosDraw) {
  std::vector<DataRow> rows(3);
  rows[0].record.drawn_numbers = {{"sea.peak_period_s", 7.5}};
  rows[2].record.drawn_numbers = {{"sea.peak_period_s", 9}};
  rows[2].record.drawn_words = {{"targets.decoys.layout", "ring"}};
  const ColumnOfRows periods = column_of(rows, "sea.peak_period_s");
  EXPECT_FALSE(periods.is_text);
  EXPECT_EQ(periods.numbers[0], 7.5);
  EXPECT_TRUE(std::isnan(periods.numbers[1]));
  EXPECT_THAT(column_of(rows, "targets.decoys.layout").texts, ElementsAre("", "", "ring"));
  EXPECT_THROW(column_of(rows, "sea.gamma"), InputError);
}

TEST(ColumnBins, OfManyValuesHaveEqualNumbersOfRowsAndKeepEqualValuesTogether) {
  ColumnOfRows column{"x", "m", false, {}, {}};
  for (int i = 99; i >= 0; --i) column.numbers.push_back(i);
  const std::vector<ColumnBin> bins = bins_of(column, 8, 5);
  ASSERT_EQ(bins.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(bins[i].rows.size(), 20u);
    EXPECT_EQ(bins[i].lowest, 20.0 * static_cast<double>(i));
    EXPECT_EQ(bins[i].highest, 20.0 * static_cast<double>(i) + 19);
  }
  // Half of the rows have one value: they are a bin of their own.
  for (std::size_t i = 0; i < 50; ++i) column.numbers[i] = 200;
  std::size_t rows = 0;
  for (const ColumnBin& bin : bins_of(column, 8, 5)) rows += bin.rows.size();
  EXPECT_EQ(rows, 100u);
  EXPECT_EQ(bins_of(column, 8, 5).back().rows.size(), 50u);
}

TEST(ColumnBins, OfFewValuesAreTheValuesAndUndefinedOnesComeLast) {
  const ColumnOfRows column{"x", "dB", false, {10, std::nan(""), 20, 10}, {}};
  const std::vector<ColumnBin> bins = bins_of(column, 8, 5);
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].text, "10");
  EXPECT_THAT(bins[0].rows, ElementsAre(0u, 3u));
  EXPECT_THAT(bins[1].rows, ElementsAre(2u));
  EXPECT_EQ(bins[2].text, "undefined");
  EXPECT_THAT(bins[2].rows, ElementsAre(1u));
}

TEST(ValueRange, OfTheTrainingRowsExcludesWhatIsBeyondThem) {
  const ColumnOfRows column{"mwr", "(m/s)^2", false, {1, 5, 3, 100}, {}};
  const std::vector<std::size_t> trained{0, 1, 2};
  const ValueRange range = range_of(column, trained, std::vector<int>{0, 1, 0, 1}, 2);
  EXPECT_EQ(range.lowest, 1);
  EXPECT_EQ(range.highest, 5);
  EXPECT_EQ(range.by_label[0][1], 2);  // median of 1 and 3
  EXPECT_EQ(range.by_label[1][1], 5);
  EXPECT_FALSE(range.excludes(1));
  EXPECT_FALSE(range.excludes(5));
  EXPECT_FALSE(range.excludes(5.004));  // 0.1 % of 5 is 0.005
  EXPECT_TRUE(range.excludes(0.99));
  EXPECT_TRUE(range.excludes(100));
  EXPECT_TRUE(range.excludes(std::nan("")));
}

// Without clutter in training an SCR is outside, and none is inside.
TEST(ValueRange, OfAnUndefinedColumnExcludesEveryValue) {
  const ColumnOfRows column{"scr_peak_cell_db", "dB", false, {std::nan(""), std::nan("")}, {}};
  const std::vector<std::size_t> trained{0, 1};
  const ValueRange range = range_of(column, trained, std::vector<int>{0, 1}, 2);
  EXPECT_TRUE(range.excludes(20));
  EXPECT_FALSE(range.excludes(std::nan("")));
}

// By hand: 0.05 and 0.15 of label 0, 0.95 twice of labels 1 and 0.
TEST(Calibration, OfASmallExampleByHand) {
  std::vector<Prediction> predictions;
  for (const auto& [probability, label] : {std::pair(0.05, 0), {0.15, 0}, {0.95, 1}, {0.95, 0}})
    predictions.push_back({0, 0, label, probability});
  const Calibration result = calibration(predictions);
  ASSERT_EQ(result.bins.size(), 10u);
  EXPECT_EQ(result.bins[9].rows, 2u);
  EXPECT_DOUBLE_EQ(result.bins[9].fraction, 0.5);
  // (0.05 + 0.15 + |1.9 - 1|) / 4
  EXPECT_NEAR(result.expected_error, 0.275, 1e-12);
  EXPECT_TRUE(std::isnan(result.bins[5].fraction));
  EXPECT_TRUE(std::isnan(calibration({}).expected_error));
}

}  // namespace
}  // namespace seaglint
