// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Surface currents on the perfectly conducting walls of a cavity for given excitations, by the magnetic-field integral
// equation.

#include <Eigen/LU>
#include <array>
#include <span>
#include <vector>

#include "sim/cavity/wall_patches.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// One row per patch and tangent, 2 i + t; one column per excitation.
using WallMatrix = Eigen::MatrixXcf;

class WallCurrents {
 public:
  // k: 1/m. Consecutive patches in `walls` should be adjacent and ordered from the apertures inwards, for fast
  // convergence of the sweeps.
  WallCurrents(std::span<const WallPatch> walls, double k, int threads, const StopFlag* stop);

  // Solves for eta J: J = 2 n x H + 2 n x PV integral of grad G x J' dS', in the unit of `mfie_excitation` = 2 n x eta
  // H. The residual of a column times its strength (> 0) is at most kResidual of that of the strongest. Throws
  // WorkError when this needs too many iterations, Interrupted when *stop becomes true.
  WallMatrix solve(const WallMatrix& driven, const Eigen::VectorXd& strength, int threads, const StopFlag* stop) const;

  static constexpr double kResidual = 1e-3;

 private:
  struct Rows;  // of patches

  std::size_t blocks() const;
  Rows block(std::size_t i) const;
  WallMatrix coupling(const Rows& to, const Rows& from) const;
  WallMatrix apply_diagonal_blocks(const WallMatrix& x, int threads) const;
  WallMatrix half_sweep(const WallMatrix& x, bool upwards, int threads, const StopFlag* stop) const;

  std::size_t patches_;
  double k_;
  Eigen::ArrayXf area_;  // of the patches, m^2
  Eigen::ArrayX3f centre_, normal_;
  std::array<Eigen::ArrayX3f, 2> tangent_;
  std::vector<Eigen::PartialPivLU<WallMatrix>> own_;  // of the diagonal blocks
};

}  // namespace seaglint
