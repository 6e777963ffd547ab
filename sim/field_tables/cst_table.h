// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CST farfield tables: radar cross section or electric field (1 m, plane wave of 1 V/m) over theta and phi.

#include <string_view>

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// The line with the names of the columns.
bool is_cst_header(std::string_view line);

// The wanted elements of a text that has such a line: columns by their squeezed names, `Theta[deg.] Phi[deg.]
// Abs(Theta)[unit] Phase(Theta)[deg.] Abs(Phi)[unit] Phase(Phi)[deg.]`, or in Ludwig's third definition `Horiz(Abs)
// Horiz(Phase) Vert(Abs) Vert(Phase)`; units: level_unit.h. Theta below 0 is folded (|theta|, phi + 180). The table has
// neither frequency nor polarisation transmitted. `Abs(RCS)` or `Abs(E)` is read where there is no component: the sum
// over both received. Throws InputError with file, line and column.
void read_cst_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
