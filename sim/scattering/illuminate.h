// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shooting and bouncing rays, with polygons in place of ray cells: rays find which sequences of facets the radar
// lights, the polygons of those facets measure exactly what is lit and seen (sim/scattering/README.md). The result
// holds for every frequency.

#include <functional>
#include <span>
#include <vector>

#include "sim/scattering/facets.h"
#include "sim/scattering/footprint.h"
#include "sim/scattering/ray_scene.h"

namespace seaglint {

struct IlluminationSettings {
  double ray_spacing_m = 0;  // of the rays that look for facet sequences; 0 = default_ray_spacing
  int max_bounces = 8;       // 1 <= x <= 64
};

// A target ready to be lit from any direction: its facets and the ray tracer's tree. Built once per mesh; safe to share
// between threads.
class Scatterer {
 public:
  // Throws InputError when no triangle of the mesh has an area.
  explicit Scatterer(const TriangleMesh& mesh);

  std::span<const Facet> facets() const { return facets_; }
  const RayScene& rays() const { return rays_; }
  double radius() const { return radius_; }  // of the bounding sphere about the body's origin, m

 private:
  std::vector<Facet> facets_;
  RayScene rays_;
  double radius_ = 0;
};

// A hundredth of the target's radius, m.
double default_ray_spacing(const Scatterer& scatterer);

// What one direction lights, tile by tile of the aperture. Tiles are independent and may be lit in any order by any
// thread.
class Illumination {
 public:
  Illumination(const Scatterer& scatterer, const RadarBasis& basis, const IlluminationSettings& settings);

  std::size_t tiles() const { return static_cast<std::size_t>(columns_) * rows_; }
  const RadarBasis& basis() const { return basis_; }

  // The footprints of one tile; rays, when given, is raised by the number of rays traced.
  std::vector<Footprint> light(std::size_t tile, std::size_t* rays = nullptr) const;

 private:
  const Scatterer& scatterer_;
  RadarBasis basis_;
  IlluminationSettings settings_;
  Vec2 lower_ = Vec2::Zero();  // of the tight window round the target's projection
  Vec2 tile_size_ = Vec2::Zero();
  int columns_ = 1, rows_ = 1;
  int rays_across_ = 16, rays_up_ = 16;  // per tile
};

}  // namespace seaglint
