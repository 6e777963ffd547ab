// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Meshes from and to files: .glb and .gltf (tinygltf), .obj, .stl and .ply (OpenMesh). The ending of the name decides.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// The triangles of a file in metres and the body frame, vertices at identical positions merged (also across parts),
// polygons split into fans. Positions have passed through float32. Files are not trusted: every count, size and index
// is checked against the file before a library allocates; anything wrong is an InputError that names the file and what
// is wrong with it, so is a unit other than m, cm, mm, km, in, ft. A mesh without triangles and coordinates that are
// not finite or beyond 1e7 m are wrong. One thread at a time: OpenMesh's readers keep their state to themselves.
//   glTF is +Y up, +Z forward (glTF 2.0, section 3.4): x = Z, y = X, z = Y. Nodes are parts, named by node or mesh.
//   OBJ, STL and PLY have no convention: their axes are taken as the body frame's. Groups, objects and solids are
//   parts.
TriangleMesh read_mesh(const std::filesystem::path& path, const std::string& unit = "m");

// The files beside a mesh's own that it is read from: buffers of a glTF, in their order; else none. InputError where
// read_mesh() finds the glTF wrong.
std::vector<std::filesystem::path> sidecar_files(const std::filesystem::path& path);

// Positions are rounded to float32, lengths are metres. glTF keeps parts and materials, OBJ parts, STL and PLY neither.
// The file is whole or absent (sim/core/process/file.h) and equal meshes give equal bytes. InputError for an unknown
// ending, an empty mesh and one that read_mesh() refuses, WorkError when the disk refuses.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

// InputError unless write_coloured_mesh() knows the ending.
void require_coloured_mesh(const std::filesystem::path& path);

// A glTF file whose materials have colours: linear red, green, blue in 0..1, one for each of mesh.materials.
void write_coloured_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                         std::span<const std::array<double, 3>> material_colours);

}  // namespace seaglint
