// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/placement/mesh_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"

namespace seaglint {
namespace {

constexpr double kFarthest_m = 1e7;  // that of read_mesh()

Vec3 axis_of(const std::string& word, const char* what) {
  const auto known = std::find(std::begin(kMeshAxes), std::end(kMeshAxes), word);
  if (known == std::end(kMeshAxes))
    throw InputError(fmt::format("{}: value '{}': must be one of {}", what, word, fmt::join(kMeshAxes, ", ")));
  Vec3 axis = Vec3::Zero();
  axis[word[1] - 'x'] = word[0] == '+' ? 1 : -1;
  return axis;
}

}  // namespace

Mat3 rotation_of(const MeshPlacement& placement) {
  const Vec3 forward = axis_of(placement.forward, "forward"), up = axis_of(placement.up, "up");
  if (forward.dot(up) != 0)
    throw InputError(
        fmt::format("forward {} and up {}: must be perpendicular to each other", placement.forward, placement.up));
  return Mat3(forward, up.cross(forward), up).transpose();
}

TriangleMesh placed(TriangleMesh mesh, const MeshPlacement& placement) {
  const Mat3 rotation = rotation_of(placement);
  const Vec3 offset(placement.offset_m);
  if (rotation != Mat3::Identity()) mesh = transformed(mesh, rotation, Vec3::Zero());
  if (placement.scale != 1) mesh = enlarged(std::move(mesh), placement.scale);
  if (!offset.isZero(0)) mesh = transformed(mesh, Mat3::Identity(), offset);
  return mesh;
}

TriangleMesh read_placed_mesh(const std::filesystem::path& path, const MeshPlacement& placement) {
  TriangleMesh mesh = placed(read_mesh(path, placement.unit), placement);
  const Bounds box = bounds(mesh);
  const double farthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  if (!(farthest <= kFarthest_m))
    throw InputError(fmt::format("{}: reaches {:g} m from the origin, beyond {:g} m: are unit, scale and offset right?",
                                 path.string(), farthest, kFarthest_m));
  return mesh;
}

std::string placement_text(const MeshPlacement& placement) {
  const MeshPlacement standard;
  std::string text = "unit " + placement.unit;
  if (placement.forward != standard.forward || placement.up != standard.up)
    text += fmt::format(" forward {} up {}", placement.forward, placement.up);
  if (placement.scale != standard.scale) text += fmt::format(" scale {:.9g}", placement.scale);
  if (placement.offset_m != standard.offset_m)
    text += fmt::format(" offset_m {:.9g}", fmt::join(placement.offset_m, ","));
  return text;
}

MeshPlacement with_scale(MeshPlacement placement, double scale) {
  for (double& along : placement.offset_m) along *= scale / placement.scale;
  placement.scale = scale;
  return placement;
}

}  // namespace seaglint
