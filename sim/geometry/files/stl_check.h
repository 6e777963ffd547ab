// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The check of an STL file.

#include <string>
#include <string_view>

#include "sim/geometry/files/plain_polygons.h"

namespace seaglint {

// InputError names the file, the line or byte, and what is wrong. Triangles with two equal corners are left out.
SanitisedPolygons sanitised_stl(std::string bytes, const std::string& file);

}  // namespace seaglint
