// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_clutter.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "radar/echo/sea_scatterers.h"
#include "radar/echo/speckle.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/numbers/random.h"

namespace seaglint {
namespace {

// Pulses further apart than this many 1/w are independent to 4e-6; larger Doppler spreads have no further effect.
constexpr double kIndependence = 5;

// Scatterers between two nodes, and the integrals of their rates of speckle and velocities from the start.
class Evolution {
 public:
  // rate_of: rate (rad/s) of a width (m/s).
  Evolution(SeaScatterers scatterers, const std::function<double(double)>& rate_of)
      : scatterers_(std::move(scatterers)), rate_of_(rate_of), from_(node(0)), to_(node(1)) {
    phase_.resize(from_.width_mps.size());
    displacement_m_.resize(from_.velocity_mps.size());
  }
  bool has_one_width() const { return phase_.empty(); }
  bool is_steady() const { return scatterers_.is_steady; }
  bool has_velocity() const { return !displacement_m_.empty(); }

  // t ascending from call to call.
  void advance_to(double t) {
    const double h = scatterers_.step_s;
    for (; t > (node_ + 1) * h; ++node_) {
      for (std::size_t k = 0; k < phase_.size(); ++k) phase_[k] += 0.5 * h * (from_.width_mps[k] + to_.width_mps[k]);
      for (std::size_t k = 0; k < displacement_m_.size(); ++k)
        displacement_m_[k] += 0.5 * h * (from_.velocity_mps[k] + to_.velocity_mps[k]);
      from_ = std::exchange(to_, node(node_ + 2));
    }
    since_s_ = t - node_ * h;
  }
  double amplitude(std::size_t k) const { return from_.amplitude[k] + since_s_ * slope(k, &ScattererState::amplitude); }
  double phase(std::size_t k) const { return phase_[k] + integral(k, &ScattererState::width_mps); }
  double displacement_m(std::size_t k) const { return displacement_m_[k] + integral(k, &ScattererState::velocity_mps); }

 private:
  using Quantity = std::vector<double> ScattererState::*;
  ScattererState node(int n) const {
    ScattererState state = scatterers_.at_node(n);
    for (double& width : state.width_mps) width = rate_of_(width);
    return state;
  }
  double slope(std::size_t k, Quantity of) const { return ((to_.*of)[k] - (from_.*of)[k]) / scatterers_.step_s; }
  double integral(std::size_t k, Quantity of) const {
    return since_s_ * ((from_.*of)[k] + 0.5 * since_s_ * slope(k, of));
  }

  SeaScatterers scatterers_;
  std::function<double(double)> rate_of_;
  ScattererState from_, to_;  // at nodes node_ and node_ + 1; rates in place of widths
  int node_ = 0;
  double since_s_ = 0;
  std::vector<double> phase_, displacement_m_;  // at node_
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
  const double platform_mps = platform_doppler_spread_mps(scene);
  double mean_mps = spec.doppler_mean_mps, spread_mps = std::hypot(texture.spread_mps, platform_mps);
  if (spec.doppler != ClutterDoppler::kPrescribed) {
    const VelocityMoments sea = clutter_velocity_moments(spec, scene, wavelength);
    mean_mps += sea.mean_mps;
    if (spec.doppler == ClutterDoppler::kSeaState) spread_mps = std::hypot(spread_mps, sea.spread_mps);
  }

  // Doppler f_D = -2 v / lambda, so a velocity spread s gives the correlation e^{-(4 pi s tau / lambda)^2 / 2}.
  const auto rate_rad_s = [&](double spread) {
    return std::clamp(4 * kPi * spread / wavelength, 1e-6 / duration, kIndependence / train.pri_s);
  };
  Evolution scatterers(sea_scatterers({.spec = spec,
                                       .scene = scene,
                                       .texture = texture,
                                       .per_cell = per_cell,
                                       .count = count,
                                       .window_m = window_m,
                                       .duration_s = duration,
                                       .mean_mps = mean_mps,
                                       .seed = seed,
                                       .index = index}),
                       [&](double width_mps) { return rate_rad_s(std::hypot(width_mps, platform_mps)); });
  const bool has_one_width = scatterers.has_one_width();
  Random random({seed, Stream::kClutter, index});
  Speckle uniform_speckle(count, rate_rad_s(spread_mps), random);
  IndividualSpeckle individual_speckle(has_one_width ? 0 : count, has_one_width ? 0 : random.bits());

  // Scatterer k of K lies at range k W / K of the window W = c/(2 step): at frequency i step its phase -4 pi f R / c is
  // -2 pi i k / K, and a forward transform sums all of them. The phase of the first frequency is absorbed by the
  // speckle. On a grid m times finer the transform is m times longer, and (m - 1)/2 steps precede the first coarse
  // frequency.
  const int length = count * train.grid_refinement;
  std::vector<Complex> first(count);
  for (int k = 0; k < count; ++k)
    first[k] = (scatterers.is_steady() ? scatterers.amplitude(k) : 1) *
               std::polar(1.0, kPi * signed_index(k, count) * (train.grid_refinement - 1) / length);
  FourierBatch transform(length, 1, Fourier::kForward);
  std::vector<Complex> values(count), response;
  std::vector<double> phases(has_one_width ? 0 : count);
  response.reserve(train.pulses() * train.frequencies());
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    const double t = train.time_s[n];
    scatterers.advance_to(t);
    if (has_one_width) {
      uniform_speckle.at(t, values.data());
    } else {
      for (int k = 0; k < count; ++k) phases[k] = scatterers.phase(k);
      individual_speckle.at(phases, values.data());
    }
    if (!scatterers.is_steady())
      for (int k = 0; k < count; ++k) values[k] *= scatterers.amplitude(k);
    for (int k = 0; k < count; ++k) values[k] *= first[k];
    // Phase of the displacement on the waves, at the carrier of the pulse.
    if (scatterers.has_velocity()) {
      for (int k = 0; k < count; ++k)
        values[k] *= std::polar(1.0, -4 * kPi * train.carrier_hz[n] * scatterers.displacement_m(k) / kSpeedOfLight);
    }
    Complex* row = transform.row(0);
    std::fill(row, row + length, Complex{});
    for (int k = 0; k < count; ++k) row[(signed_index(k, count) + length) % length] = values[k];
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
