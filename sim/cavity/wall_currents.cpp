// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/wall_currents.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "sim/core/numbers/constants.h"
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

namespace {

// Patches per diagonal block. A duct of 3,000 patches: 19, 17, 12, 7 iterations with 64, 128, 256, 512; beyond, the
// solution of the blocks dominates the cost.
constexpr int kBlock = 512;
constexpr std::size_t kTile = 32;  // patches of a block per thread task
// patches whose coupling to a tile is formed at once: 64 x 256 numbers, within the cache
constexpr std::size_t kColumns = 128;
constexpr Eigen::Index kColumnsPerSolve =
    32;  // excitations solved together, which projection the assembly of the coupling
constexpr std::size_t kMaxIterations = 150;

// At most one number per patch of a block; SSE processes four at a time.
using Line = Eigen::Array<float, Eigen::Dynamic, 1, 0, kBlock, 1>;

struct Phasors {
  Line cosine, sine;
};

// Phasors of angles >= 0 in cycles, below 4 million, to rounding: half of the fraction by its series, |x| <= pi/2, then
// the double-angle formula. The library functions would take a third of the solution time.
Phasors phasors(const Line& turns) {
  constexpr float kRound = 1.5f * (1 << 23);  // adding and subtracting it rounds to the nearest integer
  const Line x = static_cast<float>(kPi) * (turns - ((turns + kRound) - kRound)), x2 = x.square();
  const Line sine =
      x * (1 + x2 * (-1 / 6.f + x2 * (1 / 120.f + x2 * (-1 / 5040.f + x2 * (1 / 362880.f - x2 / 39916800.f)))));
  const Line cosine =
      1 + x2 * (-1 / 2.f +
                x2 * (1 / 24.f + x2 * (-1 / 720.f + x2 * (1 / 40320.f + x2 * (-1 / 3628800.f + x2 / 479001600.f)))));
  return {1 - 2 * sine.square(), 2 * sine * cosine};
}

// GMRES state of one excitation: its column of every Krylov direction, and the least-squares solution (Saad and Schultz
// 1986, algorithm 3).
struct KrylovColumn {
  Eigen::Index column = 0;
  double length = 0;  // norm of the excitation
  Eigen::MatrixXcd hessenberg;
  Eigen::VectorXcd weights;  // of the directions in the solution
  double residual = 0;
  bool exact = false;  // the Krylov space contains the solution

  // Orthogonalises the column of `next`, the image of the last direction, into a new direction.
  void add(const std::vector<WallMatrix>& directions, WallMatrix& next) {
    if (length == 0 || exact) return;
    const auto known = static_cast<Eigen::Index>(directions.size());
    hessenberg.conservativeResizeLike(Eigen::MatrixXcd::Zero(known + 1, known));
    for (Eigen::Index m = 0; m < known; ++m) {
      const auto direction = directions[static_cast<std::size_t>(m)].col(column);
      const std::complex<float> projection = direction.dot(next.col(column));
      hessenberg(m, known - 1) = projection;
      next.col(column) -= projection * direction;
    }
    const float rest = next.col(column).norm();
    hessenberg(known, known - 1) = rest;
    exact = !(rest > 0);
    if (!exact) next.col(column) /= rest;
    const Eigen::VectorXcd right = length * Eigen::VectorXcd::Unit(known + 1, 0);
    weights = hessenberg.householderQr().solve(right);
    residual = (right - hessenberg * weights).norm();
  }

  // Weighted sum of the directions.
  void sum(const std::vector<WallMatrix>& directions, WallMatrix& into) const {
    for (Eigen::Index m = 0; m < weights.size(); ++m)
      into.col(column) += std::complex<float>(weights(m)) * directions[static_cast<std::size_t>(m)].col(column);
  }
};

}  // namespace

struct WallCurrents::Rows {
  std::size_t first = 0, last = 0;

  Eigen::Index start() const { return static_cast<Eigen::Index>(2 * first); }
  Eigen::Index count() const { return static_cast<Eigen::Index>(2 * (last - first)); }
};

std::size_t WallCurrents::blocks() const { return (patches_ + kBlock - 1) / kBlock; }

WallCurrents::Rows WallCurrents::block(std::size_t i) const {
  return {i * kBlock, std::min(patches_, (i + 1) * kBlock)};
}

