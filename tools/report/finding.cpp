// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/finding.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <span>

namespace seaglint {

namespace {

bool scores_as_chance(const Scores& scores, bool independent, int repeats) {
  constexpr double kDeviations = 2.576;  // 99 % of a normal distribution, two-sided
  const Guessing guess = guessing(scores);
  if (!independent && std::isfinite(scores.accuracy_95.low)) return scores.accuracy_95.low <= guess.most;
  const double rows = static_cast<double>(scores.rows) / repeats;
  const double off = std::max({scores.accuracy - guess.most, independent ? guess.least - scores.accuracy : 0.0, 0.0});
  return off <= kDeviations * std::sqrt(guess.most * (1 - guess.most) / rows);
}

// "99.8 % (99–100)".
std::string in_words(const Scores& scores) {
  std::string text = fmt::format("{:.1f} %", 100 * scores.accuracy);
  const auto& [low, high] = scores.accuracy_95;
  if (std::isfinite(low)) text += fmt::format(" ({:.0f}–{:.0f})", 100 * low, 100 * high);
  return text;
}

// "MWR alone" as "MWR".
std::string quantity(const ProbeResult& probe) { return probe.name.substr(0, probe.name.find(" alone")); }

// The quantity by itself that tells most; null if all are as chance.
const ProbeResult* best_alone(std::span<const ProbeResult> probes, const Scenario& scenario) {
  const ProbeResult* best = nullptr;
  for (const ProbeResult& probe : probes) {
    if (probe.kind == ProbeKind::kBlind || as_chance(probe, scenario.learning.split_repeats)) continue;
    if (probe.kind == ProbeKind::kScale && not_scaled(scenario.clutter).empty()) continue;
    if (best == nullptr || probe.of_group().scores.accuracy > best->of_group().scores.accuracy) best = &probe;
  }
  return best;
}

}  // namespace

std::string capital(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string Guessing::text() const {
  const std::string high = fmt::format("{:.1f} %", 100 * most);
  return most - least < 5e-4 ? high : fmt::format("{:.1f} to {}", 100 * least, high);
}

Guessing guessing(const Scores& scores) {
  std::vector<double> rows;
  for (const std::vector<std::size_t>& of_truth : scores.confusion)
    rows.push_back(static_cast<double>(std::accumulate(of_truth.begin(), of_truth.end(), std::size_t{0})));
  const double all = std::accumulate(rows.begin(), rows.end(), 0.0), even = 1 / static_cast<double>(rows.size());
  if (!(all > 0)) return {even, even};
  double squares = 0;
  for (const double count : rows) squares += count / all * (count / all);
  return {squares, *std::ranges::max_element(rows) / all};
}

bool as_chance(const ProbeResult& probe, int repeats) {
  return std::ranges::all_of(probe.evaluations, [&](const Evaluation& evaluation) {
    return scores_as_chance(evaluation.scores, probe.kind == ProbeKind::kBlind, repeats);
  });
}

const char* cause(const ProbeResult& probe) {
  switch (probe.kind) {
    case ProbeKind::kBlind: return "nothing of the target";
    case ProbeKind::kScale: return "level";
    case ProbeKind::kRatio: return "the ratio of target to clutter";
    case ProbeKind::kShape: return "geometry";
    case ProbeKind::kFeature: break;
  }
  const std::string name = quantity(probe);
  return name == "sigma_r" ? "geometry" : name == "CCF" ? "geometry and motion" : "motion";
}

std::string not_scaled(const ClutterSpec& clutter) {
  const bool sea = clutter.enabled && is_absolute(clutter.level);
  const bool receiver = clutter.noise_level == NoiseLevel::kThermal;
  if (sea && receiver) return "Clutter and receiver noise are";
  if (sea) return "The clutter is";
  return receiver ? "The receiver’s noise is" : "";
}

std::string finding(const Study& study, const Scenario& scenario) {
  const ClassNames classes = class_names(scenario);
  const DivisionWords division = division_words(scenario.learning.split, study.division);
  const int repeats = scenario.learning.split_repeats;
  const Scores& fused = outcome_of(study, "fused").primary.scores;
  if (!std::isfinite(fused.accuracy)) return "No map was tested.";
  const std::string who = classes.size() == 2 ? fmt::format("{} and {}", classes[1], classes[0]) : "the classes";
  if (scores_as_chance(fused, false, repeats))
    return fmt::format("On {} the fused features do not tell {} apart: {} of the maps, guessing {}.", division.unseen,
                       who, in_words(fused), guessing(fused).text());
  std::string text = fmt::format("On {} the fused features tell {} apart in {} of the maps; guessing reaches {}. ",
                                 division.unseen, who, in_words(fused), guessing(fused).text());
  for (const ProbeResult& probe : study.probes) {
    if (probe.kind == ProbeKind::kBlind && !as_chance(probe, repeats))
      return text + fmt::format(
                        "{}, which does not depend on the target, is away from chance with {}: look for a leak "
                        "before any other figure is believed.",
                        capital(probe.name), in_words(probe.of_group().scores));
  }
  const ProbeResult* best = best_alone(study.probes, scenario);
  if (best == nullptr) return text + "No single quantity tells them by itself.";
  const Scores& alone = best->of_group().scores;
  const bool as_well = std::isfinite(alone.accuracy_95.high) && std::isfinite(fused.accuracy_95.low)
                           ? alone.accuracy_95.high >= fused.accuracy_95.low
                           : alone.accuracy >= fused.accuracy;
  if (as_well)
    return text + fmt::format("{} alone does as well: {} reaches {}.", capital(cause(*best)), quantity(*best),
                              in_words(alone));
  return text + fmt::format("No single quantity does as well; the best is {} ({}) with {}.", quantity(*best),
                            cause(*best), in_words(alone));
}

}  // namespace seaglint
