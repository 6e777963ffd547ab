// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "sim/core/error.h"
#include "sim/core/random.h"

namespace seaglint {

namespace {

// The order in which the targets of one interval are numbered: a Fisher-Yates shuffle of its own key.
std::vector<int> target_order(std::uint64_t seed, std::size_t interval_number, std::size_t targets) {
  std::vector<int> order(targets);
  std::iota(order.begin(), order.end(), 0);
  Random random({seed, Stream::kTargetOrder, interval_number});
  for (std::size_t i = targets; i > 1; --i) {
    std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
  }
  return order;
}

}  // namespace

SamplePlan::SamplePlan(const Scenario& scenario)
    : seed_(scenario.seed),
      sea_states_(sea_states(scenario.sea).size()),
      realisations_(static_cast<std::size_t>(scenario.dataset.realisations_per_case)),
      views_(views(scenario.view).size()),
      intervals_(scenario.dataset.maps_per_case / std::max(1, scenario.dataset.realisations_per_case)),
      targets_(scenario.targets.size()),
      per_shard_(static_cast<std::size_t>(scenario.dataset.maps_per_shard)),
      spacing_s_(scenario.dataset.interval_spacing_s) {
  SEAGLINT_CHECK(realisations_ >= 1 && intervals_ >= 1 && per_shard_ >= 1 &&
                     scenario.dataset.maps_per_case % scenario.dataset.realisations_per_case == 0,
                 fmt::format("maps_per_case {}, realisations_per_case {}, maps_per_shard {}",
                             scenario.dataset.maps_per_case, realisations_, per_shard_));
}

std::size_t SamplePlan::size() const {
  return sea_states_ * realisations_ * views_ * static_cast<std::size_t>(intervals_) * targets_;
}

SampleAddress SamplePlan::address(std::size_t sample) const {
  SEAGLINT_CHECK(sample < size(), fmt::format("sample {} of {}", sample, size()));
  const std::size_t interval_number = sample / targets_;
  std::size_t rest = interval_number;
  const auto next_digit = [&rest](std::size_t base) {
    const std::size_t digit = rest % base;
    rest /= base;
    return static_cast<int>(digit);
  };
  SampleAddress address;
  address.target = target_order(seed_, interval_number, targets_)[sample % targets_];
  address.interval = next_digit(static_cast<std::size_t>(intervals_));
  address.view = next_digit(views_);
  address.realisation = next_digit(realisations_);
  address.sea_state = static_cast<int>(rest);
  return address;
}

std::size_t SamplePlan::sample(const SampleAddress& address) const {
  std::size_t number = static_cast<std::size_t>(address.sea_state);
  number = number * realisations_ + static_cast<std::size_t>(address.realisation);
  number = number * views_ + static_cast<std::size_t>(address.view);
  number = number * static_cast<std::size_t>(intervals_) + static_cast<std::size_t>(address.interval);
  const std::vector<int> order = target_order(seed_, number, targets_);
  const auto place = std::find(order.begin(), order.end(), address.target);
  SEAGLINT_CHECK(place != order.end(), fmt::format("target {} of {}", address.target, targets_));
  return number * targets_ + static_cast<std::size_t>(place - order.begin());
}

std::size_t SamplePlan::shards() const { return (size() + per_shard_ - 1) / per_shard_; }

ShardRange SamplePlan::shard(std::size_t index) const {
  SEAGLINT_CHECK(index < shards(), fmt::format("shard {} of {}", index, shards()));
  const std::size_t first = index * per_shard_;
  return {first, std::min(per_shard_, size() - first)};
}

std::uint64_t SamplePlan::sea_key(int sea_state, int realisation) const {
  return static_cast<std::uint64_t>(sea_state) * 1000000u + static_cast<std::uint64_t>(realisation);
}

std::int64_t SamplePlan::group(const SampleAddress& address) const {
  return static_cast<std::int64_t>(address.sea_state) * static_cast<std::int64_t>(realisations_) + address.realisation;
}

double SamplePlan::start_s(const SampleAddress& address) const { return address.interval * spacing_s_; }

double SamplePlan::last_start_s() const { return (intervals_ - 1) * spacing_s_; }

}  // namespace seaglint
