// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Point: a part of a contribution whose amplitude is frozen over a band and an aspect change,
//     S(k, r^ + d) = amplitude(k) pattern(k) e^{jk (psi + gradient . d)}.

#include <array>
#include <cstddef>
#include <span>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/radiation/contribution.h"

namespace seaglint {

// Relative error of a frozen amplitude per end point, -28 dB; the error of a sum over many is far smaller.
inline constexpr double kMaxAmplitudeError = 0.04;
// Phase from its middle up to which a piece may be one point.
inline constexpr double kMaxHalfPhase = 0.5;  // rad

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
};

struct Point {
  BandValues amplitude{};                      // at the nodes, of unit pattern, without the phase e^{jk psi}, m
  double psi = 0;                              // minus the two-way path, m
  PathGradient gradient;                       // d psi / d r^, body frame, m
  ScatteringMatrix pattern{};                  // at all nodes, as traced
  std::span<const ScatteringMatrix> at_node;   // where not empty in its place: at each node, of the contribution
  PathSense sense = PathSense::kOneWay;        // kMean: of one antenna
  ContributionSource source;

  const ScatteringMatrix& traced_pattern(std::size_t node) const { return at_node.empty() ? pattern : at_node[node]; }
  // In the sense of the point.
  ScatteringMatrix pattern_at(std::size_t node) const {
    const ScatteringMatrix& traced = traced_pattern(node);
    if (sense == PathSense::kOneWay) return traced;
    if (sense == PathSense::kMean) return reciprocal_mean(traced, traced);
    return {traced[0], traced[2], traced[1], traced[3]};
  }
  // Without the phase, m.
  ScatteringMatrix matrix(std::size_t node) const {
    ScatteringMatrix value = pattern_at(node);
    for (Complex& element : value) element *= amplitude[node];
    return value;
  }
};

// Sum of the points at their first node, of wavenumber k, for a change `turn` of both look directions: the direct sum,
// for tests and for few points.
ScatteringMatrix direct_sum(std::span<const Point> points, double k, const Vec3& turn = Vec3::Zero());

}  // namespace seaglint
