// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Cross-check by the other method of the solver: of the views of a sweep by groups of contributions, and of samples of
// a scenario.

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/process/parallel.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scenario/scenario.h"
#include "tools/figure/figure.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_uncertainty.h"

namespace seaglint {

// Sums of the contributions of one view by part, number of bounces and mechanism.

struct ContributionGroup {
  std::uint16_t part = 0;  // index into the mesh's parts
  std::uint8_t bounces = 1;
  Mechanism mechanism = Mechanism::kPhysicalOptics;

  auto operator<=>(const ContributionGroup&) const = default;  // NOLINT(modernize-use-nullptr): compares with 0
};

using GroupSums = std::map<ContributionGroup, ScatteringMatrix>;

// hh, hv, vh, vv of every group that occurs, m, at wavenumber k; phase about the point that psi refers to.
GroupSums group_sums(std::span<const Point> points, double k);

// "part hull, 2 bounces, po"
std::string text_of(const ContributionGroup& group, const std::vector<std::string>& part_names);

// A sweep by beams and by shooting and bouncing rays: how far the two differ in every view, and in which contributions.

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

// A cross-check of two methods as a table and as text.

// CSV of all rows, elevation slowest, then azimuth, then element, after rcs_heading().
std::string cross_check_table(const RcsRequest& request, const RcsTarget& target, const CrossCheck& check,
                              std::span<const std::string> warnings = {});

// All rows for a terminal, a line each under one of headings, then the figures of summary_of() with the rows it names.
std::string cross_check_text(const CrossCheck& check, const RcsTarget& target);

// Levels of hh and vv by both methods along the axis, azimuth or elevation, that has several values, and below them the
// relative difference of the fields. No plots where both axes vary, or none.
PlotPanels cross_check_plots(const CrossCheck& check);

// Samples of a scenario by the other method of the solver.

// A sample by the method of its scenario and by the other one of beams and rays.
struct SampleDifference {
  std::size_t sample = 0;
  std::string target;
  SolverMethod method = SolverMethod::kBeams, other = SolverMethod::kRays;  // of the target itself
  // |H_other - H| / |H|, both root sums of squares over pulses and frequencies, dB, -300 or more.
  double response_db = 0;
  double strongest_cell_db = 0;  // level of the other map in the strongest cell of the map, less that cell's, dB
};

struct SampleCrossCheck {
  std::vector<SampleDifference> differences;  // in the order of the samples
  std::size_t points = 0;                     // samples of ideal points alone or of the sea alone, without a solver
  bool is_sea_alone = false;
  double median_response_db() const;  // of the differences; NaN without any
};

// `count` of `size` samples in the middles of equal parts of the set: (2 n + 1) size / (2 count), 0 < count <= size.
std::vector<std::size_t> evenly_spread(std::size_t count, std::size_t size);

// Cross-check of these samples of the scenario, in parallel; the result does not depend on the threads. Throws
// InputError for a target without power by one method, Interrupted when *stop becomes true.
SampleCrossCheck cross_check_samples(const Scenario& scenario, std::span<const std::size_t> samples, int threads,
                                     const StopFlag* stop = nullptr);

// Relative difference of two responses of one shape, dB, within -300 and 300; of a vanishing reference 300, unless both
// vanish.
double relative_difference_db(const FrequencyResponse& reference, const FrequencyResponse& other);

// A line for each sample under one of headings, then median and largest differences and the number of samples left out.
std::string text_of(const SampleCrossCheck& check);

}  // namespace seaglint
