// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Where the transmitter of a table of `seaglint rcs` stands: one clause of its head, written and read here.

#include <optional>
#include <string>

#include "tools/rcs/rcs_request.h"

namespace seaglint {

// Begins the line of the head that holds the clause.
inline constexpr const char* kMethodNote = "# physical optics";

// The clause for a transmitter that stands still, or for none: monostatic.
std::string transmitter_note(const std::optional<FixedTransmitter>& transmitter);

struct NotedTransmitter {
  std::optional<FixedTransmitter> fixed;  // absent: monostatic
};

// The clause of a line of a head; nothing where it has none. Throws InputError for an angle that is no number.
std::optional<NotedTransmitter> read_transmitter_note(const std::string& line);

}  // namespace seaglint
