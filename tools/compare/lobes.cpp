// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/lobes.h"

#include <algorithm>
#include <cmath>

namespace seaglint {
namespace {

constexpr double kLeast_db = 3;  // between a lobe and the nulls beside it

// The vertex of the parabola through three points; the middle one where they are on a line.
Extremum vertex(std::span<const double> x, std::span<const double> y, std::size_t i) {
  const double a = x[i - 1] - x[i], b = x[i + 1] - x[i], u = y[i - 1] - y[i], v = y[i + 1] - y[i];
  const double square = (u / a - v / b) / (a - b), slope = u / a - square * a;
  if (square == 0) return {x[i], y[i]};
  const double at = std::clamp(-slope / (2 * square), a, b);
  return {x[i] + at, y[i] + at * (slope + square * at)};
}

// Indices of alternating maxima and minima that differ by at least kLeast_db.
std::vector<std::size_t> turning_points(std::span<const double> y) {
  std::vector<std::size_t> points;
  if (y.size() < 3) return points;
  std::size_t highest = 0, lowest = 0;
  int direction = 0;  // of the last confirmed change
  for (std::size_t i = 1; i < y.size(); ++i) {
    if (y[i] > y[highest]) highest = i;
    if (y[i] < y[lowest]) lowest = i;
    if (direction >= 0 && y[highest] - y[i] >= kLeast_db) {
      points.push_back(highest);
      direction = -1;
      lowest = highest = i;
    } else if (direction <= 0 && y[i] - y[lowest] >= kLeast_db) {
      points.push_back(lowest);
      direction = 1;
      lowest = highest = i;
    }
  }
  return points;
}

std::vector<Extremum> extrema(std::span<const double> x, std::span<const double> y, double lowest_db, double sign) {
  std::vector<Extremum> found;
  for (const std::size_t i : turning_points(y)) {
    if (i == 0 || i + 1 == y.size() || y[i] < lowest_db) continue;
    if (sign * (2 * y[i] - y[i - 1] - y[i + 1]) <= 0) continue;
    found.push_back(vertex(x, y, i));
  }
  return found;
}

std::size_t nearest(std::span<const Extremum> extrema, double x) {
  const auto place = std::min_element(extrema.begin(), extrema.end(), [x](const Extremum& a, const Extremum& b) {
    return std::abs(a.x - x) < std::abs(b.x - x);
  });
  return static_cast<std::size_t>(place - extrema.begin());
}

}  // namespace

std::vector<Extremum> lobes_of(std::span<const double> x, std::span<const double> level_db, double lowest_db) {
  return extrema(x, level_db, lowest_db, 1);
}

std::vector<Extremum> nulls_of(std::span<const double> x, std::span<const double> level_db, double lowest_db) {
  return extrema(x, level_db, lowest_db, -1);
}

ExtremumPairs paired_extrema(std::span<const Extremum> reference, std::span<const Extremum> other) {
  ExtremumPairs pairs;
  pairs.count = reference.size();
  for (std::size_t i = 0; i < reference.size() && !other.empty(); ++i) {
    const Extremum& close = other[nearest(other, reference[i].x)];
    if (nearest(reference, close.x) != i) continue;
    ++pairs.paired;
    pairs.mean_shift += std::abs(close.x - reference[i].x);
    pairs.mean_db += std::abs(close.level_db - reference[i].level_db);
  }
  if (pairs.paired == 0) return pairs;
  pairs.mean_shift /= static_cast<double>(pairs.paired);
  pairs.mean_db /= static_cast<double>(pairs.paired);
  return pairs;
}

}  // namespace seaglint
