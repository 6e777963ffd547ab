// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/coinciding_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

// Largest distance of coinciding faces from a common plane, relative to half the diagonal of the mesh: the rounding of
// six digits. The thinnest plates that are drawn with a thickness are a hundred times thicker.
constexpr double kSamePlane = 1e-6;
// Part of a triangle's area that may be left uncovered.
constexpr double kUncovered = 1e-4;
// Largest distance between the diagonals of one quad, relative to the shorter diagonal. A tetrahedron has 0.7.
constexpr double kWarp = 0.1;

constexpr std::size_t kMostSubtracted = 100;  // polygons from one triangle
// Bounds of time and memory: means over all triangles of those near one and of those that overlap it. Meshes have 15
// and at most 4.
constexpr std::size_t kMostNear = 1000, kMostOverlaps = 30;

using Polygon = std::vector<Vec2>;  // convex, counter-clockwise

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// The part of a polygon to the left (sign = 1) or right (sign = -1) of the line from u to v (I. Sutherland and G.
// Hodgman, Communications of the ACM 17, 1974, 32-42).
Polygon clipped(const Polygon& polygon, const Vec2& u, const Vec2& v, double sign) {
  const Vec2 along = v - u;
  const auto height = [&](const Vec2& p) { return sign * (along.x() * (p.y() - u.y()) - along.y() * (p.x() - u.x())); };
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ha = height(a), hb = height(b);
    if (ha >= 0) part.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) part.push_back(a + ha / (ha - hb) * (b - a));
  }
  return part;
}

// Replaces disjoint polygons by what a convex polygon does not cover of them.
void subtract(std::vector<Polygon>& polygons, const Polygon& cover) {
  std::vector<Polygon> left;
  for (Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < cover.size() && polygon.size() > 2; ++i) {
      const Vec2 &u = cover[i], &v = cover[(i + 1) % cover.size()];
      Polygon outside = clipped(polygon, u, v, -1);
      if (area_of(outside) > 0) left.push_back(std::move(outside));
      polygon = clipped(polygon, u, v, 1);
    }
  }
  polygons = std::move(left);
}

struct Box {
  Vec3 lower, upper;

  bool overlaps(const Box& other) const {
    return lower.cwiseMin(other.upper) == lower && other.lower.cwiseMin(upper) == other.lower;
  }
};

// Boxes in a binary tree, split at the median of their centres.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes.empty()) build(0, static_cast<std::uint32_t>(boxes.size()));
  }

  // Calls use(i) for every box i that overlaps this one.
  template <typename Use>
  void find(const Box& box, const Use& use) const {
    std::array<std::uint32_t, 64> pending;
    std::size_t count = 0;
    if (!nodes_.empty()) pending[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[pending[--count]];
      if (!node.box.overlaps(box)) continue;
      if (node.right == 0) {
        for (std::uint32_t i = node.first; i < node.end; ++i)
          if (boxes_[order_[i]].overlaps(box)) use(order_[i]);
        continue;
      }
      pending[count++] = node.right;
      pending[count++] = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
    }
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, end;
    std::uint32_t right = 0;  // second child, the first follows its parent; 0: a leaf
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t end) {
    constexpr std::uint32_t kLeaf = 4;
    Box all = boxes_[order_[first]];
    for (std::uint32_t i = first + 1; i < end; ++i) {
      all.lower = all.lower.cwiseMin(boxes_[order_[i]].lower);
      all.upper = all.upper.cwiseMax(boxes_[order_[i]].upper);
    }
    const auto own = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({all, first, end});
    if (end - first <= kLeaf) return own;
    const std::size_t axis = (all.upper - all.lower).longest_axis();
    const auto centre = [&](std::uint32_t i) { return boxes_[i].lower[axis] + boxes_[i].upper[axis]; };
    const std::uint32_t middle = first + (end - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair{centre(a), a} < std::pair{centre(b), b};
                     });
    build(first, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[own].right = right;
    return own;
  }

  std::span<const Box> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

