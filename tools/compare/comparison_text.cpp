// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/comparison_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/parallel.h"
#include "sim/core/process/printable.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

std::string text_of(const Alignment& a, bool of_all) {
  std::string text = fmt::format("constant phase {:.1f} deg, ", degrees(a.phase_rad));
  if (a.undetermined.size() == 3) {
    text += "no phase origin that the data fix";
  } else {
    text +=
        fmt::format("phase origin {:.4f}, {:.4f}, {:.4f} m (+- {:.4f}, {:.4f}, {:.4f})", a.origin_m.x(), a.origin_m.y(),
                    a.origin_m.z(), a.origin_error_m.x(), a.origin_error_m.y(), a.origin_error_m.z());
    for (const Vec3& v : a.undetermined)
      text += fmt::format("; the data fix none along {:.2f}, {:.2f}, {:.2f}", v.x(), v.y(), v.z());
  }
  return of_all ? text + "; of all elements" : text;
}

ordered_json extrema_json(const ExtremumPairs& pairs, CutAxis axis) {
  if (axis == CutAxis::kSeveral) return nullptr;
  ordered_json json{{"count", pairs.count}, {"paired", pairs.paired}};
  json["unit"] = axis_unit(axis);
  json["mean_shift"] = pairs.mean_shift;
  json["mean_db"] = pairs.mean_db;
  return json;
}

ordered_json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

ordered_json fitted_json(const ExportComparison& comparison, Polarisation element) {
  if (!comparison.alignment) return nullptr;
  const Alignment& a = *comparison.alignment;
  ordered_json json;
  json["phase_deg"] = degrees(a.phase_rad);
  json["origin_m"] = vector_json(a.origin_m);
  json["origin_error_m"] = vector_json(a.origin_error_m);
  json["undetermined"] = ordered_json::array();
  for (const Vec3& v : a.undetermined) json["undetermined"].push_back(vector_json(v));
  json["conjugated"] = a.conjugated;
  json["sign"] = a.sign[static_cast<std::size_t>(element)];
  json["offset_db"] = a.level_db;
  return json;
}

// known: a last column with the exact or closed-form levels, empty where there is none.
std::string rows_of(const ExportComparison& comparison, const PairedCut& cut, bool known) {
  const std::string name = csv_cell(comparison.name) + ',';
  const std::string other = fmt::format(",{},{}", csv_cell(comparison.compared), kQuantityNames[cut.quantity()]);
  const PairedCut::Model& model = cut.models[0];
  const bool phases = cut.has_phases();
  std::string text;
  const auto digits = [&](double x) { fmt::format_to(std::back_inserter(text), ",{:.9g}", x); };
  const auto decibels = [&](double x) { fmt::format_to(std::back_inserter(text), ",{:.4f}", x); };
  text.reserve(cut.places.size() * (name.size() + other.size() + 110));
  for (std::size_t i = 0; i < cut.places.size(); ++i) {
    const PairedCut::Place& p = cut.places[i];
    (text += name).append(fmt::format_int(p.line).c_str()).append(other);
    for (const double x : {p.frequency_hz, p.azimuth_deg, p.elevation_deg}) digits(x);
    for (const double level : {cut.level_dbsm[i], model.level_dbsm[i], model.level_dbsm[i] - cut.level_dbsm[i]})
      decibels(level);
    if (phases) {
      const Complex a = cut.amplitude_m[i], b = model.amplitude_m[i];
      for (const double x : {a.real(), a.imag(), b.real(), b.imag()}) digits(x);
    } else {
      text += ",,,,";
    }
    if (known && cut.known && !std::isnan(cut.known->level_dbsm[i])) {
      decibels(cut.known->level_dbsm[i]);
    } else if (known) {
      text += ',';
    }
    text += '\n';
  }
  return text;
}

ordered_json interpolation_json(const ExportComparison& comparison) {
  if (!comparison.interpolation) return nullptr;
  const InterpolationQuality& q = *comparison.interpolation;
  return {{"radius_m", q.radius_m},
          {"interpolated", q.interpolated},
          {"omitted", q.omitted},
          {"standard_error", q.standard_error},
          {"largest_error", q.largest_error}};
}

