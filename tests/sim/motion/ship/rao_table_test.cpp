// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/responses.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/motion/ship/rao_files.h"
#include "sim/motion/ship/ship.h"
#include "sim/motion/target_motion.h"
#include "sim/sea/realisation.h"
#include "sim/sea/spectrum.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

const char* const kVeres = SEAGLINT_SOURCE_DIR "/tests/reference/ship_motion/s175_veres.re1";
const char* const kWamit = SEAGLINT_SOURCE_DIR "/tests/reference/ship_motion/fpso.4";

double wavenumber(double omega) { return omega * omega / kGravity; }

// Long waves determine every sign: surge and sway -j along the waves, heave 1, roll -jk sin mu, pitch +jk cos mu, yaw
// in antiphase.
void expect_long_wave_limits(const RaoTable& table, double omega, double roll_factor) {
  const double k = wavenumber(omega);
  for (const double mu_deg : {0.0, 30.0, 60.0, 120.0, 150.0, 180.0, -30.0, -60.0, -120.0, -150.0}) {
    const double mu = radians(mu_deg);
    const MotionRao r = table.at(omega, k, mu);
    EXPECT_NEAR(std::abs(r.surge + kJ * std::cos(mu)), 0, 0.05) << mu_deg;
    EXPECT_NEAR(std::abs(r.sway + kJ * std::sin(mu)), 0, 0.05) << mu_deg;
    EXPECT_NEAR(std::abs(r.heave - 1.0), 0, 0.05) << mu_deg;
    EXPECT_NEAR(std::abs(r.roll / k + roll_factor * kJ * std::sin(mu)), 0, 0.05) << mu_deg;
    EXPECT_NEAR(std::abs(r.pitch / k - kJ * std::cos(mu)), 0, 0.05) << mu_deg;
    EXPECT_LE((r.yaw / k).real() * std::sin(mu) * std::cos(mu), 1e-6) << mu_deg;
    EXPECT_NEAR(std::abs(r.yaw / k), std::abs(std::sin(mu) * std::cos(mu)), 0.15) << mu_deg;
  }
}

// VERES' own roll tends to 1.20 of the slope, with w^2/w0^2 = 0.12 at its lowest frequency.
TEST(VeresTable, TendsToTheSlopeOfLongWaves) { expect_long_wave_limits(read_veres_rao(kVeres, 0), 0.1047198, 1.36); }

TEST(WamitTable, TendsToTheSlopeOfLongWaves) {
  const RaoTable table = read_wamit_rao(kWamit, {});
  expect_long_wave_limits(table, table.omegas().front(), 1.0);
  EXPECT_EQ(table.headings().size(), 12u);  // 7, and 5 of them mirrored
}

// The file's own numbers: heading 30 is towards 180 + 30 deg, where surge, sway, roll and pitch have the other sign.
TEST(VeresTable, ContainsTheFilesNumbers) {
  const RaoTable table = read_veres_rao(kVeres, 0);
  EXPECT_NEAR(table.reference().x(), -2.54748, 1e-9);
  EXPECT_NEAR(table.reference().z(), 0.05, 1e-9);
  const MotionRao r = table.at(0.5026549, wavenumber(0.5026549), radians(180));
  const double phase = -wavenumber(0.5026549) * -1 * table.reference().x();
  std::ifstream file(kVeres);
  std::string line;
  bool found = false;
  while (!found && std::getline(file, line)) found = line.find("0.5026549") != std::string::npos;
  ASSERT_TRUE(found);
  for (int d = 1; d <= 6; ++d) {
    int number;
    double re, im;
    file >> number >> re >> im;
    const Complex value = Complex(re, im) * std::polar(1.0, phase);
    const Complex ours = d == 1 ? -r.surge : d == 3 ? r.heave : d == 5 ? -r.pitch : value;
    EXPECT_NEAR(std::abs(ours - value), 0, 1e-12) << d;
  }
}

