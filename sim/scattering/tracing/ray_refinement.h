// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Adaptive rays of a tile: cells of the lattice are halved where their rays differ from those around, as long as that
// finds reflectors or obstacles not met there before.

#include <cstdint>
#include <vector>

#include "sim/scattering/tracing/ray_lattice.h"
#include "sim/scattering/tracing/ray_paths.h"

namespace seaglint {

class RayRefinement {
 public:
  // Both must outlive the object.
  RayRefinement(const RayLattice& lattice, RayPaths& paths) : lattice_(lattice), paths_(paths) {}

  // Traces all rays of the tile into the paths.
  void trace(std::size_t tile);

 private:
  // A cell with its ray and the signatures met in it and next to it, a range of known_.
  struct Cell {
    LatticeCell at;
    Vec2 ray;
    std::uint64_t signature = 0;
    std::size_t first_known = 0, last_known = 0;
  };

  void trace_coarse(std::size_t tile);
  void halve(const std::vector<Cell>& cells, std::vector<Cell>& next);
  void trace_rays();

  const RayLattice& lattice_;
  RayPaths& paths_;
  std::vector<Cell> cells_, quarters_;
  std::vector<std::uint64_t> known_, next_known_;
  std::vector<Vec2> rays_;
  std::vector<std::uint64_t> signatures_;
};

}  // namespace seaglint
