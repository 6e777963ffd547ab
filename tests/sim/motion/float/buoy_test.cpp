// SPDX-License-Identifier: BSD-3-Clause
// Floats against two buoys measured in the ocean (tests/reference/ship_motion/doe_buoy/SOURCE.md): three numbers fitted
// to half of a record of 30 minutes, the other half computed with them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/text/text_table.h"
#include "sim/motion/target_motion.h"
#include "tests/measured.h"

namespace seaglint {
namespace {

const std::string kBuoys = SEAGLINT_SOURCE_DIR "/tests/reference/ship_motion/doe_buoy/";

// Lines of the measured spectra are multiples of 1/204.8 Hz; 2048 samples of 0.1 s are one period of all of them.
constexpr std::size_t kSamples = 2048;
constexpr double kStep = 0.1, kPeriod = kStep * kSamples;

struct SpectrumLine {
  std::size_t number;  // multiple of 1/kPeriod
  double slope, tilt;  // measured variance, rad^2
};

std::vector<SpectrumLine> measured_spectrum(const std::string& buoy, const std::string& part) {
  const TextTable table(TextSource::read(kBuoys + "spectra.csv"),
                        {"buoy", "part", "frequency_hz", "slope_rad2_per_hz", "tilt_rad2_per_hz"});
  std::vector<SpectrumLine> lines;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, 0) != buoy || table.text(row, 1) != part) continue;
    lines.push_back({static_cast<std::size_t>(std::lround(table.number(row, 2) * kPeriod)),
                     table.number(row, 3) / kPeriod, table.number(row, 4) / kPeriod});
  }
  return lines;
}

struct Band {
  double low_hz, high_hz, measured, standard_error;  // tilt over slope
};

// From 0.07 to 0.45 Hz: below, z06 tilts by what is not waves (a slope of 0.26 deg); above, by the buoys' own waves.
std::vector<Band> bands_of(const std::string& buoy, const std::string& part) {
  const TextTable table(TextSource::read(kBuoys + "bands.csv"),
                        {"buoy", "part", "low_hz", "high_hz", "tilt_per_slope", "standard_error"});
  std::vector<Band> bands;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Band band{table.number(row, 2), table.number(row, 3), table.number(row, 4), table.number(row, 5)};
    if (table.text(row, 0) == buoy && table.text(row, 1) == part && band.low_hz >= 0.07 && band.high_hz <= 0.45)
      bands.push_back(band);
  }
  return bands;
}

// What is fitted. Both hulls are 6 m by 3 m: the disc of that waterplane; a draught of 0.5 m displaces some 5 t. The
// ratio of their natural periods of roll and pitch is that of the first half of z05.
struct FloatFit {
  double roll_period_s = 2.5, damping = 0.2, effective_slope = 0.9;
};
constexpr double kHullLength = 6, kHullBeam = 3, kHullDraught = 0.5, kRollOverPitchPeriod = 4.0 / 3;

// The measured slope spectrum as long-crested linear waves at 45 deg to both axes of tilt; quadratic phases, which
// focus them nowhere.
WaveField sea_of(const std::vector<SpectrumLine>& lines) {
  constexpr double kGoldenAngle = 2.399963229728653;
  std::vector<WaveComponent> components;
  for (const SpectrumLine& line : lines) {
    const double omega = 2 * kPi * static_cast<double>(line.number) / kPeriod, k = omega * omega / kGravity;
    components.push_back({omega,
                          std::sqrt(2 * line.slope) / k,
                          kGoldenAngle * static_cast<double>(line.number * line.number),
                          k,
                          {std::sqrt(0.5), std::sqrt(0.5)}});
  }
  return WaveField(components, 1, 0);
}

// Tilt over slope in each band, of a trajectory over one period of the sea.
std::vector<double> computed_ratios(const FloatFit& fit, const std::vector<SpectrumLine>& lines,
                                    const std::vector<Band>& bands) {
  MotionSpec spec;
  spec.model = MotionModel::kFloat;
  spec.diameter_m = std::sqrt(kHullLength * kHullBeam);
  spec.draught_m = kHullDraught;
  spec.roll_period_s = fit.roll_period_s;
  spec.pitch_period_s = fit.roll_period_s / kRollOverPitchPeriod;
  spec.effective_slope = fit.effective_slope;
  spec.roll_damping = spec.pitch_damping = fit.damping;
  spec.step_s = kStep;
  spec.spin_up_s = 60;
  const Trajectory trajectory =
      simulate_motion(make_body(spec, {}), rest_position(spec, 0, 0), sea_of(lines), kPeriod, 1, 0);
  std::vector<Vec3> angles;
  std::vector<Complex> turn;  // e^{-2 pi j n / kSamples}
  for (std::size_t n = 0; n < kSamples; ++n) {
    angles.push_back(trajectory.sample(kStep * static_cast<double>(n)).angles);
    turn.push_back(std::polar(1.0, -2 * kPi * static_cast<double>(n) / kSamples));
  }
  std::vector<double> ratios;
  for (const Band& band : bands) {
    double tilt = 0, slope = 0;
    for (const SpectrumLine& line : lines) {
      const double frequency = static_cast<double>(line.number) / kPeriod;
      if (frequency < band.low_hz || frequency >= band.high_hz) continue;
      Complex roll = 0, pitch = 0;
      for (std::size_t n = 0; n < kSamples; ++n) {
        const Complex& phasor = turn[n * line.number % kSamples];
        roll += angles[n].x() * phasor;
        pitch += angles[n].y() * phasor;
      }
      tilt += 2 * (std::norm(roll) + std::norm(pitch)) / (double(kSamples) * double(kSamples));
      slope += line.slope;
    }
    ratios.push_back(std::sqrt(tilt / slope));
  }
  return ratios;
}

