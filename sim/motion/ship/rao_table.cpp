// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/ship/rao_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr double kWidestGap = radians(45);

MotionRao mixed(const MotionRao& a, double weight_a, const MotionRao& b, double weight_b) {
  const auto mix = [&](Complex p, Complex q) { return weight_a * p + weight_b * q; };
  return {mix(a.surge, b.surge), mix(a.sway, b.sway),   mix(a.heave, b.heave),
          mix(a.roll, b.roll),   mix(a.pitch, b.pitch), mix(a.yaw, b.yaw)};
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
  const MotionRao interpolated = mixed(along(left), 1 - v, along(right), v);
  const Complex phase = std::polar(1.0, -wavenumber * (std::cos(mu) * reference_.x() + std::sin(mu) * reference_.y()));
  return {phase * interpolated.surge, phase * interpolated.sway,  phase * interpolated.heave,
          phase * interpolated.roll,  phase * interpolated.pitch, phase * interpolated.yaw};
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
  ResponseSynthesis series(sea, response, table.speed(), x, y, 0, spec.step_s);
  const long count = std::max(1L, static_cast<long>(std::ceil(duration_s / spec.step_s))) + 1;
  std::vector<MotionSample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (long n = 0; n < count; ++n, series.advance()) samples.push_back(series.sample());
  return samples;
}

}  // namespace seaglint
