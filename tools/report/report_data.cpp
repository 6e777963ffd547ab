// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tools/pipeline/train.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr double kShownAzimuths_deg[] = {80, 170}, kShownWaveHeight_m = 1;

// Order of preference of a map for an aspect. Wave heights within a quarter of a metre of another count as equal, so
// that one of several drawn seas has the aspect.
std::array<double, 8> place_of(const SampleRecord& record, double azimuth_deg) {
  const double off_m = std::abs(record.significant_wave_height_m - kShownWaveHeight_m);
  const double off_deg = std::abs(std::remainder(record.azimuth_deg - azimuth_deg, 360));
  return {std::floor(off_m / 0.25),
          off_deg,
          off_m,
          static_cast<double>(record.sea_state),
          static_cast<double>(record.view),
          static_cast<double>(record.realisation),
          static_cast<double>(record.interval),
          static_cast<double>(record.target)};
}

}  // namespace

LineFit fit_line(const std::vector<StoredCentre>& centres) {
  LineFit fit;
  const double n = static_cast<double>(centres.size());
  double r = 0, v = 0;
  for (const StoredCentre& c : centres) {
    r += c[0] / n;
    v += c[1] / n;
  }
  double rr = 0, rv = 0, vv = 0;
  for (const StoredCentre& c : centres) {
    rr += (c[0] - r) * (c[0] - r);
    rv += (c[0] - r) * (c[1] - v);
    vv += (c[1] - v) * (c[1] - v);
  }
  fit.slope = rr > 0 ? rv / rr : 0;
  fit.intercept = v - fit.slope * r;
  // A line through n uncorrelated points explains 1 / (n - 1) of their variance; the adjusted R^2 (Ezekiel 1930)
  // corrects for it.
  const bool defined = centres.size() >= 3 && rr > 0 && vv > 0;
  fit.explained =
      defined ? 1 - (1 - rv * rv / (rr * vv)) * (n - 1) / (n - 2) : std::numeric_limits<double>::quiet_NaN();
  return fit;
}

ReportCollector::ReportCollector(const Scenario& scenario, const SamplePlan& plan) {
  data_.classes = static_cast<int>(scenario.dataset.classes.size());
  const std::size_t states = plan.classes().size() * plan.views().size() * plan.sea_states().size();
  of_each_state_ = std::max<std::size_t>(1, (kMostMaps + states - 1) / states);
  data_.handmade.names = {"mwr", "ccf", "sigma_r_m", "sigma_v_mps"};
}

void ReportCollector::add(const Shard& shard) {
  data_.axes = shard.axes;
  for (const Sample& sample : shard.samples) {
    const SampleRecord& record = sample.record;
    data_.rows.push_back({record, fit_line(sample.centre_list)});
    if (seen_[{record.target, record.view, record.sea_state}]++ < of_each_state_)
      data_.maps.push_back(explorer_map(sample, shard.axes));
    for (const double value : {record.mwr, record.ccf, record.sigma_r_m, record.sigma_v_mps}) {
      data_.handmade.values.push_back(static_cast<float>(value));
    }
    for (std::int64_t aspect = 0; aspect < std::ssize(kShownAzimuths_deg); ++aspect) {
      const std::array<double, 8> place = place_of(record, kShownAzimuths_deg[aspect]);
      const auto [nearest, is_first] = nearest_.try_emplace({aspect, -record.label});
      if (is_first || place < nearest->second.place) nearest->second = {place, {sample, shard.axes}};
    }
  }
}

ReportData ReportCollector::with_embeddings(const FeatureMatrix& embeddings) const {
  return with_fused(join_columns(data_.handmade, embeddings));
}

