// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/learnable.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "classify/dataset/directory/planned_record.h"
#include "classify/model/division.h"
#include "classify/model/study.h"
#include "sim/core/process/error.h"
#include "tools/pipeline/train.h"

namespace seaglint {

namespace {

std::vector<RowGroup> planned_seas(const SamplePlan& plan) {
  std::vector<RowGroup> seas;
  for (std::size_t sample = 0; sample < plan.size(); ++sample) {
    const SampleAddress address = plan.sea_address(sample);
    seas.push_back({plan.group(address), address.sea_state});
  }
  return seas;
}

// Calls check(), whose errors get the place of a key.
template <class Check>
auto at_key(const Scenario& scenario, const std::string& key, Check&& check) {
  try {
    return check();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", place_of(scenario, key), error.what()));
  }
}

// Whether the values of a column are known before the maps: those of the scenario, and drawn ones; not the number of
// the data set.
bool is_planned(const std::string& name) {
  if (name == "data_set") return false;
  const auto is_name = [&](const SampleColumn& column) { return name == column.name; };
  return std::ranges::any_of(planned_columns(), is_name) || std::ranges::none_of(sample_columns(), is_name);
}

}  // namespace

void check_division(const Scenario& scenario, const SamplePlan& plan) {
  const SplitSpec& split = scenario.learning.split;
  const DivisionRequest request = division_request(split);
  if (request.is_default()) return;
  std::vector<DataRow> rows;
  std::vector<int> labels;
  for (std::size_t sample = 0; sample < plan.size(); ++sample) {
    rows.push_back({0, planned_record(scenario, plan, sample)});
    labels.push_back(static_cast<int>(rows.back().record.label));
  }
  bool all_planned = is_planned(split.by);
  at_key(scenario, "learning.split.by", [&] { return column_of(rows, split.by); });
  for (const HoldOutSpec& held : split.hold_out) {
    at_key(scenario, "learning.split.hold_out." + held.column, [&] { return column_of(rows, held.column); });
    all_planned = all_planned && is_planned(held.column);
  }
  if (!all_planned) return;
  at_key(scenario, "learning.split", [&] {
    const Division division = make_division(rows, planned_seas(plan), labels, request);
    require_classes(division, labels, scenario);
    check_splits(division, scenario.learning, scenario.dataset.train_fraction, scenario.seed);
  });
}

void check_learnable(const Scenario& scenario, const SamplePlan& plan) {
  const std::vector<std::string>& classes = scenario.dataset.classes;
  for (int label = 0; label < static_cast<int>(classes.size()); ++label) {
    const bool has = std::ranges::any_of(
        plan.classes(), [&](int target) { return scenario.targets[static_cast<std::size_t>(target)].label == label; });
    if (has) continue;
    if (classes.size() == 2) throw InputError("targets: learning needs a target of label 0 and one of label 1");
    throw InputError(fmt::format("{}: learning needs a target of every class, also of '{}' (label {})",
                                 place_of(scenario, "dataset.classes"), classes[static_cast<std::size_t>(label)],
                                 label));
  }
  if (division_request(scenario.learning.split).is_default()) {
    check_splits(division_by_sea(planned_seas(plan)), scenario.learning, scenario.dataset.train_fraction,
                 scenario.seed);
  }
  check_division(scenario, plan);
}

}  // namespace seaglint
