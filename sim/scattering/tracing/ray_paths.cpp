// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_paths.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>
#include <utility>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/scattering/geometry/look_basis.h"

namespace seaglint {

namespace {

// Aimed rays meet a panel inside its border by this fraction of the way to its middle.
constexpr double kInset = 0.02;
// Most aimed rays along one side, so that their number follows that of panels for any spacing.
constexpr double kMostAlongSide = 64;

Box projected_box(const Facet& facet, const RadarBasis& basis) {
  Box box{Vec2::Constant(std::numeric_limits<double>::infinity()),
          Vec2::Constant(-std::numeric_limits<double>::infinity())};
  for (const Vec3& corner : facet.corner) {
    const Vec2 p(corner.dot(basis.h), corner.dot(basis.v));
    box = {box.lower.cwiseMin(p), box.upper.cwiseMax(p)};
  }
  return box;
}

}  // namespace

RayLattice::RayLattice(const Scatterer& scatterer, const RadarBasis& basis, double spacing_m) : spacing_(spacing_m) {
  const std::span<const Facet> facets = scatterer.facets();
  Box all = projected_box(facets.front(), basis);
  for (const Facet& facet : facets) {
    const Box box = projected_box(facet, basis);
    all = {all.lower.cwiseMin(box.lower), all.upper.cwiseMax(box.upper)};
  }
  lower_ = all.lower - Vec2::Constant(0.5 * spacing_m);
  const Vec2 size = all.upper - lower_ + Vec2::Constant(0.5 * spacing_m);
  const double rays = size.x() / spacing_m * (size.y() / spacing_m);
  if (rays > kMaxRays)
    throw InputError(fmt::format("rays {:.4g} m apart over a target of {:.4g} x {:.4g} m are {:.2g}, more than {:.0e}",
                                 spacing_m, size.x(), size.y(), rays, kMaxRays));
  const double side = tile_side();
  const auto columns = static_cast<std::int64_t>(size.x() / side) + 1,
             rows = static_cast<std::int64_t>(size.y() / side) + 1;
  std::vector<std::int32_t> tile_at(static_cast<std::size_t>(columns * rows), -1);
  for (const Facet& facet : facets) {
    const Box box = projected_box(facet, basis);
    const Vec2 from = (box.lower - lower_) / side, to = (box.upper - lower_) / side;
    for (auto row = static_cast<std::int64_t>(from.y()); row <= static_cast<std::int64_t>(to.y()); ++row) {
      for (auto column = static_cast<std::int64_t>(from.x()); column <= static_cast<std::int64_t>(to.x()); ++column)
        tile_at[static_cast<std::size_t>(row * columns + column)] = 0;
    }
  }
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < columns; ++column) {
      std::int32_t& number = tile_at[static_cast<std::size_t>(row * columns + column)];
      if (number < 0) continue;
      number = static_cast<std::int32_t>(tiles_.size());
      tiles_.push_back({column, row});
    }
  }
  aim_at_panels(scatterer, basis, columns, tile_at);
}

void RayLattice::aim_at_panels(const Scatterer& scatterer, const RadarBasis& basis, std::int64_t columns,
                               std::span<const std::int32_t> tile_at) {
  const std::span<const Facet> facets = scatterer.facets();
  std::vector<std::pair<std::int32_t, Vec2>> rays;
  const auto aim = [&](const Vec3& x) {
    const Vec2 p(x.dot(basis.h), x.dot(basis.v)), at = (p - lower_) / tile_side();
    const auto column = static_cast<std::int64_t>(at.x()), row = static_cast<std::int64_t>(at.y());
    rays.emplace_back(tile_at[static_cast<std::size_t>(row * columns + column)], p);
  };
  for (int f = 0; f < static_cast<int>(facets.size()); ++f) {
    const std::span<const Vec3> outline = scatterer.panels().outline(f);
    if (outline.empty() || !(facets[f].two_sided || facets[f].normal.dot(basis.r) > 0)) continue;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : outline) middle += corner / static_cast<double>(outline.size());
    aim(middle);
    if (scatterer.surface().curved(f)) continue;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 &a = outline[i], along = outline[(i + 1) % outline.size()] - a;
      const int points = 1 + static_cast<int>(std::min(along.norm() / cell_side(0), kMostAlongSide - 1));
      for (int n = 0; n < points; ++n) aim(middle + (1 - kInset) * (a + (n + 0.5) / points * along - middle));
    }
  }
  std::ranges::stable_sort(rays, {}, &std::pair<std::int32_t, Vec2>::first);
  for (const auto& [tile, p] : rays) {
    Tile& of = tiles_[static_cast<std::size_t>(tile)];
    if (of.last == 0) of.first = aimed_.size();
    aimed_.push_back(p);
    of.last = aimed_.size();
  }
}

