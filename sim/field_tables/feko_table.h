// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// FEKO far fields (.ffe) of the radar cross section: blocks by frequency and incident wave.

#include <string_view>

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

bool is_feko_table(std::string_view text);

// Every block of `#Result Type: RCS`. A block with one direction, that of its incident wave, is monostatic; blocks of
// one incident wave with several directions are bistatic, a cut per element and incident wave. E is S in metres
// (checked against the block's RCS); the incident wave at polarisation angle 0, which files do not state, is along
// -theta^ = v, at 90 deg along phi^ = h: without wanted elements v is taken. Throws InputError with file, line and
// column.
void read_feko_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
