// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/wall_currents.h"

#include <fmt/format.h>

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
constexpr std::size_t kBlock = 512;
constexpr std::size_t kTile = 32;      // patches of a block per thread task
constexpr std::size_t kColumns = 128;  // patches whose coupling to a tile is formed at once: numbers within the cache
constexpr std::size_t kColumnsPerSolve = 32;  // excitations for which one assembly of the coupling serves
constexpr std::size_t kMaxIterations = 150;

using Line = std::array<float, kBlock>;  // at most one number per patch of a block

// Writes cos and sin of n angles >= 0 in cycles, below 4 million, to rounding: half of the fraction by its series,
// |x| <= pi/2, then the double-angle formula. The library functions would take a third of the solution time.
void phasors(const Line& turns, std::size_t n, Line& cosine, Line& sine) {
  constexpr float kRound = 1.5f * (1 << 23);  // adding and subtracting it rounds to the nearest integer
  for (std::size_t i = 0; i < n; ++i) {
    const float x = static_cast<float>(kPi) * (turns[i] - ((turns[i] + kRound) - kRound)), x2 = x * x;
    const float s =
        x * (1 + x2 * (-1 / 6.f + x2 * (1 / 120.f + x2 * (-1 / 5040.f + x2 * (1 / 362880.f - x2 / 39916800.f)))));
    const float c =
        1 + x2 * (-1 / 2.f +
                  x2 * (1 / 24.f + x2 * (-1 / 720.f + x2 * (1 / 40320.f + x2 * (-1 / 3628800.f + x2 / 479001600.f)))));
    cosine[i] = 1 - 2 * s * s;
    sine[i] = 2 * s * c;
  }
}

Complex inner_product(std::span<const ComplexFloat> a, std::span<const ComplexFloat> b) {
  Complex sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += Complex(std::conj(a[i])) * Complex(b[i]);
  return sum;
}

double norm(std::span<const ComplexFloat> a) { return std::sqrt(inner_product(a, a).real()); }

void add(ComplexFloat factor, std::span<const ComplexFloat> a, std::span<ComplexFloat> to) {
  for (std::size_t i = 0; i < a.size(); ++i) to[i] += factor * a[i];
}

void scale(std::span<ComplexFloat> a, double factor) {
  for (ComplexFloat& value : a) value *= static_cast<float>(factor);
}

// GMRES state of one excitation: its column of every Krylov direction, and the least-squares solution (Saad and Schultz
// 1986, algorithm 3).
struct KrylovColumn {
  std::size_t column = 0;
  double length = 0;                              // norm of the excitation
  std::vector<std::vector<Complex>> projections;  // column m of the Hessenberg matrix, m + 2 numbers
  ComplexMatrix weights;                          // of the directions in the solution, one column
  double residual = 0;
  bool exact = false;  // the Krylov space contains the solution

  // Orthogonalises the column of `next`, the image of the last direction, into a new direction.
  void add_direction(const std::vector<WallMatrix>& directions, WallMatrix& next) {
    if (length == 0 || exact) return;
    const std::size_t known = directions.size();
    const std::span<ComplexFloat> image = next.column(column);
    std::vector<Complex> projection;
    for (const WallMatrix& direction : directions) {
      projection.push_back(inner_product(direction.column(column), image));
      add(ComplexFloat(-projection.back()), direction.column(column), image);
    }
    const double rest = norm(image);
    projection.emplace_back(rest);
    projections.push_back(std::move(projection));
    exact = !(rest > 0);
    if (!exact) scale(image, 1 / rest);

    ComplexMatrix hessenberg(known + 1, known), right(known + 1, 1);
    for (std::size_t m = 0; m < known; ++m) std::ranges::copy(projections[m], hessenberg.column(m).begin());
    right(0, 0) = length;
    weights = least_squares(hessenberg, right);
    const ComplexMatrix reached = product(hessenberg, weights);
    double squares = 0;
    for (std::size_t m = 0; m <= known; ++m) squares += std::norm(right(m, 0) - reached(m, 0));
    residual = std::sqrt(squares);
  }

  // Adds the weighted sum of the directions.
  void sum(const std::vector<WallMatrix>& directions, WallMatrix& into) const {
    for (std::size_t m = 0; m < weights.rows(); ++m)
      add(ComplexFloat(weights(m, 0)), directions[m].column(column), into.column(column));
  }
};

// Columns first ... first + count - 1.
WallMatrix columns_of(const WallMatrix& a, std::size_t first, std::size_t count) {
  WallMatrix part(a.rows(), count);
  for (std::size_t c = 0; c < count; ++c) std::ranges::copy(a.column(first + c), part.column(c).begin());
  return part;
}

}  // namespace

