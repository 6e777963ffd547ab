// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Phase integral of a footprint, and its physical-optics scattering matrix.

#include <array>
#include <cstddef>

#include "sim/scattering/radiation/footprint.h"

namespace seaglint {

// I(k) = integral over the footprint of e^{jk psi(p)} d^2p, m^2. Gordon's contour form (W. B. Gordon, IEEE Trans.
// AP-23, 1975, 590-592), by the divergence theorem with F = w e^{jk w.p} / (jk |w|^2); a series where |w| is small.
// With curvature: the sum of curved_contributions(), taper included.
Complex phase_integral(const Footprint& footprint, double k);

// The same over another part of the flat facet.
Complex flat_phase_integral(const Footprint& footprint, const MovingPolygon& polygon, double k);

// S = -jk/(2 pi) pattern I(k): physical optics, E_s = -(jk eta / 4 pi) (e^{-jkr}/r) integral (J - r^ r^.J) e^{jk r^.x}
// dS with J = 2 n x H (Balanis, Advanced Engineering Electromagnetics, eqs. 6-95, 7-54), dS = d^2p / |n . k^|. hh, hv,
// vh, vv in metres. `index`: of k in the illumination's wavenumbers, used where materials make the pattern depend on
// it.
std::array<Complex, 4> scattered(const Footprint& footprint, double k, std::size_t index = 0);

}  // namespace seaglint
