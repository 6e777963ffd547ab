// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Data of the report: the samples of a run without their maps, the few maps that it shows, quartiles of the features;
// the names of the classes and of the split.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/model/classifiers.h"
#include "classify/model/data_rows.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "tools/report/explorer.h"

namespace seaglint {

// Least-squares line v = a r + b through the stored centres of a map.
struct LineFit {
  double slope = 0;      // 1/s
  double intercept = 0;  // m/s
  double explained = 0;  // adjusted R^2: 1 = all on the line, 0 on average for uncorrelated points, NaN below 3 centres
};
LineFit fit_line(const std::vector<StoredCentre>& centres);

struct ReportRow {
  SampleRecord record;
  LineFit line;
};

// One map that the report shows.
struct ShownMap {
  Sample sample;
  StoredAxes axes;
};

struct ReportData {
  std::vector<ReportRow> rows;
  std::vector<ShownMap> shown;    // every class, the last label first, at the first aspect, then at the second
  int classes = 2;                // labels 0 to classes - 1
  Condition heights, azimuths;    // bins of the rows by wave height and azimuth
  std::size_t shown_height = 0;   // bin of the first map that is shown
  std::vector<ExplorerMap> maps;  // of every state in turn: at most about kMostMaps, see ReportCollector
  StoredAxes axes;                // of all maps
  FeatureMatrix handmade;         // of all rows
  FeatureMatrix fused;            // the same plus the network's embeddings

  // Bin of the wave heights that the figures by aspect have; null without rows.
  const ColumnBin* height_shown() const { return heights.bins.empty() ? nullptr : &heights.bins[shown_height]; }
};

// Collects the data of the report from shards, in their order. Maps shown: one of each class at the aspects nearest 80
// and 170 deg azimuth in the sea nearest Hs 1 m (as in the paper's figures), the first of several.
// The first maps of every target, view and sea state are kept, reduced: as many of each as make kMostMaps in all.
class ReportCollector {
 public:
  ReportCollector(const Scenario& scenario, const SamplePlan& plan);

  void add(const Shard& shard);
  // embeddings: those of the network, for all rows.
  ReportData with_embeddings(const FeatureMatrix& embeddings) const;
  // fused: hand-made features and embeddings, for all rows.
  ReportData with_fused(FeatureMatrix fused) const;
  std::vector<std::int64_t> samples() const;

 private:
  static constexpr std::size_t kMostMaps = 512;

  // The map of a class and aspect that is nearest so far, and its place in the order of preference.
  struct Nearest {
    std::array<double, 8> place = {};
    ShownMap map;
  };

  std::map<std::array<std::int64_t, 2>, Nearest> nearest_;   // by aspect and minus the label
  std::size_t of_each_state_ = 1;                            // maps that are kept
  std::map<std::array<std::int64_t, 3>, std::size_t> seen_;  // by target, view and sea state
  ReportData data_;
};

// Reads the data set and the embeddings of a run. Throws InputError when either is invalid.
ReportData load_report_data(const std::filesystem::path& directory, const Scenario& scenario, const SamplePlan& plan,
                            const StopFlag* stop);

// Quartiles of the features by class, wave height and aspect.

// Selects rows; an absent member selects all. Bins are those of `heights` and `azimuths` of the data.
struct RowFilter {
  std::optional<int> label = {};
  const ColumnBin* height = nullptr;
  const ColumnBin* azimuth = nullptr;
};

// Numbers of a row whose quartiles are in metrics.json.
struct ReportQuantity {
  const char* name;
  double (*value)(const ReportRow&);
};
inline constexpr ReportQuantity kReportQuantities[] = {
    {"mwr", [](const ReportRow& row) { return row.record.mwr; }},
    {"ccf", [](const ReportRow& row) { return row.record.ccf; }},
    {"sigma_r_m", [](const ReportRow& row) { return row.record.sigma_r_m; }},
    {"sigma_v_mps", [](const ReportRow& row) { return row.record.sigma_v_mps; }},
    {"centres", [](const ReportRow& row) { return static_cast<double>(row.record.centres); }},
    {"line_explained", [](const ReportRow& row) { return row.line.explained; }},
    {"scr_per_pulse_db", [](const ReportRow& row) { return row.record.scr_per_pulse_db; }},
};

Quartiles quartiles_of(const ReportData& data, const RowFilter& filter,
                       const std::function<double(const ReportRow&)>& value);

// The group protocol in words, plain text.
struct DivisionWords {
  bool by_sea = true;   // whole seas on one side
  std::string by;       // "by sea", "by azimuth_deg"
  std::string unseen;   // what is tested: "unseen seas", "values of azimuth_deg that were not trained on"
  std::string heading;  // "Split by sea realisation (no test sea was seen in training)"
};
// `division`: Study::division.
DivisionWords division_words(const SplitSpec& split, const std::string& division);

// Names by label: dataset.classes where the scenario names them; else the names of the targets of each label in the
// scenario's order, "a, b"; of more than three "label 0" or "label 1". Plain text.
using ClassNames = std::vector<std::string>;
ClassNames class_names(const Scenario& scenario);

}  // namespace seaglint
