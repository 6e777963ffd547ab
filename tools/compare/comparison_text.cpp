// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/comparison_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"
#include "sim/core/text/escape.h"
#include "tools/rcs/like_program.h"

namespace seaglint {
namespace {

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

nlohmann::ordered_json extrema_json(const ExtremumPairs& pairs, CutAxis axis) {
  if (axis == CutAxis::kSeveral) return nullptr;
  nlohmann::ordered_json json{{"count", pairs.count}, {"paired", pairs.paired}};
  json["unit"] = axis_unit(axis);
  json["mean_shift"] = pairs.mean_shift;
  json["mean_db"] = pairs.mean_db;
  return json;
}

nlohmann::ordered_json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json fitted_json(const ExportComparison& comparison, Polarisation element) {
  if (!comparison.alignment) return nullptr;
  const Alignment& a = *comparison.alignment;
  nlohmann::ordered_json json;
  json["phase_deg"] = degrees(a.phase_rad);
  json["origin_m"] = vector_json(a.origin_m);
  json["origin_error_m"] = vector_json(a.origin_error_m);
  json["undetermined"] = nlohmann::ordered_json::array();
  for (const Vec3& v : a.undetermined) json["undetermined"].push_back(vector_json(v));
  json["conjugated"] = a.conjugated;
  json["sign"] = a.sign[static_cast<std::size_t>(element)];
  json["offset_db"] = a.level_db;
  return json;
}

// ",1.23456789", nine significant digits.
void append_digits(std::string& text, double value) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, std::end(digits), value, std::chars_format::general, 9);
  SEAGLINT_CHECK(error == std::errc(), "at most 16 characters");
  (text += ',').append(digits, end);
}

// ",-12.3456".
void append_decibels(std::string& text, double value) {
  char digits[512];
  const auto [end, error] = std::to_chars(digits, std::end(digits), value, std::chars_format::fixed, 4);
  SEAGLINT_CHECK(error == std::errc(), "at most 315 characters");
  (text += ',').append(digits, end);
}

