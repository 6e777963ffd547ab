// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/scatterer.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/geometry/surface/facets.h"

namespace seaglint {

namespace {

// Distance from the centre of a surface's sphere within which a larger surface is of the same body, in its radii. The
// ship's brackets hang up to 1.6 radii from the walls that they belong to.
constexpr double kReach = 2;

// Number of the surface of every facet, in order of their first facets.
std::vector<std::int32_t> surfaces(std::span<const Facet> facets) {
  std::vector<std::pair<const Vec3*, std::uint32_t>> corners;
  corners.reserve(3 * facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    for (const Vec3& corner : facets[f].corner) corners.emplace_back(&corner, f);
  }
  std::ranges::sort(
      corners, [](const auto& a, const auto& b) { return std::ranges::lexicographical_compare(*a.first, *b.first); });
  DisjointSets sets(facets.size());
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (*corners[i].first == *corners[i - 1].first) sets.unite(corners[i].second, corners[i - 1].second);
  }
  std::vector<std::int32_t> number(facets.size(), -1), of_facet;
  std::int32_t count = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    std::int32_t& own = number[sets.find(f)];
    if (own < 0) own = count++;
    of_facet.push_back(own);
  }
  return of_facet;
}

struct Surface {
  Sphere sphere;
  bool open = false;
};

double distance_to_side(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double fraction = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - fraction * (b - a)).norm();
}

double distance_to_panel(const Vec3& x, const BvhPanel& panel) {
  const std::span<const Vec3> outline = panel.outline();
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    inside = inside && panel.normal.cross(b - a).dot(x - a) >= 0;
    nearest = std::min(nearest, distance_to_side(x, a, b));
  }
  return inside ? std::abs(panel.normal.dot(x) - panel.offset) : nearest;
}

// Calls visit(panel) for every panel that reaches into the sphere.
template <typename Visit>
void panels_in(const Sphere& sphere, const PanelBvh& tree, const Visit& visit) {
  const auto from = [&](int axis) { return sphere.centre[axis] - sphere.radius; };
  const auto to = [&](int axis) { return sphere.centre[axis] + sphere.radius; };
  Prism box;
  box.along = box.normal = Vec3::UnitX();
  box.offset = from(0);
  box.across = {Vec3::UnitY(), Vec3::UnitZ()};
  box.lower = {from(1), from(2)};
  box.upper = {to(1), to(2)};
  box.wave = Vec3::Zero();  // no panel faces away
  tree.traverse(box, [&](const BvhPanel& panel) {
    if (distance_to_panel(sphere.centre, panel) <= sphere.radius) visit(panel);
    return to(0);
  });
}

}  // namespace

BodySizes body_sizes(std::span<const Facet> facets, const PanelBvh& tree) {
  BodySizes sizes{surfaces(facets), {}};
  const auto count = static_cast<std::size_t>(*std::ranges::max_element(sizes.surface_of) + 1);
  std::vector<std::vector<Vec3>> corners(count);
  std::vector<Surface> surface(count);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto own = static_cast<std::size_t>(sizes.surface_of[f]);
    corners[own].insert(corners[own].end(), facets[f].corner.begin(), facets[f].corner.end());
    surface[own].open = surface[own].open || facets[f].two_sided;
  }
  for (std::size_t i = 0; i < count; ++i) surface[i].sphere = bounding_sphere(corners[i]);

  // Surfaces of one kind are united with those that they reach; pairs of a closed and an open one are decided by size
  // afterwards.
  DisjointSets bodies(count);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> mixed;  // closed, open
  for (std::uint32_t own = 0; own < count; ++own) {
    panels_in({surface[own].sphere.centre, kReach * surface[own].sphere.radius}, tree, [&](const BvhPanel& panel) {
      const auto other = static_cast<std::uint32_t>(sizes.surface_of[static_cast<std::size_t>(panel.facet)]);
      if (other == own || surface[other].sphere.radius < surface[own].sphere.radius) return;
      if (surface[other].open == surface[own].open) {
        bodies.unite(own, other);
      } else {
        const auto pair = surface[own].open ? std::pair{other, own} : std::pair{own, other};
        if (mixed.empty() || mixed.back() != pair) mixed.push_back(pair);
      }
    });
  }
  const auto largest = [&](DisjointSets& sets) {
    std::vector<double> radius(count, 0);  // by representative
    for (std::uint32_t i = 0; i < count; ++i)
      radius[sets.find(i)] = std::max(radius[sets.find(i)], surface[i].sphere.radius);
    return radius;
  };
  const std::vector<double> radius = largest(bodies);
  DisjointSets joined = bodies;
  for (const auto& [closed, open] : mixed) {
    if (radius[bodies.find(open)] <= radius[bodies.find(closed)]) joined.unite(open, closed);
  }
  const std::vector<double> of_body = largest(joined);
  for (std::uint32_t i = 0; i < count; ++i) sizes.radius.push_back(of_body[joined.find(i)]);
  return sizes;
}

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
// and convex wedges of two opaque faces; none at submerged faces and lenses.
bool diffracts_with(const MaterialSpec& a, const MaterialSpec& b, const SharpEdge& edge) {
  if (ends_beams(a.kind) || ends_beams(b.kind)) return false;
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

double merging_tolerance(double highest_hz) {
  return std::exp2(std::floor(std::log2(kSpeedOfLight / highest_hz / 2000)));
}

}  // namespace seaglint
