// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shells of I-DEAS universal files; used by mesh_io.

#include <optional>
#include <string>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct UnvMesh {
  TriangleMesh mesh;               // lengths in the unit of the file
  std::optional<double> unit_m{};  // that unit in metres, where dataset 164 states it
};

// Nodes of datasets 2411, 781 and 15, elements of 2412 and 780: thin and thick shells, plates, membranes, plane stress
// and plane strain. Parts are the groups of datasets 2467, 2477, 2452 and 2435, else the physical properties
// ("property_7"). Other datasets are skipped. Throws InputError with file, line and column; also for nodes in another
// coordinate system than the global one.
UnvMesh read_unv(std::string bytes, const std::string& file);

}  // namespace seaglint
