// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "classify/model/study.h"
#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/text/json.h"

namespace seaglint {

namespace {

constexpr double kLevel = 0.05;

// Distance from the null in standard errors; an estimate without scatter is certain.
double distance(const Estimate& estimate, double null) {
  const double difference = std::abs(estimate.value - null);
  if (difference == 0) return 0;
  return estimate.standard_error > 0 ? difference / estimate.standard_error : std::numeric_limits<double>::infinity();
}

// Indices of the estimates that are numbers, the most different first; equal ones in their order.
std::vector<std::size_t> most_different_first(std::span<const Estimate> estimates, double null) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!std::isnan(estimates[i].value) && !std::isnan(estimates[i].standard_error)) order.push_back(i);
  }
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return distance(estimates[a], null) > distance(estimates[b], null); });
  return order;
}

// Half of the interval of an estimate that is the k-th of m.
double half_width(const Estimate& estimate, std::size_t k, std::size_t m) {
  return half_width(estimate, kLevel / static_cast<double>(m - k));
}

}  // namespace

Estimate estimate_of(const Scores& scores) {
  const double of_bootstrap = (scores.accuracy_95.high - scores.accuracy_95.low) / (2 * normal_quantile(0.975));
  const double seas = static_cast<double>(std::max<std::size_t>(scores.groups, 2));
  return {scores.accuracy, of_bootstrap * std::sqrt(seas / (seas - 1)), seas - 1};
}

double half_width(const Estimate& estimate, double level) {
  return student_quantile(1 - level / 2, estimate.degrees_of_freedom) * estimate.standard_error;
}

Estimate difference_of(const Estimate& a, const Estimate& b) {
  const double of_a = a.standard_error * a.standard_error, of_b = b.standard_error * b.standard_error;
  const double spread = of_a * of_a / a.degrees_of_freedom + of_b * of_b / b.degrees_of_freedom;
  return {a.value - b.value, std::sqrt(of_a + of_b),
          spread > 0 ? (of_a + of_b) * (of_a + of_b) / spread : std::numeric_limits<double>::infinity()};
}

std::vector<ConfidenceInterval> holm_intervals(std::span<const Estimate> estimates, double null) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<ConfidenceInterval> intervals(estimates.size(), {kNone, kNone});
  const std::vector<std::size_t> order = most_different_first(estimates, null);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Estimate& estimate = estimates[order[k]];
    const double half = half_width(estimate, k, order.size());
    intervals[order[k]] = {std::max(0.0, estimate.value - half), std::min(1.0, estimate.value + half)};
  }
  return intervals;
}

std::vector<bool> holm_rejections(std::span<const Estimate> estimates, double null) {
  std::vector<bool> rejected(estimates.size(), false);
  const std::vector<std::size_t> order = most_different_first(estimates, null);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Estimate& estimate = estimates[order[k]];
    if (!(std::abs(estimate.value - null) > half_width(estimate, k, order.size()))) break;
    rejected[order[k]] = true;
  }
  return rejected;
}

