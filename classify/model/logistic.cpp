// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/logistic.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr int kMostSteps = 100;
constexpr double kGradientPerRow = 1e-9;

// log(1 + e^x) without overflow
double softplus(double x) { return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))); }

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Standardised columns, and a last one of ones for the offset.
Rows standardised(const FeatureMatrix& features, std::span<const double> means, std::span<const double> scales) {
  const auto rows = static_cast<Eigen::Index>(features.rows()), columns = static_cast<Eigen::Index>(means.size());
  Rows z(rows, columns + 1);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const std::span<const float> row = features.row(static_cast<std::size_t>(i));
    for (Eigen::Index k = 0; k < columns; ++k)
      z(i, k) = (static_cast<double>(row[static_cast<std::size_t>(k)]) - means[static_cast<std::size_t>(k)]) *
                scales[static_cast<std::size_t>(k)];
    z(i, columns) = 1;
  }
  return z;
}

// Moves w against a direction of Newton's method, by a half, a quarter, ... of it where the whole does not lower the
// objective, whose value at w is `value`. False, with w unchanged, when none does.
template <class Objective, class Weights>
bool descend(const Objective& objective, const Weights& direction, Weights& w, double& value) {
  double length = 1, next = objective(w - direction);
  while (!(next <= value) && length > 1e-6) {
    length /= 2;
    next = objective(w - length * direction);
  }
  if (!(next <= value)) return false;
  w -= length * direction;
  value = next;
  return true;
}

// Weights of the columns of z, the last that of the offset.
Eigen::VectorXd binary_weights(const Rows& z, std::span<const int> labels) {
  const std::size_t rows = labels.size();
  Eigen::VectorXd truth(z.rows()), w = Eigen::VectorXd::Zero(z.cols()), penalty = Eigen::VectorXd::Ones(z.cols());
  for (std::size_t i = 0; i < rows; ++i) truth[static_cast<Eigen::Index>(i)] = labels[i];
  penalty[z.cols() - 1] = 1e-12;  // the offset is free; with one class only it stays finite

  const auto objective = [&](const Eigen::VectorXd& at) {
    const Eigen::VectorXd x = z * at;
    double sum = 0.5 * at.cwiseAbs2().dot(penalty);
    for (Eigen::Index i = 0; i < x.size(); ++i) sum += softplus(x[i]) - truth[i] * x[i];
    return sum;
  };
  double value = objective(w);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd p = (z * w).unaryExpr(&logistic);
    const Eigen::VectorXd gradient = z.transpose() * (p - truth) + penalty.cwiseProduct(w);
    if (gradient.cwiseAbs().maxCoeff() < kGradientPerRow * static_cast<double>(rows)) break;
    const Eigen::VectorXd curvature = p.array() * (1 - p.array());
    Eigen::MatrixXd hessian = z.transpose() * curvature.asDiagonal() * z;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd direction = hessian.ldlt().solve(gradient);
    if (!descend(objective, direction, w, value)) break;
  }
  return w;
}

// Probabilities of the classes, [row][class], from their exponents.
Eigen::MatrixXd softmax(const Eigen::MatrixXd& exponents) {
  Eigen::MatrixXd p = (exponents.colwise() - exponents.rowwise().maxCoeff()).array().exp();
  const Eigen::VectorXd sums = p.rowwise().sum();
  p.array().colwise() /= sums.array();
  return p;
}

