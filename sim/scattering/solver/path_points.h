// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Contributions of a trace as the points of an interval's response.

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "sim/scattering/observation/look_direction_path.h"
#include "sim/scattering/points/edge_decomposition.h"
#include "sim/scattering/points/finite_range.h"
#include "sim/scattering/points/point_contributions.h"
#include "sim/scattering/radiation/edge_contribution.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/sums/reciprocity.h"
#include "sim/scattering/sums/response_grid.h"

namespace seaglint {

// Which points of a trace are kept, and how contributions decompose into them.
struct PointSelection {
  DecompositionSettings split;
  double half_band = 0;  // rad/m
  double faint = 0;      // half of all points, mostly tapered or cancelling end points, are weaker, m
  int channel = 0;       // index of the polarisation
  double range_m = 0;    // for the curvature of the wavefront; 0: none
  // A shadow boundary at grazing incidence slides along its facet much faster than any point of the body. Its rate is
  // limited to that of a point at four radii: such end points are weak and cross many velocity cells.
  double slide_limit = 0;  // m

  // Of one polarisation; for one antenna the mean of both senses (reciprocity.h), m.
  Complex amplitude(const PointContribution& point, bool monostatic) const {
    const auto pattern = monostatic ? reciprocal_mean(point.pattern, point.pattern) : point.pattern;
    return point.amplitude * Complex(pattern[static_cast<std::size_t>(channel)]);
  }
  bool is_faint(const Complex& amplitude) const { return std::norm(amplitude) < faint * faint; }
  // Factor of the path rates that keeps them within slide_limit.
  double limit(const PathGradient& gradient) const { return std::min(1.0, slide_limit / gradient.sum().norm()); }
};

inline double slide_limit_m(const Scatterer& scatterer) { return 8 * scatterer.radius(); }

// Cross-track path rate of body-fixed points is at most this, m, for a track tangent of unit length. Contributions of
// shadow boundaries that exceed it are weak.
inline double cross_track_limit_m(const Scatterer& scatterer) { return std::numbers::sqrt2 * scatterer.radius(); }

// Decompositions of one contribution into points, appended.
void append_points(const Footprint& footprint, const BistaticGeometry& traced, const PointSelection& selection,
                   std::vector<PointContribution>& out);
void append_points(const EdgeContribution& contribution, const BistaticGeometry& traced,
                   const PointSelection& selection, std::vector<PointContribution>& out);

// Calls visit(PointContribution&) for the points of footprints or edge contributions, in their order. At a finite range
// the wavefront is curved about the body's centre, from which the look directions are measured.
template <class Contributions, class Visit>
void for_each_point(const Contributions& contributions, const BistaticGeometry& traced, const PointSelection& selection,
                    const Visit& visit) {
  std::vector<PointContribution> points;
  for (const auto& contribution : contributions) {
    points.clear();
    append_points(contribution, traced, selection, points);
    if (selection.range_m > 0) apply_wavefront_curvature(points, traced, {selection.range_m});
    for (PointContribution& point : points) visit(point);
  }
}

// Points of one chunk of panels or edges, aligned to cache lines: threads fill neighbouring chunks concurrently.
struct alignas(64) ChunkPoints {
  std::vector<GridPoint> points;
};

// Points are spread on this many grids for any number of threads, each for every fourth chunk; they are added in order.
inline constexpr std::size_t kGrids = 4;

// Sum of the points over the band and the look directions of a path; beside_m: largest path rate across the track.
ResponseGrid grid_of_points(std::span<const ChunkPoints> chunks, const LookDirectionPath& path,
                            const WavenumberGrid& wavenumbers, double beside_m, int threads);

}  // namespace seaglint
