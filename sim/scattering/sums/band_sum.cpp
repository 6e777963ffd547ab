// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/band_sum.h"

#include <algorithm>
#include <cmath>

namespace seaglint {

namespace {

// e^{jx} to 1e-11, |x| <= kCellHalfPhase.
Complex small_phasor(double x) {
  const double y = x * x;
  return {1 - y / 2 * (1 - y / 12 * (1 - y / 30)), x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42)))};
}

}  // namespace

BandSum::BandSum(const FrequencyBand& band)
    : band_(band), cell_m_(band.half_width() > 0 ? 2 * kCellHalfPhase / band.half_width() : 0) {}

BandSum::Cell& BandSum::cell(std::int64_t place) {
  constexpr std::int64_t kMargin = 64;
  const auto size = static_cast<std::int64_t>(number_.size());
  if (size == 0) first_ = place - kMargin / 2;
  if (place < first_) {
    const std::int64_t before = first_ - place + kMargin;
    number_.insert(number_.begin(), static_cast<std::size_t>(before), -1);
    first_ -= before;
  } else if (place >= first_ + size) {
    number_.resize(static_cast<std::size_t>(place - first_ + kMargin), -1);
  }
  std::int32_t& number = number_[static_cast<std::size_t>(place - first_)];
  if (number < 0) {
    number = static_cast<std::int32_t>(cells_.size());
    cells_.push_back({place, {}});
  }
  return cells_[static_cast<std::size_t>(number)];
}

void BandSum::add(const Point& point) {
  const std::int64_t place = cell_m_ > 0 ? std::llround(point.psi / cell_m_) : 0;
  const double from_centre = point.psi - static_cast<double>(place) * cell_m_;
  Cell& sum = cell(place);
  // The phases at equidistant nodes by recurrence; a step is at most 0.62 kCellHalfPhase.
  Complex phase = std::polar(1.0, band_.nodes()[0] * from_centre);
  const Complex step = small_phasor(band_.node_step() * from_centre);
  for (std::size_t n = 0; n < band_.nodes().size(); ++n, phase *= step) {
    const Complex value = point.amplitude[n] * phase;
    const ScatteringMatrix pattern = point.pattern_at(n);
    for (std::size_t i = 0; i < 4; ++i) {
      sum.values[n][2 * i] += value.real() * pattern[i].real() - value.imag() * pattern[i].imag();
      sum.values[n][2 * i + 1] += value.real() * pattern[i].imag() + value.imag() * pattern[i].real();
    }
  }
}

void BandSum::add(const BandSum& other) {
  for (const Cell& from : other.cells_) {
    Cell& to = cell(from.place);
    for (std::size_t n = 0; n < kBandNodes; ++n) {
      for (std::size_t i = 0; i < 8; ++i) to.values[n][i] += from.values[n][i];
    }
  }
}

ScatteringMatrix BandSum::at(double k) const {
  const std::array<double, kBandNodes> weights = band_.weights(k);
  ScatteringMatrix sum{};
  for (const Cell& cell : cells_) {
    std::array<double, 8> value{};
    for (std::size_t n = 0; n < kBandNodes; ++n) {
      for (std::size_t i = 0; i < 8; ++i) value[i] += weights[n] * cell.values[n][i];
    }
    const Complex phase = std::polar(1.0, k * static_cast<double>(cell.place) * cell_m_);
    for (std::size_t i = 0; i < 4; ++i) sum[i] += phase * Complex(value[2 * i], value[2 * i + 1]);
  }
  return sum;
}

}  // namespace seaglint
