// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/turntable_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "tools/figure/mesh_picture.h"

namespace seaglint {

namespace {

std::string band_text(const TurntableEcho& echo) {
  return fmt::format("{:g} to {:g} GHz in steps of {:.4g} MHz", 1e-9 * echo.frequency_hz.front(),
                     1e-9 * echo.frequency_hz.back(), 1e-6 * (echo.frequency_hz[1] - echo.frequency_hz[0]));
}

std::string sector_text(const TurntableEcho& echo) {
  return fmt::format("azimuth {:.6g} to {:.6g} deg in steps of {:.4g} deg, elevation {:g} deg",
                     echo.azimuth_deg.front(), echo.azimuth_deg.back(), echo.azimuth_deg[1] - echo.azimuth_deg[0],
                     echo.elevation_deg);
}

FigureAxis dbsm_axis(const std::vector<double>& levels, const TurntableCaption& caption) {
  const double highest = std::max(caption.highest_dbsm.value_or(std::ranges::max(levels)), kMinLevel_dbsm);
  return {"RCS (dBsm)", AxisRange{highest + kMapFloorDb, highest}, false};
}

std::vector<double> clipped(std::vector<double> levels, const FigureAxis& axis) {
  for (double& level : levels) level = std::max(level, axis.range->first);
  return levels;
}

// Groups of neighbouring values, `most` groups at most, of equal size but for the last.
struct Groups {
  std::size_t size = 1, count = 0;
  std::vector<double> middles;
};

Groups groups_of(const std::vector<double>& values, std::size_t most) {
  Groups groups;
  groups.size = (values.size() + most - 1) / most;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t first = 0; first < values.size(); first += groups.size)
    groups.middles.push_back(values[first] + 0.5 * step * static_cast<double>(groups.size - 1));
  groups.count = groups.middles.size();
  return groups;
}

// Outlines of the mesh and of its parts from a fiftieth of its size on.
std::vector<std::array<double, 2>> plan_of(const TriangleMesh& mesh, const Vec3& right, const Vec3& up) {
  constexpr double kSamples = 1000, kLeast = 0.02;
  const auto size_of = [&](const TriangleMesh& of) {
    const Bounds box = bounds(of);
    return (box.upper - box.lower).norm();
  };
  const double size = size_of(mesh);
  std::vector<std::array<double, 2>> plan = outline_of(mesh, right, up, size / kSamples);
  if (mesh.part_names.size() < 2) return plan;
  std::vector<TriangleMesh> parts(mesh.part_names.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    TriangleMesh& part = parts[mesh.triangle_part[t]];
    if (part.triangles.empty()) part.vertices = mesh.vertices;
    part.triangles.push_back(mesh.triangles[t]);
  }
  for (const TriangleMesh& part : parts) {
    if (part.triangles.empty() || size_of(part) < kLeast * size) continue;
    const auto more = outline_of(part, right, up, size / kSamples);
    plan.insert(plan.end(), more.begin(), more.end());
  }
  return plan;
}

}  // namespace

void require_turntable(const RcsRequest& request, const std::string& option) {
  const auto require_axis = [&](const char* sweep, const std::vector<double>& values) {
    if (values.size() < kFewestOfTurntable)
      throw InputError(fmt::format("{}: {} value{}: {} needs at least {}", sweep, values.size(),
                                   values.size() == 1 ? "" : "s", option, kFewestOfTurntable));
    if (values.back() < values.front())
      throw InputError(fmt::format("{}: a step below 0: {} needs ascending values", sweep, option));
  };
  require_axis("--frequency-ghz", request.frequency_hz);
  require_axis("--azimuth-deg", request.azimuth_deg);
  if (request.elevation_deg.size() != 1)
    throw InputError(fmt::format("--elevation-deg: {} values: {} needs one", request.elevation_deg.size(), option));
  if (std::abs(request.elevation_deg[0]) > kSteepestTurntable_deg)
    throw InputError(fmt::format("--elevation-deg: value {:g}: with {} it must be within {:g} and {:g}",
                                 request.elevation_deg[0], option, -kSteepestTurntable_deg, kSteepestTurntable_deg));
  if (request.azimuth_deg.back() - request.azimuth_deg.front() > 360)
    throw InputError(fmt::format("--azimuth-deg: {:g} to {:g}: with {} at most a turn of 360 deg",
                                 request.azimuth_deg.front(), request.azimuth_deg.back(), option));
  if (request.transmitter)
    throw InputError(fmt::format("{} does not support --transmit-azimuth-deg: it needs one antenna", option));
}

