// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_statistics.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "tools/rcs/rcs_figure.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

AreaStatistics area_statistics(std::vector<double> areas_m2) {
  std::ranges::sort(areas_m2);
  double sum = 0;
  for (const double area : areas_m2) sum += area;
  const auto percentile = [&](double p) { return quantile(areas_m2, p); };
  return {areas_m2.size(),
          percentile(0.05),
          percentile(0.25),
          percentile(0.5),
          percentile(0.75),
          percentile(0.95),
          sum / static_cast<double>(areas_m2.size()),
          percentile(1)};
}

std::size_t sector_count(double sector_deg) {
  const double count = std::round(360 / sector_deg);
  if (!(sector_deg >= kNarrowestSector_deg && sector_deg <= 360 && std::abs(count * sector_deg - 360) < 1e-6))
    throw InputError(fmt::format("--sector-deg: value {}: must divide 360 and be within {:g} and 360", sector_deg,
                                 kNarrowestSector_deg));
  return static_cast<std::size_t>(count);
}

std::size_t sector_of(double azimuth_deg, double sector_deg) {
  const auto count = static_cast<std::int64_t>(sector_count(sector_deg));
  const auto number = static_cast<std::int64_t>(std::floor(azimuth_deg / sector_deg + 0.5 + 1e-9));
  return static_cast<std::size_t>((number % count + count) % count);
}

