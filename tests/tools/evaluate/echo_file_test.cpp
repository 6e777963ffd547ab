// SPDX-License-Identifier: BSD-3-Clause
// Intervals as samples over time: an ideal chirp delayed in time becomes the point that it is the echo of; files that
// contradict their scenario are refused.
#include "tools/evaluate/classify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <span>

#include "classify/dataset/format/npz.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tests/temporary_folder.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

constexpr std::size_t kPulses = 64, kSamples = 1914;  // 29 times 66 = 50 MHz / (25 MHz / 33)
constexpr double kSampling = 50e6, kWidth = 36e-6, kBandwidth = 25e6, kPri = 250e-6;

template <class T>
NpzArray array(const char* name, const char* type, const std::vector<std::uint64_t>& shape,
               const std::vector<T>& values) {
  return npz_array(name, type, shape, bytes_of_values(std::span<const T>(values)));
}

// The measured echo of a point.
struct Measured {
  std::vector<std::complex<double>> echo;
  std::vector<double> time_s, pulse_time_s, carrier_hz;
  std::vector<std::int64_t> hop_code;
  std::string scenario =
      "seaglint: 1\nname: measured\nradar: {pulses: 64}\n"
      "targets: {point: {label: 0, points: [{position_m: [0, 0, 0]}]}}\n";
  std::string description;
  std::map<std::string, NpzArray> replaced;  // in place of, or beside, the arrays
  std::vector<std::string> left_out;

  Measured(double range_m, double velocity_mps, double amplitude_m) {
    for (std::size_t k = 0; k < kSamples; ++k)
      time_s.push_back((static_cast<double>(k) - (kSamples - 1) / 2.0) / kSampling);
    for (std::size_t n = 0; n < kPulses; ++n) {
      hop_code.push_back(static_cast<std::int64_t>(n * 5 % 8));
      carrier_hz.push_back(16e9 + 25e6 * static_cast<double>(hop_code.back()));
      pulse_time_s.push_back(kPri * static_cast<double>(n));
      const double delay_s = 2 * (range_m + velocity_mps * pulse_time_s.back()) / kSpeedOfLight;
      for (const double t : time_s) {
        const double u = t - delay_s;
        const bool is_on = std::abs(u) < kWidth / 2;
        echo.push_back(
            is_on ? std::polar(amplitude_m, kPi * kBandwidth / kWidth * u * u - 2 * kPi * carrier_hz.back() * delay_s)
                  : 0);
      }
    }
  }

  void write(const std::filesystem::path& file) const {
    std::map<std::string, NpzArray> arrays{
        {"echo", array("echo", "<c16", {kPulses, kSamples}, echo)},
        {"time_s", array("time_s", "<f8", {time_s.size()}, time_s)},
        {"pulse_time_s", array("pulse_time_s", "<f8", {pulse_time_s.size()}, pulse_time_s)},
        {"carrier_hz", array("carrier_hz", "<f8", {carrier_hz.size()}, carrier_hz)},
        {"hop_code", array("hop_code", "<i8", {hop_code.size()}, hop_code)}};
    for (const auto& [name, other] : replaced) arrays[name] = other;
    for (const std::string& name : left_out) arrays.erase(name);
    std::vector<NpzArray> list;
    for (const auto& [name, one] : arrays) list.push_back(one);
    std::vector<NpzText> texts;
    if (!scenario.empty()) texts.push_back({"scenario.yaml", scenario});
    if (!description.empty()) texts.push_back({"description.json", description});
    write_npz(file, list, texts);
  }
};

