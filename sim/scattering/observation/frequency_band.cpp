// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/frequency_band.h"

#include <cmath>

namespace seaglint {
namespace {

// Outermost nodes in half-widths: of equidistant nodes these have the smallest largest product of the distances to
// them, 0.14 (0.125 for Chebyshev's, whose phases do not follow by recurrence).
constexpr double kOutermost = 0.92;

}  // namespace

FormRange form_range(double k) {
  const double number = std::floor(4 * std::log2(k));
  return {std::exp2(number / 4), std::exp2((number + 1) / 4)};
}

FrequencyBand::FrequencyBand(double k) : centre_(k), half_width_(0), form_(form_range(k)) { nodes_[0] = k; }

FrequencyBand::FrequencyBand(double lowest, double highest)
    : centre_(0.5 * (lowest + highest)),
      half_width_(0.5 * (highest - lowest)),
      form_(form_range(centre_)),
      count_(kBandNodes) {
  for (std::size_t n = 0; n < kBandNodes; ++n) {
    const double place = 2.0 * static_cast<double>(n) / (kBandNodes - 1) - 1;
    nodes_[n] = centre_ + kOutermost * half_width_ * place;
  }
}

std::array<double, kBandNodes> FrequencyBand::weights(double k) const {
  std::array<double, kBandNodes> weights{};
  for (std::size_t n = 0; n < count_; ++n) {
    weights[n] = 1;
    for (std::size_t m = 0; m < count_; ++m) {
      if (m != n) weights[n] *= (k - nodes_[m]) / (nodes_[n] - nodes_[m]);
    }
  }
  return weights;
}

}  // namespace seaglint
