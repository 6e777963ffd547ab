// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/class_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace seaglint {

ClassNames class_names(const Scenario& scenario) {
  constexpr std::size_t kMostNames = 3;
  if (scenario.dataset.classes != default_classes()) return scenario.dataset.classes;
  ClassNames classes;
  for (const int label : {0, 1}) {
    std::vector<std::string> names;
    for (const TargetSpec& target : scenario.targets)
      if (target.role == TargetRole::kClass && target.label == label) names.push_back(target.name);
    classes.push_back(names.empty() || names.size() > kMostNames ? fmt::format("label {}", label)
                                                                 : fmt::format("{}", fmt::join(names, ", ")));
  }
  return classes;
}

}  // namespace seaglint
