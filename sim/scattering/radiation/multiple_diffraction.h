// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Multiple diffraction: a sharp edge launches a hard-polarised diffracted wave along a flat face; the wave grazes to
// the other edges of the face and is diffracted again, up to four times in all (J. B. Keller, J. Opt. Soc. Am. 52
// (1962) 116-130). PO and single fringe currents lack this field on plates of a few wavelengths. It cancels the field
// of the first edge where the echo of a sheet must vanish, as for an incident E normal to a sheet in its own plane. A
// wall perpendicular to the face reflects the wave back along it, as in corner reflectors.

#include <array>
#include <span>
#include <vector>

#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/edge_illumination.h"

namespace seaglint {

struct MultipleDiffractionLimits {
  // Minimum length of straight runs of edges for double diffraction, and for orders three and four, m.
  double min_run_m = 0, min_run_high_order_m = 0;
  double min_amplitude_m = 0;  // contributions that cannot reach this amplitude are omitted, evaluated at k
  double k = 1;                // 1/m
};

// Scene of the grazing waves of one observation.
struct GrazingWaves {
  const Scatterer& scatterer;
  const BistaticGeometry& geometry;
  std::span<const double> wavenumbers;  // of the patterns of thick sheets
  const IlluminationByEdge& outgoing;   // intervals of last edges, by a wave from the receiver
  MultipleDiffractionLimits limits;
};

// Appends the contributions transmitter - first edge - face - second edge (- face - third edge ...) - receiver, for all
// intervals of first edges in `incoming` and of last edges in the scene. The strip of grazing rays is followed across
// coplanar facets and via up to two perpendicular walls to the next edge; it ends at edges that are not sharp. Concave
// edges launch and relaunch waves too, because PO has no transition region where a wave reflected by one wall grazes
// the other; for one antenna such a double diffraction includes its reciprocal, which ends at the concave edge. Fields
// decay as 1/sqrt(k l) with the distance l between two edges; at the later edge half of the field is the incident
// field.
void trace_multiple_diffraction(const GrazingWaves& scene, EdgeIlluminations incoming,
                                std::vector<Contribution>& contributions);

// Wall in the penumbra of a face edge: a wall perpendicular to a face at near-grazing incidence, behind the edge of the
// face, such as a deckhouse on a deck at low elevation, or a corner reflector observed along an arm.
//
// Let l be the distance from the edge to the wall, a the grazing angle over the face, s = sin a and b = l tan a. PO
// illuminates the wall fully by the direct wave and a second time by the face-reflected wave up to z = b; for incidence
// from below the face, only above the shadow-boundary line z = |b|. Within (lambda l)^(1/2) of the face both fields
// follow the half-plane (A. Sommerfeld; M. Born and E. Wolf, Principles of Optics, 8.7): F(z) = erfc(-c (z + b)) / 2
// for the direct wave, c = e^{j pi/4} (k / 2l)^(1/2), and F(-z) with -b for its image in the face. By reciprocity the
// response, soft and hard (-, +), is the integral over the wall of
//
//     [e^{jkzs} F(z) -+ e^{-jkzs} F(-z)]^2
//
// which has a closed form for a wall higher than the penumbra. By parts the squares leave error functions F(w), w^2 =
// jx, x = k l s^2, at the foot; the product, a convolution of two of them, leaves (l / pi k)^(1/2) e^{-j pi/4} e^{-jx}
// (1 - F(x)) in addition to the b of PO, F(x) the transition function (amplitude_laws.h). With erfc(w) = e^{-jx} F(x) /
// (pi j x)^(1/2), the correction to PO (without its rays that both arrive and leave via the face) is, per metre of wall
// and -jk / 2 pi,
//
//     via the edge and its image in the wall     -1 / (2jks)         a > 0, at the phase of the foot
//     at the edge's shadow-boundary line         e^{-2jx} / (2jks)   a < 0: cancels the end-point contribution of PO
//     from the edge to the wall and back         (l / pi k)^(1/2) e^{-j pi/4} e^{-jx} [F(x) / (2jx) -+ (1 - F(x))]
//
// whose singularities at a = 0 cancel. Where the image of the wall in the face radiates up to z = b
// (image_weight()), it already contributes (1 - e^{-2jx}) / (2jks): a second -1 / (2jks) is then added at the
// foot, and e^{-2jx} / (2jks) at the line for a > 0 too. The third term is, hard, the face-grazing diffracted wave that
// the wall reflects (multiple_diffraction.h). Soft it decays faster than multiple diffraction, but at grazing it is
// equally large: the sum is -2 (l / pi k)^(1/2) e^{-j pi/4}, by which the height of a wall on a face of length l is
// effectively reduced; hard the sum vanishes. Away from grazing the first term is the -1 / (4 pi sin a) of
// edge_diffraction.h; tapers connect the two.

// A face that ends at an edge, and a wall perpendicular to it; all normals are unit vectors.
struct WallBehindEdge {
  Vec3 edge_point, edge_direction;  // a point and the unit direction of the edge
  Vec3 face_normal;                 // on the illuminated side
  Vec3 wall_normal;                 // towards the edge
  double height = 0;         // of the wall, m; the terms are tapered to zero for a wall no higher than the penumbra
  double image_weight = 0;   // fraction of the echo via the face that its image radiates (image_weight())
  std::array<Vec3, 2> foot;  // ends of the interval of the wall behind the edge
  // true: the end of the interval is the projection of an end of the edge and slides with the look direction; false: it
  // is fixed
  std::array<bool, 2> ends_follow_edge{};
};

// Appends the penumbra terms for one antenna. `source`: of the wall's foot. Terms below limits.min_amplitude_m at the
// wavenumber limits.k are omitted.
void append_wall_penumbra(const WallBehindEdge& wall, const RadarBasis& antenna, const ContributionSource& source,
                          const MultipleDiffractionLimits& limits, std::vector<Contribution>& contributions);

}  // namespace seaglint
