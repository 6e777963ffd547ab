// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Division of a beam's cross-section.

#include <array>

#include "sim/scattering/geometry/image_transform.h"
#include "sim/scattering/geometry/polygon_set.h"

namespace seaglint {

// The parts of a cross-section on either side of the middle of a rectangle around it, with sides along and across the
// longest side of its polygons, cut across the longer one. The cut is at rest on the plane that the rays leave,
// `source`, when the look direction changes.
std::array<PolygonSet, 2> halved(const PolygonSet& cross_section, const DepthPlane& source);

}  // namespace seaglint
