// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>
#include <vector>

namespace seaglint {

namespace {

using nlohmann::ordered_json;

// independent: of a probe that is random by construction, which is away from chance below guessing, too. Any other
// probe separates nothing there: what it learnt does not hold on unseen rows.
bool scores_as_chance(const ordered_json& scores, bool independent, int repeats) {
  constexpr double kDeviations = 2.576;  // 99 % of a normal distribution, two-sided
  const Guessing guess = guessing(scores);
  const double low = value_or_nan(scores.at("accuracy_95").at(0));
  if (!independent && std::isfinite(low)) return low <= guess.most;
  const double rows = scores.at("rows").get<double>() / repeats, accuracy = value_or_nan(scores.at("accuracy"));
  const double off = std::max({accuracy - guess.most, independent ? guess.least - accuracy : 0.0, 0.0});
  return off <= kDeviations * std::sqrt(guess.most * (1 - guess.most) / rows);
}

}  // namespace

std::string scores_fault(const ordered_json& metrics, std::size_t classes) {
  if (!metrics.is_structured()) return "";
  if (metrics.is_object() && metrics.contains("confusion") && metrics.at("confusion").size() != classes * classes)
    return fmt::format("confusion: {} counts of {} classes", metrics.at("confusion").size(), classes);
  if (metrics.is_object() && metrics.contains("false_alarms") && metrics.contains("detections") &&
      metrics.at("false_alarms").size() != metrics.at("detections").size())
    return fmt::format("roc: {} false_alarms, {} detections", metrics.at("false_alarms").size(),
                       metrics.at("detections").size());
  for (const ordered_json& member : metrics)
    if (std::string fault = scores_fault(member, classes); !fault.empty()) return fault;
  return "";
}

double value_or_nan(const ordered_json& json) { return json.is_number() ? json.get<double>() : std::nan(""); }

std::string percent(double fraction) { return std::isfinite(fraction) ? fmt::format("{:.1f} %", 100 * fraction) : "–"; }

std::string accuracy_cell(const ordered_json& scores) {
  const double low = value_or_nan(scores.at("accuracy_95").at(0)), high = value_or_nan(scores.at("accuracy_95").at(1));
  std::string cell = percent(value_or_nan(scores.at("accuracy")));
  if (std::isfinite(low)) cell += fmt::format(" <small>({:.0f}–{:.0f})</small>", 100 * low, 100 * high);
  return cell;
}

double probe_accuracy(const ordered_json& metrics, const std::string& name) {
  for (const auto& probe : metrics.at("probes")) {
    if (probe.at("name") == name) return value_or_nan(probe.at("group").at("accuracy"));
  }
  return std::nan("");
}

DivisionWords division_words(const ordered_json& metrics) {
  const auto column = metrics.at("learning").at("split.by").get<std::string>();
  DivisionWords words;
  words.by_sea = column == "sea";
  words.by = "by " + column;
  words.unseen = words.by_sea ? "unseen seas" : fmt::format("values of {} that were not trained on", column);
  words.heading = words.by_sea ? "Split by sea realisation (no test sea was seen in training)"
                               : fmt::format("Split by {0} (no value of {0} is trained and tested on)", column);
  // Text of Division: "tested on layout=ring only; split by ..."
  constexpr std::string_view kTested = "tested on ", kOnly = " only; split by ";
  const std::string division = metrics.value("division", "");
  const std::size_t end = division.rfind(kOnly);
  if (!division.starts_with(kTested) || end == std::string::npos) return words;
  const std::string held = division.substr(kTested.size(), end - kTested.size());
  words.unseen = fmt::format("held-out maps ({}) of {}", held, words.unseen);
  words.heading += fmt::format(", tested on {} only", held);
  return words;
}

std::string Guessing::text() const {
  const std::string high = fmt::format("{:.1f} %", 100 * most);
  return most - least < 5e-4 ? high : fmt::format("{:.1f} to {}", 100 * least, high);
}

Guessing guessing(const ordered_json& scores) {
  // Entries by truth, then decision.
  const ordered_json& confusion = scores.at("confusion");
  const auto classes = static_cast<std::size_t>(std::lround(std::sqrt(confusion.size())));
  std::vector<double> rows(classes);
  std::size_t entry = 0;
  for (const ordered_json& count : confusion) rows.at(entry++ / classes) += count.get<double>();
  const double all = std::accumulate(rows.begin(), rows.end(), 0.0);
  if (!(all > 0)) return {1.0 / static_cast<double>(classes), 1.0 / static_cast<double>(classes)};
  double squares = 0;
  for (const double count : rows) squares += count / all * (count / all);
  return {squares, *std::max_element(rows.begin(), rows.end()) / all};
}

bool as_chance(const ordered_json& metrics, const ordered_json& probe) {
  const bool blind = probe.at("kind") == "blind";
  const int repeats = metrics.at("split_repeats");
  const bool random = !probe.contains("random") || scores_as_chance(probe.at("random"), blind, repeats);
  return random && scores_as_chance(probe.at("group"), blind, repeats);
}

}  // namespace seaglint
