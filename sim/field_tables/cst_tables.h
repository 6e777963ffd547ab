// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CST farfield tables over theta and phi, and 1D curves over frequency, theta or phi: radar cross section, or the
// electric field at 1 m under a plane wave of 1 V/m.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// Whether one of the first lines has the names of the columns.
bool is_cst_table(const TextSource& source);

// The wanted elements of a farfield table: columns by their squeezed names, `Theta[deg.] Phi[deg.]
// Abs(Theta)[unit] Phase(Theta)[deg.] Abs(Phi)[unit] Phase(Phi)[deg.]`, or in Ludwig's third definition `Horiz(Abs)
// Horiz(Phase) Vert(Abs) Vert(Phase)`; units: LevelUnit. Theta below 0 is folded (|theta|, phi + 180). The table has
// neither frequency nor polarisation transmitted. `Abs(RCS)` or `Abs(E)` is read where there is no component: the sum
// over both received. Throws InputError with file, line and column.
void read_cst_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Whether one of the first lines has the names of the columns of a curve.
bool is_cst_curves(const TextSource& source);

// All blocks of a file, of both styles:
//   #Parameters = {theta=90; phi=10}                    (if any)
//   #"Frequency / GHz"<TAB>"RCS ... [Magnitude]"        two columns, or three: real and imaginary part, magnitude and
//   phase
//   #----
//   Frequency / GHz      RCS/abs,dBsm                   or older, the block ending with an empty line
//   ----
// What is not on the abscissa - frequency, theta, phi - comes from the parameters, the curve's name or the file's name,
// as `theta = 90`; the element from the settings or VV, HH, VH, HV in a name, or with `abs` in the curve's name and
// both received polarisations wanted their sum. CST prints [Magnitude] for decibels too: the unit is that of the name
// (m^2, dBsm, dB(m^2), V/m, dB(V/m)), else dBsm where a value is negative; else the file is refused. Throws InputError
// with file, line and column.
void read_cst_curves(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
