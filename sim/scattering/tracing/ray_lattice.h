// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Lattice of parallel rays over the projection of a target, in square tiles that are traced one by one: coarse cells,
// which are halved where their rays differ, and rays aimed at every panel.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/geometry/polygon_set.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/scatterer/scatterer.h"

namespace seaglint {

// Square of the projection plane; its side is the finest spacing times 2^(kHalvings - level).
struct LatticeCell {
  int level = 0;  // 0 <= x <= kHalvings
  std::int64_t column = 0, row = 0;
};

class RayLattice {
 public:
  static constexpr int kHalvings = 3;            // of a coarse cell, down to the spacing
  static constexpr std::int64_t kTileSide = 64;  // coarse cells along a side of a tile
  static constexpr double kMaxRays = 1e10;       // of one direction

  // basis: projection plane. spacing_m: of the finest rays. Tiles that no facet overlaps are left out. Throws
  // InputError where more than kMaxRays rays of that spacing fit over the target.
  RayLattice(const Scatterer& scatterer, const RadarBasis& basis, double spacing_m);

  std::size_t tiles() const { return tiles_.size(); }
  // Square of the projection plane that a tile covers, at rest when the look direction changes.
  PolygonSet window(std::size_t tile) const;
  // Coarse cell i, j of a tile, 0 <= i, j < kTileSide.
  LatticeCell cell(std::size_t tile, std::int64_t i, std::int64_t j) const;
  // Point of the projection plane at which the ray of a cell crosses it, m: at a place in the cell that is random but a
  // function of the cell alone. A long feature narrower than the spacing is met somewhere along its length.
  Vec2 ray(const LatticeCell& cell) const;
  // The quarter of a cell, of the next level, that contains the point.
  LatticeCell quarter(const LatticeCell& cell, const Vec2& p) const;
  // Rays to points of the panels in a tile that face the antenna: their middles, and along the sides of flat ones.
  std::span<const Vec2> aimed(std::size_t tile) const;

 private:
  struct Tile {
    std::int64_t column = 0, row = 0;
    std::size_t first = 0, last = 0;  // of aimed_
  };
  double tile_side() const { return static_cast<double>(kTileSide) * cell_side(0); }
  double cell_side(int level) const { return spacing_ * static_cast<double>(1 << (kHalvings - level)); }
  void aim_at_panels(const Scatterer& scatterer, const RadarBasis& basis, std::int64_t columns,
                     std::span<const std::int32_t> tile_at);

  double spacing_;
  Vec2 lower_ = Vec2::Zero();  // of the lattice, m
  std::vector<Tile> tiles_;    // by rows
  std::vector<Vec2> aimed_;    // by tile
};

}  // namespace seaglint
