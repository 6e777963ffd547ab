// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/solver_mesh.h"

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/scattering/target/target_check.h"

namespace seaglint {

SoundMesh sound_mesh(const TriangleMesh& mesh, double lowest_hz) {
  SoundMesh sound{repaired(mesh), findings(examine(mesh))};
  if (sound.mesh.triangles.empty()) throw InputError("no triangle has an area: nothing scatters");
  const std::vector<std::string> of_size = check_target(sound.mesh, lowest_hz);
  sound.doubts.insert(sound.doubts.end(), of_size.begin(), of_size.end());
  return sound;
}

}  // namespace seaglint
