// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A wave on a stretch of an edge, and the strip of parallel rays that it sends along a face.

#include <array>
#include <cmath>

#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/diffraction/thick_edge.h"
#include "sim/scattering/edges/edge_contribution.h"
#include "sim/scattering/target/sharp_edges.h"

namespace seaglint {

// By how much of itself the thickness of the rims that an edge wave met changes it: to first order the sum over them.
struct ThicknessChange {
  FirstOrderThickness<Complex> change;
  double thickness_m = 0;  // 0: none is a sheet's
};

inline ThicknessChange with_edge(ThicknessChange thickness, const WedgeFrame& wedge, const Vec3& towards) {
  if (wedge.thickness_m <= 0) return thickness;
  const FirstOrderThickness<Complex> more = thick_edge_wave_change(wedge, towards);
  return {{thickness.change.constant + more.constant, thickness.change.logarithm + more.logarithm}, wedge.thickness_m};
}

// A wave on a stretch of an edge. Its path and where the antenna sees it are linear along the stretch.
struct EdgeIncidentWave {
  int edge = kNoEdge;
  std::array<double, 2> s{};    // m from the edge's start
  std::array<double, 2> psi{};  // minus the path, m
  std::array<Vec3, 2> X;        // its gradient
  Vec3 direction;
  std::array<Vec3, 2> E;                     // for h and v
  std::array<Complex, 2> factor{1.0, 1.0};   // of E
  std::array<double, 2> l{};                 // of the edge wave that it is, at the stretch's ends, m
  double departure = 0, first_length_m = 0;  // of the first edge wave, as in EdgeContribution
  ThicknessChange thickness{};               // of sheets, passed before
  int grazing_waves = 0;                     // passed before
  int wall_reflections = 0;                  // that the edge wave was reflected by
  // takes directions after those walls, or after the other wall of a corner, back to before them
  Mat3 unfolding = Mat3::Identity();
  Vec3 previous_direction = Vec3::Zero();  // direction of the wave at the edge before
};

// A strip of parallel rays on a face: u across them, w along.
struct RayStrip {
  Vec3 u, w;
  double from, to;  // in u
};

// Mean of 1/sqrt(l) where l is linear between its ends.
inline double mean_inverse_sqrt_length(const std::array<double, 2>& l) {
  return 2 / (std::sqrt(l[0]) + std::sqrt(l[1]));
}

// The part of it on a part of its stretch, from one share of the way to another.
inline EdgeIncidentWave sub_interval(const EdgeIncidentWave& in, double from, double to) {
  EdgeIncidentWave part = in;
  part.s = {interpolate(in.s, from), interpolate(in.s, to)};
  part.psi = {interpolate(in.psi, from), interpolate(in.psi, to)};
  part.X = {interpolate(in.X, from), interpolate(in.X, to)};
  part.l = {interpolate(in.l, from), interpolate(in.l, to)};
  return part;
}

// A wave that leaves an edge along a face; after an upright wall it comes from the edge's image.
struct GrazingSource {
  const EdgeIncidentWave& in;
  const WedgeFace& face;
  Vec3 start, along;  // of the edge
  std::array<Complex, 2> amplitude;
  double departure = 0;            // transition_parameter() at the edge
  ThicknessChange thickness = {};  // the edge's own with those before
  int wall_reflections = 0;
  Mat3 unfolding = Mat3::Identity();
};

// What a plane with unit normal n makes of directions.
inline Mat3 householder(const Vec3& n) { return Mat3::Identity() - 2 * n * n.transpose(); }

}  // namespace seaglint
