// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/rays/ray_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

// Rays of a tile are ordered by squares of this side: packets of 16 are compact.
constexpr std::int64_t kPacketSide = 4;

Box projected_box(const Facet& facet, const RadarBasis& basis) {
  Box box{Vec2::Constant(std::numeric_limits<double>::infinity()),
          Vec2::Constant(-std::numeric_limits<double>::infinity())};
  for (const Vec3& corner : facet.corner) {
    const Vec2 p(corner.dot(basis.h), corner.dot(basis.v));
    box = {box.lower.cwiseMin(p), box.upper.cwiseMax(p)};
  }
  return box;
}

// Two numbers of [0, 1), a function of the square alone.
Vec2 place_in_square(std::int64_t column, std::int64_t row) {
  const std::array<std::uint32_t, 4> bits =
      philox4x32({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), 0, 0},
                 {static_cast<std::uint32_t>(Stream::kRayLattice), 0});
  return 0x1p-32 * Vec2(bits[0], bits[1]);
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
  const double rays = (size / spacing_m).prod();
  if (rays > kMaxRays)
    throw InputError(fmt::format("rays {:.4g} m apart over a target of {:.4g} x {:.4g} m are {:.2g}, more than {:.0e}",
                                 spacing_m, size.x(), size.y(), rays, kMaxRays));
  const double side = static_cast<double>(kTileSide) * spacing_m;
  const auto columns = static_cast<std::int64_t>(size.x() / side) + 1,
             rows = static_cast<std::int64_t>(size.y() / side) + 1;
  std::vector<bool> met(static_cast<std::size_t>(columns * rows), false);
  for (const Facet& facet : facets) {
    const Box box = projected_box(facet, basis);
    const Vec2 from = (box.lower - lower_) / side, to = (box.upper - lower_) / side;
    for (auto row = static_cast<std::int64_t>(from.y()); row <= static_cast<std::int64_t>(to.y()); ++row) {
      for (auto column = static_cast<std::int64_t>(from.x()); column <= static_cast<std::int64_t>(to.x()); ++column)
        met[static_cast<std::size_t>(row * columns + column)] = true;
    }
  }
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < columns; ++column) {
      if (met[static_cast<std::size_t>(row * columns + column)]) tiles_.push_back({column, row});
    }
  }
}

Vec2 RayLattice::corner(const Tile& tile) const {
  return lower_ + static_cast<double>(kTileSide) * spacing_ *
                      Vec2(static_cast<double>(tile.column), static_cast<double>(tile.row));
}

PolygonSet RayLattice::window(std::size_t tile) const {
  const Vec2 low = corner(tiles_[tile]), high = corner({tiles_[tile].column + 1, tiles_[tile].row + 1});
  MovingPolygon square;
  for (const Vec2& p : {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())})
    square.push_back({p, Vec2::Zero(), Vec2::Zero()});
  PolygonSet window;
  window.push_back(std::move(square));
  return window;
}

void RayLattice::rays_of(std::size_t tile, std::vector<Vec2>& rays) const {
  const Tile& at = tiles_[tile];
  const Vec2 low = corner(at);
  rays.clear();
  for (std::int64_t j = 0; j < kTileSide; j += kPacketSide) {
    for (std::int64_t i = 0; i < kTileSide; i += kPacketSide) {
      for (std::int64_t square = 0; square < kPacketSide * kPacketSide; ++square) {
        const std::int64_t column = i + square % kPacketSide, row = j + square / kPacketSide;
        const Vec2 place = place_in_square(at.column * kTileSide + column, at.row * kTileSide + row);
        rays.push_back(low + spacing_ * (Vec2(static_cast<double>(column), static_cast<double>(row)) + place));
      }
    }
  }
}

}  // namespace seaglint
