// SPDX-License-Identifier: BSD-3-Clause
#include "radar/waveform/pulse_train.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scenario/files/tables.h"

namespace seaglint {
namespace {

// Codes from a file, and pulses with jittered start times.

TEST(HopCodeFile, IsUsedBlockByBlock) {
  RadarSpec spec;
  spec.pulses = 4;
  spec.carrier_count = 3;
  spec.hop_code = HopCode::kFile;
  spec.hop_codes =
      std::make_shared<std::vector<int>>(read_hop_code({"codes.txt", "# two intervals\n0, 1 2,0\n2\t2\n1,1\n"}, 4, 3));
  EXPECT_EQ(make_pulse_train(spec, 100, 1, 0).code, (std::vector<int>{0, 1, 2, 0}));
  EXPECT_EQ(make_pulse_train(spec, 100, 1, 1).code, (std::vector<int>{2, 2, 1, 1}));
  EXPECT_EQ(make_pulse_train(spec, 100, 9, 4).code, (std::vector<int>{0, 1, 2, 0}));
  EXPECT_NE(figures_of_merit_text(make_pulse_train(spec, 100, 1, 1), spec)
                .find("no pulse of the first interval uses carrier 0"),
            std::string::npos);
}

TEST(HopCodeFile, RefusesInvalidCodes) {
  for (const char* text :
       {"", "# nothing\n", "0 1 2", "0 1 2 3", "0 1 x 2", "0 1 -1 2", "0 1 1.5 2", "0 1 2 99999999999"})
    EXPECT_THROW(read_hop_code({"codes.txt", text}, 4, 3), InputError) << text;
  try {
    read_hop_code({"codes.txt", "0 1\n2 3\n"}, 4, 3);
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

RadarSpec paper_radar() { return {}; }
constexpr double kShipWindow = 239.8;  // c / (2 0.625 MHz)

TEST(PulseTrain, ThePaperRadarHasItsResolutionsAndFortyBinsPerPulse) {
  const PulseTrain train = make_pulse_train(paper_radar(), kShipWindow, 1, 2);
  EXPECT_EQ(train.frequencies(), 40u);
  EXPECT_EQ(train.band_bins(), 320);
  EXPECT_NEAR(train.baseband_step_hz, 0.625e6, 1e-6);
  EXPECT_NEAR(train.range_resolution_m(), 0.75, 0.001);
  EXPECT_NEAR(train.velocity_resolution_mps(), 0.1456, 5e-5);
  EXPECT_NEAR(train.unambiguous_velocity_mps(), 18.635, 0.001);
  EXPECT_NEAR(train.unambiguous_range_m(), 239.83, 0.01);
  EXPECT_NEAR(train.band_centre_hz(), 16e9 + 3.5 * 25e6, 1e-3);
}

TEST(PulseTrain, BandsOfAdjacentCarriersCoverTheBandUniformly) {
  const PulseTrain train = make_pulse_train(paper_radar(), kShipWindow, 1, 2);
  std::vector<double> all;
  for (int i = 0; i < train.carriers; ++i)
    for (const double f : train.baseband_hz) all.push_back(train.first_carrier_hz + i * train.hop_step_hz + f);
  for (std::size_t k = 1; k < all.size(); ++k)
    EXPECT_NEAR(all[k] - all[k - 1], train.baseband_step_hz, 1e-5);  // 16e9 eps = 4e-6
}

TEST(PulseTrain, FrequenciesOfEveryPulseAreOnOneGrid) {
  for (const double bandwidth : {10.0, 25.0, 60.0}) {
    RadarSpec spec = paper_radar();
    spec.bandwidth_mhz = bandwidth;
    spec.sampling_mhz = 80;
    const PulseTrain train = make_pulse_train(spec, kShipWindow, 3, 4);
    const IntervalSampling sampling = interval_sampling(train, 12.5);
    ASSERT_EQ(sampling.pulse_first.size(), 256u);
    EXPECT_EQ(sampling.frequencies_per_pulse, static_cast<int>(std::round(bandwidth / 0.625)));
    for (std::size_t n = 0; n < train.pulses(); ++n) {
      EXPECT_DOUBLE_EQ(sampling.pulse_time_s[n], 12.5 + static_cast<double>(n) * 250e-6);
      for (int b = 0; b < sampling.frequencies_per_pulse; ++b) {
        const double f = sampling.first_hz + (sampling.pulse_first[n] + b) * sampling.step_hz;
        EXPECT_NEAR(f, train.carrier_hz[n] + train.baseband_hz[b], 1e-4);
        EXPECT_LE(std::abs(train.baseband_hz[b]), train.bandwidth_hz / 2);
      }
      EXPECT_LE(sampling.pulse_first[n] + sampling.frequencies_per_pulse, sampling.count);
    }
  }
}

TEST(PulseTrain, TheWindowIsAtLeastTheRequestedOne) {
  for (const double window : {0.5, 5.9, 6.1, 100.0, 239.8, 240.0, 1000.0})
    EXPECT_GE(make_pulse_train(paper_radar(), window, 1, 1).unambiguous_range_m(), window * (1 - 1e-9));
}

TEST(HopCode, BalancedUsesEveryCarrierEquallyOftenAndSteppedInOrder) {
  for (const int carriers : {1, 7, 8, 300}) {
    std::vector<int> count(carriers);
    for (const int c : hop_code(HopCode::kBalanced, 256, carriers, 5, 6)) ++count.at(c);
    const auto [fewest, most] = std::minmax_element(count.begin(), count.end());
    EXPECT_LE(*most - *fewest, 256 % carriers == 0 ? 0 : 1);
    const std::vector<int> stepped = hop_code(HopCode::kStepped, 256, carriers, 5, 6);
    for (int n = 0; n < 256; ++n) EXPECT_EQ(stepped[n], n % carriers);
  }
}

TEST(HopCode, RandomIsUniformIndependentAndKeyed) {
  EXPECT_EQ(hop_code(HopCode::kRandom, 256, 8, 5, 6), hop_code(HopCode::kRandom, 256, 8, 5, 6));
  EXPECT_NE(hop_code(HopCode::kRandom, 256, 8, 5, 6), hop_code(HopCode::kRandom, 256, 8, 5, 7));
  EXPECT_NE(hop_code(HopCode::kBalanced, 256, 8, 5, 6), hop_code(HopCode::kBalanced, 256, 8, 6, 6));
  std::vector<double> count(64);  // pairs of successive pulses
  const int intervals = 400;
  for (int i = 0; i < intervals; ++i) {
    const std::vector<int> code = hop_code(HopCode::kRandom, 256, 8, 5, i);
    for (int n = 0; n < 256; n += 2) ++count[8 * code[n] + code[n + 1]];
  }
  const double expected = intervals * 128 / 64.0;
  double chi_square = 0;
  for (const double n : count) chi_square += (n - expected) * (n - expected) / expected;
  EXPECT_LT(chi_square, 103.4);  // 63 degrees of freedom, significance 0.001
}

TEST(ChirpSpectrum, IsTheStationaryPhaseSpectrumOfAnLfmPulse) {
  const PulseTrain train = make_pulse_train(paper_radar(), kShipWindow, 1, 2);
  // |P| = 1 and phase pi/4 - pi f^2 / mu inside the band, with Fresnel ripples of 1/(pi sqrt(2 x)), x the distance to
  // the band's edge in units of sqrt(mu), from either edge; the sampled chirp's images add at most as much again.
  for (std::size_t b = 0; b < train.frequencies(); ++b) {
    const double f = train.baseband_hz[b];
    const double edge = (train.bandwidth_hz / 2 - std::abs(f)) / std::sqrt(train.chirp_rate_hz_s);
    const Complex expected = std::polar(1.0, kPi / 4 - kPi * f * f / train.chirp_rate_hz_s);
    const double ripple = 2 / (kPi * std::sqrt(2.0) * edge);
    EXPECT_NEAR(std::abs(train.chirp_spectrum[b] - expected), 0, ripple + 0.02) << f;
  }
}

TEST(ChirpSpectrum, IsSymmetricAndHasTheEnergyOfThePulse) {
  // The whole sampled spectrum: 1800 frequencies of one period, so that sum |P|^2 df = mu T_p.
  const double bandwidth = 25e6, width = 36e-6, sampling = 50e6;
  std::vector<double> frequencies;
  for (int i = -900; i < 900; ++i) frequencies.push_back((i + 0.5) * sampling / 1800);
  const std::vector<Complex> spectrum = chirp_spectrum(bandwidth, width, sampling, frequencies);
  double energy = 0;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    energy += std::norm(spectrum[i]) * sampling / 1800;
    EXPECT_NEAR(std::abs(spectrum[i] - spectrum[spectrum.size() - 1 - i]), 0, 1e-11);
  }
  EXPECT_NEAR(energy / bandwidth, 1, 1e-12);  // mu T_p = B
}

TEST(PulseTrain, RefusesIntervalsTooLargeForMemory) {
  RadarSpec spec = paper_radar();
  EXPECT_THROW(make_pulse_train(spec, 1e12, 1, 1), InputError);
  spec.pulses = 65536;
  EXPECT_THROW(make_pulse_train(spec, 1e5, 1, 1), InputError);
  spec = paper_radar();
  spec.pulse_width_us = 1e6;
  spec.pri_us = 1e7;
  EXPECT_THROW(make_pulse_train(spec, 200, 1, 1), InputError);
}

TEST(PulseTrain, HasADescriptionForEveryCode) {
  for (const HopCode code : {HopCode::kRandom, HopCode::kBalanced, HopCode::kStepped}) {
    RadarSpec spec = paper_radar();
    spec.hop_code = code;
    const std::string text = figures_of_merit_text(make_pulse_train(spec, kShipWindow, 1, 2), spec);
    EXPECT_NE(text.find("0.749"), std::string::npos) << text;
    EXPECT_NE(text.find("5396 m"), std::string::npos) << text;  // blind range c T_p / 2
    EXPECT_NE(text.find("37.47 km"), std::string::npos) << text;
  }
}

// Reference figures: one scatterer, 256 pulses, 8 carriers of 25 MHz.
TEST(ExpectedResponse, HasThePedestalOfBalancedCodesAtKnownPoints) {
  RadarSpec spec = paper_radar();
  spec.hop_code = HopCode::kBalanced;
  const PulseTrain train = make_pulse_train(spec, kShipWindow, 1, 2);
  const auto level_db = [&](double r, double v) { return 10 * std::log10(expected_response_power(train, r, v)); };
  EXPECT_NEAR(level_db(1.5, 1.757), -24.1, 0.05);
  EXPECT_NEAR(level_db(0, 1), -34.3, 0.05);
  EXPECT_NEAR(level_db(0, 5), -31.4, 0.05);
  EXPECT_NEAR(level_db(2, 0), -18.09, 0.005);
  EXPECT_NEAR(level_db(0, 0), 0, 1e-9);
}

}  // namespace
}  // namespace seaglint
