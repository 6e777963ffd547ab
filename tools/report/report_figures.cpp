// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_figures.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "classify/model/data_rows.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/layout/layout.h"
#include "sim/scenario/sample_plan.h"
#include "tools/figure/figure.h"
#include "tools/figure/map_figure.h"
#include "tools/figure/mesh_picture.h"
#include "tools/figure/tsne.h"
#include "tools/page/html.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/scene.h"
#include "tools/report/explorer.h"
#include "tools/report/report_data.h"

namespace seaglint {

namespace {

constexpr std::size_t kMostDrawnPlots = 12;  // of one report; metrics.json has the others, too

constexpr std::pair<const char*, const char*> kGroupLabels[3] = {
    {"handmade", "hand-made"}, {"cnn", "CNN"}, {"fused", "fused"}};

std::string split_name(const SplitSpec& split, Protocol protocol) {
  if (protocol == Protocol::kRandom) return "random split of the maps";
  return split.by == "sea" ? "split by sea realisation" : "split by " + split.by;
}

constexpr double kFewestAlarms = 0.1;  // %, left end of the ROC's logarithmic axis

// Points of fewer false alarms, none among them, stand at kFewestAlarms.
Series curve_of(std::string name, const std::vector<RocPoint>& points) {
  Series series;
  series.name = std::move(name);
  for (const RocPoint& point : points) {
    series.x.push_back(std::max(100 * point.false_alarms, kFewestAlarms));
    series.y.push_back(100 * point.detections);
  }
  return series;
}

// Of two classes, without curves.
LinePlot empty_roc_plot(std::string title) {
  LinePlot plot;
  plot.title = std::move(title);
  plot.x = {"false alarms: label 0 declared label 1 (%)", AxisRange{kFewestAlarms, 100}, true};
  plot.y = {"detections: label 1 declared label 1 (%)", AxisRange{0, 102}, false};
  return plot;
}

Series chance() {
  Series series{"chance", {}, {}, {}, SeriesStyle::kLines};
  for (int i = 0; i <= 60; ++i) series.x.push_back(kFewestAlarms * std::pow(10, i / 20.0));
  series.y = series.x;
  return series;
}

// Accuracy of each group of features, %, with 95 % intervals, over the means of the bins of bins_of(group).
LinePlot binned_accuracy_plot(std::string title, FigureAxis axis,
                              const std::function<const std::vector<BinnedScores>&(const char* group)>& bins_of) {
  LinePlot plot;
  plot.title = std::move(title);
  plot.x = std::move(axis);
  double least = std::numeric_limits<double>::infinity(), most = -least, lowest = 50;
  for (const BinnedScores& bin : bins_of(kGroupLabels[0].first)) {
    least = std::min(least, bin.mean);
    most = std::max(most, bin.mean);
  }
  const double span = most > least ? most - least : std::max(most, 0.0);
  double shift = -0.012 * span;  // offset, so that the error bars do not overlap
  for (const auto& [group, label] : kGroupLabels) {
    Series series;
    series.name = label;
    series.style = SeriesStyle::kLinesPoints;
    for (const BinnedScores& bin : bins_of(group)) {
      const double accuracy = 100 * bin.scores.accuracy, low = 100 * bin.scores.accuracy_95.low,
                   high = 100 * bin.scores.accuracy_95.high;
      series.x.push_back(bin.mean + shift);
      series.y.push_back(accuracy);
      series.interval.push_back({std::isfinite(low) ? low : accuracy, std::isfinite(high) ? high : accuracy});
      lowest = std::min(lowest, series.interval.back()[0]);
    }
    plot.series.push_back(std::move(series));
    shift += 0.012 * span;
  }
  plot.y = {"accuracy on test maps (%)", AxisRange{std::floor(lowest / 10) * 10, 102}, false};
  return plot;
}

LinePlot accuracy_plot(const Study& study, const SplitSpec& split, Protocol protocol) {
  return binned_accuracy_plot(
      "Accuracy, " + split_name(split, protocol),
      {"significant wave height (m)", {}, false}, [&](const char* group) -> const auto& {
        return outcome_of(study, group, protocol).primary.by_wave_height;
      });
}

// The same under the group protocol over the drawn and swept quantities that are numbers: over the means of their bins.
std::vector<std::pair<std::string, LinePlot>> condition_accuracy_plots(const Study& study, const SplitSpec& split) {
  std::vector<std::pair<std::string, LinePlot>> plots;
  const std::vector<ConditionScores>& conditions = outcome_of(study, "handmade").by_condition;
  for (std::size_t i = 0; i < conditions.size() && plots.size() < kMostDrawnPlots; ++i) {
    const auto& [key, units, bins] = conditions[i];
    if (bins.size() < 2 || !std::isfinite(bins.front().mean)) continue;  // words and single values have no axis
    plots.emplace_back(
        key, binned_accuracy_plot(
                 "Accuracy, " + split_name(split, Protocol::kGroup),
                 {units == "1" ? key : fmt::format("{} ({})", key, units), {}, false},
                 [&](const char* group) -> const auto& { return outcome_of(study, group).by_condition[i].bins; }));
  }
  return plots;
}

// Detections over false alarms of the fused features under the group protocol, a curve for each bin of the wave
// height; none of more than two classes, and with one bin.
std::optional<LinePlot> roc_by_wave_height_plot(const Study& study, const SplitSpec& split) {
  LinePlot plot = empty_roc_plot("ROC by wave height, fused, " + split_name(split, Protocol::kGroup));
  for (const BinnedScores& bin : outcome_of(study, "fused").primary.by_wave_height) {
    if (bin.roc.size() != 1) return std::nullopt;  // more than two classes
    if (bin.roc.front().empty()) continue;         // maps of one class only
    plot.series.push_back(curve_of(fmt::format("{} m, AUC {:.3f}", bin.text, bin.scores.auc), bin.roc.front()));
  }
  if (plot.series.size() < 2) return std::nullopt;
  plot.series.push_back(chance());
  return plot;
}

}  // namespace

LinePlot roc_plot(const Study& study, const SplitSpec& split, Protocol protocol) {
  LinePlot plot = empty_roc_plot("ROC, " + split_name(split, protocol));
  const std::vector<std::vector<RocPoint>>& fused = outcome_of(study, "fused", protocol).roc;
  if (fused.size() > 1) {
    plot.title = "ROC of each class against the rest, fused, " + split_name(split, protocol);
    plot.x.label = "false alarms: others declared the class (%)";
    plot.y.label = "detections of the class (%)";
    for (std::size_t label = 0; label < fused.size(); ++label)
      plot.series.push_back(curve_of(study.classes[label], fused[label]));
  } else {
    for (const auto& [group, label] : kGroupLabels) {
      const Outcome& outcome = outcome_of(study, group, protocol);
      plot.series.push_back(
          curve_of(fmt::format("{}, AUC {:.3f}", label, outcome.primary.scores.auc), outcome.roc.front()));
    }
  }
  plot.series.push_back(chance());
  return plot;
}

namespace fs = std::filesystem;

namespace {

constexpr FigureSize kPlotSize{640, 430};
constexpr std::size_t kMaxNeighbours = 700;  // rows of a t-SNE plane

struct Drawing {
  ReportFigure figure;
  std::function<void(const fs::path&)> draw;  // of one file
};

class FigureList {
 public:
  // `notes`: small print of every figure of lines.
  FigureList(fs::path directory, std::vector<std::string> notes)
      : directory_(std::move(directory)), notes_(std::move(notes)) {}

