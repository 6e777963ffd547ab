// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The check of an OBJ file.

#include <string>
#include <string_view>

#include "sim/geometry/files/plain_polygons.h"

namespace seaglint {

// InputError names the file, the line or byte, and what is wrong. Polygons are split (triangulate_polygon); triangles
// with two equal corners are left out.
SanitisedPolygons sanitised_obj(std::string_view bytes, const std::string& file);

}  // namespace seaglint
