// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The target of a request as Python gives it.

#include <memory>
#include <string>
#include <variant>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

using MeshOrFile = std::variant<std::shared_ptr<TriangleMesh>, std::string>;

// Throws InputError where the file is not found (find_input()).
void set_target(RcsRequest& request, const MeshOrFile& target);

}  // namespace seaglint
