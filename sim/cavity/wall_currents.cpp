// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/wall_currents.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/core/constants.h"
#include "sim/core/error.h"

namespace seaglint {
namespace {

// Patches that are solved together. A duct of 3,000: 19, 17, 12, 7 sweeps with 64, 128, 256, 512 of them; with more the
// blocks' own solutions take over.
constexpr std::size_t kBlock = 512;
constexpr std::size_t kTile = 32;      // patches of a block whose rows one thread takes at a time
constexpr std::size_t kColumns = 128;  // patches whose coupling to a tile is formed at once: 64 x 256 numbers stay in the cache
constexpr Eigen::Index kTogether = 32;  // fields solved side by side, which share the coupling's making
constexpr int kMostSweeps = 100;

// e^{-j 2 pi x}, to 2e-7: sine and cosine of the fraction's eighth turn by their series. A third of the solution's time
// would go into the library's.
std::complex<float> turned_back(double x) {
  const auto whole = static_cast<std::int64_t>(4 * x + 0.5);  // quarters of a turn, x >= 0
  const auto a = static_cast<float>((kPi / 2) * (4 * x - static_cast<double>(whole))), a2 = a * a;
  const float sine = a * (1 + a2 * (-1 / 6.f + a2 * (1 / 120.f + a2 * (-1 / 5040.f + a2 / 362880.f))));
  const float cosine = 1 + a2 * (-1 / 2.f + a2 * (1 / 24.f + a2 * (-1 / 720.f + a2 / 40320.f)));
  switch (whole & 3) {
    case 0: return {cosine, -sine};
    case 1: return {-sine, -cosine};
    case 2: return {-cosine, sine};
    default: return {sine, cosine};
  }
}

// Least squares of one column of the block: minimises |beta e_1 - H y| (Saad and Schultz 1986, eq. 12).
Eigen::VectorXcd least_squares(const Eigen::MatrixXcd& hessenberg, double beta, double* residual) {
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(hessenberg.rows());
  right(0) = beta;
  const Eigen::VectorXcd y = hessenberg.householderQr().solve(right);
  *residual = (right - hessenberg * y).norm();
  return y;
}

}  // namespace

struct WallCurrents::Rows {
  std::size_t first = 0, last = 0;

