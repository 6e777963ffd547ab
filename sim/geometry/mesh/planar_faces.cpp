// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/planar_faces.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "sim/geometry/mesh/disjoint_sets.h"
#include "sim/geometry/mesh/editable_mesh.h"
#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

// Distance from a common plane, relative to the extent of the mesh, below which triangles are exactly coplanar: some
// thousand roundings of double precision.
constexpr double kExact = 1e-12;
// Smallest cosine between the normals of a face: triangles folded back are not part of it.
constexpr double kSameSide = 0.9;

// Plane through the area-weighted centroid of a set of triangles.
struct Plane {
  Vec3 area = Vec3::Zero(), moment = Vec3::Zero();  // sums of area vectors, m^2, and of area times centroid, m^3
  double total = 0;                                 // m^2

  void add(const TriangleMesh& mesh, std::uint32_t t) {
    const Vec3 a = area_vector(mesh, t);
    const auto& [i, j, k] = mesh.triangles[t];
    area += a;
    total += a.norm();
    moment += a.norm() / 3 * (mesh.vertices[i] + mesh.vertices[j] + mesh.vertices[k]);
  }
  void add(const Plane& other) {
    area += other.area;
    moment += other.moment;
    total += other.total;
  }
  Vec3 normal() const { return area.normalized(); }
};

// True where a corner normal is off the triangle's own: a sample of a curved surface.
bool is_curved(const TriangleMesh& mesh, std::uint32_t t) {
  constexpr double kOff = 1e-3;  // rad, the digits of normals in files
  if (mesh.corner_normals.empty()) return false;
  const Vec3 own = area_vector(mesh, t).normalized();
  return std::ranges::any_of(mesh.corner_normals[t],
                             [&](const Vec3& n) { return !n.isZero(0) && (n - own).norm() > kOff; });
}

bool alike(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  return !is_curved(mesh, a) && !is_curved(mesh, b) && mesh.triangle_part[a] == mesh.triangle_part[b] &&
         mesh.triangle_material[a] == mesh.triangle_material[b];
}

// True where the smaller of two neighbouring triangles lies in the plane of the larger one.
bool coplanar(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, double tolerance) {
  const Vec3 na = area_vector(mesh, a), nb = area_vector(mesh, b);
  if (na.dot(nb) <= kSameSide * na.norm() * nb.norm()) return false;
  const bool swap = na.squaredNorm() < nb.squaredNorm();
  const std::uint32_t large = swap ? b : a, small = swap ? a : b;
  const Vec3 n = (swap ? nb : na).normalized();
  const Vec3& origin = mesh.vertices[mesh.triangles[large][0]];
  return std::ranges::all_of(mesh.triangles[small],
                             [&](std::uint32_t v) { return std::abs(n.dot(mesh.vertices[v] - origin)) <= tolerance; });
}

std::tuple<double, double, double> position_key(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

// Face of every triangle: exactly planar regions, joined to the largest plane they are within `tolerance` of.
std::vector<std::uint32_t> find_faces(const TriangleMesh& mesh, double tolerance, double exact) {
  const Topology topology = topology_of(mesh);
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  DisjointSets regions(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (const std::uint32_t g : topology.neighbours[t]) {
      if (g != kNoIndex && g > t && alike(mesh, t, g) && coplanar(mesh, t, g, exact)) regions.unite(t, g);
    }
  }
  std::vector<Plane> plane(count);
  std::vector<std::vector<std::uint32_t>> members(count);
  std::vector<Vec3> first(count, Vec3::Constant(std::numeric_limits<double>::infinity()));
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::uint32_t region = regions.find(t);
    if (members[region].empty()) seeds.push_back(region);
    members[region].push_back(t);
    plane[region].add(mesh, t);
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (position_key(mesh.vertices[v]) < position_key(first[region])) first[region] = mesh.vertices[v];
    }
  }
  std::ranges::sort(seeds, [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(-plane[a].total, position_key(first[a])) < std::tuple(-plane[b].total, position_key(first[b]));
  });
  std::vector<std::uint32_t> face(count, kNoIndex);
  // Regions of one material that hang together with the seed and lie in a plane, the seed first.
  const auto regions_in_plane = [&](std::uint32_t seed, const Plane& of) {
    const Vec3 n = of.normal(), centroid = of.moment / of.total;
    const auto fits = [&](std::uint32_t region) {
      return std::ranges::all_of(members[region], [&](std::uint32_t t) {
        return area_vector(mesh, t).dot(n) > kSameSide * area_vector(mesh, t).norm() &&
               std::ranges::all_of(mesh.triangles[t], [&](std::uint32_t v) {
                 return std::abs(n.dot(mesh.vertices[v] - centroid)) <= tolerance;
               });
      });
    };
    std::vector<std::uint32_t> found{seed};
    std::set<std::uint32_t> known{seed};
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (const std::uint32_t t : members[found[i]]) {
        for (const std::uint32_t g : topology.neighbours[t]) {
          if (g == kNoIndex || face[g] != kNoIndex || !alike(mesh, g, t)) continue;
          const std::uint32_t region = regions.find(g);
          if (!known.contains(region) && fits(region)) {
            known.insert(region);
            found.push_back(region);
          }
        }
      }
    }
    return found;
  };
  for (const std::uint32_t seed : seeds) {
    if (face[members[seed].front()] != kNoIndex || !(plane[seed].total > 0)) continue;
    // The plane of the regions found so far, until no further one lies in it.
    std::vector<std::uint32_t> own{seed};
    for (std::size_t before = 0; own.size() > before;) {
      before = own.size();
      Plane fit;
      for (const std::uint32_t region : own) fit.add(plane[region]);
      const std::vector<std::uint32_t> found = regions_in_plane(seed, fit);
      if (found.size() > before) own = found;
    }
    for (const std::uint32_t region : own) {
      for (const std::uint32_t t : members[region]) face[t] = seed;
    }
  }
  for (std::uint32_t t = 0; t < count; ++t) {
    if (face[t] == kNoIndex) face[t] = t;
  }
  return face;
}

}  // namespace

PlanarFaces merge_planar_faces(const TriangleMesh& mesh, double tolerance) {
  PlanarFaces result{welded(mesh), {}};
  TriangleMesh& merged = result.mesh;
  if (merged.triangle_part.empty()) merged.triangle_part.assign(merged.triangles.size(), 0);
  if (merged.triangle_material.empty()) merged.triangle_material.assign(merged.triangles.size(), 0);
  if (merged.part_names.empty()) merged.part_names = {"all"};
  const Bounds box = bounds(merged);
  const double exact = kExact * std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  EditableMesh surface(merged, find_faces(merged, std::max(tolerance, exact), exact));
  for (std::uint32_t t = 0; t < merged.triangles.size(); ++t) {
    if (is_curved(merged, t)) surface.keep_vertices(t);
  }
  surface.remove_flat_vertices(std::max(tolerance, exact));
  surface.make_delaunay();
  surface.store(merged, result.face);
  return result;
}

}  // namespace seaglint
