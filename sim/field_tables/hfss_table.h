// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// HFSS reports of the monostatic or bistatic radar cross section as csv.

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

bool is_hfss_table(const TextSource& source);

// Columns by name, in the unit of their brackets: `IWavePhi [deg]`, `IWaveTheta [deg]`, `Freq [GHz]`, of a bistatic
// table also `Phi [deg]`, `Theta [deg]` of the receiver, and of the component received
//   MonostaticRCSTheta [m^2]         none or mag(): any unit of level_unit.h; [] is m^2, [dB] is dBsm
//   dB(MonostaticRCSTheta) []        dB(), dB10(), and dB20() of Complex: dBsm
//   re(), im() or mag(), ang_deg() of ComplexMonostaticRCSTheta [meter]      sqrt(sigma) e^{j phase}, a length
// or the same of ...Phi, of ...Total and of Bistatic. A value that is no column of its own stands in the name of the
// result, `dB(MonostaticRCSPhi) [] - Freq='10GHz' IWaveTheta='90deg'`, of which there may be many, or is the settings'
// frequency or incident wave. The incident wave is along theta^ or phi^; which of them the file does not say. ...Total
// is read where there is no component: the sum over both received. Throws InputError with file, line and column, also
// for a unit that is not read.
void read_hfss_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
