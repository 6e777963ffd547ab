// SPDX-License-Identifier: BSD-3-Clause
// The two sentences about a comparison.
#include "tools/compare/comparison_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sim/field_tables/field_table.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

// Levels in hh at 10 GHz over azimuths 0 to 180 deg.
FieldTable table(const std::string& name, const std::function<double(int)>& level_dbsm) {
  FieldTable table;
  table.name = name;
  RcsCut& cut = table.cuts.emplace_back();
  cut.name = name;
  cut.element = Polarisation::kHh;
  cut.transmitter = DeclaredTransmitter{};
  for (int azimuth = 0; azimuth <= 180; ++azimuth)
    cut.values.push_back({10e9, 90, static_cast<double>(azimuth), level_dbsm(azimuth), {}, azimuth + 2});
  return table;
}

std::string verdict_of(const std::function<double(int)>& level_dbsm, const std::function<double(int)>& compared_dbsm) {
  return verdict(compare_with_table(table("chamber.csv", level_dbsm), table("solver.csv", compared_dbsm), {}, 1));
}

// A null of 40 dB every 10 deg.
double pattern(int azimuth) { return azimuth % 10 == 5 ? -40 : 0; }

TEST(Verdict, OfEqualValuesStatesTheLargestDifference) {
  EXPECT_EQ(
      verdict_of(pattern, pattern),
      "The RCS of solver.csv agrees with chamber.csv within 0.01 dB in hh at 90 % of the 181 angles. No value of hh "
      "differs by more than 0.01 dB.");
}

TEST(Verdict, NamesNullsWhereAllLargeDifferencesAreInThem) {
  EXPECT_EQ(
      verdict_of(pattern, [](int az) { return pattern(az) + (az % 10 == 5   ? 4
                                                             : az % 10 == 7 ? 0.5
                                                                            : 0.2); }),
      "The RCS of solver.csv agrees with chamber.csv within 0.5 dB in hh at 90 % of the 181 angles. All 18 "
      "differences beyond 1.0 dB in hh are in levels more than 20 dB below its strongest (nulls and weak lobes).");
}

TEST(Verdict, NamesTheSectorOfMostDifferences) {
  const std::string text = verdict_of([](int) { return 3; }, [](int az) { return az >= 40 && az <= 50 ? 5.5 : 3.1; });
  EXPECT_THAT(text, HasSubstr("within 0.1 dB in hh at 90 %"));
  EXPECT_THAT(text, HasSubstr("The differences in hh are mainly at azimuth 40 to 50 deg (98 % of their squared sum)."));
}

TEST(Verdict, SeparatesAnOffsetFromTheRest) {
  const std::string text = verdict_of(pattern, [](int az) { return pattern(az) + 1.5 + 0.1 * (az % 2); });
  EXPECT_THAT(text, HasSubstr("The RCS of solver.csv is 1.5 dB higher than that of chamber.csv in hh; apart from this "
                              "offset they agree within 0.05 dB at 90 % of the 181 angles."));
}

TEST(Verdict, OfAnExportInAnotherUnitNamesTheCause) {
  EXPECT_THAT(verdict_of([](int az) { return 60 + pattern(az); }, pattern),
              HasSubstr("Possible cause: the export is 60.0 dB higher throughout: an area in mm^2 or a mesh in mm?"));
}

// Strong levels agree, half of the others do not: an agreement with its limit, and where the rest is.
TEST(Verdict, OfStrongLevelsAloneIsAnAgreementWithItsLimit) {
  const std::string text =
      verdict_of([](int az) { return az < 90 ? 0 : -30; }, [](int az) { return az < 90    ? 0.2
                                                                               : az < 120 ? -22
                                                                                          : -30; });
  EXPECT_THAT(text,
              HasSubstr("agrees with chamber.csv within 0.2 dB in hh at 90 % of the levels within 20 dB of the "
                        "strongest, but within 8.0 dB only at 90 % of all 181 angles. The differences in hh are mainly "
                        "at azimuth 90 to 119 deg"));
}

TEST(Verdict, DoesNotCallDifferentPatternsAnAgreement) {
  const std::string text =
      verdict_of([](int az) { return 10 * std::sin(0.3 * az); }, [](int az) { return 10 * std::sin(0.3 * az + 1.5); });
  EXPECT_THAT(text, testing::StartsWith("The RCS of solver.csv does not agree with chamber.csv: 90 % of the 181 angles "
                                        "are within "));
}

}  // namespace
}  // namespace seaglint
