// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Writes and reads the clause in the head of a `seaglint rcs` table that gives the direction of the transmitter.

#include <optional>
#include <string>

#include "tools/rcs/rcs_request.h"

namespace seaglint {

// First words of the head line that contains the clause.
inline constexpr const char* kMethodNote = "# physical optics";

// The clause for a fixed transmitter; without one, for the monostatic case.
std::string transmitter_note(const std::optional<FixedTransmitter>& transmitter);

struct NotedTransmitter {
  std::optional<FixedTransmitter> fixed;  // absent: monostatic
};

// Parses the clause of a head line; empty if the line has none. Throws InputError for an angle that is no number.
std::optional<NotedTransmitter> read_transmitter_note(const std::string& line);

}  // namespace seaglint
