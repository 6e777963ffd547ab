// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A sweep whose smallest patch, or distance between rays, is halved until its levels no longer change.

#include <functional>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_sweep.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

// Changes of a level by halving this size, dB, of hh and vv in all rows; levels are raised to 60 dB below the
// highest of their element, as in deep nulls any change is large.
struct LevelChange {
  double mean_db = 0;                                // of the magnitude
  double largest_db = 0;                             // with its sign
  std::size_t view = 0, frequency = 0, element = 0;  // where; element 0 hh, 1 vv
};

struct ConvergenceStep {
  double size_m = 0;         // smallest patch, of the body with the smallest ones, or distance between rays
  std::size_t segments = 0;  // beam segments traced
  LevelChange change;        // from the step before; zero in the first
};

struct ConvergedSweep {
  RcsResult result;                     // with the last size; its sweep has the result of the step before as `coarser`
  std::vector<ConvergenceStep> series;  // the last one's size is that of the result
  bool converged = false;               // the last change is at most the tolerance
  std::string limit = {};               // why the size was not halved once more; empty otherwise
};

inline constexpr int kMostHalvings = 6;

// Halves a size until no level of the sweep changes by more than tolerance_db > 0, at most kMostHalvings times: by the
// method of beams the smallest patch, from that of the smallest body, which all bodies get; by that of rays the
// distance between them, with the smallest patch of the request, up to the largest number of rays. say() gets a line
// after each step. Throws InputError for a request with cavities, whose walls have no patches of this kind, for one
// that leaves the method open, and what compute_rcs() throws.
ConvergedSweep converge_rcs(const RcsRequest& request, const RcsTarget& target, double tolerance_db, int threads,
                            const StopFlag* stop, const std::function<void(const std::string&)>& say);

// The request with the size of a step.
RcsRequest at_step(RcsRequest request, const ConvergenceStep& step);

// "levels still change by 0.3 dB after 6 halvings of the patches": warning for a sweep that has not converged.
std::string convergence_warning(const RcsRequest& request, const ConvergedSweep& sweep);

// Change of the levels of `fine` from those of `coarse`, models of one sweep.
LevelChange level_change(const RcsSweep& sweep, const RcsSweep::Model& fine, const RcsSweep::Model& coarse);

// The columns of a converged sweep after those of every table, and their values: the level less that with patches of
// twice the side (of larger bodies after one halving: their own), or rays twice as far apart, dB, within -60 and 60.
std::string convergence_header(SolverMethod method);
std::string convergence_cells(const RcsSweep& sweep, std::size_t view, std::size_t frequency);

}  // namespace seaglint
