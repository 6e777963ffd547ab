// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string_view>

#include "classify/model/data_rows.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/json.h"
#include "sim/scenario/scenario.h"
#include "tools/page/html.h"
#include "tools/pipeline/scene.h"
#include "tools/pipeline/warnings.h"
#include "tools/report/finding.h"

namespace seaglint {

namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr const char* kGroups[3] = {"handmade", "cnn", "fused"};
constexpr const char* kGroupNames[3] = {"hand-made", "CNN", "fused"};

std::string percent(double fraction) { return std::isfinite(fraction) ? fmt::format("{:.1f} %", 100 * fraction) : "–"; }

std::string number(std::size_t count) { return fmt::format("{}", count); }

// "93.3 % (88–98)" in HTML, with the 95 % interval if there is one.
std::string accuracy_cell(const Scores& scores) {
  const auto& [low, high] = scores.accuracy_95;
  std::string cell = percent(scores.accuracy);
  if (std::isfinite(low)) cell += fmt::format(" <small>({:.0f}–{:.0f})</small>", 100 * low, 100 * high);
  return cell;
}

// The protocols of the study: of a benchmark the second only.
std::vector<Protocol> protocols_of(const Study& study) {
  std::vector<Protocol> protocols;
  for (const Outcome& outcome : study.groups.front().outcomes) protocols.push_back(outcome.protocol);
  return protocols;
}

std::string probe_accuracy(const Study& study, std::string_view name) {
  const auto probe = std::ranges::find(study.probes, name, &ProbeResult::name);
  return percent(probe == study.probes.end() ? std::nan("") : probe->of_group().scores.accuracy);
}

// Interpretation of a probe's accuracy by its kind.
std::string reading(ProbeKind kind, bool chance, bool level_seen) {
  switch (kind) {
    case ProbeKind::kBlind: return chance ? "as chance" : "<b>away from chance: look for a leak</b>";
    case ProbeKind::kFeature:
      if (chance) return "chance: does not tell by itself";
      return level_seen ? "tells by itself; level has a part in what is found" : "tells by itself";
    case ProbeKind::kScale:
      if (chance) return "chance: level does not tell";
      return level_seen ? "level tells the class; features see it by what is found"
                        : "level tells the class; no feature uses it";
    default: break;
  }
  if (chance) return "chance: does not tell";
  return kind == ProbeKind::kRatio ? "tells the class: it decides what is found"
                                   : "tells by shape or strength of the target";
}

// Comparison of the accuracy on random rows with that of the group protocol; with overlapping 95 % intervals they are
// not distinguished.
std::string compared_protocols(const Scores& random, const Scores& group) {
  const double gap = 100 * (random.accuracy - group.accuracy);
  const std::string by = fmt::format("by {:.1f} points", std::abs(gap));
  if (!std::isfinite(gap)) return "";
  if (std::abs(gap) < 0.05) return "; here they agree";
  if (random.accuracy_95.low > group.accuracy_95.high) return ", so that random rows flatter " + by;
  if (random.accuracy_95.high < group.accuracy_95.low) return "; here random rows are the harder test, " + by;
  const bool known = std::isfinite(random.accuracy_95.low) && std::isfinite(group.accuracy_95.low);
  return fmt::format("; random rows come out {} {}, {}", gap > 0 ? "higher" : "lower", by,
                     known ? "which is within the intervals" : "without intervals to judge it by");
}

// Cells of the three groups of features in one bin, or in all (null), with the numbers of predictions and seas.
void add_accuracies(std::vector<std::string>& row, const std::array<const Scores*, 3>& of_groups) {
  for (const Scores* scores : of_groups) row.push_back(accuracy_cell(*scores));
  row.push_back(number(of_groups[0]->rows));
  row.push_back(number(of_groups[0]->groups));
}

std::array<const Outcome*, 3> outcomes_of(const Study& study, Protocol protocol) {
  return {&outcome_of(study, "handmade", protocol), &outcome_of(study, "cnn", protocol),
          &outcome_of(study, "fused", protocol)};
}

std::string heading_of(Protocol protocol, const DivisionWords& division) {
  return protocol == Protocol::kRandom ? "Random split of the maps (maps of one sea on both sides)"
                                       : escape_html(division.heading);
}

std::string heights_table(const Study& study, Protocol protocol) {
  Rows rows{{"H<sub>s</sub> (m)", "hand-made", "CNN", "fused", "test predictions", "test seas"}};
  const auto [a, b, c] = outcomes_of(study, protocol);
  for (std::size_t i = 0; i < a->primary.by_wave_height.size(); ++i) {
    const auto scores = [&](const Outcome* outcome) { return &outcome->primary.by_wave_height[i].scores; };
    rows.push_back({escape_html(a->primary.by_wave_height[i].text)});
    add_accuracies(rows.back(), {scores(a), scores(b), scores(c)});
  }
  rows.push_back({"all"});
  add_accuracies(rows.back(), {&a->primary.scores, &b->primary.scores, &c->primary.scores});
  return html_table(rows);
}

// Accuracy by the bins of every drawn key and swept quantity; empty without any.
std::string conditions_table(const Study& study, Protocol protocol, const DivisionWords& division) {
  Rows rows{{"quantity", "values", "hand-made", "CNN", "fused", "test predictions", "test seas"}};
  const auto [a, b, c] = outcomes_of(study, protocol);
  if (a->by_condition.empty()) return "";
  for (std::size_t key = 0; key < a->by_condition.size(); ++key) {
    const ConditionScores& condition = a->by_condition[key];
    const bool has_unit = !condition.unit.empty() && condition.unit != "1";
    for (std::size_t bin = 0; bin < condition.bins.size(); ++bin) {
      const auto scores = [&](const Outcome* outcome) { return &outcome->by_condition[key].bins[bin].scores; };
      rows.push_back({escape_html(condition.name),
                      escape_html(condition.bins[bin].text + (has_unit ? " " + condition.unit : ""))});
      add_accuracies(rows.back(), {scores(a), scores(b), scores(c)});
    }
  }
  return fmt::format("<details><summary>By drawn and swept quantities, {}</summary>\n{}</details>\n",
                     protocol == Protocol::kRandom ? "random split" : escape_html(division.heading), html_table(rows));
}

const char* fusion_name(Fusion fusion) { return fusion == Fusion::kSplit ? "split" : "in_sample"; }

std::string merits_table(const Study& study, const Scenario& scenario, const DivisionWords& division) {
  const ClassNames classes = class_names(scenario);
  const bool two = classes.size() == 2;
  Rows rows{{"features, split", "fusion", "accuracy", two ? "AUC" : "AUC, mean over pairs of classes", "log loss"}};
  if (two) {
    rows.front().push_back(fmt::format("predictions: {} as {}", escape_html(classes[0]), escape_html(classes[1])));
    rows.front().push_back(fmt::format("{} as {}", escape_html(classes[1]), escape_html(classes[0])));
  }
  rows.front().push_back("maps the trees learned from, each split");
  const auto add = [&](const std::string& name, const std::string& fusion, const Evaluation& evaluation) {
    const Scores& scores = evaluation.scores;
    const auto three = [](double x) { return std::isfinite(x) ? fmt::format("{:.3f}", x) : "–"; };
    rows.push_back({name, fusion, accuracy_cell(scores), three(scores.auc), three(scores.log_loss)});
    if (two) rows.back().insert(rows.back().end(), {number(scores.confusion[0][1]), number(scores.confusion[1][0])});
    rows.back().push_back(number(evaluation.train_rows));
  };
  const Fusion fusion = scenario.learning.fusion;
  const Fusion other = fusion == Fusion::kSplit ? Fusion::kInSample : Fusion::kSplit;
  for (const Protocol protocol : protocols_of(study)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Outcome& outcome = outcome_of(study, kGroups[k], protocol);
      const std::string name =
          fmt::format("{}, {}", kGroupNames[k], protocol == Protocol::kRandom ? "random" : escape_html(division.by));
      add(name, k == 0 ? "–" : fusion_name(fusion), outcome.primary);
      if (outcome.alternative) add(name, k == 0 ? "rows of split" : fusion_name(other), *outcome.alternative);
    }
  }
  return html_table(rows);
}

