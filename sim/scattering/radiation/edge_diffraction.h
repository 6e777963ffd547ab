// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Diffraction of a bounding edge of a reflector towards the reflectors after it, as in corner reflectors and for walls
// on decks.
//
// The beam that the reflector reflects ends at the edge. PO of the last reflector has an end-point contribution along
// the edge's shadow-boundary line, in every direction. The exact field has it at the edge, on the diffracted path via
// the reflectors to the receiver (beam_boundary.h moves it there). Therefore the end-point contribution of the last
// reflector is subtracted here from the exact field of the edge, not that of the edge's own face. Both are infinite in
// the direction of the reflected beam as -1/delta, delta the angle off it about the edge, and differ by the projection
// of the current on the received polarisation. For a beam that leaves a face at the angle a, normal to the edge, to
// first order
//
//     PO end point of the edge's own face   -1/delta -+ cot(a) / 2
//     exact half-plane                      -1/delta -+ 1 / (2 sin a)
//
// for soft and hard polarisation, with the opposite sign for the edge nearer to the source
// (Keller's coefficients, J. Opt. Soc. Am. 52 (1962) 116-130, and the end point of PO, expanded about the specular
// direction), all over 2 pi per metre of edge. An edge of a right-angled dihedral thus scatters -+(1 / sin a - tan a) /
// (4 pi): on the axis, a = 45 deg, the fringe current of the last reflector's own edge, and more towards the arm.

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/radiation/multiple_diffraction.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/edge_illumination.h"
#include "sim/scattering/tracing/tracing_settings.h"

namespace seaglint {

// Weights with which the two faces of a wedge radiate towards reflectors. With more reflections on both paths together
// than kMaxCorrectedReflections the shadow-boundary lines keep their end-point contributions, and the weights are
// limited to 0.2 rad about the specular direction.
inline constexpr int kMaxCorrectedReflections = 2;
std::array<double, 2> reflected_face_weights(const WedgeFrame& wedge, const EdgeIllumination& in,
                                             const EdgeIllumination& out);

// hh, hv, vh, vv per metre of edge, to be added to equivalent_edge_currents(): the PO end-point contribution of the
// edge's own face less that of the first reflector on the exit path; zero for a direct exit path, for which the edge's
// face is itself the last reflector. Valid on Keller's cone: an exit direction off it is rotated onto it.
std::array<double, 4> endpoint_correction(const WedgeFace& face, const EdgeIllumination& in,
                                          const EdgeIllumination& out);

// An interval of an edge is illuminated directly or after reflections; exit paths are found by tracing the receiver's
// wave back to the edge (reciprocity). Each pair of an incident and an exit path with a common interval is one
// contribution. For one antenna two reciprocal paths are one contribution.

// Limits of multiple diffraction: straight runs of edges of at least 42 times the smallest patch side (0.2 m on the 144
// m ship by default); third and fourth order for runs of at least 280 times that side (1.4 m); contributions of at
// least min_amplitude() at the lowest wavenumber.
MultipleDiffractionLimits multiple_diffraction_limits(const Scatterer& scatterer, const TracingSettings& settings,
                                                      double lowest);

struct EdgeDiffractionRequest {
  const Scatterer& scatterer;
  const BistaticGeometry& geometry;
  const TracingSettings& settings;
  std::span<const double> wavenumbers;  // of the patterns, at least one
  const IlluminationByEdge& incoming;   // by the transmitter
  const IlluminationByEdge& outgoing;   // by a wave from the receiver, the same object for one antenna
  int threads = 1;
};

// Calls visit(chunk, contributions), chunk = 0..kEdgeChunks-1, with the contributions of each edge; those of a chunk
// arrive in order from one thread. Contributions rejected by the filter of the settings are omitted. Chunks do not
// depend on the number of threads.
inline constexpr std::size_t kEdgeChunks = 16;
void edge_diffraction(const EdgeDiffractionRequest& request,
                      const std::function<void(std::size_t, std::span<const Contribution>)>& visit);

}  // namespace seaglint
