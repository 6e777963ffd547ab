// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The formats of mesh files, behind mesh_io.h. Readers take the bytes of a file and its name for messages, and throw
// InputError with file, line (and column) or byte, and cause; writers return bytes, equal ones for equal meshes.

#include <array>
#include <bit>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

inline constexpr std::size_t kMaxParts = 65000;  // of a mesh

// OBJ. Positions and normals are the doubles that the text states; a normal that is missing or no number is none.
// Polygons are triangulated (triangulate_polygon); triangles with two equal vertices are dropped.
TriangleMesh read_obj(std::string bytes, const std::string& file);
// Positions and normals with the digits that restore the doubles, a group per run of triangles of one part.
std::string obj_bytes(const TriangleMesh& mesh);

// PLY, text and binary of both byte orders. The normals of a file (nx, ny, nz) are those of its vertices.
TriangleMesh read_ply(std::string bytes, const std::string& file);
// Binary, little-endian: doubles, one vertex for each position and normal that occur together.
std::string ply_bytes(const TriangleMesh& mesh);

// STL, text or binary, without degenerate triangles; bytes behind the last one of a binary file are a finding.
TriangleMesh read_stl(std::string bytes, const std::string& file);
// Binary, little-endian float32.
std::string stl_bytes(const TriangleMesh& mesh);

// glTF by tinygltf: the bytes of a .glb or .gltf, distinguished by the magic word. `path` appears in errors; buffers
// are read from its folder only.
TriangleMesh read_gltf(const std::string& bytes, const std::filesystem::path& path);
// Files next to `path` that hold buffers, in the order of the buffers. Throws InputError as read_gltf().
std::vector<std::filesystem::path> gltf_buffer_files(const std::string& bytes, const std::filesystem::path& path);
// A .glb, or a .gltf with its buffer as a data URI. material_colours: linear red, green, blue in 0..1 per material;
// empty: grey.
std::string gltf_bytes(const TriangleMesh& mesh, bool binary,
                       std::span<const std::array<double, 3>> material_colours = {});

struct SanitisedGltf {
  std::string bytes;                  // of a .glb where the file is one, else JSON
  std::vector<std::string> findings;  // TriangleMesh::findings
};
bool is_glb(std::string_view bytes);
// The file reduced to what a mesh needs: scenes, nodes, meshes with positions and indices, names of materials,
// accessors, buffer views, buffers. Types, indices, ranges and nesting are checked before tinygltf reads them; images,
// animations, extras, extensions and morph targets of weight 0 are removed; data URIs (RFC 2397) lose their type and
// parameters.
SanitisedGltf sanitised_gltf(std::string_view bytes, const std::string& file);

// NASTRAN bulk data. GRID in the base system or one of CORD2R, CORD2C, CORD2S; CTRIA3, CTRIAR, CTRIA6, CQUAD4, CQUADR,
// CQUAD8, CQUAD (also written CQUAD9) and CSHEAR. Parts are properties, with the names that pre-processors write into
// comments, else "property_7"; "body" without a property. Other cards are ignored, solids and other shells counted.
// Refused: INCLUDE, superelements, replication, a file with BEGIN BULK that ends without ENDDATA.
TriangleMesh read_nastran(std::string bytes, const std::string& file);

// I-DEAS universal files. Nodes of datasets 2411, 781 and 15, elements of 2412 and 780: thin and thick shells, plates,
// membranes, plane stress and plane strain. Parts are the groups of datasets 2467, 2477, 2452 and 2435, else the
// physical properties ("property_7"). Other datasets are skipped. Refused: nodes in another coordinate system than the
// global one.
struct UnvMesh {
  TriangleMesh mesh;               // lengths in the unit of the file
  std::optional<double> unit_m{};  // that unit in metres, where dataset 164 states it
};
UnvMesh read_unv(std::string bytes, const std::string& file);

// Gmsh, versions 2.0 to 2.2 and 4.1, text and binary of both byte orders: triangles and quadrilaterals. Parts are
// physical surfaces by their names ("physical_7" without), else elementary surfaces ("surface_7"); of several physical
// surfaces the first; a negative one turns the elements (version 4.1).
TriangleMesh read_gmsh(std::string bytes, const std::string& file);

// The words of a line with one blank between them, in UTF-8; `without` where there are none.
std::string name_in(std::string_view line, const char* without);
// A coordinate of a text, coordinate_of(); nullopt for anything else.
std::optional<double> coordinate_in(std::string_view word);

// The number of type T whose bytes begin here; swap: in the other byte order than the machine's.
template <typename T>
T number_at(const char* bytes, bool swap = false) {
  std::array<char, sizeof(T)> raw{};
  for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = bytes[swap ? raw.size() - 1 - i : i];
  return std::bit_cast<T>(raw);
}

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");
template <typename T>
void append_number(std::string& bytes, T value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  bytes.append(raw.data(), raw.size());
}

}  // namespace seaglint