ordered_json solver_json(const ExportComparison& comparison) {
  if (!comparison.solver) return nullptr;
  const RcsRequest& request = *comparison.solver;
  ordered_json json;
  json["like"] = request.like.empty() ? ordered_json(nullptr) : ordered_json(request.like);
  json["crease_deg"] = request.crease_deg ? ordered_json(*request.crease_deg) : ordered_json(nullptr);
  json["edges"] = request.edges;
  json["max_bounces"] = request.max_bounces;
  json["method"] = kSolverMethodNames[static_cast<int>(request.method)];
  return json;
}

std::string contribution_text(const ElementStatistics::Worst& worst) {
  return worst.main ? fmt::format("{}, {:.1f} dBsm", worst.main->group(), worst.main->level_dbsm) : "";
}

// Known values of one quantity.
ordered_json known_json(const ExportComparison& comparison, std::size_t quantity) {
  if (!comparison.known) return nullptr;
  const KnownValues& known = *comparison.known;
  ordered_json json{{"body", known.body}, {"value", known.name}};
  for (const KnownStatistics& s : known.statistics) {
    if (s.quantity != quantity) continue;
    json["pairs"] = s.reference.points;
    json["export_bias_db"] = s.reference.bias_db;
    json["export_rms_db"] = s.reference.rms_db;
    json["compared_bias_db"] = s.compared.bias_db;
    json["compared_rms_db"] = s.compared.rms_db;
    json["own_error_db"] = s.error_db;
    json["verdict"] = closer_text(s.reference.rms_db, s.compared.rms_db, s.error_db, comparison.compared);
  }
  json["levels"] = ordered_json::array();
  for (const KnownLevel& l : known.levels) {
    if (l.quantity != quantity) continue;
    json["levels"].push_back({{"body", l.body},
                              {"place", l.place},
                              {"range_m", l.range_m},
                              {"known_dbsm", l.known_dbsm},
                              {"export_dbsm", l.reference_dbsm},
                              {"compared_dbsm", l.compared_dbsm}});
  }
  if (!json.contains("pairs") && json["levels"].empty()) return nullptr;
  return json;
}

ordered_json trials_json(const ExportComparison& comparison) {
  ordered_json json = ordered_json::array();
  for (const Trial& trial : comparison.trials) {
    json.push_back({{"option", trial.option},
                    {"views", trial.views},
                    {"median_before_db", trial.before_db},
                    {"median_after_db", trial.after_db},
                    {"helps", trial.helps}});
  }
  return json;
}

}  // namespace

std::string solver_text(const std::vector<ExportComparison>& comparisons) {
  const auto solved = std::ranges::find_if(comparisons, [](const auto& c) { return c.solver.has_value(); });
  if (solved == comparisons.end()) return "";
  std::string text = fmt::format("{} solved with {}", solved->compared, solver_text(*solved->solver));
  if (!solved->solver->like.empty()) text += fmt::format(": {}", like_program(solved->solver->like).described);
  return text;
}

namespace {

// A difference for a sentence: 0.04, 0.3, 12.
std::string amount(double db) {
  db = std::abs(db);
  if (db >= 9.95) return fmt::format("{:.0f}", db);
  return db < 0.095 ? fmt::format("{:.2f}", std::max(db, 0.01)) : fmt::format("{:.1f}", db);
}

const ElementStatistics& strongest_of(const ExportComparison& comparison) {
  return *std::ranges::max_element(comparison.elements, {}, &ElementStatistics::highest_dbsm);
}

// "181 angles", "21 frequencies", "3801 angles and frequencies".
std::string places_text(const ElementStatistics& s) {
  const char* noun = s.frequencies == 1 ? "angles" : s.directions == 1 ? "frequencies" : "angles and frequencies";
  return fmt::format("{} {}", s.difference.points, noun);
}

constexpr double kWeaker_db = 10;  // an element whose highest level is lower by this is named apart
constexpr double kAgreement_db =
    3;  // 90 % of the differences, or of those about an offset, of what is called agreement

// "0.3 dB in hh and 0.5 dB in vv": the 90 % differences of these elements, equal ones together.
std::string amounts_text(const std::vector<const ElementStatistics*>& elements) {
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const ElementStatistics* s : elements) {
    const std::string text = amount(s->p90_db);
    auto group = std::ranges::find(groups, text, &decltype(groups)::value_type::first);
    if (group == groups.end()) group = groups.insert(groups.end(), {text, {}});
    group->second.emplace_back(kQuantityNames[s->quantity()]);
  }
  std::vector<std::string> texts;
  for (const auto& [db, names] : groups) texts.push_back(fmt::format("{} dB in {}", db, fmt::join(names, " and ")));
  return fmt::format("{}", fmt::join(texts, texts.size() == 2 ? " and " : ", "));
}

