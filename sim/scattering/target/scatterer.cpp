// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/scatterer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

double radius_of(std::span<const Facet> facets) {
  double radius = 0;
  for (const Facet& facet : facets) {
    for (const Vec3& corner : facet.corner) radius = std::max(radius, corner.norm());
  }
  return radius;
}

bool is_air_backed(const MaterialSpec& material) {
  return material.kind == SurfaceKind::kLayers && material.backing == Backing::kAir;
}

// Edges of materials diffract where there is a coefficient for them: free edges of sheets, with air behind or opaque,
// and convex wedges of two opaque faces; none at submerged faces.
bool diffracts_with(const MaterialSpec& a, const MaterialSpec& b, const SharpEdge& edge) {
  if (a.kind == SurfaceKind::kSubmerged || b.kind == SurfaceKind::kSubmerged) return false;
  if (edge.is_free_edge()) return edge.two_sided;
  return !edge.two_sided && edge.front_wedge.N > 1 && !is_air_backed(a) && !is_air_backed(b);
}

}  // namespace

// Surfaces that rise above their facets by less than 1e-7 of the radius count as flat: it is the rounding of
// single-precision coordinates, 7 um on the 144 m ship, 0.3 deg of phase at 16 GHz.
Scatterer::Scatterer(const TriangleMesh& mesh, std::vector<MaterialSpec> materials, double crease_rad,
                     double sheet_thickness_m)
    : facets_(make_facets(mesh)),
      radius_(radius_of(facets_)),
      sheet_thickness_(sheet_thickness_m),
      surface_(facets_, crease_rad, 1e-7 * radius_),
      panels_(facets_, surface_),
      edges_(find_sharp_edges(facets_, crease_rad > 0 ? crease_rad : radians(kDefaultCreaseDeg), sheet_thickness_)),
      tree_(facets_, panels_),
      materials_(std::move(materials)) {
  for (const Facet& facet : facets_) {
    SEAGLINT_CHECK(materials_.empty() || facet.material < materials_.size(),
                   fmt::format("material {} of {}", facet.material, materials_.size()));
  }
  if (facets_.empty()) throw InputError("the mesh has no triangle with an area: nothing scatters");
  for (auto& sides : edges_.edges_of_facet) {
    for (int& edge : sides) {
      if (edge == kNoEdge || materials_.empty()) continue;
      SharpEdge& wedge = edges_.edges[edge];
      const MaterialSpec &a = materials_[facets_[wedge.facet[0]].material],
                         &b = materials_[facets_[wedge.facet[1]].material];
      wedge.conducts = a.kind == SurfaceKind::kPec && b.kind == SurfaceKind::kPec;
      if (!wedge.conducts && !diffracts_with(a, b, wedge)) edge = kNoEdge;
    }
  }
  index_by_panel(edges_, facets_, panels_);
}

}  // namespace seaglint
