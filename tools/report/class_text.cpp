// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/class_text.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/page/html.h"

namespace seaglint {

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
  return "<h3>Decisions by class, fused features, split by sea</h3>\n" + html_table(rows);
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
