// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/mesh/mesh_diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "sim/geometry/mesh/coinciding_faces.h"
#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

// The vertices in ascending order, and whether the triangle is an even permutation of them.
struct Corners {
  std::array<std::uint32_t, 3> sorted;
  bool even;
  std::uint32_t triangle;
};

Corners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  Corners c{mesh.triangles[triangle], true, triangle};
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {0, 1}}) {
    if (c.sorted[i] > c.sorted[j]) {
      std::swap(c.sorted[i], c.sorted[j]);
      c.even = !c.even;
    }
  }
  return c;
}

std::span<const HalfEdge> uses_of(const Topology& topology, const MeshEdge& edge) {
  return {topology.uses.data() + edge.first_use, edge.use_count};
}

struct Diagnosis {
  MeshDiagnostics health;
  std::vector<char> drop;           // degenerate or a copy
  std::vector<char> turn;           // of an inverted surface
  std::vector<FaceOverlap> unlike;  // CoincidingFaces::unlike
};

// Marks copies of triangles. Returns pairs (front, back) of coinciding triangles of opposite orientation and different
// material.
std::vector<std::array<std::uint32_t, 2>> find_copies(const TriangleMesh& mesh, Diagnosis& d) {
  const IndexGroups at_vertex(mesh.triangles.size(), mesh.vertices.size(),
                              [&](std::uint32_t t) { return std::ranges::min(mesh.triangles[t]); });
  std::vector<Corners> all;
  all.reserve(mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto first = static_cast<std::ptrdiff_t>(all.size());
    for (const std::uint32_t t : at_vertex[v]) {
      if (!d.drop[t]) all.push_back(corners_of(mesh, t));
    }
    std::sort(all.begin() + first, all.end(), [](const Corners& a, const Corners& b) {
      return a.sorted != b.sorted ? a.sorted < b.sorted : a.triangle < b.triangle;
    });
  }
  std::vector<std::array<std::uint32_t, 2>> backs;
  for (std::size_t i = 0; i < all.size();) {
    // The first is kept; triangles of the same orientation are copies, those of opposite orientation are its back.
    const Corners& front = all[i];
    bool has_back = false;
    std::size_t next = i + 1;
    for (; next < all.size() && all[next].sorted == front.sorted; ++next) {
      const Corners& copy = all[next];
      const bool differs =
          copy.even != front.even && mesh.triangle_material[copy.triangle] != mesh.triangle_material[front.triangle];
      if (differs && !has_back) {
        backs.push_back({front.triangle, copy.triangle});
        has_back = true;
      } else {
        d.drop[copy.triangle] = 1;
        ++(copy.even == front.even ? d.health.repeated : d.health.two_sided);
      }
    }
    i = next;
  }
  return backs;
}

// Topology after the removal of dropped triangles.
Topology remaining(Topology topology, const std::vector<char>& drop) {
  if (std::ranges::count(drop, 1) == 0) return topology;
  std::vector<HalfEdge> uses;
  for (MeshEdge& edge : topology.edges) {
    const auto first = static_cast<std::uint32_t>(uses.size());
    for (const HalfEdge& use : uses_of(topology, edge)) {
      if (!drop[use.triangle]) uses.push_back(use);
    }
    edge.first_use = first;
    edge.use_count = static_cast<std::uint32_t>(uses.size()) - first;
  }
  topology.uses = std::move(uses);
  std::erase_if(topology.edges, [](const MeshEdge& edge) { return edge.use_count == 0; });
  return topology;
}

bool is_mixed(std::span<const HalfEdge> uses) { return uses.size() == 2 && uses[0].forward == uses[1].forward; }

// Per root of each set: true when its triangles do not traverse every edge equally often in both directions.
std::vector<char> unclosed(const Topology& topology, std::size_t triangles, DisjointSets& sets) {
  std::vector<char> open(triangles, 0);
  std::vector<HalfEdge> uses;
  for (const MeshEdge& edge : topology.edges) {
    const auto all = uses_of(topology, edge);
    if (all.size() == 2 && all[0].forward != all[1].forward && sets.find(all[0].triangle) == sets.find(all[1].triangle))
      continue;
    uses.assign(all.begin(), all.end());
    std::sort(uses.begin(), uses.end(),
              [&](const HalfEdge& a, const HalfEdge& b) { return sets.find(a.triangle) < sets.find(b.triangle); });
    for (std::size_t i = 0; i < uses.size();) {
      const std::uint32_t root = sets.find(uses[i].triangle);
      int balance = 0;
      for (; i < uses.size() && sets.find(uses[i].triangle) == root; ++i) balance += uses[i].forward ? 1 : -1;
      if (balance != 0) open[root] = 1;
    }
  }
  return open;
}

