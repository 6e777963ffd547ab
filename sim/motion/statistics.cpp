// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"

namespace seaglint {
namespace {

// The three angles in a window from `begin`, mean removed.
std::array<std::vector<double>, 3> window_of(const std::vector<MotionSample>& samples, std::size_t begin,
                                             std::size_t length) {
  std::array<std::vector<double>, 3> angles;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& values = angles[static_cast<std::size_t>(axis)];
    for (std::size_t n = 0; n < length; ++n) values.push_back(samples[begin + n].angles[axis]);
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(length);
    for (double& value : values) value -= mean;
  }
  return angles;
}

}  // namespace

std::vector<MotionSample> uniform_samples(const Trajectory& trajectory, double duration_s) {
  std::vector<MotionSample> samples;
  const double end = std::min(duration_s, trajectory.end_s());
  for (int n = 0; n * kStatisticsStep_s <= end + 1e-9; ++n)
    samples.push_back(trajectory.sample(std::min(n * kStatisticsStep_s, end)));
  return samples;
}

std::array<AngleStatistics, 3> angle_statistics(const Trajectory& trajectory, double duration_s) {
  const std::vector<MotionSample> samples = uniform_samples(trajectory, duration_s);
  const double count = static_cast<double>(samples.size());
  std::array<AngleStatistics, 3> statistics;
  for (int axis = 0; axis < 3; ++axis) {
    AngleStatistics& angle = statistics[static_cast<std::size_t>(axis)];
    for (const MotionSample& s : samples) {
      angle.mean += s.angles[axis] / count;
      angle.largest = std::max(angle.largest, std::abs(s.angles[axis]));
    }
    // m0 is the variance about the mean and m2 that of the rate.
    double m0 = 0, m2 = 0;
    for (const MotionSample& s : samples) {
      m0 += (s.angles[axis] - angle.mean) * (s.angles[axis] - angle.mean) / count;
      m2 += s.angle_rates[axis] * s.angle_rates[axis] / count;
    }
    angle.rms = std::sqrt(m0);
    if (m2 > 0) angle.mean_period_s = 2 * kPi * std::sqrt(m0 / m2);
  }
  return statistics;
}

std::array<double, 6> motion_rms(const Trajectory& trajectory, double duration_s) {
  constexpr double kAtRest = 1e-9;
  const std::vector<MotionSample> samples = uniform_samples(trajectory, duration_s);
  const double count = static_cast<double>(samples.size());
  std::array<double, 6> rms{};
  for (int i = 0; i < 6; ++i) {
    const auto value = [i](const MotionSample& s) { return i < 3 ? s.angles[i] : s.translation[i - 3]; };
    const double first = value(samples.front());
    double sum = 0, squares = 0, largest = 0;
    for (const MotionSample& s : samples) {
      const double change = value(s) - first;
      sum += change;
      squares += change * change;
      largest = std::max(largest, std::abs(change));
    }
    const double mean = sum / count;
    if (largest > kAtRest) rms[static_cast<std::size_t>(i)] = std::sqrt(std::max(0.0, squares / count - mean * mean));
  }
  return rms;
}

AngleSpectra angle_spectra(const Trajectory& trajectory, double duration_s) {
  constexpr double kWindow_s = 120, kHighest = 8;
  constexpr std::size_t kPadding = 2;
  const std::vector<MotionSample> samples = uniform_samples(trajectory, duration_s);
  const std::size_t length = std::min(samples.size(), static_cast<std::size_t>(kWindow_s / kStatisticsStep_s));
  const std::size_t hop = std::max<std::size_t>(1, length / 2);
  const double step = kPi / (static_cast<double>(length) * kStatisticsStep_s);
  AngleSpectra spectra;
  for (int n = 1; n * step <= kHighest; ++n) spectra.omega.push_back(n * step);
  for (std::vector<double>& density : spectra.density) density.assign(spectra.omega.size(), 0.0);
  double windows = 0;
  for (std::size_t begin = 0; begin + length <= samples.size(); begin += hop, windows += 1) {
    const auto powers =
        periodograms(window_of(samples, begin, length), kStatisticsStep_s, spectra.omega.size(), kPadding);
    for (std::size_t axis = 0; axis < powers.size(); ++axis) {
      for (std::size_t n = 0; n < powers[axis].size(); ++n) spectra.density[axis][n] += powers[axis][n];
    }
  }
  for (std::vector<double>& density : spectra.density) {
    for (double& value : density) value /= windows;
  }
  return spectra;
}

}  // namespace seaglint
