// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Mesh files: .glb and .gltf (tinygltf), .obj, .ply, .stl, and shells of solvers, which are read only: NASTRAN (.nas
// .bdf .dat .fem), I-DEAS universal files (.unv), Gmsh (.msh). The file name extension selects the format.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Largest coordinate of a mesh, m; larger ones indicate a wrong unit.
inline constexpr double kLargestCoordinate = 1e7;

// The triangles of a file in metres and the body frame. Vertices at identical positions are merged (also across parts),
// polygons are triangulated. Positions have the precision of the file: doubles in text and in PLY properties of that
// type; float32 in glTF, whose nodes place them in double precision, and in binary STL.
// Files are untrusted: every count, size and index is checked against the file before a library allocates. Throws
// InputError with file and cause; also for a unit other than m, cm, mm, km, in, ft, a mesh without triangles, and
// coordinates that are not finite or exceed 1e7 m.
//   glTF is +Y up, +Z forward (glTF 2.0, section 3.4): x = Z, y = X, z = Y. Nodes are parts, named after node or mesh.
// Normals of glTF (NORMAL), OBJ (vn) and PLY (nx, ny, nz) become corner normals; those that are no unit vectors are
// normalised, invalid ones are none and refuse nothing. Facet normals of STL are ignored: they follow from the
// vertices.
//   The others define no axes: they are read as body axes. Groups, objects, solids, properties are parts.
//   A universal file that states its unit is read in it; `unit` must be "m" or agree, unless the file states metres.
TriangleMesh read_mesh(const std::filesystem::path& path, const std::string& unit = "m");

// Further files that a mesh file refers to: the buffers of a glTF, in their order; otherwise empty. Throws InputError
// where read_mesh() rejects the glTF.
std::vector<std::filesystem::path> sidecar_files(const std::filesystem::path& path);

// Lengths are metres. OBJ and PLY hold the positions as doubles, glTF and STL round them to float32. glTF keeps parts
// and materials, OBJ parts, STL and PLY neither; all but STL keep normals. The file is complete or absent
// (sim/core/process/file.h); equal meshes give equal bytes. Throws InputError for an unknown extension, an empty mesh
// and a mesh that read_mesh() rejects, WorkError when writing fails.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

// Writes a glTF file with coloured materials: linear red, green, blue in 0..1, one colour per entry of mesh.materials.
// Throws InputError for another extension than .glb and .gltf.
void write_coloured_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                         std::span<const std::array<double, 3>> material_colours);

}  // namespace seaglint