std::span<const Vec2> RayLattice::aimed(std::size_t tile) const {
  return std::span(aimed_).subspan(tiles_[tile].first, tiles_[tile].last - tiles_[tile].first);
}

PolygonSet RayLattice::window(std::size_t tile) const {
  const Vec2 low = lower_ +
                   tile_side() * Vec2(static_cast<double>(tiles_[tile].column), static_cast<double>(tiles_[tile].row)),
             high = low + Vec2::Constant(tile_side());
  MovingPolygon square;
  for (const Vec2& p : {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())})
    square.push_back({p, Vec2::Zero(), Vec2::Zero()});
  PolygonSet window;
  window.push_back(std::move(square));
  return window;
}

LatticeCell RayLattice::cell(std::size_t tile, std::int64_t i, std::int64_t j) const {
  return {0, tiles_[tile].column * kTileSide + i, tiles_[tile].row * kTileSide + j};
}

Vec2 RayLattice::ray(const LatticeCell& cell) const {
  const std::array<std::uint32_t, 4> bits =
      philox4x32({static_cast<std::uint32_t>(cell.column), static_cast<std::uint32_t>(cell.row),
                  static_cast<std::uint32_t>(cell.level), 0},
                 {static_cast<std::uint32_t>(Stream::kRayLattice), 0});
  return lower_ + cell_side(cell.level) * Vec2(static_cast<double>(cell.column) + 0x1p-32 * bits[0],
                                               static_cast<double>(cell.row) + 0x1p-32 * bits[1]);
}

LatticeCell RayLattice::quarter(const LatticeCell& cell, const Vec2& p) const {
  const Vec2 middle = lower_ + cell_side(cell.level) *
                                   Vec2(static_cast<double>(cell.column) + 0.5, static_cast<double>(cell.row) + 0.5);
  return {cell.level + 1, 2 * cell.column + (p.x() >= middle.x() ? 1 : 0),
          2 * cell.row + (p.y() >= middle.y() ? 1 : 0)};
}

