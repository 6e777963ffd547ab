// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_clutter.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "radar/echo/gamma_texture.h"
#include "radar/waveform/fourier.h"
#include "sim/core/constants.h"
#include "sim/core/random.h"

namespace seaglint {
namespace {

// Scatterers per synthetic range resolution c/(2 B_s): two make speckle of a resolution cell Gaussian and still have
// their own phases.
constexpr int kScatterersPerCell = 2;
// Correlation length of the texture in synthetic range cells (3.75 m for the paper's radar): long against the main
// lobe, so that a map's cell sees one value of texture and its intensity keeps <I^2>/<I>^2 = 2 (1 + 1/shape) to about 2
// %.
constexpr double kTextureCells = 5;
// A Gaussian process with correlation e^{-(w tau)^2/2} is white noise at nodes every kNodeSpacing/w through the kernel
// e^{-(w t)^2}; spacing and reach leave errors of 1e-6 and 5e-6 in the correlation.
constexpr double kNodeSpacing = 0.6;
constexpr double kKernelReach = 3.5;
// Pulses further apart than this many 1/w are independent to 4e-6; faster Doppler spreads change nothing any more.
constexpr double kIndependence = 5;

Complex complex_normal(Random& random) {
  const double re = random.normal();
  return Complex(re, random.normal()) * std::sqrt(0.5);
}

// Speckle of all scatterers over time: independent complex Gaussian processes of power 1 with one Doppler width.
class Speckle {
 public:
  Speckle(int scatterers, double rate_rad_s, Random& random)
      : scatterers_(scatterers), rate_(rate_rad_s), random_(random), first_(-std::ceil(kKernelReach / kNodeSpacing)) {}

  // Values at time_s >= 0, ascending from call to call.
  void at(double time_s, Complex* values) {
    const double x = time_s * rate_;
    const double from = std::ceil((x - kKernelReach) / kNodeSpacing);
    const double to = std::floor((x + kKernelReach) / kNodeSpacing);
    while (!nodes_.empty() && first_ < from) {
      nodes_.pop_front();
      ++first_;
    }
    first_ = std::max(first_, from);
    while (first_ + static_cast<double>(nodes_.size()) <= to) {
      std::vector<Complex> node(scatterers_);
      for (Complex& value : node) value = complex_normal(random_);
      nodes_.push_back(std::move(node));
    }
    std::vector<double> weight;
    double power = 0;
    for (double q = from; q <= to; ++q) {
      weight.push_back(std::exp(-(x - q * kNodeSpacing) * (x - q * kNodeSpacing)));
      power += weight.back() * weight.back();
    }
    std::fill(values, values + scatterers_, Complex{});
    for (std::size_t i = 0; i < weight.size(); ++i) {
      const double w = weight[i] / std::sqrt(power);
      for (int k = 0; k < scatterers_; ++k) values[k] += w * nodes_[i][k];
    }
  }

 private:
  int scatterers_;
  double rate_;
  Random& random_;
  double first_;  // number of the node nodes_.front(), at time first_ kNodeSpacing / rate
  std::deque<std::vector<Complex>> nodes_;
};

}  // namespace

std::vector<double> sea_texture(int cells, double shape, double correlation_cells, Random& random) {
  std::vector<double> white(cells);
  for (double& value : white) value = random.normal();
  // The kernel e^{-d^2/l^2} folded onto the ring.
  const int reach = static_cast<int>(std::ceil(kKernelReach * correlation_cells));
  std::vector<double> kernel(std::min(cells, 2 * reach + 1));
  for (int d = -reach; d <= reach; ++d) {
    const double x = d / correlation_cells;
    kernel[(d + static_cast<long>(reach)) % static_cast<long>(kernel.size())] += std::exp(-x * x);
  }
  double power = 0;
  for (const double w : kernel) power += w * w;
  std::vector<double> texture(cells);
  for (int k = 0; k < cells; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < kernel.size(); ++i) sum += kernel[i] * white[(k + i) % cells];
    texture[k] = gamma_texture(shape, sum / std::sqrt(power));
  }
  return texture;
}

std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, std::uint64_t seed,
                                      std::uint64_t index) {
  Random random({seed, Stream::kClutter, index});
  const int scatterers = kScatterersPerCell * train.band_bins();
  const std::vector<double> texture =
      sea_texture(scatterers, spec.texture_shape, kScatterersPerCell * kTextureCells, random);

  // Doppler f_D = -2 v / lambda, so a velocity spread s gives the correlation e^{-(4 pi s tau / lambda)^2 / 2}.
  const double wavelength = kSpeedOfLight / train.band_centre_hz();
  const double duration = std::max(train.time_s.back(), train.pri_s);
  const double rate =
      std::clamp(4 * kPi * spec.doppler_spread_mps / wavelength, 1e-6 / duration, kIndependence / train.pri_s);
  Speckle speckle(scatterers, rate, random);

  // Scatterer k of K lies at range k W / K of the window W = c/(2 step): at frequency i step its phase -4 pi f R / c is
  // -2 pi i k / K, and a forward transform sums all of them. The first frequency's phase is part of the speckle.
  FourierBatch transform(scatterers, 1, Fourier::kForward);
  std::vector<Complex> response;
  response.reserve(train.pulses() * train.frequencies());
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    Complex* row = transform.row(0);
    speckle.at(train.time_s[n], row);
    for (int k = 0; k < scatterers; ++k) row[k] *= std::sqrt(texture[k] / scatterers);
    transform.execute();
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const double sweep_s = train.intra_pulse_motion ? train.baseband_hz[b] / train.chirp_rate_hz_s : 0;
      const double range_m = spec.doppler_mean_mps * (train.time_s[n] + sweep_s);
      const double frequency = train.carrier_hz[n] + train.baseband_hz[b];
      response.push_back(row[train.code[n] * train.bins_per_hop + b] *
                         std::polar(1.0, -4 * kPi * frequency * range_m / kSpeedOfLight));
    }
  }
  return response;
}

}  // namespace seaglint