// Decisions of the fused features under the group protocol by truth.
std::string confusion_table(const Study& study, const ClassNames& classes, const DivisionWords& division) {
  Rows rows{{"truth"}};
  for (const std::string& name : classes) rows.front().push_back("declared " + escape_html(name));
  for (std::size_t truth = 0; truth < classes.size(); ++truth) {
    rows.push_back({escape_html(classes[truth])});
    for (const std::size_t count : outcome_of(study, "fused").primary.scores.confusion[truth])
      rows.back().push_back(number(count));
  }
  return fmt::format("<h3>Decisions by class, fused features, split {}</h3>\n", escape_html(division.by)) +
         html_table(rows);
}

std::string accuracy_tables(const Study& study, const Scenario& scenario, const DivisionWords& division) {
  std::string html;
  for (const Protocol protocol : protocols_of(study))
    html += fmt::format("<h3>{}</h3>\n", heading_of(protocol, division)) + heights_table(study, protocol);
  for (const Protocol protocol : protocols_of(study)) html += conditions_table(study, protocol, division);
  html += "<h3>Further figures of merit, all wave heights</h3>\n" + merits_table(study, scenario, division);
  const ClassNames classes = class_names(scenario);
  return classes.size() > 2 ? html + confusion_table(study, classes, division) : html;
}

