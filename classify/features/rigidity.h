// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Test of rigidity: how well the ranges and range rates of tracks over looks fit one rigid body, in units of their
// standard errors. It needs no training. The body has points s_j in body axes, attitude R_k and angular velocity w_k at
// look k; r^ is the direction to the radar:
//   b_k  = R_k^T r^               direction to the radar in body axes
//   a_k  = R_k^T (r^ x w_k)       its rate db_k/dt, perpendicular to b_k
//   r_kj = rho_k - s_j . b_k      range
//   v_kj = nu_k  - s_j . a_k      range rate
// rho_k and nu_k belong to the origin of body axes. Free reflectors have no common a_k and b_k.

#include <cstddef>
#include <vector>

#include "classify/features/tracks.h"
#include "sim/core/numbers/linear.h"

namespace seaglint {

// Sum of squared residuals over standard errors, with its degrees of freedom: measured values less free parameters.
struct ChiSquare {
  double value = 0;
  int degrees = 0;  // 0: no test, the parameters fit every measurement

  bool defined() const { return degrees > 0; }
  // Mean 1 for a body of the model; 0 where not defined.
  double ratio() const;
  // Probability that a body of the model exceeds `value`: Q(degrees / 2, value / 2), Q the regularised upper incomplete
  // gamma function (Abramowitz and Stegun 1964, eq. 26.4.19); 1 where not defined.
  double p_value() const;
};

// Range rates of all tracks against a matrix of this rank, 0 to 3, beside a common rate:
//   v_kj = nu_k + sum_p a_kp s_jp,  p = 1..rank
// by weighted least squares over the entries that are seen (principal components of data with gaps: Wiberg 1976). A
// rigid body has rank 3 at most. It has rank 2 while it turns by a few degrees in all: a_k is then across one b. It has
// rank 1 where its points lie on a line. Free reflectors have no bound.
//   degrees = entries - looks (1 + rank) - tracks rank + rank^2 + rank
// The last two terms: a linear map of s with the inverse of a, and a shift of s with nu, change no velocity. Looks with
// fewer than rank + 2 entries and tracks with fewer than rank + 1 fit exactly and are left out of all counts; the rest
// overlap, as tracks do that are seen in half of the looks. Below the true rank the ratio exceeds 1; above it the
// factors fit the largest errors and the ratio is below 1.
ChiSquare rank_test(const TrackSet& set, int rank);

// kHuber: weights min(1, 2 errors / |residual|), so that few wrong entries do not pull the fit (Huber 1964).
enum class FitWeights { kErrors, kHuber };

struct VelocityResidual {
  std::size_t look = 0, track = 0;
  double value_mps = 0;  // measured less fitted
};

// Residuals of the fit of rank_test(), of the entries that count in it, by track and then by look. Rank 0: velocities
// about the common ones.
std::vector<VelocityResidual> rank_residuals(const TrackSet& set, int rank, FitWeights weights = FitWeights::kErrors);

// Ranges and range rates of all tracks against one rigid body; body coordinates of its points.
struct RigidBody {
  ChiSquare test;
  std::vector<Vec3> points_m;  // s_j of each track, mean 0, in axes of the fit, perhaps mirrored; NaN: left out
};

// Levenberg and Marquardt's method (Marquardt 1963) on rho_k, nu_k, unit b_k, a_k across b_k, s_j. It starts from the
// factor of rank 3 of ranges and rates (Tomasi and Kanade 1992) with the metric that makes b_k unit and a_k
// perpendicular to it, and from three of given extent across the line of sight; the smallest sum counts.
//   degrees = 2 entries - 6 looks - 3 tracks + 6
// Per look: rho, nu, two angles of b, two components of a. Per track: s. A rotation of body axes (3) and a shift of
// their origin (3, with rho and nu) change no measurement. Looks with fewer than 4 entries and tracks with fewer than 2
// fit exactly and are left out of all counts; the test needs three looks of the rest. Where the body turns so little,
// or is so flat, that a coordinate lies below its error, the ratio is below 1: the test errs towards rigid.
RigidBody fit_rigid_body(const TrackSet& set);

}  // namespace seaglint
