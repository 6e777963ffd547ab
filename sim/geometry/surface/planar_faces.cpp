// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/surface/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

namespace {

// Smallest height of a triangle that a change may leave, relative to its longest side.
constexpr double kMinHeight = 1e-7;
// Relative to the sum of the terms of the incircle determinant, below which four vertices count as cocircular.
constexpr double kCocircular = 1e-9;

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  return (x - a - std::clamp((x - a).dot(e) / e.squaredNorm(), 0.0, 1.0) * e).norm();
}

bool has(const std::array<std::uint32_t, 3>& triangle, std::uint32_t v) {
  return triangle[0] == v || triangle[1] == v || triangle[2] == v;
}

std::uint32_t apex_of(const std::array<std::uint32_t, 3>& triangle, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t v : triangle) {
    if (v != a && v != b) return v;
  }
  return a;
}

// True when the triangle runs from a to b.
bool runs(const std::array<std::uint32_t, 3>& triangle, std::uint32_t a, std::uint32_t b) {
  for (int i = 0; i < 3; ++i) {
    if (triangle[i] == a && triangle[(i + 1) % 3] == b) return true;
  }
  return false;
}

// Triangles whose planar faces can be triangulated anew: removal of vertices by half-edge collapse and edge flips.
class EditableMesh {
 public:
  // `face`: planar face of every triangle, numbers below the count of triangles. Vertices at one position must be one
  // vertex.
  EditableMesh(const TriangleMesh& mesh, std::vector<std::uint32_t> face)
      : vertices_(mesh.vertices),
        triangles_(mesh.triangles),
        face_(std::move(face)),
        at_(mesh.vertices.size()),
        kept_(mesh.vertices.size(), 0) {
    std::vector<std::uint32_t> uses(vertices_.size(), 0);
    for (const Triangle& triangle : triangles_) {
      for (const std::uint32_t v : triangle) ++uses[v];
    }
    for (std::size_t v = 0; v < vertices_.size(); ++v) at_[v].reserve(uses[v]);
    face_normal_.assign(triangles_.size(), Vec3::Zero());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      Triangle& triangle = triangles_[t];
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) {
        triangle = {0, 0, 0};
        continue;
      }
      for (const std::uint32_t v : triangle) at_[v].push_back(t);
      face_normal_[face_[t]] += area_vector(mesh, t);
    }
    for (Vec3& normal : face_normal_) normal.normalize();
  }

  // The vertices of this triangle will not be removed.
  void keep_vertices(std::uint32_t triangle) {
    for (const std::uint32_t v : triangles_[triangle]) kept_[v] = 1;
  }

  // Removes vertices inside a face and vertices where exactly two collinear boundary edges of faces meet. A removed
  // vertex lies within `tolerance` (m) of the boundary edge that replaces its edges (H. Hoppe et al., Proc. SIGGRAPH
  // 1993, 19-26: edge collapse and its link condition).
  void remove_flat_vertices(double tolerance) {
    std::vector<std::uint32_t> order;
    for (bool changed = true; changed;) {
      order.clear();
      for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
        if (!kept_[v] && !at_[v].empty() && !is_corner(v)) order.push_back(v);
      }
      std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return is_before(a, b); });
      changed = false;
      for (const std::uint32_t v : order) changed |= !at_[v].empty() && remove_vertex(v, tolerance);
      if (changed) make_delaunay();
    }
  }

  // Flips edges inside faces until they are Delaunay triangulations constrained by the faces' boundaries (C. L. Lawson,
  // in Mathematical Software III, 1977, 161-194); ties as in merge_planar_faces().
  void make_delaunay() {
    std::vector<std::uint32_t> triangles_of_face(triangles_.size(), 0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) triangles_of_face[face_[t]] += is_alive(t);
    std::vector<Edge> open;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!is_alive(t) || triangles_of_face[face_[t]] == 1) continue;
      for (int i = 0; i < 3; ++i) open.push_back(std::minmax(triangles_[t][i], triangles_[t][(i + 1) % 3]));
    }
    std::ranges::sort(open);
    open.erase(std::unique(open.begin(), open.end()), open.end());
    // Lawson's flips end; the bound is for the rounding of nearly cocircular vertices.
    for (std::size_t flips = 0, most = 100 * open.size(); !open.empty() && flips < most;) {
      const auto [a, b] = open.back();
      open.pop_back();
      flips += flip_if_needed(a, b, open);
    }
  }

  // Replaces the triangles of the mesh, with parts, materials and the corner normals of unchanged triangles, and
  // numbers the faces from 0.
  void store(TriangleMesh& mesh, std::vector<std::uint32_t>& face) const {
    std::vector<std::uint32_t> number(triangles_.size(), kNoIndex);
    std::uint32_t faces = 0;
    const TriangleMesh before = mesh;
    mesh.clear_triangles();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!is_alive(t)) continue;
      mesh.add_like(before, t, triangles_[t], triangles_[t] == before.triangles[t] ? before.normals_of(t) : kNoNormals);
      if (number[face_[t]] == kNoIndex) number[face_[t]] = faces++;
      face.push_back(number[face_[t]]);
    }
  }

 private:
  using Triangle = std::array<std::uint32_t, 3>;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // ascending

  bool is_alive(std::uint32_t t) const { return triangles_[t][0] != triangles_[t][1]; }
  std::vector<std::uint32_t> triangles_at(std::uint32_t a, std::uint32_t b) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : at_[a]) {
      if (has(triangles_[t], b)) found.push_back(t);
    }
    return found;
  }
  // The two triangles of an edge; none where it has one or more than two.
  std::optional<std::array<std::uint32_t, 2>> two_triangles_at(std::uint32_t a, std::uint32_t b) const {
    std::array<std::uint32_t, 2> found{};
    std::size_t count = 0;
    for (const std::uint32_t t : at_[a]) {
      if (!has(triangles_[t], b)) continue;
      if (count == 2) return std::nullopt;
      found[count++] = t;
    }
    return count == 2 ? std::optional(found) : std::nullopt;
  }
  // Vertices joined to v, ascending.
  std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    found.reserve(2 * at_[v].size());
    for (const std::uint32_t t : at_[v]) {
      for (const std::uint32_t u : triangles_[t]) {
        if (u != v) found.push_back(u);
      }
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
  // True unless exactly two triangles of one face and of opposite sense share the edge.
  bool is_boundary(std::uint32_t a, std::uint32_t b) const {
    const auto sides = two_triangles_at(a, b);
    if (!sides) return true;
    const auto [t, g] = *sides;
    return face_[t] != face_[g] || runs(triangles_[t], a, b) == runs(triangles_[g], a, b);
  }
  // True where triangles that are alone in their face at v have more than two edges there: all are boundaries.
  bool is_corner(std::uint32_t v) const {
    std::array<std::uint32_t, 2> ends{};
    std::size_t count = 0;
    for (const std::uint32_t t : at_[v]) {
      if (std::ranges::any_of(at_[v], [&](std::uint32_t g) { return g != t && face_[g] == face_[t]; })) continue;
      for (const std::uint32_t u : triangles_[t]) {
        if (u == v || std::find(ends.begin(), ends.begin() + count, u) != ends.begin() + count) continue;
        if (count == 2) return true;
        ends[count++] = u;
      }
    }
    return false;
  }
  bool remove_vertex(std::uint32_t v, double tolerance) {
    std::vector<std::uint32_t> around = neighbours(v), ends;
    for (const std::uint32_t u : around) {
      if (is_boundary(v, u)) ends.push_back(u);
    }
    if (ends.empty()) {
      // Inside a face: any neighbour, in an order that does not depend on numbers.
      std::ranges::sort(around, [&](std::uint32_t a, std::uint32_t b) { return is_before(a, b); });
      return std::ranges::any_of(around, [&](std::uint32_t u) { return collapse(v, u); });
    }
    if (ends.size() != 2) return false;
    const Vec3 &x = vertices_[v], &a = vertices_[ends[0]], &b = vertices_[ends[1]];
    if ((a - x).dot(b - x) >= 0) return false;
    const Edge before = std::minmax(v, ends[0]), after = std::minmax(v, ends[1]);
    std::vector<Vec3> removed{x};
    for (const Edge& edge : {before, after}) {
      if (const auto at = removed_.find(edge); at != removed_.end())
        removed.insert(removed.end(), at->second.begin(), at->second.end());
    }
    if (!std::ranges::all_of(removed, [&](const Vec3& p) { return distance_to_segment(p, a, b) <= tolerance; }))
      return false;
    if (is_before(ends[1], ends[0])) std::swap(ends[0], ends[1]);
    if (!collapse(v, ends[0]) && !collapse(v, ends[1])) return false;
    removed_.erase(before);
    removed_.erase(after);
    removed_[std::minmax(ends[0], ends[1])] = std::move(removed);
    return true;
  }
  // Moves v to u, where no other triangle turns over or loses its area and the surface keeps its topology.
  bool collapse(std::uint32_t v, std::uint32_t u) {
    const std::vector<std::uint32_t> vanish = triangles_at(v, u);
    // Link condition: v and u have no common neighbours but the apexes of the triangles at their edge.
    std::vector<std::uint32_t> of_v = neighbours(v), of_u = neighbours(u), common;
    std::ranges::set_intersection(of_v, of_u, std::back_inserter(common));
    if (common.size() != vanish.size()) return false;
    for (const std::uint32_t t : at_[v]) {
      if (has(triangles_[t], u)) continue;
      std::array<Vec3, 3> corner;
      for (int i = 0; i < 3; ++i) corner[i] = vertices_[triangles_[t][i] == v ? u : triangles_[t][i]];
      const Vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
      const double longest = std::max({e1.squaredNorm(), e2.squaredNorm(), (corner[2] - corner[1]).squaredNorm()});
      if (!(e1.cross(e2).dot(face_normal_[face_[t]]) > kMinHeight * longest)) return false;
    }
    for (const std::uint32_t t : vanish) {
      for (const std::uint32_t w : triangles_[t]) std::erase(at_[w], t);
      triangles_[t] = {0, 0, 0};
    }
    for (const std::uint32_t t : at_[v]) {
      std::ranges::replace(triangles_[t], v, u);
      at_[u].push_back(t);
    }
    at_[v].clear();
    return true;
  }
  bool is_before(std::uint32_t a, std::uint32_t b) const {
    const Vec3 &x = vertices_[a], &y = vertices_[b];
    return std::tuple(x.x(), x.y(), x.z()) < std::tuple(y.x(), y.y(), y.z());
  }
  bool flip_if_needed(std::uint32_t a, std::uint32_t b, std::vector<Edge>& around) {
    const auto both = two_triangles_at(a, b);
    if (!both || face_[both->front()] != face_[both->back()]) return false;
    std::array<std::uint32_t, 2> sides = *both;
    if (!runs(triangles_[sides[0]], a, b)) std::swap(sides[0], sides[1]);
    if (!runs(triangles_[sides[0]], a, b) || !runs(triangles_[sides[1]], b, a)) return false;
    const std::uint32_t c = apex_of(triangles_[sides[0]], a, b), d = apex_of(triangles_[sides[1]], a, b);
    if (c == d || std::ranges::any_of(at_[c], [&](std::uint32_t t) { return has(triangles_[t], d); })) return false;
    const Vec3 &A = vertices_[a], &B = vertices_[b], &C = vertices_[c], &D = vertices_[d];
    // The new triangles c, a, d and d, b, c must have the face's sense.
    const Vec3& n = face_normal_[face_[sides[0]]];
    const double longest = std::max((B - A).squaredNorm(), (D - C).squaredNorm());
    if (!((A - C).cross(D - C).dot(n) > kMinHeight * longest) || !((B - D).cross(C - D).dot(n) > kMinHeight * longest))
      return false;
    // Angles at c and d opposite the edge: their sum exceeds pi where d is inside the circle through a, b, c.
    const double sin_c = (A - C).cross(B - C).dot(n), cos_c = (A - C).dot(B - C);
    const double sin_d = (B - D).cross(A - D).dot(n), cos_d = (B - D).dot(A - D);
    const double sum = sin_c * cos_d + cos_c * sin_d;
    const double scale = std::sqrt((sin_c * sin_c + cos_c * cos_c) * (sin_d * sin_d + cos_d * cos_d));
    if (sum > kCocircular * scale) return false;
    if (sum > -kCocircular * scale) {
      const auto lower = [&](std::uint32_t x, std::uint32_t y) { return is_before(x, y) ? x : y; };
      const std::uint32_t first = lower(lower(a, b), lower(c, d));
      if (first == a || first == b) return false;
    }
    triangles_[sides[0]] = {c, a, d};
    triangles_[sides[1]] = {d, b, c};
    std::erase(at_[b], sides[0]);
    std::erase(at_[a], sides[1]);
    at_[d].push_back(sides[0]);
    at_[c].push_back(sides[1]);
    for (const Edge edge : {std::minmax(c, a), std::minmax(a, d), std::minmax(d, b), std::minmax(b, c)})
      around.push_back(edge);
    return true;
  }

  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;  // removed ones have equal vertices
  std::vector<std::uint32_t> face_;
  std::vector<std::vector<std::uint32_t>> at_;  // triangles by vertex
  std::map<Edge, std::vector<Vec3>> removed_;   // vertices removed from boundary edges
  std::vector<char> kept_;                      // by vertex
  std::vector<Vec3> face_normal_;               // by triangle number of the face, unit
};

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
