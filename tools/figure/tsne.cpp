// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/tsne.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/numbers/random.h"

namespace seaglint {

namespace {

// Columns of zero mean and unit variance; constant columns become zero.
std::vector<double> standardised(const FeatureMatrix& features) {
  const std::size_t n = features.rows(), columns = features.columns();
  std::vector<double> values(features.values.begin(), features.values.end());
  for (std::size_t k = 0; k < columns; ++k) {
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < n; ++i) mean += values[i * columns + k] / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) square += std::pow(values[i * columns + k] - mean, 2) / static_cast<double>(n);
    const double scale = square > 1e-24 * (1 + mean * mean) ? 1 / std::sqrt(square) : 0;
    for (std::size_t i = 0; i < n; ++i) values[i * columns + k] = (values[i * columns + k] - mean) * scale;
  }
  return values;
}

// p_{j|i} of row i for the precision at which the entropy is log(perplexity) (eq. 1), found by bisection.
void conditional_probabilities(const std::vector<double>& distance2, std::size_t i, std::size_t n, double perplexity,
                               double* p) {
  double low = 0, high = std::numeric_limits<double>::infinity(), precision = 1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < n; ++j) {
    if (j != i) nearest = std::min(nearest, distance2[i * n + j]);
  }
  for (int step = 0; step < 60; ++step) {
    double sum = 0, weighted = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double excess = distance2[i * n + j] - nearest;
      p[j] = j == i ? 0 : std::exp(-precision * excess);
      sum += p[j];
      weighted += p[j] * excess;
    }
    const double entropy = std::log(sum) + precision * weighted / sum;
    for (std::size_t j = 0; j < n; ++j) p[j] /= sum;
    (entropy > std::log(perplexity) ? low : high) = precision;
    precision = std::isinf(high) ? 2 * precision : 0.5 * (low + high);
  }
}

}  // namespace

std::vector<std::array<double, 2>> tsne(const FeatureMatrix& features, double perplexity, int iterations,
                                        std::uint64_t seed) {
  const std::size_t n = features.rows(), columns = features.columns();
  std::vector<std::array<double, 2>> y(n, {0, 0});
  if (n < 4) return y;
  perplexity = std::min(perplexity, static_cast<double>(n) / 3);

  const std::vector<double> x = standardised(features);
  std::vector<double> distance2(n * n, 0.0), p(n * n), symmetric(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < columns; ++k)
        distance2[i * n + j] += std::pow(x[i * columns + k] - x[j * columns + k], 2);
    }
    conditional_probabilities(distance2, i, n, perplexity, p.data() + i * n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      symmetric[i * n + j] = std::max((p[i * n + j] + p[j * n + i]) / (2 * static_cast<double>(n)), 1e-12);
    }
  }

  Random random({seed, Stream::kEmbeddingPlot, 0});
  for (auto& point : y) point = {1e-4 * random.normal(), 1e-4 * random.normal()};
  // Gradient descent with momentum and gains, early exaggeration 12 (section 3.4 and the authors' code); the step is n
  // / 12 (Belkina et al. 2019).
  const double rate = std::max(static_cast<double>(n) / 12, 20.0);
  std::vector<std::array<double, 2>> velocity(n, {0, 0}), gain(n, {1, 1});
  std::vector<double> q(n * n);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const bool early = iteration < iterations / 4;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double dx = y[i][0] - y[j][0], dy = y[i][1] - y[j][1];
        q[i * n + j] = i == j ? 0 : 1 / (1 + dx * dx + dy * dy);
        sum += q[i * n + j];
      }
    }
    std::array<double, 2> centre{0, 0};
    std::vector<std::array<double, 2>> gradient(n, {0, 0});
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        // eq. 5
        const double factor = 4 * ((early ? 12 : 1) * symmetric[i * n + j] - q[i * n + j] / sum) * q[i * n + j];
        for (int k = 0; k < 2; ++k) gradient[i][k] += factor * (y[i][k] - y[j][k]);
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (int k = 0; k < 2; ++k) {
        gain[i][k] = std::max((gradient[i][k] > 0) == (velocity[i][k] > 0) ? gain[i][k] * 0.8 : gain[i][k] + 0.2, 0.01);
        velocity[i][k] = (early ? 0.5 : 0.8) * velocity[i][k] - rate * gain[i][k] * gradient[i][k];
        y[i][k] += velocity[i][k];
        centre[k] += y[i][k] / static_cast<double>(n);
      }
    }
    for (auto& point : y) point = {point[0] - centre[0], point[1] - centre[1]};
  }
  return y;
}

}  // namespace seaglint
