// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What an open cavity in a perfect conductor returns, from the field inside instead of rays (README.md).

#include <array>
#include <span>
#include <vector>

#include "sim/cavity/cavity_aperture.h"
#include "sim/cavity/wall_patches.h"
#include "sim/core/process/parallel.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/response/scattering_matrix.h"
#include "sim/scattering/surfaces/footprint.h"
#include "sim/scattering/target/embree_scene.h"
#include "sim/scattering/target/scatterer.h"

namespace seaglint {

struct CavitySize {
  double aperture_m2 = 0, walls_m2 = 0;
  std::size_t patches = 0;  // of the walls
};

inline constexpr double kPatchesPerWavelength = 6;

class Cavity {
 public:
  // `part` of the mesh (an index into part_names): the cavity's walls, perfectly conducting, whose free edges are its
  // rims. `whole`: the target it belongs to, which may stand before the mouth. Walls are cut into patches of a
  // wavelength over patches_per_wavelength (README.md, "Accuracy").
  Cavity(const TriangleMesh& mesh, std::size_t part, const Scatterer& whole,
         double patches_per_wavelength = kPatchesPerWavelength);

  // Throws InputError for walls that are closed, face outwards, are too large for the wavelength or too near each other
  // or the mouth, and for a mouth below half a wavelength. k: 1/m.
  CavitySize size(double k) const;

  // hh, hv, vh, vv (received, transmitted) in metres for each pair of antennas, phase origin at the body's origin; to
  // be added to what the rest of the target returns, without what leaves the walls. Throws as size() does, WorkError
  // when the currents do not settle, and Interrupted when *stop becomes true.
  std::vector<std::array<Complex, 4>> scattering_matrices(double k, std::span<const BistaticGeometry> views,
                                                          int threads, const StopFlag* stop = nullptr) const;

 private:
  struct Discretisation {
    std::vector<ApertureCell> aperture;
    std::vector<WallPatch> walls;
  };
  Discretisation shape(double k) const;

  TriangleMesh walls_;
  RayScene scene_;
  double radius_;
  double patches_per_wavelength_;
};

}  // namespace seaglint