namespace {

// Displacement from a panel at which rays start, in radii of the target: 30 times the rounding of Embree's coordinates.
constexpr double kOffSurface = 2e-6;

// Processor time of this thread, s.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, Proc. OOPSLA 2014, 453-472) of both numbers.
std::uint64_t mixed(std::uint64_t signature, std::uint64_t next) {
  std::uint64_t z = signature + (next + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace

RayPaths::RayPaths(const TracingContext& scene)
    : scene_(scene),
      facets_(scene.scatterer.facets()),
      embree_(scene.scatterer.ray_scene()),
      off_surface_(kOffSurface * scene.scatterer.radius()),
      child_of_panel_(facets_.size(), -1),
      bundle_of_panel_(facets_.size(), -1) {}

std::span<const Obstacle> RayPaths::obstacles(int path, std::size_t receiver) const {
  const auto number = static_cast<std::int32_t>(receiver);
  const auto first = std::ranges::lower_bound(obstacles_, Obstacle{path, number, -1}),
             last = std::ranges::lower_bound(obstacles_, Obstacle{path, number + 1, -1});
  return {first, last};
}

void RayPaths::start() {
  const RadarBasis& basis = scene_.transmit;
  for (const RayPath& path : paths_) {
    if (path.facet >= 0) bundle_of_panel_[static_cast<std::size_t>(path.facet)] = -1;
  }
  paths_.assign(1, {});
  paths_.front().direction = -basis.r;
  paths_.front().start = 2 * scene_.scatterer.radius() * basis.r;
  paths_.front().per_h = basis.h;
  paths_.front().per_v = basis.v;
  obstacles_.clear();
}

void RayPaths::trace(std::span<const Vec2> rays, std::span<std::uint64_t> signatures) {
  std::ranges::fill(signatures, 0);
  rays_.resize(rays.size());
  std::iota(rays_.begin(), rays_.end(), 0);
  bundles_.assign(1, {0, 0, rays.size()});
  for (int bounce = 1; bounce <= scene_.settings.max_bounces && !rays_.empty(); ++bounce) {
    batch_.clear();
    for (const Bundle& bundle : bundles_) {
      const RayPath& path = paths_[static_cast<std::size_t>(bundle.path)];
      for (std::size_t i = bundle.first; i < bundle.first + bundle.count; ++i)
        batch_.add(path.leaves_at(rays[rays_[i]]), path.direction);
    }
    first_hits();
    reflect(signatures);
    find_obstacles(rays, signatures);
    // Rays end in water, at lenses and at the walls of cavities.
    std::erase_if(bundles_, [&](const Bundle& bundle) {
      const int facet = paths_[static_cast<std::size_t>(bundle.path)].facet;
      return scene_.ends_beams(facet) || scene_.settings.filter.is_cavity(facets_[facet].part);
    });
    std::size_t kept = 0;
    for (Bundle& bundle : bundles_) {
      std::copy_n(rays_.begin() + static_cast<std::ptrdiff_t>(bundle.first), bundle.count,
                  rays_.begin() + static_cast<std::ptrdiff_t>(kept));
      bundle.first = kept;
      kept += bundle.count;
    }
    rays_.resize(kept);
  }
}

void RayPaths::finish() {
  std::ranges::sort(obstacles_);
  obstacles_.erase(std::unique(obstacles_.begin(), obstacles_.end()), obstacles_.end());
}

void RayPaths::mark_children(std::int32_t path) {
  for (std::int32_t i = paths_[static_cast<std::size_t>(path)].first_child; i >= 0;
       i = paths_[static_cast<std::size_t>(i)].next_sibling) {
    const auto at = static_cast<std::size_t>(paths_[static_cast<std::size_t>(i)].facet);
    bundle_of_panel_[at] = path;
    child_of_panel_[at] = i;
  }
}

void RayPaths::first_hits() {
  hits_.resize(batch_.size());
  const double start = thread_seconds();
  embree_.first_hits(batch_, hits_);
  embree_s_ += thread_seconds() - start;
  queries_ += batch_.size();
}

bool RayPaths::is_lit(int facet, const Vec3& direction) const {
  const double cosine = facets_[facet].normal.dot(direction);
  return facets_[facet].two_sided ? std::abs(cosine) > kInPlaneAngle : cosine < -kInPlaneAngle;
}

// Divides every bundle by the panels that its rays hit.
void RayPaths::reflect(std::span<std::uint64_t> signatures) {
  next_bundles_.clear();
  next_rays_.clear();
  for (const Bundle& bundle : bundles_) {
    child_.assign(bundle.count, -1);
    const Vec3 direction = paths_[static_cast<std::size_t>(bundle.path)].direction;
    mark_children(bundle.path);
    for (std::size_t i = 0; i < bundle.count; ++i) {
      const int hit = hits_[bundle.first + i];
      if (hit == kNoFacet) continue;
      const int panel = scene_.scatterer.panels().representative(hit);
      const auto at = static_cast<std::size_t>(panel);
      if (bundle_of_panel_[at] != bundle.path) {
        if (!is_lit(panel, direction)) continue;
        bundle_of_panel_[at] = bundle.path;
        child_of_panel_[at] = path_after(bundle.path, panel);
      }
      child_[i] = child_of_panel_[at];
      std::uint64_t& signature = signatures[rays_[bundle.first + i]];
      signature = mixed(signature, static_cast<std::uint64_t>(child_[i]));
    }
    group_by_child(bundle);
  }
  bundles_.swap(next_bundles_);
  rays_.swap(next_rays_);
}

// Appends the bundles of the children that rays of this bundle met, in the order of the first ray of each.
void RayPaths::group_by_child(const Bundle& bundle) {
  const std::size_t first_bundle = next_bundles_.size();
  place_of_child_.resize(paths_.size(), -1);
  for (const std::int32_t child : child_) {
    if (child < 0) continue;
    std::int32_t& place = place_of_child_[static_cast<std::size_t>(child)];
    if (place < 0) {
      place = static_cast<std::int32_t>(next_bundles_.size());
      next_bundles_.push_back({child, 0, 0});
    }
    ++next_bundles_[static_cast<std::size_t>(place)].count;
  }
  std::size_t end = next_rays_.size();
  for (std::size_t i = first_bundle; i < next_bundles_.size(); ++i) {
    Bundle& next = next_bundles_[i];
    next.first = end;
    end += next.count;
    next.count = 0;
  }
  next_rays_.resize(end);
  for (std::size_t i = 0; i < bundle.count; ++i) {
    if (child_[i] < 0) continue;
    Bundle& next = next_bundles_[static_cast<std::size_t>(place_of_child_[static_cast<std::size_t>(child_[i])])];
    next_rays_[next.first + next.count++] = rays_[bundle.first + i];
  }
  for (std::size_t i = first_bundle; i < next_bundles_.size(); ++i)
    place_of_child_[static_cast<std::size_t>(next_bundles_[i].path)] = -1;
}

std::int32_t RayPaths::path_after(std::int32_t parent, int panel) {
  const RayPath before = paths_[static_cast<std::size_t>(parent)];
  const RadarBasis& basis = scene_.transmit;
  RayPath path;
  path.facet = panel;
  path.parent = parent;
  path.bounce = static_cast<std::uint8_t>(before.bounce + 1);
  path.next_sibling = before.first_child;
  const Facet& facet = facets_[panel];
  const Vec3 n = facet.normal.dot(before.direction) < 0 ? facet.normal : Vec3(-facet.normal);
  const Mat3& L = before.image_transform.L;
  const Vec3 n_image = L * n;
  const double offset = n.dot(facet.corner[0]);
  const DepthPlane plane = depth_plane(n_image, offset + n_image.dot(before.image_transform.t), basis);
  path.image_transform = before.image_transform * plane_reflection(n, offset);
  path.direction = reflect_direction(before.direction, n);
  path.start = L.transpose() * (plane.z0 * basis.r - before.image_transform.t) + off_surface_ * n;
  path.per_h = L.transpose() * (basis.h + plane.slope.x() * basis.r);
  path.per_v = L.transpose() * (basis.v + plane.slope.y() * basis.r);
  const auto number = static_cast<std::int32_t>(paths_.size());
  paths_.push_back(path);
  paths_[static_cast<std::size_t>(parent)].first_child = number;
  return number;
}

void RayPaths::find_obstacles(std::span<const Vec2> rays, std::span<std::uint64_t> signatures) {
  for (std::size_t receiver = 0; receiver < scene_.receivers.size(); ++receiver) {
    const BistaticGeometry& geometry = scene_.receivers[receiver].geometry;
    // A receiver at the transmitter sees exactly the illuminated part of the first reflector.
    const auto is_asked = [&](const Bundle& bundle) {
      const RayPath& path = paths_[static_cast<std::size_t>(bundle.path)];
      if (path.bounce == 1 && geometry.monostatic) return false;
      const Facet& facet = facets_[path.facet];
      const Vec3& before = paths_[static_cast<std::size_t>(path.parent)].direction;
      const double side = facet.normal.dot(before) < 0 ? 1 : -1;
      return side * facet.normal.dot(geometry.receive.r) > kEdgeOn;
    };
    batch_.clear();
    for (const Bundle& bundle : bundles_) {
      if (!is_asked(bundle)) continue;
      const RayPath& path = paths_[static_cast<std::size_t>(bundle.path)];
      for (std::size_t i = bundle.first; i < bundle.first + bundle.count; ++i)
        batch_.add(path.leaves_at(rays[rays_[i]]), geometry.receive.r);
    }
    first_hits();
    std::size_t at = 0;
    for (const Bundle& bundle : bundles_) {
      if (!is_asked(bundle)) continue;
      for (std::size_t i = 0; i < bundle.count; ++i, ++at) {
        if (hits_[at] == kNoFacet) continue;
        const Obstacle obstacle{bundle.path, static_cast<std::int32_t>(receiver),
                                scene_.scatterer.panels().representative(hits_[at])};
        if (obstacles_.empty() || obstacles_.back() != obstacle) obstacles_.push_back(obstacle);
        std::uint64_t& signature = signatures[rays_[bundle.first + i]];
        signature = mixed(signature, (static_cast<std::uint64_t>(obstacle.facet) << 16 | receiver) + (1ull << 63));
      }
    }
  }
}

}  // namespace seaglint
