// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/return_grid.h"

#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/core/parallel.h"

namespace seaglint {
namespace {

constexpr int kWidth = 6;                // cells
constexpr double kBeta = 2.30 * kWidth;  // Barnett et al. 2019, section 4.2, for oversampling 2

// phi(x), x in cells, |x| <= W/2.
double kernel(double x) {
  const double z = 2 * x / kWidth;
  const double inside = 1 - z * z;
  return inside <= 0 ? 0 : std::exp(kBeta * (std::sqrt(inside) - 1));
}

// phi^(theta) = integral of phi(x) cos(theta x) dx over its support, theta in rad per cell. The substitution x = W/2
// sin a removes the square root's end points; the midpoint rule then converges exponentially.
double kernel_transform(double theta) {
  constexpr int kPoints = 64;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double a = kPi * ((i + 0.5) / kPoints - 0.5);
    sum += std::exp(kBeta * (std::cos(a) - 1)) * std::cos(theta * 0.5 * kWidth * std::sin(a)) * std::cos(a);
  }
  return sum * kPi / kPoints * 0.5 * kWidth;
}

// phi at the cells 0..W-1 seen from a point `offset` cells after the first, W/2 - 1 <= offset <= W/2: linear in a
// table, which errs by phi'' / (8 n^2) = 7e-7, far less than the kernel itself.
std::array<double, kWidth> weights(double offset) {
  constexpr int kSteps = 512;
  static const auto table = [] {
    std::array<std::array<double, kWidth>, kSteps + 1> values;
    for (int n = 0; n <= kSteps; ++n) {
      for (int i = 0; i < kWidth; ++i) values[n][i] = kernel(i - (kWidth / 2 - 1) - static_cast<double>(n) / kSteps);
    }
    return values;
  }();
  const double place = (offset - (kWidth / 2 - 1)) * kSteps;
  const int n = std::clamp(static_cast<int>(place), 0, kSteps - 1);
  std::array<double, kWidth> w;
  for (int i = 0; i < kWidth; ++i) w[i] = table[n][i] + (place - n) * (table[n + 1][i] - table[n][i]);
  return w;
}

// The smallest length >= n with factors 2, 3 and 5 only.
int fft_length(int n) {
  for (;; ++n) {
    int rest = n;
    for (const int factor : {2, 3, 5}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return n;
  }
}

}  // namespace

ReturnGrid::ReturnGrid(const WavenumberGrid& wavenumbers, double u_limit, double s_limit)
    : wavenumbers_(wavenumbers), kc_(wavenumbers.at(wavenumbers.centre_index())) {
  SEAGLINT_CHECK(wavenumbers.count >= 1 && wavenumbers.step > 0 && kc_ > 0,
                 fmt::format("count {}, step {}, centre {}", wavenumbers.count, wavenumbers.step, kc_));
  psi_cells_ = fft_length(std::max(2 * wavenumbers.count, 2 * kWidth));
  psi_cell_ = 2 * kPi / (wavenumbers.step * psi_cells_);
  // Displacements up to s_limit make phases e^{jk u s}: cells of half the Nyquist spacing at the band's upper end. A
  // body at rest still has one cell.
  const double k_last = wavenumbers.at(wavenumbers.count - 1);
  const double s_bound = std::max(s_limit, 1e-3 / (k_last * std::max(u_limit, 1e-9)));
  u_cell_ = kPi / (2 * k_last * s_bound);
  const int half = static_cast<int>(std::ceil(u_limit / u_cell_)) + kWidth / 2 + 1;
  u_cells_ = 2 * half + 1;
  u_first_ = -half * u_cell_;
  cells_.assign(static_cast<std::size_t>(u_cells_) * psi_cells_, 0.0);

  psi_correction_.resize(wavenumbers.count);
  for (int q = 0; q < wavenumbers.count; ++q) {
    const int m = q - wavenumbers.centre_index();
    psi_correction_[q] = 1 / kernel_transform(m * wavenumbers.step * psi_cell_);
  }
}

void ReturnGrid::spread(std::span<const ReturnPoint> points) {
  for (const ReturnPoint& point : points) {
    const Complex value = point.amplitude * std::polar(1.0, kc_ * point.psi);

    // The grid is periodic in psi: frequencies on a grid of step dk cannot tell psi from psi + 2 pi / dk.
    const double x = point.psi / psi_cell_;
    const int first_psi = static_cast<int>(std::ceil(x - 0.5 * kWidth));
    const auto along_psi = weights(x - first_psi);
    const double y = (point.u - u_first_) / u_cell_;
    const int first_u = static_cast<int>(std::ceil(y - 0.5 * kWidth));
    SEAGLINT_CHECK(first_u >= 0 && first_u + kWidth <= u_cells_,
                   fmt::format("u = {} m lies outside the grid", point.u));
    const auto along_u = weights(y - first_u);

    std::array<int, kWidth> column;
    for (int i = 0; i < kWidth; ++i) column[i] = ((first_psi + i) % psi_cells_ + psi_cells_) % psi_cells_;
    for (int j = 0; j < kWidth; ++j) {
      const Complex row = along_u[j] * value;
      Complex* cells = &cells_[cell(first_u + j, 0)];
      for (int i = 0; i < kWidth; ++i) cells[column[i]] += along_psi[i] * row;
    }
  }
}

void ReturnGrid::add(const ReturnGrid& other) {
  SEAGLINT_CHECK(cells_.size() == other.cells_.size(),
                 fmt::format("{} and {} cells", cells_.size(), other.cells_.size()));
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i] += other.cells_[i];
}

void ReturnGrid::transform() {
  auto* data = reinterpret_cast<fftw_complex*>(cells_.data());
  fftw_plan plan;
  {
    const std::lock_guard lock(fftw_planner_mutex());
    const int length = psi_cells_;
    plan = fftw_plan_many_dft(1, &length, u_cells_, data, nullptr, 1, psi_cells_, data, nullptr, 1, psi_cells_,
                              FFTW_BACKWARD, FFTW_ESTIMATE);
  }
  SEAGLINT_CHECK(plan != nullptr, "FFTW has no plan");
  fftw_execute(plan);
  const std::lock_guard lock(fftw_planner_mutex());
  fftw_destroy_plan(plan);
}

void ReturnGrid::response(int first, double s, std::span<Complex> out) const {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int q = first + static_cast<int>(i);
    const int m = q - wavenumbers_.centre_index();
    const double k = wavenumbers_.at(q);
    const int bin = (m % psi_cells_ + psi_cells_) % psi_cells_;
    // e^{jk u_j s} by recurrence over the few cells in u.
    Complex turn = std::polar(1.0, k * u_first_ * s);
    const Complex step = std::polar(1.0, k * u_cell_ * s);
    Complex sum = 0;
    for (int u = 0; u < u_cells_; ++u) {
      sum += cells_[cell(u, bin)] * turn;
      turn *= step;
    }
    out[i] = sum * psi_correction_[q] / kernel_transform(k * u_cell_ * s);
  }
}

}  // namespace seaglint