struct WallCurrents::Patches {
  std::size_t first = 0, last = 0;

  std::size_t count() const { return last - first; }
  RowRange rows() const { return {2 * first, 2 * count()}; }  // of a WallMatrix
};

std::size_t WallCurrents::blocks() const { return (patches_ + kBlock - 1) / kBlock; }

WallCurrents::Patches WallCurrents::block(std::size_t i) const {
  return {i * kBlock, std::min(patches_, (i + 1) * kBlock)};
}

// 2 n x (grad G x t') A' on either tangent t of the patches `to`, transposed, from a unit current along t' on `from`:
//   t . [n x (grad G x t')] = (t . grad G)(n . t') - (t . t')(n . grad G), grad G = -(1 + jkR) e^{-jkR} / (4 pi R^3) R
//   with R from the source to the patch. The self term of a plane patch is zero.
WallMatrix WallCurrents::coupling(const Patches& to, const Patches& from) const {
  const std::size_t first = from.first, n = from.count();
  const float k = static_cast<float>(k_), cycles = static_cast<float>(k_ / (2 * kPi));
  WallMatrix transposed(2 * n, 2 * to.count());
  Line X, Y, Z, r, turns, cosine, sine, real, imaginary;
  const auto at = [](const PatchVectors& v, std::size_t i) { return std::array<float, 3>{v[0][i], v[1][i], v[2][i]}; };
  for (std::size_t i = to.first; i < to.last; ++i) {
    const auto centre = at(centre_, i), normal = at(normal_, i);
    for (std::size_t j = 0; j < n; ++j) {
      X[j] = centre[0] - centre_[0][first + j];
      Y[j] = centre[1] - centre_[1][first + j];
      Z[j] = centre[2] - centre_[2][first + j];
      r[j] = std::sqrt(X[j] * X[j] + Y[j] * Y[j] + Z[j] * Z[j]);
      turns[j] = cycles * r[j];
    }
    phasors(turns, n, cosine, sine);
    for (std::size_t j = 0; j < n; ++j) {
      const float level = -area_[first + j] / (static_cast<float>(2 * kPi) * (r[j] * r[j]) * r[j]), kr = k * r[j];
      real[j] = level * (cosine[j] + kr * sine[j]);
      imaginary[j] = level * (kr * cosine[j] - sine[j]);
    }
    for (std::size_t a = 0; a < 2; ++a) {
      const auto t = at(tangent_[a], i);
      const std::span<ComplexFloat> column = transposed.column(2 * (i - to.first) + a);
      for (std::size_t b = 0; b < 2; ++b) {
        const float *x = &tangent_[b][0][first], *y = &tangent_[b][1][first], *z = &tangent_[b][2][first];
        for (std::size_t j = 0; j < n; ++j) {
          const float along = t[0] * X[j] + t[1] * Y[j] + t[2] * Z[j],
                      height = normal[0] * X[j] + normal[1] * Y[j] + normal[2] * Z[j];
          const float shape = along * (normal[0] * x[j] + normal[1] * y[j] + normal[2] * z[j]) -
                              (t[0] * x[j] + t[1] * y[j] + t[2] * z[j]) * height;
          column[2 * j + b] = {real[j] * shape, imaginary[j] * shape};
        }
      }
      if (i >= from.first && i < from.last) std::ranges::fill(column.subspan(2 * (i - first), 2), ComplexFloat(0));
    }
  }
  return transposed;
}

WallCurrents::WallCurrents(std::span<const WallPatch> walls, double k, int threads, const StopFlag* stop)
    : patches_(walls.size()), k_(k), own_(blocks()) {
  Vec3 middle = Vec3::Zero();  // origin in the cavity, since distances are in single precision
  for (const WallPatch& patch : walls) middle += patch.centre / static_cast<double>(walls.size());
  const auto append = [](const Vec3& v, PatchVectors& to) {
    for (int axis = 0; axis < 3; ++axis) to[static_cast<std::size_t>(axis)].push_back(static_cast<float>(v[axis]));
  };
  for (const WallPatch& wall : walls) {
    area_.push_back(static_cast<float>(wall.area));
    append(wall.centre - middle, centre_);
    append(wall.normal, normal_);
    for (std::size_t t = 0; t < 2; ++t) append(wall.tangent[t], tangent_[t]);
  }
  parallel_for(
      blocks(), threads,
      [&](std::size_t i) {
        const Patches own = block(i);
        const WallMatrix coupled = coupling(own, own);
        WallMatrix system(coupled.columns(), coupled.rows());
        for (std::size_t a = 0; a < system.rows(); ++a) {
          for (std::size_t b = 0; b < system.columns(); ++b) system(a, b) = (a == b ? 1.0f : 0.0f) - coupled(b, a);
        }
        own_[i] = LuFactors(system);
      },
      stop);
}