std::string phases_text(const ElementStatistics& s) {
  constexpr double kAgree = 0.99, kDiffer = 0.9;
  if (!s.difference.correlation) return "";
  const double correlation = std::abs(*s.difference.correlation);
  if (correlation >= kAgree) return fmt::format(", phases included (correlation {:.3f})", correlation);
  return fmt::format("; the phases {} (correlation {:.2f})", correlation < kDiffer ? "do not agree" : "agree roughly",
                     correlation);
}

bool agrees(const ElementStatistics& s) { return s.p90_db <= kAgreement_db; }

// "within 0.3 dB in hh and 0.5 dB in vv at 90 % of the 181 angles, phases included (correlation 0.997), but not in hv
// (9.0 dB); weaker elements, by 25 dB and more, within 2.0 dB in vh".
std::string within_text(const ExportComparison& comparison) {
  const ElementStatistics& strongest = strongest_of(comparison);
  std::vector<const ElementStatistics*> agreeing, differing, weaker;
  double below = 1e300;
  for (const ElementStatistics& s : comparison.elements) {
    if (s.highest_dbsm < strongest.highest_dbsm - kWeaker_db) {
      weaker.push_back(&s);
      below = std::min(below, strongest.highest_dbsm - s.highest_dbsm);
    } else {
      (agrees(s) ? agreeing : differing).push_back(&s);
    }
  }
  std::string text = fmt::format("within {} at 90 % of the {}{}", amounts_text(agreeing), places_text(strongest),
                                 phases_text(strongest));
  if (!differing.empty()) text += fmt::format(", but not in others: {}", amounts_text(differing));
  if (!weaker.empty())
    text += fmt::format("; weaker elements, by {} dB and more, within {}", amount(below), amounts_text(weaker));
  return text;
}

bool is_offset(const ElementStatistics& s) {
  constexpr double kLeast_db = 0.3, kSteady = 0.5;
  return std::abs(s.difference.bias_db) >= kLeast_db &&
         s.p90_about_bias_db <= std::min(kSteady * std::abs(s.difference.bias_db), kAgreement_db);
}

// How far they agree.
std::string agreement_text(const ExportComparison& c) {
  constexpr std::size_t kLeastStrong = 5;
  constexpr double kOneSided = 0.7;  // of the mean difference
  const ElementStatistics& s = strongest_of(c);
  const std::string subject = c.compared == "seaglint" ? "The RCS computed by seaglint" : "The RCS of " + c.compared;
  if (is_offset(s))
    return fmt::format(
        "{} is {} dB {} than that of {} in {}; apart from this offset they agree within {} dB at 90 % of "
        "the {}{}.",
        subject, amount(s.difference.bias_db), s.difference.bias_db > 0 ? "higher" : "lower", c.name,
        kQuantityNames[s.quantity()], amount(s.p90_about_bias_db), places_text(s), phases_text(s));
  if (agrees(s)) return fmt::format("{} agrees with {} {}.", subject, c.name, within_text(c));
  const char* element = kQuantityNames[s.quantity()];
  if (s.strong >= kLeastStrong && s.p90_strong_db <= kAgreement_db)
    return fmt::format(
        "{} agrees with {} within {} dB in {} at 90 % of the levels within {:g} dB of the strongest{}, but within {} "
        "dB only "
        "at 90 % of all {}.",
        subject, c.name, amount(s.p90_strong_db), element, kStrong_db, phases_text(s), amount(s.p90_db),
        places_text(s));
  const bool one_sided = std::abs(s.difference.bias_db) >= std::max(1.0, kOneSided * s.difference.mean_db);
  return fmt::format("{} does not agree with {}: 90 % of the {} are within {} dB in {}{}{}.", subject, c.name,
                     places_text(s), amount(s.p90_db), element,
                     one_sided ? fmt::format(", on average {} dB {}", amount(s.difference.bias_db),
                                             s.difference.bias_db > 0 ? "higher" : "lower")
                               : "",
                     phases_text(s));
}

