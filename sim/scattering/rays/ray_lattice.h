// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lattice of parallel rays over the projection of a target, in square tiles that are traced one by one.

#include <cstdint>
#include <vector>

#include "sim/scattering/beams/bistatic_geometry.h"
#include "sim/scattering/beams/polygon_set.h"
#include "sim/scattering/target/scatterer.h"

namespace seaglint {

// One ray per square of the lattice, at a place in it that is random but a function of the square alone: a long feature
// narrower than the spacing is met somewhere along its length, whatever its direction.
class RayLattice {
 public:
  static constexpr std::int64_t kTileSide = 256;  // rays along a side of a tile
  static constexpr double kMaxRays = 1e10;        // of one direction

  // basis: projection plane. Tiles that no facet overlaps are left out. Throws InputError for more than kMaxRays rays
  // over the target.
  RayLattice(const Scatterer& scatterer, const RadarBasis& basis, double spacing_m);

  double spacing() const { return spacing_; }  // m
  std::size_t tiles() const { return tiles_.size(); }
  // Square of the projection plane that a tile covers, at rest when the look direction changes.
  PolygonSet window(std::size_t tile) const;
  // Points of the projection plane at which the rays of a tile cross it, m, neighbours next to each other.
  void rays_of(std::size_t tile, std::vector<Vec2>& rays) const;

 private:
  struct Tile {
    std::int64_t column = 0, row = 0;
  };
  Vec2 corner(const Tile& tile) const;

  double spacing_;
  Vec2 lower_ = Vec2::Zero();  // of the lattice, m
  std::vector<Tile> tiles_;    // by rows
};

}  // namespace seaglint
