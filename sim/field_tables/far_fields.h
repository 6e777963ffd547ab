// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Complex far fields in blocks: FEKO far fields (.ffe) of the radar cross section by frequency and incident wave, and
// CST farfield sources (.ffs, version 3.0) over phi and theta at one or several frequencies.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

bool is_feko_table(const TextSource& source);

// Every block of `#Result Type: RCS`. A block with one direction, that of its incident wave, is monostatic; blocks of
// one incident wave with several directions are bistatic, a cut per element and incident wave. E is S in metres
// (checked against the block's RCS); the incident wave at polarisation angle 0, which files do not state, is along
// -theta^ = v, at 90 deg along phi^ = h: without wanted elements v is taken. Throws InputError with file, line and
// column.
void read_feko_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

bool is_cst_source(const TextSource& source);

// The wanted elements of the scattered field at 1 m under a plane wave of 1 V/m, about the position in the file. The
// file has neither the incident wave nor its polarisation. Throws InputError with file, line and column for another
// version or data type, rotated axes, and blocks that are not as long as announced.
void read_cst_source(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
