// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/sample_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {

std::uint64_t sea_key(std::size_t sea_state, std::size_t realisation) {
  constexpr std::uint64_t kMaxRealisations = 1000000;
  SEAGLINT_CHECK(realisation < kMaxRealisations, fmt::format("realisation {}", realisation));
  return sea_state * kMaxRealisations + realisation;
}

namespace {

std::vector<int> classes_of(const Scenario& scenario) {
  std::vector<int> classes;
  for (std::size_t t = 0; t < scenario.targets.size(); ++t) {
    if (scenario.targets[t].role == TargetRole::kClass) classes.push_back(static_cast<int>(t));
  }
  return classes;
}

}  // namespace

SamplePlan::SamplePlan(const Scenario& scenario)
    : seed_(scenario.seed),
      varied_(scenario.variations.empty() ? nullptr : std::make_shared<const Scenario>(scenario)),
      sea_states_(seaglint::sea_states(scenario.sea)),
      realisations_(static_cast<std::size_t>(scenario.dataset.realisations_per_case)),
      views_(seaglint::views(scenario.view)),
      intervals_(scenario.dataset.maps_per_case / std::max(1, scenario.dataset.realisations_per_case) /
                 std::max(1, scenario.dataset.maps_per_interval)),
      classes_(classes_of(scenario)),
      per_interval_(static_cast<std::size_t>(std::max(1, scenario.dataset.maps_per_interval))),
      per_realisation_(views_.size() * static_cast<std::size_t>(intervals_) * classes_.size()),
      per_shard_(static_cast<std::size_t>(scenario.dataset.maps_per_shard)),
      spacing_s_(scenario.dataset.interval_spacing_s),
      looks_(scenario.looks) {
  SEAGLINT_CHECK(realisations_ >= 1 && intervals_ >= 1 && per_shard_ >= 1 &&
                     scenario.dataset.maps_per_case ==
                         intervals_ * scenario.dataset.realisations_per_case * scenario.dataset.maps_per_interval,
                 fmt::format("maps_per_case {}, realisations_per_case {}, maps_per_shard {}",
                             scenario.dataset.maps_per_case, realisations_, per_shard_));
}

std::size_t SamplePlan::size() const { return sea_states_.size() * realisations_ * per_realisation_ * per_interval_; }

// Shuffled with a key per realisation.
std::vector<std::uint32_t> SamplePlan::order(std::size_t realisation_number) const {
  std::vector<std::uint32_t> order(per_realisation_);
  std::iota(order.begin(), order.end(), 0u);
  Random random({seed_, Stream::kTargetOrder, realisation_number});
  shuffle(order, random);
  return order;
}

SampleAddress SamplePlan::sea_address(std::size_t sample) const {
  SEAGLINT_CHECK(sample < size(), fmt::format("sample {} of {}", sample, size()));
  const std::size_t realisation_number = sample / per_interval_ / per_realisation_;
  SampleAddress address;
  address.realisation = static_cast<int>(realisation_number % realisations_);
  address.sea_state = static_cast<int>(realisation_number / realisations_);
  return address;
}

SampleAddress SamplePlan::address(std::size_t sample) const {
  SampleAddress address = sea_address(sample);
  const std::size_t number = sample / per_interval_;
  const std::size_t place = order(number / per_realisation_)[number % per_realisation_];
  const std::size_t intervals = static_cast<std::size_t>(intervals_);
  const std::size_t classes = classes_.size();
  address.target = classes_[place % classes];
  address.interval = static_cast<int>(place / classes % intervals);
  address.view = static_cast<int>(place / classes / intervals);
  address.clutter = static_cast<int>(sample % per_interval_);
  return address;
}

std::size_t SamplePlan::sample(const SampleAddress& address) const {
  const std::size_t realisation_number =
      static_cast<std::size_t>(address.sea_state) * realisations_ + static_cast<std::size_t>(address.realisation);
  const std::size_t view_interval = static_cast<std::size_t>(address.view) * static_cast<std::size_t>(intervals_) +
                                    static_cast<std::size_t>(address.interval);
  const auto which = static_cast<std::size_t>(std::ranges::find(classes_, address.target) - classes_.begin());
  SEAGLINT_CHECK(which < classes_.size(), fmt::format("target {} has no samples", address.target));
  const std::size_t place = view_interval * classes_.size() + which;
  const std::vector<std::uint32_t> order = this->order(realisation_number);
  const auto found = std::find(order.begin(), order.end(), place);
  SEAGLINT_CHECK(found != order.end(), fmt::format("place {} of {}", place, per_realisation_));
  const std::size_t interval_number =
      realisation_number * per_realisation_ + static_cast<std::size_t>(found - order.begin());
  return interval_number * per_interval_ + static_cast<std::size_t>(address.clutter);
}

DrawPlace SamplePlan::draw_place(const SampleAddress& at) const {
  const auto observation =
      (static_cast<std::uint64_t>(group(at)) * views_.size() + static_cast<std::uint64_t>(at.view)) *
          static_cast<std::uint64_t>(intervals_) +
      static_cast<std::uint64_t>(at.interval);
  return {sea_key(static_cast<std::size_t>(at.sea_state), static_cast<std::size_t>(at.realisation)), observation,
          observation * per_interval_ + static_cast<std::uint64_t>(at.clutter)};
}

Scenario SamplePlan::drawn(const Scenario& scenario, const SampleAddress& at) const {
  return drawn_scenario(scenario, draw_place(at));
}

SeaState SamplePlan::sea_state(const SampleAddress& at) const {
  const auto index = static_cast<std::size_t>(at.sea_state);
  return varied_ ? seaglint::sea_states(drawn(*varied_, at).sea)[index] : sea_states_[index];
}

View SamplePlan::view(const SampleAddress& at) const {
  const auto index = static_cast<std::size_t>(at.view);
  return varied_ ? seaglint::views(drawn(*varied_, at).view)[index] : views_[index];
}

std::size_t SamplePlan::shards() const { return (size() + per_shard_ - 1) / per_shard_; }

ShardRange SamplePlan::shard(std::size_t index) const {
  SEAGLINT_CHECK(index < shards(), fmt::format("shard {} of {}", index, shards()));
  const std::size_t first = index * per_shard_;
  return {first, std::min(per_shard_, size() - first)};
}

std::int64_t SamplePlan::group(const SampleAddress& address) const {
  return static_cast<std::int64_t>(address.sea_state) * static_cast<std::int64_t>(realisations_) + address.realisation;
}

double SamplePlan::start_s(const SampleAddress& address) const {
  const double first_s = address.interval * spacing_s_;
  if (address.look == 0) return first_s;
  return first_s + address.look * (varied_ ? drawn(*varied_, address).looks : looks_).spacing_s;
}

std::uint64_t SamplePlan::look_key(std::size_t sample, int look) const {
  // Beyond all samples; odd, so that looks take different codes of a file.
  constexpr std::uint64_t kStride = (std::uint64_t{1} << 40) + 1;
  SEAGLINT_CHECK(sample < kStride && look >= 0 && look < looks_.count,
                 fmt::format("look {} of sample {}", look, sample));
  return sample + static_cast<std::uint64_t>(look) * kStride;
}

double SamplePlan::last_start_s() const { return (intervals_ - 1) * spacing_s_; }

}  // namespace seaglint
