// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/core/process/error.h"
#include "tools/rcs/echo_selection.h"

namespace seaglint {
namespace {

void require_above_water(const SeaUnderTarget& sea, const TriangleMesh& mesh) {
  const double top_m = bounds(mesh).upper.z();
  if (!(top_m + sea.height_m > 0)) {
    throw InputError(
        fmt::format("--origin-height-m: value {}: must be greater than {:.6g}, else the whole target is under water",
                    sea.height_m, -top_m));
  }
}

}  // namespace

PreparedTarget prepare_mesh(const RcsRequest& request) {
  requested_sweep(request);  // throws InputError for a contradictory request
  const auto [lowest, highest] = std::minmax_element(request.frequency_hz.begin(), request.frequency_hz.end());
  SolverMesh mesh = load_solver_mesh({.mesh = request.target,
                                      .unit = request.unit,
                                      .loaded = request.mesh,
                                      .materials = request.materials,
                                      .material_folder = "",
                                      .lowest_hz = *lowest,
                                      .highest_hz = *highest,
                                      .materials_place = "--material",
                                      .frequencies_place = "",
                                      .mesh_place = request.target.string()});
  ScattererSettings settings{
      .waterline_m = std::nullopt,
      .crease_rad = request.crease_deg ? std::optional(radians(*request.crease_deg)) : std::nullopt,
      .sheet_thickness_m = 1e-3 * request.sheet_thickness_mm,
      .edges = request.edges,
      .lowest_hz = *lowest,
      .highest_hz = *highest};
  if (request.sea.reflection) {
    require_above_water(request.sea, mesh.mesh);
    settings.waterline_m = -request.sea.height_m;
  }
  return prepare_target(std::move(mesh), settings);
}

RcsTarget select_echoes(const RcsRequest& request, PreparedTarget prepared) {
  const auto [lowest, highest] = std::minmax_element(request.frequency_hz.begin(), request.frequency_hz.end());
  RcsTarget target{std::move(prepared), {}, {}};
  const PreparedTarget& whole = target.prepared;
  target.filter = filter_of(request.selection, whole.mesh, request.max_bounces, request.edges);
  target.filter.cavities = cavity_parts(request.cavities, whole.mesh, whole.materials, target.filter);
  target.cavities =
      make_cavities(request.cavities, whole.mesh, target.filter.cavities, *whole.scatterer, *lowest, *highest);
  return target;
}

RcsTarget prepare_rcs_target(const RcsRequest& request) { return select_echoes(request, prepare_mesh(request)); }

}  // namespace seaglint
