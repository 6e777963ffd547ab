// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Vectors and matrices of two and three dimensions, as plain values.
//
// Sums run (x + y) + z. Three run x + (y + z): the third row of a product of matrices or of a matrix and a vector, the
// trace, and the product of a real and a complex vector. Results keep their bits as long as these orders stay.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstddef>

namespace seaglint {

using Complex = std::complex<double>;
inline constexpr Complex kJ{0, 1};

struct Vec2 {
  constexpr Vec2() = default;
  constexpr Vec2(double x, double y) : at_{x, y} {}
  static constexpr Vec2 Zero() { return {}; }
  static constexpr Vec2 Constant(double value) { return {value, value}; }
  static constexpr Vec2 UnitX() { return {1, 0}; }
  static constexpr Vec2 UnitY() { return {0, 1}; }

  constexpr double x() const { return at_[0]; }
  constexpr double y() const { return at_[1]; }
  constexpr double& x() { return at_[0]; }
  constexpr double& y() { return at_[1]; }
  constexpr double operator[](std::size_t i) const { return at_[i]; }
  constexpr double& operator[](std::size_t i) { return at_[i]; }

  constexpr Vec2& operator+=(const Vec2& b) { return *this = *this + b; }
  constexpr Vec2& operator-=(const Vec2& b) { return *this = *this - b; }
  constexpr Vec2& operator*=(double s) { return *this = *this * s; }
  constexpr Vec2& operator/=(double s) { return *this = *this / s; }
  friend constexpr Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.x() + b.x(), a.y() + b.y()}; }
  friend constexpr Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x() - b.x(), a.y() - b.y()}; }
  friend constexpr Vec2 operator-(const Vec2& a) { return {-a.x(), -a.y()}; }
  friend constexpr Vec2 operator*(const Vec2& a, double s) { return {a.x() * s, a.y() * s}; }
  friend constexpr Vec2 operator*(double s, const Vec2& a) { return a * s; }
  friend constexpr Vec2 operator/(const Vec2& a, double s) { return {a.x() / s, a.y() / s}; }
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;

  constexpr double dot(const Vec2& b) const { return x() * b.x() + y() * b.y(); }
  // Component of the cross product along z.
  friend constexpr double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
  constexpr double squaredNorm() const { return dot(*this); }
  double norm() const { return std::sqrt(squaredNorm()); }
  // The vector itself where its length is 0.
  Vec2 normalized() const { return squaredNorm() > 0 ? *this / norm() : *this; }

  constexpr Vec2 cwiseMin(const Vec2& b) const { return {std::min(x(), b.x()), std::min(y(), b.y())}; }
  constexpr Vec2 cwiseMax(const Vec2& b) const { return {std::max(x(), b.x()), std::max(y(), b.y())}; }
  Vec2 cwiseAbs() const { return {std::abs(x()), std::abs(y())}; }
  constexpr double maxCoeff() const { return std::max(x(), y()); }

 private:
  std::array<double, 2> at_{};
};

// Of double, Vec3, or of Complex, CVec3.
template <class T>
struct Vector3 {
  constexpr Vector3() = default;
  constexpr Vector3(const T& x, const T& y, const T& z) : at_{x, y, z} {}
  constexpr explicit Vector3(const std::array<T, 3>& at) : at_(at) {}
  static constexpr Vector3 Zero() { return {}; }
  static constexpr Vector3 Constant(const T& value) { return {value, value, value}; }
  static constexpr Vector3 UnitX() { return {1, 0, 0}; }
  static constexpr Vector3 UnitY() { return {0, 1, 0}; }
  static constexpr Vector3 UnitZ() { return {0, 0, 1}; }

  constexpr const T& x() const { return at_[0]; }
  constexpr const T& y() const { return at_[1]; }
  constexpr const T& z() const { return at_[2]; }
  constexpr T& x() { return at_[0]; }
  constexpr T& y() { return at_[1]; }
  constexpr T& z() { return at_[2]; }
  constexpr const T& operator[](std::size_t i) const { return at_[i]; }
  constexpr T& operator[](std::size_t i) { return at_[i]; }
  constexpr const T* data() const { return at_.data(); }
  constexpr const T* begin() const { return data(); }
  constexpr const T* end() const { return data() + 3; }
  constexpr T* begin() { return at_.data(); }
  constexpr T* end() { return at_.data() + 3; }
  constexpr Vec2 xy() const { return {x(), y()}; }
  template <class U>
  constexpr Vector3<U> cast() const {
    return {static_cast<U>(x()), static_cast<U>(y()), static_cast<U>(z())};
  }

