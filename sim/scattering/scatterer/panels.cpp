// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

namespace {

// Smallest cosine between normals in one panel: excludes folded facets thinner than kCoincident.
constexpr double kSameWay = 0.999;
// Limit while a panel grows, vertices on straight sides included.
constexpr std::size_t kMaxCorners = 32;

struct Outline {
  Vec3 normal;
  std::vector<Vec3> corner;
  std::vector<std::array<int, 2>> side;  // facet and its side along corner[i] -> corner[i + 1]
};

// Twice the signed area of the triangle a, b, c about the normal, m^2: positive for a left turn at b. Relative to the
// squared length, values within kStraight count as collinear.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return normal.dot((b - a).cross(c - b));
}
constexpr double kStraight = 1e-12;

// Adds the vertex `apex` of the facet across side i, its own side `edge`, to the outline; false where the result would
// not be convex.
bool grow(Outline& outline, std::size_t i, int facet, int edge, const Vec3& apex) {
  const std::size_t n = outline.corner.size();
  const auto at = [&](std::size_t j) -> const Vec3& { return outline.corner[j % n]; };
  const double straight = kStraight * (apex - at(i)).squaredNorm();
  // A facet that is folded back has its apex on the wrong side.
  if (!(turn(at(i), apex, at(i + 1), outline.normal) > straight)) return false;
  if (turn(at(i + n - 1), at(i), apex, outline.normal) < -straight ||
      turn(apex, at(i + 1), at(i + 2), outline.normal) < -straight)
    return false;
  const auto place = static_cast<std::ptrdiff_t>(i) + 1;
  outline.corner.insert(outline.corner.begin() + place, apex);
  outline.side[i] = {facet, (edge + 1) % 3};
  outline.side.insert(outline.side.begin() + place, {facet, (edge + 2) % 3});
  return true;
}

}  // namespace

Panels::Panels(std::span<const Facet> facets, const SmoothSurface& surface)
    : facets_(facets), of_(facets.size(), -1), size_(facets.size(), 0), width_(facets.size(), 0) {
  first_corner_.reserve(facets.size() + 1);
  first_member_.reserve(facets.size() + 1);
  members_.reserve(facets.size());
  Outline outline;
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
    first_member_.push_back(static_cast<std::uint32_t>(members_.size()));
    if (of_[f] >= 0) continue;
    const Facet& first = facets[f];
    of_[f] = f;
    members_.push_back(f);
    outline = {first.normal, {first.corner.begin(), first.corner.end()}, {{f, 0}, {f, 1}, {f, 2}}};
    for (std::size_t i = 0; i < outline.side.size() && outline.side.size() < kMaxCorners;) {
      const auto [from, edge] = outline.side[i];
      const int g = facets[from].neighbour[edge];
      const auto joins = [&, from = from] {
        if (g < 0 || of_[g] >= 0 || surface.curved(f) || surface.curved(g)) return false;
        const Facet& other = facets[g];
        // Exactly two facets share the side.
        const auto back = std::find(other.neighbour.begin(), other.neighbour.end(), from);
        if (back == other.neighbour.end() || other.part != first.part || other.material != first.material ||
            other.two_sided != first.two_sided)
          return false;
        if (other.normal.dot(first.normal) < kSameWay) return false;
        const bool one_face = first.face >= 0 && other.face == first.face;
        for (const Vec3& x : other.corner) {
          if (!one_face && std::abs(first.normal.dot(x) - first.offset) > kCoincident) return false;
        }
        const int shared = static_cast<int>(back - other.neighbour.begin());
        return grow(outline, i, g, shared, other.corner[(shared + 2) % 3]);
      };
      if (joins()) {
        of_[g] = f;
        members_.push_back(g);
        i = 0;  // a facet rejected before may fit the larger outline
      } else {
        ++i;
      }
    }
    const std::size_t n = outline.corner.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 &before = outline.corner[(i + n - 1) % n], &here = outline.corner[i],
                 &after = outline.corner[(i + 1) % n];
      if (n > 3 && turn(before, here, after, outline.normal) > kStraight * (after - before).squaredNorm())
        corners_.push_back(here);
      for (const Vec3& other : outline.corner) size_[f] = std::max(size_[f], (other - here).norm());
      width_[f] += 0.5 * first.normal.dot((before - outline.corner[0]).cross(here - outline.corner[0]));
    }
    width_[f] /= size_[f];
  }
  first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
  first_member_.push_back(static_cast<std::uint32_t>(members_.size()));
}

