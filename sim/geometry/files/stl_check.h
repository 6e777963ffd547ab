// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Validation of an STL file before OpenMesh parses it.

#include <string>
#include <string_view>

#include "sim/geometry/files/plain_polygons.h"

namespace seaglint {

// Triangles with two equal vertices are dropped. Throws InputError with file, line or byte, and cause.
SanitisedPolygons sanitised_stl(std::string bytes, const std::string& file);

}  // namespace seaglint