  constexpr Vector3& operator+=(const Vector3& b) { return *this = *this + b; }
  constexpr Vector3& operator-=(const Vector3& b) { return *this = *this - b; }
  constexpr Vector3& operator*=(const T& s) { return *this = *this * s; }
  constexpr Vector3& operator/=(const T& s) { return *this = *this / s; }
  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {a.x() + b.x(), a.y() + b.y(), a.z() + b.z()};
  }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
  }
  friend constexpr Vector3 operator-(const Vector3& a) { return {-a.x(), -a.y(), -a.z()}; }
  friend constexpr Vector3 operator*(const Vector3& a, const T& s) { return {a.x() * s, a.y() * s, a.z() * s}; }
  friend constexpr Vector3 operator*(const T& s, const Vector3& a) { return a * s; }
  friend constexpr Vector3 operator/(const Vector3& a, const T& s) { return {a.x() / s, a.y() / s, a.z() / s}; }
  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;

  constexpr double dot(const Vector3& b) const { return x() * b.x() + y() * b.y() + z() * b.z(); }
  constexpr Complex dot(const Vector3<Complex>& b) const requires std::same_as<T, double> {
    return x() * b.x() + (y() * b.y() + z() * b.z());
  }
  constexpr Vector3 cross(const Vector3& b) const {
    return {y() * b.z() - z() * b.y(), z() * b.x() - x() * b.z(), x() * b.y() - y() * b.x()};
  }
  constexpr double squaredNorm() const { return dot(*this); }
  double norm() const { return std::sqrt(squaredNorm()); }
  // The vector itself where its length is 0.
  Vector3 normalized() const { return squaredNorm() > 0 ? *this / norm() : *this; }
  void normalize() { *this = normalized(); }
  // A unit vector at right angles to this one.
  Vector3 unitOrthogonal() const {
    constexpr double kAlongZ = 1e-12;
    if (std::abs(x()) <= kAlongZ * std::abs(z()) && std::abs(y()) <= kAlongZ * std::abs(z())) {
      const double inverse = 1 / Vec2(y(), z()).norm();
      return {0, -z() * inverse, y() * inverse};
    }
    const double inverse = 1 / xy().norm();
    return {-y() * inverse, x() * inverse, 0};
  }

  constexpr double sum() const { return x() + y() + z(); }
  constexpr Vector3 cwiseMin(const Vector3& b) const {
    return {std::min(x(), b.x()), std::min(y(), b.y()), std::min(z(), b.z())};
  }
  constexpr Vector3 cwiseMax(const Vector3& b) const {
    return {std::max(x(), b.x()), std::max(y(), b.y()), std::max(z(), b.z())};
  }
  constexpr Vector3 cwiseProduct(const Vector3& b) const { return {x() * b.x(), y() * b.y(), z() * b.z()}; }
  Vector3 cwiseAbs() const { return {std::abs(x()), std::abs(y()), std::abs(z())}; }
  Vector3 rounded() const { return {std::round(x()), std::round(y()), std::round(z())}; }
  constexpr double maxCoeff() const { return std::max({x(), y(), z()}); }
  // The first of the largest components.
  constexpr std::size_t longest_axis() const {
    return static_cast<std::size_t>(std::max_element(at_.begin(), at_.end()) - at_.begin());
  }
  // No component is larger than the tolerance.
  bool isZero(double tolerance) const {
    return std::abs(x()) <= tolerance && std::abs(y()) <= tolerance && std::abs(z()) <= tolerance;
  }
  bool allFinite() const { return std::isfinite(x()) && std::isfinite(y()) && std::isfinite(z()); }

 private:
  std::array<T, 3> at_{};
};

using Vec3 = Vector3<double>;
using CVec3 = Vector3<Complex>;

constexpr CVec3 operator*(const Complex& s, const Vec3& a) { return {s * a.x(), s * a.y(), s * a.z()}; }
constexpr CVec3 operator*(const Vec3& a, const Complex& s) { return s * a; }
constexpr CVec3 operator*(double s, const CVec3& a) { return {s * a.x(), s * a.y(), s * a.z()}; }
constexpr CVec3 operator*(const CVec3& a, double s) { return s * a; }

struct Mat2 {
  constexpr Mat2() = default;
  // Of its columns.
  constexpr Mat2(const Vec2& first, const Vec2& second) : column_{first, second} {}
  static constexpr Mat2 Zero() { return {}; }
  static constexpr Mat2 Identity() { return {{1, 0}, {0, 1}}; }

  constexpr double operator()(std::size_t i, std::size_t j) const { return column_[j][i]; }
  constexpr double& operator()(std::size_t i, std::size_t j) { return column_[j][i]; }
  constexpr const Vec2& col(std::size_t j) const { return column_[j]; }
  constexpr Mat2 transpose() const { return {{column_[0].x(), column_[1].x()}, {column_[0].y(), column_[1].y()}}; }

  constexpr Mat2& operator+=(const Mat2& b) { return *this = *this + b; }
  constexpr Mat2& operator-=(const Mat2& b) { return *this = *this - b; }
  constexpr Mat2& operator*=(double s) { return *this = s * *this; }
  friend constexpr Mat2 operator+(const Mat2& a, const Mat2& b) { return {a.col(0) + b.col(0), a.col(1) + b.col(1)}; }
  friend constexpr Mat2 operator-(const Mat2& a, const Mat2& b) { return {a.col(0) - b.col(0), a.col(1) - b.col(1)}; }
  friend constexpr Mat2 operator*(double s, const Mat2& a) { return {s * a.col(0), s * a.col(1)}; }
  friend constexpr Vec2 operator*(const Mat2& a, const Vec2& v) { return a.col(0) * v.x() + a.col(1) * v.y(); }
  friend constexpr Mat2 operator*(const Mat2& a, const Mat2& b) { return {a * b.col(0), a * b.col(1)}; }