// True if the accuracy increases from each height to the next.
bool rises(const std::vector<BinnedScores>& bins) {
  const auto is_no_rise = [](const BinnedScores& a, const BinnedScores& b) {
    return !(b.scores.accuracy > a.scores.accuracy);
  };
  return bins.size() > 1 && std::ranges::adjacent_find(bins, is_no_rise) == bins.end();
}

double median_mwr(const ReportData& data, const ColumnBin& height, int label) {
  return quartiles_of(data, {label, &height}, kReportQuantities[0].value).median;
}

// "0.1 (ship) and 0.2 (array)", from the last label to the first.
std::string by_class(const ClassNames& classes, const std::function<std::string(int label)>& value) {
  std::string text;
  for (int label = static_cast<int>(classes.size()) - 1; label >= 0; --label) {
    text += text.empty() ? "" : label > 0 ? ", " : " and ";
    text += fmt::format("{} ({})", value(label), classes[static_cast<std::size_t>(label)]);
  }
  return text;
}

std::string feature_table(const ReportData& data, const ClassNames& classes) {
  Rows rows{{"class, H<sub>s</sub>", "MWR ((m/s)²)", "CCF", "σ<sub>r</sub> (m)", "σ<sub>v</sub> (m/s)", "centres",
             "line explains"}};
  struct Cell {
    const char* format;
    double scale;
  };
  constexpr Cell kCells[] = {{"{:.3g}", 1}, {"{:.2f}", 1}, {"{:.1f}", 1},
                             {"{:.3f}", 1}, {"{:.0f}", 1}, {"{:.0f} %", 100}};
  for (const ColumnBin& height : data.heights.bins) {
    for (int label = data.classes - 1; label >= 0; --label) {
      rows.push_back({escape_html(fmt::format("{}, {} m", classes.at(static_cast<std::size_t>(label)), height.text))});
      for (std::size_t i = 0; i < std::size(kCells); ++i) {
        const Quartiles q = quartiles_of(data, {label, &height}, kReportQuantities[i].value);
        const auto text = [&](double x) { return fmt::format(fmt::runtime(kCells[i].format), kCells[i].scale * x); };
        rows.back().push_back(fmt::format("{} <small>({}–{})</small>", text(q.median), text(q.lower), text(q.upper)));
      }
    }
  }
  return html_table(rows);
}