// Which of both is closer to the exact or closed-form value; empty where none is known or it does not decide.
std::string known_text(const ExportComparison& c) {
  constexpr double kMostly = 1.0 / 3;
  if (!c.known || c.known->statistics.empty()) return "";
  const std::size_t quantity = strongest_of(c).quantity();
  const auto found = std::ranges::find(c.known->statistics, quantity, &KnownStatistics::quantity);
  const KnownStatistics& s = found == c.known->statistics.end() ? c.known->statistics.front() : *found;
  const double of_export = s.reference.rms_db, own = s.compared.rms_db;
  std::string closer = closer_text(of_export, own, s.error_db, c.compared);
  if (!closer.ends_with("is closer")) return "";
  if (own < kMostly * of_export) closer = "the difference is mainly the export's error";
  if (of_export < kMostly * own) closer = fmt::format("the difference is mainly the error of {}", c.compared);
  return fmt::format(
      "From the {} of the {} {} differs by {:.2f} dB rms (bias {:+.2f} dB), the export by {:.2f} dB ({:+.2f} dB): "
      "{}.",
      c.known->name == "closed form" ? "closed form" : "exact value (Mie series)", c.known->body, c.compared, own,
      s.compared.bias_db, of_export, s.reference.bias_db, closer);
}

// The strongest element; where it agrees and one of similar level does not, that one.
const ElementStatistics& least_agreeing_of(const ExportComparison& comparison) {
  const ElementStatistics* found = &strongest_of(comparison);
  if (!agrees(*found)) return *found;
  for (const ElementStatistics& s : comparison.elements) {
    if (s.highest_dbsm >= strongest_of(comparison).highest_dbsm - kWeaker_db && !agrees(s) && s.p90_db > found->p90_db)
      found = &s;
  }
  return *found;
}

// "10.2 GHz, azimuth 12 deg, elevation 2 deg".
std::string text_of(const PairedCut::Place& p) {
  return fmt::format("{:.6g} GHz, azimuth {:.5g} deg, elevation {:.5g} deg", 1e-9 * p.frequency_hz, p.azimuth_deg,
                     p.elevation_deg);
}

// "part hull contributes most (2 bounces, physical optics)", where at least half of the worst places share that; else
// empty.
std::string common_contribution(const ElementStatistics& s) {
  std::map<std::string, std::pair<std::size_t, const MainContribution*>> count;
  for (const ElementStatistics::Worst& worst : s.worst) {
    if (!worst.main) continue;
    auto& [places, example] = count[worst.main->group()];
    ++places;
    example = &*worst.main;
  }
  const auto most = std::ranges::max_element(count, {}, [](const auto& one) { return one.second.first; });
  if (most == count.end() || 2 * most->second.first < s.worst.size()) return "";
  const MainContribution& main = *most->second.second;
  const auto mechanism = std::ranges::find(kMechanismNames, main.mechanism) - kMechanismNames.begin();
  return fmt::format("part {} contributes most ({} bounce{}, {})", main.part, main.bounces,
                     main.bounces == 1 ? "" : "s", kMechanismWords[static_cast<std::size_t>(mechanism)]);
}

