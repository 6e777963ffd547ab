// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/scatter_seas.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dispersion.h"
#include "sim/core/text/names.h"
#include "sim/scenario/cases.h"
#include "sim/scenario/files/error_list.h"
#include "sim/scenario/files/override.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/reader.h"

namespace seaglint {

namespace fs = std::filesystem;

std::shared_ptr<ScatterDiagram> find_scatter_diagram(const ScenarioDocument& document, ErrorList& errors) {
  const YamlNode* sea = document.root.find("sea");
  const YamlNode* node = sea == nullptr ? nullptr : sea->find(kScatterDiagram);
  if (node == nullptr || node->kind != YamlNode::Kind::kScalar) return nullptr;  // the reader refuses lists and maps
  std::shared_ptr<ScatterDiagram> diagram;
  errors.check({kScatterKey}, [&] {
    const fs::path folder = fs::path(document.file_name).parent_path();
    diagram = std::make_shared<ScatterDiagram>(
        read_scatter_diagram(find_file(node->text, folder, document.place_of(kScatterKey))));
  });
  for (const Alternatives& group : kAlternatives) {
    if (std::ranges::find(group.keys, kScatterDiagram) == std::end(group.keys)) continue;
    for (const std::string_view key : group.keys) {
      if (key.empty() || key == kScatterDiagram || sea->find(key) == nullptr) continue;
      errors.attempt({kScatterKey}, [&] {
        document.fail_at(fmt::format("sea.{}", key),
                         "not allowed here: sea.scatter_diagram gives wave heights and periods");
      });
      diagram = nullptr;
    }
  }
  return diagram;
}

namespace {

// True if the waves of any state of a sea break.
bool is_breaking(const SeaSpec& sea) {
  return std::ranges::any_of(sea_states(sea), [](const SeaState& state) {
    return state.significant_wave_height_m > breaking_height(2 * kPi / state.peak_period_s, state.depth_m);
  });
}

}  // namespace

void exclude_breaking(const ScenarioDocument& document, const std::vector<Variation>& variations,
                      ScatterDiagram& diagram) {
  ScenarioDocument of_sea = document;
  std::erase_if(of_sea.root.entries, [](const YamlEntry& entry) { return entry.key != "sea"; });
  std::vector<Variation> drawn = variations;
  std::erase_if(drawn, [](const Variation& variation) { return !variation.key_path.starts_with("sea."); });
  std::vector<std::vector<std::string>> choices(1);
  for (const Variation& variation : drawn) choices.front().push_back(variation.distribution.middle());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (const std::string& end : drawn[i].distribution.ends()) {
      choices.push_back(choices.front());
      choices.back()[i] = end;
    }
  }
  for (const Variation& of_pair : scatter_variations(std::make_shared<ScatterDiagram>(diagram)))
    drawn.push_back(of_pair);
  std::vector<bool> is_excluded;
  for (const ScatterCell& cell : diagram.cells) {
    const auto breaks = [&](std::vector<std::string> values) {
      values.push_back(fmt::format("{}", cell.highest_height_m));
      values.push_back(fmt::format("{}", cell.lowest_period_s));
      const ScenarioDocument steepest = with_values(of_sea, drawn, values);
      ErrorList errors(steepest);  // of keys that the whole scenario is refused for
      SeaSpec sea = read_fields(steepest, errors).sea;
      sea.propagation_deg = {0};
      return !errors.concerns("sea") && is_breaking(sea);
    };
    is_excluded.push_back(std::ranges::any_of(choices, breaks));
  }
  exclude_cells(diagram, is_excluded);
  if (diagram.cells.empty())
    document.fail_at(kScatterKey, "all of its seas break: their heights exceed L/7 of a period");
}

std::vector<SeaPair> extreme_pairs(const ScatterDiagram& diagram) {
  std::vector<SeaPair> pairs;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i) {  // by height, then by period
    const ScatterCell& cell = diagram.cells[i];
    const bool is_first = i == 0 || diagram.cells[i - 1].lowest_height_m != cell.lowest_height_m;
    const bool is_last = i + 1 == diagram.cells.size() || diagram.cells[i + 1].lowest_height_m != cell.lowest_height_m;
    if (is_first) pairs.push_back({cell.highest_height_m, cell.lowest_period_s});
    if (is_last) pairs.push_back({cell.highest_height_m, cell.highest_period_s});
    if (is_last) pairs.push_back({cell.lowest_height_m, cell.highest_period_s});
  }
  return pairs;
}

}  // namespace seaglint
