// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Directions and frequencies of a cut: in the body's angles, as few grids that a sweep solves at once, and as a sweep
// of one element.

#include <compare>
#include <optional>
#include <span>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

struct ViewPoint {
  double frequency_hz = 0, azimuth_deg = 0, elevation_deg = 0;
  auto operator<=>(const ViewPoint&) const = default;  // NOLINT(modernize-use-nullptr): compares with 0
};

// All combinations of these values.
struct ViewGrid {
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg;  // ascending
  bool operator==(const ViewGrid&) const = default;
};

// Grids that hold every point exactly once and nothing else: directions of equal frequencies, then elevations of equal
// azimuths. Points that stand repeatedly count once.
std::vector<ViewGrid> view_grids(std::span<const ViewPoint> points);

// The grid cut along its longest side, so that one variable changes in each: frequencies of each direction, or
// directions of one elevation or azimuth at all frequencies.
std::vector<ViewGrid> cuts_of(const ViewGrid& grid);

// Directions of a cut in the body's angles: azimuth = (phi - phi_offset) / phi_scale, elevation = 90 deg - theta.

double azimuth_of(const RcsCut& cut, double phi_deg);  // -180..180 deg

ViewPoint view_point(const RcsCut& cut, const FieldValue& value);

// Throws InputError with the option that states it if the cut has none.
const DeclaredTransmitter& stated_transmitter(const RcsCut& cut);

// Absent for a monostatic cut.
std::optional<FixedTransmitter> fixed_transmitter(const RcsCut& cut);

// The values of `other` at the directions (0.001 deg) and frequencies (1e-6) of `cut`, as few sweeps with one model of
// its name; the element of `other` alone is filled, about the body's origin. Without phases the amplitudes are positive
// with the level's magnitude. Empty if no place is equal.
std::vector<RcsSweep> table_sweeps(const RcsCut& cut, const RcsCut& other);

}  // namespace seaglint
