// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Names of columns as different programs write them.

#include <string>
#include <string_view>

namespace seaglint {

// The name and unit of a column in one spelling, lower case with underscores: "roll_deg" for `roll_deg`, `Roll [deg]`,
// `ROLL (degrees)`, and for `roll` with the unit `(deg)` in a row of its own. Squares and cubes are digits:
// `area [m^2]` is "area_m2".
std::string column_key(std::string_view name, std::string_view unit = {});

// The unit in brackets at the end of a name, with its brackets; empty without one.
std::string_view bracketed_unit(std::string_view name);

// A cell of a row of units: a usual unit, anything in brackets, "-" or nothing.
bool is_unit(std::string_view cell);

}  // namespace seaglint
