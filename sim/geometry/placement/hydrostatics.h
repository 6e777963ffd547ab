// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hydrostatics of a body at rest with the mean water surface at z = 0: volume, waterplane, centres, metacentres.

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Body frame, SI. All are zero for a mesh without a waterline, or with no volume below it.
struct Hydrostatics {
  double volume_m3 = 0;               // below the water
  double wetted_m2 = 0;               // surface below the water
  double length_m = 0, beam_m = 0;    // of the waterline
  double draught_m = 0;               // depth of the lowest point
  double waterplane_m2 = 0;           // area of the waterline's section
  double flotation_x_m = 0;           // centroid of the waterplane
  Vec3 buoyancy_m = Vec3::Zero();     // centroid of the volume; KB = draught_m + z
  double transverse_bm_m = 0;         // BM = I / V, I about the x axis through the centroid of the waterplane
  double longitudinal_bm_m = 0;       // about the y axis
  double block_coefficient = 0;       // V / (L B T)
  double waterplane_coefficient = 0;  // A / (L B)

  // GM = KB + BM - KG for a centre of gravity at this height above the water, m.
  double metacentric_height_m(double centre_of_gravity_m) const {
    return buoyancy_m.z() + transverse_bm_m - centre_of_gravity_m;
  }
};

// Integrals over the surface below z = 0 by the divergence theorem (Gauss) with fields that vanish at z = 0 or have no
// divergence, so that the waterplane itself is not needed: V = int z dA_z, waterplane A = -int dA_z, its moments
// likewise. Exact for a mesh of closed, oriented surfaces that do not overlap below the water.
Hydrostatics hydrostatics_of(const TriangleMesh& mesh);

}  // namespace seaglint