// [column][class], the last row those of the offsets. Equal shifts of all offsets change no probability: the term
// (sum of offsets)^2 / 2 makes the minimum unique without moving it.
Eigen::MatrixXd multinomial_weights(const Rows& z, std::span<const int> labels, std::size_t classes) {
  const Eigen::Index columns = z.cols(), count = static_cast<Eigen::Index>(classes), last = columns - 1;
  Eigen::MatrixXd truth = Eigen::MatrixXd::Zero(z.rows(), count), w = Eigen::MatrixXd::Zero(columns, count);
  for (Eigen::Index i = 0; i < z.rows(); ++i) truth(i, labels[static_cast<std::size_t>(i)]) = 1;
  const auto objective = [&](const Eigen::MatrixXd& at) {
    const Eigen::MatrixXd x = z * at;
    const Eigen::VectorXd highest = x.rowwise().maxCoeff();
    const Eigen::VectorXd sums = (x.colwise() - highest).array().exp().rowwise().sum();
    return 0.5 * at.topRows(last).squaredNorm() + 0.5 * std::pow(at.row(last).sum(), 2) +
           (highest.array() + sums.array().log()).sum() - truth.cwiseProduct(x).sum();
  };
  double value = objective(w);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd p = softmax(z * w);
    Eigen::MatrixXd gradient = z.transpose() * (p - truth);
    gradient.topRows(last) += w.topRows(last);
    gradient.row(last).array() += w.row(last).sum();
    if (gradient.cwiseAbs().maxCoeff() < kGradientPerRow * static_cast<double>(z.rows())) break;
    Eigen::MatrixXd hessian(columns * count, columns * count);
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; b < count; ++b) {
        const Eigen::VectorXd curvature = p.col(a).array() * ((a == b ? 1.0 : 0.0) - p.col(b).array());
        auto block = hessian.block(a * columns, b * columns, columns, columns);
        block = z.transpose() * curvature.asDiagonal() * z;
        if (a == b) block.diagonal().head(last).array() += 1;
        block(last, last) += 1;
      }
    }
    const Eigen::VectorXd solved = hessian.ldlt().solve(gradient.reshaped());
    const Eigen::MatrixXd direction = solved.reshaped(columns, count);
    if (!descend(objective, direction, w, value)) break;
  }
  return w;
}

}  // namespace

LogisticModel LogisticModel::train(const FeatureMatrix& features, std::span<const int> labels, std::size_t classes) {
  const std::size_t rows = features.rows(), columns = features.columns();
  SEAGLINT_CHECK(rows > 0 && labels.size() == rows, "one label per row");
  LogisticModel model;
  for (std::size_t k = 0; k < columns; ++k) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < rows; ++i) sum += static_cast<double>(features.row(i)[k]);
    const double mean = sum / static_cast<double>(rows);
    for (std::size_t i = 0; i < rows; ++i) squares += std::pow(static_cast<double>(features.row(i)[k]) - mean, 2);
    const double deviation = std::sqrt(squares / static_cast<double>(rows));
    model.means_.push_back(mean);
    model.scales_.push_back(deviation > 0 ? 1 / deviation : 0);
  }
  const Rows z = standardised(features, model.means_, model.scales_);
  const Eigen::MatrixXd w =
      classes == 2 ? Eigen::MatrixXd(binary_weights(z, labels)) : multinomial_weights(z, labels, classes);
  for (Eigen::Index k = 0; k < w.cols(); ++k) {
    model.weights_.insert(model.weights_.end(), w.col(k).data(), w.col(k).data() + columns);
    model.offsets_.push_back(w(z.cols() - 1, k));
  }
  return model;
}

std::vector<double> LogisticModel::predict(const FeatureMatrix& features) const {
  const std::size_t columns = means_.size();
  SEAGLINT_CHECK(features.columns() == columns, "as many columns as in training");
  std::vector<double> probabilities;
  std::vector<double> exponents(offsets_.size());
  for (std::size_t i = 0; i < features.rows(); ++i) {
    for (std::size_t output = 0; output < offsets_.size(); ++output) {
      double x = offsets_[output];
      for (std::size_t k = 0; k < columns; ++k)
        x += weights_[output * columns + k] * (static_cast<double>(features.row(i)[k]) - means_[k]) * scales_[k];
      exponents[output] = x;
    }
    if (exponents.size() == 1) {
      probabilities.push_back(logistic(exponents[0]));
      continue;
    }
    const double highest = *std::max_element(exponents.begin(), exponents.end());
    double sum = 0;
    for (const double x : exponents) sum += std::exp(x - highest);
    for (const double x : exponents) probabilities.push_back(std::exp(x - highest) / sum);
  }
  return probabilities;
}

}  // namespace seaglint
