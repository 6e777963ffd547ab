// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/comparison_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>

#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "tools/compare/comparison_text.h"
#include "tools/page/html.h"

namespace seaglint {

namespace {

const char* name_of(const ElementStatistics& s) { return kQuantityNames[s.quantity()]; }

double to_hundredths(double value) { return std::round(100 * value) / 100 + 0.0; }  // 0 has no sign

std::string decibels(double value) { return fmt::format("{:.2f}", to_hundredths(value)); }

std::string signed_decibels(double value) { return fmt::format("{:+.2f}", to_hundredths(value)); }

std::string extrema_cell(const ExtremumPairs& pairs, CutAxis axis) {
  if (axis == CutAxis::kSeveral || pairs.count == 0) return "-";
  return fmt::format("{} of {}, {:.3g} {}, {:.2f} dB", pairs.paired, pairs.count, pairs.mean_shift, axis_unit(axis),
                     pairs.mean_db);
}

std::string differences(const std::vector<ExportComparison>& comparisons) {
  std::vector<std::vector<std::string>> rows{{"export", "element", "against", "pairs", "bias (dB)", "mean (dB)",
                                              "rms (dB)", "90 % (dB)", "95 % (dB)", "correlation"}};
  for (const ExportComparison& c : comparisons) {
    for (const ElementStatistics& s : c.elements) {
      const std::string name =
          s.total ? fmt::format("total, {} transmitted", transmits_v(s.element) ? "v" : "h") : name_of(s);
      rows.push_back(
          {escape_html(c.name), name, escape_html(c.compared), fmt::format("{}", s.difference.points),
           decibels(s.difference.bias_db), decibels(s.difference.mean_db), decibels(s.difference.rms_db),
           decibels(s.p90_db), decibels(s.p95_db),
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
    for (const ElementStatistics& s : c.elements) {
      if (s.axis != CutAxis::kSeveral && s.lobes.count + s.nulls.count > 0)
        rows.push_back({escape_html(c.name), name_of(s), extrema_cell(s.lobes, s.axis), extrema_cell(s.nulls, s.axis)});
    }
  }
  return rows.size() > 1 ? html_table(rows, false) : "";
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

// The largest differences of each element, of the strongest element first: what contributes most there, then the
// values. Two elements with the same values, hv and vh of one antenna, share a row.
std::string worst(const std::vector<ExportComparison>& comparisons) {
  constexpr std::size_t kContribution = 3;  // columns of it
  const auto is_explained = [](const ExportComparison& c) {
    return std::ranges::any_of(c.elements, [](const ElementStatistics& s) {
      return std::ranges::any_of(s.worst, [](const ElementStatistics::Worst& w) { return w.main.has_value(); });
    });
  };
  std::vector<std::vector<std::string>> rows;
  for (const ExportComparison& c : comparisons) {
    std::vector<const ElementStatistics*> elements;
    for (const ElementStatistics& s : c.elements) elements.push_back(&s);
    std::ranges::stable_sort(elements, std::ranges::greater{}, &ElementStatistics::highest_dbsm);
    for (const ElementStatistics* s : elements) {
      for (const ElementStatistics::Worst& w : s->worst) {
        const PairedCut::Place& p = w.place;
        std::vector<std::string> cells;
        if (w.main) {
          cells = {escape_html(w.main->part), fmt::format("{}", w.main->bounces), w.main->mechanism};
        } else {
          cells.assign(kContribution, "-");
        }
        cells.insert(
            cells.end(),
            {signed_decibels(w.difference_db), name_of(*s), fmt::format("{:.6g}", 1e-9 * p.frequency_hz),
             fmt::format("{:.6g}", p.azimuth_deg), fmt::format("{:.6g}", p.elevation_deg),
             fmt::format("{:.1f}", w.reference_dbsm), fmt::format("{:.1f}", s->highest_dbsm - w.reference_dbsm),
             comparisons.size() > 1 ? fmt::format("{}:{}", escape_html(c.name), p.line) : fmt::format("{}", p.line)});
        constexpr std::size_t kElement = kContribution + 1;
        const auto same = std::ranges::find_if(rows, [&](const std::vector<std::string>& row) {
          for (std::size_t i = 0; i < row.size(); ++i) {
            if (i != kElement && row[i] != cells[i]) return false;
          }
          return true;
        });
        if (same != rows.end()) {
          (*same)[kElement] += fmt::format(", {}", cells[kElement]);
        } else {
          rows.push_back(std::move(cells));
        }
      }
    }
  }
  rows.insert(rows.begin(),
              {"part", "bounces", "mechanism", "difference (dB)", "element", "GHz", "az (deg)", "el (deg)",
               "export (dBsm)", "below max (dB)", comparisons.size() > 1 ? "export, line" : "line"});
  if (std::ranges::none_of(comparisons, is_explained)) {
    for (std::vector<std::string>& row : rows) row.erase(row.begin(), row.begin() + kContribution);
  }
  return html_table(rows);
}

std::string verdicts(const std::vector<ExportComparison>& comparisons) {
  std::string text;
  for (const ExportComparison& c : comparisons) {
    if (!c.elements.empty()) text += fmt::format("<p class=\"verdict\">{}</p>\n", escape_html(verdict(c)));
  }
  return text;
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

// Levels of one cut for the script of the page: 16-bit steps above a floor, little-endian, of export and compared
// values, then of the known ones; 65535 is none.
std::string packed_cut(const ExportComparison& c, std::size_t index, const PairedCut& cut, double floor_db,
                       std::size_t x_index) {
  constexpr double kFinest_db = 0.002, kSteps = 65'000;
  constexpr std::uint16_t kNone = 65535;
  const PairedCut::Model& model = cut.models[0];
  const double highest = std::ranges::max(cut.level_dbsm), bottom = highest - floor_db;
  const double step = std::max(kFinest_db, (std::max(highest, std::ranges::max(model.level_dbsm)) - bottom) / kSteps);
  std::vector<std::uint8_t> bytes;
  const auto add = [&](const std::vector<double>& levels) {
    for (const double level : levels) {
      const auto steps = std::isnan(level)
                             ? kNone
                             : static_cast<std::uint16_t>(std::clamp((level - bottom) / step + 0.5, 0.0, kSteps));
      bytes.push_back(static_cast<std::uint8_t>(steps & 255u));
      bytes.push_back(static_cast<std::uint8_t>(steps >> 8));
    }
  };
  add(cut.level_dbsm);
  add(model.level_dbsm);
  if (cut.known) add(cut.known->level_dbsm);
  constexpr const char* kAxes[] = {"azimuth", "elevation", "frequency"};
  const PairedCut::Place& place = cut.places.front();
  const auto fixed = [&](CutAxis axis, double value) { return cut.axis == axis ? "null" : json_number(value, 9); };
  return fmt::format(R"({{"export":{},"pol":{},"along":"{}","ghz":{},"az":{},"el":{},"x":{},"bottom":{},"step":{},)"
                     R"("name":{},"compared":{},"known":{},"levels":"{}"}})",
                     index, json_string(kQuantityNames[cut.quantity()]), kAxes[static_cast<int>(cut.axis)],
                     fixed(CutAxis::kFrequency, 1e-9 * place.frequency_hz), fixed(CutAxis::kAzimuth, place.azimuth_deg),
                     fixed(CutAxis::kElevation, place.elevation_deg), x_index, json_number(bottom, 9),
                     json_number(step, 9), json_string(c.name), json_string(c.compared),
                     cut.known ? json_string(cut.known->name) : "null", packed(bytes));
}

struct PageCuts {
  std::string json;  // empty without any curve
  std::size_t shown = 0, all = 0;
};

// {"x": [[...], ...], "cuts": [...]}: the cuts along one axis, as many as the page has room for.
PageCuts page_cuts(const std::vector<ExportComparison>& comparisons, double floor_db) {
  constexpr std::size_t kRoom = 2'000'000;  // characters
  PageCuts page;
  std::map<std::vector<double>, std::size_t> axes;
  std::vector<std::string> cuts, x;
  std::size_t size = 0;
  for (std::size_t e = 0; e < comparisons.size(); ++e) {
    for (const PairedCut& cut : comparisons[e].cuts) {
      if (cut.axis == CutAxis::kSeveral || cut.x.size() < 2) continue;
      ++page.all;
      if (size > kRoom) continue;
      const auto [axis, is_new] = axes.try_emplace(cut.x, axes.size());
      if (is_new) size += x.emplace_back(json_numbers(cut.x, 9)).size();
      size += cuts.emplace_back(packed_cut(comparisons[e], e, cut, floor_db, axis->second)).size();
      ++page.shown;
    }
  }
  if (page.shown > 0) page.json = fmt::format(R"({{"x":[{}],"cuts":[{}]}})", fmt::join(x, ","), fmt::join(cuts, ","));
  return page;
}

}  // namespace

std::string comparison_page(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                            const ComparisonFigures& figures) {
  const std::string title = comparisons.size() == 1
                                ? comparisons.front().name + " against " + comparisons.front().compared
                                : fmt::format("{} exports compared", comparisons.size());
  const auto figure = [](const std::filesystem::path& file, const char* caption, const char* alternative,
                         const std::string& plot = {}) {
    return file.empty() ? "" : html_figure(file, caption, alternative, plot);
  };
  std::string images;
  constexpr const char* kImages[] = {"image of the export's levels", "image of the compared levels",
                                     "image of the differences"};
  for (std::size_t i = 0; i < figures.images.size(); ++i) images += figure(figures.images[i], "", kImages[i]);
  std::string turntables;
  constexpr const char* kTurntables[] = {"turntable image of the export", "range profiles of the export",
                                         "turntable image of the compared values",
                                         "range profiles of the compared values"};
  for (std::size_t i : {0u, 2u, 1u, 3u}) {
    if (i < figures.turntables.size()) turntables += figure(figures.turntables[i], "", kTurntables[i]);
  }
  const PageCuts cuts = page_cuts(comparisons, settings.floor_db);
  PageValues values{
      {"title", title},
      {"verdicts", verdicts(comparisons)},
      {"floor_db", fmt::format("{:g}", settings.floor_db)},
      {"interpolated", settings.interpolation_radius_m ? "yes" : ""},
      {"differences", differences(comparisons)},
      {"solver", solver_text(comparisons)},
      {"warnings", warnings(comparisons)},
      {"cuts", cuts.json},
      {"left_out", cuts.shown < cuts.all
                       ? fmt::format("The page has {} of {} cuts; all pairs are in compare.csv.", cuts.shown, cuts.all)
                       : ""},
      {"curves", figure(figures.curves, "Levels above, differences below; at most four cuts.", "curves of both")},
      {"images", images.empty() ? "" : "<div class=\"maps three\">" + images + "</div>"},
      {"lobes_and_nulls", lobes_and_nulls(comparisons)},
      {"fits", fits(comparisons)},
      {"profiles",
       figure(figures.profiles, "Hann's window over all frequencies of a direction; a point has its own level.",
              "range profiles of both", figures.profiles_plot)},
      {"turntables", turntables.empty() ? "" : "<div class=\"maps\">" + turntables + "</div>"},
      {"worst", worst(comparisons)},
      {"readings", readings(comparisons)},
      {"version", kVersion}};
  add_known_values(values, comparisons);
  return html_page(title, filled(comparison_template(), values), comparison_script());
}

}  // namespace seaglint
