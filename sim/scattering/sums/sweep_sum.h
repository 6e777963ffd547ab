// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sums of points over the frequencies of a sweep.

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/sums/view_estimate.h"

namespace seaglint {

// Largest phase over half of the band between a point and the centre of its cell, rad. Together with that of a point's
// own amplitude, at most a tenth, the interpolation error of a point is below 9e-5 (FrequencyBand::weights).
inline constexpr double kCellHalfPhase = 0.25;

// Sum of many points over a band: their phases are collected in cells of path length, in which the sum varies so slowly
// with k that its values at the nodes of the band determine it. The cost per point does not depend on the number of
// frequencies, which need not be equidistant.
class BandSum {
 public:
  explicit BandSum(const FrequencyBand& band);

  // A point at the nodes of the band.
  void add(const Point& point);
  // Adds a sum over the same band, cell by cell.
  void add(const BandSum& other);

  // hh, hv, vh, vv at a wavenumber of the band, m.
  ScatteringMatrix at(double k) const;

 private:
  // Values at the nodes of the points in one cell, relative to the phase of its centre: real and imaginary parts.
  struct Cell {
    std::int64_t place = 0;  // its centre is at place * cell_m_
    std::array<std::array<double, 8>, kBandNodes> values{};
  };
  Cell& cell(std::int64_t place);

  FrequencyBand band_;
  double cell_m_;                     // 0 for a single wavenumber: one cell
  std::vector<Cell> cells_;           // in the order of their first points
  std::vector<std::int32_t> number_;  // of the cell at a place, from first_ on; -1: none yet
  std::int64_t first_ = 0;
};

// Sum of the contributions of one pair of directions over the frequencies of a sweep, `by_part` also of every part of
// the mesh (ContributionSource). `estimated`: frequency of the view's estimate. Neither changes a matrix of the whole.
// The plan must outlive the object.
class SweepSum {
 public:
  explicit SweepSum(const SweepPlan& plan, std::optional<std::size_t> estimated = std::nullopt, bool by_part = false);

  // The contributions of one beam or one edge. Reciprocal ones (PathSense::kExchanged) have no estimate.
  void add(std::span<const Contribution> contributions, const Observation& observation);
  void add(const SweepSum& other);

  Matrices matrices() const { return matrices_of(whole_); }
  std::map<std::uint16_t, Matrices> parts() const;
  const std::optional<ViewEstimate>& estimate() const { return estimate_; }

 private:
  struct Sum {
    explicit Sum(const SweepPlan& plan);
    void add(const Sum& other);

    std::vector<BandSum> bands;  // of the plan's bands
    Matrices single;             // of contributions that oscillate over their band, per frequency
  };
  Matrices matrices_of(const Sum& sum) const;
  void add(const Contribution& contribution, const Observation& observation);
  void add_to_estimate(const Contribution& contribution, const Observation& observation, const FrequencyBand& band);

  const SweepPlan& plan_;
  bool by_part_;
  Sum whole_;
  std::map<std::uint16_t, Sum> parts_;
  std::vector<Point> points_;  // of one contribution
  std::optional<ViewEstimate> estimate_;
  std::size_t estimated_band_ = 0, estimated_node_ = 0;  // of the plan: that with its frequency, and its nearest node
};

// Adds the sums of chunks in the order of the chunks, whichever is complete first, so that bits do not depend on
// threads; those that wait for an earlier one are kept.
template <class Sum>
class OrderedSum {
 public:
  OrderedSum(Sum empty, std::size_t chunks)
      : empty_(empty), sum_(std::move(empty)), chunks_(chunks), complete_(chunks) {}

  // The sum of one chunk, filled by one thread; complete() takes it, also where it was never filled.
  Sum& chunk(std::size_t chunk) {
    std::optional<Sum>& own = chunks_[chunk];
    if (!own) own.emplace(empty_);
    return *own;
  }
  void complete(std::size_t chunk) {
    const std::scoped_lock lock(mutex_);
    complete_[chunk] = true;
    for (; next_ < chunks_.size() && complete_[next_]; ++next_) {
      if (chunks_[next_]) sum_.add(*chunks_[next_]);
      chunks_[next_].reset();
    }
  }
  const Sum& sum() const { return sum_; }

 private:
  Sum empty_, sum_;
  std::vector<std::optional<Sum>> chunks_;
  std::vector<bool> complete_;
  std::size_t next_ = 0;  // the chunk that is added next
  std::mutex mutex_;      // of sum_, complete_ and next_
};

}  // namespace seaglint
