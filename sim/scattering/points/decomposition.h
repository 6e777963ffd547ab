// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Points: parts of a contribution whose amplitudes are frozen over a band and an aspect change,
//     S(k, r^ + d) = amplitude(k) pattern(k) e^{jk (psi + gradient . d)},
// and the decomposition of a contribution into them. A closed form may not be frozen while its phase changes by cycles;
// its end-point contributions may (radiation/README.md).

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/radiation/contribution.h"

namespace seaglint {

// Where points hold: the nodes of a band, the first of which is the wavenumber `first_node` of the contribution's
// patterns, and a change of the look direction.
struct PointBand {
  FrequencyBand band;
  std::size_t first_node = 0;
  double aspect_change_rad = 0;  // largest change of the look direction from the traced one, 0 <= x < 0.1
  // Half of a band about a single node, rad/m: amplitudes are frozen, patterns change linearly, by the nodes before and
  // after it. 0: the node alone.
  double half_band = 0;

  // The node and the traced direction alone, where closed forms hold.
  bool is_single() const { return band.nodes().size() == 1 && aspect_change_rad <= 0 && half_band <= 0; }
  // The wavenumber that determines the form of a decomposition: in a sweep that of the band's FormRange, so that a
  // frequency has the same points alone and within any sweep; of frozen amplitudes the node.
  double form_k() const { return band.nodes().size() > 1 || is_single() ? band.form().centre() : band.nodes().front(); }
};

struct Point {
  BandValues amplitude{};                     // at the nodes, of unit pattern, without the phase e^{jk psi}, m
  double psi = 0;                             // minus the two-way path, m
  PathGradient gradient;                      // d psi / d r^, body frame, m
  ScatteringMatrix pattern{};                 // at all nodes, as traced
  std::span<const ScatteringMatrix> at_node;  // where not empty in its place: at each node, of the contribution
  PathSense sense = PathSense::kOneWay;       // kMean: of one antenna
  ContributionSource source;

  const ScatteringMatrix& traced_pattern(std::size_t node) const { return at_node.empty() ? pattern : at_node[node]; }
  // In the sense of the point, element i of hh, hv, vh, vv.
  Complex pattern_at(std::size_t node, std::size_t i) const {
    constexpr std::array<std::size_t, 4> kTransposed{0, 2, 1, 3};
    const ScatteringMatrix& traced = traced_pattern(node);
    if (sense == PathSense::kOneWay) return traced[i];
    const Complex& back = traced[kTransposed[i]];
    return sense == PathSense::kExchanged ? back : 0.5 * (traced[i] + back);
  }
  // Without the phase, m.
  ScatteringMatrix matrix(std::size_t node) const {
    ScatteringMatrix value;
    for (std::size_t i = 0; i < 4; ++i) value[i] = amplitude[node] * pattern_at(node, i);
    return value;
  }
};

// Sum of the points at their first node, of wavenumber k, for a change `turn` of both look directions: the direct sum,
// for tests and for few points.
ScatteringMatrix direct_sum(std::span<const Point> points, double k, const Vec3& turn = Vec3::Zero());

// Appends the points of a contribution, about the phase origin of the observation. At the nodes and the traced
// direction the sum of amplitude pattern e^{jk psi} is the contribution to rounding, elsewhere amplitudes are frozen.
// Let u be the aspect change times the change of psi's slope along the panel or the edge: an area is replaced by its
// sides where that slope exceeds u / kMaxAmplitudeError, a side or an edge by its end points where its own slope does;
// otherwise they are divided into pieces whose own phase stays below kMaxHalfPhase. The relative error is at most
// kMaxAmplitudeError per end point, and |k / k_node - 1| beyond the nodes of a band. At a single node and direction a
// flat footprint or an interval is one point.
//
// Reciprocity and the curvature of the wavefront enter here. At a finite range each path is longer by |x_perp|^2 / (2
// R), x measured from the point that the range refers to (CONVENTIONS.md, "Plane waves"). Its first order about a
// footprint's centroid tilts the phase and decides with it on the form; its second order is a change of aspect by the
// footprint's extent over R. The slide of a shadow boundary along the curved front is neglected.
void decompose(const Contribution& contribution, const Observation& observation, const PointBand& at,
               std::vector<Point>& out);

// The contribution at the wavenumber k, the node of its patterns `node`: the sum of its points there.
ScatteringMatrix scattered(const Contribution& contribution, const Observation& observation, double k,
                           std::size_t node = 0);

// False where the amplitude law oscillates over the band, so that its nodes do not determine it.
bool varies_slowly(const Contribution& contribution, const FrequencyBand& band);

}  // namespace seaglint