// 2 n x (grad G x t') A' on either tangent t of the patches `to`, transposed, from a unit current along t' on `from`:
//   t . [n x (grad G x t')] = (t . grad G)(n . t') - (t . t')(n . grad G), grad G = -(1 + jkR) e^{-jkR} / (4 pi R^3) R
//   with R from the source to the patch. The self term of a plane patch is zero.
WallMatrix WallCurrents::coupling(const Rows& to, const Rows& from) const {
  WallMatrix transposed(from.count(), to.count());
  const auto first = static_cast<Eigen::Index>(from.first), count = static_cast<Eigen::Index>(from.last - from.first);
  const auto dot = [&](const Eigen::Vector3f& a, const Eigen::ArrayX3f& b) -> Line {
    return a.x() * b.col(0).segment(first, count) + a.y() * b.col(1).segment(first, count) +
           a.z() * b.col(2).segment(first, count);
  };
  for (std::size_t i = to.first; i < to.last; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const auto column = 2 * static_cast<Eigen::Index>(i - to.first);
    const Eigen::Vector3f centre = centre_.row(at), normal = normal_.row(at);
    const Line X = centre.x() - centre_.col(0).segment(first, count),
               Y = centre.y() - centre_.col(1).segment(first, count),
               Z = centre.z() - centre_.col(2).segment(first, count);
    const Line r2 = X.square() + Y.square() + Z.square(), r = r2.sqrt(), kr = static_cast<float>(k_) * r;
    const auto [cosine, sine] = phasors(static_cast<float>(k_ / (2 * kPi)) * r);
    const Line level = -area_.segment(first, count) / (static_cast<float>(2 * kPi) * r2 * r);
    const Line real = level * (cosine + kr * sine), imaginary = level * (kr * cosine - sine);
    const auto towards = [&](const Eigen::Vector3f& v) -> Line { return v.x() * X + v.y() * Y + v.z() * Z; };
    const Line height = towards(normal);
    for (int a = 0; a < 2; ++a) {
      const Eigen::Vector3f t = tangent_[a].row(at);
      const Line along = towards(t);
      for (int b = 0; b < 2; ++b) {
        const Line shape = along * dot(normal, tangent_[b]) - dot(t, tangent_[b]) * height;
        Eigen::Map<Eigen::ArrayXcf, 0, Eigen::InnerStride<2>> line(&transposed(b, column + a), count);
        line.real() = real * shape;
        line.imag() = imaginary * shape;
      }
    }
    if (i >= from.first && i < from.last)
      transposed.block(2 * static_cast<Eigen::Index>(i - from.first), column, 2, 2).setZero();
  }
  return transposed;
}

WallCurrents::WallCurrents(std::span<const WallPatch> walls, double k, int threads, const StopFlag* stop)
    : patches_(walls.size()),
      k_(k),
      area_(static_cast<Eigen::Index>(patches_)),
      centre_(area_.size(), 3),
      normal_(area_.size(), 3),
      own_(blocks()) {
  tangent_.fill(Eigen::ArrayX3f(area_.size(), 3));
  Vec3 middle = Vec3::Zero();  // origin in the cavity, since distances are in single precision
  for (const WallPatch& patch : walls) middle += patch.centre / static_cast<double>(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    area_(at) = static_cast<float>(walls[i].area);
    const Vec3 centre = walls[i].centre - middle;
    for (int axis = 0; axis < 3; ++axis) {
      centre_(at, axis) = static_cast<float>(centre[axis]);
      normal_(at, axis) = static_cast<float>(walls[i].normal[axis]);
      for (int t = 0; t < 2; ++t) tangent_[t](at, axis) = static_cast<float>(walls[i].tangent[t][axis]);
    }
  }
  parallel_for(
      blocks(), threads,
      [&](std::size_t i) {
        const Rows rows = block(i);
        own_[i].compute(WallMatrix::Identity(rows.count(), rows.count()) - coupling(rows, rows).transpose());
      },
      stop);
}

// Product D x, D the diagonal blocks.
WallMatrix WallCurrents::apply_diagonal_blocks(const WallMatrix& x, int threads) const {
  WallMatrix result = x;
  parallel_for(blocks(), threads, [&](std::size_t i) {
    const Rows rows = block(i);
    result.middleRows(rows.start(), rows.count()).noalias() -=
        coupling(rows, rows).transpose() * x.middleRows(rows.start(), rows.count());
  });
  return result;
}

