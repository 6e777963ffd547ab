// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A sweep in the files of other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/rcs/rcs_sweep.h"

namespace seaglint {

// hh, hv, vh, vv of the sweep's last model.
std::vector<RcsCut> cuts_of_sweep(const RcsSweep& sweep);

// Writes the sweep beside its table NAME.csv and returns the files: `feko` NAME_v.ffe and NAME_h.ffe, by the
// polarisation transmitted; `cst` a table `NAME (f = 9.5), theta = ..., VP.txt` per frequency and polarisation
// transmitted; `pyaedt` `NAME VV.json` with `NAME VV.h5` per element. Throws InputError for `pyaedt` of a bistatic
// sweep, WorkError where a file cannot be written.
std::vector<std::filesystem::path> write_sweep_as(const std::string& format, const RcsSweep& sweep,
                                                  const std::filesystem::path& table);

}  // namespace seaglint