namespace {

using nlohmann::ordered_json;

constexpr double kPaperHandmade = 0.86;
constexpr double kNearChance = 0.1;  // of the maps: quantities within it of chance separate nothing

double chance_of(const Study& study) { return 1 / static_cast<double>(study.classes.size()); }

// Name, evaluation.
std::vector<std::pair<std::string, const Evaluation*>> baselines(const Study& study) {
  std::vector<std::pair<std::string, const Evaluation*>> all;
  for (const auto& [name, group] : {std::pair{"handmade", "handmade"}, {"network", "cnn"}, {"fused", "fused"}})
    all.emplace_back(name, &outcome_of(study, group).primary);
  for (const auto& [name, group] :
       {std::pair{"handmade_logistic", "handmade"}, {"network_logistic", "cnn"}, {"fused_logistic", "fused"}})
    all.emplace_back(name, &outcome_of(study, group).linear);
  return all;
}

ordered_json to_object(const Evaluation& evaluation) {
  const auto figures = [](const Scores& scores) {
    return ordered_json{
        {"accuracy", number_or_null(scores.accuracy)},
        {"interval", {number_or_null(scores.accuracy_95.low), number_or_null(scores.accuracy_95.high)}}};
  };
  ordered_json json = figures(evaluation.scores);
  for (const BinnedScores& entry : evaluation.by_wave_height) json["by"][entry.text] = figures(entry.scores);
  return json;
}

std::string rounded(const Scores& scores) { return fmt::format("{:.1f}", 100 * scores.accuracy); }

// "80.0 / 99.0 / 99.2", by wave height.
std::string by_height(const Evaluation& evaluation) {
  std::vector<std::string> values;
  for (const BinnedScores& entry : evaluation.by_wave_height) values.push_back(rounded(entry.scores));
  return fmt::format("{}", fmt::join(values, " / "));
}

std::string heights(const Evaluation& evaluation) {
  std::vector<std::string> values;
  for (const BinnedScores& entry : evaluation.by_wave_height) values.push_back(entry.text);
  return fmt::format("{}", fmt::join(values, " / "));
}

Estimate difference_of(const Scores& a, const Scores& b) { return difference_of(estimate_of(a), estimate_of(b)); }

// Whether all differences are above 0: each by more than its interval of 95 %, or one below by more than that of
// Bonferroni's level.
Verdict all_above(const std::vector<Estimate>& differences) {
  const double level = kLevel / static_cast<double>(differences.size());
  if (std::ranges::all_of(differences, [](const Estimate& d) { return d.value > half_width(d); }))
    return Verdict::kHeld;
  return std::ranges::any_of(differences, [&](const Estimate& d) { return -d.value > half_width(d, level); })
             ? Verdict::kNotHeld
             : Verdict::kUndecided;
}

Claim above_the_papers_accuracy(const Study& study, Protocol protocol) {
  Scores scores = outcome_of(study, "handmade", protocol).primary.scores;
  Estimate above = estimate_of(scores);
  const double half = half_width(above);
  scores.accuracy_95 = {std::max(scores.accuracy - half, 0.0), std::min(scores.accuracy + half, 1.0)};  // NaN stays
  above.value -= kPaperHandmade;
  return {"hand-made features are above 86 %", all_above({above}), percent(scores) + " %",
          "held: the interval of 95 % is above 86 %; not held: below"};
}

Claim both_are_best(const Study& study, Protocol protocol) {
  const auto scores = [&](const char* group) -> const Scores& {
    return outcome_of(study, group, protocol).primary.scores;
  };
  const Scores &fused = scores("fused"), &handmade = scores("handmade"), &network = scores("cnn");
  return {"hand-made and learned features together are the best",
          all_above({difference_of(fused, handmade), difference_of(fused, network)}),
          fmt::format("fused {}, hand-made {}, network {} %", rounded(fused), rounded(handmade), rounded(network)),
          "held: more than each by more than the interval of 95 % of the difference; not held: less than one by more "
          "than its interval for two"};
}

// From the lowest to the highest waves.
Claim rises_with_the_waves(const Study& study, Protocol protocol) {
  const Evaluation& handmade = outcome_of(study, "handmade", protocol).primary;
  const std::vector<BinnedScores>& bins = handmade.by_wave_height;
  return {"hand-made features rise with the wave height",
          bins.size() < 2 ? Verdict::kUndecided : all_above({difference_of(bins.back().scores, bins.front().scores)}),
          fmt::format("{} % at Hs {} m", by_height(handmade), heights(handmade)),
          "held: more in the highest waves than in the lowest by more than the interval of 95 % of the difference; not "
          "held: less by more than it"};
}

Claim trees_are_superior(const Study& study, Protocol protocol) {
  Claim claim{"trees are superior to logistic regression", Verdict::kUndecided, "",
              "held: more for all features by more than the interval of 95 % of the difference; not held: less for "
              "some by more than its interval for three"};
  std::vector<Estimate> differences;
  for (const auto& [name, group] : {std::pair{"hand-made", "handmade"}, {"network", "cnn"}, {"fused", "fused"}}) {
    const Outcome& outcome = outcome_of(study, group, protocol);
    differences.push_back(difference_of(outcome.primary.scores, outcome.linear.scores));
    claim.why += fmt::format("{}{} {} and {}", claim.why.empty() ? "" : ", ", name, rounded(outcome.primary.scores),
                             rounded(outcome.linear.scores));
  }
  claim.verdict = all_above(differences);
  claim.why += " %";
  return claim;
}

// How far the interval of a quantity extends from chance; infinite without an interval.
double farthest(const FloorEntry& entry, double chance) {
  const auto& [low, high] = entry.scores.accuracy_95;
  return std::isfinite(low) ? std::max(high - chance, chance - low) : std::numeric_limits<double>::infinity();
}

Claim motion_alone_separates(const Study& study, Protocol protocol) {
  Claim claim{"motion alone separates the classes", Verdict::kUndecided, "",
              fmt::format("not held: Holm's procedure rejects that some quantity other than motion is at chance; held: "
                          "the intervals of all are within {:g} % of chance",
                          100 * kNearChance)};
  const double chance = chance_of(study);
  const std::vector<FloorEntry> floor = floor_of(study, protocol);
  for (const FloorEntry& entry : floor) {
    if (!entry.leaks) continue;
    claim.verdict = Verdict::kNotHeld;
    claim.why += fmt::format("{}{} {} %", claim.why.empty() ? "" : ", ", entry.name, rounded(entry.scores));
  }
  if (claim.verdict == Verdict::kNotHeld) {
    if (study.classes.size() > 2) claim.why += fmt::format(" (chance: {:.1f} %)", 100 * chance);
    return claim;
  }
  const auto widest =
      std::ranges::max_element(floor, {}, [&](const FloorEntry& entry) { return farthest(entry, chance); });
  if (widest == floor.end() || !std::isfinite(farthest(*widest, chance))) {
    claim.why = "not every quantity has an interval";
    return claim;
  }
  if (farthest(*widest, chance) <= kNearChance) claim.verdict = Verdict::kHeld;
  claim.why = fmt::format("chance ({:.1f} %) is rejected for no quantity; {} may be {:.1f} to {:.1f} %", 100 * chance,
                          widest->name, 100 * widest->scores.accuracy_95.low, 100 * widest->scores.accuracy_95.high);
  return claim;
}

}  // namespace

