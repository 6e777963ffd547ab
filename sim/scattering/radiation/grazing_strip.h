// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A wave on an interval of an edge, and the strip of parallel rays that it launches along a face.

#include <array>
#include <cmath>

#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/coefficients/thick_edge.h"
#include "sim/scattering/coefficients/grazing_wave_amplitude.h"
#include "sim/scattering/scatterer/sharp_edges.h"

namespace seaglint {

// Relative first-order change of a grazing wave by the thickness of the sheets whose edges it met: the sum over these
// edges.
struct ThicknessChange {
  FirstOrderThickness<Complex> change;
  double thickness_m = 0;  // 0: no sheet has a thickness
};

inline ThicknessChange with_edge(ThicknessChange thickness, const WedgeFrame& wedge, const Vec3& towards) {
  if (wedge.thickness_m <= 0) return thickness;
  const FirstOrderThickness<Complex> more = thick_edge_wave_change(wedge, towards);
  return {{thickness.change.constant + more.constant, thickness.change.logarithm + more.logarithm}, wedge.thickness_m};
}

// A wave incident on an interval of an edge. psi and its gradient are linear along the interval.
struct EdgeIncidentWave {
  int edge = kNoEdge;
  std::array<double, 2> s{};    // m from the edge's start
  std::array<double, 2> psi{};  // minus the path so far, m
  std::array<Vec3, 2> X;        // gradient of psi with the transmit direction, m
  Vec3 direction;
  std::array<Vec3, 2> E;                                // for transmitted h and v
  std::array<Complex, 2> factor{1.0, 1.0};              // of E
  std::array<double, 2> l{};                            // length of this grazing wave at the ends of the interval, m
  double departure = 0;                                 // transition_parameter() where it starts
  std::array<double, kMaxGrazingWaves - 1> detour_m{};  // GrazingWaveAmplitude::detour_m
  ThicknessChange thickness{};                          // of the edges met before
  int grazing_waves = 0;                                // along the face, before
  int wall_reflections = 0;                             // of this grazing wave at perpendicular walls
  // maps directions behind those walls, or behind the other wall of a concave edge, to image space
  Mat3 unfolding = Mat3::Identity();
  Vec3 previous_direction = Vec3::Zero();  // of the wave at the previous edge
  bool met_concave_edge = false;           // among the edges before
};

// A strip of parallel rays on a face: u transverse, w along the rays, both unit vectors in the face.
struct RayStrip {
  Vec3 u, w;
  double from, to;  // in u, m
};

// Mean of 1/sqrt(l) for l linear between its ends.
inline double mean_inverse_sqrt_length(const std::array<double, 2>& l) {
  return 2 / (std::sqrt(l[0]) + std::sqrt(l[1]));
}

// The wave on a part of its interval, fractions `from` to `to`.
inline EdgeIncidentWave sub_interval(const EdgeIncidentWave& in, double from, double to) {
  EdgeIncidentWave part = in;
  part.s = {interpolate(in.s, from), interpolate(in.s, to)};
  part.psi = {interpolate(in.psi, from), interpolate(in.psi, to)};
  part.X = {interpolate(in.X, from), interpolate(in.X, to)};
  part.l = {interpolate(in.l, from), interpolate(in.l, to)};
  return part;
}

// A grazing wave where it leaves an edge along a face; after a perpendicular wall it leaves the edge's image.
struct GrazingSource {
  const EdgeIncidentWave& in;
  const WedgeFace& face;
  Vec3 start, along;  // of the edge
  std::array<Complex, 2> amplitude;
  double departure = 0;            // transition_parameter() at the edge
  ThicknessChange thickness = {};  // including the edge's own
  int wall_reflections = 0;
  Mat3 unfolding = Mat3::Identity();
  bool met_concave_edge = false;  // including the edge it leaves
};

// Reflection of directions in a plane with unit normal n.
inline Mat3 householder(const Vec3& n) { return Mat3::Identity() - outer_product(2 * n, n); }

}  // namespace seaglint
