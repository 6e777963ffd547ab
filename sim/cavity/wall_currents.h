// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Walls of a cavity: their division into patches of nearly uniform size, independent of the triangulation, and the
// surface currents on the perfectly conducting patches for given excitations, by the magnetic-field integral equation.

#include <array>
#include <span>
#include <vector>

#include "sim/core/numbers/dense.h"
#include "sim/core/process/parallel.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct WallPatch {
  Vec3 centre;                  // m, body frame
  Vec3 normal;                  // unit, into the cavity
  std::array<Vec3, 2> tangent;  // unit, orthogonal; tangent[0] x tangent[1] = normal
  double area = 0;              // m^2
};

// Patches of about size x size. Triangles are subdivided into pieces of a third of `size` and clustered about seeds
// about `size` apart, which are then moved to the centroids of their clusters (Lloyd, IEEE Trans. IT-28, 1982,
// 129-137). The distance includes the difference of the normals, so that patches end at edges of the walls. Throws
// InputError for more than kMaxPatches.
std::vector<WallPatch> wall_patches(const TriangleMesh& walls, double size);

// At this number the currents take a quarter of an hour per frequency on two cores, and a few GB.
inline constexpr std::size_t kMaxPatches = 20'000;

// One row per patch and tangent, 2 i + t; one column per excitation.
using WallMatrix = ComplexFloatMatrix;

class WallCurrents {
 public:
  // k: 1/m. Consecutive patches in `walls` should be adjacent and ordered from the apertures inwards, for fast
  // convergence of the sweeps.
  WallCurrents(std::span<const WallPatch> walls, double k, int threads, const StopFlag* stop);

  // Solves for eta J: J = 2 n x H + 2 n x PV integral of grad G x J' dS', in the unit of `mfie_excitation` = 2 n x eta
  // H. The residual of a column times its strength (> 0) is at most kResidual of that of the strongest. Throws
  // WorkError when this needs too many iterations, Interrupted when *stop becomes true.
  WallMatrix solve(const WallMatrix& driven, std::span<const double> strength, int threads, const StopFlag* stop) const;

  static constexpr double kResidual = 1e-3;

 private:
  using PatchValues = std::vector<float>;  // one number per patch
  using PatchVectors = std::array<PatchValues, 3>;
  struct Patches;  // a range of them

  std::size_t blocks() const;
  Patches block(std::size_t i) const;
  WallMatrix coupling(const Patches& to, const Patches& from) const;
  WallMatrix apply_diagonal_blocks(const WallMatrix& x, int threads) const;
  WallMatrix half_sweep(const WallMatrix& x, bool upwards, int threads, const StopFlag* stop) const;

  std::size_t patches_;
  double k_;
  PatchValues area_;  // m^2
  PatchVectors centre_, normal_;
  std::array<PatchVectors, 2> tangent_;
  std::vector<LuFactors> own_;  // of the diagonal blocks
};

}  // namespace seaglint
