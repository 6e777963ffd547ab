// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A sweep by beams and by shooting and bouncing rays: how far the two differ in every view, and in which contributions.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/core/process/parallel.h"
#include "tools/cross_check/contribution_groups.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"

namespace seaglint {

inline constexpr double kMostRelativeDb = 300;   // bounds of a relative difference, for echoes that vanish
inline constexpr double kLargeDifferenceDb = 3;  // rows beyond it are listed

// One element of one view. Levels are those of the mean of sigma over the frequencies.
struct CrossCheckRow {
  double azimuth_deg = 0, elevation_deg = 0;
  std::size_t element = 0;  // 0 hh, 1 vv
  double beams_dbsm = 0, rays_dbsm = 0;
  // |S_rays - S_beams| / |S_beams|, both root sums of squares over the frequencies, dB, within -+kMostRelativeDb.
  double relative_db = 0;
  // The group of contributions whose sums by the two methods differ most, and its fraction of the sum of the magnitudes
  // of the differences of all groups, 0 to 1. Absent where no group differs, and over the sea.
  std::optional<ContributionGroup> group;
  double fraction = 0;

  double difference_db() const { return rays_dbsm - beams_dbsm; }
  double level_dbsm() const { return beams_dbsm > rays_dbsm ? beams_dbsm : rays_dbsm; }
};

struct CrossCheck {
  std::vector<CrossCheckRow> rows;  // elevation slowest, then azimuth, then hh and vv
  double grouped_hz = 0;            // the frequency of the groups: that nearest to the middle of the sweep
};

// The request by beams and by rays, whatever its method, its other settings unchanged, on `threads` threads (0 = all
// processors). The result does not depend on their number. Throws InputError for a request with cavities, uncertainty
// or exports of one aspect, and what compute_rcs() throws.
CrossCheck cross_check_rcs(const RcsRequest& request, const RcsTarget& target, int threads = 0,
                           const StopFlag* stop = nullptr);

// The same for two requests of one sweep that differ in any settings of the solver; those of `rays` become the rays'.
CrossCheck compare_solutions(const RcsRequest& beams, const RcsRequest& rays, const RcsTarget& target, int threads = 0,
                             const StopFlag* stop = nullptr);

// Figures of all rows. A row is strong when the higher of its two levels is at least the median of these levels.
struct CrossCheckSummary {
  double median_relative_db = 0, p90_relative_db = 0;
  std::vector<std::size_t> worst;  // strong rows of the largest relative differences, at most five, largest first
  std::vector<std::size_t> large;  // strong rows whose levels differ by more than kLargeDifferenceDb, in their order
};
CrossCheckSummary summary_of(const CrossCheck& check);

}  // namespace seaglint
