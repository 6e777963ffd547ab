// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/class_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/page/html.h"
#include "tools/pipeline/metrics.h"

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

std::size_t confused(const nlohmann::ordered_json& scores, std::size_t classes, std::size_t truth,
                     std::size_t decision) {
  return std::next(scores.at("confusion").begin(), static_cast<std::ptrdiff_t>(truth * classes + decision))
      ->get<std::size_t>();
}

std::string confusion_table(const nlohmann::ordered_json& metrics, const ClassNames& classes) {
  std::vector<std::vector<std::string>> rows{{"truth"}};
  for (const std::string& name : classes) rows.front().push_back("declared " + escape_html(name));
  for (std::size_t truth = 0; truth < classes.size(); ++truth) {
    rows.push_back({escape_html(classes[truth])});
    for (std::size_t decision = 0; decision < classes.size(); ++decision)
      rows.back().push_back(
          fmt::format("{}", confused(metrics.at("fused").at("group"), classes.size(), truth, decision)));
  }
  return fmt::format("<h3>Decisions by class, fused features, split {}</h3>\n", division_words(metrics).by) +
         html_table(rows);
}

std::string by_class(const ClassNames& classes, const std::function<std::string(int label)>& value) {
  std::string text;
  for (int label = static_cast<int>(classes.size()) - 1; label >= 0; --label) {
    text += text.empty() ? "" : label > 0 ? ", " : " and ";
    text += fmt::format("{} ({})", value(label), escape_html(classes[static_cast<std::size_t>(label)]));
  }
  return text;
}

}  // namespace seaglint
