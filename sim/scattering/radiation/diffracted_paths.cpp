// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/diffracted_paths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/path_weights.h"
#include "sim/scattering/geometry/tolerances.h"

namespace seaglint {
namespace {

constexpr double kShallow = 1e-4;  // m, of a panel in edge-on view

Vec3 normal_of(const DepthPlane& plane, const RadarBasis& basis) {
  return (basis.r - plane.slope.x() * basis.h - plane.slope.y() * basis.v).normalized();
}

// Maps real points to the projection plane.
struct ProjectionMap {
  Vec3 h, v;
  Vec2 shift;

  ProjectionMap(const RadarBasis& transmit, const ImageTransform& image_transform)
      : h(image_transform.L.transpose() * transmit.h),
        v(image_transform.L.transpose() * transmit.v),
        shift(image_transform.t.dot(transmit.h), image_transform.t.dot(transmit.v)) {}
  Vec2 operator()(const Vec3& x) const { return Vec2(h.dot(x), v.dot(x)) + shift; }
};

}  // namespace

std::vector<Vec2> projected_outline(const Panels& panels, const RadarBasis& transmit, const PathPanel& panel) {
  const ProjectionMap into(transmit, *panel.image_transform);
  const std::span<const Vec3> real = panels.outline(panel.facet);
  std::vector<Vec2> outline(real.size());
  std::ranges::transform(real, outline.begin(), into);
  return outline;
}

std::vector<BeamEdge> beam_edges(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit,
                                 std::span<const PathPanel> panels_on_path) {
  std::vector<BeamEdge> found;
  found.reserve(4 * panels_on_path.size());
  for (std::size_t i = 0; i < panels_on_path.size(); ++i) {
    const PathPanel& panel = panels_on_path[i];
    const ProjectionMap into(transmit, *panel.image_transform);
    const Vec3 n = panel.image_transform->L.transpose() * normal_of(*panel.plane, transmit);
    std::vector<Vec2> outline;
    for (const PanelEdge& side : edges.edges_of_panel(panel.facet)) {
      const SharpEdge& edge = edges.edges[side.edge];
      if (!edge.conducts) continue;
      const WedgeFrame* wedge = wedge_on_illuminated_face(edge, side.is_first_face, panel.direction);
      if (!wedge || wedge->N <= 1) continue;
      if (outline.empty()) outline = projected_outline(panels, transmit, panel);
      const Vec2 a = into(edge.a), b = into(edge.b), along = (b - a).normalized();
      Vec2 middle = Vec2::Zero();
      double depth = 0;
      for (const Vec2& p : outline) {
        middle += p / static_cast<double>(outline.size());
        depth = std::max(depth, std::abs(along.x() * (p - a).y() - along.y() * (p - a).x()));
      }
      if (depth > kShallow) found.push_back({i, a, b, middle, into(edge.a + n.cross(edge.along())) - a, depth});
    }
  }
  return found;
}

SideFrame::SideFrame(const MovingVertex& start, const MovingVertex& end)
    : from(start),
      to(end),
      length((end.p - start.p).norm()),
      along((end.p - start.p) / length),
      across(-along.y(), along.x()) {}

bool SideFrame::lies_on(const BeamEdge& edge) const {
  return std::abs(x(edge.a)) <= kCoincident && std::abs(x(edge.b)) <= kCoincident && x(edge.interior_point) > 0;
}

DiffractedPaths::DiffractedPaths(const BistaticGeometry& geometry, std::span<const PathPanel> panels_on_path,
                                 const Footprint& footprint)
    : geometry_(geometry),
      basis_(geometry.transmit),
      panels_on_path_(panels_on_path),
      footprint_(footprint),
      normal_(normal_of(footprint.plane, basis_)),
      before_(reflect_direction(footprint.image_transform.L * geometry.receive.r, normal_)) {}

DiffractedPaths::DiffractedPath DiffractedPaths::diffracted_path(std::size_t panel_index, const Vec2& p) const {
  const Vec3 X = at(panel_index, p), beyond = X - 2 * normal_.dot(X - footprint_.plane.z0 * basis_.r) * normal_;
  const Vec3 Y = footprint_.image_transform.real(beyond);
  return {X, Y, basis_.r.dot(X) + geometry_.receive.r.dot(Y)};
}

Vec2 DiffractedPaths::landing_point(std::size_t panel_index, const Vec2& p) const {
  const Vec3 X = at(panel_index, p),
             landed = X - normal_.dot(X - footprint_.plane.z0 * basis_.r) / normal_.dot(before_) * before_;
  return {landed.dot(basis_.h), landed.dot(basis_.v)};
}

Vec2 DiffractedPaths::exit_in_plane(const Vec2& direction) const {
  return Vec2(-before_.dot(basis_.r), before_.dot(direction.x() * basis_.h + direction.y() * basis_.v)).normalized();
}

DiffractedPaths::EdgeWeight DiffractedPaths::edge_weight(const BeamEdge& edge, double slope) const {
  const PathPanel& reflector = panels_on_path_[edge.panel_index];
  // In real space at the edge: exit direction, normals of its face and of the last panel, and the direction of the
  // edge.
  const Mat3 real = reflector.image_transform->L.transpose();
  const Vec3 s = real * before_, last = real * normal_;
  Vec3 n = real * normal_of(*reflector.plane, basis_);
  if (n.dot(reflector.direction) > 0) n = -n;
  const Vec2 run = (edge.b - edge.a).normalized();
  const Vec3 along =
      real * (run.x() * basis_.h + run.y() * basis_.v + reflector.plane->slope.dot(run) * basis_.r).normalized();
  const double moved = reflected_edge_weight(n, along, reflector.direction, s, last) *
                       beam_incidence_taper(reflect_direction(reflector.direction, n), s, last) *
                       (1 - smooth_taper(std::abs(slope), kSlopeWindow));
  return {moved, n.dot(s) > 0};
}

}  // namespace seaglint
