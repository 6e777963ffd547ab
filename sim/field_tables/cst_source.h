// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CST farfield sources (.ffs, version 3.0): complex fields over phi and theta at one or several frequencies.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

bool is_cst_source(std::string_view text);

// The wanted elements of the scattered field at 1 m under a plane wave of 1 V/m, about the position in the file. The
// file has neither the incident wave nor its polarisation. Throws InputError with file, line and column for another
// version or data type, rotated axes, and blocks that are not as long as announced.
void read_cst_source(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