// known: a last column with the exact or closed-form levels, empty where there is none.
std::string rows_of(const ExportComparison& comparison, const PairedCut& cut, bool known) {
  const std::string name = csv_cell(comparison.name) + ',';
  const std::string other = fmt::format(",{},{}", csv_cell(comparison.compared), kQuantityNames[cut.quantity()]);
  const PairedCut::Model& model = cut.models[0];
  const bool phases = !cut.amplitude_m.empty() && !model.amplitude_m.empty();
  std::string text;
  text.reserve(cut.places.size() * (name.size() + other.size() + 110));
  for (std::size_t i = 0; i < cut.places.size(); ++i) {
    const PairedCut::Place& p = cut.places[i];
    (text += name).append(fmt::format_int(p.line).c_str()).append(other);
    for (const double x : {p.frequency_hz, p.azimuth_deg, p.elevation_deg}) append_digits(text, x);
    for (const double level : {cut.level_dbsm[i], model.level_dbsm[i], model.level_dbsm[i] - cut.level_dbsm[i]})
      append_decibels(text, level);
    if (phases) {
      const Complex a = cut.amplitude_m[i], b = model.amplitude_m[i];
      for (const double x : {a.real(), a.imag(), b.real(), b.imag()}) append_digits(text, x);
    } else {
      text += ",,,,";
    }
    if (known && cut.known && !std::isnan(cut.known->level_dbsm[i])) {
      append_decibels(text, cut.known->level_dbsm[i]);
    } else if (known) {
      text += ',';
    }
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json interpolation_json(const ExportComparison& comparison) {
  if (!comparison.interpolation) return nullptr;
  const InterpolationQuality& q = *comparison.interpolation;
  return {{"radius_m", q.radius_m},
          {"interpolated", q.interpolated},
          {"omitted", q.omitted},
          {"standard_error", q.standard_error},
          {"largest_error", q.largest_error}};
}

nlohmann::ordered_json solver_json(const ExportComparison& comparison) {
  if (!comparison.solver) return nullptr;
  const RcsRequest& request = *comparison.solver;
  nlohmann::ordered_json json;
  json["like"] = request.like.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(request.like);
  json["crease_deg"] =
      request.crease_deg ? nlohmann::ordered_json(*request.crease_deg) : nlohmann::ordered_json(nullptr);
  json["edges"] = request.edges;
  json["max_bounces"] = request.max_bounces;
  json["method"] = kSolverMethodNames[static_cast<int>(request.method)];
  return json;
}

// Known values of one quantity.
nlohmann::ordered_json known_json(const ExportComparison& comparison, std::size_t quantity) {
  if (!comparison.known) return nullptr;
  const KnownValues& known = *comparison.known;
  nlohmann::ordered_json json{{"body", known.body}, {"value", known.name}};
  for (const KnownStatistics& s : known.statistics) {
    if (s.quantity != quantity) continue;
    json["pairs"] = s.pairs;
    json["export_bias_db"] = s.reference_bias_db;
    json["export_rms_db"] = s.reference_rms_db;
    json["compared_bias_db"] = s.compared_bias_db;
    json["compared_rms_db"] = s.compared_rms_db;
    json["own_error_db"] = s.error_db;
    json["verdict"] = closer_text(s.reference_rms_db, s.compared_rms_db, s.error_db, comparison.compared);
  }
  json["levels"] = nlohmann::ordered_json::array();
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

nlohmann::ordered_json trials_json(const ExportComparison& comparison) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
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

std::string comparison_table(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings) {
  std::size_t width = 6, other = 8, pol = 3;
  for (const ExportComparison& c : comparisons) {
    width = std::max(width, c.name.size());
    other = std::max(other, c.compared.size());
    for (const ElementStatistics& s : c.elements)
      pol = std::max(pol, std::string_view(kQuantityNames[s.quantity()]).size());
  }
  std::string text = fmt::format(
      "Differences in dB, compared - export, both clipped at {:g} dB below the export's maximum:\n{:<{}}  {:<{}}  "
      "{:<{}}  {:>7}  {:>7}  {:>7}  {:>7}  {:>7}  correlation\n",
      settings.floor_db, "export", width, "pol", pol, "compared", other, "pairs", "bias", "mean", "rms", "95 %");
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements) {
      text +=
          fmt::format("{:<{}}  {:<{}}  {:<{}}  {:>7}  {:>7.3f}  {:>7.3f}  {:>7.3f}  {:>7.3f}  {}\n", c.name, width,
                      kQuantityNames[s.quantity()], pol, c.compared, other, s.pairs, s.bias_db, s.mean_abs_db, s.rms_db,
                      s.p95_db, s.correlation ? fmt::format("{:.4f}", *s.correlation) : std::string("no phases"));
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

nlohmann::ordered_json comparison_json(const std::vector<ExportComparison>& comparisons,
                                       const ComparisonSettings& settings) {
  nlohmann::ordered_json json;
  json["version"] = kVersion;
  json["settings"] = {{"floor_db", settings.floor_db}, {"as_is", settings.as_is}};
  json["exports"] = nlohmann::ordered_json::array();
  nlohmann::ordered_json not_compared = nlohmann::ordered_json::array();
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements) {
      nlohmann::ordered_json entry;
      entry["name"] = c.name;
      entry["reader"] = c.reader;
      entry["convention"] = c.notes;
      entry["omitted"] = c.omitted;
      entry["compared"] = c.compared;
      entry["polarisation"] = kQuantityNames[s.quantity()];
      entry["pairs"] = s.pairs;
      entry["bias_db"] = s.bias_db;
      entry["mean_abs_db"] = s.mean_abs_db;
      entry["rms_db"] = s.rms_db;
      entry["p95_db"] = s.p95_db;
      entry["correlation"] = s.correlation ? nlohmann::ordered_json(*s.correlation) : nlohmann::ordered_json(nullptr);
      entry["fitted"] = fitted_json(c, s.element);
      entry["lobes"] = extrema_json(s.lobes, s.axis);
      entry["nulls"] = extrema_json(s.nulls, s.axis);
      entry["worst"] = nlohmann::ordered_json::array();
      for (const ElementStatistics::Worst& worst : s.worst) {
        entry["worst"].push_back({{"difference_db", worst.difference_db},
                                  {"frequency_hz", worst.place.frequency_hz},
                                  {"azimuth_deg", worst.place.azimuth_deg},
                                  {"elevation_deg", worst.place.elevation_deg},
                                  {"line", worst.place.line},
                                  {"main_contribution", worst.main}});
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
  return json;
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
