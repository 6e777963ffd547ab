// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cross_check/rcs_cross_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/numbers/quantile.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

constexpr std::array<std::size_t, 2> kElements{0, 3};  // hh, vv of a matrix

using ViewMatrices = std::vector<std::vector<std::array<Complex, 4>>>;  // [view][frequency]

double relative_db(double difference2, double reference2) {
  if (difference2 == 0) return -kMostRelativeDb;
  if (reference2 == 0) return kMostRelativeDb;
  return std::clamp(10 * std::log10(difference2 / reference2), -kMostRelativeDb, kMostRelativeDb);
}

CrossCheckRow row_of(const std::vector<std::array<Complex, 4>>& beams, const std::vector<std::array<Complex, 4>>& rays,
                     std::size_t element) {
  double beams2 = 0, rays2 = 0, difference2 = 0;  // sums of squares over the frequencies
  for (std::size_t q = 0; q < beams.size(); ++q) {
    const Complex &b = beams[q][kElements[element]], &r = rays[q][kElements[element]];
    beams2 += std::norm(b);
    rays2 += std::norm(r);
    difference2 += std::norm(r - b);
  }
  const double frequencies = static_cast<double>(beams.size());
  CrossCheckRow row;
  row.element = element;
  row.beams_dbsm = dbsm_of_area(4 * kPi * beams2 / frequencies, kMinPrinted_m2);
  row.rays_dbsm = dbsm_of_area(4 * kPi * rays2 / frequencies, kMinPrinted_m2);
  row.relative_db = relative_db(difference2, beams2);
  return row;
}

// Fills in the groups of a view's rows, hh and vv.
void set_groups(GroupSums beams, const GroupSums& rays, CrossCheckRow* rows) {
  for (const auto& [group, sum] : rays) {
    for (std::size_t i = 0; i < 4; ++i) beams[group][i] -= sum[i];
  }
  for (std::size_t element = 0; element < kElements.size(); ++element) {
    double all = 0, most = 0;
    for (const auto& [group, difference] : beams) {
      const double size = std::abs(difference[kElements[element]]);
      all += size;
      if (size <= most) continue;
      most = size;
      rows[element].group = group;
    }
    if (all > 0) rows[element].fraction = most / all;
  }
}

double middle_frequency(const std::vector<double>& frequency_hz) {
  const auto [lowest, highest] = std::ranges::minmax(frequency_hz);
  return std::ranges::min(frequency_hz, {},
                          [middle = (lowest + highest) / 2](double hz) { return std::abs(hz - middle); });
}

ViewMatrices solved(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop) {
  return std::move(compute_rcs(request, target, threads, stop).sweep.models.back().matrices);
}

void require_comparable(const RcsRequest& request) {
  if (!request.cavities.parts.empty())
    throw InputError("--cross-check compares beams with rays; a --cavity is solved by neither");
  if (request.uncertainty || request.exports.wanted())
    throw InputError("--cross-check does not support --uncertainty and exports of one aspect");
}

}  // namespace

CrossCheck compare_solutions(const RcsRequest& beams, const RcsRequest& rays, const RcsTarget& target, int threads,
                             const StopFlag* stop) {
  require_comparable(beams);
  const RcsSweep sweep = requested_sweep(beams);
  CrossCheck check{std::vector<CrossCheckRow>(2 * sweep.views()), middle_frequency(beams.frequency_hz)};
  {
    const ViewMatrices by_beams = solved(beams, target, threads, stop), by_rays = solved(rays, target, threads, stop);
    for (std::size_t i = 0; i < check.rows.size(); ++i) {
      check.rows[i] = row_of(by_beams[i / 2], by_rays[i / 2], i % 2);
      check.rows[i].azimuth_deg = sweep.azimuth_of(i / 2);
      check.rows[i].elevation_deg = sweep.elevation_of(i / 2);
    }
  }
  if (beams.sea.reflection) return check;
  const double k = 2 * kPi * check.grouped_hz / kSpeedOfLight;
  std::atomic<std::size_t> done{0};
  Progress progress("contributions", sweep.views(), "views");
  try {
    parallel_for(
        sweep.views(), std::min(thread_count(threads), 8),  // each needs the memory of a trace
        [&](std::size_t i) {
          const RcsView view{sweep.azimuth_of(i), sweep.elevation_of(i), check.grouped_hz};
          // One after the other: a view of a large target has millions of contributions.
          const GroupSums of_beams = group_sums(view_contributions(beams, target, view, 1, stop).views[0].points, k);
          set_groups(of_beams, group_sums(view_contributions(rays, target, view, 1, stop).views[0].points, k),
                     &check.rows[2 * i]);
          ++done;
          progress.advance();
        },
        stop);
  } catch (const Interrupted&) {
    throw WorkError(fmt::format("interrupted after the contributions of {} of {} views", done.load(), sweep.views()));
  }
  return check;
}

CrossCheck cross_check_rcs(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop) {
  RcsRequest beams = request, rays = request;
  beams.physical_optics_too = rays.physical_optics_too = false;
  beams.method = SolverMethod::kBeams;
  beams.ray_spacing_m = 0;
  rays.method = SolverMethod::kRays;
  return compare_solutions(beams, rays, target, threads, stop);
}

CrossCheckSummary summary_of(const CrossCheck& check) {
  constexpr std::size_t kWorst = 5;
  std::vector<double> relative, levels;
  for (const CrossCheckRow& row : check.rows) {
    relative.push_back(row.relative_db);
    levels.push_back(row.level_dbsm());
  }
  std::ranges::sort(relative);
  std::ranges::sort(levels);
  CrossCheckSummary summary{quantile(relative, 0.5), quantile(relative, 0.9), {}, {}};
  const double median_level = quantile(levels, 0.5);
  for (std::size_t i = 0; i < check.rows.size(); ++i) {
    if (check.rows[i].level_dbsm() < median_level) continue;
    summary.worst.push_back(i);
    if (std::abs(check.rows[i].difference_db()) > kLargeDifferenceDb) summary.large.push_back(i);
  }
  std::ranges::stable_sort(summary.worst, std::ranges::greater{},
                           [&](std::size_t i) { return check.rows[i].relative_db; });
  if (summary.worst.size() > kWorst) summary.worst.resize(kWorst);
  return summary;
}

}  // namespace seaglint