// Product D x, D the diagonal blocks.
WallMatrix WallCurrents::apply_diagonal_blocks(const WallMatrix& x, int threads) const {
  WallMatrix result = x;
  parallel_for(blocks(), threads, [&](std::size_t i) {
    const Patches own = block(i);
    add_transposed_product(-1, coupling(own, own), x, own.rows(), result, own.rows());
  });
  return result;
}

// Solves (D - K_L) y = x (upwards: K_U), D the diagonal blocks, K_L the coupling from preceding blocks.
WallMatrix WallCurrents::half_sweep(const WallMatrix& x, bool upwards, int threads, const StopFlag* stop) const {
  WallMatrix known = x, y(x.rows(), x.columns());
  for (std::size_t n = 0; n < blocks(); ++n) {
    const std::size_t at = upwards ? blocks() - 1 - n : n;
    const Patches own = block(at);
    const Patches done = upwards ? Patches{own.last, patches_} : Patches{0, own.first};
    const std::size_t tiles = (own.count() + kTile - 1) / kTile;
    parallel_for(
        done.count() == 0 ? 0 : tiles, threads,
        [&](std::size_t t) {
          const Patches tile{own.first + t * kTile, std::min(own.last, own.first + (t + 1) * kTile)};
          for (std::size_t j = done.first; j < done.last; j += kColumns) {
            const Patches from{j, std::min(done.last, j + kColumns)};
            add_transposed_product(1, coupling(tile, from), y, from.rows(), known, tile.rows());
          }
        },
        stop);
    own_[at].solve(known, y, own.rows());
  }
  return y;
}

// Generalised minimal residuals (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986, 856-869) per column,
// preconditioned by one sweep inwards and one outwards, as forward-backward iterations (Burkholder and Lundin, IEEE
// Trans. AP-53, 2005, 793-799). With 1 - K = D - K_L - K_U and T = (D - K_U)^-1 D,
//   (D - K_L)^-1 (1 - K) T = T + (D - K_L)^-1 D (1 - T)
// so that each application needs one product with K (Eisenstat, SIAM J. Sci. Stat. Comput. 2, 1981, 1-4).
WallMatrix WallCurrents::solve(const WallMatrix& driven, std::span<const double> strength, int threads,
                               const StopFlag* stop) const {
  WallMatrix currents(driven.rows(), 0);
  double strongest = 0;
  for (std::size_t c = 0; c < driven.columns(); ++c)
    strongest = std::max(strongest, norm(driven.column(c)) * strength[c]);
  for (std::size_t first = 0; first < driven.columns(); first += kColumnsPerSolve) {
    const std::size_t count = std::min(kColumnsPerSolve, driven.columns() - first);
    std::vector<WallMatrix> directions{half_sweep(columns_of(driven, first, count), false, threads, stop)};
    std::vector<KrylovColumn> fields(count);
    for (std::size_t c = 0; c < count; ++c) {
      const std::span<ComplexFloat> direction = directions.front().column(c);
      fields[c].column = c;
      fields[c].length = norm(direction);
      if (fields[c].length > 0) scale(direction, 1 / fields[c].length);
    }
    for (double worst = strongest; worst > kResidual * strongest;) {
      if (directions.size() > kMaxIterations)
        throw WorkError(fmt::format("cavity currents did not converge in {} iterations: residual {:.1e}",
                                    kMaxIterations, worst / strongest));
      const WallMatrix outward = half_sweep(apply_diagonal_blocks(directions.back(), threads), true, threads, stop);
      WallMatrix rest = directions.back(), next = outward;
      for (std::size_t c = 0; c < count; ++c) add(-1, outward.column(c), rest.column(c));
      const WallMatrix inward = half_sweep(apply_diagonal_blocks(rest, threads), false, threads, stop);
      for (std::size_t c = 0; c < count; ++c) add(1, inward.column(c), next.column(c));
      worst = 0;
      for (KrylovColumn& field : fields) {
        field.add_direction(directions, next);
        const double left = field.residual * strength[first + field.column];
        if (!std::isfinite(left))
          throw WorkError("the cavity's currents have no finite solution: walls too near each other for their patches");
        worst = std::max(worst, left);
      }
      directions.push_back(std::move(next));
    }
    WallMatrix sum(driven.rows(), count);
    for (const KrylovColumn& field : fields) field.sum(directions, sum);
    currents.append(half_sweep(apply_diagonal_blocks(sum, threads), true, threads, stop));
  }
  return currents;
}

}  // namespace seaglint
