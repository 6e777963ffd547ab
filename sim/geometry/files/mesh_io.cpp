// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/mesh_formats.h"
#include "sim/geometry/mesh/triangulate_polygon.h"

namespace seaglint {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

std::string ending_of(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

bool is_gltf(const std::string& ending) { return ending == ".glb" || ending == ".gltf"; }

constexpr std::array<const char*, 5> kWritten{".glb", ".gltf", ".obj", ".stl", ".ply"};
constexpr std::array<const char*, 6> kReadOnly{".nas", ".bdf", ".dat", ".fem", ".unv", ".msh"};

bool is_among(const std::string& ending, std::span<const char* const> endings) {
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

void require_written(const std::string& ending, const std::filesystem::path& path) {
  if (is_among(ending, kWritten)) return;
  if (is_among(ending, kReadOnly)) {
    throw InputError(fmt::format("{}: meshes with the ending \"{}\" are read only; written are {}", path.string(),
                                 ending, fmt::join(kWritten, " ")));
  }
  throw InputError(fmt::format("{}: the ending \"{}\" is not a mesh format; known are {}", path.string(), ending,
                               fmt::join(kWritten, " ")));
}

void require_read(const std::string& ending, const std::filesystem::path& path) {
  if (is_among(ending, kWritten) || is_among(ending, kReadOnly)) return;
  throw InputError(fmt::format("{}: the ending \"{}\" is not a mesh format; known are {} {}", path.string(), ending,
                               fmt::join(kWritten, " "), fmt::join(kReadOnly, " ")));
}

// Throws InputError for a text in UTF-16 and, in place of a text, a file of another format.
void refuse_foreign(const std::string& ending, std::string_view bytes, const std::string& file) {
  const bool may_be_binary = ending == ".stl" && !bytes.starts_with("\xff\xfe") && !bytes.starts_with("\xfe\xff");
  const std::string_view kind = may_be_binary ? std::string_view() : foreign_kind(bytes);
  if (!kind.empty()) throw InputError(fmt::format("{}: no {} file: it is {}", file, ending, kind));
}

TriangleMesh read_polygons(const std::string& ending, std::string bytes, const std::string& file) {
  refuse_foreign(ending, bytes, file);
  if (ending == ".obj") return read_obj(std::move(bytes), file);
  if (ending == ".stl") return read_stl(std::move(bytes), file);
  if (ending == ".ply") return read_ply(std::move(bytes), file);
  if (ending == ".msh") return read_gmsh(std::move(bytes), file);
  return read_nastran(std::move(bytes), file);
}

std::string polygon_bytes(const std::string& ending, const TriangleMesh& mesh) {
  if (ending == ".obj") return obj_bytes(mesh);
  if (ending == ".stl") return stl_bytes(mesh);
  return ply_bytes(mesh);
}

void check_mesh(const TriangleMesh& mesh, const std::string& file) {
  if (mesh.triangles.empty()) throw InputError(fmt::format("{}: contains no triangles", file));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& p = mesh.vertices[v];
    if (!p.allFinite()) throw InputError(fmt::format("{}: vertex {} is not finite", file, v));
    if (p.cwiseAbs().maxCoeff() > kLargestCoordinate) {
      throw InputError(fmt::format("{}: vertex {} lies at ({:g}, {:g}, {:g}) m, beyond {:g} m; is the unit right?",
                                   file, v, p.x(), p.y(), p.z(), kLargestCoordinate));
    }
  }
}

// Metres in one m, cm, mm, km, in or ft; InputError for any other name.
double metres_per(const std::string& unit) {
  constexpr std::array<std::pair<const char*, double>, 6> kUnits{
      {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"km", 1000.0}, {"in", 0.0254}, {"ft", 0.3048}}};
  for (const auto& [name, metres] : kUnits) {
    if (unit == name) return metres;
  }
  throw InputError(fmt::format("\"{}\" is not a unit of length; known are m cm mm km in ft", unit));
}

// A universal file in metres. The unit that it states is that of the lengths, and must be the one that the caller
// names; but programs without units state metres.
TriangleMesh read_unv_in_metres(std::string bytes, const std::string& unit, const std::string& file) {
  refuse_foreign(".unv", bytes, file);
  UnvMesh unv = read_unv(std::move(bytes), file);
  const double named = metres_per(unit), stated = unv.unit_m.value_or(named);
  const auto are_equal = [](double a, double b) { return std::abs(a - b) <= 1e-3 * b; };
  if (unit != "m" && !are_equal(stated, named) && !are_equal(stated, 1)) {
    throw InputError(
        fmt::format("{}: unit \"{}\": must be that of the file, {:.6g} m by its dataset 164", file, unit, stated));
  }
  if (unit != "m" && !are_equal(stated, named))
    unv.mesh.findings.push_back(fmt::format("its dataset 164 states metres: read in {} as asked for", unit));
  if (unit == "m" && !are_equal(stated, named))
    unv.mesh.findings.push_back(fmt::format("its lengths are in units of {:.6g} m by its dataset 164", stated));
  const double scale = unit == "m" ? stated : named;
  for (Vec3& p : unv.mesh.vertices) p *= scale;
  return unv.mesh;
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path, const std::string& unit) {
  const double scale = metres_per(unit);
  const std::string file = path.string();
  const std::string ending = ending_of(path);
  require_read(ending, path);
  std::string bytes = read_file(path, kMaxBytes);
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty", file));

  TriangleMesh mesh = is_gltf(ending)    ? read_gltf(bytes, path)
                      : ending == ".unv" ? read_unv_in_metres(std::move(bytes), unit, file)
                                         : read_polygons(ending, std::move(bytes), file);
  if (scale != 1.0 && ending != ".unv") {
    for (Vec3& p : mesh.vertices) p *= scale;
  }
  check_mesh(mesh, file);
  return welded(mesh);
}

std::vector<std::filesystem::path> sidecar_files(const std::filesystem::path& path) {
  if (!is_gltf(ending_of(path))) return {};
  return gltf_buffer_files(read_file(path, kMaxBytes), path);
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const std::string ending = ending_of(path);
  require_written(ending, path);
  if (mesh.triangles.empty())
    throw InputError(fmt::format("{}: a mesh without triangles is not written", path.string()));
  check_mesh(mesh, path.string());
  const std::string bytes = is_gltf(ending) ? gltf_bytes(mesh, ending == ".glb") : polygon_bytes(ending, mesh);
  write_file(path, bytes);
}

void write_coloured_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                         std::span<const std::array<double, 3>> material_colours) {
  if (!is_gltf(ending_of(path)))
    throw InputError(fmt::format("{}: colours need the ending .glb or .gltf", path.string()));
  if (mesh.triangles.empty())
    throw InputError(fmt::format("{}: a mesh without triangles is not written", path.string()));
  write_file(path, gltf_bytes(mesh, ending_of(path) == ".glb", material_colours));
}

std::string name_in(std::string_view line, const char* without) {
  const std::string name = fmt::format("{}", fmt::join(words_of(line), " "));
  return name.empty() ? without : utf8_of(name);
}

std::optional<double> coordinate_in(std::string_view word) {
  const auto number = parse_any_number(word);
  return number ? coordinate_of(*number) : std::nullopt;
}

}  // namespace seaglint
