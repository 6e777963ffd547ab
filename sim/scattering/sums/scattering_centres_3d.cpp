// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/scattering_centres_3d.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

// Place of the origin in its cell, as a share of the cell: the golden section, so that neither planes of symmetry nor
// round lengths of a target are sides of cells, where rounding would divide a centre.
constexpr double kCellOrigin = 0.381966;

ScatteringMatrix echo_of(const Point& point, double k) {
  ScatteringMatrix s = point.matrix(0);
  const Complex phase = std::polar(1.0, k * point.psi);
  for (Complex& element : s) element *= phase;
  return s;
}

}  // namespace

double ScatteringCentre3d::peak_rcs() const {
  double max = 0;
  for (const Complex& s : amplitude) max = std::max(max, std::norm(s));
  return 4 * kPi * max;
}

std::vector<ScatteringCentre3d> cluster_centres(std::span<const Point> points, double k, double cell_m) {
  SEAGLINT_CHECK(cell_m > 0, fmt::format("cells of {} m", cell_m));
  using Key = std::array<std::int64_t, 7>;
  struct Cell {
    ScatteringCentre3d centre;
    double weight = 0;
  };
  const auto cell = [&](double x) { return static_cast<std::int64_t>(std::floor(x / (2 * cell_m) + kCellOrigin)); };
  std::map<Key, Cell> cells;
  for (const Point& c : points) {
    const Vec3 g = c.gradient.sum();
    Cell& at = cells[{c.source.part, c.source.bounces, static_cast<std::int64_t>(c.source.mechanism), cell(c.psi),
                      cell(g.x()), cell(g.y()), cell(g.z())}];
    const auto s = echo_of(c, k);
    double weight = 1e-300;
    for (int i = 0; i < 4; ++i) {
      at.centre.amplitude[i] += s[i];
      weight = std::max(weight, std::abs(s[i]));
    }
    at.centre.part = c.source.part;
    at.centre.bounces = c.source.bounces;
    at.centre.mechanism = c.source.mechanism;
    // Weighted running mean, inside the cell.
    at.weight += weight;
    at.centre.psi += (c.psi - at.centre.psi) * (weight / at.weight);
    at.centre.gradient += (g - at.centre.gradient) * (weight / at.weight);
  }
  std::vector<ScatteringCentre3d> centres;
  centres.reserve(cells.size());
  for (const auto& [key, c] : cells) centres.push_back(c.centre);
  std::stable_sort(centres.begin(), centres.end(), [](const ScatteringCentre3d& a, const ScatteringCentre3d& b) {
    return a.peak_rcs() > b.peak_rcs();
  });
  return centres;
}

Matrices facet_contributions(std::span<const Point> points, double k, std::size_t facets) {
  Matrices echoes(facets);
  for (const Point& c : points) {
    SEAGLINT_CHECK(c.source.facet >= 0 && static_cast<std::size_t>(c.source.facet) < facets,
                   fmt::format("facet {} of {}", c.source.facet, facets));
    const auto s = echo_of(c, k);
    for (int i = 0; i < 4; ++i) echoes[static_cast<std::size_t>(c.source.facet)][i] += s[i];
  }
  return echoes;
}

}  // namespace seaglint
