// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/planar_faces.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

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

// True for a sample of a curved surface.
bool is_curved(const TriangleMesh& mesh, std::uint32_t t) { return normal_deviation(mesh, t) > kNormalDigits; }

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

// Exactly planar regions of triangles, joined to faces.
class FaceFinder {
 public:
  FaceFinder(const TriangleMesh& mesh, double tolerance, double exact)
      : mesh_(mesh),
        tolerance_(tolerance),
        topology_(topology_of(mesh)),
        regions_(mesh.triangles.size()),
        plane_(mesh.triangles.size()),
        members_(mesh.triangles.size()),
        face_(mesh.triangles.size(), kNoIndex) {
    for (std::uint32_t t = 0; t < count(); ++t) {
      for (const std::uint32_t g : topology_.neighbours[t]) {
        if (g != kNoIndex && g > t && alike(mesh, t, g) && coplanar(mesh, t, g, exact)) regions_.unite(t, g);
      }
    }
    for (std::uint32_t t = 0; t < count(); ++t) {
      const std::uint32_t region = regions_.find(t);
      members_[region].push_back(t);
      plane_[region].add(mesh, t);
    }
  }

  // Face of every triangle. The largest region comes first; of equal ones that with the smallest vertex.
  std::vector<std::uint32_t> run() {
    for (const std::uint32_t seed : regions_by_size()) {
      if (face_[members_[seed].front()] != kNoIndex || !(plane_[seed].total > 0)) continue;
      for (const std::uint32_t region : regions_of_face(seed)) {
        for (const std::uint32_t t : members_[region]) face_[t] = seed;
      }
    }
    for (std::uint32_t t = 0; t < count(); ++t) {
      if (face_[t] == kNoIndex) face_[t] = t;
    }
    return face_;
  }

 private:
  std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }

  std::vector<std::uint32_t> regions_by_size() const {
    std::vector<std::uint32_t> seeds;
    std::vector<std::tuple<double, double, double, double>> key(count());  // minus the area, smallest vertex
    for (std::uint32_t region = 0; region < count(); ++region) {
      if (members_[region].empty()) continue;
      seeds.push_back(region);
      Vec3 first = mesh_.vertices[mesh_.triangles[members_[region].front()][0]];
      for (const std::uint32_t t : members_[region]) {
        for (const std::uint32_t v : mesh_.triangles[t]) {
          if (position_key(mesh_.vertices[v]) < position_key(first)) first = mesh_.vertices[v];
        }
      }
      key[region] = std::tuple_cat(std::tuple(-plane_[region].total), position_key(first));
    }
    std::ranges::sort(seeds, {}, [&](std::uint32_t region) { return key[region]; });
    return seeds;
  }

  // Regions in the plane of the regions found so far, until no further one lies in it.
  std::vector<std::uint32_t> regions_of_face(std::uint32_t seed) {
    std::vector<std::uint32_t> own{seed};
    for (std::size_t before = 0; own.size() > before;) {
      before = own.size();
      Plane fit;
      for (const std::uint32_t region : own) fit.add(plane_[region]);
      std::vector<std::uint32_t> found = regions_in_plane(seed, fit);
      if (found.size() > before) own = std::move(found);
    }
    return own;
  }

  // Regions without a face that are connected to the seed and lie in a plane, the seed first.
  std::vector<std::uint32_t> regions_in_plane(std::uint32_t seed, const Plane& plane) {
    const Vec3 n = plane.normal(), centroid = plane.moment / plane.total;
    std::vector<std::uint32_t> found{seed};
    std::set<std::uint32_t> known{seed};
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (const std::uint32_t t : members_[found[i]]) {
        for (const std::uint32_t g : topology_.neighbours[t]) {
          if (g == kNoIndex || face_[g] != kNoIndex || !alike(mesh_, g, t)) continue;
          const std::uint32_t region = regions_.find(g);
          if (known.contains(region) || !lies_in_plane(region, n, centroid)) continue;
          known.insert(region);
          found.push_back(region);
        }
      }
    }
    return found;
  }

  bool lies_in_plane(std::uint32_t region, const Vec3& n, const Vec3& centroid) const {
    return std::ranges::all_of(members_[region], [&](std::uint32_t t) {
      const Vec3 area = area_vector(mesh_, t);
      return area.dot(n) > kSameSide * area.norm() && std::ranges::all_of(mesh_.triangles[t], [&](std::uint32_t v) {
               return std::abs(n.dot(mesh_.vertices[v] - centroid)) <= tolerance_;
             });
    });
  }

  const TriangleMesh& mesh_;
  double tolerance_;
  Topology topology_;
  DisjointSets regions_;
  std::vector<Plane> plane_;                         // of every region
  std::vector<std::vector<std::uint32_t>> members_;  // triangles of every region
  std::vector<std::uint32_t> face_;                  // of every triangle; kNoIndex: none yet
};

}  // namespace

PlanarFaces merge_planar_faces(const TriangleMesh& mesh, double tolerance) {
  PlanarFaces result{welded(mesh), {}};
  TriangleMesh& merged = result.mesh;
  if (merged.triangle_part.empty()) merged.triangle_part.assign(merged.triangles.size(), 0);
  if (merged.triangle_material.empty()) merged.triangle_material.assign(merged.triangles.size(), 0);
  if (merged.part_names.empty()) merged.part_names = {"all"};
  const Bounds box = bounds(merged);
  const double exact = kExact * std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  EditableMesh surface(merged, FaceFinder(merged, std::max(tolerance, exact), exact).run());
  for (std::uint32_t t = 0; t < merged.triangles.size(); ++t) {
    if (is_curved(merged, t)) surface.keep_vertices(t);
  }
  surface.remove_flat_vertices(std::max(tolerance, exact));
  surface.make_delaunay();
  surface.store(merged, result.face);
  return result;
}

}  // namespace seaglint
