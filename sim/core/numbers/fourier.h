// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Discrete Fourier transforms in place (FFTW behind it), planned by FFTW_ESTIMATE, so that bits do not depend on
// timing. Building a plan is serialised over threads; executing different ones is not.

#include <cstddef>

#include "sim/core/numbers/linear.h"

namespace seaglint {

enum class Fourier { kForward, kInverse };  // e^{-j 2 pi k i / L} and e^{+j 2 pi k i / L}, both without a factor

// Transforms `count` rows of `length` numbers each in the caller's memory, row i from data + i stride on; what lies
// between the rows stays. Throws WorkError when FFTW has no plan.
void transform_rows(Complex* data, std::size_t length, std::size_t count, std::size_t stride, Fourier direction);

// `count` transforms of `length` numbers each, one row after the other in memory of its own, to be executed often.
class FourierBatch {
 public:
  FourierBatch(std::size_t length, std::size_t count, Fourier direction);  // rows start at zero
  ~FourierBatch();
  FourierBatch(const FourierBatch&) = delete;
  FourierBatch& operator=(const FourierBatch&) = delete;

  Complex* row(std::size_t i) { return data_ + i * length_; }
  const Complex* row(std::size_t i) const { return data_ + i * length_; }
  std::size_t length() const { return length_; }
  void execute();  // all rows

 private:
  std::size_t length_;
  std::size_t count_;
  Complex* data_;
  void* plan_;
};

}  // namespace seaglint