TEST(RaoTable, IsInterpolatedAndMirrored) {
  const RaoTable table = read_veres_rao(kVeres, 0);
  const double w = 0.75, k = wavenumber(w);
  const MotionRao port = table.at(w, k, radians(65));
  const MotionRao starboard = table.at(w, k, radians(-65));
  EXPECT_NEAR(std::abs(port.roll + starboard.roll), 0, 1e-12);
  EXPECT_NEAR(std::abs(port.pitch - starboard.pitch), 0, 1e-12);
  EXPECT_NEAR(std::abs(port.yaw + starboard.yaw), 0, 1e-12);
  EXPECT_NEAR(std::abs(table.at(w, k, radians(65 + 360)).roll - port.roll), 0, 1e-12);
  const double between = std::abs(port.pitch);
  EXPECT_GT(between,
            0.9 * std::min(std::abs(table.at(w, k, radians(60)).pitch), std::abs(table.at(w, k, radians(70)).pitch)));
  EXPECT_LT(between,
            std::max(std::abs(table.at(w, k, radians(60)).pitch), std::abs(table.at(w, k, radians(70)).pitch)));
  EXPECT_EQ(table.at(5, wavenumber(5), 1).heave, Complex(0));
}

// A heading of the table needs no neighbour, whichever side of it rounding falls.
TEST(RaoTable, ContainsItsHeadingsToTheirRounding) {
  std::vector<MotionRao> responses(3);
  for (std::size_t m = 0; m < 3; ++m) responses[m].heave = static_cast<double>(m + 1);
  const RaoTable table("test", {radians(-55), radians(55), kPi}, {1}, responses, Vec3::Zero(), 0);
  for (const double rounding : {-1e-15, 0.0, 1e-15}) {
    EXPECT_NEAR(std::abs(table.at(1, 0.1, radians(-55) + rounding).heave - 1.0), 0, 1e-12) << rounding;
    EXPECT_NEAR(std::abs(table.at(1, 0.1, radians(55) + rounding).heave - 2.0), 0, 1e-12) << rounding;
    EXPECT_NEAR(std::abs(table.at(1, 0.1, kPi + rounding).heave - 3.0), 0, 1e-12) << rounding;
  }
  EXPECT_THROW(table.at(1, 0.1, radians(55) + 1e-6), InputError);
  EXPECT_THROW(table.at(1, 0.1, radians(55) - 1e-6), InputError);
}

MotionSpec rao_spec(const char* file) {
  MotionSpec spec;
  spec.model = MotionModel::kRao;
  spec.file = file;
  spec.step_s = 0.1;
  return spec;
}

