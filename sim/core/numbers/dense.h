// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Dense matrices of any size, their products and decompositions. Eigen does the decompositions, in dense.cpp alone:
// a source that includes it takes several times as long to compile as most files of the project.

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Stored by columns.
template <typename T>
class Matrix {
 public:
  Matrix() = default;
  Matrix(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns), values_(rows * columns) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  T& operator()(std::size_t row, std::size_t column) { return values_[column * rows_ + row]; }
  const T& operator()(std::size_t row, std::size_t column) const { return values_[column * rows_ + row]; }
  std::span<T> column(std::size_t j) { return std::span(values_).subspan(j * rows_, rows_); }
  std::span<const T> column(std::size_t j) const { return std::span(values_).subspan(j * rows_, rows_); }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }

  // Appends the columns of a matrix with as many rows.
  void append(const Matrix& other) {
    rows_ = other.rows_;
    columns_ += other.columns_;
    values_.insert(values_.end(), other.values_.begin(), other.values_.end());
  }

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<T> values_;
};

using ComplexMatrix = Matrix<Complex>;
using ComplexFloat = std::complex<float>;
using ComplexFloatMatrix = Matrix<ComplexFloat>;

ComplexMatrix product(const ComplexMatrix& a, const ComplexMatrix& b);          // a b
ComplexMatrix adjoint_product(const ComplexMatrix& a, const ComplexMatrix& b);  // a^H b

// Consecutive rows of a matrix.
struct RowRange {
  std::size_t first = 0, count = 0;
};

// c += factor a^T b with b, c the given rows of the matrices.
void add_transposed_product(float factor, const ComplexFloatMatrix& a, const ComplexFloatMatrix& b, RowRange of_b,
                            ComplexFloatMatrix& c, RowRange of_c);

// LU factors of a square matrix, with partial pivoting.
class LuFactors {
 public:
  LuFactors() = default;
  explicit LuFactors(const ComplexFloatMatrix& a);

  // Solves a x = b with b and x the given rows of the matrices.
  void solve(const ComplexFloatMatrix& b, ComplexFloatMatrix& x, RowRange rows) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

// The x that minimise |a x - b| for each column b; at least as many rows as columns. By a QR decomposition with
// column pivoting.
ComplexMatrix least_squares(const ComplexMatrix& a, const ComplexMatrix& b);

struct HermitianModes {
  std::vector<double> values;  // ascending
  ComplexMatrix vectors;       // orthonormal columns
};

HermitianModes hermitian_modes(const ComplexMatrix& a);

}  // namespace seaglint
