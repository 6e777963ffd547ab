// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Observation of a target by one or two antennas: look directions, range, phase origin and reciprocity.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

// hh, hv, vh, vv (received, transmitted): a scattering matrix in m, or a pattern to which one is proportional.
using ScatteringMatrix = std::array<Complex, 4>;
using Matrices = std::vector<ScatteringMatrix>;  // per frequency

inline void add_to(ScatteringMatrix& sum, const ScatteringMatrix& term) {
  for (std::size_t i = 0; i < 4; ++i) sum[i] += term[i];
}

// Look directions of transmitter and receiver.
struct BistaticGeometry {
  RadarBasis transmit;
  RadarBasis receive;
  bool monostatic = true;  // receive equals transmit
};
BistaticGeometry monostatic(const RadarBasis& basis);
BistaticGeometry bistatic(const RadarBasis& transmit, const RadarBasis& receive);

// Path gradient, m: d psi = transmit . d r^_t + receive . d r^_s, or their sum for one common direction. For a
// body-fixed point these are its positions, in image space for the transmitter and in real space for the receiver
// (Fermat). The motion of a sliding point on the body adds to them.
struct PathGradient {
  Vec3 transmit = Vec3::Zero();
  Vec3 receive = Vec3::Zero();
  Vec3 transmit_slide = Vec3::Zero(), receive_slide = Vec3::Zero();  // part of them due to sliding

  Vec3 sum() const { return transmit + receive; }
};

// Linear interpolation from a (s = 0) to b (s = 1).
PathGradient interpolate(const PathGradient& a, const PathGradient& b, double s);

// Distance of the radar, for the curvature of the wavefront.
struct RadarRange {
  double range_m = 0;  // 0: plane wave; else at least ten times the target's radius about the point it refers to
  Vec3 origin = Vec3::Zero();  // of the target's coordinates, relative to that point, m
};

// Reciprocity: S(a, b) = S(b, a)^T, received along a and transmitted along b; for one antenna hv = vh. Geometrical
// optics carries a wave from panel to panel and physical optics radiates it, so that the sum of the beams is reciprocal
// to their accuracy only (solver/README.md, "Reciprocity"). The mean of a matrix and of its transpose is the orthogonal
// projection on reciprocal matrices: its squared error over the elements is that of the matrix less |hv - vh|^2 / 2.
enum class PathSense {
  kMean,       // one antenna: the mean of both senses of every path; two antennas: as kOneWay
  kOneWay,     // from the transmitter, as traced
  kExchanged,  // the reciprocal paths, of which transmitter and receiver are exchanged
};

// How contributions are observed. Their coordinates are relative to the scatterer's centre.
struct Observation {
  BistaticGeometry antennas;    // look directions that are traced
  RadarRange radar = {};        // origin: the scatterer's centre relative to the point of the range
  double direction_spread = 0;  // direction_spread() of the radar, rad
  Vec3 centre = Vec3::Zero();   // the scatterer's centre relative to the phase origin, m
  PathSense sense = PathSense::kMean;
  double weight = 1;  // factor of all amplitudes
};

// Observation of a body at rest with the phase referred to the body's origin. radar.origin: of the body's frame. Throws
// InputError when the range is below ten times the reach of the target from the point of the range.
Observation observation_of(const Scatterer& scatterer, const BistaticGeometry& antennas, const RadarRange& radar = {});

// Largest difference of the direction to the radar over the target, rad; 0 in the far field. radar.origin: the
// scatterer's centre. Throws InputError as check_wavefront_range().
double direction_spread(const Scatterer& scatterer, const RadarRange& radar);

// Throws InputError where the wavefront range (m; 0: plane wave) is less than ten times the reach of the target from
// the point of the range: beyond that the third-order term of the wavefront is below a tenth of the second-order one.
void check_wavefront_range(double reach_m, double range_m);

// Index of the pair with the antennas of the pair i exchanged, itself for one antenna; none where it is not among them.
std::optional<std::size_t> exchanged_pair(std::span<const BistaticGeometry> pairs, std::size_t i);

// Mean of a matrix hh, hv, vh, vv and the transposed one of exchanged antennas.
ScatteringMatrix reciprocal_mean(const ScatteringMatrix& matrix, const ScatteringMatrix& exchanged);

}  // namespace seaglint
