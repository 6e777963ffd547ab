// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/explorer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ranges>
#include <tuple>
#include <unordered_map>

#include "classify/dataset/format/shard.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/field_tables/field_table.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/solver/solve.h"
#include "tools/page/html.h"
#include "tools/rcs/hot_spots.h"

namespace seaglint {

namespace {

constexpr int kColumnDigits = 12;           // binary digits of a real column: 1.2e-4 relative
constexpr double kLargestExact = 16777216;  // integers up to here are exact in single precision

// A column's numbers; empty for texts, and for keys beyond single precision.
std::vector<double> numbers_of(const SampleColumn& column, std::span<const SampleRecord> records) {
  std::vector<double> values;
  values.reserve(records.size());
  const auto* integer = std::get_if<std::int64_t SampleRecord::*>(&column.member);
  const auto* real = std::get_if<double SampleRecord::*>(&column.member);
  if (integer == nullptr && real == nullptr) return {};
  for (const SampleRecord& record : records) {
    values.push_back(real != nullptr ? record.*(*real) : static_cast<double>(record.*(*integer)));
    if (integer != nullptr && std::abs(values.back()) > kLargestExact) return {};
  }
  return values;
}

bool is_feature(std::string_view name) {
  constexpr std::string_view kFeatures[] = {"mwr", "ccf", "sigma_r_m", "sigma_v_mps", "centres"};
  return std::ranges::find(kFeatures, name) != std::end(kFeatures);
}

// Integers, and the values of the maps' titles, have the digits of single precision.
int digits_of(const SampleColumn& column) {
  constexpr std::string_view kOfTitles[] = {"significant_wave_height_m", "azimuth_deg", "elevation_deg"};
  const bool integer = std::holds_alternative<std::int64_t SampleRecord::*>(column.member);
  return integer || std::ranges::find(kOfTitles, column.name) != std::end(kOfTitles) ? 24 : kColumnDigits;
}

std::string column_json(const std::string& name, const std::string& unit, const std::vector<double>& values,
                        int digits) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return fmt::format(R"({{"name":{},"unit":{},"feature":{},"varies":{},"packed":"{}"}})", json_string(name),
                     json_string(unit), is_feature(name), low < high, packed_floats(values, digits));
}

std::vector<std::string> columns_of(std::span<const SampleRecord> records) {
  std::vector<std::string> list;
  for (const SampleColumn& column : sample_columns()) {
    const std::vector<double> values = numbers_of(column, records);
    if (!values.empty()) list.push_back(column_json(column.name, column.unit, values, digits_of(column)));
  }
  const std::size_t drawn = records.empty() ? 0 : records.front().drawn_numbers.size();
  for (std::size_t i = 0; i < drawn; ++i) {
    const std::string& key = records.front().drawn_numbers[i].key;
    std::vector<double> values;
    for (const SampleRecord& record : records)
      values.push_back(i < record.drawn_numbers.size() ? record.drawn_numbers[i].value : std::nan(""));
    list.push_back(column_json(key, drawn_text(key).units, values, kColumnDigits));
  }
  return list;
}

// Number of the bin of each row; of a row without one that of the first.
std::vector<std::size_t> bin_of_row(std::span<const ColumnBin> bins, std::size_t rows) {
  std::vector<std::size_t> numbers(rows, 0);
  for (std::size_t bin = 0; bin < bins.size(); ++bin)
    for (const std::size_t row : bins[bin].rows) numbers[row] = bin;
  return numbers;
}

// The bins of a quantity by which maps are chosen: their texts, the one shown first, the bin of every row.
std::string choices(std::span<const ColumnBin> bins, std::size_t rows, std::size_t first) {
  std::vector<std::string> texts;
  for (const ColumnBin& bin : bins) texts.push_back(json_string(bin.text));
  std::vector<std::uint8_t> numbers;
  for (const std::size_t bin : bin_of_row(bins, rows)) numbers.push_back(static_cast<std::uint8_t>(bin));
  return fmt::format(R"({{"texts":[{}],"first":{},"bins":"{}"}})", fmt::join(texts, ","), first, packed(numbers));
}

std::string axis_json(const ReducedAxis& axis) {
  return fmt::format(R"({{"first":{},"step":{},"count":{},"cells":{}}})", json_number(axis.first, 17),
                     json_number(axis.step, 17), axis.count, axis.cells);
}

}  // namespace