// Where the differences are, and what contributes there.
std::string places_of_differences(const ExportComparison& c) {
  constexpr double kConcentrated = 0.6, kNearlyAll = 0.8, kNone_db = 0.1, kBoth_db = 0.1;
  constexpr std::size_t kLeast = 5;
  const ElementStatistics &strongest = strongest_of(c), &s = least_agreeing_of(c);
  const ElementStatistics::Worst& worst = s.worst.front();
  if (std::abs(worst.difference_db) < kNone_db)
    return fmt::format("No value of {} differs by more than {} dB.", kQuantityNames[s.quantity()],
                       amount(worst.difference_db + std::copysign(0.005, worst.difference_db)));
  const std::string there = common_contribution(s);
  if (agrees(strongest) && s.beyond >= kLeast &&
      static_cast<double>(s.beyond_weak) >= kNearlyAll * static_cast<double>(s.beyond)) {
    std::string text = fmt::format(
        "{} differences beyond {} dB in {} are in levels more than {:g} dB below its strongest (nulls and weak lobes)",
        s.beyond_weak == s.beyond ? fmt::format("All {}", s.beyond) : fmt::format("{} of {}", s.beyond_weak, s.beyond),
        amount(s.limit_db), kQuantityNames[s.quantity()], kStrong_db);
    if (!there.empty()) text += ", where at the worst places " + there;
    if (s.p90_strong_db + kBoth_db < s.p90_db)
      text += fmt::format("; above these levels 90 % agree within {} dB", amount(s.p90_strong_db));
    return text + ".";
  }
  if (s.sector.fraction >= kConcentrated)
    return fmt::format("The differences in {} are mainly at {} {:.5g} to {:.5g} {} ({:.0f} % of their squared sum){}.",
                       kQuantityNames[s.quantity()], s.sector.axis, s.sector.low, s.sector.high, s.sector.unit,
                       100 * s.sector.fraction, there.empty() ? "" : ", where " + there);
  return fmt::format("The largest difference, {:+.1f} dB in {} at {}, is in a level {:.0f} dB below the strongest{}.",
                     worst.difference_db, kQuantityNames[s.quantity()], text_of(worst.place),
                     s.highest_dbsm - worst.reference_dbsm, there.empty() ? "" : "; at the worst places " + there);
}

// Why they differ, by what is most certain.
std::string reason_text(const ExportComparison& c) {
  const ElementStatistics& s = strongest_of(c);
  const auto trial = [&]() -> std::string {
    for (std::string& sentence : trial_sentences(c.trials)) {
      if (!std::ranges::any_of(c.trials, &Trial::helps)) continue;
      sentence.front() = 'W';  // "with --unit mm ..."
      return sentence + ".";
    }
    return "";
  };
  if (std::ranges::any_of(c.trials, is_unit)) return trial();
  if (std::string known = known_text(c); !known.empty()) return known;
  if (std::string other = trial(); !other.empty()) return other;
  if ((is_offset(s) || !agrees(s)) && !c.suggested.empty())
    return fmt::format("Possible cause: {}", c.suggested.front());
  return places_of_differences(c);
}

}  // namespace

std::string verdict(const ExportComparison& comparison) {
  if (comparison.elements.empty()) return "";
  std::string text = agreement_text(comparison) + " " + reason_text(comparison);
  if (!text.ends_with('.') && !text.ends_with('?')) text += '.';
  return text;
}

std::string comparison_table(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings) {
  std::size_t width = 6, other = 8, pol = 3;
  for (const ExportComparison& c : comparisons) {
    width = std::max(width, c.name.size());
    other = std::max(other, c.compared.size());
    for (const ElementStatistics& s : c.elements)
      pol = std::max(pol, std::string_view(kQuantityNames[s.quantity()]).size());
  }
  std::string text;
  for (const ExportComparison& c : comparisons) {
    if (!c.elements.empty()) text += verdict(c) + "\n";
  }
  text += fmt::format(
      "Differences in dB, compared - export, both clipped at {:g} dB below the export's maximum:\n{:<{}}  {:<{}}  "
      "{:<{}}  {:>7}  {:>7}  {:>7}  {:>7}  {:>7}  {:>7}  correlation\n",
      settings.floor_db, "export", width, "pol", pol, "compared", other, "pairs", "bias", "mean", "rms", "90 %",
      "95 %");
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements) {
      text += fmt::format("{:<{}}  {:<{}}  {:<{}}  {:>7}  {:>7.3f}  {:>7.3f}  {:>7.3f}  {:>7.3f}  {:>7.3f}  {}\n",
                          c.name, width, kQuantityNames[s.quantity()], pol, c.compared, other, s.difference.points,
                          s.difference.bias_db, s.difference.mean_db, s.difference.rms_db, s.p90_db, s.p95_db,
                          s.difference.correlation ? fmt::format("{:.4f}", std::abs(*s.difference.correlation))
                                                   : std::string("no phases"));
    }
  }
  if (const std::string solver = solver_text(comparisons); !solver.empty()) text += fmt::format("{}\n", solver);
  for (const ExportComparison& c : comparisons) {
    if (c.known) {
      for (const std::string& line : known_lines(*c.known, c.compared)) text += fmt::format("{}: {}\n", c.name, line);
    }
    if (c.interpolation) text += fmt::format("{}: {}\n", c.compared, text_of(*c.interpolation));
    if (c.alignment) text += fmt::format("{}: {}\n", c.name, text_of(*c.alignment, c.elements.size() > 1));
    for (const std::string& sentence : c.omitted) text += fmt::format("{}: {}\n", c.name, sentence);
    for (const std::string& warning : c.warnings) text += fmt::format("{}: warning: {}\n", c.name, warning);
  }
  return text;
}

