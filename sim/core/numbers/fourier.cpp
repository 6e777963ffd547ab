// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/fourier.h"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// The FFTW planner has global state.
std::mutex planner_mutex;

void check(std::size_t length, std::size_t count, std::size_t stride) {
  constexpr std::size_t kMax = std::size_t{1} << 30;
  SEAGLINT_CHECK(length >= 1 && count >= 1 && stride >= length && count < kMax && stride < kMax,
                 fmt::format("{} rows of {}, {} apart", count, length, stride));
}

// FFTW_ESTIMATE depends on the alignment of the data only.
fftw_plan plan_rows(Complex* data, std::size_t length, std::size_t count, std::size_t stride, Fourier direction) {
  auto* rows = reinterpret_cast<fftw_complex*>(data);
  const int n = static_cast<int>(length), distance = static_cast<int>(stride);
  const std::lock_guard lock(planner_mutex);
  return fftw_plan_many_dft(1, &n, static_cast<int>(count), rows, nullptr, 1, distance, rows, nullptr, 1, distance,
                            direction == Fourier::kForward ? FFTW_FORWARD : FFTW_BACKWARD, FFTW_ESTIMATE);
}

void destroy(fftw_plan plan) {
  const std::lock_guard lock(planner_mutex);
  fftw_destroy_plan(plan);
}

[[noreturn]] void refuse(std::size_t length, std::size_t count) {
  throw WorkError(fmt::format("no plan for {} Fourier transforms of length {}", count, length));
}

}  // namespace

void transform_rows(Complex* data, std::size_t length, std::size_t count, std::size_t stride, Fourier direction) {
  check(length, count, stride);
  const fftw_plan plan = plan_rows(data, length, count, stride, direction);
  if (plan == nullptr) refuse(length, count);
  fftw_execute(plan);
  destroy(plan);
}

FourierBatch::FourierBatch(std::size_t length, std::size_t count, Fourier direction)
    : length_(length), data_(nullptr), plan_(nullptr) {
  check(length, count, length);
  data_ = reinterpret_cast<Complex*>(fftw_alloc_complex(length * count));
  if (data_ == nullptr) throw std::bad_alloc();
  plan_ = plan_rows(data_, length, count, length, direction);
  if (plan_ == nullptr) {
    fftw_free(data_);
    refuse(length, count);
  }
  std::fill(data_, data_ + length * count, Complex{});
}

FourierBatch::~FourierBatch() {
  destroy(static_cast<fftw_plan>(plan_));
  fftw_free(data_);
}

void FourierBatch::execute() { fftw_execute(static_cast<fftw_plan>(plan_)); }

std::vector<std::vector<double>> periodograms(std::span<const std::vector<double>> series, double step,
                                              std::size_t count, std::size_t padding) {
  const std::size_t samples = series[0].size();
  FourierBatch transform(padding * samples, series.size(), Fourier::kForward);
  double power = 0;
  for (std::size_t n = 0; n < samples; ++n) {
    const double window = 0.5 - 0.5 * std::cos(2 * kPi * (static_cast<double>(n) + 0.5) / static_cast<double>(samples));
    for (std::size_t i = 0; i < series.size(); ++i) transform.row(i)[n] = window * series[i][n];
    power += window * window;
  }
  transform.execute();
  std::vector<std::vector<double>> density(series.size());
  for (std::size_t i = 0; i < series.size(); ++i) {
    for (std::size_t k = 1; k <= count; ++k)
      density[i].push_back(std::norm(transform.row(i)[k]) * step / (kPi * power));
  }
  return density;
}

}  // namespace seaglint
