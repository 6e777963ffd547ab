// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A target's mesh between its file and the solver.

#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// A mesh as the solver takes it, and a sentence for everything that was wrong with the file's or may be.
struct SoundMesh {
  TriangleMesh mesh;
  std::vector<std::string> doubts;
};

// Its materials are chosen before. Throws InputError when no triangle has an area and for what check_target() refuses.
SoundMesh sound_mesh(const TriangleMesh& mesh, double lowest_hz);

}  // namespace seaglint
