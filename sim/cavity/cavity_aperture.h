// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Apertures of a cavity, the surfaces that would close its walls, and their Kirchhoff fields: incident plane waves in
// the aperture, and the fields that they radiate to the walls.

#include <span>
#include <vector>

#include "sim/cavity/wall_currents.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/radiation/contribution.h"
#include "sim/scattering/scatterer/embree_scene.h"

namespace seaglint {

// Cell of an aperture, without the islands in it.
struct ApertureCell {
  Vec3 centre;      // m, body frame
  Vec3 inward;      // unit, into the cavity
  Vec3 across, up;  // unit, in the plane of the aperture; across x up = inward
  double area = 0;  // m^2
};

// Apertures of `walls`, whose triangles face into the cavity, divided into cells of `pitch` metres by one lattice per
// aperture. Throws InputError for walls that are closed, face out of the cavity, enclose no volume, or have
// non-manifold or inconsistent edges, and for a rim that is not plane to within a quarter of the pitch or touches
// itself.
std::vector<ApertureCell> aperture_cells(const TriangleMesh& walls, double pitch);

// Equivalent currents in the aperture, eta J = n x eta H and M = -n x E, times the square root of the cell area: rows 4
// i + {J across, J up, M across, M up}, one column per field. Their inner product is the integral over the aperture.
using ApertureFields = ComplexMatrix;

// Plane waves e^{jk r^.x} of unit amplitude from the directions of the antennas, columns 2 i + {h, v}; zero in cells
// that face away from the antenna or are hidden from it by `scene`. radius: of the target, m.
ApertureFields incident_aperture_fields(std::span<const ApertureCell> aperture, double k,
                                        std::span<const BistaticGeometry> views, RadarBasis BistaticGeometry::*antenna,
                                        const RayScene& scene, double radius);

// Tangential fields on the walls, rows as in WallMatrix.
struct WallFields {
  WallMatrix incident_electric;  // E
  WallMatrix mfie_excitation;    // 2 n x eta H
};

WallFields wall_fields(std::span<const ApertureCell> aperture, std::span<const WallPatch> walls, double k,
                       const ApertureFields& fields, int threads, const StopFlag* stop);

}  // namespace seaglint
