// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// HFSS reports of the monostatic radar cross section as csv.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

bool is_hfss_table(const TextSource& source);

// Columns by name: `IWavePhi [deg]`, `IWaveTheta [deg]`, `Freq [GHz]` and of the component received dB(), none, re()
// and im() of `[Complex]MonostaticRCSTheta` or `...Phi`; a value that is no column of its own stands in the name of the
// result, `dB(MonostaticRCSPhi) [] - Freq='10GHz' IWaveTheta='90deg'`, of which there may be many, or is the settings'
// frequency. The complex value is sqrt(sigma) e^{j phase} in metres. The wave incident is along theta^ or phi^; which
// of them the file does not say. Throws InputError with file, line and column.
void read_hfss_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