// The complete chain: file, body, series in an irregular sea; its RMS is the root of int |H|^2 S.
TEST(SimulateRao, HasTheVarianceOfSpectrumAndTable) {
  SeaState state;
  state.significant_wave_height_m = 2;
  state.peak_period_s = 9;
  state.propagation_rad = radians(60);
  state.cutoff_rad_s = 3;
  state.second_order_cutoff_rad_s = 0;
  const Body body = make_body(rao_spec(kVeres), {});
  const WaveField sea = realise_sea(state, 42, 0);
  const double duration = 20000;
  const Trajectory trajectory = simulate_motion(body, Vec3::Zero(), sea, duration, 1, 0);
  Vec3 variance = Vec3::Zero();
  const int count = 200000;
  for (int n = 0; n < count; ++n) {
    const Vec3 angles = trajectory.sample(n * 0.1).angles;
    variance += angles.cwiseProduct(angles) / count;
  }

  const RaoTable& table = std::get<RaoTable>(body.model);
  const JonswapSpectrum spectrum(2, 9, 3.3);
  Vec3 expected = Vec3::Zero();
  for (std::size_t i = 1; i < table.omegas().size(); ++i) {
    const auto moduli = [&](std::size_t n) {
      const MotionRao r = table.at(table.omegas()[n], wavenumber(table.omegas()[n]), state.propagation_rad);
      return Vec3(std::abs(r.roll), std::abs(r.pitch), std::abs(r.yaw));
    };
    const Vec3 a = moduli(i - 1), b = moduli(i);
    const double width = table.omegas()[i] - table.omegas()[i - 1];
    for (int n = 0; n < 100; ++n) {
      const double u = (n + 0.5) / 100;
      const Vec3 h = (1 - u) * a + u * b;
      expected += h.cwiseProduct(h) * spectrum.density(table.omegas()[i - 1] + u * width) * width / 100;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double ratio = std::sqrt(variance[axis] / expected[axis]);
    std::printf("axis %d: rms %.4f deg, ratio %.4f\n", axis, degrees(std::sqrt(variance[axis])), ratio);
    EXPECT_NEAR(ratio, 1, 0.01) << axis;
  }
}

TEST(SimulateRao, RefusesASeaThatTheTableDoesNotCover) {
  SeaState state;
  state.significant_wave_height_m = 0.1;
  state.peak_period_s = 1.5;
  state.cutoff_rad_s = 0;
  state.second_order_cutoff_rad_s = 0;
  const Body body = make_body(rao_spec(kVeres), {});
  const std::string message =
      refusal_of([&] { simulate_motion(body, Vec3::Zero(), realise_sea(state, 1, 0), 10, 1, 0); });
  EXPECT_HAS(message, "s175_veres.re1: covers 0.1047 to 3.142 rad/s");
  EXPECT_HAS(message, "% of the waves' variance lies");
}

TEST(ReadRao, RefusesInvalidTables) {
  const std::filesystem::path file = std::filesystem::path(SEAGLINT_BINARY_DIR) / "wrong.re1";
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  write("time,roll\n");
  EXPECT_HAS(refusal_of([&] { read_veres_rao(file, 0); }), "no motion transfer functions");
  std::ifstream source(kVeres);
  std::string text((std::istreambuf_iterator<char>(source)), {});
  write(text.substr(0, 3000));
  EXPECT_HAS(refusal_of([&] { read_veres_rao(file, 0); }), "wrong.re1:");
  const std::size_t number = text.find("0.20961041E-07");
  write(text.substr(0, number) + "NaN" + text.substr(number + 14));
  EXPECT_HAS(refusal_of([&] { read_veres_rao(file, 0); }), "must be a finite number");
  EXPECT_HAS(refusal_of([&] { read_veres_rao(kVeres, 5); }), "it contains 0, 10.29 m/s");
  write("1 0 1 2 90 1 1\n");
  EXPECT_HAS(refusal_of([&] { read_wamit_rao(file, {}); }), "wrong.re1:1:7: MOD: value '2': must be the modulus");
  write("1 0 7 1 90 0 1\n");
  EXPECT_HAS(refusal_of([&] { read_wamit_rao(file, {}); }), "wrong.re1:1:5: I: value '7': must be a mode, 1 to 6");
  write("1 0 1 1 90 0 1\n");
  EXPECT_HAS(refusal_of([&] { read_wamit_rao(file, {}); }), "mode 2 is missing");
  MotionSpec spec = rao_spec("nowhere.re1");
  EXPECT_HAS(refusal_of([&] { make_body(spec, {}); }), "no such file");
}

class RaoFile : public testing::Test {
 protected:
  static std::string text_of(const char* file) {
    std::ifstream source(file);
    return std::string((std::istreambuf_iterator<char>(source)), {});
  }
  std::filesystem::path put(const std::string& text) const {
    std::ofstream(folder_.path() / "a.rao", std::ios::binary) << text;
    return folder_.path() / "a.rao";
  }
  std::string wamit_refusal(const std::string& text) const {
    return refusal_of([&] { read_wamit_rao(put(text), {}); });
  }
  std::string veres_refusal(const std::string& text) const {
    return refusal_of([&] { read_veres_rao(put(text), 0); });
  }
  // The rows of one heading once more, under another name of the same direction.
  static std::string with_heading_again(const std::string& heading, const std::string& again, const char* factor = "") {
    std::string text = text_of(kWamit), added;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string period, beta, mode, modulus, phase, re, im;
      words >> period >> beta >> mode >> modulus >> phase >> re >> im;
      if (std::stod(beta) != std::stod(heading)) continue;
      const bool changed = factor[0] != 0 && mode == "3";
      added += fmt::format("{} {} {} {} {} {} {}\n", period, again, mode, changed ? "2" : modulus,
                           changed ? "0" : phase, changed ? "2" : re, changed ? "0" : im);
    }
    return text + added;
  }
  static void expect_same(const RaoTable& a, const RaoTable& b) {
    ASSERT_EQ(a.headings().size(), b.headings().size());
    ASSERT_EQ(a.omegas(), b.omegas());
    for (const double omega : a.omegas()) {
      for (const double mu : a.headings()) {
        const double k = wavenumber(omega);
        EXPECT_EQ(a.at(omega, k, mu).heave, b.at(omega, k, mu).heave) << omega << " " << mu;
        EXPECT_EQ(a.at(omega, k, mu).roll, b.at(omega, k, mu).roll) << omega << " " << mu;
      }
    }
  }
  TemporaryFolder folder_;
};

