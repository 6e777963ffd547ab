// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/make_ship.h"

#include <fmt/format.h>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/geometry/mesh/crease_normals.h"
#include "sim/geometry/ship/ship_deck_fittings.h"
#include "sim/geometry/ship/ship_hull.h"
#include "sim/geometry/ship/ship_mast.h"
#include "sim/geometry/ship/ship_rails.h"
#include "sim/geometry/ship/ship_superstructure.h"
#include "sim/geometry/ship/ship_wall_fittings.h"
#include "sim/geometry/ship/ship_weapons.h"

namespace seaglint {
namespace {

void require(double value, double min, double max, const char* name) {
  // Written so that a NaN fails.
  if (!(value >= min && value <= max))
    throw InputError(fmt::format("ship {}: {} is outside {}..{} m", name, value, min, max));
}

// Positions on a grid of 2^-16 m (15 um, a thousandth of a wavelength at 16 GHz), which float32 represents exactly up
// to 256 m: differences in the last bit of a sine between processors have no effect.
TriangleMesh on_grid(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices) p = (p * 65536.0).rounded() / 65536.0;
  return mesh;
}

// Facets of the hull and of fairings turn by less, the sides of pipes and masts, knuckles and box edges by 22 deg and
// more.
constexpr double kSmoothTurn_deg = 20;
// Surfaces that rise by less count as flat, m: positions on the grid bend a long flat face of four corners by as much,
// which is 1.2 deg of two-way phase at 16 GHz.
constexpr double kFlat_m = 3e-5;

}  // namespace

TriangleMesh make_ship(const ShipForm& form) {
  require(form.length_m, 90, 200, "length");
  require(form.beam_m, 12, 25, "beam");
  require(form.freeboard_m, 4, 9, "freeboard");
  require(form.bow_height_m, form.freeboard_m, 14, "bow height");
  require(form.stern_height_m, 3, 9, "stern height");
  require(form.panel_m, 0.5, 6, "panel");
  require(form.plating_m, 0, 0.05, "plating");
  require(form.rail_width_m, 0.02, 0.1, "rail width");

  const HullSurface hull(form);
  const ShipHouses houses = ship_houses(hull);
  MeshBuilder builder;
  add_hull(builder, hull);
  add_superstructure(builder, hull, houses);
  if (form.detail >= ShipDetail::kFittings) {
    add_bulwark(builder, hull);
    add_masts(builder, hull, houses);
    add_weapons(builder, hull, houses);
    add_deck_fittings(builder, hull, houses);
    add_wall_fittings(builder, hull, houses);
  }
  if (form.detail >= ShipDetail::kRails) add_rails(builder, hull, houses);
  TriangleMesh ship = on_grid(builder.take());
  ship.corner_normals = crease_normals(ship, radians(kSmoothTurn_deg), kFlat_m);
  return ship;
}

}  // namespace seaglint
