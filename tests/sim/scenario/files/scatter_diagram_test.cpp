// SPDX-License-Identifier: BSD-3-Clause
// Scatter diagrams as they are printed and exported are read, and drawn as often as they count.
#include "sim/scenario/files/tables.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string diagram_refusal(const std::string& text) {
  try {
    read_scatter_diagram({"s.csv", text});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Cells as lines "height_low height_high period_low period_high count".
std::string cells_of(const std::string& text) {
  std::string lines;
  for (const ScatterCell& cell : read_scatter_diagram({"s.csv", text}).cells)
    lines += fmt::format("{:g} {:g} {:g} {:g} {:g}\n", cell.lowest_height_m, cell.highest_height_m,
                         cell.lowest_period_s, cell.highest_period_s, cell.count);
  return lines;
}

const char* const kCells =
    "0 1 4 6 10\n"
    "0 1 6 8 30\n"
    "1 2 6 8 20\n"
    "2 3 8 10 5\n";

TEST(ScatterDiagram, IsReadInAnyLayoutAndWithAnySeparator) {
  for (const char* text :
       {"Hs/Tp,5,7,9\n0.5,10,30,0\n1.5,0,20,0\n2.5,0,0,5\n",
        "# North Sea, counts\nHs [m] \\ Tp [s];5;7;9;Sum\n0,5;10;30;0;40\n1,5;;20;;20\n2,5;0;0;5;5\nSum;10;50;5;65\n",
        "significant_wave_height_m/peak_period_s\t4-6\t6-8\t8-10\n0-1\t10\t30\t-\n1 - 2\t0\t20\t0\n2 to 3\t0\t0\t5\n",
        "Tp/Hs 0.5 1.5 2.5\n5 10 0 0\n7 30 20 0\n9 0 0 5\n",
        "hs_m,tp_s,count\n0.5,5,10\n0.5,7,30\n1.5,7,20\n2.5,9,5\n2.5,5,0\n",
        "count;peak_period_s;significant_wave_height_m\n5;9;2,5\n20;7;1,5\n30;7;0,5\n10;5;0,5\n"}) {
    EXPECT_EQ(cells_of(text), kCells) << text;
    EXPECT_EQ(read_scatter_diagram({"s.csv", text}).period_key, "peak_period_s");
  }
}

TEST(ScatterDiagram, IsRefusedWithThePlaceOfItsMistake) {
  const std::pair<const char*, const char*> cases[] = {
      {"5,7\n0.5,10,30\n", "s.csv: no scatter diagram: its first cell must name"},
      {"Hs/Tx,5,7\n0.5,10,30\n1.5,1,1\n", "s.csv: no scatter diagram"},
      {"", "s.csv: no scatter diagram"},
      {"Hs/Tp,5,seven\n0.5,10,30\n", "s.csv:1:9: 'seven': must be a period"},
      {"Hs/Tp,5,5\n0.5,10,30\n", "s.csv:1:9: '5': appears twice"},
      {"Hs/Tp,5,7\n0.5,10,-30\n1.5,0,0\n", "s.csv:2:8: '-30': must be a count"},
      {"Hs/Tp,5,7\n0.5,10,nan\n1.5,0,0\n", "s.csv:2:8: 'nan': must be a count"},
      {"Hs/Tp,5,7\n0.5,10\n1.5,0,0\n", "s.csv:2:1: 2 cells where the first row has 3"},
      {"Hs/Tp,5,7\n0.5,10,1,2\n1.5,0,0\n", "4 cells where the first row has 3"},
      {"Hs/Tp,5,7\n0.5,0,0\n1.5,0,0\n", "s.csv: all counts are 0"},
      {"Hs/Tp,5,7\n0.5,1,0\n", "s.csv:2:1: '0.5': wave heights must be centres of two or more equal cells"},
      {"Hs/Tp,5,7,10\n0.5,1,0,1\n1.5,1,0,1\n", "s.csv:1:11: '10': periods must be centres of two or more equal cells"},
      {"Hs/Tp,5,7-9\n0.5,1,0\n1.5,1,0\n", "all be centres of cells, or all cells LOW-HIGH"},
      {"Hs/Tp,5,7\n0,1,0\n1,1,0\n", "s.csv:2:1: '0': its cell, -0.5 to 0.5, begins below 0"},
      {"hs_m,tp_s,count\n0.5,5,10\n0.5,5,30\n1.5,7,20\n", "this pair of height and period appears twice"},
      {"hs_m,tp_s,count\n0.5,5,10\n1.5,7,-1\n", "must be"}};
  for (const auto& [text, message] : cases) EXPECT_THAT(diagram_refusal(text), HasSubstr(message)) << text;
}

// Pearson's statistic of 4 cells has 3 degrees of freedom: 21.1 is exceeded with probability 1e-4; the means of u over
// a cell of n draws have the standard deviation 1/sqrt(12 n).
TEST(ScatterDiagram, IsDrawnAsOftenAsItCountsAndUniformlyWithinItsCells) {
  const ScatterDiagram diagram = read_scatter_diagram({"s.csv", "Hs/Tp,5,7,9\n0.5,10,30,0\n1.5,0,20,0\n2.5,0,0,5\n"});
  constexpr int kDraws = 20000;
  std::vector<double> counts(diagram.cells.size()), heights(counts.size()), periods(counts.size());
  for (int i = 0; i < kDraws; ++i) {
    Random random({1, Stream::kTest, static_cast<std::uint64_t>(i)});
    const SeaPair pair = diagram.draw(random);
    std::size_t inside = 0;
    for (std::size_t c = 0; c < counts.size(); ++c) {
      const ScatterCell& cell = diagram.cells[c];
      const double u =
          (pair.significant_wave_height_m - cell.lowest_height_m) / (cell.highest_height_m - cell.lowest_height_m);
      const double v = (pair.period_s - cell.lowest_period_s) / (cell.highest_period_s - cell.lowest_period_s);
      if (u < 0 || u > 1 || v < 0 || v > 1) continue;
      ++inside;
      ++counts[c];
      heights[c] += u;
      periods[c] += v;
    }
    ASSERT_EQ(inside, 1u) << pair.significant_wave_height_m << " " << pair.period_s;
  }
  double chi_squared = 0;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const double expected = kDraws * diagram.cells[c].count / diagram.count();
    chi_squared += (counts[c] - expected) * (counts[c] - expected) / expected;
    for (const double sum : {heights[c], periods[c]})
      EXPECT_NEAR(sum / counts[c], 0.5, 5 / std::sqrt(12 * counts[c])) << c;
  }
  EXPECT_LT(chi_squared, 21.1);
}

TEST(ScatterDiagram, WithoutSomeCellsStatesTheirPartOfTheCounts) {
  ScatterDiagram diagram = read_scatter_diagram({"s.csv", "Hs/Tp,5,7,9\n0.5,10,30,0\n1.5,0,20,0\n2.5,0,0,5\n"});
  EXPECT_EQ(diagram.likeliest().period_s, 7);
  EXPECT_EQ(diagram.likeliest().significant_wave_height_m, 0.5);
  exclude_cells(diagram, {false, true, false, true});
  EXPECT_EQ(diagram.cells.size(), 2u);
  EXPECT_EQ(diagram.excluded_cells, 2u);
  EXPECT_NEAR(diagram.excluded_fraction, 35.0 / 65, 1e-15);
}

}  // namespace
}  // namespace seaglint
