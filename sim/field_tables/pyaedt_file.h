// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// PyAEDT's exports of the monostatic radar cross section of HFSS: a JSON with the units beside an HDF5 table.

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/field_tables/field_table.h"

namespace seaglint {

// Whether a text is such a JSON: an object with the key monostatic_file.
bool is_pyaedt_json(std::string_view text);

// Either file of the pair; the other one is beside it: the JSON names the table, and a table is read with the unit of
// the JSON that names it. A value is sqrt(sigma) e^{j phase} in metres, e^{+jwt}, for a radar at IWaveTheta, IWavePhi;
// S = value / sqrt(4 pi). The element - received, transmitted - is a word VV, HV, VH or HH in the name of either file
// or else the only one wanted. The meshes of model_info, [file, colour, opacity, unit] each, become the table's
// geometry where all of them are in the folder `geometry` beside the JSON, or beside it. Throws InputError naming the
// file.
void read_pyaedt_file(const std::filesystem::path& file, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
