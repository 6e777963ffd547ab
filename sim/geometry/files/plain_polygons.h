// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Result of the validation of OBJ, STL and PLY files: the input of OpenMesh.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seaglint {

// A validated file in the plain subset of its format that OpenMesh reads correctly: triangles only, absolute indices,
// finite float positions.
struct SanitisedPolygons {
  std::string bytes;
  bool binary = false;                       // of an STL; a PLY states its encoding itself
  std::size_t triangle_count = 0;            // upper bound
  std::vector<std::string> part_names;       // empty: no names
  std::vector<std::uint16_t> triangle_part;  // one per triangle, or empty
};

// A coordinate as float32; nullopt when not finite or beyond 1e30; 0 below 1e-30, so that conversions to float text are
// exact.
std::optional<float> coordinate_of(double value);

}  // namespace seaglint
