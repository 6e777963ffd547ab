// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/surface/smooth_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

// Smallest shape factor of a merged facet, unless those that it replaces are narrower: excludes triangles of nearly
// collinear vertices, whose normals are rounding.
constexpr double kMinShape = 0.3;
constexpr std::size_t kMaxRing = 32;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Triangle = std::array<std::uint32_t, 3>;

struct SurfacePoint {
  Vec3 position, normal;
};

// Triangle of vertices of the smooth surface, with the height of the surface above it as SmoothSurface has it.
struct CurvedTriangle {
  Vec3 a, normal;     // first corner, unit normal
  Vec3 to_b, to_c;    // dual basis of the sides a -> b, a -> c
  double ab, bc, ca;  // sagittas of the sides, m
  double shape;       // 4 sqrt(3) area / sum of squared sides: 1 for an equilateral one
  std::array<Vec3, 3> corner_normal;

  CurvedTriangle(const SurfacePoint& A, const SurfacePoint& B, const SurfacePoint& C)
      : a(A.position), corner_normal{A.normal, B.normal, C.normal} {
    const Vec3 e1 = B.position - A.position, e2 = C.position - A.position, e3 = C.position - B.position,
               across = e1.cross(e2);
    const double twice_area = across.norm();
    normal = across / twice_area;
    to_b = e2.cross(across) / (twice_area * twice_area);
    to_c = across.cross(e1) / (twice_area * twice_area);
    ab = (B.normal - A.normal).dot(e1) / 8;
    bc = (C.normal - B.normal).dot(e3) / 8;
    ca = (A.normal - C.normal).dot(-e2) / 8;
    shape = 2 * std::sqrt(3.0) * twice_area / (e1.squaredNorm() + e2.squaredNorm() + e3.squaredNorm());
  }

  bool is_tilted() const {
    static const double min_cosine = std::cos(kMaxFacetTilt);
    return std::ranges::any_of(corner_normal, [&](const Vec3& n) { return !(normal.dot(n) >= min_cosine); });
  }
  std::array<double, 3> barycentric(const Vec3& x) const {
    const double b = to_b.dot(x - a), c = to_c.dot(x - a);
    return {1 - b - c, b, c};
  }
  // Height of the point over the surface, m. at: its barycentric coordinates.
  double height_of(const Vec3& x, const std::array<double, 3>& at) const {
    const auto& [la, lb, lc] = at;
    return normal.dot(x - a) - 4 * (ab * la * lb + bc * lb * lc + ca * lc * la);
  }
};

