// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bindings/bindings.h"

#include "sim/core/text/names.h"

namespace seaglint {

void set_target(RcsRequest& request, const MeshOrFile& target) {
  if (const auto* file = std::get_if<std::string>(&target)) {
    request.target = find_input(*file);
  } else {
    request.mesh = std::get<0>(target);
    request.target = "the mesh";
  }
}

}  // namespace seaglint
