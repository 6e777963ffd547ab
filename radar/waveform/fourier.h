// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Batches of discrete Fourier transforms for the radar stages (FFTW behind it).

#include <cstddef>

#include "sim/core/numbers/linear.h"

namespace seaglint {

enum class Fourier { kForward, kInverse };  // e^{-j 2 pi k i / L} and e^{+j 2 pi k i / L}, both without a factor

// `count` transforms of `length` numbers each, in place, one row after the other. Plans by FFTW_ESTIMATE, so that bits
// do not depend on timing; building is serialised over threads, executing different batches is not.
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
