// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering of an open-ended cavity in a perfect conductor, from the interior field by an integral equation instead of
// beam tracing (README.md).

#include <array>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/scatterer/embree_scene.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

struct CavitySize {
  double aperture_m2 = 0, walls_m2 = 0;
  std::size_t patches = 0;  // of the walls
};

inline constexpr double kPatchesPerWavelength = 6;

class Cavity {
 public:
  // part: index into part_names of the perfectly conducting cavity walls, whose free edges are the rims. whole: the
  // complete target, which may shadow the aperture. The walls are divided into patches of wavelength /
  // patches_per_wavelength (README.md, "Accuracy").
  Cavity(const TriangleMesh& mesh, std::size_t part, const Scatterer& whole,
         double patches_per_wavelength = kPatchesPerWavelength);

  // Throws InputError for walls that are closed, face outwards, are too large for the wavelength or too close to each
  // other or to the aperture, and for an aperture narrower than half a wavelength. k: 1/m.
  CavitySize size(double k) const;

  // hh, hv, vh, vv (received, transmitted) in metres for each bistatic geometry, phase origin at the body's origin; to
  // be added to the response of the rest of the target, without contributions of the walls. Throws as size(), WorkError
  // when the currents do not converge, Interrupted when *stop becomes true.
  std::vector<std::array<Complex, 4>> scattering_matrices(double k, std::span<const BistaticGeometry> views,
                                                          int threads, const StopFlag* stop = nullptr) const;

 private:
  struct Discretisation;  // of aperture and walls
  Discretisation shape(double k) const;

  Vec3 centre_;         // of the complete target, body frame
  TriangleMesh walls_;  // relative to it
  RayScene scene_;
  double radius_;
  double patches_per_wavelength_;
};

}  // namespace seaglint