TEST_F(RaoFile, OfWamitMayHaveBothEndsOfTheCircleAndALineOfNames) {
  const RaoTable plain = read_wamit_rao(kWamit, {});
  const std::string text = text_of(kWamit);
  for (const std::string& same : {with_heading_again("0", "360"), with_heading_again("180", "-180"),
                                  "     PER      BETA   I  Mod(XI)   Pha(XI)   Re(XI)   Im(XI)\n" + text,
                                  "\xef\xbb\xbf" + text, "WAMIT output of an FPSO\n\n" + text})
    expect_same(plain, read_wamit_rao(put(same), {}));
  EXPECT_HAS(wamit_refusal(with_heading_again("0", "360", "2")),
             "headings 0 and 360 deg are one direction, where the former has");
  EXPECT_HAS(wamit_refusal(with_heading_again("30", "30.0")), "mode 1: duplicate");
  EXPECT_HAS(wamit_refusal("KL BETA I MOD PHA RE IM\n" + text),
             "a.rao:1:1: column 'KL': the first column must be the period or the frequency");
  EXPECT_HAS(wamit_refusal("1 0 1 1 1.5708 0 1\n"), "a.rao:1:9: PHA: value '1.5708': must be in degrees");
  EXPECT_HAS(wamit_refusal("1 0 1.5 1 90 0 1\n"), "value '1.5': must be a mode");
  EXPECT_HAS(wamit_refusal(text + "1 0 1 1\n"), "4 cells where the names are 7");
}

// The same table as a program with headings of where waves come from, or with e^{-iwt}, would write it.
TEST_F(RaoFile, OfWamitMayHaveTheConventionsOfOtherPrograms) {
  const auto rewritten = [](bool from, bool minus) {
    std::string text;
    std::istringstream lines(text_of(kWamit));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string period, mode, modulus, re;
      double beta = 0, phase = 0, im = 0;
      words >> period >> beta >> mode >> modulus >> phase >> re >> im;
      text += fmt::format("{} {} {} {} {} {} {}\n", period, from ? beta + 180 : beta, mode, modulus,
                          minus ? -phase : phase, re, minus ? -im : im);
    }
    return text;
  };
  const RaoTable plain = read_wamit_rao(kWamit, {});
  constexpr auto kFrom = HeadingConvention::kFrom;
  constexpr auto kMinus = TimeFactor::kMinus;
  expect_same(plain, read_wamit_rao(put(rewritten(true, false)), {.wamit_heading = kFrom}));
  expect_same(plain, read_wamit_rao(put(rewritten(false, true)), {.wamit_time_factor = kMinus}));
  expect_same(plain, read_wamit_rao(put(rewritten(true, true)), {.wamit_heading = kFrom, .wamit_time_factor = kMinus}));
  // Pitch follows the slope of long waves; either convention alone turns its sign.
  for (const std::string& text : {rewritten(true, false), rewritten(false, true)}) {
    EXPECT_HAS(wamit_refusal(text),
               "pitch in waves of 163.9 s has the opposite sign of the waves' slope: "
               "motion.wamit_heading (now towards) or motion.wamit_time_factor (now plus) is not "
               "the file's");
  }
  EXPECT_HAS(refusal_of([&] { read_wamit_rao(kWamit, {.wamit_heading = kFrom}); }), "(now from)");
  EXPECT_EQ(long_waves_of(plain), LongWaves::kAgree);
  EXPECT_EQ(long_waves_of(read_veres_rao(kVeres, 0)), LongWaves::kAgree);
}

