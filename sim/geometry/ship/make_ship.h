// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Meshes of ships by kind, each with individual variation by its seed; no particular ships.

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Body frame, origin amidships on the centreline at the waterline z = 0, underwater body included. Every part is closed
// and faces outwards, with normals where the surface is smooth; adjacent parts overlap slightly, so that no two faces
// coincide. Materials of assets/materials: pec, window_glass, rubber_tube, grp_sheet and human_body.
struct Ship {
  TriangleMesh mesh;
  double centre_of_gravity_m = 0;  // height above the waterline
};

// Deterministic: equal specs give equal meshes. Throws InputError, "KEY: value ...", for a value that is out of the
// range of its kind.
Ship make_ship(const ShipSpec& spec);

// Radius about the origin within which the ship is, m, without its mesh being made: 10 % more than half its length and
// 5 m.
double ship_reach_m(const ShipSpec& spec);

// The combatant of assets: the frigate's reference ship above the waterline, where it is cut and closed.
TriangleMesh make_combatant(ShipDetail detail = ShipDetail::kRails);

}  // namespace seaglint