namespace {

Vec3 side(const Facet& facet, int i) { return facet.corner[(i + 1) % 3] - facet.corner[i]; }

// Frame of a face for the edge direction t: n = t x x points out of the conductor.
WedgeFace face_along(const Vec3& t, const Vec3& x) { return {x, t.cross(x), t}; }

// Exterior angle below which two faces, the sides of a sheet meshed on both, form a half-plane.
constexpr double kBackToBack = 1e-6;  // rad

WedgeFrame wedge_of(const WedgeFace& first, const Vec3& x_second) {
  double exterior = std::atan2(x_second.dot(first.n), x_second.dot(first.x));
  if (exterior <= kBackToBack) exterior += 2 * kPi;
  return {{first, face_along(-first.t, x_second)}, exterior / kPi};
}

// Index of the side of `facet` between two points, in either sense; -1 when there is none.
int side_between(const Facet& facet, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = facet.corner[i], &q = facet.corner[(i + 1) % 3];
    if ((p == a && q == b) || (p == b && q == a)) return i;
  }
  return -1;
}

// Unit vector in the facet, normal to its side i, pointing into the facet.
Vec3 into(const Facet& facet, int i) {
  const Vec3 t = side(facet, i).normalized();
  return facet.normal.cross(t);
}

// Images solve a wedge whose exterior angle divides pi, and its edge does not diffract: Keller's coefficients have the
// factor sin(pi / N), of which 1e-3 is -60 dB.
bool diffracts(const WedgeFrame& wedge) {
  return wedge.N > 1 || (wedge.N > kMinWedgeIndex && std::abs(std::sin(kPi / wedge.N)) > 1e-3);
}

// Angle below which adjacent edges count as collinear. Rounding to single precision turns edges of a tenth of a metre,
// seventy metres from the origin, by a tenth of it.
constexpr double kMaxChainBend = 1e-3;  // rad
// Points where more edges meet, as in a fan of disconnected triangles, end every chain.
constexpr std::ptrdiff_t kMaxMeetingEdges = 64;

// Sets collinear_length_m.
void measure_collinear_chains(std::vector<SharpEdge>& edges) {
  struct End {
    Vec3 place, outwards;  // end point and direction from it along the edge
    std::size_t edge;
  };
  std::vector<End> ends;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    ends.push_back({edges[e].a, edges[e].along(), e});
    ends.push_back({edges[e].b, -edges[e].along(), e});
  }
  const auto before = [](const Vec3& p, const Vec3& q) { return std::ranges::lexicographical_compare(p, q); };
  std::ranges::sort(ends, [&](const End& p, const End& q) { return before(p.place, q.place); });

  std::vector<std::size_t> run(edges.size());  // disjoint sets: parent edge in the same chain
  std::iota(run.begin(), run.end(), std::size_t{0});
  const auto head = [&](std::size_t e) {
    while (run[e] != e) e = run[e] = run[run[e]];
    return e;
  };
  for (auto first = ends.begin(); first != ends.end();) {
    const auto last = std::find_if(first, ends.end(), [&](const End& end) { return end.place != first->place; });
    for (auto p = first; last - first <= kMaxMeetingEdges && p != last; ++p) {
      for (auto q = std::next(p); q != last; ++q) {
        if ((p->outwards + q->outwards).norm() < kMaxChainBend) run[head(p->edge)] = head(q->edge);
      }
    }
    first = last;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) edges[head(e)].collinear_length_m += edges[e].length();
  for (std::size_t e = 0; e < edges.size(); ++e) edges[e].collinear_length_m = edges[head(e)].collinear_length_m;
}

}  // namespace

