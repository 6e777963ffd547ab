// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/json.h"
#include "sim/scenario/writer.h"
#include "tools/page/html.h"
#include "tools/pipeline/scene.h"
#include "tools/pipeline/train.h"
#include "tools/pipeline/warnings.h"
#include "tools/report/explorer.h"
#include "tools/report/report_data.h"
#include "tools/report/report_figures.h"
#include "tools/report/report_text.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

using nlohmann::ordered_json;

// Throws InputError naming the file if it is no JSON object.
ordered_json read_object(const fs::path& file) {
  const std::string text = read_file(file);
  check_json(text, file.string(), kMaxOrderedKeys);
  try {
    ordered_json object = ordered_json::parse(text);
    if (!object.is_object()) throw InputError(fmt::format("{}: must be a JSON object", file.string()));
    return object;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), json_problem(error)));
  }
}

// The run's numbers; throws InputError if they differ from those of its model, as tables and figures would be of two
// trainings.
ordered_json read_metrics(const fs::path& directory, std::size_t classes) {
  const fs::path file = directory / kMetricsFile;
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: not the directory of a finished run: no {}", directory.string(), kMetricsFile));
  ordered_json metrics = read_object(file);
  // Members that every part of the page uses; a file of another version or origin is detected here.
  for (const char* member : {"handmade", "cnn", "fused", "probes", "network", "data", "run"}) {
    if (!metrics.contains(member)) throw InputError(fmt::format("{}: no member `{}`", file.string(), member));
  }
  const fs::path of_model = directory / "model" / kMetricsFile;
  if (!fs::exists(of_model)) {
    throw InputError(
        fmt::format("{}: missing: the last training did not end; go on by `seaglint run --resume`", of_model.string()));
  }
  const ordered_json model = read_object(of_model);
  for (const auto& [member, value] : model.items()) {
    if (metrics.contains(member) && metrics[member] == value) continue;
    throw InputError(fmt::format("{}: `{}` is of another training than {}; go on by `seaglint run --resume`",
                                 file.string(), member, of_model.string()));
  }
  const std::string fault = scores_fault(metrics, classes);
  if (!fault.empty()) throw InputError(fmt::format("{}: {}", file.string(), fault));
  return metrics;
}

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

// The smaller of a figure's files: the SVG, except for a scatter of many points.
const fs::path& smaller_file(const ReportFigure& figure) {
  const bool svg = !figure.svg.empty() && fs::file_size(figure.svg) <= fs::file_size(figure.png);
  return svg ? figure.svg : figure.png;
}

// The figures of a section, two per row. `replaced`: report.js draws something else in their place.
std::string figures(const std::vector<ReportFigure>& all, const std::string& section, bool replaced = false) {
  std::string html;
  for (const ReportFigure& figure : all) {
    if (figure.section != section) continue;
    html += html_figure(smaller_file(figure), figure.caption, figure.alternative, figure.plot);
  }
  return html.empty() ? html : fmt::format("<div class=\"{}\">\n{}</div>\n", replaced ? "pair static" : "pair", html);
}

std::string section(const char* id, const char* title, const std::string& content) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, content);
}

std::string targets_section(const std::vector<ReportFigure>& all, const HotSpots& spots, const std::string& missing) {
  if (!missing.empty()) {
    return fmt::format(
        "<p>Neither the targets nor their motion are drawn: {}. Report the run again where its files are found.</p>\n",
        escape_html(missing));
  }
  const std::string pictures = figures(all, "targets");
  if (pictures.empty()) return "<p>Ideal point scatterers; there is nothing to draw.</p>\n";
  std::string html;
  if (!spots.json.empty())
    html += fmt::format("<div id=\"hot-spots\"><script type=\"application/json\">{}</script></div>\n", spots.json);
  if (!spots.about.empty()) html += fmt::format("<p class=\"caption\">{}</p>\n", spots.about);
  return html + pictures;
}

// Where report.js draws maps, with what it reads.
std::string explorer(const ReportData& data) {
  std::vector<SampleRecord> records;
  for (const ReportRow& row : data.rows) records.push_back(row.record);
  const double azimuth_deg = data.shown.empty() ? 0 : data.shown.front().sample.record.azimuth_deg;
  std::size_t azimuth = 0;
  while (data.azimuths.bins[azimuth].highest < azimuth_deg) ++azimuth;
  return fmt::format("<div id=\"explorer\"><script type=\"application/json\">{}</script></div>\n",
                     explorer_json({records, data.maps, data.axes, data.heights.bins, data.azimuths.bins,
                                    data.shown_height, azimuth}));
}

