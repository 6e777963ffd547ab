// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tables of levels with named columns, or four columns without names.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// Whether one of the first lines has numbers only, 3 to 5 of them; or names of columns theta_deg and phi_deg.
bool is_four_columns(const TextSource& source);
bool has_named_angles(const TextSource& source);

// Frequency in Hz, theta, phi in degrees and level in dBsm in this order (Austin RCS Benchmark Suite), or named
// frequency_hz (_ghz, _mhz), theta_deg, phi_deg, dbsm in any order. One element, which the name or the settings give.
void read_four_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);
void read_named_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
