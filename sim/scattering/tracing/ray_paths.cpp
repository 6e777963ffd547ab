// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_paths.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

#include "sim/scattering/geometry/tolerances.h"

namespace seaglint {
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
    // Rays end in water and at the walls of cavities.
    std::erase_if(bundles_, [&](const Bundle& bundle) {
      const int facet = paths_[static_cast<std::size_t>(bundle.path)].facet;
      return scene_.is_submerged(facet) || scene_.settings.filter.is_cavity(facets_[facet].part);
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