namespace {

// Views of one elevation, or all, and one sector, or all.
struct SectorViews {
  std::optional<std::size_t> elevation, sector;
  std::vector<std::size_t> views;
};

// The azimuths without those that are a turn from an earlier one.
std::vector<std::size_t> different_azimuths(const RcsSweep& sweep) {
  std::set<std::int64_t> seen;  // in 1e-9 of a turn
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < sweep.azimuth_deg.size(); ++i) {
    const double turns = sweep.azimuth_deg[i] / 360;
    if (seen.insert(std::llround(1e9 * (turns - std::floor(turns))) % 1'000'000'000).second) kept.push_back(i);
  }
  return kept;
}

// Elevations slowest; all is the last of the elevations and of the sectors. Without empty ones.
std::vector<SectorViews> sector_views(const RcsSweep& sweep, std::span<const std::size_t> azimuths, double sector_deg) {
  const std::size_t elevations = sweep.elevation_deg.size(), sectors = sector_count(sector_deg);
  std::vector<SectorViews> all((elevations + 1) * (sectors + 1));
  for (std::size_t e = 0; e <= elevations; ++e) {
    for (std::size_t s = 0; s <= sectors; ++s) {
      SectorViews& of = all[e * (sectors + 1) + s];
      if (e < elevations) of.elevation = e;
      if (s < sectors) of.sector = s;
    }
  }
  for (std::size_t e = 0; e < elevations; ++e) {
    for (const std::size_t azimuth : azimuths) {
      const std::size_t of = sector_of(sweep.azimuth_deg[azimuth], sector_deg);
      for (const std::size_t elevation : {e, elevations}) {
        for (const std::size_t sector : {of, sectors})
          all[elevation * (sectors + 1) + sector].views.push_back(e * sweep.azimuth_deg.size() + azimuth);
      }
    }
  }
  std::erase_if(all, [](const SectorViews& of) { return of.views.empty(); });
  return all;
}

double area_of(const Complex& s) { return 4 * kPi * std::norm(s); }

// Areas of one element of a part, or of the whole, m^2.
std::vector<double> areas_of(const RcsSweep& sweep, std::optional<std::uint16_t> part, std::size_t element,
                             std::span<const std::size_t> views) {
  const std::size_t frequencies = sweep.frequency_hz.size();
  std::vector<double> areas;
  areas.reserve(views.size() * frequencies);
  for (const std::size_t view : views) {
    if (!part) {
      for (const auto& matrix : sweep.models.back().matrices[view]) areas.push_back(area_of(matrix[element]));
    } else if (const auto found = sweep.parts[view].find(*part); found != sweep.parts[view].end()) {
      for (const auto& matrix : found->second) areas.push_back(area_of(Complex(matrix[element])));
    } else {
      areas.insert(areas.end(), frequencies, 0.0);
    }
  }
  return areas;
}

}  // namespace

RcsStatistics rcs_statistics(const RcsSweep& sweep, double sector_deg) {
  const std::vector<std::size_t> azimuths = different_azimuths(sweep);
  RcsStatistics statistics{sweep.frequency_hz, sweep.elevation_deg, sector_deg, azimuths.size(), {}};
  const std::vector<SectorViews> groups = sector_views(sweep, azimuths, sector_deg);
  std::set<std::uint16_t> parts;
  for (const auto& view : sweep.parts) {
    for (const auto& [part, matrices] : view) parts.insert(part);
  }
  std::vector<std::optional<std::uint16_t>> of{std::nullopt};
  of.insert(of.end(), parts.begin(), parts.end());
  for (const std::optional<std::uint16_t>& part : of) {
    for (const SectorViews& group : groups) {
      for (std::size_t element = 0; element < 4; ++element)
        statistics.rows.push_back({part, element, group.elevation, group.sector, group.views.size(),
                                   area_statistics(areas_of(sweep, part, element, group.views))});
    }
  }
  return statistics;
}

bool has_statistics_by_part(const RcsRequest& request, const TriangleMesh& mesh) {
  constexpr std::size_t kMost = 8'000'000;
  const std::size_t rows = request.frequency_hz.size() * request.azimuth_deg.size() * request.elevation_deg.size();
  return mesh.part_names.size() > 1 && rows * mesh.part_names.size() <= kMost;
}

AzimuthSampling azimuth_sampling(const RcsRequest& request, const TriangleMesh& mesh) {
  AzimuthSampling sampling;
  const std::vector<double> azimuths = averaged_azimuths(request);
  for (std::size_t i = 1; i < azimuths.size(); ++i)
    sampling.step_deg = std::max(sampling.step_deg, std::abs(azimuths[i] - azimuths[i - 1]));
  const Bounds box = bounds(mesh);
  sampling.extent_m = std::hypot(box.upper.x() - box.lower.x(), box.upper.y() - box.lower.y());
  sampling.is_bistatic = request.transmitter.has_value();
  sampling.highest_hz = *std::ranges::max_element(request.frequency_hz);
  sampling.lobe_deg =
      degrees(kSpeedOfLight / sampling.highest_hz / ((sampling.is_bistatic ? 1 : 2) * sampling.extent_m));
  return sampling;
}

namespace {

const char* lobe_formula(const AzimuthSampling& sampling) {
  return sampling.is_bistatic ? "lambda / D" : "lambda / 2D";
}

// Of the sectors of one elevation that have views.
std::size_t fewest_views(const RcsStatistics& statistics) {
  std::size_t fewest = statistics.azimuths;
  for (const SectorStatistics& row : statistics.rows) {
    if (row.elevation && row.sector) fewest = std::min(fewest, row.views);
  }
  return fewest;
}

}  // namespace

std::optional<std::string> lobe_warning(const RcsRequest& request, const TriangleMesh& mesh) {
  const AzimuthSampling sampling = azimuth_sampling(request, mesh);
  if (request.azimuth_deg.size() < kFewestDrawn || sampling.step_deg <= sampling.lobe_deg * (1 + 1e-9)) return {};
  return fmt::format(
      "the azimuths are {:.4g} deg apart, the narrowest lobes of a target of {:.3g} m at {:.4g} GHz {:.2g} deg wide "
      "({}): single values are samples of them, largest ones may be missed; steps of {:.2g} deg miss none",
      sampling.step_deg, sampling.extent_m, 1e-9 * sampling.highest_hz, sampling.lobe_deg, lobe_formula(sampling),
      sampling.lobe_deg / 2);
}

std::string sampling_text(const RcsStatistics& statistics, const AzimuthSampling& sampling) {
  if (sampling.step_deg == 0) return "one azimuth";
  const std::string steps =
      fmt::format("azimuth step {:.4g} deg, lobes {:.2g} deg ({}, D = {:.4g} m): ", sampling.step_deg,
                  sampling.lobe_deg, lobe_formula(sampling), sampling.extent_m);
  if (sampling.step_deg >= sampling.lobe_deg) return steps + "every view is an independent sample";
  return steps + fmt::format("about {:.0f} independent samples in a sector of {:g} deg",
                             std::max(1.0, statistics.sector_deg / sampling.lobe_deg), statistics.sector_deg);
}

std::optional<std::string> sampling_warning(const RcsStatistics& statistics, const AzimuthSampling& sampling) {
  const std::size_t fewest = fewest_views(statistics);
  if (sampling.step_deg <= 10 * sampling.lobe_deg || fewest >= kFewestViews) return {};
  return fmt::format(
      "{} of an elevation in a sector of {:g} deg: statistics of few samples; the azimuths are {:.4g} deg apart, lobes "
      "{:.2g} deg wide ({}); steps of {:.3g} deg have {} views in a sector",
      fewest == 1 ? "one view" : fmt::format("{} views", fewest), statistics.sector_deg, sampling.step_deg,
      sampling.lobe_deg, lobe_formula(sampling), statistics.sector_deg / kFewestViews, kFewestViews);
}

namespace {

double level_of(double area_m2) { return dbsm_of_area(area_m2, kMinPrinted_m2); }

std::array<double, 7> levels_of(const AreaStatistics& area) {
  return {level_of(area.p5_m2),  level_of(area.p25_m2),  level_of(area.median_m2), level_of(area.p75_m2),
          level_of(area.p95_m2), level_of(area.mean_m2), level_of(area.largest_m2)};
}

}  // namespace

std::string statistics_csv(const RcsStatistics& statistics, const std::string& heading,
                           std::span<const std::string> part_names) {
  std::string csv =
      heading +
      fmt::format(
          "# statistics of cross-sections in m^2 over the views and frequencies of a sector of azimuth, as levels; "
          "percentiles linear between the ordered values; azimuths a turn apart once\n"
          "# sectors of {:g} deg about their centre, without the upper bound; a part: the coherent sum of the "
          "contributions that end on it, edges on that of their first facet\n"
          "part,polarisation,elevation_deg,sector_centre_deg,views,values,p5_dbsm,p25_dbsm,median_dbsm,p75_dbsm,"
          "p95_dbsm,mean_dbsm,largest_dbsm\n",
          statistics.sector_deg);
  for (const SectorStatistics& row : statistics.rows) {
    csv += fmt::format(
        "{},{},{},{},{},{}", row.part ? csv_cell(part_names[*row.part]) : "whole", kPolarisationNames[row.element],
        row.elevation ? fmt::format("{:.9g}", statistics.elevation_deg[*row.elevation]) : "all",
        row.sector ? fmt::format("{:.9g}", static_cast<double>(*row.sector) * statistics.sector_deg) : "all", row.views,
        row.area.values);
    for (const double dbsm : levels_of(row.area)) csv += fmt::format(",{:.4f}", dbsm);
    csv += "\n";
  }
  return csv;
}

namespace {

// "elevation 1 deg, 9.4 GHz", "3 elevations from 1 to 5 deg, 11 frequencies from 9 to 10 GHz".
std::string scope(const RcsStatistics& statistics) {
  const auto axis = [](const std::vector<double>& values, double unit, const char* one, const char* many,
                       const char* unit_name) {
    if (values.size() == 1) return fmt::format("{}{:.6g} {}", one, unit * values[0], unit_name);
    const auto [lowest, highest] = std::ranges::minmax(values);
    return fmt::format("{} {} from {:.6g} to {:.6g} {}", values.size(), many, unit * lowest, unit * highest, unit_name);
  };
  return axis(statistics.elevation_deg, 1, "elevation ", "elevations", "deg") + ", " +
         axis(statistics.frequency_hz, 1e-9, "", "frequencies", "GHz");
}

// The ten parts of the highest mean of hh and vv over all views, each with its median and mean.
std::string parts_table(const RcsStatistics& statistics, std::span<const std::string> part_names) {
  constexpr std::size_t kMost = 10;
  struct PartLevels {
    std::string name;
    std::array<AreaStatistics, 2> area;  // hh, vv
    double highest() const { return std::max(area[0].mean_m2, area[1].mean_m2); }
  };
  std::vector<PartLevels> parts;
  for (const SectorStatistics& row : statistics.rows) {
    if (!row.part || row.elevation || row.sector) continue;
    if (row.element == kCoPolar[0]) parts.push_back({on_one_line(part_names[*row.part]), {row.area, {}}});
    if (row.element == kCoPolar[1]) parts.back().area[1] = row.area;
  }
  if (parts.empty()) return "";
  std::ranges::stable_sort(parts, std::greater(), &PartLevels::highest);
  std::string text = "parts, all azimuths        hh median     mean   vv median     mean\n";
  for (std::size_t i = 0; i < std::min(kMost, parts.size()); ++i) {
    const auto& [hh, vv] = parts[i].area;
    text += fmt::format("{:<26} {:9.1f}{:9.1f}{:12.1f}{:9.1f}\n", shown(parts[i].name, 26), level_of(hh.median_m2),
                        level_of(hh.mean_m2), level_of(vv.median_m2), level_of(vv.mean_m2));
  }
  if (parts.size() > kMost) text += fmt::format("and {} parts of lower means\n", parts.size() - kMost);
  return text;
}

}  // namespace

std::string statistics_table(const RcsStatistics& statistics, std::span<const std::string> part_names) {
  constexpr std::size_t kMostSectors = 24;
  std::string text = fmt::format(
      "dBsm over views and frequencies, {}\n     azimuth (deg)   views     5 %    25 %  median    75 %    95 %    mean "
      " largest\n",
      scope(statistics));
  std::size_t left_out = 0;
  for (const std::size_t element : kCoPolar) {
    std::size_t sectors = 0;
    for (const SectorStatistics& row : statistics.rows) {
      if (row.part || row.elevation || row.element != element) continue;
      if (row.sector && ++sectors > kMostSectors) continue;
      const double centre = static_cast<double>(row.sector.value_or(0)) * statistics.sector_deg;
      text += fmt::format("{}   {:>13} {:7}", kPolarisationNames[element],
                          row.sector ? fmt::format("{:g} to {:g}", centre - statistics.sector_deg / 2,
                                                   centre + statistics.sector_deg / 2)
                                     : "all",
                          row.views);
      for (const double dbsm : levels_of(row.area)) text += fmt::format("{:8.1f}", dbsm);
      text += "\n";
    }
    left_out = sectors > kMostSectors ? sectors - kMostSectors : 0;
  }
  if (left_out > 0) text += fmt::format("and {} more sectors\n", left_out);
  return text + parts_table(statistics, part_names);
}

}  // namespace seaglint
