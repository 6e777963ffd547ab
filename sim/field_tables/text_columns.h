// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tables of levels, with or without phases, in named columns, and four columns without names.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// Whether one of the first lines has numbers only, 3 to 5 of them.
bool is_four_columns(const TextSource& source);
bool has_four_columns(const TextSource& source);  // exactly 4 of them
// Whether one of the first lines, or a comment among them, has names of columns theta_deg and phi_deg, or of an azimuth
// and an element or level.
bool is_named_table(const TextSource& source);

// Frequency in Hz, theta, phi in degrees and level in dBsm in this order (Austin RCS Benchmark Suite). One element,
// which the name or the settings give.
void read_four_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Columns by name and unit, in any order (column_key.h): azimuth (also az, aspect, angle, phi) in deg or rad, elevation
// or theta, frequency in Hz, kHz, MHz, GHz; of each element, HH, HV, VH, VV (received, transmitted), the level in dBsm
// or m^2, `HH (dBsm)`, `rcs_hh_dbsm`, and its phase, `HH phase (deg)`, e^{+jwt}; or one level of the element that the
// name or the settings give. What is missing is of the settings: the frequency, and the elevation, else 0. A table by
// azimuth is monostatic unless the settings say otherwise. Throws InputError with file, line and column, also for a
// column of these quantities without a unit.
void read_named_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
