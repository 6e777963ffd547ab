// SPDX-License-Identifier: BSD-3-Clause
// A misspelt word means the name that is nearest to it, with or without its unit, or that begins with it.
#include "sim/core/text/names.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace seaglint {
namespace {

const std::vector<std::string> kRadar{"carrier_ghz",   "hop_count",      "hop_step_mhz", "hop_code",
                                      "bandwidth_mhz", "pulse_width_us", "sampling_mhz", "pri_us",
                                      "pri_jitter_us", "pulses"};

TEST(Suggestion, IsTheNearestNameByLettersOrByTheNameWithoutItsUnit) {
  const std::pair<const char*, const char*> meant[] = {{"carier_ghz", "carrier_ghz"},
                                                       {"pulse", "pulses"},
                                                       {"bandwidth", "bandwidth_mhz"},
                                                       {"carrier", "carrier_ghz"},
                                                       {"bandwidth_hz", "bandwidth_mhz"},
                                                       {"Pulse_Width", "pulse_width_us"},
                                                       {"pri", "pri_us"},
                                                       {"pri_s", "pri_us"},
                                                       {"bandwith", "bandwidth_mhz"},
                                                       {"sampling_rate_mhz", "sampling_mhz"},
                                                       {"jitter", "pri_jitter_us"},
                                                       {"hop_step_hz", "hop_step_mhz"}};
  for (const auto& [word, name] : meant)
    EXPECT_EQ(suggestion(word, kRadar), "did you mean '" + std::string(name) + "'?");
  EXPECT_EQ(suggestion("--frequency", {"--frequency-ghz", "--facets"}), "did you mean '--frequency-ghz'?");
  EXPECT_EQ(suggestion("bandwidth", {"radar.bandwidth_mhz", "sea.gamma"}), "did you mean 'radar.bandwidth_mhz'?");
}

TEST(Suggestion, NamesSeveralThatBeginWithTheWord) {
  EXPECT_EQ(suggestion("hop", kRadar), "did you mean 'hop_count', 'hop_step_mhz' or 'hop_code'?");
}

TEST(Suggestion, IsTheWholeListWhenNoNameIsNear) {
  EXPECT_EQ(suggestion("colour", {"a", "b"}), "must be one of a, b");
  EXPECT_EQ(near_suggestion("colour", {"a", "b"}), std::nullopt);
  EXPECT_EQ(near_suggestion(std::string(10000, 'a'), {"a"}), std::nullopt);
  EXPECT_EQ(near_suggestion("", {}), std::nullopt);
}

}  // namespace
}  // namespace seaglint
