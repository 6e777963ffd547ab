// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/make_ship.h"

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/placement/hydrostatics.h"
#include "sim/geometry/ship/ship_design.h"
#include "sim/geometry/surface/facets.h"

namespace seaglint {

namespace {

// Facets of the hull and of fairings turn by less, the sides of pipes and masts, knuckles and box edges by 22 deg and
// more.
constexpr double kSmoothTurn_deg = 20;
// Surfaces that rise by less count as flat, m: positions on the grid bend a long flat face of four corners by as much,
// which is 1.2 deg of two-way phase at 16 GHz.
constexpr double kFlat_m = 3e-5;

// Positions on a grid of 2^-16 m (15 um, a thousandth of a wavelength at 16 GHz), which float32 represents exactly up
// to 256 m: differences in the last bit of a sine between processors have no effect.
TriangleMesh with_normals_on_grid(TriangleMesh mesh) {
  for (Vec3& p : mesh.vertices) p = (p * 65536.0).rounded() / 65536.0;
  mesh.corner_normals = crease_normals(mesh, radians(kSmoothTurn_deg), kFlat_m);
  return mesh;
}

}  // namespace

Ship make_ship(const ShipSpec& spec) {
  Random random({spec.seed, Stream::kShip, static_cast<std::uint64_t>(spec.kind)});
  const ShipDesign design = design_of(spec, random);
  MeshBuilder builder;
  if (spec.kind == ShipKind::kFrigate) {
    add_combatant(builder, design.lines, spec.detail, design.rail_width);
  } else {
    const HullSurface hull(design.lines);
    add_hull(builder, hull);
    using Add = void (*)(MeshBuilder&, const HullSurface&, const ShipDesign&, Random&);
    constexpr Add kAdd[] = {nullptr,    add_corvette,       add_patrol_boat,    add_container_ship,
                            add_tanker, add_bulk_carrier,   add_fishing_vessel, add_ferry,
                            add_tug,    add_inflatable_boat};
    kAdd[static_cast<std::size_t>(spec.kind)](builder, hull, design, random);
  }
  TriangleMesh mesh = builder.take();
  // Raised from the laden waterline, then trimmed about the origin, amidships on the water.
  const Vec3 rise(0, 0, design.laden_draught - design.draught);
  const Mat3 trim = axis_rotation(-design.trim, Vec3::UnitY());
  for (Vec3& p : mesh.vertices) p = trim * (p + rise);
  Ship ship{with_normals_on_grid(std::move(mesh)), 0};
  fill_normals(ship.mesh);
  // GM = KB + BM - KG.
  const Hydrostatics afloat = hydrostatics_of(ship.mesh);
  ship.centre_of_gravity_m = afloat.buoyancy_m.z() + afloat.transverse_bm_m - design.metacentric_height;
  return ship;
}

double ship_reach_m(const ShipSpec& spec) {
  Random random({spec.seed, Stream::kShip, static_cast<std::uint64_t>(spec.kind)});
  return 0.55 * design_of(spec, random).length + 5;
}

TriangleMesh make_combatant(ShipDetail detail) {
  MeshBuilder builder;
  add_combatant(builder, combatant_lines(144, 17.5), detail, 0.045);
  return with_normals_on_grid(builder.take());
}

}  // namespace seaglint
