// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Numbers on the command line are decimal. CLI11 alone reads them as C literals: 010 as eight, 0x10 as sixteen, an
// empty word as zero.

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

namespace seaglint {

// Validator for numbers in [lowest, highest]; unlike CLI::Range it rejects NaN.
CLI::Validator number_within(double lowest, double highest);

// Restricts every numeric option, also of all subcommands, to decimal numbers.
void require_decimal_numbers(CLI::App& app);

}  // namespace seaglint
