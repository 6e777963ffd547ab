// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shells of NASTRAN bulk data; used by mesh_io.

#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// GRID in the base system or one of CORD2R, CORD2C, CORD2S; CTRIA3, CTRIAR, CTRIA6, CQUAD4, CQUADR, CQUAD8, CQUAD
// (also written CQUAD9) and CSHEAR. Parts are properties, with the names that pre-processors write into comments
// (NastranNames), else "property_7"; "body" without a property. Other cards are ignored, solids and other shells
// counted. Throws InputError with file, line and column; also for INCLUDE, superelements, replication, and a file with
// BEGIN BULK that ends without ENDDATA.
TriangleMesh read_nastran(std::string bytes, const std::string& file);

}  // namespace seaglint
