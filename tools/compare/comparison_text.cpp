// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/comparison_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/parallel.h"
#include "sim/core/process/printable.h"
#include "tools/page/html.h"
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
  const bool phases = !cut.amplitude_m.empty() && !model.amplitude_m.empty();
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
      text += fmt::format("{:<{}}  {:<{}}  {:<{}}  {:>7}  {:>7.3f}  {:>7.3f}  {:>7.3f}  {:>7.3f}  {}\n", c.name, width,
                          kQuantityNames[s.quantity()], pol, c.compared, other, s.difference.points,
                          s.difference.bias_db, s.difference.mean_db, s.difference.rms_db, s.p95_db,
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
      entry["pairs"] = s.difference.points;
      entry["bias_db"] = s.difference.bias_db;
      entry["mean_abs_db"] = s.difference.mean_db;
      entry["rms_db"] = s.difference.rms_db;
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

namespace {

const char* name_of(const ElementStatistics& s) { return kQuantityNames[s.quantity()]; }

std::string decibels(double value) { return fmt::format("{:.2f}", value); }

std::string signed_decibels(double value) { return fmt::format("{:+.2f}", value); }

std::string extrema_cell(const ExtremumPairs& pairs, CutAxis axis) {
  if (axis == CutAxis::kSeveral || pairs.count == 0) return "-";
  return fmt::format("{} of {}, {:.3g} {}, {:.2f} dB", pairs.paired, pairs.count, pairs.mean_shift, axis_unit(axis),
                     pairs.mean_db);
}

std::string differences(const std::vector<ExportComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows{
      {"export", "element", "against", "pairs", "bias (dB)", "mean (dB)", "rms (dB)", "95 % (dB)", "correlation"}};
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements) {
      const std::string name =
          s.total ? fmt::format("total, {} transmitted", transmits_v(s.element) ? "v" : "h") : name_of(s);
      rows.push_back(
          {escape_html(c.name), name, escape_html(c.compared), fmt::format("{}", s.difference.points),
           decibels(s.difference.bias_db), decibels(s.difference.mean_db), decibels(s.difference.rms_db),
           decibels(s.p95_db),
           s.difference.correlation ? fmt::format("{:.4f}", std::abs(*s.difference.correlation)) : "no phases"});
    }
  }
  return html_table(rows);
}

// Both against exact and closed-form values: the bodies, the tables of statistics and of levels; each empty without.
void add_known_values(PageValues& values, const std::vector<ExportComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows{{"export", "element", "places", "export bias (dB)", "export rms (dB)",
                                              "compared bias (dB)", "compared rms (dB)", "closer"}};
  std::vector<std::vector<std::string>> levels{
      {"export", "element", "body", "known (dBsm)", "export (dBsm)", "compared (dBsm)", "closer"}};
  std::string& bodies = values["known_bodies"];
  for (const ExportComparison& c : comparisons) {
    if (!c.known) continue;
    bodies += fmt::format("<p>{}: {}, {}.</p>\n", escape_html(c.name), c.known->body, c.known->name);
    for (const KnownStatistics& s : c.known->statistics)
      rows.push_back({escape_html(c.name), kQuantityNames[s.quantity], fmt::format("{}", s.reference.points),
                      signed_decibels(s.reference.bias_db), decibels(s.reference.rms_db),
                      signed_decibels(s.compared.bias_db), decibels(s.compared.rms_db),
                      escape_html(closer_text(s.reference.rms_db, s.compared.rms_db, s.error_db, c.compared))});
    for (const KnownLevel& l : c.known->levels)
      levels.push_back({escape_html(c.name), kQuantityNames[l.quantity], l.body, decibels(l.known_dbsm),
                        decibels(l.reference_dbsm), decibels(l.compared_dbsm),
                        escape_html(closer_text(std::abs(l.reference_dbsm - l.known_dbsm),
                                                std::abs(l.compared_dbsm - l.known_dbsm), 0, c.compared))});
  }
  values["known_statistics"] = rows.size() > 1 ? html_table(rows, false) : "";
  values["known_levels"] = levels.size() > 1 ? html_table(levels, false) : "";
}

std::string lobes_and_nulls(const std::vector<ExportComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows{
      {"export", "element", "lobes paired, mean displacement and difference", "nulls paired"}};
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements)
      rows.push_back({escape_html(c.name), name_of(s), extrema_cell(s.lobes, s.axis), extrema_cell(s.nulls, s.axis)});
  }
  return html_table(rows, false);
}

