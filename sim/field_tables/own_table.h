// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tables of `seaglint rcs`.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// Whether one of the first lines has frequency_hz, azimuth_deg and elevation_deg and no phases; below a head of
// `seaglint rcs` one of the angles is enough.
bool is_own_table(const TextSource& source);

// Columns by name: xx_re and xx_im, or xx_dbsm alone; without wanted elements, all that the table has. Its head gives
// the transmitter (transmitter_keys.h). Throws InputError with file, line and column, and for a head of `seaglint rcs`
// without a transmitter.
void read_own_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
