// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_data.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/text/json.h"
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

using nlohmann::ordered_json;

ordered_json to_object(const Quartiles& q) {
  return {{"lower", number_or_null(q.lower)}, {"median", number_or_null(q.median)}, {"upper", number_or_null(q.upper)}};
}

bool holds(const RowFilter& filter, std::size_t row, const SampleRecord& record) {
  const auto is_in = [row](const ColumnBin* bin) {
    return bin == nullptr || std::ranges::binary_search(bin->rows, row);
  };
  return (!filter.label || *filter.label == record.label) && is_in(filter.height) && is_in(filter.azimuth);
}

struct NamedValue {
  const char* name;
  double (*value)(const ReportRow&);
};

constexpr NamedValue kValues[] = {
    {"mwr", [](const ReportRow& row) { return row.record.mwr; }},
    {"ccf", [](const ReportRow& row) { return row.record.ccf; }},
    {"sigma_r_m", [](const ReportRow& row) { return row.record.sigma_r_m; }},
    {"sigma_v_mps", [](const ReportRow& row) { return row.record.sigma_v_mps; }},
    {"centres", [](const ReportRow& row) { return static_cast<double>(row.record.centres); }},
    {"line_explained", [](const ReportRow& row) { return row.line.explained; }},
    {"scr_per_pulse_db", [](const ReportRow& row) { return row.record.scr_per_pulse_db; }},
};

// Members of a bin of a quantity: its mean under `name`, its text, its ends.
ordered_json to_object(const char* name, const ColumnBin& bin) {
  return {{name, bin.mean}, {"bin", bin.text}, {"lowest", bin.lowest}, {"highest", bin.highest}};
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

ordered_json report_numbers(const ReportData& data) {
  ordered_json json;
  json["features_by_wave_height"] = ordered_json::array();
  for (const ColumnBin& height : data.heights.bins) {
    for (int label = data.classes - 1; label >= 0; --label) {
      ordered_json entry = to_object(kWaveHeightColumn, height);
      entry["label"] = label;
      for (const NamedValue& v : kValues) entry[v.name] = to_object(quartiles_of(data, {label, &height}, v.value));
      json["features_by_wave_height"].push_back(entry);
    }
  }
  json["features_by_azimuth"] = ordered_json::array();
  const ColumnBin* height = data.heights.bins.empty() ? nullptr : &data.heights.bins[data.shown_height];
  for (const ColumnBin& azimuth : data.azimuths.bins) {
    for (int label = data.classes - 1; label >= 0; --label) {
      ordered_json entry = to_object("azimuth_deg", azimuth);
      entry[kWaveHeightColumn] = height->text;
      entry["label"] = label;
      for (const NamedValue& v : kValues)
        entry[v.name] = to_object(quartiles_of(data, {label, height, &azimuth}, v.value));
      json["features_by_azimuth"].push_back(entry);
    }
  }
  json["maps_shown"] = ordered_json::array();
  for (const ShownMap& shown : data.shown) {
    const SampleRecord& record = shown.sample.record;
    const LineFit line = fit_line(shown.sample.centre_list);
    json["maps_shown"].push_back({{"sample", record.sample},
                                  {"target", record.target_name},
                                  {"label", record.label},
                                  {"azimuth_deg", record.azimuth_deg},
                                  {"significant_wave_height_m", record.significant_wave_height_m},
                                  {"peak_m", record.peak_m},
                                  {"centres", record.centres},
                                  {"mwr", record.mwr},
                                  {"ccf", record.ccf},
                                  {"sigma_r_m", record.sigma_r_m},
                                  {"sigma_v_mps", record.sigma_v_mps},
                                  {"line_slope_per_s", number_or_null(line.slope)},
                                  {"line_explained", number_or_null(line.explained)},
                                  {"scr_per_pulse_db", number_or_null(record.scr_per_pulse_db)},
                                  {"scr_peak_cell_db", number_or_null(record.scr_peak_cell_db)}});
  }
  return json;
}

}  // namespace seaglint
