// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/response/sweep_sum.h"

#include <utility>

#include "sim/scattering/edges/edge_decomposition.h"
#include "sim/scattering/surfaces/curved_footprint.h"
#include "sim/scattering/surfaces/finite_range.h"
#include "sim/scattering/surfaces/phase_integral.h"

namespace seaglint {
namespace {

void add_to(std::array<Complex, 4>& sum, const std::array<Complex, 4>& term) {
  for (int i = 0; i < 4; ++i) sum[i] += term[i];
}

}  // namespace

SweepSum::SweepSum(const SweepPlan& plan, const BistaticGeometry& geometry, const RadarRange& radar, double spread)
    : plan_(plan), geometry_(geometry), radar_(radar), spread_(spread), direct_(plan.size()) {
  for (const SweepPlan::Band& of : plan.bands()) bands_.emplace_back(of.band);
}

void SweepSum::add(std::span<const Footprint> footprints) {
  for (const Footprint& footprint : footprints) {
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const auto& [band, first_node, frequencies] = plan_.bands()[b];
      if (in_closed_form(band)) {
        add_to(direct_[frequencies.front()], scattered(footprint, band.centre(), first_node));
        continue;
      }
      points_.clear();
      if (radar_.range_m > 0) {
        decompose_at_range(footprint, geometry_, band, radar_, points_);
      } else {
        decompose(footprint, geometry_.transmit, band, 0, points_);
      }
      if (footprint.patterns.empty()) {
        add_points({}, bands_[b]);
        continue;
      }
      std::array<std::array<Complex, 4>, kBandNodes> patterns;
      for (std::size_t n = 0; n < band.nodes().size(); ++n) patterns[n] = footprint.patterns[first_node + n];
      add_points(patterns, bands_[b]);
    }
  }
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