std::string comparison_json(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings) {
  ordered_json json;
  json["version"] = kVersion;
  json["settings"] = {{"floor_db", settings.floor_db}, {"as_is", settings.as_is}};
  json["exports"] = ordered_json::array();
  ordered_json not_compared = ordered_json::array();
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements) {
      ordered_json entry;
      entry["name"] = c.name;
      entry["reader"] = c.reader;
      entry["convention"] = c.notes;
      entry["omitted"] = c.omitted;
      entry["compared"] = c.compared;
      entry["polarisation"] = kQuantityNames[s.quantity()];
      entry["summary"] = verdict(c);
      entry["pairs"] = s.difference.points;
      entry["bias_db"] = s.difference.bias_db;
      entry["mean_abs_db"] = s.difference.mean_db;
      entry["rms_db"] = s.difference.rms_db;
      entry["p90_db"] = s.p90_db;
      entry["p95_db"] = s.p95_db;
      entry["correlation"] =
          s.difference.correlation ? ordered_json(std::abs(*s.difference.correlation)) : ordered_json(nullptr);
      entry["fitted"] = fitted_json(c, s.element);
      entry["lobes"] = extrema_json(s.lobes, s.axis);
      entry["nulls"] = extrema_json(s.nulls, s.axis);
      entry["worst"] = ordered_json::array();
      for (const ElementStatistics::Worst& worst : s.worst) {
        entry["worst"].push_back({{"difference_db", worst.difference_db},
                                  {"frequency_hz", worst.place.frequency_hz},
                                  {"azimuth_deg", worst.place.azimuth_deg},
                                  {"elevation_deg", worst.place.elevation_deg},
                                  {"line", worst.place.line},
                                  {"main_contribution", contribution_text(worst)}});
      }
      entry["solver"] = solver_json(c);
      entry["known"] = known_json(c, s.quantity());
      entry["trials"] = trials_json(c);
      entry["warnings"] = c.warnings;
      entry["interpolation"] = interpolation_json(c);
      json["exports"].push_back(std::move(entry));
    }
    for (const std::vector<std::string>* sentences : {&c.omitted, &c.one_sided}) {
      for (const std::string& sentence : *sentences) not_compared.push_back({{"name", c.name}, {"why", sentence}});
    }
  }
  json["not_compared"] = std::move(not_compared);
  return json.dump(2) + "\n";
}

std::string comparison_csv(const std::vector<ExportComparison>& comparisons, int threads) {
  std::vector<std::pair<const ExportComparison*, const PairedCut*>> cuts;
  for (const ExportComparison& c : comparisons) {
    for (const PairedCut& cut : c.cuts) cuts.emplace_back(&c, &cut);
  }
  const bool known = std::ranges::any_of(cuts, [](const auto& cut) { return cut.second->known.has_value(); });
  std::vector<std::string> rows(cuts.size());
  parallel_for(cuts.size(), threads, [&](std::size_t i) { rows[i] = rows_of(*cuts[i].first, *cuts[i].second, known); });
  std::string csv = fmt::format(
      "# seaglint {} compare: compared - export, amplitudes in metres, e^{{+jwt}}, basis of CONVENTIONS.md\n"
      "export,line,compared,polarisation,frequency_hz,azimuth_deg,elevation_deg,export_dbsm,compared_dbsm,difference_"
      "db,"
      "export_re,export_im,compared_re,compared_im{}\n",
      kVersion, known ? ",known_dbsm" : "");
  std::size_t size = csv.size();
  for (const std::string& text : rows) size += text.size();
  csv.reserve(size);
  for (const std::string& text : rows) csv += text;
  return csv;
}

}  // namespace seaglint
