// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_clutter.h"

#include <algorithm>
#include <cmath>

#include "radar/echo/sea_scatterers.h"
#include "radar/echo/speckle.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

// Pulses further apart than this many 1/w are independent to 4e-6; larger Doppler spreads have no further effect.
constexpr double kIndependence = 5;

// Scatterers per synthetic range resolution c/(2 B_s): with two the speckle of a resolution cell is Gaussian and their
// phases remain independent; with texture: waves at least one per metre.
int scatterers_per_cell(const ClutterSpec& spec, double range_cell_m) {
  return texture_is_by_waves(spec) ? std::max(2, static_cast<int>(std::ceil(range_cell_m))) : 2;
}

// A quantity of all scatterers, [node][scatterer], linear between nodes, and its integral from the first node.
class OverTime {
 public:
  OverTime(std::vector<double> values, std::size_t count, double step_s)
      : values_(std::move(values)), integral_(values_.size()), count_(count), step_s_(step_s) {
    for (std::size_t i = count; i < values_.size(); ++i)
      integral_[i] = integral_[i - count] + 0.5 * step_s * (values_[i - count] + values_[i]);
  }
  bool empty() const { return values_.empty(); }

  void at(double t, std::vector<double>& values) const {
    const auto [first, since_s] = segment(t);
    for (std::size_t k = 0; k < count_; ++k) values[k] = values_[first + k] + since_s * slope(first + k);
  }
  void integral_at(double t, std::vector<double>& values) const {
    const auto [first, since_s] = segment(t);
    for (std::size_t k = 0; k < count_; ++k)
      values[k] = integral_[first + k] + since_s * (values_[first + k] + 0.5 * since_s * slope(first + k));
  }

 private:
  struct Segment {
    std::size_t first;
    double since_s;
  };
  Segment segment(double t) const {
    const std::size_t node = std::min(static_cast<std::size_t>(t / step_s_), values_.size() / count_ - 2);
    return {node * count_, t - static_cast<double>(node) * step_s_};
  }
  double slope(std::size_t i) const { return (values_[i + count_] - values_[i]) / step_s_; }

  std::vector<double> values_, integral_;
  std::size_t count_;
  double step_s_;
};

}  // namespace

std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, const ClutterScene& scene,
                                      std::uint64_t seed, std::uint64_t index) {
  const double window_m = train.unambiguous_range_m() / train.grid_refinement,
               range_cell_m = train.range_resolution_m();
  const int per_cell = scatterers_per_cell(spec, range_cell_m),
            count = per_cell * train.band_bins() / train.grid_refinement;
  const TextureParameters texture = texture_parameters(spec, scene, train.band_centre_hz(), range_cell_m);

  // Contribution of the waves to the prescribed velocity.
  const double wavelength = kSpeedOfLight / train.band_centre_hz();
  const double duration = std::max(train.time_s.back(), train.pri_s);
  double mean_mps = spec.doppler_mean_mps, spread_mps = texture.spread_mps;
  const double across_mps = platform_doppler_spread_mps(scene);
  spread_mps = std::hypot(spread_mps, across_mps);
  if (spec.doppler != ClutterDoppler::kPrescribed) {
    const VelocityMoments sea = clutter_velocity_moments(spec, scene, wavelength);
    mean_mps += sea.mean_mps;
    if (spec.doppler == ClutterDoppler::kSeaState) spread_mps = std::hypot(spread_mps, sea.spread_mps);
  }
  SeaScatterers scatterers = sea_scatterers({.spec = spec,
                                             .scene = scene,
                                             .texture = texture,
                                             .per_cell = per_cell,
                                             .count = count,
                                             .window_m = window_m,
                                             .duration_s = duration,
                                             .mean_mps = mean_mps,
                                             .seed = seed,
                                             .index = index});

  // Doppler f_D = -2 v / lambda, so a velocity spread s gives the correlation e^{-(4 pi s tau / lambda)^2 / 2}.
  const auto rate_rad_s = [&](double spread) {
    return std::clamp(4 * kPi * spread / wavelength, 1e-6 / duration, kIndependence / train.pri_s);
  };
  for (double& width : scatterers.width_mps) width = rate_rad_s(std::hypot(width, across_mps));
  const bool has_one_width = scatterers.width_mps.empty();
  Random random({seed, Stream::kClutter, index});
  Speckle speckle_of_one(count, rate_rad_s(spread_mps), random);
  SpeckleOfPhases speckle_of_all(has_one_width ? 0 : count, has_one_width ? 0 : random.bits());
  const OverTime rates(std::move(scatterers.width_mps), count, scatterers.step_s),
      velocities(std::move(scatterers.velocity_mps), count, scatterers.step_s);

  // Scatterer k of K lies at range k W / K of the window W = c/(2 step): at frequency i step its phase -4 pi f R / c is
  // -2 pi i k / K, and a forward transform sums all of them. The phase of the first frequency is absorbed by the
  // speckle. On a grid m times finer the transform is m times longer, and (m - 1)/2 steps precede the first coarse
  // frequency.
  const int length = count * train.grid_refinement;
  std::vector<Complex> first(count);
  for (int k = 0; k < count; ++k)
    first[k] = (has_one_width ? scatterers.amplitude[k] : 1) *
               std::polar(1.0, kPi * place_of(k, count) * (train.grid_refinement - 1) / length);
  const OverTime amplitudes(has_one_width ? std::vector<double>{} : std::move(scatterers.amplitude), count,
                            scatterers.step_s);
  FourierBatch transform(length, 1, Fourier::kForward);
  std::vector<Complex> values(count);
  std::vector<double> of_scatterers(count);
  std::vector<Complex> response;
  response.reserve(train.pulses() * train.frequencies());
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    const double t = train.time_s[n];
    if (has_one_width) {
      speckle_of_one.at(t, values.data());
    } else {
      rates.integral_at(t, of_scatterers);
      speckle_of_all.at(of_scatterers, values.data());
      amplitudes.at(t, of_scatterers);
      for (int k = 0; k < count; ++k) values[k] *= of_scatterers[k];
    }
    for (int k = 0; k < count; ++k) values[k] *= first[k];
    // Phase of the displacement on the waves, at the carrier of the pulse.
    if (!velocities.empty()) {
      velocities.integral_at(t, of_scatterers);
      for (int k = 0; k < count; ++k)
        values[k] *= std::polar(1.0, -4 * kPi * train.carrier_hz[n] * of_scatterers[k] / kSpeedOfLight);
    }
    Complex* row = transform.row(0);
    std::fill(row, row + length, Complex{});
    for (int k = 0; k < count; ++k) row[(place_of(k, count) + length) % length] = values[k];
    transform.execute();
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const double sweep_s = train.intra_pulse_motion ? train.baseband_hz[b] / train.chirp_rate_hz_s : 0;
      const double range_m = mean_mps * (t + sweep_s);
      const double frequency = train.carrier_hz[n] + train.baseband_hz[b];
      response.push_back(row[train.code[n] * train.bins_per_hop + b] *
                         std::polar(1.0, -4 * kPi * frequency * range_m / kSpeedOfLight));
    }
  }
  return response;
}

}  // namespace seaglint