TEST_F(RaoFile, SaysByWhichConventionsItWasRead) {
  MotionSpec spec = rao_spec(kWamit);
  EXPECT_HAS(motion_file_reading(make_body(spec, {})),
             "(WAMIT: the direction of propagation), 29 frequencies 0.03834 to 5.712 rad/s, speed 0 "
             "m/s, time factor e^{+iwt}; its longest waves, 163.9 s, confirm heave, pitch, roll");
  spec.file = kVeres;
  EXPECT_HAS(motion_file_reading(make_body(spec, {})), "(VERES: its heading + 180), 36 frequencies");
  spec.wamit_time_factor = TimeFactor::kMinus;
  EXPECT_HAS(refusal_of([&] { make_body(spec, {}); }), "motion.wamit_time_factor: not allowed here: ");
  spec.wamit_time_factor = TimeFactor::kPlus;
  spec.wamit_heading = HeadingConvention::kFrom;
  EXPECT_HAS(refusal_of([&] { make_body(spec, {}); }), "motion.wamit_heading: not allowed here: ");
}

TEST_F(RaoFile, OfVeresIsRefusedForWhatWasOverwrittenOrDropped) {
  const std::string text = text_of(kVeres);
  expect_same(read_veres_rao(kVeres, 0), read_veres_rao(put("\xef\xbb\xbf" + text + "\n \n"), 0));
  EXPECT_HAS(veres_refusal(text + "  17.0\n"), ": '17.0' behind the last block");
  // One speed, one heading, one frequency.
  const auto table = [](const std::string& counts, const std::string& rows) {
    return "MOTION TRANSFER FUNCTIONS VERES\n\n\n\n\n\n1025 9.81\n100 10 5\n0 0\n" + counts + "\n0 0 0 0 0\n" + rows;
  };
  const std::string six = "1 0 0\n2 0 0\n3 1 0\n4 0 0\n5 0 0\n6 0 0\n",
                    other = "1 0 0\n2 0 0\n3 2 0\n4 0 0\n5 0 0\n6 0 0\n";
  EXPECT_EQ(veres_refusal(table("1 1 1 6", "0\n0.5\n" + six)), "accepted");
  EXPECT_EQ(veres_refusal(table("1 2 1 6", "0\n0.5\n" + six + "360\n0.5\n" + six)), "accepted");
  EXPECT_HAS(veres_refusal(table("1 2 1 6", "0\n0.5\n" + six + "360\n0.5\n" + other)),
             "headings 0 and 360 deg are one direction with different responses");
  EXPECT_HAS(veres_refusal(table("1 2 1 6", "90\n0.5\n" + six + "90\n0.5\n" + six)),
             "a.rao:20:1: heading 90 deg appears twice");
  EXPECT_HAS(veres_refusal(table("1 1 1 6", "0\n0\n" + six)), "a.rao:13:1: frequency 0 rad/s: must be greater than 0");
  EXPECT_HAS(veres_refusal(table("1 1 1 6", "0\n-1\n" + six)), "frequency -1 rad/s");
  EXPECT_HAS(veres_refusal(table("1 1 1.5 6", "0\n1\n" + six)), "count 1.5: must be a whole number");
  EXPECT_HAS(veres_refusal(table("1 1 1 6", "0\n1x\n" + six)),
             "a.rao:13:1: frequency: value '1x': must be a finite number");
}

