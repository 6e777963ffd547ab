// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Kirchhoff's fields: plane waves as they stand in the mouth of a cavity, and what they send to its walls.

#include <span>

#include "sim/cavity/cavity_aperture.h"
#include "sim/cavity/wall_currents.h"
#include "sim/scattering/surfaces/footprint.h"
#include "sim/scattering/target/embree_scene.h"

namespace seaglint {

// Equivalent currents in the mouth, eta J = n x eta H and M = -n x E, times the square root of each cell's area: rows
// 4 i + {J across, J up, M across, M up}, one column for each field. Their inner product is the mouth's integral.
using ApertureFields = Eigen::MatrixXcd;

// The plane waves e^{jk r^.x} of unit strength from the antennas' directions, columns 2 i + {h, v}; zero in cells that
// look away from the antenna or from where `scene` hides it. radius: of the target, m.
ApertureFields incident_aperture_fields(std::span<const ApertureCell> aperture, double k,
                                        std::span<const BistaticGeometry> views, RadarBasis BistaticGeometry::*antenna,
                                        const RayScene& scene, double radius);

// Both tangential fields on the walls, rows of WallMatrix.
struct WallFields {
  WallMatrix incident_electric;  // E
  WallMatrix mfie_excitation;    // 2 n x eta H
};

WallFields wall_fields(std::span<const ApertureCell> aperture, std::span<const WallPatch> walls, double k,
                       const ApertureFields& fields, int threads, const StopFlag* stop);

}  // namespace seaglint