void require_window(const RcsRequest& request, const TriangleMesh& mesh, const std::string& option, bool image) {
  const double elevation = request.elevation_deg[0];
  const TurntableSampling sampling = turntable_sampling(request.frequency_hz, request.azimuth_deg, elevation);
  const TurntableExtent extent = turntable_extent(mesh, request.azimuth_deg, elevation);
  // A step that is smaller by the ratio of both, with three digits, rounded down.
  const auto needed = [](double step, double ratio) {
    const double wanted = step * ratio, digit = std::pow(10, std::floor(std::log10(wanted)) - 2);
    return digit * std::floor(wanted / digit);
  };
  const auto check = [&](const char* sweep, double step, const char* unit, double window_m, double target_m,
                         const char* direction) {
    if (target_m <= window_m) return;
    throw InputError(
        fmt::format("{}: step {:.4g}: must be at most {:.4g} {} for {}, which repeats every {:.4g} m {}: the target is "
                    "{:.4g} m long there",
                    sweep, step, needed(step, window_m / target_m), unit, option, window_m, direction, target_m));
  };
  check("--frequency-ghz", 1e-9 * (request.frequency_hz[1] - request.frequency_hz[0]), "GHz", sampling.range_window_m,
        extent.longest_range_m, "in range");
  if (image)
    check("--azimuth-deg", request.azimuth_deg[1] - request.azimuth_deg[0], "deg", sampling.cross_window_m,
          extent.longest_cross_m, "in cross range");
}

TurntableEcho turntable_echo(const RcsSweep& sweep, std::size_t element) {
  TurntableEcho echo{sweep.frequency_hz, sweep.azimuth_deg, sweep.elevation_deg.front(), {}, element};
  for (const auto& frequencies : sweep.models.back().matrices) {
    for (const std::array<Complex, 4>& matrix : frequencies) echo.amplitude_m.push_back(matrix[element]);
  }
  return echo;
}

Heatmap turntable_figure(const TurntableEcho& echo, const TurntableImage& image, const TriangleMesh* mesh,
                         const TurntableCaption& caption) {
  const TurntableSampling sampling = turntable_sampling(echo.frequency_hz, echo.azimuth_deg, echo.elevation_deg);
  Heatmap figure;
  figure.title = caption.title;
  figure.x.label = "range (m)";
  figure.y.label = "cross range (m)";
  figure.equal_axes = true;
  figure.colour = dbsm_axis(image.level_dbsm, caption);
  figure.map = {image.range_m, image.cross_m, clipped(image.level_dbsm, figure.colour)};
  if (mesh != nullptr) {
    const TurntableAxes axes(sampling.middle_azimuth_deg, echo.elevation_deg);
    figure.outline = plan_of(*mesh, axes.range, axes.cross);
  }
  figure.notes = {fmt::format("seen from above, radar at the left (azimuth {:.6g} deg)", sampling.middle_azimuth_deg),
                  "range from the body's origin, positive = farther; cross range positive = left",
                  !figure.outline.empty() ? "lines: outlines of the mesh and its parts" : "",
                  band_text(echo),
                  sector_text(echo),
                  fmt::format("resolution {:.3g} m (c/2B) by {:.3g} m (lambda/2 sector)", sampling.range_cell_m,
                              sampling.cross_cell_m),
                  "Taylor's weights (-35 dB); a point has its own level",
                  fmt::format("repeats every {:.4g} m by {:.4g} m", sampling.range_window_m, sampling.cross_window_m)};
  std::erase(figure.notes, "");
  figure.notes.insert(figure.notes.end(), caption.notes.begin(), caption.notes.end());
  return figure;
}