// Keeps the backs of sheets of two materials where the connected surface is closed, since the solver then illuminates
// each triangle on its front only. In open surfaces it illuminates both sides of every triangle, and the first of two
// coinciding triangles hides the other from both: the back is removed.
void choose_backs(const TriangleMesh& mesh, const Topology& topology,
                  std::span<const std::array<std::uint32_t, 2>> backs, Diagnosis& d) {
  if (backs.empty()) return;
  const Topology left = remaining(topology, d.drop);
  DisjointSets sets(mesh.triangles.size());
  for (const MeshEdge& edge : left.edges) {
    for (const HalfEdge& use : uses_of(left, edge)) sets.unite(left.uses[edge.first_use].triangle, use.triangle);
  }
  const std::vector<char> open = unclosed(left, mesh.triangles.size(), sets);
  for (const auto& [front, back] : backs) {
    if (!open[sets.find(front)]) {
      ++d.health.kept_backs;
      continue;
    }
    d.drop[back] = 1;
    if (d.health.dropped_backs++ == 0) {
      d.health.lost_part = mesh.part_names[mesh.triangle_part[back]];
      d.health.lost_behind = mesh.part_names[mesh.triangle_part[front]];
    }
  }
}

struct Surface {
  bool open = false;
  double volume = 0, area = 0;  // m^3, 0 where it is rounding; m^2
  std::size_t triangles = 0;
};

// Surfaces by the root of their set. Volumes about a point of the mesh: far from the origin the terms of the divergence
// theorem cancel.
std::vector<Surface> surfaces_of(const TriangleMesh& mesh, const std::vector<char>& drop, DisjointSets& sets,
                                 const std::vector<char>& open) {
  const std::size_t count = mesh.triangles.size();
  std::vector<Surface> surfaces(count);
  const Bounds box = bounds(mesh);
  const Vec3 centre = (box.lower + box.upper) / 2;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (drop[t]) continue;
    Surface& surface = surfaces[sets.find(t)];
    surface.open = open[sets.find(t)];
    const Vec3 area = area_vector(mesh, t);
    surface.volume += (mesh.vertices[mesh.triangles[t][0]] - centre).dot(area) / 3;
    surface.area += area.norm();
    ++surface.triangles;
  }
  // Below this the enclosed volume is rounding.
  constexpr double kMinVolume = 1e-9;  // of size times area
  const double size = (box.upper - box.lower).norm();
  for (Surface& surface : surfaces) {
    if (!(std::abs(surface.volume) > kMinVolume * size * surface.area)) surface.volume = 0;
  }
  return surfaces;
}

// Sets of triangles that are connected across edges of exactly two.
DisjointSets connected(const Topology& topology, std::size_t triangles) {
  DisjointSets sets(triangles);
  for (const MeshEdge& edge : topology.edges) {
    const auto uses = uses_of(topology, edge);
    if (uses.size() == 2) sets.unite(uses[0].triangle, uses[1].triangle);
  }
  return sets;
}

// What a coincidence is by the surfaces of its triangles: no wave reaches faces in which two closed bodies are in
// contact. The shell of a closed body that is drawn from inside as well has the same volume with the other sign and is
// no contact.
CoincidingFaces coinciding_faces(const TriangleMesh& mesh, const Topology& topology, const std::vector<char>& drop,
                                 bool quads) {
  DisjointSets sets = connected(topology, mesh.triangles.size());
  const std::vector<char> open = unclosed(topology, mesh.triangles.size(), sets);
  const std::vector<Surface> surfaces = surfaces_of(mesh, drop, sets, open);
  const auto volume_at = [&](std::uint32_t t) {
    const Surface& surface = surfaces[sets.find(t)];
    return surface.open ? 0.0 : surface.volume;
  };
  const auto kind = [&](std::uint32_t a, std::uint32_t b) {
    const double one = volume_at(a), other = volume_at(b);
    if (sets.find(a) == sets.find(b) || one * other < 0 || (one == 0 && other == 0)) return Coincidence::kSheet;
    return one == 0 ? Coincidence::kSheetOnBody : other == 0 ? Coincidence::kBodyUnderSheet : Coincidence::kBodies;
  };
  return find_coinciding_faces(mesh, {drop, kind, quads});
}