// How a program writes the responses of a free body with a natural roll period of 9 s, in waves of 45 to 5 s.
struct WrittenTable {
  Complex translations = 1, rotations = 1;           // factors
  bool per_slope = false, omega = false;             // rotations over k a; first column
  std::array<double, 2> origin{0, 0};                // of the body from that of the waves' phase
  double heave = 1, longest_s = 45, shortest_s = 5;  // heave relative to that of a free body
  int first_mode = 1;

  std::string text() const {
    std::string rows;
    for (double period = longest_s; period >= shortest_s; period *= 0.92) {
      const double w = 2 * kPi / period, k = w * w / kGravity, ratio = w * 9 / (2 * kPi);
      for (const double beta_deg : {0.0, 45.0, 90.0, 135.0, 180.0}) {
        const double c = std::cos(radians(beta_deg)), s = std::sin(radians(beta_deg)), far = 1 / (1 + 400 * k * k);
        const Complex phase = std::polar(1.0, -k * (c * origin[0] + s * origin[1]));
        const double slope = per_slope ? 1 : k;
        const Complex modes[] = {-kJ * c,
                                 -kJ * s,
                                 heave * far,
                                 -kJ * slope * s / (1 - ratio * ratio + 0.16 * kJ * ratio),
                                 kJ * slope * c * far,
                                 -slope * s * c * far};
        for (int m = 0; m < 6; ++m) {
          const Complex value = phase * modes[m] * (m < 3 ? translations : rotations);
          rows += fmt::format("{:.9e} {:.6e} {} {:.9e} {:.6e} {:.9e} {:.9e}\n", omega ? w : period, beta_deg,
                              m + first_mode, std::abs(value), degrees(std::arg(value)), value.real(), value.imag());
        }
      }
    }
    return rows;
  }
};

class LongWaveUnits : public RaoFile {
 protected:
  std::string refusal(const WrittenTable& table, const MotionSpec& spec = {}, double side_m = 0) const {
    return refusal_of([&] { read_wamit_rao(put(table.text()), spec, Vec3::Zero(), side_m); });
  }
  // The table as it is read, against the one in metres and radians.
  void expect_mended(const WrittenTable& table, const MotionSpec& spec) const {
    const RaoTable read = read_wamit_rao(put(table.text()), spec);
    const RaoTable plain = read_wamit_rao(put(WrittenTable{}.text()), {});
    ASSERT_EQ(read.omegas().size(), plain.omegas().size());
    for (std::size_t n = 0; n < read.omegas().size(); ++n) {
      for (const double mu : {0.0, radians(45), radians(-90), kPi}) {
        const double w = plain.omegas()[n], k = wavenumber(w);
        const MotionRao a = read.at(read.omegas()[n], k, mu), b = plain.at(w, k, mu);
        EXPECT_LT(std::abs(a.heave - b.heave), 1e-6) << w << " " << mu;
        EXPECT_LT(std::abs(a.sway - b.sway), 1e-6) << w << " " << mu;
        EXPECT_LT(std::abs(a.roll - b.roll), 1e-6) << w << " " << mu;
        EXPECT_LT(std::abs(a.pitch - b.pitch), 1e-6) << w << " " << mu;
        EXPECT_LT(std::abs(a.yaw - b.yaw), 1e-6) << w << " " << mu;
      }
    }
  }
};

TEST_F(LongWaveUnits, OfAFreeBodyAreConfirmed) {
  const LongWaveLimits limits = long_wave_limits(read_wamit_rao(put(WrittenTable{}.text()), {}));
  EXPECT_NEAR(limits.period_s, 45, 1e-6);
  ASSERT_TRUE(limits.heave && limits.pitch && limits.roll);
  EXPECT_LT(std::abs(*limits.heave - 1.0), 0.01);
  EXPECT_LT(std::abs(*limits.pitch - 1.0), 0.01);
  EXPECT_LT(std::abs(*limits.roll - 1.0), 0.03);
}