  template <class Plot>
  void add(const std::string& section, const std::string& name, Plot plot, FigureSize size, std::string caption,
           std::string alternative, bool vector_too = true) {
    ReportFigure figure{section,
                        directory_ / (name + ".png"),
                        vector_too ? directory_ / (name + ".svg") : fs::path(),
                        std::move(caption),
                        std::move(alternative),
                        ""};
    if constexpr (std::is_same_v<Plot, LinePlot>) figure.plot = plot_json(plot);
    if constexpr (std::is_same_v<Plot, PlotPanels>) figure.plot = plot_json(plot.plots, plot.columns);
    drawings_.push_back({std::move(figure), [plot = std::move(plot), size, notes = notes_](const fs::path& file) {
                           if constexpr (std::is_same_v<Plot, PlotPanels>) {
                             PlotPanels panels = plot;
                             panels.notes = notes;
                             write_figure(panels, file);
                           } else if constexpr (std::is_same_v<Plot, LinePlot>) {
                             write_figure(PlotPanels{.plots = {plot}, .size = size, .notes = notes}, file);
                           } else {
                             write_figure(plot, file, size);
                           }
                         }});
  }

  void add_picture(const std::string& section, const std::string& name, std::function<void(const fs::path&)> draw,
                   std::string caption, std::string alternative) {
    drawings_.push_back(
        {{section, directory_ / (name + ".png"), {}, std::move(caption), std::move(alternative), ""}, std::move(draw)});
  }