ReportData ReportCollector::with_fused(FeatureMatrix fused) const {
  ReportData data = data_;
  data.fused = std::move(fused);
  std::set<std::int64_t> samples;
  for (const auto& [key, nearest] : nearest_)
    if (samples.insert(nearest.map.sample.record.sample).second) data.shown.push_back(nearest.map);
  std::vector<DataRow> rows;
  for (const ReportRow& row : data.rows) rows.push_back({0, row.record});
  data.heights = condition_of(rows, kWaveHeightColumn);
  data.azimuths = condition_of(rows, "azimuth_deg");
  if (data.shown.empty()) return data;
  const double height = data.shown.front().sample.record.significant_wave_height_m;
  while (data.heights.bins[data.shown_height].highest < height) ++data.shown_height;
  return data;
}

std::vector<std::int64_t> ReportCollector::samples() const {
  std::vector<std::int64_t> samples;
  for (const ReportRow& row : data_.rows) samples.push_back(row.record.sample);
  return samples;
}

ReportData load_report_data(const fs::path& directory, const Scenario& scenario, const SamplePlan& plan,
                            const StopFlag* stop) {
  const DatasetReader reader(directory / "data");
  warn(data_set_warnings(reader));
  if (reader.size() != plan.size()) {
    throw InputError(fmt::format("{}: {} maps, but scenario.yaml makes {}", (directory / "data").string(),
                                 reader.size(), plan.size()));
  }
  ReportCollector collector(scenario, plan);
  for (std::size_t i = 0; i < reader.shards(); ++i) {
    if (stop && *stop) throw Interrupted();
    collector.add(reader.shard(i));
  }
  return collector.with_fused(read_embeddings(directory / "model" / kEmbeddingsFile, collector.samples()));
}

namespace {

bool holds(const RowFilter& filter, std::size_t row, const SampleRecord& record) {
  const auto is_in = [row](const ColumnBin* bin) {
    return bin == nullptr || std::ranges::binary_search(bin->rows, row);
  };
  return (!filter.label || *filter.label == record.label) && is_in(filter.height) && is_in(filter.azimuth);
}

}  // namespace

Quartiles quartiles_of(const ReportData& data, const RowFilter& filter,
                       const std::function<double(const ReportRow&)>& value) {
  std::vector<double> values;
  for (std::size_t row = 0; row < data.rows.size(); ++row) {
    if (holds(filter, row, data.rows[row].record)) values.push_back(value(data.rows[row]));
  }
  return quartiles(std::move(values));
}

DivisionWords division_words(const SplitSpec& split, const std::string& division) {
  DivisionWords words;
  words.by_sea = split.by == "sea";
  words.by = "by " + split.by;
  words.unseen = words.by_sea ? "unseen seas" : fmt::format("values of {} that were not trained on", split.by);
  words.heading = words.by_sea ? "Split by sea realisation (no test sea was seen in training)"
                               : fmt::format("Split by {0} (no value of {0} is trained and tested on)", split.by);
  // Text of Division: "tested on layout=ring only; split by ..."
  constexpr std::string_view kTested = "tested on ", kOnly = " only; split by ";
  const std::size_t end = division.rfind(kOnly);
  if (!division.starts_with(kTested) || end == std::string::npos) return words;
  const std::string held = division.substr(kTested.size(), end - kTested.size());
  words.unseen = fmt::format("held-out maps ({}) of {}", held, words.unseen);
  words.heading += fmt::format(", tested on {} only", held);
  return words;
}

ClassNames class_names(const Scenario& scenario) {
  constexpr std::size_t kMostNames = 3;
  if (scenario.dataset.classes != default_classes()) return scenario.dataset.classes;
  ClassNames classes;
  for (const int label : {0, 1}) {
    std::vector<std::string> names;
    for (const TargetSpec& target : scenario.targets)
      if (target.role == TargetRole::kClass && target.label == label) names.push_back(target.name);
    classes.push_back(names.empty() || names.size() > kMostNames ? fmt::format("label {}", label)
                                                                 : fmt::format("{}", fmt::join(names, ", ")));
  }
  return classes;
}

}  // namespace seaglint
