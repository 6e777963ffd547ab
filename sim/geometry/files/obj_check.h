// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Validation of an OBJ file before OpenMesh parses it.

#include <string>
#include <string_view>

#include "sim/geometry/files/plain_polygons.h"

namespace seaglint {

// Polygons are triangulated (triangulate_polygon); triangles with two equal vertices are dropped. Throws InputError
// with file, line or byte, and cause.
SanitisedPolygons sanitised_obj(std::string_view bytes, const std::string& file);

}  // namespace seaglint