  std::vector<ReportFigure> draw(int threads, const StopFlag* stop) const {
    struct Task {
      const Drawing* drawing;
      fs::path file;
    };
    std::vector<Task> tasks;
    for (const Drawing& drawing : drawings_) {
      tasks.push_back({&drawing, drawing.figure.png});
      if (!drawing.figure.svg.empty()) tasks.push_back({&drawing, drawing.figure.svg});
    }
    parallel_for(
        tasks.size(), threads, [&](std::size_t i) { tasks[i].drawing->draw(tasks[i].file); }, stop);
    std::vector<ReportFigure> figures;
    for (const Drawing& drawing : drawings_) figures.push_back(drawing.figure);
    return figures;
  }

 private:
  fs::path directory_;
  std::vector<std::string> notes_;
  std::vector<Drawing> drawings_;
};

std::string file_word(const std::string& name) {
  std::string word;
  for (const char c : name) word += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return word;
}

// A map in the target's window, its centres and the fitted line, with small print.
Heatmap map_of(const ShownMap& shown, const ReportRequest& request) {
  const Scenario& scenario = request.scenario;
  const SamplePlan& plan = request.plan;
  const SampleRecord& record = shown.sample.record;
  const LineFit line = fit_line(shown.sample.centre_list);
  Heatmap map = rv_figure({.sample = shown.sample, .axes = shown.axes, .line = {line.slope, line.intercept}});
  const SampleAddress address = plan.address(static_cast<std::size_t>(record.sample));
  std::ranges::copy(small_print(scenario, plan.drawn(scenario, address).radar, record), std::back_inserter(map.notes));
  map.notes.push_back("seaglint " + request.results.numbers.version);
  return map;
}

void add_maps(FigureList& list, const ReportRequest& request) {
  for (const ShownMap& shown : request.results.data.shown) {
    const SampleRecord& record = shown.sample.record;
    const LineFit line = fit_line(shown.sample.centre_list);
    list.add(
        "maps", fmt::format("map_{}_{:g}deg", file_word(record.target_name), record.azimuth_deg),
        map_of(shown, request), map_size(FigureStyle::kScreen),
        fmt::format("<b>{}</b>, azimuth {:g}°, H<sub>s</sub> {:g} m (sample {}). Strongest cell {:.3g} m ({:.1f} "
                    "dBsm), {} centres, "
                    "MWR {:.3g} (m/s)², CCF {:.2f}, σ<sub>r</sub> {:.1f} m, σ<sub>v</sub> {:.2f} m/s; the straight "
                    "line explains {} "
                    "of the centres' velocity variance.",
                    escape_html(record.target_name), record.azimuth_deg, record.significant_wave_height_m,
                    record.sample, record.peak_m, 10 * std::log10(4 * kPi * record.peak_m * record.peak_m),
                    record.centres, record.mwr, record.ccf, record.sigma_r_m, record.sigma_v_mps,
                    std::isfinite(line.explained) ? fmt::format("{:.0f} %", 100 * line.explained) : "an unknown share"),
        fmt::format("Range-velocity map of {} at azimuth {:g} degrees", record.target_name, record.azimuth_deg), false);
  }
}

// Maps that the fused features get wrong on unseen seas, the surest first.
void add_wrong_maps(FigureList& list, const ReportRequest& request) {
  constexpr std::size_t kMost = 4;
  const ReportData& data = request.results.data;
  const ClassNames classes = class_names(request.scenario);
  const std::vector<Prediction>& wrong = outcome_of(request.results.numbers.study, "fused").wrong;
  if (wrong.empty()) return;
  const DatasetReader reader(request.directory / "data");
  for (std::size_t i = 0; i < std::min(kMost, wrong.size()); ++i) {
    const std::int64_t sample = data.rows.at(wrong[i].row).record.sample;
    const ShownMap shown{stored_sample(reader, static_cast<std::size_t>(sample)).sample, data.axes};
    const SampleRecord& record = shown.sample.record;
    list.add(
        "wrong", fmt::format("wrong_map_{}", i + 1), map_of(shown, request), map_size(FigureStyle::kScreen),
        fmt::format("Sample {}: <b>{}</b> declared <b>{}</b> with probability {:.2f}. {} centres, MWR {:.3g} (m/s)², "
                    "CCF {:.2f}.",
                    sample, escape_html(classes.at(static_cast<std::size_t>(wrong[i].label))),
                    escape_html(classes.at(static_cast<std::size_t>(wrong[i].decision()))),
                    wrong[i].of(wrong[i].decision()), record.centres, record.mwr, record.ccf),
        fmt::format("Range-velocity map of sample {}, wrongly classified", sample), false);
  }
}

void add_scores(FigureList& list, const Study& study, const SplitSpec& split) {
  const DivisionWords division = division_words(split, study.division);
  const std::string unseen = escape_html(division.unseen), by = escape_html(division.by);
  const std::vector<Outcome>& outcomes = study.groups.front().outcomes;
  for (const Outcome& outcome : outcomes) {
    const bool random = outcome.protocol == Protocol::kRandom;
    list.add("accuracy", fmt::format("accuracy_{}", name(outcome.protocol)),
             accuracy_plot(study, split, outcome.protocol), kPlotSize,
             random ? "Random split: maps of the same sea lie on both sides. Bars: 95 % "
                      "bootstrap over seas."
                    : fmt::format("Split {}: tested on {}. No bar where a height has one test sea only.", by, unseen),
             fmt::format("Accuracy against wave height, {} split", name(outcome.protocol)));
  }
  for (auto& [key, plot] : condition_accuracy_plots(study, split)) {
    list.add(
        "accuracy", "accuracy_by_" + file_word(key), std::move(plot), kPlotSize,
        fmt::format("The same for {} by <code>{}</code>: swept values each, drawn ones in at most {} bins of equal "
                    "numbers of maps, at the means of their values.",
                    unseen, escape_html(key), kMostBins),
        "Accuracy against " + key);
  }
  for (const Outcome& outcome : outcomes) {
    list.add("accuracy", fmt::format("roc_{}", name(outcome.protocol)), roc_plot(study, split, outcome.protocol),
             kPlotSize,
             outcome.protocol == Protocol::kRandom
                 ? "Receiver operating characteristic over the threshold of the trees' probability, all test "
                   "predictions of the random split; no false alarm stands at 0.1 %."
                 : fmt::format("{} for {}; no false alarm stands at 0.1 %. Maps of one sea are not independent.",
                               outcomes.size() > 1 ? "The same" : "Receiver operating characteristic", unseen),
             fmt::format("ROC, {} split", name(outcome.protocol)));
  }
  if (std::optional<LinePlot> plot = roc_by_wave_height_plot(study, split))
    list.add("accuracy", "roc_by_wave_height", std::move(*plot), kPlotSize,
             fmt::format("The same of the fused features by wave height, {}.", unseen), "ROC by wave height");
}

// One scatter with a series per class.
LinePlot class_scatter(const ReportData& data, const ClassNames& classes,
                       const std::function<std::array<double, 2>(std::size_t)>& point,
                       const std::vector<std::size_t>& rows) {
  LinePlot plot;
  for (int label = 0; label < static_cast<int>(classes.size()); ++label) {
    Series series;
    series.name = classes[static_cast<std::size_t>(label)];
    series.style = SeriesStyle::kPoints;
    for (const std::size_t row : rows) {
      if (data.rows[row].record.label != label) continue;
      const auto xy = point(row);
      series.x.push_back(xy[0]);
      series.y.push_back(xy[1]);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

// The share of each class's maps, %, over the values of one quantity, as steps; bins of equal ratios where the axis is
// logarithmic. Undefined values are left out.
LinePlot histogram(const ReportData& data, const ClassNames& classes, const FigureAxis& axis,
                   const std::function<double(const ReportRow&)>& value) {
  constexpr int kBins = 24;
  const auto place = [&](double x) { return axis.logarithmic ? std::log10(std::max(x, 1e-6)) : x; };
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const ReportRow& row : data.rows) {
    if (!std::isfinite(value(row))) continue;
    least = std::min(least, place(value(row)));
    most = std::max(most, place(value(row)));
  }
  LinePlot plot;
  plot.title = axis.label;
  plot.x = axis;
  plot.y = {"maps of the class (%)", {}, false};
  const double width = most > least ? (most - least) / kBins : 1;
  for (int label = 0; label < data.classes; ++label) {
    std::vector<double> counts(kBins, 0.0);
    double all = 0;
    for (const ReportRow& row : data.rows) {
      if (row.record.label != label || !std::isfinite(value(row))) continue;
      const double bin = (place(value(row)) - least) / width;
      counts[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))] += 1;
      all += 1;
    }
    Series series{classes[static_cast<std::size_t>(label)], {}, {}, {}, SeriesStyle::kLines};
    for (int edge = 0; edge <= kBins; ++edge) {
      const double x = least + edge * width;
      for (const int bin : {edge - 1, edge}) {
        series.x.push_back(axis.logarithmic ? std::pow(10, x) : x);
        const bool is_inside = bin >= 0 && bin < kBins && all > 0;
        series.y.push_back(is_inside ? 100 * counts[static_cast<std::size_t>(bin)] / all : 0);
      }
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

PlotPanels feature_histograms(const ReportData& data, const ClassNames& classes) {
  const std::pair<FigureAxis, double (*)(const ReportRow&)> quantities[] = {
      {{"MWR ((m/s)^2)", {}, true}, [](const ReportRow& row) { return row.record.mwr; }},
      {{"CCF", {}, false}, [](const ReportRow& row) { return row.record.ccf; }},
      {{"sigma_r (m)", {}, false}, [](const ReportRow& row) { return row.record.sigma_r_m; }},
      {{"sigma_v (m/s)", {}, false}, [](const ReportRow& row) { return row.record.sigma_v_mps; }},
      {{"number of centres", {}, false}, [](const ReportRow& row) { return static_cast<double>(row.record.centres); }},
      {{"velocity variance explained by the line (%)", {}, false},
       [](const ReportRow& row) { return 100 * row.line.explained; }}};
  PlotPanels panels{.plots = {}, .columns = 2, .size = {1100, 1000}};
  for (const auto& [axis, value] : quantities) {
    const auto is_defined = [value = value](const ReportRow& row) { return std::isfinite(value(row)); };
    if (std::ranges::any_of(data.rows, is_defined)) panels.plots.push_back(histogram(data, classes, axis, value));
  }
  return panels;
}

// At most `most` rows, evenly spaced.
std::vector<std::size_t> thinned(std::size_t rows, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(rows, most);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(i * rows / count);
  return chosen;
}

void add_features(FigureList& list, const ReportData& data, const ClassNames& classes, std::uint64_t seed) {
  const std::vector<std::size_t> all = thinned(data.rows.size(), 4000);
  LinePlot residual = class_scatter(
      data, classes,
      [&](std::size_t i) {
        return std::array{std::max(data.rows[i].record.mwr, 1e-6), data.rows[i].record.ccf};
      },
      all);
  residual.title = "Line residual and contrast of the spreads";
  residual.x = {"MWR ((m/s)^2)", {}, true};
  residual.y = {"CCF", AxisRange{0, 1.02}, false};
  list.add("scatter", "features_mwr_ccf", std::move(residual), kPlotSize,
           "Residual of the line (MWR) and contrast of the spreads (CCF), every map a point; a residual of zero stands "
           "at 1e-6.",
           "Scatter of MWR and CCF by class");
  LinePlot spreads = class_scatter(
      data, classes,
      [&](std::size_t i) {
        return std::array{data.rows[i].record.sigma_r_m, data.rows[i].record.sigma_v_mps};
      },
      all);
  spreads.title = "Spreads of the scattering centres";
  spreads.x.label = "sigma_r (m)";
  spreads.y.label = "sigma_v (m/s)";
  list.add("scatter", "features_spreads", std::move(spreads), kPlotSize,
           "Standard deviations of the centres' ranges and velocities.",
           "Scatter of range and velocity spread by class");

  list.add(
      "features", "feature_histograms", feature_histograms(data, classes), {},
      "Share of each class's maps by feature, in 24 intervals from the smallest to the largest value; those of MWR "
      "are equal on a logarithmic axis.",
      "Histograms of the features by class");
  const std::vector<std::size_t> few = thinned(data.rows.size(), kMaxNeighbours);
  for (const auto& [name, matrix, title] :
       {std::tuple{"tsne_handmade", &data.handmade, "t-SNE of the hand-made features"},
        {"tsne_fused", &data.fused, "t-SNE of the fused features"}}) {
    const auto points = tsne(select_rows(*matrix, few), 30, 500, seed);
    std::vector<std::array<double, 2>> place(data.rows.size());
    for (std::size_t i = 0; i < few.size(); ++i) place[few[i]] = points[i];
    LinePlot plot = class_scatter(
        data, classes, [&](std::size_t i) { return place[i]; }, few);
    plot.title = title;
    plot.x.label = "t-SNE 1";
    plot.y.label = "t-SNE 2";
    list.add("neighbours", name, std::move(plot), kPlotSize,
             fmt::format("{}: neighbours stay neighbours, distances between clusters mean nothing. {} maps, training "
                         "and test together.",
                         title, few.size()),
             title);
  }
}

void add_aspects(FigureList& list, const ReportData& data, const ClassNames& classes) {
  const std::vector<ColumnBin>& azimuths = data.azimuths.bins;
  const ColumnBin& height = data.heights.bins[data.shown_height];
  struct Quantity {
    const char* file;
    const char* title;
    FigureAxis axis;
    std::function<double(const ReportRow&)> value;
    const char* caption;
  };
  const Quantity quantities[] = {
      {"line_by_azimuth",
       "How much of a line a map shows",
       {"velocity variance explained by the line (%)", AxisRange{-55, 102}, false},
       [](const ReportRow& row) { return 100 * row.line.explained; },
       "Share of the centres' velocity variance that a straight line in range explains, adjusted for the number of "
       "centres (0 = loose points): median and quartiles over all maps of the aspect."},
      {"mwr_by_azimuth",
       "Line residual by aspect",
       {"MWR ((m/s)^2)", {}, true},
       [](const ReportRow& row) { return std::max(row.record.mwr, 1e-6); },
       "MWR by aspect: median and quartiles."}};
  for (const Quantity& quantity : quantities) {
    LinePlot plot;
    plot.title = fmt::format("{}, Hs {} m", quantity.title, height.text);
    plot.x.label = "azimuth of the radar, 0 = ahead of the bow (deg)";
    plot.y = quantity.axis;
    for (int label = 0; label < data.classes; ++label) {
      Series series;
      series.name = classes[static_cast<std::size_t>(label)];
      series.style = SeriesStyle::kLinesPoints;
      for (const ColumnBin& azimuth : azimuths) {
        const Quartiles q = quartiles_of(data, {label, &height, &azimuth}, quantity.value);
        series.x.push_back(azimuth.mean + 2 * label - (data.classes - 1));
        series.y.push_back(q.median);
        series.interval.push_back({q.lower, q.upper});
      }
      plot.series.push_back(std::move(series));
    }
    const bool is_binned = std::ranges::any_of(azimuths, [](const ColumnBin& bin) { return bin.lowest < bin.highest; });
    list.add("aspects", quantity.file, std::move(plot), kPlotSize,
             quantity.caption + std::string(is_binned ? " Azimuths in bins of equal numbers of maps." : ""),
             quantity.title);
  }
}

LinePlot angle_plot(const std::string& title, const Trajectory& body, const std::vector<double>& times) {
  LinePlot plot;
  plot.title = title;
  plot.x.label = "time (s)";
  plot.y.label = "angle (deg)";
  constexpr const char* kNames[3] = {"roll", "pitch", "yaw"};
  for (int axis = 0; axis < 3; ++axis) {
    Series series;
    series.name = kNames[axis];
    for (const double t : times) {
      series.x.push_back(t);
      series.y.push_back(degrees(body.sample(t).angles[axis]));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

// The sea of the first map that is shown, above the angles of every target's first body, on one time axis.
void add_sea(FigureList& list, const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets,
             const SampleRecord& record) {
  constexpr double kExcerptS = 60;
  const SeaChoice choice{static_cast<std::size_t>(record.sea_state), static_cast<std::size_t>(record.realisation)};
  const Scene scene =
      make_scene({.scenario = scenario, .targets = targets, .sea = choice, .plan = &plan, .at_least_s = kExcerptS});
  std::vector<double> times;
  for (int i = 0; i <= 600; ++i) times.push_back(0.1 * i);

  LinePlot waves;
  waves.title = fmt::format("Sea surface at the reference point, Hs {:g} m, Tp {:g} s",
                            record.significant_wave_height_m, record.peak_period_s);
  waves.x = {"time (s)", AxisRange{0, kExcerptS}, false};
  waves.y.label = "elevation (m)";
  Series full{scenario.sea.order == 2 ? "second order" : "linear", times, {}, {}, SeriesStyle::kLines};
  for (const double t : times) full.y.push_back(scene.sea.surface(0, 0, t).elevation);
  waves.series.push_back(std::move(full));
  PlotPanels panels{.plots = {std::move(waves)}};
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (scene.bodies[t].empty()) continue;
    const bool is_one_of_many = scene.bodies[t].size() > 1 && !is_raft(targets[t].spec.layout);
    panels.plots.push_back(
        angle_plot(fmt::format("Motion of {}{}", targets[t].spec.name, is_one_of_many ? ", first body" : ""),
                   scene.bodies[t].front(), times));
    panels.plots.back().x.range = AxisRange{0, kExcerptS};
  }
  panels.size = {1000, static_cast<int>(90 + 230 * panels.plots.size())};
  list.add("sea", "sea_and_motion", std::move(panels), {},
           fmt::format("One minute of sea realisation {}, common to all targets and aspects, and the angles of the "
                       "targets in it (right-handed: pitch &gt; 0 puts the bow down).",
                       choice.realisation + 1),
           "Elevation of the sea and angles of the targets against time");
}

void add_targets(FigureList& list, const std::vector<Target>& targets) {
  for (const Target& target : targets) {
    if (target.models.empty()) continue;
    const TriangleMesh& mesh = target.models.front()->prepared->mesh;
    const TargetSpec& spec = target.spec;
    const Bounds box = bounds(mesh);
    const Vec3 size = box.upper - box.lower;
    list.add_picture(
        "targets", fmt::format("target_{}", file_word(target.spec.name)),
        [&mesh](const fs::path& file) { write_file(file, png_bytes(picture_of(mesh, PictureView{.width = 1000}))); },
        fmt::format("<b>{}</b> ({}): {:.1f} × {:.1f} × {:.1f} m, {} triangles{}.", escape_html(spec.name),
                    spec.role == TargetRole::kPart ? "part of others" : fmt::format("label {}", spec.label), size.x(),
                    size.y(), size.z(), mesh.triangles.size(),
                    body_count(spec.layout) > 1 ? "; one of the bodies" + layout_text(spec.layout) : std::string()),
        fmt::format("Picture of {}", target.spec.name));
  }
}

}  // namespace

std::vector<ReportFigure> draw_report_figures(const ReportRequest& request) {
  const auto& [data, numbers] = request.results;
  const Scenario& scenario = request.scenario;
  std::vector<std::string> notes{fmt::format("{}, seed {}", scenario.name, scenario.seed),
                                 fmt::format("{} maps", data.rows.size())};
  std::ranges::copy(radar_print(scenario.radar), std::back_inserter(notes));
  notes.push_back("seaglint " + numbers.version);
  FigureList list(request.directory, std::move(notes));
  const ClassNames classes = class_names(scenario);
  add_maps(list, request);
  add_scores(list, numbers.study, scenario.learning.split);
  add_wrong_maps(list, request);
  add_features(list, data, classes, scenario.seed);
  add_aspects(list, data, classes);
  if (!data.shown.empty()) add_sea(list, scenario, request.plan, request.targets, data.shown.front().sample.record);
  add_targets(list, request.targets);
  return list.draw(thread_count(request.threads), request.stop);
}

}  // namespace seaglint
