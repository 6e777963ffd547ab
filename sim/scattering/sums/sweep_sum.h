// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sum of contributions over the frequencies of a sweep, as points over its bands.

#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/scattering/observation/sweep_plan.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/sums/band_sum.h"
#include "sim/scattering/sums/view_estimate.h"

namespace seaglint {

// Of one pair of directions. `estimated`: frequency of the view's estimate, which changes no matrix. The plan must
// outlive the object.
class SweepSum {
 public:
  explicit SweepSum(const SweepPlan& plan, std::optional<std::size_t> estimated = std::nullopt);

  // The contributions of one beam or one edge. Reciprocal ones (PathSense::kExchanged) have no estimate.
  void add(std::span<const Contribution> contributions, const Observation& observation);
  void add(const SweepSum& other);

  Matrices matrices() const;
  const std::optional<ViewEstimate>& estimate() const { return estimate_; }

 private:
  void add(const Contribution& contribution, const Observation& observation);
  void add_to_estimate(const Contribution& contribution, const Observation& observation, const FrequencyBand& band);

  const SweepPlan& plan_;
  std::vector<BandSum> bands_;  // of the plan's bands
  Matrices single_;             // of contributions that oscillate over their band, per frequency
  std::vector<Point> points_;   // of one contribution
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