Heatmap profiles_figure(const TurntableEcho& echo, const TurntableProfiles& profiles, const TurntableCaption& caption,
                        const PeakNames& names, std::size_t most) {
  constexpr std::size_t kMostCells = 800;
  const TurntableSampling sampling = turntable_sampling(echo.frequency_hz, echo.azimuth_deg, echo.elevation_deg);
  const std::size_t ranges = profiles.range_m.size(), middle = echo.azimuth_deg.size() / 2;
  const double middle_hz = echo.frequency_hz[echo.frequency_hz.size() / 2];
  Heatmap figure;
  figure.title = caption.title;
  figure.x.label = "range (m)";
  figure.y.label = "azimuth (deg)";
  figure.colour = dbsm_axis(profiles.level_dbsm, caption);
  const Groups columns = groups_of(profiles.range_m, kMostCells), rows = groups_of(echo.azimuth_deg, kMostCells);
  figure.map = {columns.middles, rows.middles,
                std::vector<double>(columns.count * rows.count, figure.colour.range->first)};
  figure.profile.emplace();
  figure.profile->y = {"RCS (dBsm)", figure.colour.range, false};
  figure.profile->colour = caption.colour;
  figure.profile->values.assign(columns.count, figure.colour.range->first);
  const auto raise = [](double& value, double level) { value = std::max(value, level); };
  for (std::size_t a = 0; a < echo.azimuth_deg.size(); ++a) {
    for (std::size_t m = 0; m < ranges; ++m) {
      const double level = profiles.level_dbsm[a * ranges + m];
      raise(figure.map.values[a / rows.size * columns.count + m / columns.size], level);
      if (a == middle) raise(figure.profile->values[m / columns.size], level);
    }
  }
  if (names) {
    std::vector<double> magnitude_m;
    for (std::size_t m = 0; m < ranges; ++m)
      magnitude_m.push_back(amplitude_of_dbsm(profiles.level_dbsm[middle * ranges + m]));
    std::vector<NamedPeak> peaks = strongest_peaks(profiles.range_m, magnitude_m, sampling.range_cell_m, most);
    names(peaks, {{echo.azimuth_deg[middle], echo.elevation_deg, middle_hz}, echo.element, sampling.range_cell_m});
    for (const NamedPeak& peak : peaks) {
      if (!peak.name.empty() && dbsm(peak.magnitude_m) > figure.colour.range->first)
        figure.profile->peaks.push_back({peak.range_m, dbsm(peak.magnitude_m), peak.name});
    }
  }
  figure.notes = {
      fmt::format("above: azimuth {:.6g} deg{}", echo.azimuth_deg[middle],
                  names ? ", peaks by what scatters most" : ""),
      "range from the body's origin, positive = farther",
      band_text(echo),
      sector_text(echo),
      fmt::format("resolution {:.3g} m (c/2B), repeats every {:.4g} m", sampling.range_cell_m, sampling.range_window_m),
      "Taylor's weights (-35 dB); a point has its own level"};
  figure.notes.insert(figure.notes.end(), caption.notes.begin(), caption.notes.end());
  return figure;
}

PeakNames part_names(const RcsRequest& request, const RcsTarget& target) {
  return [&request, &target](std::vector<NamedPeak>& peaks, const ProfilePlace& place) {
    const SolveResult solved = view_contributions(request, target, place.view);
    std::vector<RangeContribution> contributions;
    append_contributions({.points = solved.views[0].points,
                          .mesh = target.prepared.mesh,
                          .k = 2 * kPi * place.view.frequency_hz / kSpeedOfLight,
                          .element = place.element},
                         contributions);
    name_peaks(peaks, contributions, place.range_cell_m);
  };
}

}  // namespace seaglint
