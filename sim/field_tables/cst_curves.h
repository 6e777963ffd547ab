// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CST 1D exports: curves of the radar cross section or the field at 1 m over frequency, theta or phi.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

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
