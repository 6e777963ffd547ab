// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// OBJ, STL and PLY through OpenMesh; used by mesh_io.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// A checked file in the plain dialect of its format that OpenMesh reads right: triangles only, absolute indices, finite
// float positions.
struct PlainPolygons {
  std::string bytes;
  bool binary = false;                       // for STL; a PLY says so itself
  std::size_t triangle_count = 0;            // at most so many will come
  std::vector<std::string> part_names;       // empty: the format or the file names none
  std::vector<std::uint16_t> triangle_part;  // as many as triangles, or none
};

// One for each format. InputError names the file, the line or byte, and what is wrong. Polygons are split
// (split_polygon); triangles with two equal corners are left out.
PlainPolygons plain_obj(std::string_view bytes, const std::string& file);
PlainPolygons plain_stl(std::string bytes, const std::string& file);
PlainPolygons plain_ply(std::string_view bytes, const std::string& file);

// `ending` is .obj, .stl or .ply.
TriangleMesh read_polygons(const PlainPolygons& plain, const std::string& ending, const std::string& file);
std::string polygon_bytes(const TriangleMesh& mesh, const std::string& ending);

}  // namespace seaglint
