// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// HFSS reports of the monostatic or bistatic radar cross section as csv, and PyAEDT's exports of the monostatic one: a
// JSON with the units beside an HDF5 table.

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

bool is_hfss_table(const TextSource& source);

// Columns by name, in the unit of their brackets: `IWavePhi [deg]`, `IWaveTheta [deg]`, `Freq [GHz]`, of a bistatic
// table also `Phi [deg]`, `Theta [deg]` of the receiver, and of the component received
//   MonostaticRCSTheta [m^2]         none or mag(): any unit of LevelUnit; [] is m^2, [dB] is dBsm
//   dB(MonostaticRCSTheta) []        dB(), dB10(), and dB20() of Complex: dBsm
//   re(), im() or mag(), ang_deg() of ComplexMonostaticRCSTheta [meter]      sqrt(sigma) e^{j phase}, a length
// or the same of ...Phi, of ...Total and of Bistatic. A value that is no column of its own stands in the name of the
// result, `dB(MonostaticRCSPhi) [] - Freq='10GHz' IWaveTheta='90deg'`, of which there may be many, or is the settings'
// frequency or incident wave. The incident wave is along theta^ or phi^; which of them the file does not say. ...Total
// is read where there is no component: the sum over both received. Throws InputError with file, line and column, also
// for a unit that is not read.
void read_hfss_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Whether a text is the JSON of such a pair: an object with the key monostatic_file.
bool is_pyaedt_json(std::string_view text);

// Reads either file of the pair; the other one is beside it: the JSON names the table, and a table is read with the
// unit of the JSON that names it. A value is sqrt(sigma) e^{j phase} in metres, e^{+jwt}, for a radar at IWaveTheta,
// IWavePhi; S = value / sqrt(4 pi). The element - received, transmitted - is a word VV, HV, VH or HH in the name of
// either file or else the only one wanted. The meshes of model_info, [file, colour, opacity, unit] each, become the
// table's geometry where all of them are in the folder `geometry` beside the JSON, or beside it. Throws InputError
// naming the file.
void read_pyaedt_file(const std::filesystem::path& file, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
