// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/diffracted_paths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/edges/reflected_edge.h"

namespace seaglint {
namespace {

constexpr double kShallow = 1e-4;  // m, of a panel seen edge-on

Vec3 normal_of(const ImagePlane& plane, const RadarBasis& basis) {
  return (basis.r - plane.slope.x() * basis.h - plane.slope.y() * basis.v).normalized();
}

// From real points to the aperture.
struct IntoAperture {
  Vec3 h, v;
  Vec2 shift;

  IntoAperture(const RadarBasis& transmit, const Mirror& mirrors)
      : h(mirrors.L.transpose() * transmit.h),
        v(mirrors.L.transpose() * transmit.v),
        shift(mirrors.t.dot(transmit.h), mirrors.t.dot(transmit.v)) {}
  Vec2 operator()(const Vec3& x) const { return Vec2(h.dot(x), v.dot(x)) + shift; }
};

}  // namespace

std::vector<Vec2> outline_of(const Panels& panels, const RadarBasis& transmit, const Screen& screen) {
  const IntoAperture into(transmit, *screen.mirrors);
  const std::span<const Vec3> real = panels.outline(screen.facet);
  std::vector<Vec2> outline(real.size());
  std::ranges::transform(real, outline.begin(), into);
  return outline;
}

std::vector<Rim> rims_of(const SharpEdges& edges, const Panels& panels, const RadarBasis& transmit,
                         std::span<const Screen> screens) {
  std::vector<Rim> rims;
  rims.reserve(4 * screens.size());
  for (std::size_t i = 0; i < screens.size(); ++i) {
    const Screen& screen = screens[i];
    const IntoAperture into(transmit, *screen.mirrors);
    const Vec3 n = screen.mirrors->L.transpose() * normal_of(*screen.plane, transmit);
    std::vector<Vec2> outline;
    for (const PanelEdge& side : edges.of_panel(screen.facet)) {
      const SharpEdge& edge = edges.edges[side.edge];
      const WedgeFrame* wedge = wedge_lit(edge, side.first, screen.direction);
      if (!wedge || wedge->N <= 1) continue;
      if (outline.empty()) outline = outline_of(panels, transmit, screen);
      const Vec2 a = into(edge.a), b = into(edge.b), along = (b - a).normalized();
      Vec2 middle = Vec2::Zero();
      double depth = 0;
      for (const Vec2& p : outline) {
        middle += p / static_cast<double>(outline.size());
        depth = std::max(depth, std::abs(along.x() * (p - a).y() - along.y() * (p - a).x()));
      }
      if (depth > kShallow) rims.push_back({i, a, b, middle, into(edge.a + n.cross(edge.along())) - a, depth});
    }
  }
  return rims;
}

SideFrame::SideFrame(const Corner& start, const Corner& end)
    : from(start),
      to(end),
      length((end.p - start.p).norm()),
      along((end.p - start.p) / length),
      across(-along.y(), along.x()) {}

bool SideFrame::holds(const Rim& rim) const {
  return std::abs(x(rim.a)) <= kOnRim && std::abs(x(rim.b)) <= kOnRim && x(rim.inside) > 0;
}

RimWays::RimWays(const AntennaPair& antennas, std::span<const Screen> screens, const Footprint& footprint)
    : antennas_(antennas),
      basis_(antennas.transmit),
      screens_(screens),
      footprint_(footprint),
      normal_(normal_of(footprint.plane, basis_)),
      before_(mirrored(footprint.mirrors.L * antennas.receive.r, normal_)) {}

RimWays::Way RimWays::over(std::size_t screen, const Vec2& p) const {
  const Vec3 X = at(screen, p), beyond = X - 2 * normal_.dot(X - footprint_.plane.z0 * basis_.r) * normal_;
  const Vec3 Y = footprint_.mirrors.real(beyond);
  return {X, Y, basis_.r.dot(X) + antennas_.receive.r.dot(Y)};
}

Vec2 RimWays::landing(std::size_t screen, const Vec2& p) const {
  const Vec3 X = at(screen, p),
             landed = X - normal_.dot(X - footprint_.plane.z0 * basis_.r) / normal_.dot(before_) * before_;
  return {landed.dot(basis_.h), landed.dot(basis_.v)};
}

Vec2 RimWays::across(const Vec2& direction) const {
  return Vec2(-before_.dot(basis_.r), before_.dot(direction.x() * basis_.h + direction.y() * basis_.v)).normalized();
}

RimWays::Share RimWays::share(const Rim& rim, double slope) const {
  const Screen& mirror = screens_[rim.screen];
  // As they are at the rim: the way out, the normals of its face and of the last facet, and its own direction.
  const Mat3 real = mirror.mirrors->L.transpose();
  const Vec3 s = real * before_, last = real * normal_;
  Vec3 n = real * normal_of(*mirror.plane, basis_);
  if (n.dot(mirror.direction) > 0) n = -n;
  const Vec2 run = (rim.b - rim.a).normalized();
  const Vec3 along =
      real * (run.x() * basis_.h + run.y() * basis_.v + mirror.plane->slope.dot(run) * basis_.r).normalized();
  const double moved = rim_share(n, along, mirror.direction, s, last) *
                       lands_on(mirrored(mirror.direction, n), s, last) * (1 - fading(std::abs(slope), kFlat));
  return {moved, n.dot(s) > 0};
}

}  // namespace seaglint