// Least squares of the logarithms of the ratios over the bands, by Levenberg's and Marquardt's method in the logarithms
// of the three numbers.
FloatFit fit_to(const std::vector<SpectrumLine>& lines, const std::vector<Band>& bands) {
  const auto numbers = [](const Vec3& x) { return FloatFit{std::exp(x.x()), std::exp(x.y()), std::exp(x.z())}; };
  const auto residuals = [&](const Vec3& x) {
    std::vector<double> result = computed_ratios(numbers(x), lines, bands);
    for (std::size_t i = 0; i < bands.size(); ++i) result[i] = std::log(result[i] / bands[i].measured);
    return result;
  };
  const auto cost = [](const std::vector<double>& r) {
    double sum = 0;
    for (const double value : r) sum += value * value;
    return sum;
  };
  const FloatFit start;
  Vec3 x(std::log(start.roll_period_s), std::log(start.damping), std::log(start.effective_slope));
  std::vector<double> now = residuals(x);
  double damping = 0.01;
  for (int iteration = 0; iteration < 20; ++iteration) {
    constexpr double kDifference = 1e-3;
    Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(bands.size()), 3);
    Eigen::VectorXd value(static_cast<Eigen::Index>(bands.size()));
    for (int p = 0; p < 3; ++p) {
      Vec3 moved = x;
      moved[p] += kDifference;
      const std::vector<double> there = residuals(moved);
      for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
        const auto n = static_cast<std::size_t>(i);
        jacobian(i, p) = (there[n] - now[n]) / kDifference;
        value(i) = now[n];
      }
    }
    const Eigen::Matrix3d normal = jacobian.transpose() * jacobian;
    const Eigen::Matrix3d damped = normal + damping * Eigen::Matrix3d(normal.diagonal().asDiagonal());
    const Eigen::Vector3d step = damped.partialPivLu().solve(-jacobian.transpose() * value);
    const Vec3 next = x + Vec3(step.x(), step.y(), step.z());
    const std::vector<double> there = residuals(next);
    if (cost(there) < cost(now)) {
      const bool settled = cost(now) - cost(there) < 1e-5;
      x = next;
      now = there;
      damping *= 0.3;
      if (settled) break;
    } else {
      damping *= 10;
    }
  }
  return numbers(x);
}

// An oscillator in place of a hull, one direction of the waves for many.
constexpr double kModel = 0.15;
// The error of a ratio of the half record that is computed, and of the one that was fitted.
constexpr double kStandardErrors = 2;

// Largest |computed / measured - 1| over the bands, in percent.
double compare(const std::string& buoy, const std::string& part, const FloatFit& fit) {
  const std::vector<Band> bands = bands_of(buoy, part);
  const std::vector<double> computed = computed_ratios(fit, measured_spectrum(buoy, part), bands);
  double worst = 0;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const Band& band = bands[i];
    std::printf("buoy,%s,%s,%.2f,%.2f,%.3f,%.3f,%.3f\n", buoy.c_str(), part.c_str(), band.low_hz, band.high_hz,
                band.measured, band.standard_error, computed[i]);
    EXPECT_NEAR(computed[i], band.measured, kModel * band.measured + kStandardErrors * band.standard_error)
        << buoy << ", " << part << " part, " << band.low_hz << " Hz";
    worst = std::max(worst, 100 * std::abs(computed[i] / band.measured - 1));
  }
  return worst;
}

FloatFit fit_to_first_half(const std::string& buoy) {
  const FloatFit fit = fit_to(measured_spectrum(buoy, "first"), bands_of(buoy, "first"));
  std::printf("buoy,buoy,part,low_hz,high_hz,measured,standard_error,computed\n");
  std::printf("fit,%s,%.2f,%.3f,%.2f\n", buoy.c_str(), fit.roll_period_s, fit.damping, fit.effective_slope);
  EXPECT_GT(fit.roll_period_s, 2);  // s, of a hull of 6 m by 3 m
  EXPECT_LT(fit.roll_period_s, 4);
  EXPECT_GT(fit.effective_slope, 0.7);
  EXPECT_LE(fit.effective_slope, 1);
  return fit;
}

TEST(OceanBuoys, Z05TiltsByThreeNumbersOfTheOtherHalf) {
  const FloatFit fit = fit_to_first_half("z05");
  compare("z05", "first", fit);
  const double second = compare("z05", "second", fit);
  EXPECT_LT(second, 100 * kModel);
  record_figure(second, 0, "buoy_z05_percent");
}

TEST(OceanBuoys, Z06TiltsByThreeNumbersOfTheOtherHalf) {
  const FloatFit fit = fit_to_first_half("z06");
  compare("z06", "first", fit);
  const double second = compare("z06", "second", fit);
  record_figure(second, 0, "buoy_z06_percent");
  // The whole record, whose standard errors are below 6 %: within the model's own error.
  const double whole = compare("z06", "whole", fit);
  EXPECT_LT(whole, 100 * kModel);
  record_figure(whole, 0, "buoy_z06_whole_percent");
}

}  // namespace
}  // namespace seaglint