ReducedAxis reduced_axis(std::span<const double> cells, std::size_t at_most) {
  const std::size_t together = std::max<std::size_t>(1, (cells.size() + at_most - 1) / at_most);
  const double step = cells.size() > 1 ? cells[1] - cells[0] : 1;
  return {cells.front() + step * static_cast<double>(together - 1) / 2, step * static_cast<double>(together),
          (cells.size() + together - 1) / together, together};
}

ExplorerMap explorer_map(const Sample& sample, const StoredAxes& axes) {
  const ReducedAxis velocity = reduced_axis(axes.velocity_mps, kExplorerCells[0]),
                    range = reduced_axis(axes.range_m, kExplorerCells[1]);
  const double peak = sample.magnitude.empty() ? 0.0 : *std::ranges::max_element(sample.magnitude);
  const auto decibels = [&](double value) {
    return value > 0 && peak > 0 ? std::max(kMapFloorDb, 20 * std::log10(value / peak)) : kMapFloorDb;
  };
  std::vector<std::uint8_t> levels(velocity.count * range.count, 0);
  for (std::size_t i = 0; i < sample.magnitude.size(); ++i) {
    const std::size_t v = i / axes.range_m.size() / velocity.cells, r = i % axes.range_m.size() / range.cells;
    const auto level = static_cast<std::uint8_t>(std::lround(decibels(sample.magnitude[i]) - kMapFloorDb));
    std::uint8_t& cell = levels[v * range.count + r];
    cell = std::max(cell, level);
  }
  ExplorerMap map{sample.record.sample, packed(levels), sample.centre_list};
  for (StoredCentre& centre : map.centres) centre[2] = static_cast<float>(decibels(centre[2]));
  return map;
}

std::vector<std::size_t> explorer_order(std::span<const SampleRecord> records, std::span<const ColumnBin> heights,
                                        std::span<const ColumnBin> azimuths) {
  using State = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::size_t, std::size_t>;
  const std::vector<std::size_t> of_height = bin_of_row(heights, records.size()),
                                 of_azimuth = bin_of_row(azimuths, records.size());
  std::map<State, int> seen;
  std::vector<std::pair<int, std::size_t>> order;
  for (std::size_t i = 0; i < records.size(); ++i)
    order.emplace_back(seen[{records[i].target, records[i].view, records[i].sea_state, of_height[i], of_azimuth[i]}]++,
                       i);
  std::ranges::sort(order);
  std::vector<std::size_t> rows;
  for (const auto& [turn, row] : order) rows.push_back(row);
  return rows;
}

std::string explorer_json(const ExplorerData& data) {
  const auto& [records, maps, axes, heights, azimuths, height, azimuth] = data;
  std::map<std::int64_t, std::string> targets;
  for (const SampleRecord& record : records)
    targets.try_emplace(record.target, fmt::format("\"{}\":{}", record.target, json_string(record.target_name)));
  std::unordered_map<std::int64_t, const ExplorerMap*> of_sample;
  for (const ExplorerMap& map : maps) of_sample[map.sample] = &map;
  std::vector<std::string> shown;
  std::size_t bytes = 0;
  for (const std::size_t row : explorer_order(records, heights, azimuths)) {
    const auto found = of_sample.find(records[row].sample);
    if (found == of_sample.end()) continue;
    std::vector<std::string> centres;
    for (const StoredCentre& c : found->second->centres)
      centres.push_back(fmt::format("[{:.2f},{:.3f},{:.1f}]", c[0], c[1], c[2]));
    const std::string list = fmt::format("[{}]", fmt::join(centres, ","));
    bytes += found->second->packed.size() + list.size();
    if (bytes > kExplorerBytes) break;
    shown.push_back(fmt::format(R"({{"row":{},"packed":"{}","centres":{}}})", row, found->second->packed, list));
  }
  return fmt::format(
      R"({{"targets":{{{}}},"range":{},"velocity":{},"floor_db":{},"step_db":1,"heights":{},"azimuths":{},"columns":[{}],"maps":[{}]}})",
      fmt::join(std::views::values(targets), ","), axis_json(reduced_axis(axes.range_m, kExplorerCells[1])),
      axis_json(reduced_axis(axes.velocity_mps, kExplorerCells[0])), kMapFloorDb,
      choices(heights, records.size(), height), choices(azimuths, records.size(), azimuth),
      fmt::join(columns_of(records), ","), fmt::join(shown, ","));
}

