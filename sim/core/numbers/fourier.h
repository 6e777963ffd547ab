// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Fourier transforms by FFTW, planned with FFTW_ESTIMATE, so that results do not depend on timing, and spectral
// densities of series. Planning is serialised between threads, execution is not.

#include <cstddef>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

enum class Fourier { kForward, kInverse };  // e^{-j 2 pi k i / L} and e^{+j 2 pi k i / L}, both unnormalised

// Transforms `count` rows of `length` numbers in the caller's memory, row i at data + i stride; memory between the rows
// is unchanged. Throws WorkError when FFTW returns no plan.
void transform_rows(Complex* data, std::size_t length, std::size_t count, std::size_t stride, Fourier direction);

// `count` transforms of `length` numbers on contiguous rows in memory of its own, for repeated execution.
class FourierBatch {
 public:
  FourierBatch(std::size_t length, std::size_t count, Fourier direction);  // rows are initialised to zero
  ~FourierBatch();
  FourierBatch(const FourierBatch&) = delete;
  FourierBatch& operator=(const FourierBatch&) = delete;

  Complex* row(std::size_t i) { return data_ + i * length_; }
  const Complex* row(std::size_t i) const { return data_ + i * length_; }
  std::size_t length() const { return length_; }
  void execute();  // all rows

 private:
  std::size_t length_;
  Complex* data_;
  void* plan_;
};

// One-sided spectral densities over angular frequency, unit squared times s/rad, of series of equal length with time
// step `step` (s), each with a Hann window and zero-padded to `padding` times its length: [series] [n - 1] at omega = n
// 2 pi / (padding length step), n = 1 to count, count <= padding length / 2.
std::vector<std::vector<double>> periodograms(std::span<const std::vector<double>> series, double step,
                                              std::size_t count, std::size_t padding = 1);

}  // namespace seaglint
