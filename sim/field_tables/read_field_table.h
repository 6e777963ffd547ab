// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reads scattering amplitudes or the radar cross section from the files of measurements and other solvers.

#include <filesystem>

#include "sim/field_tables/field_table.h"

namespace seaglint {

// Reads a file whose format is recognised by its content (README.md). What neither the file nor its name states comes
// from the settings; a setting that contradicts the file is an error. Throws InputError naming the file, the line, what
// is missing and the format that was recognised, or why each format was not.
FieldTable read_field_table(const std::filesystem::path& file, const FieldTableSettings& settings);

// Whether read_field_table() recognises a file: HDF5 not, which the JSON of its pair reads, nor results of `seaglint
// compare`. False too where it cannot be read.
bool is_field_table(const std::filesystem::path& file);

}  // namespace seaglint
