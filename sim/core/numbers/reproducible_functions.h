// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Elementary functions that are bit-identical on all machines: they use operations only that IEEE 754 rounds
// identically everywhere; functions of libm differ between versions and processors.

#include <cstddef>
#include <span>
#include <vector>

namespace seaglint {

// Logarithm, exponential and hyperbolic tangent, from +, -, *, / and scaling by powers of two only.
double reproducible_log(double x);   // x > 0 and normal; relative error below 4e-16, absolute near 1
double reproducible_exp(double x);   // relative error below 4e-16; 0 below -700
double reproducible_tanh(double x);  // relative error below 1e-15

// cosine[i], sine[i] of angle[i] (radians), |angle| <= kLargestAngle; absolute error below 4e-16. Spans of equal
// length.
void unit_phasors(std::span<const double> angle, std::span<double> cosine, std::span<double> sine);
inline constexpr double kLargestAngle = 4e8;

// The angle unchanged within kLargestAngle, else reduced by whole turns; |angle| <= 1e12, where its own rounding is
// 1e-4 rad.
double wrapped_angle(double angle);

// Phasors e^{j(omega_i t + phase_i)} at t = start + n step for n = 0, 1, 2, ...: each step multiplies them by a
// constant phasor; every kResynchronise steps they are recomputed from their angles. Error below 1e-13.
class UniformPhasors {
 public:
  static constexpr int kResynchronise = 64;

  UniformPhasors(std::vector<double> omega, std::vector<double> phase, double start, double step);

  void advance();
  double time() const { return start_ + step_ * static_cast<double>(count_); }
  std::span<const double> cosine() const { return cosine_; }
  std::span<const double> sine() const { return sine_; }

 private:
  void synchronise();

  std::vector<double> omega_, phase_;
  double start_, step_;
  long long count_ = 0;
  std::vector<double> turn_cosine_, turn_sine_;
  std::vector<double> cosine_, sine_, angle_;
};

}  // namespace seaglint
