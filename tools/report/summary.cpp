// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/summary.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/core/text/json_number.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

ordered_json to_object(const Quartiles& q) {
  return {{"lower", number_or_null(q.lower)}, {"median", number_or_null(q.median)}, {"upper", number_or_null(q.upper)}};
}

bool holds(const RowFilter& filter, const SampleRecord& record) {
  return (!filter.label || *filter.label == record.label) &&
         (!filter.wave_height_m || *filter.wave_height_m == record.significant_wave_height_m) &&
         (!filter.azimuth_deg || *filter.azimuth_deg == record.azimuth_deg);
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

template <class Member>
std::vector<double> distinct(const ReportData& data, Member member) {
  std::set<double> values;
  for (const ReportRow& row : data.rows) values.insert(row.record.*member);
  return {values.begin(), values.end()};
}

}  // namespace

Quartiles quartiles_of(const ReportData& data, const RowFilter& filter,
                       const std::function<double(const ReportRow&)>& value) {
  std::vector<double> values;
  for (const ReportRow& row : data.rows) {
    if (holds(filter, row.record)) values.push_back(value(row));
  }
  return quartiles(std::move(values));
}

std::vector<double> wave_heights_m(const ReportData& data) {
  return distinct(data, &SampleRecord::significant_wave_height_m);
}
std::vector<double> azimuths_deg(const ReportData& data) { return distinct(data, &SampleRecord::azimuth_deg); }

ordered_json report_numbers(const ReportData& data) {
  ordered_json json;
  json["features_by_wave_height"] = ordered_json::array();
  for (const double height : wave_heights_m(data)) {
    for (int label = data.classes - 1; label >= 0; --label) {
      ordered_json entry{{"significant_wave_height_m", height}, {"label", label}};
      for (const NamedValue& v : kValues) entry[v.name] = to_object(quartiles_of(data, {label, height, {}}, v.value));
      json["features_by_wave_height"].push_back(entry);
    }
  }
  json["features_by_azimuth"] = ordered_json::array();
  for (const double azimuth : azimuths_deg(data)) {
    for (int label = data.classes - 1; label >= 0; --label) {
      ordered_json entry{
          {"azimuth_deg", azimuth}, {"significant_wave_height_m", data.shown_wave_height_m}, {"label", label}};
      for (const NamedValue& v : kValues)
        entry[v.name] = to_object(quartiles_of(data, {label, data.shown_wave_height_m, azimuth}, v.value));
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
