// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A target as the solver keeps it, whatever the direction it is seen from.

#include <span>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/material/material.h"
#include "sim/scattering/target/facets.h"
#include "sim/scattering/target/panel_bvh.h"
#include "sim/scattering/target/panels.h"
#include "sim/scattering/target/sharp_edges.h"
#include "sim/scattering/target/smooth_surface.h"

namespace seaglint {

// A target ready to be lit from any direction: its facets, the smooth surface behind them, panels, sharp edges and the
// tree that beams are walked through. Built once per mesh; safe to share between threads.
class Scatterer {
 public:
  // materials[i] is what mesh.materials[i] is made of; none: all is perfect conductor. Facets that turn by less than
  // crease_rad (0..pi; 0 = all flat) belong to one smooth surface. Rims of open surfaces are those of sheets of
  // sheet_thickness_m. Throws InputError when no triangle of the mesh has an area.
  explicit Scatterer(const TriangleMesh& mesh, std::vector<MaterialSpec> materials = {},
                     double crease_rad = radians(kDefaultCreaseDeg), double sheet_thickness_m = 0);

  // Surface and panels look at the facets: they may move, not be copied.
  Scatterer(Scatterer&&) = default;
  Scatterer& operator=(Scatterer&&) = default;

  std::span<const Facet> facets() const { return facets_; }
  const SmoothSurface& surface() const { return surface_; }
  const Panels& panels() const { return panels_; }
  const PanelBvh& tree() const { return tree_; }
  const SharpEdges& edges() const { return edges_; }
  double sheet_thickness() const { return sheet_thickness_; }  // m
  double radius() const { return radius_; }                    // of the bounding sphere about the body's origin, m
  std::span<const MaterialSpec> materials() const { return materials_; }  // empty: all is perfect conductor

 private:
  std::vector<Facet> facets_;
  double radius_ = 0, sheet_thickness_ = 0;
  SmoothSurface surface_;
  Panels panels_;
  SharpEdges edges_;
  PanelBvh tree_;
  std::vector<MaterialSpec> materials_;
};

}  // namespace seaglint