class FacetMerger {
 public:
  FacetMerger(std::span<const Facet> facets, const SmoothSides& smooth, double tolerance)
      : facets_(facets),
        tolerance_(tolerance),
        triangles_(facets.size()),
        changed_(facets.size(), 0),
        first_removed_(facets.size(), kNone) {
    const SmoothVertices surface = smooth_vertices(facets, smooth);
    const std::size_t vertices = surface.normal.size();
    points_.resize(vertices);
    at_.resize(vertices);
    next_removed_.assign(vertices, kNone);
    open_.assign(vertices, 1);
    kept_.assign(vertices, 0);
    changed_in_.assign(vertices, 0);
    for (std::size_t v = 0; v < vertices; ++v) {
      points_[v].normal = surface.normal[v];
      at_[v].reserve(static_cast<std::size_t>(surface.first[v + 1] - surface.first[v]));
    }
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) triangles_[f][i] = static_cast<std::uint32_t>(surface.of_facet[f][i]);
    }
    for (std::size_t f = 0; f < facets.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = triangles_[f][i], w = triangles_[f][(i + 1) % 3];
        points_[v].position = facets[f].corner[i];
        at_[v].push_back(static_cast<std::uint32_t>(f));
        // Parts and materials keep their borders.
        const Facet& first = facets[at_[v].front()];
        if (facets[f].part != first.part || facets[f].material != first.material) kept_[v] = 1;
        if (smooth[f][i] >= 0) continue;
        kept_[v] = kept_[w] = 1;
        not_smooth_.push_back(std::minmax(v, w));
      }
    }
    std::ranges::sort(not_smooth_);
  }

  // Removes vertices until none can be removed; false where none could. In one round no two of neighbouring vertices
  // are removed, so that facets stay of similar size.
  bool run() {
    std::size_t all = 0;
    for (std::uint32_t round = 1;; ++round) {
      std::size_t removed = 0;
      for (std::uint32_t v = 0; v < kept_.size(); ++v) {
        if (kept_[v] || !open_[v] || changed_in_[v] == round) continue;
        open_[v] = 0;
        removed += remove_vertex(v, round);
      }
      if (removed == 0) return all > 0;
      all += removed;
    }
  }

  MergedFacets result() const {
    std::vector<char> touched(points_.size(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (changed_[t] && is_alive(t))
        for (const std::uint32_t v : triangles_[t]) touched[v] = 1;
    }
    TriangleMesh mesh;
    for (const SurfacePoint& point : points_) mesh.vertices.push_back(point.position);
    std::vector<std::uint32_t> face;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!is_alive(t)) continue;
      mesh.triangles.push_back(triangles_[t]);
      mesh.triangle_part.push_back(facets_[t].part);
      mesh.triangle_material.push_back(facets_[t].material);
      std::array<Vec3, 3> normal = facets_[t].corner_normal;
      for (std::size_t i = 0; i < 3; ++i) {
        if (touched[triangles_[t][i]]) normal[i] = points_[triangles_[t][i]].normal;
      }
      mesh.corner_normals.push_back(normal);
      face.push_back(changed_[t] ? kNone : static_cast<std::uint32_t>(facets_[t].face));
    }
    MergedFacets merged{make_facets(mesh, face), {}};
    SEAGLINT_CHECK(merged.facets.size() == mesh.triangles.size(),
                   fmt::format("{} of {} merged facets", merged.facets.size(), mesh.triangles.size()));
    merged.smooth.assign(merged.facets.size(), {-1, -1, -1});
    for (std::size_t f = 0; f < merged.facets.size(); ++f) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair<std::uint32_t, std::uint32_t> side =
            std::minmax(mesh.triangles[f][i], mesh.triangles[f][(i + 1) % 3]);
        if (!std::ranges::binary_search(not_smooth_, side)) merged.smooth[f][i] = merged.facets[f].neighbour[i];
      }
    }
    return merged;
  }

 private:
  bool is_alive(std::size_t t) const { return triangles_[t][0] != triangles_[t][1]; }

  CurvedTriangle curved(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return {points_[a], points_[b], points_[c]};
  }

  // Neighbours of v in the order of its triangles, counter-clockwise; false where they are not one ring.
  bool find_ring(std::uint32_t v) {
    const std::vector<std::uint32_t>& triangles = at_[v];
    const std::size_t n = triangles.size();
    if (n < 3 || n > kMaxRing) return false;
    std::array<std::pair<std::uint32_t, std::uint32_t>, kMaxRing> side;
    for (std::size_t i = 0; i < n; ++i) {
      const Triangle& t = triangles_[triangles[i]];
      const std::size_t own = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      side[i] = {t[(own + 1) % 3], t[(own + 2) % 3]};
    }
    ring_.assign(1, side[0].first);
    for (std::size_t step = 0; step + 1 < n; ++step) {
      const auto* next =
          std::find_if(side.begin(), side.begin() + n, [&](const auto& s) { return s.first == ring_.back(); });
      if (next == side.begin() + n || next->second == ring_.front()) return false;
      ring_.push_back(next->second);
    }
    return std::any_of(side.begin(), side.begin() + n,
                       [&](const auto& s) { return s.first == ring_.back() && s.second == ring_.front(); });
  }

  bool are_joined(std::uint32_t u, std::uint32_t w) const {
    return std::ranges::any_of(at_[u], [&](std::uint32_t t) { return std::ranges::count(triangles_[t], w) > 0; });
  }

  // Replaces the triangles around v by a fan from one of its neighbours, the one that gives the best shapes.
  bool remove_vertex(std::uint32_t v, std::uint32_t round) {
    if (!find_ring(v)) return false;
    const std::size_t n = ring_.size();
    double narrowest = kMinShape;
    for (const std::uint32_t t : at_[v]) {
      const auto& [a, b, c] = triangles_[t];
      narrowest = std::min(narrowest, curved(a, b, c).shape);
    }
    order_.clear();
    for (std::size_t k = 0; k < n; ++k) {
      double shape = 1;
      for (std::size_t j = 1; j + 1 < n && shape >= narrowest; ++j) {
        const CurvedTriangle next = curved(ring_[k], ring_[(k + j) % n], ring_[(k + j + 1) % n]);
        shape = next.is_tilted() ? -1 : std::min(shape, next.shape);
      }
      if (shape >= narrowest) order_.push_back({shape, k});
    }
    std::ranges::sort(order_, [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    return std::ranges::any_of(order_, [&](const auto& best) { return replace_by_fan(v, best.second, round); });
  }

  // Link condition: of the ring, u is joined to its two neighbours only. Two kept vertices are never joined, since
  // another surface may have that edge.
  bool may_fan(std::uint32_t u, std::size_t k) const {
    const std::size_t n = ring_.size();
    for (std::size_t j = 2; j + 1 < n; ++j) {
      const std::uint32_t w = ring_[(k + j) % n];
      if ((kept_[u] && kept_[w]) || are_joined(u, w)) return false;
    }
    return n > 3 || std::ranges::none_of(at_[u], [&](std::uint32_t t) {
             return std::ranges::all_of(ring_,
                                        [&](std::uint32_t w) { return std::ranges::count(triangles_[t], w) > 0; });
           });
  }

  bool replace_by_fan(std::uint32_t v, std::size_t k, std::uint32_t round) {
    const std::size_t n = ring_.size();
    const std::uint32_t u = ring_[k];
    if (!may_fan(u, k)) return false;
    fan_.clear();
    for (std::size_t j = 1; j + 1 < n; ++j) fan_.push_back(curved(u, ring_[(k + j) % n], ring_[(k + j + 1) % n]));
    removed_.assign(1, v);
    for (const std::uint32_t t : at_[v]) {
      for (std::uint32_t x = first_removed_[t]; x != kNone; x = next_removed_[x]) removed_.push_back(x);
    }
    in_.clear();
    for (const std::uint32_t x : removed_) {
      const Vec3& position = points_[x].position;
      const auto inside = [&](const CurvedTriangle& t) { return std::ranges::min(t.barycentric(position)); };
      const auto best = std::ranges::max_element(fan_, {}, inside);
      if (!(std::abs(best->height_of(position, best->barycentric(position))) <= tolerance_)) return false;
      in_.push_back(static_cast<std::size_t>(best - fan_.begin()));
    }
    const std::vector<std::uint32_t> old = std::exchange(at_[v], {});
    for (const std::uint32_t w : ring_) {
      std::erase_if(at_[w], [&](std::uint32_t t) { return std::ranges::count(old, t) > 0; });
      open_[w] = 1;
      changed_in_[w] = round;
    }
    for (std::size_t j = 0; j < old.size(); ++j) {
      const std::uint32_t t = old[j];
      first_removed_[t] = kNone;
      changed_[t] = 1;
      triangles_[t] = j + 2 < n ? Triangle{u, ring_[(k + j + 1) % n], ring_[(k + j + 2) % n]} : Triangle{0, 0, 0};
      if (j + 2 >= n) continue;
      for (const std::uint32_t w : triangles_[t]) at_[w].push_back(t);
    }
    for (std::size_t i = 0; i < removed_.size(); ++i) {
      next_removed_[removed_[i]] = first_removed_[old[in_[i]]];
      first_removed_[old[in_[i]]] = removed_[i];
    }
    kept_[v] = 1;
    return true;
  }

  std::span<const Facet> facets_;
  double tolerance_;
  std::vector<Triangle> triangles_;  // of vertices of the surface; removed ones have equal vertices
  std::vector<char> changed_;        // by triangle
  std::vector<std::uint32_t> first_removed_, next_removed_;  // removed vertices, a list by triangle
  std::vector<SurfacePoint> points_;                         // by vertex
  std::vector<std::vector<std::uint32_t>> at_;               // triangles by vertex
  std::vector<char> kept_;                                   // by vertex; removed ones too
  std::vector<char> open_;                                   // by vertex: its neighbourhood changed since it was tried
  std::vector<std::uint32_t> changed_in_;                    // last round that changed the vertex's triangles
  std::vector<std::pair<std::uint32_t, std::uint32_t>> not_smooth_;  // sides, ascending
  // Work memory.
  std::vector<std::uint32_t> ring_, removed_;
  std::vector<std::pair<double, std::size_t>> order_;
  std::vector<CurvedTriangle> fan_;
  std::vector<std::size_t> in_;  // of each removed vertex: triangle of the fan
};

}  // namespace

MergedFacets merge_smooth_facets(std::vector<Facet> facets, SmoothSides smooth, double tolerance) {
  const bool any = std::ranges::any_of(
      smooth, [](const auto& sides) { return std::ranges::all_of(sides, [](std::int32_t g) { return g >= 0; }); });
  if (any && tolerance > 0) {
    FacetMerger merger(facets, smooth, tolerance);
    if (merger.run()) return merger.result();
  }
  return {std::move(facets), std::move(smooth)};
}

}  // namespace seaglint