// The benchmarks in folders of the run's directory, by name.
std::string benchmarks(const fs::path& run) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(run)) {
    if (is_there(entry.path() / kBenchmarkFile)) files.push_back(entry.path() / kBenchmarkFile);
  }
  std::sort(files.begin(), files.end());
  std::string html;
  for (const fs::path& file : files) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";  // in an address as in a name
    const std::string folder = file.parent_path().filename();
    const bool is_linked = folder.find_first_not_of(kPlain) == std::string::npos;
    try {
      html += benchmark_section(read_object(file), is_linked ? folder + "/" + kReportFile : "");
    } catch (const nlohmann::json::exception& error) {
      throw InputError(fmt::format("{}: {}", file.string(), json_problem(error)));
    }
  }
  return html;
}

// Times, versions, seeds and the network of a run, as HTML.
std::string provenance_table(const ordered_json& metrics) {
  std::vector<std::vector<std::string>> rows{{"item", "value"}};
  const auto& run = metrics.at("run");
  for (const auto& [stage, seconds] : run.at("seconds").items())
    rows.push_back({fmt::format("time for {}", stage), fmt::format("{:.1f} s", value_or_nan(seconds))});
  rows.push_back({"threads", fmt::format("{}", run.at("threads").get<int>())});
  rows.push_back(
      {"maps made in this run / kept from an earlier one",
       fmt::format("{} / {}", run.at("maps_made").get<std::size_t>(), run.at("maps_kept").get<std::size_t>())});
  rows.push_back({"program", "seaglint " + escape_html(metrics.at("version").get<std::string>())});
  rows.push_back({"scenario, seed", fmt::format("{}, {}", escape_html(metrics.at("scenario").get<std::string>()),
                                                metrics.at("seed").get<std::uint64_t>())});
  rows.push_back({"scenario SHA-256",
                  "<code>" + escape_html(metrics.at("data").at("scenario_sha256").get<std::string>()) + "</code>"});
  const auto processors = metrics.at("data").at("processors").get<std::vector<std::string>>();
  rows.push_back({"processor", escape_html(fmt::format("{}", fmt::join(processors, "; ")))});
  const auto& network = metrics.at("network");
  rows.push_back(
      {"network", fmt::format("{} parameters, weights of epoch {}", network.at("parameters").get<std::size_t>(),
                              network.at("epochs").get<int>())});
  const auto& losses = network.at("training_loss");
  if (!losses.empty())
    rows.push_back({"network’s training loss, first and last epoch",
                    fmt::format("{:.3f}, {:.3f}", value_or_nan(losses.front()), value_or_nan(losses.back()))});
  return html_table(rows, false);
}