// Medians of the variance that the line explains, "10°: 80 / 5 %, 30°: ...", at the wave height shown.
std::string explained_by_aspect(const ReportData& data) {
  std::vector<std::string> aspects;
  for (const ColumnBin& azimuth : data.azimuths.bins) {
    std::vector<std::string> explained;
    for (int label = data.classes - 1; label >= 0; --label) {
      const Quartiles q = quartiles_of(data, {label, data.height_shown(), &azimuth},
                                       [](const ReportRow& row) { return row.line.explained; });
      explained.push_back(fmt::format("{:.0f}", 100 * q.median));
    }
    aspects.push_back(fmt::format("{}°: {} %", azimuth.text, fmt::join(explained, " / ")));
  }
  return fmt::format("{}", fmt::join(aspects, ", "));
}

// Values of the expert notes that are not those of the rest of the page.
void add_note_values(PageValues& values, const RunResults& results, const Scenario& scenario) {
  const auto& [data, numbers] = results;
  const Study& study = numbers.study;
  const ClassNames classes = class_names(scenario);
  const ClutterSpec& clutter = scenario.clutter;
  values["spacing"] = fmt::format("{:g}", scenario.dataset.interval_spacing_s);
  values["compared"] = protocols_of(study).size() < 2
                           ? ""
                           : compared_protocols(outcome_of(study, "fused", Protocol::kRandom).primary.scores,
                                                outcome_of(study, "fused").primary.scores);
  values["seas"] = number(outcome_of(study, "handmade").primary.scores.groups);
  values["not_scaled"] = not_scaled(clutter);
  values["clutter"] = clutter.enabled
                          ? fmt::format("The clutter follows the target (SCR in dB: {})",
                                        value_text(scenario, "clutter.scr_db", fmt::format("{:g}", clutter.scr_db)))
                          : "There is no clutter";
  for (const auto& [value, probe] : {std::pair{"total_power", "total power"},
                                     {"ratio", "signal to clutter and noise"},
                                     {"sigma_r", "sigma_r alone"},
                                     {"sigma_v", "sigma_v alone"},
                                     {"mwr", "MWR alone"},
                                     {"ccf", "CCF alone"},
                                     {"centres", "number of centres"}})
    values[value] = probe_accuracy(study, probe);
  values["rises"] = rises(outcome_of(study, "handmade").primary.by_wave_height) ? "yes" : "";
  values["clean"] =
      std::ranges::all_of(study.probes,
                          [&](const ProbeResult& probe) {
                            return probe.kind != ProbeKind::kBlind || as_chance(probe, scenario.learning.split_repeats);
                          })
          ? "yes"
          : "";
  values["guessing"] = guessing(outcome_of(study, "fused").primary.scores).text();
  // The random code's pedestal and the velocity cell determine what the features can resolve.
  const double cell =
      make_pulse_train(scenario.radar, scenario.map.range_span_m, scenario.seed, 0).velocity_resolution_mps();
  values["velocity_cell"] = fmt::format("{:.3f}", cell);
  values["cell_mwr"] = fmt::format("{:.2g}", cell * cell / 12);
  const ColumnBin* shown = data.height_shown();
  values["shown_height"] = shown == nullptr ? "-" : shown->text;
  values["shown_residuals"] = by_class(classes, [&](int label) {
    return shown == nullptr ? "-" : fmt::format("{:.2g}", median_mwr(data, *shown, label));
  });
  values["class_names"] = fmt::format("{}", fmt::join(classes.rbegin(), classes.rend(), " / "));
  values["explained"] = explained_by_aspect(data);
  values["random_code"] = scenario.radar.hop_code != HopCode::kStepped ? "yes" : "";
  const auto thin = std::ranges::count_if(data.rows, [](const ReportRow& row) { return row.record.centres < 3; });
  values["thin"] = thin > 0 ? fmt::format("{}", thin) : "";
}

