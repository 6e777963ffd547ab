// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What an open cavity in a perfect conductor returns, from the field inside instead of rays (README.md).

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/parallel.h"
#include "sim/geometry/triangle_mesh.h"
#include "sim/scattering/embree_scene.h"
#include "sim/scattering/footprint.h"
#include "sim/scattering/scatterer.h"

namespace seaglint {

struct CavitySize {
  double mouth_m2 = 0, walls_m2 = 0;
  std::size_t patches = 0;  // of the walls
  int fields = 0;           // in the mouth that were solved
};

inline constexpr double kPatchesPerWavelength = 6;

class Cavity {
 public:
  // `part` of the mesh (an index into part_names): the cavity's walls, perfectly conducting, whose free edges are its
  // rims. `whole`: the target it belongs to, which may stand before the mouth. Walls are cut into patches of a wavelength
  // over patches_per_wavelength (README.md, "Accuracy").
  Cavity(const TriangleMesh& mesh, std::size_t part, const Scatterer& whole, double patches_per_wavelength = kPatchesPerWavelength);

  // hh, hv, vh, vv (received, transmitted) in metres for each pair of antennas, phase origin at the body's origin; to be
  // added to what the rest of the target returns, without what leaves the walls. Throws InputError for walls that are
  // closed, too large for the wavelength, or face outwards; Interrupted when *stop becomes true.
  std::vector<std::array<Complex, 4>> scattering_matrices(double k, std::span<const AntennaPair> views, int threads,
                                                          const StopFlag* stop = nullptr, CavitySize* size = nullptr) const;

 private:
  TriangleMesh walls_;
  RayScene scene_;
  double radius_;
  double patches_per_wavelength_;
};

}  // namespace seaglint