// Solves (D - K_L) y = x (upwards: K_U), D the diagonal blocks, K_L the coupling from preceding blocks.
WallMatrix WallCurrents::half_sweep(const WallMatrix& x, bool upwards, int threads, const StopFlag* stop) const {
  WallMatrix y(x.rows(), x.cols());
  for (std::size_t n = 0; n < blocks(); ++n) {
    const std::size_t at = upwards ? blocks() - 1 - n : n;
    const Rows rows = block(at);
    WallMatrix known = x.middleRows(rows.start(), rows.count());
    const Rows done = upwards ? Rows{rows.last, patches_} : Rows{0, rows.first};
    const std::size_t tiles = (rows.last - rows.first + kTile - 1) / kTile;
    parallel_for(
        done.first == done.last ? 0 : tiles, threads,
        [&](std::size_t t) {
          const Rows tile{rows.first + t * kTile, std::min(rows.last, rows.first + (t + 1) * kTile)};
          for (std::size_t j = done.first; j < done.last; j += kColumns) {
            const Rows from{j, std::min(done.last, j + kColumns)};
            known.middleRows(tile.start() - rows.start(), tile.count()).noalias() +=
                coupling(tile, from).transpose() * y.middleRows(from.start(), from.count());
          }
        },
        stop);
    y.middleRows(rows.start(), rows.count()) = own_[at].solve(known);
  }
  return y;
}

// Generalised minimal residuals (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986, 856-869) per column,
// preconditioned by one sweep inwards and one outwards, as forward-backward iterations (Burkholder and Lundin, IEEE
// Trans. AP-53, 2005, 793-799). With 1 - K = D - K_L - K_U and T = (D - K_U)^-1 D,
//   (D - K_L)^-1 (1 - K) T = T + (D - K_L)^-1 D (1 - T)
// so that each application needs one product with K (Eisenstat, SIAM J. Sci. Stat. Comput. 2, 1981, 1-4).
WallMatrix WallCurrents::solve(const WallMatrix& driven, const Eigen::VectorXd& strength, int threads,
                               const StopFlag* stop) const {
  WallMatrix currents(driven.rows(), driven.cols());
  const double strongest = (driven.colwise().norm().transpose().cast<double>().array() * strength.array()).maxCoeff();
  for (Eigen::Index first = 0; first < driven.cols(); first += kColumnsPerSolve) {
    const Eigen::Index count = std::min(kColumnsPerSolve, driven.cols() - first);
    std::vector<WallMatrix> directions{half_sweep(driven.middleCols(first, count), false, threads, stop)};
    std::vector<KrylovColumn> fields(static_cast<std::size_t>(count));
    for (Eigen::Index c = 0; c < count; ++c) {
      auto direction = directions.front().col(c);
      fields[static_cast<std::size_t>(c)].column = c;
      fields[static_cast<std::size_t>(c)].length = direction.norm();
      direction.normalize();
    }
    for (double worst = strongest; worst > kResidual * strongest;) {
      if (directions.size() > kMaxIterations)
        throw WorkError(fmt::format("cavity currents did not converge in {} iterations: residual {:.1e}",
                                    kMaxIterations, worst / strongest));
      const WallMatrix outward = half_sweep(apply_diagonal_blocks(directions.back(), threads), true, threads, stop);
      WallMatrix next =
          outward + half_sweep(apply_diagonal_blocks(directions.back() - outward, threads), false, threads, stop);
      worst = 0;
      for (KrylovColumn& field : fields) {
        field.add(directions, next);
        const double left = field.residual * strength(first + field.column);
        if (!std::isfinite(left))
          throw WorkError("the cavity's currents have no finite solution: walls too near each other for their patches");
        worst = std::max(worst, left);
      }
      directions.push_back(std::move(next));
    }
    WallMatrix sum = WallMatrix::Zero(driven.rows(), count);
    for (const KrylovColumn& field : fields) field.sum(directions, sum);
    currents.middleCols(first, count) = half_sweep(apply_diagonal_blocks(sum, threads), true, threads, stop);
  }
  return currents;
}

}  // namespace seaglint
