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
struct RowOfRims {
  OfThickness<Complex> change;
  double thickness_m = 0;  // 0: none is a sheet's
};

inline RowOfRims with_rim(RowOfRims rims, const WedgeFrame& wedge, const Vec3& towards) {
  if (wedge.thickness_m <= 0) return rims;
  const OfThickness<Complex> more = thick_rim_wave(wedge, towards);
  return {{rims.change.constant + more.constant, rims.change.logarithm + more.logarithm}, wedge.thickness_m};
}

// A wave on a stretch of an edge. Its path and where the antenna sees it are linear along the stretch.
struct Incident {
  int edge = kNoEdge;
  std::array<double, 2> s{};    // m from the edge's start
  std::array<double, 2> psi{};  // minus the path, m
  std::array<Vec3, 2> X;        // its gradient
  Vec3 direction;
  std::array<Vec3, 2> E;                    // for h and v
  std::array<Complex, 2> factor{1.0, 1.0};  // of E
  std::array<double, 2> l{};                // of the edge wave that it is, at the stretch's ends, m
  double departure = 0, first_m = 0;        // of the first edge wave, as in EdgeFootprint
  RowOfRims rims{};                         // of sheets, passed before
  int waves = 0;                            // passed before
  int walls = 0;                            // that the edge wave was reflected by
  // takes directions after those walls, or after the other wall of a corner, back to before them
  Mat3 unfolded = Mat3::Identity();
  Vec3 before = Vec3::Zero();  // direction of the wave at the edge before
};

// A strip of parallel rays on a face: u across them, w along.
struct Strip {
  Vec3 u, w;
  double from, to;  // in u
};

// Mean of 1/sqrt(l) where l is linear between its ends.
inline double mean_decay(const std::array<double, 2>& l) { return 2 / (std::sqrt(l[0]) + std::sqrt(l[1])); }

// The part of it on a part of its stretch, from one share of the way to another.
inline Incident part_of(const Incident& in, double from, double to) {
  Incident part = in;
  part.s = {at_share(in.s, from), at_share(in.s, to)};
  part.psi = {at_share(in.psi, from), at_share(in.psi, to)};
  part.X = {at_share(in.X, from), at_share(in.X, to)};
  part.l = {at_share(in.l, from), at_share(in.l, to)};
  return part;
}

// A wave that leaves an edge along a face; after an upright wall it comes from the edge's image.
struct Source {
  const Incident& in;
  const WedgeFace& face;
  Vec3 start, along;  // of the edge
  std::array<Complex, 2> amplitude;
  double departure = 0;  // shadow_distance() at the edge
  RowOfRims rims = {};   // the edge's own with those before
  int walls = 0;
  Mat3 unfolded = Mat3::Identity();
};

// What a plane with unit normal n makes of directions.
inline Mat3 mirror_of(const Vec3& n) { return Mat3::Identity() - 2 * n * n.transpose(); }

}  // namespace seaglint