// Marks backs of sheets that are cut otherwise than their fronts, and returns the topology without them. Quads that are
// drawn from both sides come first: without their backs, bodies are closed and their contact with others is seen.
Topology without_covered_backs(const TriangleMesh& mesh, Topology topology, Diagnosis& d) {
  CoincidingFaces found;
  for (const bool quads : {true, false}) {
    found = coinciding_faces(mesh, topology, d.drop, quads);
    for (const std::uint32_t t : found.backs) d.drop[t] = 1;
    d.health.covered += found.backs.size();
    d.health.covered_m2 += found.backs_m2;
    if (!found.backs.empty()) topology = remaining(std::move(topology), d.drop);
  }
  d.health.partly = found.partly;
  d.health.partly_m2 = found.partly_m2;
  d.unlike = std::move(found.unlike);
  d.health.is_crowded = found.is_crowded;
  return topology;
}

Diagnosis find_defects(const TriangleMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  Diagnosis d;
  d.drop.assign(count, 0);
  d.turn.assign(count, 0);
  d.health.triangles = count;
  d.health.of_file = mesh.findings;
  for (const auto& normals : mesh.corner_normals)
    d.health.corners_without_normal += static_cast<std::size_t>(std::ranges::count(normals, Vec3(Vec3::Zero())));
  Topology topology = topology_of(mesh);
  for (const std::uint32_t t : topology.degenerate) d.drop[t] = 1;
  d.health.degenerate = topology.degenerate.size();
  const auto backs = find_copies(mesh, d);
  choose_backs(mesh, topology, backs, d);
  topology = remaining(std::move(topology), d.drop);
  topology = without_covered_backs(mesh, std::move(topology), d);

  // Only edges of two triangles define which triangles continue each other.
  DisjointSets sets = connected(topology, count);
  for (const MeshEdge& edge : topology.edges) {
    const auto uses = uses_of(topology, edge);
    if (uses.size() == 1) ++d.health.open_edges;
    if (is_mixed(uses)) ++d.health.inconsistent_edges;
    if (uses.size() > 2) ++d.health.non_manifold_edges;
  }
  // Sets that are closed by this are separate bodies, which may touch others along edges. The others are joined across
  // non-manifold edges and may be closed together.
  const std::vector<char> ends = unclosed(topology, count, sets);
  DisjointSets joined = sets;
  for (const MeshEdge& edge : topology.edges) {
    std::uint32_t first = kNoIndex;
    for (const HalfEdge& use : uses_of(topology, edge)) {
      if (!ends[sets.find(use.triangle)]) continue;
      if (first == kNoIndex) first = use.triangle;
      joined.unite(first, use.triangle);
    }
  }
  const std::vector<char> open = unclosed(topology, count, joined);
  // Of two coinciding faces in open surfaces, which scatter from both sides, either may hide the other.
  std::vector<char> is_hidden(count, 0);
  for (const FaceOverlap& o : d.unlike) {
    if (d.drop[o.a] || d.drop[o.b] || !open[joined.find(o.a)] || !open[joined.find(o.b)]) continue;
    d.health.unlike_m2 += o.area;
    for (const std::uint32_t t : {o.a, o.b}) d.health.unlike += std::exchange(is_hidden[t], char{1}) ? 0 : 1;
  }
  std::vector<char> has_free_edge(count, 0);
  for (const MeshEdge& edge : topology.edges) {
    const auto uses = uses_of(topology, edge);
    if (uses.size() == 1 || is_mixed(uses)) has_free_edge[joined.find(uses[0].triangle)] = 1;
  }

  const std::vector<Surface> surfaces = surfaces_of(mesh, d.drop, joined, open);
  const Bounds box = bounds(mesh);
  d.health.size = box.upper - box.lower;
  const auto inverted = [](const Surface& s) { return !s.open && s.volume < 0; };
  for (std::uint32_t root = 0; root < count; ++root) {
    const Surface& surface = surfaces[root];
    if (surface.triangles == 0) continue;
    ++d.health.surfaces;
    d.health.open_surfaces += surface.open;
    d.health.non_manifold_surfaces += surface.open && !has_free_edge[root];
    if (!inverted(surface)) continue;
    ++d.health.inverted_surfaces;
    d.health.inverted_triangles += surface.triangles;
  }
  for (std::uint32_t t = 0; t < count; ++t) d.turn[t] = !d.drop[t] && inverted(surfaces[joined.find(t)]);
  return d;
}

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

// Whether a mesh measured in metres was probably drawn in another unit: no ship is longer than 500 m, no target shorter
// than 2 cm, and elongated bodies of many facets (ships: 3 times as long as wide) are seldom below 5 m.
bool has_unlikely_size(const MeshDiagnostics& h) {
  constexpr double kLongest = 500, kShortest = 0.02, kShortestShip = 5, kShipRatio = 3;
  constexpr std::size_t kShipFacets = 500;
  Vec3 size = h.size;
  std::sort(size.begin(), size.end());
  const bool like_a_ship = h.triangles >= kShipFacets && size[2] > kShipRatio * size[1] && size[2] < kShortestShip;
  return size[2] > kLongest || (size[2] > 0 && size[2] < kShortest) || like_a_ship;
}

}  // namespace

