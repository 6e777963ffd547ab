// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Target geometry and materials of the solver, independent of the look direction.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/surface/facets.h"
#include "sim/geometry/surface/smooth_surface.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/scatterer/embree_scene.h"
#include "sim/scattering/scatterer/panel_bvh.h"
#include "sim/scattering/scatterer/panels.h"

namespace seaglint {

// Size of the body to which each facet belongs. A surface is a set of facets connected by common vertices. Where a
// surface at least as large comes nearer to the centre of its bounding sphere than twice its radius, both belong to one
// body, whose size is that of its largest surface: the parts of a ship, their fittings and rails. Open surfaces belong
// to a body of closed ones only where they are no larger: a piece of sea or ground about a closed body is a body of its
// own. Sizes turn and move with a target.
struct BodySizes {
  std::vector<std::int32_t> surface_of;  // by facet
  std::vector<double> radius;            // of the bounding sphere of its body's largest surface, m, by surface

  double at(int facet) const { return radius[static_cast<std::size_t>(surface_of[static_cast<std::size_t>(facet)])]; }
};

// The tree is that of the facets.
BodySizes body_sizes(std::span<const Facet> facets, const PanelBvh& tree);

// Facets, smooth surface, panels, sharp edges and the panel hierarchy of a target. Built once per mesh; safe to share
// between threads. Their coordinates are those of the mesh relative to centre(), so that no tolerance and no rounding
// depends on where a file has its origin; decompose() adds the phase of the origin (Observation::centre), an
// interval the motion of the centre.
class Scatterer {
 public:
  // materials[i]: material of mesh.materials[i]; empty: perfect conductor. crease_rad: adjacent facets whose normals
  // differ by less form one smooth surface, 0..pi; 0: all facets flat; absent: planar faces are triangulated anew and
  // the shape determines which facets form a smooth surface (smooth_sides_by_shape()). sheet_thickness_m: thickness of
  // open surfaces at their free edges, m. merging_m: tolerance to which facets of smooth surfaces are merged
  // (merge_smooth_facets()), m; 0, and with crease_rad: they stay as meshed. Throws InputError when every triangle is
  // degenerate.
  explicit Scatterer(const TriangleMesh& mesh, std::vector<MaterialSpec> materials = {},
                     std::optional<double> crease_rad = std::nullopt, double sheet_thickness_m = 0,
                     double merging_m = 0);

  // Movable only: surface and panels refer to the facets.
  Scatterer(Scatterer&&) = default;
  Scatterer& operator=(Scatterer&&) = default;

  std::span<const Facet> facets() const { return facets_; }
  const SmoothSurface& surface() const { return surface_; }
  const Panels& panels() const { return panels_; }
  const PanelBvh& tree() const { return tree_; }
  // Facets as an Embree scene, made at the first call.
  const RayScene& ray_scene() const;
  const SharpEdges& edges() const { return edges_; }
  double sheet_thickness() const { return sheet_thickness_; }  // m
  // Bounding sphere: its centre in the body frame, rounded to 1e-6 of its radius, and its radius about that, m.
  const Vec3& centre() const { return centre_; }
  double radius() const { return radius_; }
  // Size of the body of each facet, which determines the detail on it.
  const BodySizes& bodies() const { return bodies_; }
  std::span<const MaterialSpec> materials() const { return materials_; }  // empty: perfect conductor

 private:
  Vec3 centre_;
  std::vector<Facet> facets_;
  double radius_ = 0, sheet_thickness_ = 0;
  SmoothSurface surface_;
  Panels panels_;
  SharpEdges edges_;
  PanelBvh tree_;
  BodySizes bodies_;
  std::vector<MaterialSpec> materials_;
  struct RaySceneOnDemand;

  // A mesh about its centre.
  struct CentredSurface {
    Vec3 centre;
    MergedFacets surface;
  };
  static CentredSurface centred(const TriangleMesh& mesh, std::optional<double> crease_rad, double merging_m);
  Scatterer(CentredSurface of, std::vector<MaterialSpec> materials, std::optional<double> crease_rad,
            double sheet_thickness_m);

  std::shared_ptr<RaySceneOnDemand> ray_scene_;
};

// Tolerance for frequencies up to `highest_hz`, m: a 2000th to a 4000th of the wavelength, a two-way phase of 0.4 deg
// at most. With four times that a rounded cylinder, whose heights err alike along its length, changes its broadside
// echo by -34 dB in place of -58 and has 2 % fewer facets. A power of two, so that neighbouring bands have the same
// facets.
double merging_tolerance(double highest_hz);

}  // namespace seaglint