// Times, versions, seeds and the network of a run.
std::string provenance_table(const RunNumbers& numbers, const Scenario& scenario) {
  Rows rows{{"item", "value"}};
  for (const auto& [stage, seconds] : numbers.run.seconds)
    rows.push_back({fmt::format("time for {}", stage), fmt::format("{:.1f} s", seconds)});
  rows.push_back({"threads", fmt::format("{}", numbers.run.threads)});
  rows.push_back({"maps made in this run / kept from an earlier one",
                  fmt::format("{} / {}", numbers.run.maps_made, numbers.run.maps_kept)});
  rows.push_back({"program", "seaglint " + escape_html(numbers.version)});
  rows.push_back({"scenario, seed", fmt::format("{}, {}", escape_html(scenario.name), scenario.seed)});
  rows.push_back({"scenario SHA-256", "<code>" + escape_html(numbers.scenario_sha256) + "</code>"});
  rows.push_back({"processor", escape_html(fmt::format("{}", fmt::join(numbers.processors, "; ")))});
  rows.push_back({"network", fmt::format("{} parameters, weights of epoch {}", numbers.network.parameters,
                                         numbers.network.epochs)});
  const std::vector<double>& losses = numbers.network.training_loss;
  if (!losses.empty())
    rows.push_back({"network’s training loss, first and last epoch",
                    fmt::format("{:.3f}, {:.3f}", losses.front(), losses.back())});
  return html_table(rows, false);
}

// The smaller of a figure's files: the SVG, except for a scatter of many points.
const std::filesystem::path& smaller_file(const ReportFigure& figure) {
  const bool svg =
      !figure.svg.empty() && std::filesystem::file_size(figure.svg) <= std::filesystem::file_size(figure.png);
  return svg ? figure.svg : figure.png;
}

// The figures of a section, two per row. `replaced`: report.js draws something else in their place.
std::string figures_of(const std::vector<ReportFigure>& all, const std::string& section, bool replaced) {
  std::string html;
  for (const ReportFigure& figure : all)
    if (figure.section == section)
      html += html_figure(smaller_file(figure), figure.caption, figure.alternative, figure.plot);
  return html.empty() ? html : fmt::format("<div class=\"{}\">\n{}</div>\n", replaced ? "pair static" : "pair", html);
}

// What report.js reads where it draws maps.
std::string explorer_of(const ReportData& data) {
  std::vector<SampleRecord> records;
  for (const ReportRow& row : data.rows) records.push_back(row.record);
  const double azimuth_deg = data.shown.empty() ? 0 : data.shown.front().sample.record.azimuth_deg;
  std::size_t azimuth = 0;
  while (azimuth + 1 < data.azimuths.bins.size() && data.azimuths.bins[azimuth].highest < azimuth_deg) ++azimuth;
  return explorer_json(
      {records, data.maps, data.axes, data.heights.bins, data.azimuths.bins, data.shown_height, azimuth});
}

std::string benchmark_table(const std::vector<StoredBenchmark::Row>& entries, const StoredBenchmark& benchmark,
                            const char* title) {
  Rows rows{{title, "all"}};
  for (const std::string& height : benchmark.heights) rows.front().push_back("Hs " + escape_html(height) + " m");
  for (const StoredBenchmark::Row& entry : entries) {
    rows.push_back({escape_html(entry.name) + (entry.leaks ? " *" : "")});
    rows.back().insert(rows.back().end(), entry.values.begin(), entry.values.end());
  }
  return html_table(rows);
}

// The study's verdicts on the paper's claims (claims_of()) under each of its protocols, and those of a benchmark.
std::string claims_table(const Study& study, const Scenario& scenario) {
  Rows rows{{"The paper’s claim"}};
  for (const Protocol protocol : protocols_of(study)) {
    const std::vector<Claim> claims = claims_of(study, protocol);
    const std::string by = escape_html(division_words(scenario.learning.split, study.division).by);
    rows.resize(claims.size() + 1);
    rows[0].insert(rows[0].end(),
                   {protocol == Protocol::kRandom ? "Random split (the paper’s)" : "Split " + by, "Verdict"});
    for (std::size_t i = 0; i < claims.size(); ++i) {
      if (rows[i + 1].empty()) rows[i + 1].push_back(escape_html(claims[i].text));
      rows[i + 1].insert(rows[i + 1].end(), {escape_html(claims[i].why), name(claims[i].verdict)});
    }
  }
  rows[0].push_back("Meaning");
  const std::vector<Claim> claims = claims_of(study);
  for (std::size_t i = 0; i < claims.size(); ++i) rows[i + 1].push_back(escape_html(claims[i].meaning));
  return html_table(rows, false);
}

