// SPDX-License-Identifier: BSD-3-Clause
// The scenarios of the project are valid and have the sizes of their table.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "sim/scenario/scenario.h"

namespace seaglint {
namespace {

std::size_t map_count(const Scenario& scenario) {
  return sea_states(scenario.sea).size() * views(scenario.view).size() * scenario.targets.size() *
         static_cast<std::size_t>(scenario.dataset.maps_per_case);
}

TEST(ShippedScenarios, AreValidAndRoundTripThroughTheirEffectiveForm) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SEAGLINT_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    ++count;
    const Scenario scenario = read_scenario(entry.path());
    const std::string effective = effective_yaml(scenario);
    EXPECT_EQ(effective_yaml(parse_scenario(effective, entry.path())), effective) << entry.path();
    EXPECT_TRUE(parse_scenario(effective, entry.path()) == scenario) << entry.path();
    EXPECT_EQ(scenario.name, entry.path().stem()) << entry.path();
  }
  EXPECT_GE(count, 3);
}

TEST(ShippedScenarios, HaveTheSizesOfTheirTable) {
  const std::map<std::string, std::size_t> sizes{{"quick", 300}, {"paper", 10200}, {"realistic", 180}, {"points", 40}};
  for (const auto& [name, maps] : sizes) {
    EXPECT_EQ(map_count(read_scenario(SEAGLINT_SOURCE_DIR "/scenarios/" + name + ".yaml")), maps) << name;
  }
}

}  // namespace
}  // namespace seaglint
