// SPDX-License-Identifier: BSD-3-Clause
#include "radar/waveform/fourier.h"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <new>

#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

FourierBatch::FourierBatch(std::size_t length, std::size_t count, Fourier direction)
    : length_(length), count_(count), data_(nullptr), plan_(nullptr) {
  SEAGLINT_CHECK(length >= 1 && count >= 1 && length < (1u << 30) && count < (1u << 30),
                 fmt::format("{} x {}", count, length));
  data_ = reinterpret_cast<Complex*>(fftw_alloc_complex(length * count));
  if (data_ == nullptr) throw std::bad_alloc();
  auto* data = reinterpret_cast<fftw_complex*>(data_);
  const int n = static_cast<int>(length);
  {
    const std::lock_guard lock(fftw_planner_mutex());
    plan_ = fftw_plan_many_dft(1, &n, static_cast<int>(count), data, nullptr, 1, n, data, nullptr, 1, n,
                               direction == Fourier::kForward ? FFTW_FORWARD : FFTW_BACKWARD, FFTW_ESTIMATE);
  }
  if (plan_ == nullptr) {
    fftw_free(data_);
    throw WorkError(fmt::format("no plan for {} Fourier transforms of length {}", count, length));
  }
  std::fill(data_, data_ + length * count, Complex{});
}

FourierBatch::~FourierBatch() {
  {
    const std::lock_guard lock(fftw_planner_mutex());
    fftw_destroy_plan(static_cast<fftw_plan>(plan_));
  }
  fftw_free(data_);
}

void FourierBatch::execute() { fftw_execute(static_cast<fftw_plan>(plan_)); }

}  // namespace seaglint