namespace {

double centre_ghz(const RadarSpec& radar) { return (lowest_ghz(radar) + highest_ghz(radar)) / 2; }

HotSpotSettings hot_spot_settings(const Scenario& scenario) {
  return {.range_db = 50, .elements = {static_cast<std::size_t>(scenario.radar.polarisation)}, .most_centres = 100};
}

std::vector<View> views_shown(std::vector<View> views) {
  std::ranges::stable_sort(views, {}, [](const View& v) { return std::pair(v.azimuth_rad, v.elevation_rad); });
  const std::size_t step = (views.size() + kHotSpotViews - 1) / kHotSpotViews;
  std::vector<View> shown;
  for (std::size_t i = 0; i < views.size(); i += step) shown.push_back(views[i]);
  return shown;
}

// The target at every view in the radar's polarisation.
HotSpotTarget hot_spots_of(const Target& target, const Scenario& scenario, const std::vector<View>& views, int threads,
                           const StopFlag* stop) {
  const PreparedTarget& prepared = *target.models.front()->prepared;
  const Scatterer& scatterer = *prepared.scatterer;
  const double wavelength = kSpeedOfLight / (1e9 * centre_ghz(scenario.radar)), k = 2 * kPi / wavelength;
  HotSpotTarget spots{target.spec.name, scatterer, prepared.mesh.part_names, {}};
  for (const View& view : views) {
    const RadarBasis basis = radar_basis(direction_to_radar(view.azimuth_rad, view.elevation_rad));
    const SolveResult solved = solve({.scatterer = scatterer,
                                      .views = {monostatic(basis)},
                                      .wavenumbers = {k},
                                      .settings = tracing_settings(target.spec.solver),
                                      .points_for_rad = default_aspect_change(scatterer, wavelength),
                                      .threads = threads,
                                      .stop = stop});
    const std::vector<Point>& points = solved.views[0].points;
    spots.views.push_back(hot_spot_view(scatterer, points, k, cluster_centres(points, k, ViewExport{}.cell_m),
                                        hot_spot_settings(scenario)));
    spots.views.back().azimuth_deg = view.azimuth_deg;
    spots.views.back().elevation_deg = view.elevation_deg;
  }
  return spots;
}

}  // namespace

HotSpots hot_spots(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets, int threads,
                   const StopFlag* stop) {
  const std::vector<View> views = views_shown(plan.views());
  std::vector<HotSpotTarget> list;
  std::string left_out;
  std::size_t facets = 0;
  for (std::size_t t = 0; t < std::min(targets.size(), scenario.targets.size()); ++t) {  // no companions
    const Target& target = targets[t];
    if (target.models.empty()) continue;
    const std::size_t of_body = target.models.front()->prepared->scatterer->facets().size();
    if (facets + of_body > kHotSpotFacets) {
      left_out += fmt::format(
          " {} has {} facets, more than a page can contain: <code>seaglint rcs "
          "--export-hot-spots FILE.glb</code> colours it.",
          escape_html(target.spec.name), of_body);
      continue;
    }
    facets += of_body;
    list.push_back(hot_spots_of(target, scenario, views, threads, stop));
  }
  if (list.empty()) return {"", left_out};
  const char* element = kPolarisationNames[static_cast<int>(scenario.radar.polarisation)];
  return {
      hot_spots_json(list, hot_spot_settings(scenario)),
      fmt::format("Level of each facet’s contribution at {:g} GHz, {}, for one body at rest without the sea; facets of "
                  "one plane have the level of their sum. Multiple bounces count for the facet that they leave "
                  "last. Balls: the strongest scattering centres, of cells of {:g} m.{}{}",
                  centre_ghz(scenario.radar), element, ViewExport{}.cell_m,
                  views.size() < plan.views().size()
                      ? fmt::format(" {} of the scenario’s {} views.", views.size(), plan.views().size())
                      : "",
                  left_out)};
}

}  // namespace seaglint