  Eigen::Index start() const { return static_cast<Eigen::Index>(2 * first); }
  Eigen::Index count() const { return static_cast<Eigen::Index>(2 * (last - first)); }
};

std::size_t WallCurrents::blocks() const { return (walls_.size() + kBlock - 1) / kBlock; }

WallCurrents::Rows WallCurrents::block(std::size_t i) const { return {i * kBlock, std::min(walls_.size(), (i + 1) * kBlock)}; }

// 2 n x (grad G x t') A' on either tangent t of the patches `to`, transposed, from a unit current along t' on `from`:
//   t . [n x (grad G x t')] = (t . grad G)(n . t') - (t . t')(n . grad G),  grad G = -(1 + jkR) e^{-jkR} / (4 pi R^3) R
// with R from the source to the patch. A patch does not act on itself: it is flat.
WallColumns WallCurrents::coupling(const Rows& to, const Rows& from) const {
  WallColumns transposed(from.count(), to.count());
  for (std::size_t i = to.first; i < to.last; ++i) {
    const WallPatch& patch = walls_[i];
    for (std::size_t j = from.first; j < from.last; ++j) {
      const WallPatch& source = walls_[j];
      const Vec3 R = patch.centre - source.centre;
      const double r2 = R.squaredNorm();
      std::complex<float> g = 0;
      if (i != j) {
        const double r = std::sqrt(r2), kr = k_ * r, level = -source.area / (2 * kPi * r2 * r);
        const std::complex<float> wave = turned_back(kr / (2 * kPi));
        const auto real = static_cast<float>(level), imaginary = static_cast<float>(level * kr);
        g = {real * wave.real() - imaginary * wave.imag(), real * wave.imag() + imaginary * wave.real()};
      }
      const double height = patch.normal.dot(R);
      for (int a = 0; a < 2; ++a) {
        const double along = patch.tangent[a].dot(R);
        for (int b = 0; b < 2; ++b) {
          const double shape = along * patch.normal.dot(source.tangent[b]) - patch.tangent[a].dot(source.tangent[b]) * height;
          transposed(static_cast<Eigen::Index>(2 * (j - from.first) + b), static_cast<Eigen::Index>(2 * (i - to.first) + a)) =
              g * static_cast<float>(shape);
        }
      }
    }
  }
  return transposed;
}

WallCurrents::WallCurrents(std::span<const WallPatch> walls, double k, int threads, const StopFlag* stop)
    : walls_(walls), k_(k), own_(blocks()) {
  parallel_for(
      blocks(), threads,
      [&](std::size_t i) {
        const Rows rows = block(i);
        own_[i].compute(WallColumns::Identity(rows.count(), rows.count()) - coupling(rows, rows).transpose());
      },
      stop);
}

// D x.
WallColumns WallCurrents::own(const WallColumns& x, int threads) const {
  WallColumns result = x;
  parallel_for(blocks(), threads, [&](std::size_t i) {
    const Rows rows = block(i);
    result.middleRows(rows.start(), rows.count()).noalias() -= coupling(rows, rows).transpose() * x.middleRows(rows.start(), rows.count());
  });
  return result;
}

// y of (D - K_L) y = x (or with K_U, upwards), D the blocks' own parts and K_L what the blocks before each one send it.
WallColumns WallCurrents::solve_one_way(const WallColumns& x, bool upwards, int threads, const StopFlag* stop) const {
  WallColumns y(x.rows(), x.cols());
  for (std::size_t n = 0; n < blocks(); ++n) {
    const std::size_t at = upwards ? blocks() - 1 - n : n;
    const Rows rows = block(at);
    WallColumns known = x.middleRows(rows.start(), rows.count());
    const Rows done = upwards ? Rows{rows.last, walls_.size()} : Rows{0, rows.first};
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

// Generalised minimal residuals (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986, 856-869) of each column by itself,
// preconditioned by a sweep inwards and one outwards, as forward-backward iterations do (Burkholder and Lundin, IEEE
// Trans. AP-53, 2005, 793-799). With 1 - K = D - K_L - K_U and T = (D - K_U)^-1 D,
//   (D - K_L)^-1 (1 - K) T = T + (D - K_L)^-1 D (1 - T)
// so that each application costs one product with K (Eisenstat, SIAM J. Sci. Stat. Comput. 2, 1981, 1-4).
WallColumns WallCurrents::solve(const WallColumns& driven, const Eigen::VectorXd& strength, int threads, const StopFlag* stop) const {
  WallColumns currents(driven.rows(), driven.cols());
  double strongest = 0;
  for (Eigen::Index c = 0; c < driven.cols(); ++c) strongest = std::max(strongest, strength(c) * driven.col(c).norm());
  for (Eigen::Index first = 0; first < driven.cols(); first += kTogether) {
    const Eigen::Index count = std::min(kTogether, driven.cols() - first);
    WallColumns v = solve_one_way(driven.middleCols(first, count), false, threads, stop);
    std::vector<double> beta(static_cast<std::size_t>(count));
    std::vector<Eigen::MatrixXcd> hessenberg(beta.size());
    std::vector<Eigen::VectorXcd> y(beta.size());
    for (Eigen::Index c = 0; c < count; ++c) {
      beta[static_cast<std::size_t>(c)] = v.col(c).norm();
      if (beta[static_cast<std::size_t>(c)] > 0) v.col(c) /= static_cast<float>(beta[static_cast<std::size_t>(c)]);
    }
    std::vector<WallColumns> basis{std::move(v)};
    double worst = 1;
    while (worst > kResidual) {
      const auto sweep = static_cast<Eigen::Index>(basis.size());
      if (sweep > kMostSweeps) throw WorkError(fmt::format("the cavity's currents did not settle in {} sweeps: residual {:.1e}", kMostSweeps, worst));
      const WallColumns outward = solve_one_way(own(basis.back(), threads), true, threads, stop);
      WallColumns next = outward + solve_one_way(own(basis.back() - outward, threads), false, threads, stop);
      worst = 0;
      for (Eigen::Index c = 0; c < count; ++c) {
        const auto at = static_cast<std::size_t>(c);
        if (beta[at] == 0) continue;
        hessenberg[at].conservativeResizeLike(Eigen::MatrixXcd::Zero(sweep + 1, sweep));
        for (Eigen::Index m = 0; m < sweep; ++m) {
          const std::complex<float> share = basis[static_cast<std::size_t>(m)].col(c).dot(next.col(c));
          hessenberg[at](m, sweep - 1) = share;
          next.col(c) -= share * basis[static_cast<std::size_t>(m)].col(c);
        }
        const float length = next.col(c).norm();
        hessenberg[at](sweep, sweep - 1) = length;
        if (length > 0) next.col(c) /= length;
        double residual = 0;
        y[at] = least_squares(hessenberg[at], beta[at], &residual);
        worst = std::max(worst, residual * strength(first + c) / strongest);
      }
      basis.push_back(std::move(next));
    }
    WallColumns sum = WallColumns::Zero(driven.rows(), count);
    for (Eigen::Index c = 0; c < count; ++c) {
      const Eigen::VectorXcd& weights = y[static_cast<std::size_t>(c)];
      for (Eigen::Index m = 0; m < weights.size(); ++m)
        sum.col(c) += std::complex<float>(weights(m)) * basis[static_cast<std::size_t>(m)].col(c);
    }
    currents.middleCols(first, count) = solve_one_way(own(sum, threads), true, threads, stop);
  }
  return currents;
}

}  // namespace seaglint
