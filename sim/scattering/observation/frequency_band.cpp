// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/frequency_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/coefficients/material.h"

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

namespace {

// Phase over half of a band of one passage, forth and back, through the layers of a material, rad: reflection
// coefficients oscillate with a few times it, of several reflectors with the sum.
constexpr double kLayerHalfPhase = 0.1;

// Longest optical path forth and back through the layers of a material, m.
double layer_path(const Scatterer& scatterer, double k) {
  const double frequency_hz = k * kSpeedOfLight / (2 * kPi);
  double longest = 0;
  for (const MaterialSpec& material : scatterer.materials()) {
    double path = 0;
    for (const LayerSpec& layer : material.layers) {
      path +=
          2e-3 * layer.thickness_mm *
          std::sqrt(std::abs(value_at(layer.permittivity, frequency_hz) * value_at(layer.permeability, frequency_hz)));
    }
    longest = std::max(longest, path);
  }
  return longest;
}

}  // namespace

SweepPlan::SweepPlan(const Scatterer& scatterer, std::span<const double> wavenumbers)
    : wavenumbers_(wavenumbers.begin(), wavenumbers.end()) {
  SEAGLINT_CHECK(!wavenumbers.empty(), "a sweep without frequencies");
  std::vector<std::size_t> order(wavenumbers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t q) { return wavenumbers[q]; });
  const double path = layer_path(scatterer, wavenumbers[order.back()]);
  const double widest = path > 0 ? 2 * kLayerHalfPhase / path : std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < order.size();) {
    // Parts of equal width of the range of equal form, each of which is a band.
    const double k = wavenumbers[order[first]];
    const FormRange form = form_range(k);
    const double width = (form.highest - form.lowest) / std::ceil((form.highest - form.lowest) / widest + 1e-12);
    const double end = std::min(form.lowest + width * (1 + std::floor((k - form.lowest) / width)), form.highest);
    std::size_t last = first + 1, distinct = 1;
    for (; last < order.size() && wavenumbers[order[last]] < end; ++last)
      distinct += wavenumbers[order[last]] > wavenumbers[order[last - 1]];
    const std::span<const std::size_t> in_band = std::span(order).subspan(first, last - first);
    if (distinct > kBandNodes) {
      add(FrequencyBand(k, wavenumbers[in_band.back()]), {in_band.begin(), in_band.end()});
    } else {
      for (std::size_t i = 0; i < in_band.size();) {
        const double own = wavenumbers[in_band[i]];
        std::vector<std::size_t> equal;
        for (; i < in_band.size() && wavenumbers[in_band[i]] == own; ++i) equal.push_back(in_band[i]);
        add(FrequencyBand(own), std::move(equal));
      }
    }
    first = last;
  }
}

std::size_t SweepPlan::middle() const {
  const auto [lowest, highest] = std::ranges::minmax(wavenumbers_);
  const auto distance = [middle = 0.5 * (lowest + highest)](double k) { return std::abs(k - middle); };
  std::size_t nearest = 0;
  for (std::size_t q = 1; q < size(); ++q) {
    const double k = wavenumbers_[q], best = wavenumbers_[nearest];
    if (distance(k) < distance(best) || (distance(k) == distance(best) && k < best)) nearest = q;
  }
  return nearest;
}

void SweepPlan::add(const FrequencyBand& band, std::vector<std::size_t> points) {
  bands_.push_back({band, nodes_.size(), std::move(points)});
  nodes_.insert(nodes_.end(), band.nodes().begin(), band.nodes().end());
}

}  // namespace seaglint
