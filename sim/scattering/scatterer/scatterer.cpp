// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/scatterer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/bounding_sphere.h"
#include "sim/geometry/mesh/planar_faces.h"

namespace seaglint {
namespace {

// Distance from a common plane within which neighbouring triangles are one planar face, relative to the target's
// radius: the rounding of single-precision coordinates.
constexpr double kPlanar = 6e-8;

// Centre of the smallest sphere about the vertices that triangles use, rounded to a power of two of 2^-20 to 2^-21 of
// its radius, so that the origin of a symmetric body stays in place.
Vec3 centre_of(const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      if (!std::exchange(used[v], 1)) points.push_back(mesh.vertices[v]);
    }
  }
  const Sphere sphere = bounding_sphere(points);
  if (!(sphere.radius > 0)) return Vec3::Zero();
  const double step = std::ldexp(1.0, std::ilogb(sphere.radius) - 20);
  return (sphere.centre / step).rounded() * step;
}

double radius_of(std::span<const Facet> facets) {
  double radius = 0;
  for (const Facet& facet : facets) {
    for (const Vec3& corner : facet.corner) radius = std::max(radius, corner.norm());
  }
  return radius;
}

double radius_of(const TriangleMesh& mesh) {
  double radius = 0;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) radius = std::max(radius, mesh.vertices[v].norm());
  }
  return radius;
}

// Facets of the mesh as it is, without its normals, or of its planar faces triangulated anew, with those normals that
// describe a surface.
std::vector<Facet> facets_of(TriangleMesh mesh, bool as_meshed) {
  if (as_meshed || !normals_describe_surface(mesh)) mesh.corner_normals.clear();
  if (as_meshed) return make_facets(mesh);
  const PlanarFaces faces = merge_planar_faces(mesh, kPlanar * radius_of(mesh));
  return make_facets(faces.mesh, faces.face);
}

SmoothSides smooth_sides(std::span<const Facet> facets, std::optional<double> crease_rad) {
  if (crease_rad) return smooth_sides_by_angle(facets, *crease_rad);
  const bool given = std::ranges::any_of(facets, [](const Facet& facet) {
    return std::ranges::any_of(facet.corner_normal, [](const Vec3& n) { return !n.isZero(0); });
  });
  return given ? smooth_sides_by_normals(facets) : smooth_sides_by_shape(facets, radians(kDefaultCreaseDeg));
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

// True where both facets of an edge belong to one smooth surface, whose two vertices there they have in common.
bool is_inside_surface(const SmoothSurface& surface, const SharpEdge& edge) {
  const CurvedFacet *a = surface.curved(edge.facet[0]), *b = surface.curved(edge.facet[1]);
  if (edge.is_free_edge() || !a || !b) return false;
  return std::ranges::count_if(a->vertex, [&](std::int32_t v) { return std::ranges::count(b->vertex, v) > 0; }) == 2;
}

}  // namespace

struct Scatterer::RaySceneOnDemand {
  std::mutex making;
  std::optional<RayScene> scene;
};

const RayScene& Scatterer::ray_scene() const {
  const std::lock_guard lock(ray_scene_->making);
  if (!ray_scene_->scene) ray_scene_->scene.emplace(facets_);
  return *ray_scene_->scene;
}

Scatterer::Scatterer(const TriangleMesh& mesh, std::vector<MaterialSpec> materials, std::optional<double> crease_rad,
                     double sheet_thickness_m, double merging_m)
    : Scatterer(centred(mesh, crease_rad, merging_m), std::move(materials), crease_rad, sheet_thickness_m) {}

Scatterer::CentredSurface Scatterer::centred(const TriangleMesh& mesh, std::optional<double> crease_rad,
                                             double merging_m) {
  const Vec3 centre = centre_of(mesh);
  std::vector<Facet> facets = facets_of(transformed(mesh, Mat3::Identity(), -centre), crease_rad.has_value());
  SmoothSides smooth = smooth_sides(facets, crease_rad);
  if (crease_rad) merging_m = 0;
  return {centre, merge_smooth_facets(std::move(facets), std::move(smooth), merging_m)};
}

// Surfaces that rise above their facets by less than 1e-7 of the radius count as flat: it is the rounding of
// single-precision coordinates, 7 um on the 144 m ship, 0.3 deg of phase at 16 GHz.
Scatterer::Scatterer(CentredSurface of, std::vector<MaterialSpec> materials, std::optional<double> crease_rad,
                     double sheet_thickness_m)
    : centre_(of.centre),
      facets_(std::move(of.surface.facets)),
      radius_(radius_of(facets_)),
      sheet_thickness_(sheet_thickness_m),
      surface_(facets_, of.surface.smooth, 1e-7 * radius_),
      panels_(facets_, surface_),
      edges_(find_sharp_edges(facets_, crease_rad.value_or(0) > 0 ? *crease_rad : radians(kDefaultCreaseDeg),
                              sheet_thickness_)),
      tree_(facets_, panels_),
      bodies_(body_sizes(facets_, tree_)),
      materials_(std::move(materials)),
      ray_scene_(std::make_shared<RaySceneOnDemand>()) {
  for (const Facet& facet : facets_) {
    SEAGLINT_CHECK(materials_.empty() || facet.material < materials_.size(),
                   fmt::format("material {} of {}", facet.material, materials_.size()));
  }
  if (facets_.empty()) throw InputError("the mesh has no triangle with an area: nothing scatters");
  for (auto& sides : edges_.edges_of_facet) {
    for (int& edge : sides) {
      if (edge == kNoEdge) continue;
      SharpEdge& wedge = edges_.edges[edge];
      if (is_inside_surface(surface_, wedge)) edge = kNoEdge;
      if (edge == kNoEdge || materials_.empty()) continue;
      const MaterialSpec &a = materials_[facets_[wedge.facet[0]].material],
                         &b = materials_[facets_[wedge.facet[1]].material];
      wedge.conducts = a.kind == SurfaceKind::kPec && b.kind == SurfaceKind::kPec;
      if (!wedge.conducts && !diffracts_with(a, b, wedge)) edge = kNoEdge;
    }
  }
  index_by_panel(edges_, facets_, panels_);
}

}  // namespace seaglint
