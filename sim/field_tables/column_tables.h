// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Tables in columns: those of `seaglint rcs` with the keys of the transmitter in their head, levels with or without
// phases in named columns, and four columns without names.

#include <optional>
#include <string>

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// Direction of a transmitter that does not move with the receiver, in the angles of `seaglint rcs`.
struct FixedTransmitter {
  double azimuth_deg = 0, elevation_deg = 0;
};

// The head line of a fixed transmitter, `# transmitter_azimuth_deg=20 transmitter_elevation_deg=3`; without one that of
// the monostatic case, `# transmitter=monostatic`. No line break.
std::string transmitter_line(const std::optional<FixedTransmitter>& transmitter);

struct TransmitterKeys {
  std::optional<FixedTransmitter> fixed;  // absent: monostatic
};

// Parses a line of a table; empty if its first word is no key of the transmitter. Throws InputError naming a key that
// is missing, unknown or has an invalid value.
std::optional<TransmitterKeys> read_transmitter_line(const std::string& line);

// Whether a text is a table of `seaglint rcs`: one of the first lines has frequency_hz, azimuth_deg and elevation_deg
// and no phases; below a head of `seaglint rcs` one of the angles is enough.
bool is_own_table(const TextSource& source);

// Columns by name: xx_re and xx_im, or xx_dbsm alone; without wanted elements, all that the table has. Its head gives
// the transmitter. Throws InputError with file, line and column, and for a head of `seaglint rcs`
// without a transmitter.
void read_own_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Whether one of the first lines has numbers only, 3 to 5 of them.
bool is_four_columns(const TextSource& source);
bool has_four_columns(const TextSource& source);  // exactly 4 of them
// Whether one of the first lines, or a comment among them, has names of columns theta_deg and phi_deg, or of an azimuth
// and an element or level.
bool is_named_table(const TextSource& source);

// Frequency in Hz, theta, phi in degrees and level in dBsm in this order (Austin RCS Benchmark Suite). One element,
// which the name or the settings give.
void read_four_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Columns by name and unit, in any order: azimuth (also az, aspect, angle, phi) in deg or rad, elevation
// or theta, frequency in Hz, kHz, MHz, GHz; of each element, HH, HV, VH, VV (received, transmitted), the level in dBsm
// or m^2, `HH (dBsm)`, `rcs_hh_dbsm`, and its phase, `HH phase (deg)`, e^{+jwt}; or one level of the element that the
// name or the settings give. What is missing is of the settings: the frequency, and the elevation, else 0. A table by
// azimuth is monostatic unless the settings say otherwise. Throws InputError with file, line and column, also for a
// column of these quantities without a unit.
void read_named_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
