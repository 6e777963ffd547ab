// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/wall_patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

struct Piece {
  Vec3 centre;  // m
  Vec3 normal;  // unit
  double area;  // m^2
};

// Halved triangles form regular patterns: distances that differ by less than this are treated as equal, so that
// rounding does not decide.
constexpr double kTie = 1e-9;
constexpr std::size_t kMaxPieces = 5'000'000;

// Halves the longest side until none is longer than `longest`.
void cut(const Vec3& a, const Vec3& b, const Vec3& c, double longest, std::vector<Piece>& pieces) {
  const std::array<double, 3> side{(b - a).norm(), (c - b).norm(), (a - c).norm()};
  const auto which = std::max_element(side.begin(), side.end()) - side.begin();
  if (side[static_cast<std::size_t>(which)] > longest) {
    const std::array<Vec3, 3> x{a, b, c};
    const Vec3 &p = x[which], &q = x[(which + 1) % 3], &r = x[(which + 2) % 3];
    const Vec3 middle = 0.5 * (p + q);
    cut(p, middle, r, longest, pieces);
    cut(middle, q, r, longest, pieces);
    return;
  }
  const Vec3 area = 0.5 * (b - a).cross(c - a);
  if (!(area.norm() > 0)) return;
  if (pieces.size() == kMaxPieces)
    throw InputError("the cavity's walls are made of too many or too thin triangles: mesh them anew");
  pieces.push_back({(a + b + c) / 3, area.normalized(), area.norm()});
}

struct Seed {
  Vec3 centre, normal;
};

// Seeds in the cells of a lattice, for neighbour search.
class SeedLattice {
 public:
  explicit SeedLattice(double cell) : cell_(cell) {}

  void add(const Vec3& x, int seed) { cells_[key(cell_of(x))].push_back(seed); }

  template <typename Visit>
  void near(const Vec3& x, const Visit& visit) const {
    const Cell middle = cell_of(x);
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find(key({middle[0] + i, middle[1] + j, middle[2] + k}));
          if (found == cells_.end()) continue;
          for (const int seed : found->second) visit(seed);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3& x) const {
    return {std::llround(x.x() / cell_), std::llround(x.y() / cell_), std::llround(x.z() / cell_)};
  }
  // 21 bits a side: cells of equal key are far apart, and distances are always tested.
  static std::uint64_t key(const Cell& c) {
    constexpr std::uint64_t kMask = (1u << 21) - 1;
    return (static_cast<std::uint64_t>(c[0]) & kMask) << 42 | (static_cast<std::uint64_t>(c[1]) & kMask) << 21 |
           (static_cast<std::uint64_t>(c[2]) & kMask);
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

}  // namespace

std::vector<WallPatch> wall_patches(const TriangleMesh& walls, double size) {
  const double area = surface_area(walls);
  const auto refuse_more = [&](double patches) {
    if (patches > kMaxPatches)
      throw InputError(fmt::format(
          "the cavity's {:.3g} m^2 of walls need about {:.0f} patches of {:.3g} m at this wavelength: at most {}", area,
          patches, size, kMaxPatches));
  };
  refuse_more(area / (size * size));
  std::vector<Piece> pieces;
  for (const auto& t : walls.triangles)
    cut(walls.vertices[t[0]], walls.vertices[t[1]], walls.vertices[t[2]], size / 3, pieces);

  // Perpendicular normals add a distance of 1.4 sizes.
  const auto distance2 = [&](const Piece& piece, const Seed& seed) {
    return (piece.centre - seed.centre).squaredNorm() + size * size * (piece.normal - seed.normal).squaredNorm();
  };
  // Minimum distance of seeds, so that each has an area of about size x size.
  const double min_distance = 0.94 * size;
  std::vector<Seed> seeds;
  SeedLattice first(size);
  for (const Piece& piece : pieces) {
    bool free = true;
    first.near(piece.centre, [&](int s) {
      free = free && distance2(piece, seeds[static_cast<std::size_t>(s)]) >= min_distance * min_distance * (1 - kTie);
    });
    if (!free) continue;
    first.add(piece.centre, static_cast<int>(seeds.size()));
    seeds.push_back({piece.centre, piece.normal});
  }

  std::vector<int> owner(pieces.size(), -1);
  std::vector<double> owned;
  constexpr int kRounds = 5;  // eight change the mean of a box with a duct by 0.01 dB
  for (int round = 0; round < kRounds; ++round) {
    SeedLattice lattice(size);
    for (std::size_t s = 0; s < seeds.size(); ++s) lattice.add(seeds[s].centre, static_cast<int>(s));
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      double nearest = std::numeric_limits<double>::infinity();
      lattice.near(pieces[p].centre, [&](int s) {
        const double d = distance2(pieces[p], seeds[static_cast<std::size_t>(s)]);
        if (d < nearest * (1 - kTie) || (d <= nearest * (1 + kTie) && s < owner[p])) {
          nearest = d;
          owner[p] = s;
        }
      });
    }
    std::vector<Vec3> centre(seeds.size(), Vec3::Zero()), normal(seeds.size(), Vec3::Zero());
    owned.assign(seeds.size(), 0);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const auto s = static_cast<std::size_t>(owner[p]);
      centre[s] += pieces[p].area * pieces[p].centre;
      normal[s] += pieces[p].area * pieces[p].normal;
      owned[s] += pieces[p].area;
    }
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      if (owned[s] > 0) seeds[s] = {centre[s] / owned[s], normal[s].normalized()};
    }
  }

  std::vector<WallPatch> patches;
  for (std::size_t s = 0; s < seeds.size(); ++s) {
    if (owned[s] <= 0) continue;
    const Vec3 n = seeds[s].normal, t = n.unitOrthogonal();
    patches.push_back({seeds[s].centre, n, {t, n.cross(t)}, owned[s]});
  }
  refuse_more(static_cast<double>(patches.size()));
  return patches;
}

}  // namespace seaglint
