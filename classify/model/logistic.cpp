// SPDX-License-Identifier: BSD-3-Clause
#include "classify/model/logistic.h"

#include <Eigen/Dense>
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

}  // namespace

LogisticModel LogisticModel::train(const FeatureMatrix& features, std::span<const int> labels) {
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
    double length = 1, next = objective(w - direction);
    while (!(next <= value) && length > 1e-6) {
      length /= 2;
      next = objective(w - length * direction);
    }
    if (!(next <= value)) break;
    w -= length * direction;
    value = next;
  }
  model.weights_.assign(w.data(), w.data() + columns);
  model.offset_ = w[z.cols() - 1];
  return model;
}

std::vector<double> LogisticModel::predict(const FeatureMatrix& features) const {
  SEAGLINT_CHECK(features.columns() == weights_.size(), "as many columns as in training");
  std::vector<double> probabilities;
  for (std::size_t i = 0; i < features.rows(); ++i) {
    double x = offset_;
    for (std::size_t k = 0; k < weights_.size(); ++k)
      x += weights_[k] * (static_cast<double>(features.row(i)[k]) - means_[k]) * scales_[k];
    probabilities.push_back(logistic(x));
  }
  return probabilities;
}

}  // namespace seaglint
