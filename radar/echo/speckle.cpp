// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/speckle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"

namespace seaglint {

Kernel kernel_at(double x) {
  Kernel kernel{std::ceil((x - kKernelReach) / kNodeSpacing), {}};
  const int nodes = static_cast<int>(std::floor((x + kKernelReach) / kNodeSpacing) - kernel.first) + 1;
  double power = 0;
  for (int n = 0; n < nodes; ++n) {
    const double q = kernel.first + n;
    kernel.weight.push_back(std::exp(-(x - q * kNodeSpacing) * (x - q * kNodeSpacing)));
    power += kernel.weight.back() * kernel.weight.back();
  }
  for (double& w : kernel.weight) w /= std::sqrt(power);
  return kernel;
}

namespace {

Complex complex_normal(Random& random) {
  const double re = random.normal();
  return Complex(re, random.normal()) * std::sqrt(0.5);
}

constexpr std::int64_t kFirstNode = -6;  // -ceil(kKernelReach / kNodeSpacing)

}  // namespace

Speckle::Speckle(int scatterers, double rate_rad_s, Random& random)
    : scatterers_(scatterers), rate_(rate_rad_s), random_(random), first_(kFirstNode) {}

void Speckle::at(double time_s, Complex* values) {
  const Kernel kernel = kernel_at(time_s * rate_);
  while (!nodes_.empty() && first_ < kernel.first) {
    nodes_.pop_front();
    ++first_;
  }
  first_ = std::max(first_, kernel.first);
  while (nodes_.size() < kernel.weight.size()) {
    std::vector<Complex> node(scatterers_);
    for (Complex& value : node) value = complex_normal(random_);
    nodes_.push_back(std::move(node));
  }
  std::fill(values, values + scatterers_, Complex{});
  for (std::size_t i = 0; i < kernel.weight.size(); ++i) {
    for (int k = 0; k < scatterers_; ++k) values[k] += kernel.weight[i] * nodes_[i][k];
  }
}

IndividualSpeckle::IndividualSpeckle(int scatterers, std::uint64_t seed) {
  for (int k = 0; k < scatterers; ++k)
    processes_.push_back({Random({seed, Stream::kClutter, static_cast<std::uint64_t>(k)}), kFirstNode, {}});
}

void IndividualSpeckle::at(std::span<const double> phase, Complex* values) {
  // Weights e^{-(x - q d)^2} of consecutive nodes q by their ratios, e^{2 d (x - q d) - d^2}, which fall by e^{-2 d^2};
  // the sum of their squares is sqrt(pi / 2) / d to 1e-6.
  static const double kRatioOfRatios = std::exp(-2 * kNodeSpacing * kNodeSpacing),
                      kNorm = std::sqrt(kNodeSpacing / std::sqrt(kPi / 2));
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    Process& process = processes_[k];
    const double x = phase[k];
    const auto first = static_cast<std::int64_t>(std::ceil((x - kKernelReach) / kNodeSpacing)),
               last = static_cast<std::int64_t>(std::floor((x + kKernelReach) / kNodeSpacing));
    for (process.end = std::max(process.end, first); process.end <= last; ++process.end)
      process.nodes[process.end & (kNodes - 1)] = complex_normal(process.random);
    const double beyond = x - static_cast<double>(first) * kNodeSpacing;
    double weight = kNorm * std::exp(-beyond * beyond),
           ratio = std::exp(2 * kNodeSpacing * beyond - kNodeSpacing * kNodeSpacing);
    Complex sum = 0;
    for (std::int64_t q = first; q <= last; ++q) {
      sum += weight * process.nodes[q & (kNodes - 1)];
      weight *= ratio;
      ratio *= kRatioOfRatios;
    }
    values[k] = sum;
  }
}

}  // namespace seaglint
