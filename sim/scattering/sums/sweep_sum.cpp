// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/sweep_sum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/scattering/points/edge_decomposition.h"
#include "sim/scattering/points/finite_range.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/radiation/curved_footprint.h"

namespace seaglint {
namespace {

void add_to(std::array<Complex, 4>& sum, const std::array<Complex, 4>& term) {
  for (int i = 0; i < 4; ++i) sum[i] += term[i];
}

}  // namespace

SweepSum::SweepSum(const SweepPlan& plan, const BistaticGeometry& geometry, const RadarRange& radar, double spread,
                   std::optional<std::size_t> estimated)
    : plan_(plan), geometry_(geometry), radar_(radar), spread_(spread), direct_(plan.size()) {
  for (const SweepPlan::Band& of : plan.bands()) bands_.emplace_back(of.band);
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

void SweepSum::add(std::span<const Footprint> footprints) {
  for (const Footprint& footprint : footprints) {
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const auto& [band, first_node, frequencies] = plan_.bands()[b];
      const bool with_estimate = estimate_ && b == estimated_band_ && ViewEstimate::concerns(footprint);
      if (in_closed_form(band)) {
        const std::array<Complex, 4> matrix = scattered(footprint, band.centre(), first_node);
        add_to(direct_[frequencies.front()], matrix);
        if (with_estimate) estimate(footprint, matrix);
        continue;
      }
      points_.clear();
      if (radar_.range_m > 0) {
        decompose_at_range(footprint, geometry_, band, radar_, points_);
      } else {
        decompose(footprint, geometry_.transmit, band, 0, points_);
      }
      std::vector<std::array<Complex, 4>> patterns;
      if (!footprint.patterns.empty()) {
        const auto first = footprint.patterns.begin() + static_cast<std::ptrdiff_t>(first_node);
        patterns.assign(first, first + static_cast<std::ptrdiff_t>(band.nodes().size()));
      }
      add_points(patterns, bands_[b]);
      if (with_estimate) estimate(footprint, at_estimate(band, patterns));
    }
  }
  if (estimate_) estimate_->end_beam();
}

// The flat matrix is that of the same polygons without the terms of curvature.
void SweepSum::estimate(const Footprint& footprint, const std::array<Complex, 4>& matrix) {
  if (!footprint.curvature) {
    estimate_->add(footprint, matrix, matrix);
    return;
  }
  Footprint flat = footprint;
  flat.curvature.reset();
  const double k = estimate_->wavenumber();
  if (radar_.range_m <= 0) {
    estimate_->add(footprint, matrix, scattered(flat, k, estimated_node_));
    return;
  }
  if (!flat.patterns.empty()) flat.pattern = flat.patterns[estimated_node_];
  const FrequencyBand band(k);
  points_.clear();
  decompose_at_range(flat, geometry_, band, radar_, points_);
  BandSum sum(band);
  for (const BandPoint& point : points_) sum.add(point);
  estimate_->add(footprint, matrix, sum.at(k));
}

std::array<Complex, 4> SweepSum::at_estimate(const FrequencyBand& band,
                                             std::span<const std::array<Complex, 4>> patterns) const {
  const double k = estimate_->wavenumber();
  const std::array<double, kBandNodes> weights = band.weights(k);
  std::array<Complex, 4> sum{};
  for (const BandPoint& point : points_) {
    const Complex phase = std::polar(1.0, k * point.psi);
    for (std::size_t n = 0; n < band.nodes().size(); ++n) {
      const Complex value = weights[n] * phase * point.amplitude[n];
      const std::array<Complex, 4>& pattern = patterns.empty() ? point.pattern : patterns[n];
      for (std::size_t i = 0; i < 4; ++i) sum[i] += value * pattern[i];
    }
  }
  return sum;
}

void SweepSum::add(std::span<const EdgeContribution> contributions) {
  for (const EdgeContribution& contribution : contributions) {
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const auto& [band, first_node, frequencies] = plan_.bands()[b];
      if (in_closed_form(band)) {
        add_to(direct_[frequencies.front()], scattered(contribution, band.centre()));
      } else if (varies_slowly(contribution, band)) {
        decompose_edge(contribution, band, bands_[b]);
      } else {
        for (const std::size_t q : frequencies) add_to(direct_[q], at(contribution, plan_.wavenumber(q)));
      }
    }
  }
}

void SweepSum::add(const SweepSum& other) {
  for (std::size_t b = 0; b < bands_.size(); ++b) bands_[b].add(other.bands_[b]);
  for (std::size_t q = 0; q < direct_.size(); ++q) add_to(direct_[q], other.direct_[q]);
  if (estimate_) estimate_->add(*other.estimate_);
}

Matrices SweepSum::matrices() const {
  Matrices all(plan_.size());
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const auto& [band, first_node, frequencies] = plan_.bands()[b];
    for (const std::size_t q : frequencies) {
      all[q] = direct_[band.nodes().size() == 1 ? frequencies.front() : q];
      add_to(all[q], bands_[b].at(plan_.wavenumber(q)));
    }
  }
  return all;
}

std::array<Complex, 4> SweepSum::at(const EdgeContribution& contribution, double k) {
  if (radar_.range_m <= 0) return scattered(contribution, k);
  const FrequencyBand band(k);
  BandSum sum(band);
  decompose_edge(contribution, band, sum);
  return sum.at(k);
}

void SweepSum::decompose_edge(const EdgeContribution& contribution, const FrequencyBand& band, BandSum& sum) {
  points_.clear();
  decompose(contribution, band, spread_, points_);
  if (radar_.range_m > 0) apply_wavefront_curvature(points_, geometry_, radar_);
  std::array<std::array<Complex, 4>, kBandNodes> patterns;
  for (std::size_t n = 0; n < band.nodes().size(); ++n) patterns[n] = contribution.pattern.at(band.nodes()[n]);
  add_points(patterns, sum);
}

void SweepSum::add_points(std::span<const std::array<Complex, 4>> patterns, BandSum& sum) {
  for (const BandPoint& point : points_) sum.add(point, patterns);
}

OrderedSweepSum::OrderedSweepSum(SweepSum empty, std::size_t chunks)
    : empty_(empty), sum_(std::move(empty)), chunks_(chunks), complete_(chunks) {}

SweepSum& OrderedSweepSum::chunk(std::size_t chunk) {
  std::optional<SweepSum>& own = chunks_[chunk];
  if (!own) own.emplace(empty_);
  return *own;
}

void OrderedSweepSum::complete(std::size_t chunk) {
  const std::scoped_lock lock(mutex_);
  complete_[chunk] = true;
  for (; next_ < chunks_.size() && complete_[next_]; ++next_) {
    if (chunks_[next_]) sum_.add(*chunks_[next_]);
    chunks_[next_].reset();
  }
}

}  // namespace seaglint
