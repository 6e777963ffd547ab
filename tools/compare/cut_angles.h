// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Directions of a cut in the body's angles: azimuth = (phi - phi_offset) / phi_scale, elevation = 90 deg - theta.

#include <optional>

#include "sim/field_tables/field_table.h"
#include "tools/compare/view_groups.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

double azimuth_of(const RcsCut& cut, double phi_deg);  // -180..180 deg

ViewPoint view_point(const RcsCut& cut, const FieldValue& value);

// Throws InputError with the option that states it if the cut has none.
const DeclaredTransmitter& stated_transmitter(const RcsCut& cut);

// Absent for a monostatic cut.
std::optional<FixedTransmitter> fixed_transmitter(const RcsCut& cut);

}  // namespace seaglint