std::string claims_table(const std::vector<Claim>& claims) {
  Rows rows{{"claim of the paper", "", "figures", "meaning"}};
  for (const Claim& claim : claims)
    rows.push_back({escape_html(claim.text), name(claim.verdict), escape_html(claim.why), escape_html(claim.meaning)});
  return html_table(rows, false);
}

}  // namespace

std::string probes_table(const Study& study, const Scenario& scenario) {
  Rows rows{{"probe", "what it is"}};
  // A benchmark has no random split.
  if (!study.probes.empty() && study.probes.front().evaluations.size() > 1) rows.front().push_back("random split");
  rows.front().push_back("split " + escape_html(division_words(scenario.learning.split, study.division).by));
  rows.front().push_back("reading");
  const bool level_seen = !not_scaled(scenario.clutter).empty();
  for (const ProbeResult& probe : study.probes) {
    rows.push_back({escape_html(probe.name), escape_html(probe.meaning)});
    for (const Evaluation& evaluation : probe.evaluations) rows.back().push_back(accuracy_cell(evaluation.scores));
    rows.back().push_back(reading(probe.kind, as_chance(probe, scenario.learning.split_repeats), level_seen));
  }
  return html_table(rows, false);
}

std::string benchmark_section(const StoredBenchmark& benchmark) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";  // in an address as in a name
  const bool is_linked = benchmark.folder.find_first_not_of(kPlain) == std::string::npos;
  return filled(benchmark_template(), {{"name", benchmark.record.name},
                                       {"small", benchmark.record.small ? "yes" : ""},
                                       {"maps", number(benchmark.record.maps)},
                                       {"seas", number(benchmark.record.seas)},
                                       {"division", benchmark.division},
                                       {"report", is_linked ? fmt::format("{}/{}", benchmark.folder, kReportFile) : ""},
                                       {"baselines", benchmark_table(benchmark.baselines, benchmark, "features")},
                                       {"floor", benchmark_table(benchmark.floor, benchmark, "without motion")},
                                       {"claims", claims_table(benchmark.claims)}});
}