// Each wrong unit is recognised by its factor and mended by the key of the message.
TEST_F(LongWaveUnits, ThatAreWrongAreRefusedWithTheirKey) {
  const WrittenTable ulen{.rotations = 25};
  EXPECT_HAS(refusal(ulen),
             "a.rao: pitch in waves of 45 s is 25 times their slope, where a body "
             "follows it: motion.wamit_ulen_m (now 1) is not the file's: 25 makes");
  expect_mended(ulen, {.wamit_ulen_m = 25});
  // ULEN given for a table that is in metres.
  EXPECT_HAS(refusal({}, {.wamit_ulen_m = 25}), "motion.wamit_ulen_m (now 25) is not the file's: 1 ");

  const WrittenTable in_degrees{.rotations = degrees(1)};
  EXPECT_HAS(refusal(in_degrees), "motion.rao_rotations: degrees");
  expect_mended(in_degrees, {.rao_rotations = RaoRotations::kDegrees});

  const WrittenTable per_slope{.per_slope = true};
  EXPECT_HAS(refusal(per_slope), "motion.rao_rotations: slope;");
  expect_mended(per_slope, {.rao_rotations = RaoRotations::kSlope});
  const WrittenTable degrees_per_slope{.rotations = degrees(1), .per_slope = true};
  EXPECT_HAS(refusal(degrees_per_slope), "motion.rao_rotations: slope_degrees");
  expect_mended(degrees_per_slope, {.rao_rotations = RaoRotations::kSlopeDegrees});

  const WrittenTable per_height{.translations = 0.5, .rotations = 0.5};
  EXPECT_HAS(refusal(per_height),
             "heave in waves of 45 s is 0.5 at 0 deg, where a body follows them "
             "(1 at 0 deg): responses over the height of the waves? "
             "motion.rao_scale: 2");
  expect_mended(per_height, {.rao_scale = 2});

  constexpr double kRhoG = 1025 * 9.81;
  const WrittenTable hams{.translations = kJ / kRhoG, .rotations = kJ / kRhoG};
  EXPECT_HAS(refusal(hams),
             "at 90 deg, where a body follows them (1 at 0 deg): responses over rho g, "
             "as HAMS writes them? motion.rao_scale: rho g of the run (10055 in sea water), motion.rao_phase_deg: -90");
  expect_mended(hams, {.rao_scale = kRhoG, .rao_phase_deg = -90});

  const WrittenTable other{.translations = 3, .rotations = 3};
  EXPECT_HAS(refusal(other), "motion.rao_scale (now 1) and motion.rao_phase_deg (now 0) are not");
}

// A body on tension legs does not heave; it is accepted when the scenario says so.
TEST_F(LongWaveUnits, OfARestrainedBodyAreAcceptedByItsKey) {
  const WrittenTable restrained{.heave = 0.01};
  EXPECT_HAS(refusal(restrained), "motion.rao_follows_long_waves: false accepts a restrained body");
  EXPECT_EQ(refusal(restrained, {.rao_follows_long_waves = false}), "accepted");
}

// Waves that are short for the body confirm nothing; a body that moves in none of them is refused if they are longer
// than twice its side.
TEST_F(LongWaveUnits, CannotBeConfirmedByShortWaves) {
  EXPECT_EQ(refusal({.longest_s = 8}), "accepted");
  const WrittenTable small{.translations = 1e-4, .rotations = 1e-4, .longest_s = 8};
  EXPECT_HAS(refusal(small), "heave is at most");
  EXPECT_HAS(refusal(small, {}, 40), "such a body does not move");
  EXPECT_EQ(refusal(small, {}, 60), "accepted");
}

