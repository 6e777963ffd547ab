// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The currents on perfectly conducting walls of a cavity, from what falls on them: the magnetic-field integral
// equation.

#include <array>
#include <span>
#include <vector>

#include "sim/cavity/wall_patches.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// One row for each tangent of each patch, 2 i + t; one column for each field that falls on the walls.
using WallMatrix = Eigen::MatrixXcf;

class WallCurrents {
 public:
  // k: 1/m. Patches that follow each other in `walls` should be neighbours and go from the openings inwards: what one
  // sweep through them leaves to the next is then little.
  WallCurrents(std::span<const WallPatch> walls, double k, int threads, const StopFlag* stop);

  // The eta J of J = 2 n x H + 2 n x PV integral of grad G x J' dS', in the unit of `mfie_excitation` = 2 n x eta H. A
  // column's residual times its strength (> 0) is at most kResidual of the strongest one's. Throws WorkError when that
  // takes too many sweeps, Interrupted when *stop becomes true.
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
  std::vector<Eigen::PartialPivLU<WallMatrix>> own_;  // of each block alone
};

}  // namespace seaglint
