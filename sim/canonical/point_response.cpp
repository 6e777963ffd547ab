// SPDX-License-Identifier: BSD-3-Clause
#include "sim/canonical/point_response.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/observation/look_directions.h"
#include "sim/scattering/observation/surface_propagation.h"

namespace seaglint {
namespace {

// The phase factors of a pulse are computed by recurrence and reset after this many, so that rounding stays below
// 1e-13.
constexpr int kRenewal = 32;

Vec3 as_vector(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

// Adds amplitude e^{-j 4 pi f (R + v f_b/mu) / c} over the frequencies of one pulse; f_b is 0 at their middle, and the
// term with the chirp rate mu exists for a chirp only. The phase is quadratic in the frequency index: the factor is
// multiplied by a ratio, the ratio by a constant.
void add_point_to_pulse(Complex* pulse, const IntervalSampling& sampling, int first, double amplitude, double range_m,
                        double velocity_mps) {
  const double slope = sampling.chirp_rate_hz_s == 0 ? 0 : velocity_mps / sampling.chirp_rate_hz_s;  // metres per hertz
  const auto phase = [&](int b) {
    const double frequency = sampling.first_hz + (first + b) * sampling.step_hz;
    const double baseband = (b - 0.5 * (sampling.frequencies_per_pulse - 1)) * sampling.step_hz;
    return -4 * kPi / kSpeedOfLight * frequency * (range_m + slope * baseband);
  };
  const Complex bend = std::polar(1.0, -8 * kPi / kSpeedOfLight * slope * sampling.step_hz * sampling.step_hz);
  for (int start = 0; start < sampling.frequencies_per_pulse; start += kRenewal) {
    const int stop = std::min(start + kRenewal, sampling.frequencies_per_pulse);
    Complex value = std::polar(amplitude, phase(start));
    Complex ratio = std::polar(1.0, phase(start + 1) - phase(start));
    for (int b = start; b < stop; ++b) {
      pulse[b] += value;
      value *= ratio;
      if (slope != 0) ratio *= bend;
    }
  }
}

}  // namespace

FrequencyResponse point_response_over_sea(std::span<const PointSpec> points, const Vec3& r_hat,
                                          const IntervalSampling& sampling, Polarisation polarisation,
                                          const SeaReflection& sea) {
  const auto place = [](const PointSpec& point, double elapsed_s) {
    return as_vector(point.position_m) + elapsed_s * as_vector(point.velocity_mps);
  };
  std::vector<OneWayAmplitudes> over_waves;  // of each point
  if (sea.waves() != nullptr) {
    const double start_s = sampling.pulse_time_s.front();
    for (const PointSpec& point : points)
      over_waves.emplace_back(sea, BodyOverWaves{[&](double time_s) { return place(point, time_s - start_s); }, 0, 0},
                              sampling, r_hat);
  }
  FrequencyResponse response;
  response.pulses = static_cast<int>(sampling.pulse_first.size());
  response.frequencies_per_pulse = sampling.frequencies_per_pulse;
  response.values.assign(static_cast<std::size_t>(response.pulses) * sampling.frequencies_per_pulse, Complex{});
  for (int n = 0; n < response.pulses; ++n) {
    const LineOfSight line_of_sight = line_of_sight_at(sampling, r_hat, sampling.pulse_time_s[n]);
    for (int b = 0; b < response.frequencies_per_pulse; ++b) {
      const double k = 2 * kPi / kSpeedOfLight * (sampling.first_hz + (sampling.pulse_first[n] + b) * sampling.step_hz);
      const double baseband_hz = (b - 0.5 * (sampling.frequencies_per_pulse - 1)) * sampling.step_hz;
      const double elapsed_s = sampling.pulse_time_s[n] - sampling.pulse_time_s.front() +
                               (sampling.chirp_rate_hz_s == 0 ? 0 : baseband_hz / sampling.chirp_rate_hz_s);
      const SeaReflectionCoefficients rho = sea.at(k, line_of_sight.radar.r.z());
      for (std::size_t p = 0; p < points.size(); ++p) {
        const Vec3 x = place(points[p], elapsed_s);
        const OneWayPaths amplitudes = over_waves.empty() ? OneWayPaths{{1, 1}, rho} : over_waves[p].at(n, b);
        for (const PropagationPath& path : kFourPaths) {
          if (!sea.is_enabled(path)) continue;
          response.at(n, b) += points[p].amplitude_m *
                               SeaReflection::path_factor(path, amplitudes, static_cast<int>(polarisation)) *
                               std::polar(1.0, k * line_of_sight.path_advance(path, x));
        }
      }
    }
  }
  return response;
}

FrequencyResponse point_response(std::span<const PointSpec> points, const Vec3& r_hat,
                                 const IntervalSampling& sampling) {
  FrequencyResponse response;
  response.pulses = static_cast<int>(sampling.pulse_first.size());
  response.frequencies_per_pulse = sampling.frequencies_per_pulse;
  response.values.assign(static_cast<std::size_t>(response.pulses) * sampling.frequencies_per_pulse, Complex{});
  // Look direction at each pulse.
  std::vector<Vec3> sight;
  for (const double time_s : sampling.pulse_time_s) sight.push_back(line_of_sight_at(sampling, r_hat, time_s).radar.r);
  for (const PointSpec& point : points) {
    const Vec3 position = as_vector(point.position_m), velocity = as_vector(point.velocity_mps);
    for (int n = 0; n < response.pulses; ++n) {
      const double elapsed_s = sampling.pulse_time_s[n] - sampling.pulse_time_s.front();
      add_point_to_pulse(&response.at(n, 0), sampling, sampling.pulse_first[n], point.amplitude_m,
                         -sight[n].dot(position + elapsed_s * velocity), -sight[n].dot(velocity));
    }
  }
  return response;
}

}  // namespace seaglint
