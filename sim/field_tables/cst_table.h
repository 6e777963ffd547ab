// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// CST farfield tables of the radar cross section (rcs_reference.h).

#include <optional>
#include <string_view>
#include <vector>

#include "sim/core/text/text_source.h"
#include "sim/field_tables/reference_sample.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// The line with the names of the columns.
bool is_cst_header(std::string_view line);

// The samples of one polarisation in a text that has such a line. The table lacks its frequency. Throws InputError with
// file, line and column.
std::vector<ReferenceSample> read_cst_table(const TextSource& source, Polarisation element,
                                            std::optional<double> frequency_hz);

}  // namespace seaglint
