// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A footprint's phase integral as points that hold over a band and a small turn: each with its own path and the
// gradient of that path, and an amplitude that varies slowly (README.md: closed forms may not be frozen while their
// phase runs through cycles; their end points may).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/beams/contribution_filter.h"
#include "sim/scattering/surfaces/decomposition.h"
#include "sim/scattering/surfaces/footprint.h"

namespace seaglint {

struct PointContribution {
  Complex amplitude;                             // S-amplitude of unit pattern at kc without its phase e^{jk psi}, m
  double psi = 0;                                // minus the two-way path, m
  PathGradient gradient;                         // d psi / d r^, body frame, m
  std::array<std::complex<float>, 4> pattern{};  // hh, hv, vh, vv
  std::int32_t facet = -1;                       // where it leaves the target
  std::uint16_t part = 0;
  std::uint8_t bounces = 1;
  Mechanism mechanism = Mechanism::kPhysicalOptics;
};

// The footprint's contributions at kc, appended. Summing amplitude e^{jk psi} at kc and the lit direction gives
// scattered(footprint, kc) to rounding. Away from there amplitudes are frozen: with u = aspect_change_rad times the
// change of psi's slope along the facet, an area becomes its edges where that slope exceeds u / kMaxAmplitudeError, an
// edge its ends where its own slope does; else they are cut into pieces whose own phase stays below kMaxHalfPhase. What
// is left is at most kMaxAmplitudeError per end point, and |k/kc - 1|.
void decompose(const Footprint& footprint, const RadarBasis& transmit, const DecompositionSettings& settings,
               std::vector<PointContribution>& out);

// The same over a band kc -+ half_band for a footprint whose patterns belong to the band's lower end, centre and upper
// end: their first-order change with k becomes two more sets of points. With P1 = dP/dk and a small delta,
//     (k - kc) P1 e^{jk psi}  is  sin((k - kc) delta) / delta P1 e^{jk psi},
// points at psi +- delta; kDerivativePhase = half_band delta bounds the error by kDerivativePhase^2 / 6 of that change.
void decompose_over_band(const Footprint& footprint, const RadarBasis& transmit, const DecompositionSettings& settings,
                         double half_band, std::vector<PointContribution>& out);

// The wavefront at a finite range, to second order (CONVENTIONS.md, "Plane waves"): each way is longer by |x_perp|^2 /
// (2 R), x counted from the point that the range refers to; `origin` is where the contributions' frame stands from
// there. The gradients follow, but for what a slipping corner's way over the bent front adds, |x_perp| / R of its slip.
// Contributions must have been split for a turn of (reach from that point) / R besides their own, since the radar
// stands in another direction from every point.
void apply_wavefront_curvature(std::span<PointContribution> contributions, const BistaticGeometry& geometry,
                               const Vec3& origin, double range_m);

// sum of pattern amplitude e^{jk (psi + gradient . turn)} over all contributions, both directions turning alike: the
// direct sum, for tests and for few points.
std::array<Complex, 4> direct_sum(std::span<const PointContribution> contributions, double k, const Vec3& turn);

}  // namespace seaglint
