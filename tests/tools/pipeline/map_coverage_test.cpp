// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/warnings.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Warnings of one target whose recorded motion drifts at 2 m/s along x for 40 s, seen from ahead.
std::vector<std::string> warnings_of_drift(const std::string& motion, double spacing_s) {
  const TemporaryFolder folder;
  std::string series = "time_s,roll_deg,pitch_deg,surge_m,sway_m,heave_m\n";
  for (int n = 0; n <= 400; ++n) series += fmt::format("{:.1f},0,0,{:.1f},0,0\n", 0.1 * n, 412300 + 0.2 * n);
  write_file(folder.path() / "drift.csv", series);
  const Pipeline pipeline(parse_scenario(
      fmt::format("seaglint: 1\nview: {{azimuth_deg: 0, elevation_deg: 2}}\nmap: {{range_span_m: 60}}\ntargets:\n"
                  "  a: {{label: 0, mesh: assets/icosahedral_reflector.glb,\n"
                  "      motion: {{model: series, file: drift.csv{}}}}}\n"
                  "  b: {{label: 1, points: [{{position_m: [0, 0, 0]}}]}}\n"
                  "dataset: {{maps_per_case: 2, realisations_per_case: 1, interval_spacing_s: {}}}\n",
                  motion, spacing_s),
      (folder.path() / "drift.yaml").string()));
  return map_coverage_warnings(pipeline);
}

// The mean position is removed: the body is within 40 m of the origin, at first 40 m astern, where the map ends at 30
// m.
TEST(MapCoverage, NamesRecordedMotionThatLeavesTheMap) {
  EXPECT_THAT(warnings_of_drift("", 1), IsEmpty());  // without translations
  EXPECT_THAT(warnings_of_drift(", translations: true", 1),
              ElementsAre(HasSubstr("targets.a at azimuth 0 deg reaches from")));
  EXPECT_THAT(warnings_of_drift(", translations: true, series_start_s: 15", 1), IsEmpty());
  EXPECT_THAT(warnings_of_drift(", translations: true, series_start_s: 5", 30),
              ElementsAre(HasSubstr("raise map.range_span_m")));
  EXPECT_THAT(warnings_of_drift(", translations: true, position: keep, series_start_s: 15", 1),
              ElementsAre(HasSubstr("-412")));
}

}  // namespace
}  // namespace seaglint
