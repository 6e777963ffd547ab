// SPDX-License-Identifier: BSD-3-Clause
#include "radar/rvmap/map_weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr int kTaylorTerms = 4;  // nbar
constexpr double kTaylorSidelobeDb = 35;

// Taylor, "Design of line-source antennas for narrow beamwidth and low side lobes", IRE Trans. AP-3 (1955) 16;
// coefficients as in Carrara, Goodman and Majewski, "Spotlight Synthetic Aperture Radar" (1995), appendix D.2.
double taylor(double u) {
  const double a = std::acosh(std::pow(10, kTaylorSidelobeDb / 20)) / kPi;
  const double s2 = kTaylorTerms * kTaylorTerms / (a * a + (kTaylorTerms - 0.5) * (kTaylorTerms - 0.5));
  const auto value = [&](double x) {
    double sum = 1;
    for (int m = 1; m < kTaylorTerms; ++m) {
      double numerator = 1, denominator = 1;
      for (int i = 1; i < kTaylorTerms; ++i) {
        numerator *= 1 - m * m / (s2 * (a * a + (i - 0.5) * (i - 0.5)));
        if (i != m) denominator *= 1 - static_cast<double>(m * m) / (i * i);
      }
      const double coefficient = (m % 2 == 1 ? 1 : -1) * numerator / (2 * denominator);
      sum += 2 * coefficient * std::cos(2 * kPi * m * x);
    }
    return sum;
  };
  return value(u) / value(0);
}

// Weight at u in (-1/2, 1/2). Hann and Hamming: Harris, "On the use of windows", Proc. IEEE 66 (1978), eq. 26b and 30b.
double taper_at(Taper taper, double u) {
  switch (taper) {
    case Taper::kNone: return 1;
    case Taper::kHann: return 0.5 + 0.5 * std::cos(2 * kPi * u);
    case Taper::kHamming: return 0.54 + 0.46 * std::cos(2 * kPi * u);
    case Taper::kTaylor: return taylor(u);
  }
  return 1;
}

}  // namespace

std::vector<double> taper_samples(Taper taper, std::size_t count) {
  std::vector<double> samples(count);
  for (std::size_t i = 0; i < count; ++i) {
    samples[i] = taper_at(taper, (static_cast<double>(i) + 0.5) / static_cast<double>(count) - 0.5);
  }
  return samples;
}

MapWeights map_weights(const PulseTrain& train, const MapSpec& spec) {
  MapWeights weights;
  weights.pulse = taper_samples(spec.velocity_taper, train.pulses());
  std::vector<double> sum(train.carriers);
  for (std::size_t n = 0; n < train.pulses(); ++n) sum[train.code[n]] += weights.pulse[n];
  for (std::size_t n = 0; n < train.pulses(); ++n) weights.pulse[n] /= sum[train.code[n]];

  std::vector<int> covering(train.band_bins());
  for (int i = 0; i < train.carriers; ++i) {
    if (sum[i] == 0) {
      ++weights.unused_carriers;
      continue;
    }
    for (std::size_t b = 0; b < train.frequencies(); ++b) ++covering[i * train.bins_per_hop + b];
  }
  weights.bin = taper_samples(spec.range_taper, covering.size());
  for (std::size_t k = 0; k < covering.size(); ++k) weights.bin[k] *= covering[k] > 0 ? 1.0 / covering[k] : 0;
  // Response of a point of amplitude 1: |P|^2 / mean |P|^2 after a matched filter, 1 after an inverse filter.
  const std::vector<Complex> filter = compression_filter(train, spec.compression);
  double total = 0;
  for (int i = 0; i < train.carriers; ++i) {
    if (sum[i] == 0) continue;
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      total += weights.bin[i * train.bins_per_hop + b] * std::real(filter[b] * train.chirp_spectrum[b]);
    }
  }
  for (double& weight : weights.bin) weight /= total;
  return weights;
}

std::vector<Complex> compression_filter(const PulseTrain& train, Compression compression) {
  double mean = 0;
  for (const Complex& p : train.chirp_spectrum) mean += std::norm(p) / static_cast<double>(train.frequencies());
  std::vector<Complex> filter(train.frequencies());
  for (std::size_t b = 0; b < filter.size(); ++b) {
    const Complex p = train.chirp_spectrum[b];
    if (compression == Compression::kMatched) {
      filter[b] = std::conj(p) / mean;
    } else if (std::norm(p) > 1e-9 * mean) {
      filter[b] = std::conj(p) / std::norm(p);
    }
  }
  return filter;
}

std::vector<Complex> compress_pulses(std::span<const Complex> echo, const PulseTrain& train, Compression compression) {
  const std::size_t frequencies = train.frequencies();
  SEAGLINT_CHECK(
      echo.size() == train.pulses() * frequencies,
      fmt::format("echo of {} values for {} pulses x {} frequencies", echo.size(), train.pulses(), frequencies));
  const std::vector<Complex> filter = compression_filter(train, compression);
  std::vector<Complex> compressed(echo.size());
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < frequencies; ++b) {
      compressed[n * frequencies + b] = filter[b] * echo[n * frequencies + b];
    }
  }
  return compressed;
}

}  // namespace seaglint
