// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/probe_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/page/html.h"
#include "tools/pipeline/metrics.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

// Those of clutter and noise whose level does not follow the target's; empty if both do. The target's level then
// determines which of its centres exceed the threshold, and so affects the features.
std::string not_scaled(const ClutterSpec& clutter) {
  const bool sea = clutter.enabled && clutter.level == ClutterLevel::kNrl;
  const bool receiver = clutter.noise_level == NoiseLevel::kThermal;
  if (sea && receiver) return "Clutter and receiver noise are";
  if (sea) return "The clutter is";
  return receiver ? "The receiver’s noise is" : "";
}

// Interpretation of a probe's accuracy by its kind.
std::string reading(const std::string& kind, bool chance, bool level_seen) {
  if (kind == "blind") return chance ? "as chance" : "<b>away from chance: look for a leak</b>";
  if (kind == "feature") {
    if (chance) return "chance: does not tell by itself";
    return level_seen ? "tells by itself; level has a part in what is found" : "tells by itself";
  }
  if (kind == "scale") {
    if (chance) return "chance: level does not tell";
    return level_seen ? "level tells the class; features see it by what is found"
                      : "level tells the class; no feature uses it";
  }
  if (chance) return "chance: does not tell";
  return kind == "ratio" ? "tells the class: it decides what is found" : "tells by shape or strength of the target";
}

}  // namespace

std::string probes_table(const ordered_json& metrics, const Scenario& scenario) {
  // A benchmark has no random split.
  const bool has_random =
      std::ranges::any_of(metrics.at("probes"), [](const ordered_json& probe) { return probe.contains("random"); });
  std::vector<std::vector<std::string>> rows{{"probe", "what it is"}};
  if (has_random) rows.front().push_back("random split");
  rows.front().push_back("split " + division_words(metrics).by);
  rows.front().push_back("reading");
  const bool level_seen = !not_scaled(scenario.clutter).empty();
  for (const auto& entry : metrics.at("probes")) {
    rows.push_back(
        {escape_html(entry.at("name").get<std::string>()), escape_html(entry.at("meaning").get<std::string>())});
    if (has_random) rows.back().push_back(accuracy_cell(entry.at("random")));
    rows.back().push_back(accuracy_cell(entry.at("group")));
    rows.back().push_back(reading(entry.at("kind"), as_chance(metrics, entry), level_seen));
  }
  return html_table(rows, false);
}

std::string note_of_level(const ordered_json& metrics, const Scenario& scenario) {
  const ClutterSpec& clutter = scenario.clutter;
  const std::string absolute = not_scaled(clutter), power = percent(probe_accuracy(metrics, "total power")),
                    unseen = escape_html(division_words(metrics).unseen);
  if (!absolute.empty()) {
    return fmt::format(
        "<b>Features see the level.</b> {} not scaled to the target, which stands out the more the larger it is. Total "
        "power alone "
        "reaches {} on {}, the ratio of the target to clutter and noise {}. Centre weights are normalised and "
        "the network’s "
        "input is divided by its energy, but which centres are found depends on that ratio: part of what features "
        "reach here may be the "
        "target’s size. Clutter and noise at given ratios to the target (<code>clutter.level: scr</code>, "
        "<code>noise_level: "
        "cnr</code> or <code>snr</code>) take it out.",
        absolute, power, unseen, percent(probe_accuracy(metrics, "signal to clutter and noise")));
  }
  return fmt::format(
      "<b>Absolute level would settle it.</b> {}, so the level of a map is the target’s size. Total power alone "
      "reaches {} on {}. No feature group sees it: clutter and noise follow the target, centre weights are normalised, "
      "the "
      "network’s input is "
      "divided by its energy. A pipeline with unnormalised maps would look better for the wrong reason.",
      clutter.enabled
          ? fmt::format("The clutter follows the target (SCR in dB: {})",
                        escape_html(value_text(scenario, "clutter.scr_db", fmt::format("{:g}", clutter.scr_db))))
          : "There is no clutter",
      power, unseen);
}

}  // namespace seaglint
