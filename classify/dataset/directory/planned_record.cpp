// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/planned_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "sim/core/numbers/random.h"
#include "sim/core/text/number.h"
#include "sim/motion/target_motion.h"
#include "sim/scenario/layout/layout.h"

namespace seaglint {

DrawnKeys drawn_keys(const Scenario& scenario) {
  DrawnKeys keys;
  for (const Variation& variation : scenario.variations)
    (variation.distribution.is_numeric() ? keys.numbers : keys.words).push_back(variation.key_path);
  return keys;
}

namespace {

// 53 bits, which a double holds, of the random numbers that give the sea its phases.
std::int64_t sea_id(std::uint64_t seed, std::uint64_t sea_key) {
  return static_cast<std::int64_t>(Random({seed, Stream::kWavePhase, sea_key}).bits() >> 11);
}

}  // namespace

SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample) {
  return planned_record(scenario, plan, sample, plan.address(sample));
}

SampleRecord planned_record(const Scenario& scenario, const SamplePlan& plan, std::size_t sample,
                            const SampleAddress& at) {
  const Scenario drawn = plan.drawn(scenario, at);
  const TargetSpec& target = drawn.targets[static_cast<std::size_t>(at.target)];
  const SeaState state = plan.sea_state(at);
  const View view = plan.view(at);
  std::size_t first_body = 0;  // bodies are numbered over all targets but parts, in order
  for (const int t : plan.classes()) {
    if (t == at.target) break;
    const TargetSpec& before = drawn.targets[static_cast<std::size_t>(t)];
    if (before.points.empty()) first_body += body_count(before.layout);
  }

  SampleRecord record;
  record.sample = static_cast<std::int64_t>(sample);
  record.label = target.label;
  record.target = at.target;
  record.target_name = target.name;
  record.layout = layout_name(target.layout);
  record.bodies = static_cast<std::int64_t>(body_count(target.layout));
  record.group = plan.group(at);
  record.sea_state = at.sea_state;
  record.significant_wave_height_m = state.significant_wave_height_m;
  record.peak_period_s = state.peak_period_s;
  record.gamma = state.gamma;
  record.propagation_deg = state.propagation_deg;
  record.swell_wave_height_m = state.swell.significant_wave_height_m;
  record.depth_m = std::isinf(state.depth_m) ? 0 : state.depth_m;
  record.view = at.view;
  record.azimuth_deg = view.azimuth_deg;
  record.elevation_deg = view.elevation_deg;
  record.realisation = at.realisation;
  record.interval = at.interval;
  record.start_s = plan.start_s(at);
  record.seed = static_cast<std::int64_t>(scenario.seed);
  const std::uint64_t sea = sea_key(static_cast<std::size_t>(at.sea_state), static_cast<std::size_t>(at.realisation));
  record.sea_key = static_cast<std::int64_t>(sea);
  record.sea_id = sea_id(scenario.seed, sea);
  record.first_motion_key = static_cast<std::int64_t>(body_index(sea, first_body));
  record.radar_key = static_cast<std::int64_t>(sample);
  for (const Variation& variation : scenario.variations) {
    const std::string value = drawn_value(variation, scenario.seed, plan.draw_place(at));
    if (variation.distribution.is_numeric()) {
      record.drawn_numbers.push_back({variation.key_path, parse_number(value).value()});
    } else {
      record.drawn_words.push_back({variation.key_path, value});
    }
  }
  return record;
}

std::span<const SampleColumn> planned_columns() {
  const std::span<const SampleColumn> all = sample_columns();
  const auto last = std::find_if(
      all.begin(), all.end(), [](const SampleColumn& column) { return std::string_view(column.name) == "radar_key"; });
  return all.first(static_cast<std::size_t>(last - all.begin()) + 1);
}

std::vector<std::string> record_mismatches(const SampleRecord& record, const SampleRecord& planned) {
  std::vector<std::string> found;
  for (const SampleColumn& column : planned_columns()) {
    std::visit(
        [&](auto member) {
          if (record.*member != planned.*member)
            found.push_back(fmt::format("{} {}, by the scenario {}", column.name, record.*member, planned.*member));
        },
        column.member);
  }
  if (!same_drawn(record, planned)) found.emplace_back("the drawn values are not those of the scenario");
  return found;
}

}  // namespace seaglint
