// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/responses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
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

MotionRao operator+(const MotionRao& a, const MotionRao& b) {
  return {a.surge + b.surge, a.sway + b.sway, a.heave + b.heave, a.roll + b.roll, a.pitch + b.pitch, a.yaw + b.yaw};
}

MotionRao scaled(const MotionRao& rao, Complex translations, Complex rotations) {
  return {translations * rao.surge, translations * rao.sway, translations * rao.heave,
          rotations * rao.roll,     rotations * rao.pitch,   rotations * rao.yaw};
}

double encounter_frequency(const ShipWave& wave, double speed) {
  return wave.omega - speed * wave.wavenumber * std::cos(wave.mu);
}

ResponseSynthesis::ResponseSynthesis(const WaveField& sea,
                                     const std::function<ResponseChannels(const ShipWave&)>& response, double speed,
                                     double x, double y, double start, double step)
    : step_(step), phasors_(make(sea, response, speed, x, y, start, step)) {}

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

std::vector<MotionSample> ResponseSynthesis::samples(double duration_s) {
  const long count = std::max(1L, static_cast<long>(std::ceil(duration_s / step_))) + 1;
  std::vector<MotionSample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (long n = 0; n < count; ++n, advance()) samples.push_back(sample());
  return samples;
}

namespace {

constexpr double kWidestGap = radians(45);

MotionRao mixed(const MotionRao& a, double weight_a, const MotionRao& b, double weight_b) {
  return scaled(a, weight_a, weight_a) + scaled(b, weight_b, weight_b);
}

// Angle wrapped into (-pi, pi].
double wrapped(double angle) { return angle - 2 * kPi * std::ceil(angle / (2 * kPi) - 0.5); }

}  // namespace

RaoTable::RaoTable(std::string source, std::vector<double> mu, std::vector<double> omega,
                   std::vector<MotionRao> responses, Vec3 reference, double speed)
    : source_(std::move(source)),
      mu_(std::move(mu)),
      omega_(std::move(omega)),
      responses_(std::move(responses)),
      reference_(std::move(reference)),
      speed_(speed) {
  SEAGLINT_CHECK(
      !mu_.empty() && !omega_.empty() && responses_.size() == mu_.size() * omega_.size(),
      fmt::format("{} responses, {} headings, {} frequencies", responses_.size(), mu_.size(), omega_.size()));
  SEAGLINT_CHECK(std::is_sorted(mu_.begin(), mu_.end()) && std::is_sorted(omega_.begin(), omega_.end()), source_);
}

// Responses are interpolated with the phase of the wave at the reference point, where it varies slowly with frequency
// and heading; e^{-jk.x} brings them to the origin.
MotionRao RaoTable::at(double omega, double wavenumber, double mu) const {
  if (omega < omega_.front() || omega > omega_.back()) return {};
  const double heading = wrapped(mu);
  const std::size_t count = mu_.size();
  const auto above = static_cast<std::size_t>(std::lower_bound(mu_.begin(), mu_.end(), heading) - mu_.begin());
  const std::size_t left = (above + count - 1) % count;
  const std::size_t right = above % count;
  double gap = mu_[right] - mu_[left];
  double place = heading - mu_[left];
  if (gap <= 0) gap += 2 * kPi;
  if (place < 0) place += 2 * kPi;
  // At a tabulated heading (or the only one), to rounding, no interpolation is needed.
  constexpr double kSameHeading = 1e-9;
  const bool on_right = above < count && std::abs(mu_[above] - heading) < kSameHeading;
  double v = on_right ? 1 : place / gap;
  if (!on_right && gap > kWidestGap) {
    if (place >= kSameHeading && gap - place >= kSameHeading) {
      throw InputError(
          fmt::format("{}: no responses near waves travelling towards {:.4g} deg: its headings leave a gap from {:.4g} "
                      "to {:.4g} deg",
                      source_, degrees(heading), degrees(mu_[left]), degrees(mu_[right])));
    }
    v = std::round(v);
  }
  const auto next = static_cast<std::size_t>(std::lower_bound(omega_.begin(), omega_.end(), omega) - omega_.begin());
  const std::size_t low = next == 0 ? 0 : next - 1;
  const double width = omega_[next] - omega_[low];
  const double u = width > 0 ? (omega - omega_[low]) / width : 1;
  const auto along = [&](std::size_t m) {
    return mixed(responses_[m * omega_.size() + low], 1 - u, responses_[m * omega_.size() + next], u);
  };
  const Complex phase = std::polar(1.0, -wavenumber * (std::cos(mu) * reference_.x() + std::sin(mu) * reference_.y()));
  return scaled(mixed(along(left), 1 - v, along(right), v), phase, phase);
}

double RaoTable::uncovered_variance_fraction(const WaveField& sea) const {
  double all = 0, outside = 0;
  for (const WaveComponent& c : sea.components()) {
    const double variance = 0.5 * c.amplitude * c.amplitude;
    all += variance;
    if (c.omega < omega_.front() || c.omega > omega_.back()) outside += variance;
  }
  return all > 0 ? outside / all : 0;
}

std::vector<MotionSample> simulate_rao(const RaoTable& table, const MotionSpec& spec, const WaveField& sea, double x,
                                       double y, double duration_s) {
  const double uncovered = table.uncovered_variance_fraction(sea);
  if (uncovered > kMaxUncoveredVariance) {
    throw InputError(fmt::format(
        "{}: covers {:.4g} to {:.4g} rad/s, outside of which {:.3g} % of the waves' variance lies: must be "
        "at most {:g} %",
        table.source(), table.omegas().front(), table.omegas().back(), 100 * uncovered, 100 * kMaxUncoveredVariance));
  }
  const double factor = spec.translations ? 1 : 0;
  const auto response = [&](const ShipWave& wave) -> ResponseChannels {
    const MotionRao r = table.at(wave.omega, wave.wavenumber, wave.mu);
    return {r.roll, r.pitch, r.yaw, factor * r.surge, factor * r.sway, factor * r.heave, 0};
  };
  return ResponseSynthesis(sea, response, table.speed(), x, y, 0, spec.step_s).samples(duration_s);
}

}  // namespace seaglint