class EchoFiles : public testing::Test {
 protected:
  std::string refusal(const std::function<void(Measured&)>& change) {
    Measured measured(20, 1, 2);
    change(measured);
    measured.write(file_);
    try {
      read_echo_file(file_);
    } catch (const InputError& error) {
      std::string text = error.what();
      EXPECT_TRUE(text.starts_with(file_.string())) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      return text;
    }
    return "accepted";
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "echo.npz";
};

// Bounds: the ideal chirp has 1.16 % RMS of aliasing in band (radar/echo/README.md).
TEST_F(EchoFiles, OfADelayedChirpHaveItsPoint) {
  Measured(31.5, -1.2, 2).write(file_);
  const EchoFile read = read_echo_file(file_);
  EXPECT_TRUE(read.is_measured);
  EXPECT_TRUE(read.given.empty());
  const GeneratedSample made = sample_of_echo(read.echo, read.train, read.scenario, {}, read.record);
  ASSERT_FALSE(made.centres.empty());
  EXPECT_NEAR(made.centres.front().amplitude_m, 2, 0.03 * 2);
  EXPECT_NEAR(made.centres.front().range_m, 31.5, 0.03 * 0.75);
  EXPECT_NEAR(made.centres.front().velocity_mps, -1.2, 0.03 * read.train.velocity_resolution_mps());
  EXPECT_TRUE(std::isnan(made.stored.record.scr_peak_cell_db));
}

TEST_F(EchoFiles, HaveTheColumnsOfTheirDescription) {
  Measured measured(10, 0, 1);
  measured.description =
      R"({"columns": {"azimuth_deg": 30, "label": 1, "target_name": "ferry", "scr_peak_cell_db": null}})";
  measured.write(file_);
  const EchoFile read = read_echo_file(file_);
  EXPECT_THAT(read.given, testing::ElementsAre("azimuth_deg", "label", "target_name"));
  EXPECT_EQ(read.record.azimuth_deg, 30);
  EXPECT_EQ(read.record.label, 1);
  EXPECT_EQ(read.record.target_name, "ferry");
  const auto with = [&](const std::string& text) { return refusal([&](Measured& echo) { echo.description = text; }); };
  EXPECT_THAT(with(R"({"columns": {"azimut_deg": 30}})"), HasSubstr("did you mean 'azimuth_deg'?"));
  EXPECT_THAT(with(R"({"columns": {"label": 0.5}})"), HasSubstr("label: 0.5: of another type"));
  EXPECT_THAT(with(R"({"columns": {"layout": 3}})"), HasSubstr("layout: 3: of another type"));
  EXPECT_THAT(with(R"({"columns": {"depth_m": 1e400}})"), HasSubstr("description.json: "));
  EXPECT_THAT(with("{\"columns\": "), HasSubstr("no valid JSON"));
  EXPECT_THAT(with("{}" + std::string(4 << 20, ' ')), HasSubstr("no archive with a description.json inside"));
  EXPECT_THAT(with(std::string(100, '[') + std::string(100, ']')), HasSubstr("nested more than 64 levels"));
}

TEST_F(EchoFiles, ThatLackSomethingAreRefused) {
  for (const char* name : {"time_s", "pulse_time_s", "carrier_hz", "hop_code"})
    EXPECT_THAT(refusal([&](Measured& echo) { echo.left_out = {name}; }),
                HasSubstr(std::string("array ") + name + ": is missing"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.left_out = {"echo"}; }), HasSubstr("no array target"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.scenario.clear(); }), HasSubstr("no scenario.yaml inside"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.scenario += "radr: {}\n"; }), HasSubstr("scenario.yaml:5:1: radr"));
  EXPECT_THAT(refusal([](Measured& echo) {
                echo.replaced["target"] = array("target", "<c16", {kPulses, kSamples}, echo.echo);
              }),
              HasSubstr("array echo beside target"));
  EXPECT_THAT(refusal([](Measured& echo) {
                echo.left_out = {"echo"};
                echo.replaced["target"] = array("target", "<c16", {kPulses, kSamples}, echo.echo);
              }),
              HasSubstr("array frequency_hz: is missing"));
}