class CoincidenceFinder {
 public:
  CoincidenceFinder(const TriangleMesh& mesh, const CoincidenceSettings& settings) : mesh_(mesh), settings_(settings) {
    area_.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      area_.push_back(area_vector(mesh, t));
      const auto& [a, b, c] = mesh.triangles[t];
      const bool is_left_out = !settings.left_out.empty() && settings.left_out[t];
      if (a != b && b != c && c != a && !is_left_out) used_.push_back(t);
    }
    const Bounds box = bounds(mesh);
    tolerance_ = kSamePlane * (box.upper - box.lower).norm() / 2;
    covered_as_quad_.assign(mesh.triangles.size(), 0);
  }

  CoincidingFaces run() {
    if (settings_.quads) {
      find_quads();
    } else {
      find_overlaps();
    }
    if (!found_.is_crowded) choose();
    return std::move(found_);
  }

 private:
  const Vec3& corner(std::uint32_t t, std::size_t i) const { return mesh_.vertices[mesh_.triangles[t][i]]; }

  double longest_side(std::uint32_t t) const {
    return std::max({(corner(t, 1) - corner(t, 0)).norm(), (corner(t, 2) - corner(t, 1)).norm(),
                     (corner(t, 0) - corner(t, 2)).norm()});
  }

  // The triangle in the plane normal to n that contains the origin, counter-clockwise about its own normal.
  Polygon projected(std::uint32_t t, const Vec3& origin, const Vec3& u, const Vec3& v) const {
    Polygon polygon;
    for (std::size_t i = 0; i < 3; ++i)
      polygon.emplace_back((corner(t, i) - origin).dot(u), (corner(t, i) - origin).dot(v));
    if (area_of(polygon) < 0) std::swap(polygon[1], polygon[2]);
    return polygon;
  }

  // True where a triangle lies in the plane of another one.
  bool is_in_plane(std::uint32_t t, const Vec3& normal, const Vec3& point) const {
    return std::ranges::all_of(mesh_.triangles[t], [&](std::uint32_t v) {
      return std::abs(normal.dot(mesh_.vertices[v] - point)) <= tolerance_;
    });
  }

  // Area of the overlap of two triangles of opposite orientation, m^2; 0 for others.
  double overlap(std::uint32_t a, std::uint32_t b) const {
    const Vec3 &area_a = area_[a], &area_b = area_[b];
    if (!(area_a.dot(area_b) < 0)) return 0;
    const double long_a = longest_side(a), long_b = longest_side(b);
    // The plane of the wider triangle is the better known one.
    const bool a_is_wider = area_a.norm() / long_a >= area_b.norm() / long_b;
    const Vec3 n = (a_is_wider ? area_a : area_b).normalized(), u = n.unitOrthogonal(), v = n.cross(u);
    if (!is_in_plane(a_is_wider ? b : a, n, corner(a_is_wider ? a : b, 0))) return 0;
    Polygon common = projected(a, corner(a, 0), u, v);
    const Polygon other = projected(b, corner(a, 0), u, v);
    for (std::size_t i = 0; i < 3 && common.size() > 2; ++i) common = clipped(common, other[i], other[(i + 1) % 3], 1);
    const double area = area_of(common), rounding = 4 * tolerance_ * std::min(long_a, long_b);
    return area > rounding ? area : 0;
  }

  void add(std::uint32_t a, std::uint32_t b, double area) {
    if (mesh_.triangle_material[a] != mesh_.triangle_material[b]) {
      unlike_.push_back({a, b, area});
      return;
    }
    switch (settings_.kind(a, b)) {
      case Coincidence::kSheet: overlaps_.push_back({a, b, area}); break;
      case Coincidence::kSheetOnBody: on_bodies_.emplace_back(a, b); break;
      case Coincidence::kBodyUnderSheet: on_bodies_.emplace_back(b, a); break;
      case Coincidence::kBodies: break;
    }
  }

  void find_overlaps() {
    std::vector<Box> boxes;
    boxes.reserve(used_.size());
    for (const std::uint32_t t : used_) {
      const Vec3 &p = corner(t, 0), &q = corner(t, 1), &r = corner(t, 2);
      const Vec3 margin = Vec3::Constant(2 * tolerance_);
      boxes.push_back({p.cwiseMin(q).cwiseMin(r) - margin, p.cwiseMax(q).cwiseMax(r) + margin});
    }
    const BoxTree tree(boxes);
    std::size_t near = 0;
    for (std::uint32_t i = 0; i < used_.size(); ++i) {
      tree.find(boxes[i], [&](std::uint32_t j) {
        ++near;
        if (j <= i) return;
        const double area = overlap(used_[i], used_[j]);
        if (area > 0) add(used_[i], used_[j], area);
      });
      found_.is_crowded =
          near > kMostNear * used_.size() + 10'000'000 ||
          overlaps_.size() + unlike_.size() + on_bodies_.size() > kMostOverlaps * used_.size() + 100'000;
      if (found_.is_crowded) return;
    }
  }

  // Quads p s q r, drawn as p q r and q p s from one side and as q s r and p r s from the other.
  void find_quads() {
    const IndexGroups at_vertex(used_.size(), mesh_.vertices.size(),
                                [&](std::uint32_t i) { return std::ranges::min(mesh_.triangles[used_[i]]); });
    const auto find = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      for (const std::uint32_t i : at_vertex[std::min({a, b, c})]) {
        const auto& [p, q, r] = mesh_.triangles[used_[i]];
        if ((p == a && q == b && r == c) || (p == b && q == c && r == a) || (p == c && q == a && r == b))
          return used_[i];
      }
      return kNoIndex;
    };
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(used_.size());
    for (const std::uint32_t t : used_) triangles.push_back(mesh_.triangles[t]);
    const std::vector<EdgeUse> sides = sides_by_edge(triangles, mesh_.vertices.size());
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
      if (sides[i].vertices != sides[i + 1].vertices || sides[i].side.forward == sides[i + 1].side.forward) continue;
      const auto apex = [&](const HalfEdge& side) { return triangles[side.triangle][(side.side + 2) % 3]; };
      const HalfEdge &one = sides[i].side, &two = sides[i + 1].side;
      const std::uint32_t p = triangles[one.triangle][one.side], q = triangles[one.triangle][(one.side + 1) % 3],
                          r = apex(one), s = apex(two);
      // Every quad is found from both sides.
      if (r == s || std::min(p, q) > std::min(r, s)) continue;
      const std::uint32_t first = find(q, s, r);
      if (first == kNoIndex || !is_flat(p, q, r, s)) continue;
      const std::uint32_t second = find(p, r, s);
      if (second == kNoIndex) continue;
      // One side of it, not a border between both.
      if (!(area_[used_[one.triangle]].dot(area_[used_[two.triangle]]) > 0)) continue;
      const std::array<std::uint32_t, 4> quad{used_[one.triangle], used_[two.triangle], first, second};
      const auto material = [&](std::uint32_t t) { return mesh_.triangle_material[t]; };
      const bool alike = std::ranges::all_of(quad, [&](std::uint32_t t) { return material(t) == material(first); });
      if (!alike || settings_.kind(quad[0], first) != Coincidence::kSheet) continue;
      for (const std::uint32_t t : quad) covered_as_quad_[t] = 1;
      for (std::size_t front = 0; front < 2; ++front) {
        for (std::size_t back = 2; back < 4; ++back)
          overlaps_.push_back({quad[front], quad[back], area_[quad[front]].norm() / 2});
      }
    }
  }

  // True where the diagonals pq and rs of a quad nearly meet.
  bool is_flat(std::uint32_t p, std::uint32_t q, std::uint32_t r, std::uint32_t s) const {
    const Vec3 one = mesh_.vertices[q] - mesh_.vertices[p], two = mesh_.vertices[s] - mesh_.vertices[r];
    const Vec3 n = one.cross(two);
    return std::abs(n.dot(mesh_.vertices[r] - mesh_.vertices[p])) <=
           kWarp * n.norm() * std::min(one.norm(), two.norm());
  }

  // True where the triangles that overlap this one cover it. Of many, which are small, the overlaps are added.
  bool is_covered(std::uint32_t t, std::span<const std::uint32_t> by) const {
    if (covered_as_quad_[t]) return true;
    double sum = 0;
    for (const std::uint32_t other : by) sum += overlap(t, other);
    if (sum < (1 - kUncovered) * area_[t].norm() - 4 * tolerance_ * longest_side(t)) return false;
    if (by.size() > kMostSubtracted) return true;
    const Vec3 area = area_[t], n = area.normalized(), u = n.unitOrthogonal(), v = n.cross(u);
    std::vector<Polygon> left{projected(t, corner(t, 0), u, v)};
    for (const std::uint32_t other : by) {
      subtract(left, projected(other, corner(t, 0), u, v));
      double rest = 0;
      for (const Polygon& polygon : left) rest += area_of(polygon);
      if (rest <= kUncovered * area.norm() + 4 * tolerance_ * longest_side(t)) return true;
    }
    return false;
  }

  void choose() {
    const std::size_t count = mesh_.triangles.size();
    DisjointSets sets(count);
    for (const FaceOverlap& o : overlaps_) sets.unite(o.a, o.b);
    std::vector<std::uint32_t> members;
    for (const FaceOverlap& o : overlaps_) members.insert(members.end(), {o.a, o.b});
    std::ranges::sort(members);
    members.erase(std::unique(members.begin(), members.end()), members.end());
    std::ranges::stable_sort(members, {}, [&](std::uint32_t t) { return sets.find(t); });

    // Both directions of every overlap, by triangle.
    Pairs others;
    for (const FaceOverlap& o : overlaps_) others.insert(others.end(), {std::pair{o.a, o.b}, {o.b, o.a}});
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());

    std::vector<char> removed(count, 0);
    for (std::size_t first = 0; first < members.size();) {
      std::size_t end = first;
      while (end < members.size() && sets.find(members[end]) == sets.find(members[first])) ++end;
      const std::span<const std::uint32_t> group(members.data() + first, end - first);
      for (const std::uint32_t t : backs_of(group, others)) removed[t] = 1;
      first = end;
    }
    std::ranges::sort(on_bodies_);
    for (auto at = on_bodies_.begin(); at != on_bodies_.end();) {
      const std::uint32_t t = at->first;
      const std::vector<std::uint32_t> by = partners(on_bodies_, t);
      if (is_covered(t, by)) removed[t] = 1;
      at += static_cast<std::ptrdiff_t>(by.size());
    }
    for (std::uint32_t t = 0; t < count; ++t) {
      if (!removed[t]) continue;
      found_.backs.push_back(t);
      found_.backs_m2 += area_[t].norm();
    }
    std::vector<std::uint32_t> partly;
    for (const FaceOverlap& o : overlaps_) {
      if (removed[o.a] || removed[o.b]) continue;
      partly.insert(partly.end(), {o.a, o.b});
      found_.partly_m2 += o.area;
    }
    std::ranges::sort(partly);
    found_.partly = static_cast<std::size_t>(std::unique(partly.begin(), partly.end()) - partly.begin());
    for (const FaceOverlap& o : unlike_) members.insert(members.end(), {o.a, o.b});
    std::ranges::sort(members);
    members.erase(std::unique(members.begin(), members.end()), members.end());
    found_.all = std::move(members);
    found_.unlike = std::move(unlike_);
  }

  // The second triangles of the pairs of a first one; the pairs ascend.
  static std::vector<std::uint32_t> partners(const Pairs& pairs, std::uint32_t t) {
    std::vector<std::uint32_t> found;
    for (auto at = std::ranges::lower_bound(pairs, std::pair{t, std::uint32_t{0}}); at != pairs.end() && at->first == t;
         ++at)
      found.push_back(at->second);
    return found;
  }

  // The covered triangles of one side of a connected overlap, whose triangles ascend.
  std::vector<std::uint32_t> backs_of(std::span<const std::uint32_t> group, const Pairs& others) const {
    const Vec3 front = area_[group[0]];
    std::array<std::vector<std::uint32_t>, 2> covered;  // of the first triangle's side, of the other one
    std::array<std::size_t, 2> all{0, 0};
    std::array<double, 2> area{0, 0};
    for (const std::uint32_t t : group) {
      const std::size_t side = area_[t].dot(front) > 0 ? 0 : 1;
      ++all[side];
      if (!is_covered(t, partners(others, t))) continue;
      covered[side].push_back(t);
      area[side] += area_[t].norm();
    }
    if (covered[1].size() == all[1]) return covered[1];
    if (covered[0].size() == all[0]) return covered[0];
    return area[1] >= area[0] ? covered[1] : covered[0];
  }

  const TriangleMesh& mesh_;
  const CoincidenceSettings& settings_;
  double tolerance_ = 0;               // m
  std::vector<Vec3> area_;             // area vectors of all triangles, m^2
  std::vector<std::uint32_t> used_;    // triangles
  std::vector<FaceOverlap> overlaps_;  // of one material
  std::vector<FaceOverlap> unlike_;    // of different materials
  Pairs on_bodies_;                    // triangle of an open surface, of a closed body
  std::vector<char> covered_as_quad_;  // by triangle
  CoincidingFaces found_;
};

}  // namespace

CoincidingFaces find_coinciding_faces(const TriangleMesh& mesh, const CoincidenceSettings& settings) {
  return CoincidenceFinder(mesh, settings).run();
}

}  // namespace seaglint
