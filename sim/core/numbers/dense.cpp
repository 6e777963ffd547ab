// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace seaglint {
namespace {

template <typename T>
using Dense = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

template <typename T>
Eigen::Map<const Dense<T>> view(const Matrix<T>& a) {
  return {a.values().data(), static_cast<Eigen::Index>(a.rows()), static_cast<Eigen::Index>(a.columns())};
}

template <typename T>
Eigen::Map<Dense<T>> view(Matrix<T>& a) {
  return {a.values().data(), static_cast<Eigen::Index>(a.rows()), static_cast<Eigen::Index>(a.columns())};
}

template <typename Mapped>
auto rows_of(Mapped a, RowRange rows) {
  return a.middleRows(static_cast<Eigen::Index>(rows.first), static_cast<Eigen::Index>(rows.count));
}

}  // namespace

ComplexMatrix product(const ComplexMatrix& a, const ComplexMatrix& b) {
  ComplexMatrix c(a.rows(), b.columns());
  for (std::size_t j = 0; j < b.columns(); ++j) {
    for (std::size_t k = 0; k < b.rows(); ++k) {
      const Complex factor = b(k, j);
      for (std::size_t i = 0; i < a.rows(); ++i) c(i, j) += a(i, k) * factor;
    }
  }
  return c;
}

ComplexMatrix adjoint_product(const ComplexMatrix& a, const ComplexMatrix& b) {
  ComplexMatrix c(a.columns(), b.columns());
  for (std::size_t j = 0; j < b.columns(); ++j) {
    for (std::size_t i = 0; i < a.columns(); ++i) {
      for (std::size_t k = 0; k < b.rows(); ++k) c(i, j) += std::conj(a(k, i)) * b(k, j);
    }
  }
  return c;
}

void add_transposed_product(float factor, const ComplexFloatMatrix& a, const ComplexFloatMatrix& b, RowRange of_b,
                            ComplexFloatMatrix& c, RowRange of_c) {
  rows_of(view(c), of_c).noalias() += factor * (view(a).transpose() * rows_of(view(b), of_b));
}

struct LuFactors::Factors {
  Eigen::PartialPivLU<Dense<ComplexFloat>> lu;
};

LuFactors::LuFactors(const ComplexFloatMatrix& a)
    : factors_(std::make_shared<Factors>(Factors{view(a).partialPivLu()})) {}

void LuFactors::solve(const ComplexFloatMatrix& b, ComplexFloatMatrix& x, RowRange rows) const {
  rows_of(view(x), rows) = factors_->lu.solve(rows_of(view(b), rows));
}

ComplexMatrix least_squares(const ComplexMatrix& a, const ComplexMatrix& b) {
  ComplexMatrix x(a.columns(), b.columns());
  view(x) = view(a).colPivHouseholderQr().solve(view(b));
  return x;
}

HermitianModes hermitian_modes(const ComplexMatrix& a) {
  Eigen::SelfAdjointEigenSolver<Dense<Complex>> solver;
  solver.compute(view(a));
  HermitianModes modes{std::vector<double>(a.rows()), ComplexMatrix(a.rows(), a.columns())};
  for (std::size_t i = 0; i < a.rows(); ++i) modes.values[i] = solver.eigenvalues()[static_cast<Eigen::Index>(i)];
  view(modes.vectors) = solver.eigenvectors();
  return modes;
}

}  // namespace seaglint