TEST_F(EchoFiles, OfAnotherTypeOrShapeAreRefused) {
  EXPECT_THAT(refusal([](Measured& echo) {
                echo.replaced["echo"] =
                    array("echo", "<f8", {kPulses, 2 * kSamples}, std::vector<double>(2 * kPulses * kSamples));
              }),
              HasSubstr("array echo: shape (64, 3828), must be (64, 1914)"));
  EXPECT_THAT(
      refusal([](Measured& echo) {
        echo.replaced["echo"] = array("echo", "<f8", {kPulses, kSamples}, std::vector<double>(kPulses * kSamples));
      }),
      HasSubstr("array echo: type <f8: must be <c8 or <c16"));
  EXPECT_THAT(refusal([](Measured& echo) {
                echo.replaced["echo"] = array("echo", "<c16", {kSamples, kPulses}, echo.echo);
              }),
              HasSubstr("array echo: shape (1914, 64)"));
  EXPECT_THAT(refusal([](Measured& echo) {
                echo.replaced["carrier_hz"] = array("carrier_hz", "|S8", {kPulses}, echo.carrier_hz);
              }),
              HasSubstr("array carrier_hz: type |S8"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.pulse_time_s.pop_back(); }),
              HasSubstr("array pulse_time_s: 63 pulses, by radar.pulses 64"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.pulse_time_s.clear(); }), HasSubstr("0 pulses"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.hop_code.pop_back(); }), HasSubstr("array hop_code: shape (63,)"));
}

TEST_F(EchoFiles, ThatContradictTheirScenarioAreRefused) {
  EXPECT_THAT(refusal([](Measured& echo) { echo.carrier_hz[5] += 1e6; }),
              HasSubstr("array carrier_hz: [5] is 16026000000, by hop_code, radar.carrier_ghz and radar.hop_step_mhz "
                        "16025000000"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.hop_code[9] = 8; }),
              HasSubstr("array hop_code: [9] is 8, must be 0 to 7"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.hop_code[9] = -1; }), HasSubstr("array hop_code: [9] is -1"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.pulse_time_s[3] += 1e-6; }), HasSubstr("array pulse_time_s: [3]"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.time_s[0] -= 1e-8; }), HasSubstr("array time_s: [0]"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.time_s.resize(1850); }),
              HasSubstr("1850 samples of each pulse, must be an odd multiple of 66, as 1914 are"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.time_s.resize(66); }), HasSubstr("shorter than radar.pulse_width_us"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.time_s.clear(); }), HasSubstr("shorter than radar.pulse_width_us"));
  const auto with_frequencies = [&](const std::vector<double>& frequency_hz) {
    return refusal([&](Measured& echo) {
      echo.replaced["frequency_hz"] = array("frequency_hz", "<f8", {frequency_hz.size()}, frequency_hz);
    });
  };
  EXPECT_THAT(with_frequencies({0, -1e6}), HasSubstr("2 frequencies in steps of -1e+06 Hz"));
  EXPECT_THAT(with_frequencies({-5e5, 5e5}), HasSubstr("2 frequencies in steps of 1e+06 Hz"));
  EXPECT_THAT(with_frequencies({0, 1e-30}), HasSubstr("2 frequencies in steps of 1e-30 Hz"));
}

TEST_F(EchoFiles, WithValuesThatAreNoEchoAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal([&](Measured& echo) {
                echo.echo[2 * kSamples + 7] = {0, kNan};
              }),
              HasSubstr("array echo: [2][7] is not finite"));
  EXPECT_THAT(refusal([&](Measured& echo) { echo.carrier_hz[1] = kNan; }), HasSubstr("array carrier_hz: [1] is nan"));
  EXPECT_THAT(refusal([&](Measured& echo) { echo.pulse_time_s[1] = kNan; }), HasSubstr("[1] is nan"));
  EXPECT_THAT(refusal([&](Measured& echo) { echo.time_s[1] = kNan; }), HasSubstr("array time_s: [1] is nan"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.echo.assign(kPulses * kSamples, 0); }),
              HasSubstr("samples without a power: 0 m^2"));
  EXPECT_THAT(refusal([](Measured& echo) { echo.echo.assign(kPulses * kSamples, 1e200); }),
              HasSubstr("samples without a power: inf m^2"));
}

}  // namespace
}  // namespace seaglint
