// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sequences of reflectors that the rays of one tile meet, found by Embree, and the panels between a reflector and a
// receiver.

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scattering/scatterer/embree_scene.h"
#include "sim/scattering/tracing/interaction.h"

namespace seaglint {

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
