// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Numbers on the command line are decimal. CLI11 takes them as C does: 010 would be eight, 0x10 sixteen, an empty word
// zero.

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

namespace seaglint {

// A number of the interval; unlike CLI::Range it refuses NaN.
CLI::Validator number_within(double lowest, double highest);

// Holds every option of numbers, of all commands below too, to decimal numbers.
void require_decimal_numbers(CLI::App& app);

}  // namespace seaglint
