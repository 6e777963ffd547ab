// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/float/tether.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// Ropes of a line: rope k joins the points k and k + 1.
struct Ropes {
  std::vector<Vec2> direction;   // n, from point k to point k + 1, unit vectors
  std::vector<double> length_m;  // distances of the ends
};

Ropes ropes_between(std::span<const Vec2> places) {
  Ropes ropes;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const Vec2 span = places[k + 1] - places[k];
    ropes.length_m.push_back(span.norm());
    ropes.direction.push_back(ropes.length_m.back() > 0 ? span / ropes.length_m.back() : Vec2::UnitX());
  }
  return ropes;
}

// Solves 2 x_k - n_{k-1}.n_k x_{k-1} - n_k.n_{k+1} x_{k+1} = c_k of the pulling ropes, x = 0 of the others, by
// elimination. The matrix is diagonally dominant.
std::vector<double> forces_of(const std::vector<Vec2>& n, const std::vector<double>& c,
                              const std::vector<char>& pulls) {
  const std::size_t count = n.size();
  const auto coupling = [&](std::size_t k) {  // of k and k + 1
    return k + 1 < count && pulls[k] && pulls[k + 1] ? -n[k].dot(n[k + 1]) : 0.0;
  };
  std::vector<double> ratio(count), x(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (!pulls[k]) continue;
    const double before = k > 0 ? coupling(k - 1) : 0, pivot = 2 - (k > 0 ? before * ratio[k - 1] : 0);
    ratio[k] = coupling(k) / pivot;
    x[k] = (c[k] - (k > 0 ? before * x[k - 1] : 0)) / pivot;
  }
  for (std::size_t k = count; k-- > 0;)
    if (k + 1 < count) x[k] -= ratio[k] * x[k + 1];
  return x;
}

// Lagrange multipliers x of the least squares problem: the smallest sum of |d_i|^2 with n_k.(d_{k+1} - d_k) + c_k <= 0
// for every rope that may pull. With d_k = x_k n_k - x_{k-1} n_{k-1} it has x >= 0, A x - c >= 0, and one of both is 0,
// where A is the matrix of forces_of(). Primal-dual active set: rope k pulls if x_k > (A x - c)_k (Hintermueller, Ito
// and Kunisch, SIAM J. Optim. 13 (2003) 865, section 2).
std::vector<double> rope_forces(const std::vector<Vec2>& n, const std::vector<double>& c,
                                const std::vector<char>& may_pull) {
  const std::size_t count = n.size();
  std::vector<char> pulls(count, 0);
  std::vector<double> x(count, 0.0);
  const auto residual = [&](std::size_t k) {  // (A x - c)_k
    return 2 * x[k] - (k > 0 ? n[k - 1].dot(n[k]) * x[k - 1] : 0) -
           (k + 1 < count ? n[k].dot(n[k + 1]) * x[k + 1] : 0) - c[k];
  };
  for (std::size_t pass = 0; pass < 2 * count + 2; ++pass) {
    std::vector<char> next(count, 0);
    for (std::size_t k = 0; k < count; ++k) {
      // The residual of a pulling rope and the force of another are 0 but for rounding.
      const double excess = pulls[k] ? x[k] : -residual(k);
      next[k] = may_pull[k] && excess > 0;
    }
    if (next == pulls) break;
    pulls = next;
    x = forces_of(n, c, pulls);
  }
  for (double& force : x) force = std::max(force, 0.0);
  return x;
}

// Adds x_k n_k - x_{k-1} n_{k-1} to every vector.
void pull(const std::vector<Vec2>& n, const std::vector<double>& x, std::span<Vec2> of_points) {
  for (std::size_t k = 0; k < n.size(); ++k) {
    if (x[k] == 0) continue;
    of_points[k] += x[k] * n[k];
    of_points[k + 1] -= x[k] * n[k];
  }
}

}  // namespace

void hold_places(std::span<Vec2> places, double length_m) {
  // Newton's method: a pass leaves the square of the displacement across the rope over twice its length.
  constexpr int kMostPasses = 50;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const Ropes ropes = ropes_between(places);
    std::vector<double> excess_m;
    for (const double distance_m : ropes.length_m) excess_m.push_back(distance_m - length_m);
    if (std::ranges::all_of(excess_m, [](double excess) { return excess <= kRopeExcess_m; })) return;
    pull(ropes.direction, rope_forces(ropes.direction, excess_m, std::vector<char>(excess_m.size(), 1)), places);
  }
}

void hold_velocities(std::span<const Vec2> places, double length_m, std::span<Vec2> velocities) {
  SEAGLINT_CHECK(places.size() == velocities.size(), "a velocity of every float");
  const Ropes ropes = ropes_between(places);
  std::vector<double> rate;
  std::vector<char> is_taut;
  for (std::size_t k = 0; k < ropes.direction.size(); ++k) {
    rate.push_back(ropes.direction[k].dot(velocities[k + 1] - velocities[k]));
    is_taut.push_back(ropes.length_m[k] >= length_m - kTaut_m);
  }
  pull(ropes.direction, rope_forces(ropes.direction, rate, is_taut), velocities);
}

}  // namespace seaglint
