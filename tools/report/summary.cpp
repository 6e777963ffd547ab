// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/summary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "sim/core/text/json_number.h"

namespace seaglint {

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