SharpEdges find_sharp_edges(std::span<const Facet> facets, double least_turn, double sheet_thickness_m) {
  SharpEdges result;
  result.edges_of_facet.assign(facets.size(), {kNoEdge, kNoEdge, kNoEdge});
  const auto add = [&](SharpEdge edge, int f, int i, int g, int k) {
    const int number = static_cast<int>(result.edges.size());
    for (WedgeFrame* wedge : {&edge.front_wedge, &edge.back_wedge})
      wedge->thickness_m = std::abs(wedge->N - 2) * kPi <= kBackToBack ? sheet_thickness_m : 0;
    result.edges.push_back(edge);
    result.edges_of_facet[f][i] = number;
    result.edges_of_facet[g][k] = number;
  };
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Facet& facet = facets[f];
      const int g = facet.neighbour[i];
      if (g >= 0 && g <= f) continue;  // already added from the other facet
      const Vec3 &a = facet.corner[i], &b = facet.corner[(i + 1) % 3];
      const Vec3 t = (b - a).normalized();
      SharpEdge edge{a, b, {f, f}, {}, {}, facet.two_sided};
      if (g < 0) {
        edge.front_wedge = {{face_along(t, into(facet, i)), face_along(-t, into(facet, i))}, 2};
        edge.back_wedge = {{face_along(-t, into(facet, i)), face_along(t, into(facet, i))}, 2};
        add(edge, f, i, f, i);
        continue;
      }
      // Exactly two facets share the edge: each is the other's neighbour.
      const int k = side_between(facets[g], a, b);
      if (k < 0 || facets[g].neighbour[k] != f) continue;
      const Vec3 x_second = into(facets[g], k);
      edge.facet[1] = g;
      edge.front_wedge = wedge_of(face_along(t, into(facet, i)), x_second);
      edge.back_wedge = wedge_of(face_along(-t, into(facet, i)), x_second);
      if (std::abs(edge.front_wedge.N - 1) * kPi >= least_turn) add(edge, f, i, g, k);
    }
  }
  measure_collinear_chains(result.edges);
  return result;
}

void index_by_panel(SharpEdges& edges, std::span<const Facet> facets, const Panels& panels) {
  edges.panel_edges.clear();
  edges.panel_offset.assign(1, 0);
  for (int panel = 0; panel < static_cast<int>(facets.size()); ++panel) {
    for (const int own : panels.members(panel)) {
      for (const int number : edges.edges_of_facet[own]) {
        if (number == kNoEdge) continue;
        const SharpEdge& edge = edges.edges[number];
        if (!edge.two_sided && !diffracts(edge.front_wedge)) continue;
        const auto [f, g] = edge.facet;
        const int other = own == f ? g : f;
        edges.panel_edges.push_back({facets[own].normal, facets[other].normal, number, edge.two_sided, own == f});
      }
    }
    edges.panel_offset.push_back(static_cast<std::uint32_t>(edges.panel_edges.size()));
  }
}

const WedgeFrame* illuminated_wedge(const SharpEdge& edge, const Vec3& k_hat) {
  // The exterior of a convex wedge is in front of either face, that of a concave one in front of both.
  const auto before = [&](const WedgeFace& face) { return k_hat.dot(face.n) <= 0; };
  const auto& [first, second] = edge.front_wedge.face;
  const bool outside = edge.front_wedge.N > 1 ? before(first) || before(second) : before(first) && before(second);
  const WedgeFrame* wedge = outside ? &edge.front_wedge : edge.two_sided ? &edge.back_wedge : nullptr;
  return wedge && diffracts(*wedge) ? wedge : nullptr;
}

const WedgeFrame* wedge_on_illuminated_face(const SharpEdge& edge, bool first, const Vec3& k_hat) {
  const WedgeFrame* wedge = illuminated_wedge(edge, k_hat);
  return wedge && (edge.is_free_edge() || k_hat.dot(wedge->face[first ? 0 : 1].n) <= 0) ? wedge : nullptr;
}

bool records_edge(const SharpEdge& edge, const WedgeFrame& wedge, bool first, const Vec3& k_hat) {
  const double of_first = -k_hat.dot(wedge.face[0].n), of_second = -k_hat.dot(wedge.face[1].n);
  return edge.is_free_edge() || (first ? of_first >= of_second : of_second > of_first);
}

}  // namespace seaglint
