// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/sweep_sum.h"

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
    for (std::size_t i = 0; i < 4; ++i) {
      const Complex pattern = point.pattern_at(n, i);
      sum.values[n][2 * i] += value.real() * pattern.real() - value.imag() * pattern.imag();
      sum.values[n][2 * i + 1] += value.real() * pattern.imag() + value.imag() * pattern.real();
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

namespace {

// The points at a wavenumber of their band, as traced from the transmitter.
ScatteringMatrix one_way_at(std::span<const Point> points, const FrequencyBand& band, double k) {
  const std::array<double, kBandNodes> weights = band.weights(k);
  ScatteringMatrix sum{};
  for (const Point& point : points) {
    const Complex phase = std::polar(1.0, k * point.psi);
    for (std::size_t n = 0; n < band.nodes().size(); ++n) {
      const Complex value = weights[n] * phase * point.amplitude[n];
      for (std::size_t i = 0; i < 4; ++i) sum[i] += value * point.traced_pattern(n)[i];
    }
  }
  return sum;
}

}  // namespace

SweepSum::Sum::Sum(const SweepPlan& plan) : single(plan.size()) {
  for (const SweepPlan::Band& of : plan.bands()) bands.emplace_back(of.band);
}

void SweepSum::Sum::add(const Sum& other) {
  for (std::size_t b = 0; b < bands.size(); ++b) bands[b].add(other.bands[b]);
  for (std::size_t q = 0; q < single.size(); ++q) add_to(single[q], other.single[q]);
}

SweepSum::SweepSum(const SweepPlan& plan, std::optional<std::size_t> estimated, bool by_part)
    : plan_(plan), by_part_(by_part), whole_(plan) {
  if (!estimated) return;
  const double k = plan.wavenumber(*estimated);
  estimate_.emplace(k);
  const auto holds = [&](const SweepPlan::Band& of) {
    return std::ranges::find(of.points, *estimated) != of.points.end();
  };
  const auto band = std::ranges::find_if(plan.bands(), holds);
  estimated_band_ = static_cast<std::size_t>(band - plan.bands().begin());
  const auto nodes = band->band.nodes();
  const auto nearest = std::ranges::min_element(nodes, {}, [&](double node) { return std::abs(node - k); });
  estimated_node_ = band->first_node + static_cast<std::size_t>(nearest - nodes.begin());
}

void SweepSum::add(std::span<const Contribution> contributions, const Observation& observation) {
  for (const Contribution& contribution : contributions) add(contribution, observation);
  if (estimate_) estimate_->end_beam();
}

void SweepSum::add(const Contribution& contribution, const Observation& observation) {
  Sum* const part = by_part_ ? &parts_.try_emplace(contribution.source.part, plan_).first->second : nullptr;
  for (std::size_t b = 0; b < whole_.bands.size(); ++b) {
    const auto& [band, first_node, frequencies] = plan_.bands()[b];
    if (!varies_slowly(contribution, band)) {
      for (const std::size_t q : frequencies) {
        const ScatteringMatrix at_q = scattered(contribution, observation, plan_.wavenumber(q), first_node);
        add_to(whole_.single[q], at_q);
        if (part) add_to(part->single[q], at_q);
      }
      continue;
    }
    points_.clear();
    decompose(contribution, observation, {band, first_node}, points_);
    for (const Point& point : points_) {
      whole_.bands[b].add(point);
      if (part) part->bands[b].add(point);
    }
    if (estimate_ && b == estimated_band_ && observation.sense != PathSense::kExchanged &&
        ViewEstimate::concerns(contribution))
      add_to_estimate(contribution, observation, band);
  }
}

// The flat matrix is that of the same polygons without the terms of curvature.
void SweepSum::add_to_estimate(const Contribution& contribution, const Observation& observation,
                               const FrequencyBand& band) {
  const double k = estimate_->wavenumber();
  ScatteringMatrix smooth = one_way_at(points_, band, k);
  for (Complex& element : smooth) element /= observation.weight;
  if (!contribution.footprint()->curvature) {
    estimate_->add(contribution, smooth, smooth);
    return;
  }
  Contribution flat = contribution;
  std::get<Footprint>(flat.element).curvature.reset();
  Observation one_way = observation;
  one_way.sense = PathSense::kOneWay;
  one_way.weight = 1;
  estimate_->add(contribution, smooth, scattered(flat, one_way, k, estimated_node_));
}

void SweepSum::add(const SweepSum& other) {
  whole_.add(other.whole_);
  for (const auto& [part, sum] : other.parts_) parts_.try_emplace(part, plan_).first->second.add(sum);
  if (estimate_) estimate_->add(*other.estimate_);
}

Matrices SweepSum::matrices_of(const Sum& sum) const {
  Matrices all = sum.single;
  for (std::size_t b = 0; b < sum.bands.size(); ++b) {
    for (const std::size_t q : plan_.bands()[b].points) add_to(all[q], sum.bands[b].at(plan_.wavenumber(q)));
  }
  return all;
}

std::map<std::uint16_t, Matrices> SweepSum::parts() const {
  std::map<std::uint16_t, Matrices> all;
  for (const auto& [part, sum] : parts_) all.emplace(part, matrices_of(sum));
  return all;
}

}  // namespace seaglint
