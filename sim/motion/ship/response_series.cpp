// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/response_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

ShipWave ship_wave(const WaveComponent& component) {
  return {component.omega, component.wavenumber, std::atan2(component.direction.y(), component.direction.x())};
}

constexpr ResponseChannel kAngles[] = {ResponseChannel::kRoll, ResponseChannel::kPitch, ResponseChannel::kYaw};
constexpr ResponseChannel kTranslations[] = {ResponseChannel::kSurge, ResponseChannel::kSway, ResponseChannel::kHeave};

constexpr std::size_t index_of(ResponseChannel channel) { return static_cast<std::size_t>(channel); }

}  // namespace

double encounter_frequency(const ShipWave& wave, double speed) {
  return wave.omega - speed * wave.wavenumber * std::cos(wave.mu);
}

ResponseSynthesis::ResponseSynthesis(const WaveField& sea,
                                     const std::function<ResponseChannels(const ShipWave&)>& response, double speed,
                                     double x, double y, double start, double step)
    : phasors_(make(sea, response, speed, x, y, start, step)) {}

UniformPhasors ResponseSynthesis::make(const WaveField& sea,
                                       const std::function<ResponseChannels(const ShipWave&)>& response, double speed,
                                       double x, double y, double start, double step) {
  std::vector<ResponseChannels> responses;
  std::array<double, kResponseChannels> largest{};
  for (const WaveComponent& component : sea.components()) {
    ResponseChannels& all = responses.emplace_back(response(ship_wave(component)));
    for (std::size_t d = 0; d < kResponseChannels; ++d) {
      all[d] *= component.amplitude;
      // A NaN would pass the comparisons below.
      SEAGLINT_CHECK(std::isfinite(all[d].real()) && std::isfinite(all[d].imag()),
                     fmt::format("channel {} at {} rad/s: {} + {}j", d, component.omega, all[d].real(), all[d].imag()));
      largest[d] = std::max(largest[d], std::abs(all[d]));
    }
  }
  constexpr double kNegligible = 1e-9;
  std::vector<double> phase;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    bool counts = false;
    for (std::size_t d = 0; d < kResponseChannels; ++d) {
      counts |= std::abs(responses[i][d]) > kNegligible * largest[d];
    }
    if (!counts) continue;
    const WaveComponent& component = sea.components()[i];
    omega_.push_back(encounter_frequency(ship_wave(component), speed));
    phase.push_back(component.phase - component.wavenumber * component.direction.dot(Vec2(x, y)));
    for (std::size_t d = 0; d < kResponseChannels; ++d) {
      parts_[d].real.push_back(responses[i][d].real());
      parts_[d].imaginary.push_back(responses[i][d].imag());
    }
  }
  for (std::size_t d = 0; d < kResponseChannels; ++d) moves_[d] = largest[d] > 0;
  return UniformPhasors(omega_, phase, start, step);
}

double ResponseSynthesis::value(ResponseChannel channel) const {
  const Parts& a = parts_[index_of(channel)];
  const double* c = phasors_.cosine().data();
  const double* s = phasors_.sine().data();
  double sum = 0;
  for (std::size_t i = 0; i < a.real.size(); ++i) sum += a.real[i] * c[i] - a.imaginary[i] * s[i];
  return sum;
}

// Re{j w x}.
double ResponseSynthesis::rate(ResponseChannel channel) const {
  const Parts& a = parts_[index_of(channel)];
  const double* c = phasors_.cosine().data();
  const double* s = phasors_.sine().data();
  double sum = 0;
  for (std::size_t i = 0; i < a.real.size(); ++i) sum -= omega_[i] * (a.imaginary[i] * c[i] + a.real[i] * s[i]);
  return sum;
}

MotionSample ResponseSynthesis::sample() const {
  MotionSample sample;
  for (int axis = 0; axis < 3; ++axis) {
    const ResponseChannel angle = kAngles[axis], translation = kTranslations[axis];
    if (moves_[index_of(angle)]) sample.angles[axis] = value(angle);
    if (moves_[index_of(angle)]) sample.angle_rates[axis] = rate(angle);
    if (moves_[index_of(translation)]) sample.translation[axis] = value(translation);
    if (moves_[index_of(translation)]) sample.translation_rates[axis] = rate(translation);
  }
  return sample;
}

}  // namespace seaglint
