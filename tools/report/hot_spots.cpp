// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/hot_spots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/field_tables/field_table.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/solver/solve.h"
#include "tools/page/html.h"
#include "tools/page/plot_json.h"
#include "tools/rcs/facet_levels.h"

namespace seaglint {
namespace {

using nlohmann::ordered_json;

constexpr double kRangeDb = 50;      // of the colours
constexpr int kPositionDigits = 16;  // binary digits of a coordinate: 2 mm of a 144 m ship

double centre_ghz(const RadarSpec& radar) { return (lowest_ghz(radar) + highest_ghz(radar)) / 2; }

std::vector<View> views_shown(std::vector<View> views) {
  std::ranges::stable_sort(views, {}, [](const View& v) { return std::pair(v.azimuth_rad, v.elevation_rad); });
  const std::size_t step = (views.size() + kHotSpotViews - 1) / kHotSpotViews;
  std::vector<View> shown;
  for (std::size_t i = 0; i < views.size(); i += step) shown.push_back(views[i]);
  return shown;
}

// Vertex numbers, each as its difference from the one before, 32 bits little-endian: small numbers, which pack well.
std::string packed_triangles(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(12 * mesh.triangles.size());
  std::uint32_t before = 0;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      const std::uint32_t difference = vertex - before;
      for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(difference >> 8 * i));
      before = vertex;
    }
  }
  return packed(bytes);
}

ordered_json json_of(const Target& target, const Scenario& scenario, const std::vector<View>& views, int threads,
                     const StopFlag* stop) {
  const Scatterer& scatterer = *target.models.front()->prepared->scatterer;
  const double wavelength = kSpeedOfLight / (1e9 * centre_ghz(scenario.radar)), k = 2 * kPi / wavelength;
  const SolverSpec& solver = target.spec.solver;
  std::vector<FacetLevels> levels;
  std::vector<double> total_dbsm;
  const auto element = static_cast<std::size_t>(scenario.radar.polarisation);
  for (const View& view : views) {
    const RadarBasis basis = radar_basis(direction_to_radar(view.azimuth_rad, view.elevation_rad));
    const SolveResult solved = solve({.scatterer = scatterer,
                                      .views = {monostatic(basis)},
                                      .wavenumbers = {k},
                                      .settings = tracing_settings(solver),
                                      .points_for_rad = default_aspect_change(scatterer, wavelength),
                                      .threads = threads,
                                      .stop = stop});
    levels.push_back(facet_levels(scatterer, solved.views[0].points, k, element));
    total_dbsm.push_back(dbsm_of_area(4 * kPi * std::norm(solved.views[0].matrices[0][element])));
  }
  const double top = std::ceil(std::ranges::max_element(levels, {}, &FacetLevels::highest_dbsm)->highest_dbsm);
  const TriangleMesh mesh = welded(mesh_of_facets(scatterer));
  std::vector<double> coordinates;
  for (const Vec3& vertex : mesh.vertices) coordinates.insert(coordinates.end(), vertex.begin(), vertex.end());
  ordered_json json{{"name", target.spec.name},
                    {"vertices", packed_floats(coordinates, kPositionDigits)},
                    {"triangles", packed_triangles(mesh)},
                    {"top_dbsm", top},
                    {"views", ordered_json::array()}};
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<std::uint8_t> steps;  // 0: kRangeDb below the top, or less
    for (const double level : levels[v].dbsm)
      steps.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(level - top + kRangeDb, 0.0, kRangeDb))));
    json["views"].push_back({{"azimuth_deg", views[v].azimuth_deg},
                             {"elevation_deg", views[v].elevation_deg},
                             {"total_dbsm", std::round(100 * total_dbsm[v]) / 100},
                             {"levels", packed(steps)}});
  }
  return json;
}

}  // namespace

HotSpots hot_spots(const Scenario& scenario, const SamplePlan& plan, const std::vector<Target>& targets, int threads,
                   const StopFlag* stop) {
  const std::vector<View> views = views_shown(plan.views());
  ordered_json list = ordered_json::array();
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
    list.push_back(json_of(target, scenario, views, threads, stop));
  }
  if (list.empty()) return {"", left_out};
  const char* element = kPolarisationNames[static_cast<int>(scenario.radar.polarisation)];
  return {
      script_json(ordered_json{{"range_db", kRangeDb}, {"step_db", 1}, {"targets", list}}.dump()),
      fmt::format("Level of each facet’s contribution at {:g} GHz, {}, for one body at rest without the sea; facets of "
                  "one plane have the level of their sum. Multiple bounces count for the facet that they leave "
                  "last.{}{}",
                  centre_ghz(scenario.radar), element,
                  views.size() < plan.views().size()
                      ? fmt::format(" {} of the scenario’s {} views.", views.size(), plan.views().size())
                      : "",
                  left_out)};
}

}  // namespace seaglint