  constexpr double trace() const { return column_[0].x() + column_[1].y(); }
  constexpr double determinant() const { return column_[0].x() * column_[1].y() - column_[0].y() * column_[1].x(); }
  // Of all components, row by row.
  constexpr double squaredNorm() const {
    return Vec2(column_[0].x(), column_[1].x()).squaredNorm() + Vec2(column_[0].y(), column_[1].y()).squaredNorm();
  }
  double norm() const { return std::sqrt(squaredNorm()); }

 private:
  std::array<Vec2, 2> column_{};
};

struct TransposedMat3;

struct Mat3 {
  constexpr Mat3() = default;
  // Of its columns.
  constexpr Mat3(const Vec3& first, const Vec3& second, const Vec3& third) : column_{first, second, third} {}
  static constexpr Mat3 Zero() { return {}; }
  static constexpr Mat3 Identity() { return {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}; }

  constexpr double operator()(std::size_t i, std::size_t j) const { return column_[j][i]; }
  constexpr double& operator()(std::size_t i, std::size_t j) { return column_[j][i]; }
  constexpr const Vec3& col(std::size_t j) const { return column_[j]; }
  constexpr Vec3& col(std::size_t j) { return column_[j]; }
  constexpr Vec3 row(std::size_t i) const { return {column_[0][i], column_[1][i], column_[2][i]}; }
  constexpr TransposedMat3 transpose() const;

  constexpr Mat3& operator+=(const Mat3& b) { return *this = *this + b; }
  constexpr Mat3& operator/=(double s) { return *this = *this / s; }
  friend constexpr Mat3 operator+(const Mat3& a, const Mat3& b) {
    return {a.col(0) + b.col(0), a.col(1) + b.col(1), a.col(2) + b.col(2)};
  }
  friend constexpr Mat3 operator-(const Mat3& a, const Mat3& b) {
    return {a.col(0) - b.col(0), a.col(1) - b.col(1), a.col(2) - b.col(2)};
  }
  friend constexpr Mat3 operator-(const Mat3& a) { return {-a.col(0), -a.col(1), -a.col(2)}; }
  friend constexpr Mat3 operator*(double s, const Mat3& a) { return {s * a.col(0), s * a.col(1), s * a.col(2)}; }
  friend constexpr Mat3 operator*(const Mat3& a, double s) { return s * a; }
  friend constexpr Mat3 operator/(const Mat3& a, double s) { return {a.col(0) / s, a.col(1) / s, a.col(2) / s}; }
  friend constexpr Vec3 operator*(const Mat3& a, const Vec3& v) {
    return {a(0, 0) * v.x() + a(0, 1) * v.y() + a(0, 2) * v.z(),  //
            a(1, 0) * v.x() + a(1, 1) * v.y() + a(1, 2) * v.z(),  //
            a(2, 0) * v.x() + (a(2, 1) * v.y() + a(2, 2) * v.z())};
  }
  friend constexpr Mat3 operator*(const Mat3& a, const Mat3& b) { return {a * b.col(0), a * b.col(1), a * b.col(2)}; }
  friend constexpr bool operator==(const Mat3&, const Mat3&) = default;

  constexpr double trace() const { return column_[0].x() + (column_[1].y() + column_[2].z()); }
  constexpr double determinant() const { return row(0).dot(row(1).cross(row(2))); }
  constexpr Mat3 inverse() const;
  // Root of the sum of squares of all components.
  double norm() const {
    return std::sqrt(column_[0].squaredNorm() + column_[1].squaredNorm() + column_[2].squaredNorm());
  }

 private:
  std::array<Vec3, 3> column_{};
};

// A^T as it stands in a product: its rows are the columns of A.
struct TransposedMat3 {
  Mat3 of;

  constexpr operator Mat3() const { return {of.row(0), of.row(1), of.row(2)}; }
  friend constexpr Vec3 operator*(const TransposedMat3& a, const Vec3& v) {
    return {a.of.col(0).dot(v), a.of.col(1).dot(v), a.of.col(2).dot(v)};
  }
};

constexpr TransposedMat3 Mat3::transpose() const { return {*this}; }

constexpr Mat3 Mat3::inverse() const {
  const Vec3 yz = col(1).cross(col(2)), zx = col(2).cross(col(0)), xy = col(0).cross(col(1));
  const double scale = 1 / yz.dot(col(0));
  return Mat3(yz * scale, zx * scale, xy * scale).transpose();
}

// a b^T
constexpr Mat2 outer_product(const Vec2& a, const Vec2& b) { return {a * b.x(), a * b.y()}; }
constexpr Mat3 outer_product(const Vec3& a, const Vec3& b) { return {a * b.x(), a * b.y(), a * b.z()}; }

}  // namespace seaglint