std::string report_body(const RunResults& results, const Scenario& scenario, const PageParts& parts) {
  const auto& [data, numbers] = results;
  const Study& study = numbers.study;
  const ClassNames classes = class_names(scenario);
  const DivisionWords division = division_words(scenario.learning.split, study.division);
  const bool both_protocols = protocols_of(study).size() > 1, pooled = scenario.learning.split_repeats > 1;
  const auto accuracy = [&](const char* group, Protocol protocol = Protocol::kGroup) {
    return percent(outcome_of(study, group, protocol).primary.scores.accuracy);
  };
  double seconds = 0;
  for (const auto& [stage, of_stage] : numbers.run.seconds) seconds += of_stage;
  ClassNames named = classes;
  if (scenario.dataset.classes == default_classes()) std::ranges::reverse(named);  // the ship first
  PageValues values{{"the_question", capital(fmt::format("{}", fmt::join(named, " or ")))},
                    {"finding", finding(study, scenario)},
                    {"the_classes", classes.size() == 2 ? "two" : "classes"},
                    {"scenario", scenario.name},
                    {"seed", fmt::format("{}", scenario.seed)},
                    {"version", numbers.version},
                    {"maps", number(data.rows.size())},
                    {"handmade", accuracy("handmade")},
                    {"network", accuracy("cnn")},
                    {"fused", accuracy("fused")},
                    {"fused_random", both_protocols ? accuracy("fused", Protocol::kRandom) : ""},
                    {"unseen", division.unseen},
                    {"by", division.by},
                    {"by_sea", division.by_sea ? "yes" : ""},
                    {"run_seconds", fmt::format("{:.0f}", seconds)},
                    {"explorer", explorer_of(data)},
                    {"accuracy_tables", accuracy_tables(study, scenario, division)},
                    {"pooled", pooled ? "yes" : ""},
                    {"repeats", fmt::format("{}", scenario.learning.split_repeats)},
                    {"both_protocols", both_protocols ? "yes" : ""},
                    {"both_fusions", outcome_of(study, "fused").alternative ? "yes" : ""},
                    {"claims", scenario.report.claims == ReportClaims::kPaper ? claims_table(study, scenario) : ""},
                    {"feature_table", feature_table(data, classes)},
                    {"even_chance", fmt::format("{:.0f}", 100.0 / static_cast<double>(classes.size()))},
                    {"probes", probes_table(study, scenario)},
                    {"missing", parts.missing},
                    {"hot_spots", parts.hot_spots.json},
                    {"hot_spots_about", parts.hot_spots.about},
                    {"provenance", provenance_table(numbers, scenario)},
                    {"effective_scenario", effective_yaml(scenario)}};
  for (const char* section :
       {"maps", "accuracy", "wrong", "scatter", "features", "neighbours", "aspects", "sea", "targets"}) {
    const bool replaced = section == std::string_view("maps") || section == std::string_view("scatter");
    values[fmt::format("{}_figures", section)] = figures_of(parts.figures, section, replaced);
  }
  for (const StoredBenchmark& benchmark : parts.benchmarks) values["benchmarks"] += benchmark_section(benchmark);
  values["benchmarks"];
  std::vector<std::string> residuals;  // of a ship and an array
  for (const ColumnBin& height : data.heights.bins)
    if (classes.size() == 2)
      residuals.push_back(
          fmt::format("{} m: {:.2g} / {:.2g}", height.text, median_mwr(data, height, 1), median_mwr(data, height, 0)));
  values["residuals"] = fmt::format("{}", fmt::join(residuals, "; "));
  values["residual_classes"] = fmt::format("{}", fmt::join(classes.rbegin(), classes.rend(), " / "));
  add_note_values(values, results, scenario);
  return filled(report_template(), values);
}

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

// Names a missing input file of the scenario, without which neither the targets' pictures nor their motion can be
// drawn; empty if all exist.
std::string missing_input(const Scenario& scenario) {
  try {
    input_files(scenario);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// `missing`: reason why no targets are drawn; `begin`: start time of the report.
void draw_and_write(const ReportRequest& request, const std::string& missing, Clock::time_point begin) {
  auto& [data, numbers] = request.results;
  const fs::path& directory = request.directory;
  write_metrics(directory, numbers.run, data);  // `report` can read it if a figure fails
  const PageParts parts{
      draw_report_figures(request),
      hot_spots(request.scenario, request.plan, request.targets, thread_count(request.threads), request.stop), missing,
      read_benchmarks(directory)};
  numbers.run.seconds.emplace_back("report", std::chrono::duration<double>(Clock::now() - begin).count());
  const std::string body = report_body(request.results, request.scenario, parts);
  write_metrics(directory, numbers.run, data);
  write_file(directory / kReportFile, html_page("seaglint: " + request.scenario.name, body,
                                                std::string(report_script()) + std::string(hot_spots_script())));
  remove_leftovers(directory);
}

}  // namespace

void write_report(const ReportRequest& request) { draw_and_write(request, "", Clock::now()); }

void write_report(const fs::path& directory, const Scenario& scenario, int threads, const StopFlag* stop) {
  const auto begin = Clock::now();
  const SamplePlan plan(scenario);
  RunNumbers numbers = read_metrics(directory, scenario);
  RunResults results{load_report_data(directory, scenario, plan, stop), std::move(numbers)};
  const std::string missing = missing_input(scenario);
  if (!missing.empty()) warn(std::array{missing + "; neither the targets nor their motion are drawn"});
  const std::vector<Target> targets =
      missing.empty() ? load_targets({.scenario = scenario, .plan = plan}) : std::vector<Target>();
  draw_and_write({directory, scenario, plan, targets, results, threads, stop}, missing, begin);
}

}  // namespace seaglint
