// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/ship.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/motion/ship/response_series.h"
#include "sim/motion/ship/ship_response.h"

namespace seaglint {

namespace {

// Responses to one wave, and the forcing for which the roll oscillator has the roll response of the coupled hull.
ResponseChannels channels(const ShipParticulars& ship, const ShipWave& wave, bool translations) {
  const MotionRao rao = ship_rao(ship, wave);
  const double factor = translations ? 1 : 0;
  const Complex forcing = rao.roll / linear_response(ship.roll, encounter_frequency(wave, ship.speed));
  return {rao.roll, rao.pitch, rao.yaw, factor * rao.surge, factor * rao.sway, factor * rao.heave, forcing};
}

// Roll with quadratic damping, from the linear steady state spin_up_s before t = 0.
std::vector<OscillatorState> nonlinear_roll(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                            double x, double y, long samples) {
  const double step = spec.step_s;
  const auto before = static_cast<long>(std::ceil(spec.spin_up_s / step));
  // Steps are subdivided for short natural periods.
  const auto parts = std::max(1L, static_cast<long>(std::ceil(ship.roll.omega0 * step / kLongestTurn)));
  const double part = step / static_cast<double>(parts);
  const auto response = [&](const ShipWave& wave) { return channels(ship, wave, false); };
  ResponseSynthesis series(sea, response, ship.speed, x, y, -step * static_cast<double>(before), 0.5 * part);
  OscillatorState state{series.value(ResponseChannel::kRoll), series.rate(ResponseChannel::kRoll)};
  std::vector<OscillatorState> roll;
  double begin = series.value(ResponseChannel::kExtra);
  for (long n = -before; n < samples; ++n) {
    if (n >= 0) roll.push_back(state);
    for (long p = 0; p < parts; ++p) {
      series.advance();
      const double middle = series.value(ResponseChannel::kExtra);
      series.advance();
      const double end = series.value(ResponseChannel::kExtra);
      state = advance(ship.roll, state, begin, middle, end, part);
      begin = end;
    }
  }
  return roll;
}

}  // namespace

std::vector<MotionSample> simulate_ship(const ShipParticulars& ship, const MotionSpec& spec, const WaveField& sea,
                                        double x, double y, double duration_s) {
  const long count = std::max(1L, static_cast<long>(std::ceil(duration_s / spec.step_s))) + 1;
  const auto response = [&](const ShipWave& wave) { return channels(ship, wave, spec.translations); };
  ResponseSynthesis series(sea, response, ship.speed, x, y, 0, spec.step_s);
  std::vector<MotionSample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (long n = 0; n < count; ++n, series.advance()) samples.push_back(series.sample());
  if (ship.roll.quadratic > 0) {
    const std::vector<OscillatorState> roll = nonlinear_roll(ship, spec, sea, x, y, count);
    for (std::size_t n = 0; n < samples.size(); ++n) {
      samples[n].angles.x() = roll[n].x;
      samples[n].angle_rates.x() = roll[n].rate;
    }
  }
  return samples;
}

}  // namespace seaglint
