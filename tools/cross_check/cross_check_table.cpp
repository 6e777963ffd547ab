// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cross_check/cross_check_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/text/escape.h"
#include "tools/rcs/echo_selection.h"
#include "tools/rcs/rcs_table.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

constexpr const char* kElementNames[2] = {"hh", "vv"};

std::string group_text(const CrossCheckRow& row, const RcsTarget& target) {
  if (!row.group) return "-";
  return fmt::format("{}: {:.2f} of the difference", text_of(*row.group, target.prepared.mesh.part_names),
                     row.fraction);
}

std::string line_of(const CrossCheckRow& row, const RcsTarget& target) {
  return fmt::format("{:>11.6g} {:>13.6g}  {:<7} {:>10.2f} {:>9.2f} {:>13.2f} {:>11.1f}  {}\n", row.azimuth_deg,
                     row.elevation_deg, kElementNames[row.element], row.beams_dbsm, row.rays_dbsm, row.difference_db(),
                     row.relative_db, group_text(row, target));
}

std::string heading() {
  return fmt::format("{:>11} {:>13}  {:<7} {:>10} {:>9} {:>13} {:>11}  {}\n", "azimuth_deg", "elevation_deg", "element",
                     "beams_dbsm", "rays_dbsm", "difference_db", "relative_db", "largest difference");
}

std::string lines_of(const CrossCheck& check, const RcsTarget& target, const std::vector<std::size_t>& rows) {
  constexpr std::size_t kMaxShown = 40;
  std::string lines = heading();
  for (std::size_t i = 0; i < std::min(kMaxShown, rows.size()); ++i) lines += line_of(check.rows[rows[i]], target);
  if (rows.size() > kMaxShown) lines += fmt::format("... and {} more\n", rows.size() - kMaxShown);
  return lines;
}

}  // namespace

std::string cross_check_table(const RcsRequest& request, const RcsTarget& target, const CrossCheck& check,
                              std::span<const std::string> warnings) {
  const auto [lowest, highest] = std::ranges::minmax(request.frequency_hz);
  RcsRequest beams = request, rays = request;
  beams.method = SolverMethod::kBeams;
  rays.method = SolverMethod::kRays;
  const Scatterer& scatterer = *target.prepared.scatterer;
  std::string csv = rcs_heading(beams, scatterer, "rcs --cross-check", warnings) +
                    fmt::format(
                        "# rays: ray_spacing_m {:.6g}\n# {} frequencies from {:.9g} to {:.9g} Hz; levels of the mean "
                        "cross-section over them; "
                        "difference: rays less beams; relative: |S_rays - S_beams| / |S_beams|, both root sums of "
                        "squares over the frequencies, dB\n"
                        "# part, bounces, mechanism: the contributions whose sums differ most at {:.9g} Hz; fraction: "
                        "of the sum of the magnitudes of the differences of all such sums\n"
                        "azimuth_deg,elevation_deg,element,beams_dbsm,rays_dbsm,difference_db,relative_db,part,bounces,"
                        "mechanism,fraction\n",
                        ray_spacing(scatterer, settings_of(rays, target, rays.edges)), request.frequency_hz.size(),
                        lowest, highest, check.grouped_hz);
  for (const CrossCheckRow& row : check.rows) {
    csv += fmt::format("{:.9g},{:.9g},{},{:.4f},{:.4f},{:.4f},{:.3f}", row.azimuth_deg, row.elevation_deg,
                       kElementNames[row.element], row.beams_dbsm, row.rays_dbsm, row.difference_db(), row.relative_db);
    if (row.group) {
      csv += fmt::format(",{},{},{},{:.4f}\n", csv_cell(target.prepared.mesh.part_names[row.group->part]),
                         row.group->bounces, kMechanismNames[static_cast<std::size_t>(row.group->mechanism)],
                         row.fraction);
    } else {
      csv += ",,,,\n";
    }
  }
  return csv;
}

std::string cross_check_text(const CrossCheck& check, const RcsTarget& target) {
  std::string text = heading();
  for (const CrossCheckRow& row : check.rows) text += line_of(row, target);
  const CrossCheckSummary summary = summary_of(check);
  text += fmt::format("Relative difference of {} rows: median {:.1f} dB, 90th percentile {:.1f} dB\n",
                      check.rows.size(), summary.median_relative_db, summary.p90_relative_db);
  if (summary.p90_relative_db > -kMostRelativeDb || !summary.large.empty()) {
    text += "Largest relative differences, of rows whose level is at least the median of all:\n" +
            lines_of(check, target, summary.worst);
  }
  text += fmt::format("Rows of these levels that differ by more than {:g} dB: {}\n", kLargeDifferenceDb,
                      summary.large.empty() ? "none" : std::to_string(summary.large.size()));
  if (!summary.large.empty()) text += lines_of(check, target, summary.large);
  return text;
}

}  // namespace seaglint
