// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/ray_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

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

}  // namespace seaglint