std::string origin_text(const Alignment& a) {
  if (a.undetermined.size() == 3) return "not fixed by the data";
  std::string text =
      fmt::format("{:.1f}, {:.1f}, {:.1f}", 1e3 * a.origin_m.x(), 1e3 * a.origin_m.y(), 1e3 * a.origin_m.z());
  for (const Vec3& v : a.undetermined)
    text += fmt::format("; none along ({:.2f}, {:.2f}, {:.2f})", v.x(), v.y(), v.z());
  return text;
}

std::string fits(const std::vector<ExportComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows{
      {"export", "constant phase (deg)", "phase origin (mm)", "time factor", "signs hh hv vh vv", "level (dB)"}};
  for (const ExportComparison& c : comparisons) {
    if (!c.alignment) continue;
    const Alignment& a = *c.alignment;
    std::string signs;
    for (const int sign : a.sign) signs += sign < 0 ? "- " : "+ ";
    rows.push_back({escape_html(c.name), fmt::format("{:.1f}", degrees(a.phase_rad)), origin_text(a),
                    a.conjugated ? "e<sup>-j&omega;t</sup>, conjugated" : "e<sup>+j&omega;t</sup>", signs,
                    fmt::format("{:+.2f}", a.level_db)});
  }
  return rows.size() == 1 ? "" : html_table(rows, false);
}

std::string warnings(const std::vector<ExportComparison>& comparisons) {
  std::string items;
  for (const ExportComparison& c : comparisons) {
    if (c.interpolation)
      items += fmt::format("<p>{}: {}.</p>\n", escape_html(c.compared), escape_html(text_of(*c.interpolation)));
    for (const std::string& warning : c.warnings)
      items += fmt::format("<p class=\"note\">{}: {}</p>\n", escape_html(c.name), escape_html(warning));
  }
  return items;
}

std::string worst(const std::vector<ExportComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows{{"export, line", "element", "frequency (GHz)", "azimuth (deg)",
                                              "elevation (deg)", "difference (dB)", "largest contribution"}};
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements) {
      for (const ElementStatistics::Worst& w : s.worst) {
        const PairedCut::Place& p = w.place;
        rows.push_back({fmt::format("{}:{}", escape_html(c.name), p.line), name_of(s),
                        fmt::format("{:.6g}", 1e-9 * p.frequency_hz), fmt::format("{:.6g}", p.azimuth_deg),
                        fmt::format("{:.6g}", p.elevation_deg), decibels(w.difference_db), escape_html(w.main)});
      }
    }
  }
  return html_table(rows);
}

std::string readings(const std::vector<ExportComparison>& comparisons) {
  std::string items;
  for (const ExportComparison& c : comparisons) {
    std::string notes;
    for (const std::string& note : c.notes) notes += "; " + escape_html(note);
    for (const std::string& sentence : c.omitted) notes += "; " + escape_html(sentence);
    items += fmt::format("<li><b>{}</b>: read as {}{}</li>\n", escape_html(c.name), escape_html(c.reader), notes);
  }
  return items;
}

}  // namespace

std::string comparison_page(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                            const ComparisonFigures& figures) {
  const std::string title = comparisons.size() == 1
                                ? comparisons.front().name + " against " + comparisons.front().compared
                                : fmt::format("{} exports compared", comparisons.size());
  const auto figure = [](const ComparisonFigure& of, const char* caption, const char* alternative) {
    return of.file.empty() ? "" : html_figure(of.file, caption, alternative, of.plot);
  };
  PageValues values{
      {"title", title},
      {"floor_db", fmt::format("{:g}", settings.floor_db)},
      {"interpolated", settings.interpolation_radius_m ? "yes" : ""},
      {"differences", differences(comparisons)},
      {"solver", solver_text(comparisons)},
      {"warnings", warnings(comparisons)},
      {"curves", figure(figures.curves, "Levels above, differences below; at most four cuts.", "curves of both")},
      {"lobes_and_nulls", lobes_and_nulls(comparisons)},
      {"fits", fits(comparisons)},
      {"profiles",
       figure(figures.profiles, "Hann's window over all frequencies of a direction; a point has its own level.",
              "range profiles of both")},
      {"worst", worst(comparisons)},
      {"readings", readings(comparisons)},
      {"version", kVersion}};
  add_known_values(values, comparisons);
  return html_page(title, filled(comparison_template(), values));
}

}  // namespace seaglint
