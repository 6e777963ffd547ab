// SPDX-License-Identifier: BSD-3-Clause
// Codes from a file, and pulses with jittered start times.
#include <gtest/gtest.h>

#include <cmath>

#include "radar/waveform/pulse_train.h"
#include "sim/core/process/error.h"
#include "sim/scenario/files/hop_code_file.h"

namespace seaglint {
namespace {

TEST(HopCodeFile, IsUsedBlockByBlock) {
  RadarSpec spec;
  spec.pulses = 4;
  spec.carrier_count = 3;
  spec.hop_code = HopCode::kFile;
  spec.hop_codes =
      std::make_shared<std::vector<int>>(parse_hop_code("# two intervals\n0, 1 2,0\n2\t2\n1,1\n", "codes.txt", 4, 3));
  EXPECT_EQ(make_pulse_train(spec, 100, 1, 0).code, (std::vector<int>{0, 1, 2, 0}));
  EXPECT_EQ(make_pulse_train(spec, 100, 1, 1).code, (std::vector<int>{2, 2, 1, 1}));
  EXPECT_EQ(make_pulse_train(spec, 100, 9, 4).code, (std::vector<int>{0, 1, 2, 0}));
  EXPECT_NE(figures_of_merit_text(make_pulse_train(spec, 100, 1, 1), spec)
                .find("no pulse of the first interval uses carrier 0"),
            std::string::npos);
}

TEST(HopCodeFile, RefusesInvalidCodes) {
  for (const char* text :
       {"", "# nothing\n", "0 1 2", "0 1 2 3", "0 1 x 2", "0 1 -1 2", "0 1 1.5 2", "0 1 2 99999999999"}) {
    EXPECT_THROW(parse_hop_code(text, "codes.txt", 4, 3), InputError) << text;
  }
  try {
    parse_hop_code("0 1\n2 3\n", "codes.txt", 4, 3);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("codes.txt:2:3: '3'"), std::string::npos) << error.what();
  }
}

TEST(PriJitter, ShiftsEveryPulseButTheFirstWithinItsBound) {
  RadarSpec spec;
  spec.pri_jitter_us = 100;
  const std::vector<double> times = pulse_times(spec, 1, 2);
  EXPECT_EQ(times[0], 0);
  double square = 0;
  for (std::size_t n = 1; n < times.size(); ++n) {
    const double moved = times[n] - static_cast<double>(n) * 250e-6;
    EXPECT_LE(std::abs(moved), 100e-6 * (1 + 1e-9));
    EXPECT_GT(times[n], times[n - 1]);
    square += moved * moved / 255;
  }
  EXPECT_NEAR(square / (100e-6 * 100e-6 / 3), 1, 4 * std::sqrt(0.8 / 255));  // var x^2 of a uniform x: 4/45 against 1/9
  EXPECT_NE(times, pulse_times(spec, 1, 3));
  EXPECT_EQ(times, pulse_times(spec, 1, 2));
}

}  // namespace
}  // namespace seaglint
