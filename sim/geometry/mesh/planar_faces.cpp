// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/planar_faces.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/geometry/mesh/disjoint_sets.h"
#include "sim/geometry/mesh/editable_mesh.h"
#include "sim/geometry/mesh/index_groups.h"
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

  void add(const TriangleMesh& mesh, std::uint32_t t, const Vec3& area_of_t) {
    const auto& [i, j, k] = mesh.triangles[t];
    area += area_of_t;
    total += area_of_t.norm();
    moment += area_of_t.norm() / 3 * (mesh.vertices[i] + mesh.vertices[j] + mesh.vertices[k]);
  }
  void add(const Plane& other) {
    area += other.area;
    moment += other.moment;
    total += other.total;
  }
  Vec3 normal() const { return area.normalized(); }
  Vec3 centroid() const { return moment / total; }
};

// True for a sample of a curved surface.
bool is_curved(const TriangleMesh& mesh, std::uint32_t t) { return normal_deviation(mesh, t) > kNormalDigits; }

std::tuple<double, double, double> position_key(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

// Exactly planar regions of triangles, joined to faces. A region has the number of one of its triangles.
class FaceFinder {
 public:
  FaceFinder(const TriangleMesh& mesh, double tolerance, double exact)
      : mesh_(mesh),
        tolerance_(tolerance),
        neighbours_(topology_of(mesh).neighbours),
        area_(count()),
        curved_(count()),
        region_(find_regions(exact)),
        members_(count(), count(), [&](std::uint32_t t) { return region_[t]; }),
        plane_(count()),
        face_(count(), kNoIndex),
        found_in_(count(), 0) {
    for (std::uint32_t t = 0; t < count(); ++t) plane_[region_[t]].add(mesh, t, area_[t]);
  }

  // Face of every triangle. The largest region comes first; of equal ones that with the smallest vertex.
  std::vector<std::uint32_t> run() {
    std::vector<char> alone(count());  // by region: none beside it lies in its plane
    for (std::uint32_t region = 0; region < count(); ++region) alone[region] = is_alone(region);
    for (const std::uint32_t seed : regions_by_size()) {
      if (face_[seed] != kNoIndex || !(plane_[seed].total > 0)) continue;
      face_[seed] = seed;
      if (alone[seed]) continue;
      for (const std::uint32_t region : regions_of_face(seed)) face_[region] = seed;
    }
    std::vector<std::uint32_t> face(count());
    for (std::uint32_t t = 0; t < count(); ++t) face[t] = face_[region_[t]] == kNoIndex ? t : face_[region_[t]];
    return face;
  }

 private:
  std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }

  bool alike(std::uint32_t a, std::uint32_t b) const {
    return !curved_[a] && !curved_[b] && mesh_.triangle_part[a] == mesh_.triangle_part[b] &&
           mesh_.triangle_material[a] == mesh_.triangle_material[b];
  }

  // True where the smaller of two neighbouring triangles lies in the plane of the larger one.
  bool coplanar(std::uint32_t a, std::uint32_t b, double tolerance) const {
    const Vec3 &na = area_[a], &nb = area_[b];
    if (na.dot(nb) <= kSameSide * na.norm() * nb.norm()) return false;
    const bool swap = na.squaredNorm() < nb.squaredNorm();
    const std::uint32_t large = swap ? b : a, small = swap ? a : b;
    const Vec3 n = (swap ? nb : na).normalized();
    const Vec3& origin = mesh_.vertices[mesh_.triangles[large][0]];
    return std::ranges::all_of(mesh_.triangles[small], [&](std::uint32_t v) {
      return std::abs(n.dot(mesh_.vertices[v] - origin)) <= tolerance;
    });
  }

  // Exactly planar region of every triangle.
  std::vector<std::uint32_t> find_regions(double exact) {
    for (std::uint32_t t = 0; t < count(); ++t) {
      area_[t] = area_vector(mesh_, t);
      curved_[t] = is_curved(mesh_, t);
    }
    DisjointSets regions(count());
    for (std::uint32_t t = 0; t < count(); ++t) {
      for (const std::uint32_t g : neighbours_[t]) {
        if (g != kNoIndex && g > t && alike(t, g) && coplanar(t, g, exact)) regions.unite(t, g);
      }
    }
    std::vector<std::uint32_t> region(count());
    for (std::uint32_t t = 0; t < count(); ++t) region[t] = regions.find(t);
    return region;
  }

  // Place of every vertex in the order of their positions.
  std::vector<std::uint32_t> vertex_ranks() const {
    std::vector<std::pair<double, std::uint32_t>> sorted(mesh_.vertices.size());
    for (std::uint32_t v = 0; v < sorted.size(); ++v) sorted[v] = {mesh_.vertices[v].x(), v};
    std::ranges::sort(sorted, [&](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first
                                : position_key(mesh_.vertices[a.second]) < position_key(mesh_.vertices[b.second]);
    });
    std::vector<std::uint32_t> rank(sorted.size());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) rank[sorted[i].second] = i;
    return rank;
  }

  std::vector<std::uint32_t> regions_by_size() const {
    struct Sized {
      double area = 0;
      std::uint32_t smallest_vertex = kNoIndex, region = 0;
    };
    const std::vector<std::uint32_t> rank = vertex_ranks();
    std::vector<Sized> sized;
    for (std::uint32_t region = 0; region < count(); ++region) {
      if (members_[region].empty()) continue;
      sized.push_back({plane_[region].total, kNoIndex, region});
      for (const std::uint32_t t : members_[region]) {
        for (const std::uint32_t v : mesh_.triangles[t])
          sized.back().smallest_vertex = std::min(sized.back().smallest_vertex, rank[v]);
      }
    }
    std::ranges::sort(sized, [](const Sized& a, const Sized& b) {
      return a.area != b.area ? a.area > b.area : a.smallest_vertex < b.smallest_vertex;
    });
    std::vector<std::uint32_t> seeds;
    for (const Sized& each : sized) seeds.push_back(each.region);
    return seeds;
  }

  // Calls use(region) for every region beside this one that may be part of the same face, until it returns true; true
  // where it did.
  template <typename Use>
  bool any_beside(std::uint32_t region, const Use& use) const {
    return std::ranges::any_of(members_[region], [&](std::uint32_t t) {
      return std::ranges::any_of(neighbours_[t], [&](std::uint32_t g) {
        return g != kNoIndex && region_[g] != region && face_[region_[g]] == kNoIndex && alike(g, t) && use(region_[g]);
      });
    });
  }

  bool is_alone(std::uint32_t region) const {
    const Vec3 n = plane_[region].normal(), centroid = plane_[region].centroid();
    return !any_beside(region, [&](std::uint32_t other) { return lies_in_plane(other, n, centroid); });
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
    const Vec3 n = plane.normal(), centroid = plane.centroid();
    std::vector<std::uint32_t> found{seed};
    ++search_;
    found_in_[seed] = search_;
    for (std::size_t i = 0; i < found.size(); ++i) {
      any_beside(found[i], [&](std::uint32_t region) {
        if (found_in_[region] != search_ && lies_in_plane(region, n, centroid)) {
          found_in_[region] = search_;
          found.push_back(region);
        }
        return false;
      });
    }
    return found;
  }

  bool lies_in_plane(std::uint32_t region, const Vec3& n, const Vec3& centroid) const {
    return std::ranges::all_of(members_[region], [&](std::uint32_t t) {
      return area_[t].dot(n) > kSameSide * area_[t].norm() &&
             std::ranges::all_of(mesh_.triangles[t], [&](std::uint32_t v) {
               return std::abs(n.dot(mesh_.vertices[v] - centroid)) <= tolerance_;
             });
    });
  }

  const TriangleMesh& mesh_;
  double tolerance_;
  std::vector<std::array<std::uint32_t, 3>> neighbours_;
  std::vector<Vec3> area_;               // area vectors of the triangles, m^2
  std::vector<char> curved_;             // by triangle
  std::vector<std::uint32_t> region_;    // of every triangle
  IndexGroups members_;                  // triangles of every region
  std::vector<Plane> plane_;             // of every region
  std::vector<std::uint32_t> face_;      // of every region; kNoIndex: none yet
  std::vector<std::uint32_t> found_in_;  // last search that found the region
  std::uint32_t search_ = 0;
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