std::string page(const ordered_json& metrics, const ReportData& data, const Scenario& scenario,
                 const std::vector<ReportFigure>& all, const HotSpots& spots, const std::string& missing,
                 const std::string& benchmarks) {
  const std::string name = escape_html(scenario.name);
  const ClassNames classes = class_names(scenario);
  const bool are_default = scenario.dataset.classes == default_classes();
  std::string body = fmt::format(
      "<header>\n<h1>{}?</h1>\n<p class=\"lead\">Simulated frequency-agile radar maps, their features and how well "
      "they tell the {} apart. Scenario <b>{}</b>, seed {}, seaglint {}.</p>\n</header>\n",
      are_default ? "Ship or corner-reflector array" : escape_html(fmt::format("{}", fmt::join(classes, " or "))),
      classes.size() == 2 ? "two" : "classes", name, scenario.seed,
      escape_html(metrics.at("version").get<std::string>()));
  body +=
      "<nav><a href=\"#maps\">Maps</a><a href=\"#accuracy\">Accuracy</a><a href=\"#paper\">The paper’s claims</a><a "
      "href=\"#features\">Features</a>" +
      std::string(benchmarks.empty() ? "" : "<a href=\"#benchmarks\">Equal geometry</a>") +
      "<a href=\"#aspects\">Aspects</a><a href=\"#probes\">Probes</a><a href=\"#notes\">What to notice</a><a "
      "href=\"#sea\">Sea and motion</a>"
      "<a href=\"#targets\">Targets</a><a href=\"#run\">Run</a><a href=\"#scenario\">Scenario</a></nav>\n";
  body += summary_tiles(metrics);
  body += section("maps", "Range-velocity maps",
                  "<p>Levels in dB below each map’s strongest cell. Circles are the scattering centres that CLEAN "
                  "finds; in pictures a frame contains them all. Range grows away from the "
                  "radar, velocity is positive when receding.</p>\n" +
                      explorer(data) + figures(all, "maps", true));
  body += section("accuracy", "Accuracy",
                  "<p>XGBoost (200 trees, depth 6 unless the scenario says otherwise) on three groups of features. In "
                  "brackets the 95 % interval of a bootstrap over sea "
                  "realisations.</p>\n" +
                      figures(all, "accuracy") + accuracy_tables(metrics, classes));
  body += section("paper", "The paper’s claims beside ours",
                  claims_table(metrics, classes) +
                      "<p>Whatever comes out is printed; nothing was tuned towards the paper. It used CST for the "
                      "echoes and DualSPHysics for the motion, "
                      "gives neither peak period nor wave direction, and tests on random rows.</p>\n");
  if (!benchmarks.empty()) body += section("benchmarks", "Classes with equal geometry", benchmarks);
  body += section("features", "Hand-made and learned features",
                  "<div id=\"scatter\"></div>\n" + figures(all, "scatter", true) + figures(all, "features") +
                      feature_table(metrics, classes));
  body += section("aspects", "Dependence on aspect", figures(all, "aspects"));
  body += section("probes", "Probes: what else could tell the class",
                  fmt::format("<p>Each quantity is given to the same trees by itself. Quantities that know nothing of "
                              "the target must stay near {:.0f} %.</p>\n",
                              100.0 / static_cast<double>(classes.size())) +
                      probes_table(metrics, scenario));
  body += section("notes", "What an expert should notice", expert_notes(metrics, scenario));
  body += section("sea", "Sea and motion", figures(all, "sea"));
  body += section("targets", "Targets", targets_section(all, spots, missing));
  body += section("run", "Run time, versions, seeds", provenance_table(metrics));
  body += section("scenario", "Effective scenario",
                  "<details><summary>Every key with its value</summary>\n<pre>" +
                      escape_html(effective_yaml(scenario)) + "</pre></details>\n");
  body +=
      "<footer>Made by seaglint. Every number of this page is in metrics.json or a benchmark.json, every figure a PNG "
      "(plots also SVG) "
      "beside it. Simulated data; nothing here was measured.</footer>\n";
  return html_page("seaglint: " + scenario.name, body, std::string(report_script()) + std::string(hot_spots_script()));
}

using Clock = std::chrono::steady_clock;

// `missing`: reason why no targets are drawn; `begin`: start time of the report.
double draw_and_write(const fs::path& directory, const Scenario& scenario, const SamplePlan& plan,
                      const std::vector<Target>& targets, const std::string& missing, RunResults results, int threads,
                      const StopFlag* stop, Clock::time_point begin) {
  ordered_json& metrics = results.metrics;
  const std::string file = (directory / kMetricsFile).string();
  double seconds = 0;
  std::string html;
  try {
    metrics["report"] = report_numbers(results.data);
    const std::vector<ReportFigure> all =
        draw_report_figures(directory, scenario, plan, targets, results.data, metrics, thread_count(threads), stop);
    const HotSpots spots = hot_spots(scenario, plan, targets, thread_count(threads), stop);
    seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    metrics["run"]["seconds"]["report"] = seconds;
    html = page(metrics, results.data, scenario, all, spots, missing, benchmarks(directory));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file, json_problem(error)));
  }
  write_file(file, metrics.dump(2) + "\n");
  write_file(directory / kReportFile, html);
  remove_leftovers(directory);
  return seconds;
}

}  // namespace

double write_report(const fs::path& directory, const Scenario& scenario, const SamplePlan& plan,
                    const std::vector<Target>& targets, RunResults results, int threads, const StopFlag* stop) {
  return draw_and_write(directory, scenario, plan, targets, "", std::move(results), threads, stop, Clock::now());
}

void write_report(const fs::path& directory, const Scenario& scenario, int threads, const StopFlag* stop) {
  const auto begin = Clock::now();
  RunResults results;
  results.metrics = read_metrics(directory, scenario.dataset.classes.size());
  const SamplePlan plan(scenario);
  results.data = load_report_data(directory, scenario, plan, stop);
  const std::string missing = missing_input(scenario);
  if (!missing.empty()) warn(std::array{missing + "; neither the targets nor their motion are drawn"});
  const std::vector<Target> targets = missing.empty() ? load_targets(scenario, plan) : std::vector<Target>();
  draw_and_write(directory, scenario, plan, targets, missing, std::move(results), threads, stop, begin);
}

}  // namespace seaglint
