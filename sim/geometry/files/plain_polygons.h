// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the checks of OBJ, STL and PLY files hand to OpenMesh.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seaglint {

// A checked file in the plain dialect of its format that OpenMesh reads right: triangles only, absolute indices, finite
// float positions.
struct SanitisedPolygons {
  std::string bytes;
  bool binary = false;                       // for STL; a PLY says so itself
  std::size_t triangle_count = 0;            // at most so many will come
  std::vector<std::string> part_names;       // empty: the format or the file names none
  std::vector<std::uint16_t> triangle_part;  // as many as triangles, or none
};

// A coordinate as float32. Not finite and beyond 1e30 is nothing; below 1e-30 is zero, which keeps float text
// conversions exact.
std::optional<float> coordinate_of(double value);

}  // namespace seaglint
