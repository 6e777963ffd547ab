// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Rays of a lattice over the projection of a target, and the sequences of reflectors that they meet, found by Embree.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/geometry/moving_polygon.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/scatterer/embree_scene.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

// Square of the projection plane; its side is the finest spacing times 2^(kHalvings - level).
struct LatticeCell {
  int level = 0;  // 0 <= x <= kHalvings
  std::int64_t column = 0, row = 0;
};

// Parallel rays over the projection of a target, in square tiles that are traced one by one: coarse cells, which are
// halved where their rays differ, and rays aimed at every panel.
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

// All rays of the tile with the same sequence of reflectors, up to this one. They are parallel before and behind it, as
// flat reflectors leave them.
struct RayPath {
  std::int32_t facet = -1;  // first facet of the last reflector
  std::int32_t parent = 0;  // sequence without it
  std::uint8_t bounce = 0;  // number of reflections; 0: the transmitted rays
  std::int32_t first_child = -1, next_sibling = -1;
  ImageTransform image_transform;  // of all reflectors, this one included
  Vec3 direction;                  // behind it, unit
  // The ray that crosses the projection plane at p leaves the panel at start + p.x per_h + p.y per_v, m, displaced
  // along the normal so far that Embree does not return the same panel.
  Vec3 start, per_h, per_v;

  Vec3 leaves_at(const Vec2& p) const { return start + p.x() * per_h + p.y() * per_v; }
};

// A panel between a reflector and a receiver.
struct Obstacle {
  std::int32_t path = 0;  // whose last reflector it hides from the receiver, in part at least
  std::int32_t receiver = 0;
  std::int32_t facet = -1;  // first facet of its panel

  auto operator<=>(const Obstacle&) const = default;  // NOLINT(modernize-use-nullptr): compares with 0
};

// Rays of one tile, traced in any number of batches; start() begins the next tile and keeps the memory.
class RayPaths {
 public:
  // The scene must outlive the object.
  explicit RayPaths(const TracingContext& scene);

  void start();
  // Follows the rays that cross the projection plane at these points up to the last reflection of the settings, and
  // from every reflector towards all receivers that may see it. signatures[i]: equal for rays that meet the same
  // reflectors and obstacles, different for others (but for 2^-64).
  void trace(std::span<const Vec2> rays, std::span<std::uint64_t> signatures);
  // To be called once after the last batch.
  void finish();
  // True where rays of this direction illuminate the panel, unless another is before it.
  bool is_lit(int facet, const Vec3& direction) const;

  // Of the present tile; 0: the transmitted rays.
  const RayPath& path(int i) const { return paths_[static_cast<std::size_t>(i)]; }
  std::span<const Obstacle> obstacles(int path, std::size_t receiver) const;
  // Rays that Embree traced, of all tiles, and its processor time for them, s.
  std::size_t queries() const { return queries_; }
  double embree_seconds() const { return embree_s_; }

 private:
  // Rays of one sequence that go on: a range of rays_.
  struct Bundle {
    std::int32_t path = 0;
    std::size_t first = 0, count = 0;
  };

  void first_hits();
  void reflect(std::span<std::uint64_t> signatures);
  void group_by_child(const Bundle& bundle);
  void mark_children(std::int32_t path);
  std::int32_t path_after(std::int32_t parent, int panel);
  void find_obstacles(std::span<const Vec2> rays, std::span<std::uint64_t> signatures);

  const TracingContext& scene_;
  std::span<const Facet> facets_;
  const RayScene& embree_;
  double off_surface_;  // displacement of a ray's start from the panel, m
  std::vector<RayPath> paths_;
  std::vector<Obstacle> obstacles_;  // ascending
  std::vector<std::uint32_t> rays_, next_rays_;
  std::vector<Bundle> bundles_, next_bundles_;
  RayBatch batch_;
  std::vector<int> hits_;
  std::vector<std::int32_t> child_;           // of each ray of a bundle
  std::vector<std::int32_t> place_of_child_;  // its bundle in next_bundles_, by path; -1: none
  std::vector<std::int32_t> child_of_panel_;  // of the bundle `bundle_of_panel_`, by first facet
  std::vector<std::int32_t> bundle_of_panel_;
  std::size_t queries_ = 0;
  double embree_s_ = 0;
};

}  // namespace seaglint
