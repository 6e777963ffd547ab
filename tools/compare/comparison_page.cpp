// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/comparison_page.h"

#include <fmt/format.h>

#include <cmath>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "tools/compare/comparison_text.h"
#include "tools/page/html.h"

namespace seaglint {
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
      rows.push_back({escape_html(c.name), name, escape_html(c.compared), fmt::format("{}", s.pairs),
                      decibels(s.bias_db), decibels(s.mean_abs_db), decibels(s.rms_db), decibels(s.p95_db),
                      s.correlation ? fmt::format("{:.4f}", *s.correlation) : "no phases"});
    }
  }
  return html_table(rows);
}

// Both against exact and closed-form values; empty without.
std::string known_table(const std::vector<ExportComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows{{"export", "element", "places", "export bias (dB)", "export rms (dB)",
                                              "compared bias (dB)", "compared rms (dB)", "closer"}};
  std::vector<std::vector<std::string>> levels{
      {"export", "element", "body", "known (dBsm)", "export (dBsm)", "compared (dBsm)", "closer"}};
  std::string bodies;
  for (const ExportComparison& c : comparisons) {
    if (!c.known) continue;
    bodies += fmt::format("<p>{}: {}, {}.</p>\n", escape_html(c.name), c.known->body, c.known->name);
    for (const KnownStatistics& s : c.known->statistics)
      rows.push_back({escape_html(c.name), kQuantityNames[s.quantity], fmt::format("{}", s.pairs),
                      signed_decibels(s.reference_bias_db), decibels(s.reference_rms_db),
                      signed_decibels(s.compared_bias_db), decibels(s.compared_rms_db),
                      escape_html(closer_text(s.reference_rms_db, s.compared_rms_db, s.error_db, c.compared))});
    for (const KnownLevel& l : c.known->levels)
      levels.push_back({escape_html(c.name), kQuantityNames[l.quantity], l.body, decibels(l.known_dbsm),
                        decibels(l.reference_dbsm), decibels(l.compared_dbsm),
                        escape_html(closer_text(std::abs(l.reference_dbsm - l.known_dbsm),
                                                std::abs(l.compared_dbsm - l.known_dbsm), 0, c.compared))});
  }
  if (bodies.empty()) return "";
  std::string text = "<h2>Against the known value</h2>\n" + bodies;
  if (rows.size() > 1)
    text += "<p>Bias and root mean square of the export and of the compared values, each minus the known value.</p>\n" +
            html_table(rows, false);
  if (levels.size() > 1) text += "<p>Levels of each body in the range profiles.</p>\n" + html_table(levels, false);
  return text;
}

std::string solver(const std::vector<ExportComparison>& comparisons) {
  const std::string text = solver_text(comparisons);
  return text.empty() ? text : fmt::format("<p>{}.</p>\n", escape_html(text));
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
  if (rows.size() == 1) return "<p>Nothing was fitted: no phases, or as asked.</p>\n";
  return html_table(rows, false);
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
  return "<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string comparison_page(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                            const ComparisonFigures& figures) {
  const std::string title = comparisons.size() == 1
                                ? comparisons.front().name + " against " + comparisons.front().compared
                                : fmt::format("{} exports compared", comparisons.size());
  std::string body = fmt::format(
      "<header><h1>{}</h1><p class=\"lead\">Levels clipped {:g} dB below the export's maximum; differences are "
      "compared - "
      "export; amplitudes in metres, e<sup>+j&omega;t</sup>, about the origin of the mesh. {}</p>"
      "</header>\n",
      escape_html(title), settings.floor_db,
      settings.interpolation_radius_m ? "The compared values are interpolated." : "Nothing is interpolated.");
  body += "<h2>Differences</h2>\n" + differences(comparisons) + solver(comparisons) + warnings(comparisons);
  body += known_table(comparisons);
  if (!figures.curves.file.empty())
    body += html_figure(figures.curves.file, "Levels above, differences below; at most four cuts.", "curves of both",
                        figures.curves.plot);
  body += lobes_and_nulls(comparisons);
  body += "<h2>Phase</h2>\n" + fits(comparisons);
  if (!figures.profiles.file.empty())
    body += "<h2>Range profiles</h2>\n" +
            html_figure(figures.profiles.file,
                        "Hann's window over all frequencies of a direction; a point has its own level.",
                        "range profiles of both", figures.profiles.plot);
  body += "<h2>Largest differences</h2>\n" + worst(comparisons);
  body += "<h2>How the files were read</h2>\n" + readings(comparisons);
  body += fmt::format(
      "<footer>seaglint {}. Every pair of values is in compare.csv, every figure in compare.json.</footer>\n",
      kVersion);
  return html_page(title, body);
}

}  // namespace seaglint
