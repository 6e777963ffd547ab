// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes and reads the keys in the head of a `seaglint rcs` table that give the direction of the transmitter.

#include <optional>
#include <string>

namespace seaglint {

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

}  // namespace seaglint
