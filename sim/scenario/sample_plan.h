// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Enumeration of the samples of a scenario: sea, view, target and interval of each, and its shard. One sample is one
// map of one coherent interval, or of several looks. Definitions of case, realisation and group:
// classify/dataset/README.md.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/scenario/scenario.h"

namespace seaglint {

// Indices of a sample in the sweeps of the scenario, all zero-based.
struct SampleAddress {
  int sea_state = 0;    // index into the plan's sea_states()
  int realisation = 0;  // 0..realisations_per_case-1, of the sea state
  int view = 0;         // index into the plan's views()
  int interval = 0;     // 0..maps_per_case/realisations_per_case/maps_per_interval-1, of the realisation
  int target = 0;       // index into scenario.targets, of one with role: class
  int clutter = 0;      // 0..maps_per_interval-1: map of the interval, with clutter and noise of its own
  int look = 0;         // 0..looks.count-1, no index of the sample: interval of it

  bool operator==(const SampleAddress&) const = default;
};

// Random index of a sea realisation: 1000000 sea_state + realisation, both zero-based, realisation below 1000000.
// Common to both classes and all views.
std::uint64_t sea_key(std::size_t sea_state, std::size_t realisation);

struct ShardRange {
  std::size_t first = 0;  // sample index
  std::size_t count = 0;
};

// Samples are numbered with the sea state slowest, then the realisation, so that samples of one sea and its motions are
// adjacent. Within a realisation views, intervals and targets are in random order (stream kTargetOrder), so that
// neither the number of a sample nor the labels of adjacent samples carry information about its label. Maps of one
// interval and target are adjacent.
class SamplePlan {
 public:
  explicit SamplePlan(const Scenario& scenario);

  std::size_t size() const;
  // All of the sweeps; drawn keys have the middles of their distributions.
  const std::vector<SeaState>& sea_states() const { return sea_states_; }
  const std::vector<View>& views() const { return views_; }
  // Indices into scenario.targets of those that have samples: all but parts.
  const std::vector<int>& classes() const { return classes_; }
  // Those of a sample, with its drawn values.
  SeaState sea_state(const SampleAddress& at) const;
  View view(const SampleAddress& at) const;
  // Where the values of a sample are drawn.
  DrawPlace draw_place(const SampleAddress& at) const;
  // The scenario of a sample: `scenario`, which the plan is of, with its drawn values.
  Scenario drawn(const Scenario& scenario, const SampleAddress& at) const;
  SampleAddress address(std::size_t sample) const;         // sample < size()
  std::size_t sample(const SampleAddress& address) const;  // inverse of address()
  // Sea state and realisation of a sample, other indices zero; sufficient for group() and cheaper than address().
  SampleAddress sea_address(std::size_t sample) const;

  std::size_t shards() const;
  ShardRange shard(std::size_t index) const;  // the last shard may have fewer samples

  int intervals() const { return intervals_; }
  int maps_per_interval() const { return static_cast<int>(per_interval_); }
  // First sample of the same interval and target: the random index of their hop code.
  std::size_t first_of_interval(std::size_t sample) const { return sample - sample % per_interval_; }
  // One group = one sea realisation, numbered from 0 without gaps.
  std::int64_t group(const SampleAddress& address) const;
  double start_s(const SampleAddress& address) const;  // of the look within the realisation
  // Start of the last interval of a realisation, of its first look, s.
  double last_start_s() const;
  int looks() const { return looks_.count; }
  // Random index of a look of a sample: that of the sample for the first one.
  std::uint64_t look_key(std::size_t sample, int look) const;

 private:
  // The shuffled order of the intervals of one realisation: entry = (view intervals + interval) classes + class.
  std::vector<std::uint32_t> order(std::size_t realisation_number) const;

  std::uint64_t seed_ = 0;
  std::shared_ptr<const Scenario> varied_;  // with variations; null without
  std::vector<SeaState> sea_states_;
  std::size_t realisations_ = 0;
  std::vector<View> views_;
  int intervals_ = 0;
  std::vector<int> classes_;
  std::size_t per_interval_ = 1;     // samples of an interval and class
  std::size_t per_realisation_ = 0;  // intervals and classes
  std::size_t per_shard_ = 1;
  double spacing_s_ = 0;
  LookSpec looks_;
};

}  // namespace seaglint