MeshDiagnostics diagnose(const TriangleMesh& mesh) { return find_defects(mesh).health; }

std::vector<std::string> diagnostic_messages(const MeshDiagnostics& h) {
  std::vector<std::string> found = h.of_file;
  if (has_unlikely_size(h)) {
    found.push_back(
        fmt::format("measures {:.4g} x {:.4g} x {:.4g} m, an unlikely size: is it drawn in another unit? Say "
                    "so by --unit, in a scenario by unit:",
                    h.size.x(), h.size.y(), h.size.z()));
  }
  if (h.degenerate > 0) found.push_back(counted(h.degenerate, "triangle has", "triangles have") + " no area: removed");
  if (h.repeated > 0)
    found.push_back(counted(h.repeated, "triangle repeats", "triangles repeat") + " another: removed");
  if (h.inverted_surfaces > 0) {
    found.push_back(fmt::format("{} inside out ({}): turned outwards",
                                counted(h.inverted_surfaces, "closed surface is", "closed surfaces are"),
                                counted(h.inverted_triangles, "triangle", "triangles")));
  }
  if (h.open_edges > 0) {
    found.push_back(
        fmt::format("{}; {} of {} surfaces are open: holes, or sheets, seen from both sides and through their holes",
                    counted(h.open_edges, "open edge", "open edges"), h.open_surfaces, h.surfaces));
  }
  if (h.inconsistent_edges > 0) {
    found.push_back(counted(h.inconsistent_edges, "edge has", "edges have") +
                    " neighbours of opposite orientation: their surfaces are taken as sheets, seen from both sides");
  }
  if (h.non_manifold_edges > 0) {
    found.push_back(
        counted(h.non_manifold_edges, "edge has", "edges have") + " three triangles or more" +
        (h.non_manifold_surfaces == 0
             ? std::string()
             : fmt::format("; {} there: no telling which side is inside, taken as sheets, seen from both sides",
                           counted(h.non_manifold_surfaces, "surface that branches", "surfaces that branch"))));
  }
  if (h.two_sided > 0)
    found.push_back(counted(h.two_sided, "triangle duplicates another", "triangles duplicate others") +
                    " with opposite orientation: removed; a single-material sheet scatters from both sides");
  if (h.covered > 0) {
    found.push_back(
        fmt::format("{} others with opposite orientation, cut otherwise ({:.4g} m^2): removed; coinciding "
                    "faces are one sheet, which scatters from both sides",
                    counted(h.covered, "triangle coincides with", "triangles coincide with"), h.covered_m2));
  }
  if (h.is_crowded)
    found.push_back("too many triangles lie in one place to find those that coincide with opposite orientation");
  if (h.partly > 0) {
    found.push_back(
        fmt::format("{} others with opposite orientation in part ({:.4g} m^2): not one sheet, the edges of "
                    "both diffract",
                    counted(h.partly, "triangle overlaps", "triangles overlap"), h.partly_m2));
  }
  if (h.unlike > 0) {
    found.push_back(
        fmt::format("{} others of another material with opposite orientation, in open surfaces "
                    "({:.4g} m^2): either may scatter on both sides",
                    counted(h.unlike, "triangle coincides with", "triangles coincide with"), h.unlike_m2));
  }
  if (h.dropped_backs > 0) {
    found.push_back(
        fmt::format("{} the back of another in another material, the first of them of part '{}' behind part '{}': "
                    "removed, their surfaces are open; both sides scatter as the front does",
                    counted(h.dropped_backs, "triangle is", "triangles are"), h.lost_part, h.lost_behind));
  }
  if (h.corners_without_normal > 0)
    found.push_back(fmt::format("{} of {} corners have no usable normal: not finite, zero or not given",
                                h.corners_without_normal, 3 * h.triangles));
  return found;
}

RepairedMesh diagnose_and_repair(const TriangleMesh& mesh) {
  Diagnosis d = find_defects(mesh);
  RepairedMesh repaired{mesh, std::move(d.health)};
  repaired.mesh.clear_triangles();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (d.drop[t]) continue;
    std::array<std::uint32_t, 3> triangle = mesh.triangles[t];
    std::array<Vec3, 3> normals = mesh.normals_of(t);
    if (d.turn[t]) {
      std::swap(triangle[1], triangle[2]);
      normals = {-normals[0], -normals[2], -normals[1]};
    }
    repaired.mesh.add_like(mesh, t, triangle, normals);
  }
  return repaired;
}

TriangleMesh repair(const TriangleMesh& mesh) { return diagnose_and_repair(mesh).mesh; }

}  // namespace seaglint
