// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Decomposes a footprint's phase integral into points that hold over a band and a small aspect change: each has its own
// path, path gradient and a slowly varying amplitude. A closed form may not be frozen while its phase changes by
// cycles; its end-point contributions may (README.md).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/radiation/footprint.h"
#include "sim/scattering/tracing/contribution_filter.h"

namespace seaglint {

struct PointContribution {
  Complex amplitude;                             // of unit pattern at kc, without the phase e^{jk psi}, m
  double psi = 0;                                // minus the two-way path, m
  PathGradient gradient;                         // d psi / d r^, body frame, m
  std::array<std::complex<float>, 4> pattern{};  // hh, hv, vh, vv
  std::int32_t facet = -1;                       // that radiates to the receiver
  std::uint16_t part = 0;
  std::uint8_t bounces = 1;
  Mechanism mechanism = Mechanism::kPhysicalOptics;
};

// A point contribution whose amplitude is given over a band.
struct BandPoint {
  BandValues amplitude{};            // of unit pattern at the nodes, without the phase e^{jk psi}, m
  double psi = 0;                    // minus the two-way path, m
  PathGradient gradient;             // d psi / d r^, body frame, m
  std::array<Complex, 4> pattern{};  // hh, hv, vh, vv, at all nodes
};

// Appends the point contributions of a footprint at kc. At kc and the traced direction the sum of amplitude e^{jk psi}
// is scattered(footprint, kc) to rounding. Elsewhere the amplitudes are frozen. Let u be aspect_change_rad times the
// change of psi's slope along the panel: an area is replaced by its edges where that slope exceeds u /
// kMaxAmplitudeError, an edge by its end points where its own slope does; otherwise they are divided into pieces whose
// own phase stays below kMaxHalfPhase. The relative error is at most kMaxAmplitudeError per end point, and |k/kc - 1|.
void decompose(const Footprint& footprint, const RadarBasis& transmit, const DecompositionSettings& settings,
               std::vector<PointContribution>& out);

// The same with the amplitudes at the nodes of a band, for a sweep: over the band nothing is frozen but the taper of
// curved surfaces. The points of footprints with a pattern per wavenumber have that of `pattern`.
void decompose(const Footprint& footprint, const RadarBasis& transmit, const FrequencyBand& band,
               double aspect_change_rad, std::vector<BandPoint>& out);

// As the first, over a band kc -+ half_band for a footprint with patterns at the lower end, centre and upper end of the
// band: the first-order change with k becomes two more sets of points. With P1 = dP/dk and a small delta,
//     (k - kc) P1 e^{jk psi}  is  sin((k - kc) delta) / delta P1 e^{jk psi},
// points at psi +- delta; kDerivativePhase = half_band delta bounds the error by kDerivativePhase^2 / 6 of that change.
void decompose_over_band(const Footprint& footprint, const RadarBasis& transmit, const DecompositionSettings& settings,
                         double half_band, std::vector<PointContribution>& out);

// Distance of the radar, for the curvature of the wavefront.
struct RadarRange {
  double range_m = 0;  // 0: plane wave; else at least ten times the target's radius about the point it refers to
  Vec3 origin = Vec3::Zero();  // of the target's coordinates, relative to that point, m
};

// Adds the curvature of the wavefront at a finite range, to second order (CONVENTIONS.md, "Plane waves"): each path is
// longer by |x_perp|^2 / (2 R), x measured from the point that R = range_m > 0 refers to. The gradients are corrected
// too, except for the slide of a shadow boundary along the curved front, |x_perp| / R of its slide. Contributions must
// have been decomposed for an aspect change larger by (reach from that point) / R, since the direction to the radar
// differs between points, or tilted, and at any slope rate (finite_range.h).
void apply_wavefront_curvature(std::span<PointContribution> contributions, const BistaticGeometry& geometry,
                               const RadarRange& radar);
void apply_wavefront_curvature(std::span<BandPoint> contributions, const BistaticGeometry& geometry,
                               const RadarRange& radar);

// Sum of pattern amplitude e^{jk (psi + gradient . turn)} over all contributions, `turn` the change of both look
// directions: the direct sum, for tests and for few points.
std::array<Complex, 4> direct_sum(std::span<const PointContribution> contributions, double k, const Vec3& turn);

}  // namespace seaglint
