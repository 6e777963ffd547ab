// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the thickness t of a sheet changes where it ends in a square rim, to first order in k t.
//
// Across the rim (2-D, wavenumber k sin b) a half-plane of thickness t differs from one without in three ways that the
// first order of Hadamard's formula for a boundary moved outwards by t/2 holds together: delta P = (j/4) integral t/2
// (du/dn du'/dn) ds for the soft field, (j/4) integral t/2 (k^2 u u' - du/ds du'/ds) ds for the hard one, u and u' the
// half-plane's exact fields for the two directions. Both integrals are closed forms (by Laplace transforms of the
// currents) but for a logarithm at the edge, which the conformal map of the square end fixes: they begin t / (4 pi e)
// from its face. The closed forms are derived in README.md, "Thick sheets", and held against integral equations of
// strips up to 0.1 wavelengths thick.
//
// The sheet is drawn where its lit face is: then what is left is the rim's alone, without the phase of a face that
// stands t/2 before the middle. A wave that comes from one side and is received on the other has its phase counted from
// the middle.

#include <array>

#include "sim/scattering/diffraction/wedge_diffraction.h"

namespace seaglint {

// A quantity of first order in k t: k t (constant + logarithm ln(k t)).
template <typename T>
struct FirstOrderThickness {
  T constant{}, logarithm{};
};

// Of the rim's equivalent_edge_currents(), in the same units: p . current is what the thickness adds to S per metre of
// rim, for received polarisation p in direction s. Unchanged when transmitter and receiver change places. Finite
// everywhere. The rim is a WedgeFrame with N = 2.
std::array<FirstOrderThickness<CVec3>, 2> thick_edge_currents(const WedgeFrame& rim, const Vec3& k_hat,
                                                              const std::array<Vec3, 2>& fields, const Vec3& s);

// By how much of itself the thickness changes a hard wave from one direction that the rim sends along the sheet, or one
// along the sheet that it sends there: `towards` the source or receiver, unit. The mean of both faces.
FirstOrderThickness<Complex> thick_edge_wave_change(const WedgeFrame& rim, const Vec3& towards);

}  // namespace seaglint