// Near its natural roll period, and in water of 50 m where waves are shorter, a free body's rotations exceed the slope
// of deep water: no unit is wrong.
TEST_F(LongWaveUnits, AreNotDoubtedNearResonanceOrInShallowWater) {
  EXPECT_EQ(refusal({.longest_s = 14}), "accepted");
  std::string text;
  for (const double period : {45.0, 38.0, 32.0, 27.0, 23.0, 20.0}) {
    const double w = 2 * kPi / period;
    double k = w * w / kGravity;
    for (int i = 0; i < 200; ++i) k = 0.5 * (k + w * w / (kGravity * std::tanh(k * 50)));
    for (const double beta_deg : {0.0, 45.0, 90.0, 135.0, 180.0}) {
      const double c = std::cos(radians(beta_deg)), s = std::sin(radians(beta_deg));
      const Complex modes[] = {-kJ * c, -kJ * s, 1, -kJ * k * s, kJ * k * c, -k * s * c};
      for (int m = 0; m < 6; ++m)
        text += fmt::format("{} {} {} {:.9e} {:.6e} {:.9e} {:.9e}\n", period, beta_deg, m + 1, std::abs(modes[m]),
                            degrees(std::arg(modes[m])), modes[m].real(), modes[m].imag());
    }
  }
  EXPECT_EQ(wamit_refusal(text), "accepted");
}

// Body 2 of a run of two, whose phases are those of the waves at the origin of the run.
TEST_F(LongWaveUnits, OfABodyOfARunOfSeveral) {
  const WrittenTable second{.origin = {30, -40}, .first_mode = 7};
  const std::string text = WrittenTable{.rotations = 0.9}.text() + second.text();
  EXPECT_HAS(wamit_refusal(text),
             "I: value '7': must be a mode, 1 to 6; motion.wamit_body chooses a "
             "body of a run of several, body 2 with modes 7 to 12");
  const RaoTable read = read_wamit_rao(put(text), {.wamit_body = 2, .wamit_xbody_m = {30, -40, 0}});
  const RaoTable plain = read_wamit_rao(put(WrittenTable{}.text()), {});
  for (const double w : plain.omegas()) {
    for (const double mu : {0.0, radians(45), radians(90)}) {
      const double k = wavenumber(w);
      EXPECT_LT(std::abs(read.at(w, k, mu).heave - plain.at(w, k, mu).heave), 1e-6) << w << " " << mu;
      EXPECT_LT(std::abs(read.at(w, k, mu).roll - plain.at(w, k, mu).roll), 1e-6) << w << " " << mu;
    }
  }
  const double w = plain.omegas().front(), k = wavenumber(w);
  EXPECT_NEAR(std::abs(read_wamit_rao(put(text), {.wamit_body = 1}).at(w, k, 0).pitch / plain.at(w, k, 0).pitch), 0.9,
              1e-6);
  EXPECT_HAS(refusal_of([&] { read_wamit_rao(put(text), {.wamit_body = 3}); }),
             "no modes 13 to 18 of motion.wamit_body 3: its modes are those of 2 bodies");
}

// Heave that is neither that of a free body nor clearly wrong is stated.
TEST_F(LongWaveUnits, AreStatedWhereHeaveIsNotThatOfAFreeBody) {
  MotionSpec spec = rao_spec("");
  const std::filesystem::path file = put(WrittenTable{.translations = 0.87, .rotations = 0.87}.text());
  std::filesystem::rename(file, file.string() + ".4");
  spec.file = file.string() + ".4";
  EXPECT_HAS(motion_file_reading(make_body(spec, {})),
             "heave in its longest waves, 45 s, is 0.87 where a free body has 1");
}

TEST_F(LongWaveUnits, OfATableOverFrequencies) {
  const WrittenTable over_omega{.omega = true};
  expect_mended(over_omega, {.wamit_first_column = WamitFirstColumn::kOmega});
  const RaoTable named = read_wamit_rao(put("OMEGA BETA I MOD PHA RE IM\n" + over_omega.text()), {});
  EXPECT_NEAR(named.omegas().front(), 2 * kPi / 45, 1e-8);
  EXPECT_HAS(refusal(over_omega),
             "heave tends to 1 in its shortest waves: motion.wamit_first_column "
             "(now period) is not the file's");
  EXPECT_HAS(refusal({}, {.wamit_first_column = WamitFirstColumn::kOmega}),
             "motion.wamit_first_column (now omega) is not the file's");
}

}  // namespace
}  // namespace seaglint