const char* name(Verdict verdict) {
  constexpr const char* kNames[] = {"held", "not held", "undecided"};
  return kNames[static_cast<int>(verdict)];
}

std::vector<FloorEntry> floor_of(const Study& study, Protocol protocol) {
  std::vector<FloorEntry> entries;
  std::vector<Estimate> estimates;
  for (const ProbeResult& probe : study.probes) {
    if (probe.kind == ProbeKind::kFeature && probe.name != "sigma_r alone") continue;
    entries.push_back({probe.name, probe.of(protocol).scores});
    estimates.push_back(estimate_of(entries.back().scores));
  }
  const std::vector<ConfidenceInterval> intervals = holm_intervals(estimates, chance_of(study));
  const std::vector<bool> rejected = holm_rejections(estimates, chance_of(study));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].scores.accuracy_95 = intervals[i];
    entries[i].leaks = rejected[i];
  }
  return entries;
}

std::vector<Claim> claims_of(const Study& study, Protocol protocol) {
  return {above_the_papers_accuracy(study, protocol), both_are_best(study, protocol),
          rises_with_the_waves(study, protocol), trees_are_superior(study, protocol),
          motion_alone_separates(study, protocol)};
}

std::string benchmark_json(const BenchmarkRecord& record, const Study& study) {
  ordered_json json{{"benchmark", record.name},    {"small", record.small},
                    {"program_version", kVersion}, {"seed", record.seed},
                    {"maps", record.maps},         {"seas", record.seas},
                    {"division", study.division},  {"split_repeats", record.split_repeats}};
  if (study.classes.size() > 2) json["classes"] = study.classes;
  for (const auto& [name, evaluation] : baselines(study)) json["baselines"][name] = to_object(*evaluation);
  for (const FloorEntry& entry : floor_of(study)) {
    const auto probe = std::ranges::find(study.probes, entry.name, &ProbeResult::name);
    ordered_json& object = json["floor"][entry.name];
    object = to_object(probe->of_group());
    object["interval"] = {number_or_null(entry.scores.accuracy_95.low), number_or_null(entry.scores.accuracy_95.high)};
    object["leaks"] = entry.leaks;
  }
  for (const Claim& claim : claims_of(study))
    json["claims"].push_back(
        {{"claim", claim.text}, {"verdict", name(claim.verdict)}, {"why", claim.why}, {"meaning", claim.meaning}});
  return json.dump(2) + "\n";
}

std::string benchmark_text(const Study& study) {
  std::string all = fmt::format("Accuracy in % (95 % interval by bootstrap over seas)\n{}\n\n", study.division);
  all += fmt::format("  {:<28}{:>18}  by Hs\n", "", "all");
  for (const auto& [name, evaluation] : baselines(study)) {
    all += fmt::format("  {:<28}{:>18}  {}\n", name, percent(evaluation->scores), by_height(*evaluation));
  }
  all += "\nWithout motion (intervals by Holm over all of them; * = differs from chance";
  all += study.classes.size() > 2 ? fmt::format(", {:.1f} %)\n\n", 100 * chance_of(study)) : ")\n\n";
  for (const FloorEntry& entry : floor_of(study)) {
    all += fmt::format("  {:<28}{:>18}{}\n", entry.name, percent(entry.scores), entry.leaks ? " *" : "");
  }
  all += "\nThe paper's claims on this data set (intervals of 95 % by Student's distribution, over seas)\n\n";
  for (const Claim& claim : claims_of(study))
    all += fmt::format("  {:<52} {:<10} {}\n", claim.text, name(claim.verdict), claim.why);
  return all;
}

std::string benchmark_row(const BenchmarkRecord& record, const Study& study) {
  const std::vector<FloorEntry> floor = floor_of(study);
  const auto highest = std::ranges::max_element(
      floor, {}, [&](const FloorEntry& entry) { return std::abs(entry.scores.accuracy - chance_of(study)); });
  const auto cell = [&](const char* group) { return by_height(outcome_of(study, group).primary); };
  return fmt::format("| `{}` | {}, {} | {} | {} | {} | {} {} |\n", record.name, record.maps, record.seas,
                     cell("handmade"), cell("cnn"), cell("fused"), highest->name, rounded(highest->scores));
}

}  // namespace seaglint
