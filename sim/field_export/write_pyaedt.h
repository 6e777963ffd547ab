// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The pair of files as PyAEDT exports the monostatic radar cross section.

#include <string>

#include "sim/field_tables/field_table.h"

namespace seaglint {

struct PyaedtPair {
  std::string json;   // text; names the table STEM.h5
  std::string table;  // bytes of the HDF5 file, which pandas.read_hdf() opens
};

// One monostatic element: sqrt(4 pi) S in metres over Freq in GHz, IWavePhi and IWaveTheta in degrees, along
// theta^ = -v and phi^ = h, exact but for the last bit. `stem` is the name of both files without its ending; the
// element should stand in it as a word VV, HV, VH or HH (received, transmitted), which no key states. Throws InputError
// for a bistatic cut and one without phases.
PyaedtPair pyaedt_pair(const RcsCut& cut, const std::string& stem);

}  // namespace seaglint
