// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/target/sharp_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

Vec3 side(const Facet& facet, int i) { return facet.corner[(i + 1) % 3] - facet.corner[i]; }

// The face's frame for an edge direction t: n = t x x points out of the conductor.
WedgeFace face_along(const Vec3& t, const Vec3& x) { return {x, t.cross(x), t}; }

// Two faces that turn back by less than this, a sheet drawn with both its sides, are a half-plane.
constexpr double kBackToBack = 1e-6;  // rad

WedgeFrame wedge_of(const WedgeFace& first, const Vec3& x_second) {
  double exterior = std::atan2(x_second.dot(first.n), x_second.dot(first.x));
  if (exterior <= kBackToBack) exterior += 2 * kPi;
  return {{first, face_along(-first.t, x_second)}, exterior / kPi};
}

// Which side of `facet` is the edge between these two points, and in which direction? -1 when none.
int side_between(const Facet& facet, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = facet.corner[i], &q = facet.corner[(i + 1) % 3];
    if ((p == a && q == b) || (p == b && q == a)) return i;
  }
  return -1;
}

// Across the edge into the facet.
Vec3 into(const Facet& facet, int i) {
  const Vec3 t = side(facet, i).normalized();
  return facet.normal.cross(t);
}

// Where the exterior angle goes into pi without a rest images solve a corner, and its edge sends nothing. The limit is
// -60 dB of an edge: Keller's coefficients have the sine for a factor.
bool diffracts(const WedgeFrame& wedge) {
  return wedge.N > 1 || (wedge.N > kSharpestCorner && std::abs(std::sin(kPi / wedge.N)) > 1e-3);
}

// Edges that go on by less than this from where they meet are one run: rounding to single precision turns those of a
// tenth of a metre, seventy metres out, by a tenth of it.
constexpr double kStraightOn = 1e-3;  // rad
// Where more edges meet, as in a fan of loose triangles, each is a run that ends there.
constexpr std::ptrdiff_t kMostMeeting = 64;

// Fills run_m.
void measure_runs(std::vector<SharpEdge>& edges) {
  struct End {
    Vec3 place, outwards;  // from here along the edge
    std::size_t edge;
  };
  std::vector<End> ends;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    ends.push_back({edges[e].a, edges[e].along(), e});
    ends.push_back({edges[e].b, -edges[e].along(), e});
  }
  const auto before = [](const Vec3& p, const Vec3& q) { return std::ranges::lexicographical_compare(p, q); };
  std::ranges::sort(ends, [&](const End& p, const End& q) { return before(p.place, q.place); });

  std::vector<std::size_t> run(edges.size());  // an edge of the same run; of one edge of every run, itself
  std::iota(run.begin(), run.end(), std::size_t{0});
  const auto head = [&](std::size_t e) {
    while (run[e] != e) e = run[e] = run[run[e]];
    return e;
  };
  for (auto first = ends.begin(); first != ends.end();) {
    const auto last = std::find_if(first, ends.end(), [&](const End& end) { return end.place != first->place; });
    for (auto p = first; last - first <= kMostMeeting && p != last; ++p) {
      for (auto q = std::next(p); q != last; ++q) {
        if ((p->outwards + q->outwards).norm() < kStraightOn) run[head(p->edge)] = head(q->edge);
      }
    }
    first = last;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) edges[head(e)].run_m += edges[e].length();
  for (std::size_t e = 0; e < edges.size(); ++e) edges[e].run_m = edges[head(e)].run_m;
}

}  // namespace

SharpEdges sharp_edges(std::span<const Facet> facets, double least_turn, double sheet_thickness_m) {
  SharpEdges result;
  result.of_facet.assign(facets.size(), {kNoEdge, kNoEdge, kNoEdge});
  const auto add = [&](SharpEdge edge, int f, int i, int g, int k) {
    const int number = static_cast<int>(result.edges.size());
    for (WedgeFrame* wedge : {&edge.outside, &edge.inside})
      wedge->thickness_m = std::abs(wedge->N - 2) * kPi <= kBackToBack ? sheet_thickness_m : 0;
    result.edges.push_back(edge);
    result.of_facet[f][i] = number;
    result.of_facet[g][k] = number;
  };
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Facet& facet = facets[f];
      const int g = facet.neighbour[i];
      if (g >= 0 && g <= f) continue;  // found from the other facet
      const Vec3 &a = facet.corner[i], &b = facet.corner[(i + 1) % 3];
      const Vec3 t = (b - a).normalized();
      SharpEdge edge{a, b, {f, f}, {}, {}, facet.open};
      if (g < 0) {
        edge.outside = {{face_along(t, into(facet, i)), face_along(-t, into(facet, i))}, 2};
        edge.inside = {{face_along(-t, into(facet, i)), face_along(t, into(facet, i))}, 2};
        add(edge, f, i, f, i);
        continue;
      }
      // Two facets and no third: each is the other's neighbour here.
      const int k = side_between(facets[g], a, b);
      if (k < 0 || facets[g].neighbour[k] != f) continue;
      const Vec3 x_second = into(facets[g], k);
      edge.facet[1] = g;
      edge.outside = wedge_of(face_along(t, into(facet, i)), x_second);
      edge.inside = wedge_of(face_along(-t, into(facet, i)), x_second);
      if (std::abs(edge.outside.N - 1) * kPi >= least_turn) add(edge, f, i, g, k);
    }
  }
  measure_runs(result.edges);
  return result;
}

void list_by_panel(SharpEdges& edges, std::span<const Facet> facets, const Panels& panels) {
  edges.by_panel.clear();
  edges.first_of_panel.assign(1, 0);
  for (int panel = 0; panel < static_cast<int>(facets.size()); ++panel) {
    for (const int own : panels.members(panel)) {
      for (const int number : edges.of_facet[own]) {
        if (number == kNoEdge) continue;
        const SharpEdge& edge = edges.edges[number];
        if (!edge.open && !diffracts(edge.outside)) continue;
        const auto [f, g] = edge.facet;
        const int other = own == f ? g : f;
        edges.by_panel.push_back({facets[own].normal, facets[other].normal, number, edge.open, own == f});
      }
    }
    edges.first_of_panel.push_back(static_cast<std::uint32_t>(edges.by_panel.size()));
  }
}

const WedgeFrame* wedge_towards(const SharpEdge& edge, const Vec3& k_hat) {
  // Outside a convex wedge is what lies before either face, outside a concave one what lies before both.
  const auto before = [&](const WedgeFace& face) { return k_hat.dot(face.n) <= 0; };
  const auto& [first, second] = edge.outside.face;
  const bool outside = edge.outside.N > 1 ? before(first) || before(second) : before(first) && before(second);
  const WedgeFrame* wedge = outside ? &edge.outside : edge.open ? &edge.inside : nullptr;
  return wedge && diffracts(*wedge) ? wedge : nullptr;
}

const WedgeFrame* wedge_lit(const SharpEdge& edge, bool first, const Vec3& k_hat) {
  const WedgeFrame* wedge = wedge_towards(edge, k_hat);
  return wedge && (edge.is_rim() || k_hat.dot(wedge->face[first ? 0 : 1].n) <= 0) ? wedge : nullptr;
}

bool speaks(const SharpEdge& edge, const WedgeFrame& wedge, bool first, const Vec3& k_hat) {
  const double of_first = -k_hat.dot(wedge.face[0].n), of_second = -k_hat.dot(wedge.face[1].n);
  return edge.is_rim() || (first ? of_first >= of_second : of_second > of_first);
}

}  // namespace seaglint
