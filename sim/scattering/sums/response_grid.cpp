// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/response_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/process/error.h"
#include "sim/core/process/parallel.h"

namespace seaglint {
namespace {

constexpr int kWidth = 6;                // cells
constexpr double kBeta = 2.30 * kWidth;  // Barnett et al. 2019, section 4.2, for oversampling 2

// Number of terms of e^{jx} with a truncation error below 3 %, estimated by the first omitted one, x^p / p!.
constexpr int terms_of_series(double x) {
  int terms = 1;
  for (double next = x; next > 0.03; ++terms) next *= x / (terms + 1);
  return terms;
}
static_assert(terms_of_series(kMaxCrossTrackPhase) == 5);

// phi(x), x in cells, |x| <= W/2.
double kernel(double x) {
  const double z = 2 * x / kWidth;
  const double inside = 1 - z * z;
  return inside <= 0 ? 0 : std::exp(kBeta * (std::sqrt(inside) - 1));
}

// phi^(theta) = integral of phi(x) cos(theta x) dx over its support, theta in rad per cell. The substitution x = W/2
// sin a removes the end-point singularities of the square root; the midpoint rule then converges exponentially.
double kernel_transform(double theta) {
  constexpr int kPoints = 64;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double a = kPi * ((i + 0.5) / kPoints - 0.5);
    sum += std::exp(kBeta * (std::cos(a) - 1)) * std::cos(theta * 0.5 * kWidth * std::sin(a)) * std::cos(a);
  }
  return sum * kPi / kPoints * 0.5 * kWidth;
}

// phi^ for |theta| up to a quarter of a cycle per cell: a Chebyshev series in theta^2, of which phi^ is an entire
// function. The last coefficients are below 1e-15 of the first.
class KernelTransform {
 public:
  KernelTransform() {
    for (int i = 0; i < kTerms; ++i) {
      for (int n = 0; n < kTerms; ++n) {
        const double angle = kPi * (n + 0.5) / kTerms;
        coefficient_[i] +=
            2.0 / kTerms * std::cos(i * angle) * kernel_transform(std::sqrt(0.5 * kMaxSquared * (1 + std::cos(angle))));
      }
    }
  }

  double operator()(double theta) const {
    const double x = 2 * theta * theta / kMaxSquared - 1;
    if (x > 1) return kernel_transform(theta);
    double next = 0, after = 0;  // Clenshaw's recurrence
    for (int i = kTerms - 1; i > 0; --i) {
      const double here = 2 * x * next - after + coefficient_[i];
      after = next;
      next = here;
    }
    return x * next - after + 0.5 * coefficient_[0];
  }

 private:
  static constexpr int kTerms = 20;
  static constexpr double kMaxSquared = 0.26 * kPi * kPi;  // slightly above (pi / 2)^2
  std::array<double, kTerms> coefficient_{};
};

double fast_kernel_transform(double theta) {
  static const KernelTransform transform;
  return transform(theta);
}

// phi at the cells 0..W-1 for a point `offset` cells after the first, W/2 - 1 <= offset <= W/2: linear interpolation in
// a table, error phi'' / (8 n^2) = 7e-7, far below the error of the kernel.
std::array<double, kWidth> weights(double offset) {
  constexpr int kSteps = 512, kBefore = kWidth / 2 - 1;
  static const auto table = [] {
    std::array<std::array<double, kWidth>, kSteps + 1> values;
    for (int n = 0; n <= kSteps; ++n) {
      for (int i = 0; i < kWidth; ++i) values[n][i] = kernel(i - kBefore - static_cast<double>(n) / kSteps);
    }
    return values;
  }();
  const double place = (offset - kBefore) * kSteps;
  const int n = std::clamp(static_cast<int>(place), 0, kSteps - 1);
  std::array<double, kWidth> w;
  for (int i = 0; i < kWidth; ++i) w[i] = table[n][i] + (place - n) * (table[n + 1][i] - table[n][i]);
  return w;
}

// The smallest length >= n with factors 2, 3 and 5 only.
int fft_length(int n) {
  for (;; ++n) {
    int rest = n;
    for (const int factor : {2, 3, 5}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return n;
  }
}

// j^n z.
Complex times_j(const Complex& z, int n) {
  const Complex turned = n % 2 == 0 ? z : Complex(-z.imag(), z.real());
  return n % 4 < 2 ? turned : -turned;
}

}  // namespace

ResponseGrid::ResponseGrid(const WavenumberGrid& wavenumbers, const GridLimits& limits)
    : wavenumbers_(wavenumbers), kc_(wavenumbers.at(wavenumbers.centre_index())), v_limit_(limits.v) {
  SEAGLINT_CHECK(wavenumbers.count >= 1 && wavenumbers.step > 0 && kc_ > 0,
                 fmt::format("count {}, step {}, centre {}", wavenumbers.count, wavenumbers.step, kc_));
  psi_cells_ = fft_length(std::max(2 * wavenumbers.count, 2 * kWidth));
  psi_cell_ = 2 * kPi / (wavenumbers.step * psi_cells_);
  // Displacements up to s_limit give phases e^{jk u s}: cells of half the Nyquist spacing at the upper end of the band.
  // A body at rest has one cell.
  const double k_last = wavenumbers.at(wavenumbers.count - 1);
  const double s_bound = std::max(limits.s, 1e-3 / (k_last * std::max(limits.u, 1e-9)));
  u_cell_ = kPi / (2 * k_last * s_bound);
  const int half = static_cast<int>(std::ceil(limits.u / u_cell_)) + kWidth / 2 + 1;
  u_cells_ = 2 * half + 1;
  u_first_ = -half * u_cell_;
  row_length_ = psi_cells_ + kWidth;
  terms_ = terms_of_series(std::min(k_last * limits.v * limits.q, kMaxCrossTrackPhase));
  cells_.assign(terms_ * cells_per_term(), 0.0);

  psi_correction_.resize(wavenumbers.count);
  for (int q = 0; q < wavenumbers.count; ++q) {
    const int m = q - wavenumbers.centre_index();
    psi_correction_[q] = 1 / fast_kernel_transform(m * wavenumbers.step * psi_cell_);
  }
}

void ResponseGrid::spread(std::span<const GridPoint> points) {
  for (const GridPoint& point : points) {
    const Complex value = point.amplitude * std::polar(1.0, kc_ * point.psi);
    const double beside = terms_ > 1 ? std::clamp(point.v / v_limit_, -1.0, 1.0) : 0;

    // The grid is periodic in psi: frequencies on a grid of step dk do not distinguish psi from psi + 2 pi / dk.
    const double x = point.psi / psi_cell_;
    const int first_psi = static_cast<int>(std::ceil(x - 0.5 * kWidth));
    const auto along_psi = weights(x - first_psi);
    const double y = (point.u - u_first_) / u_cell_;
    const int first_u = static_cast<int>(std::ceil(y - 0.5 * kWidth));
    SEAGLINT_CHECK(first_u >= 0 && first_u + kWidth <= u_cells_,
                   fmt::format("u = {} m lies outside the grid", point.u));
    const auto along_u = weights(y - first_u);

    // A row extends W cells beyond its period, so that a kernel is never cut; transform() adds these cells to its
    // start.
    const int column = ((first_psi % psi_cells_) + psi_cells_) % psi_cells_;
    double power = 1;  // of the cross-track rate
    for (int term = 0; term < terms_; ++term, power *= beside) {
      Complex* of_term = &cells_[term * cells_per_term()];
      for (int j = 0; j < kWidth; ++j) {
        const double weight = power * along_u[j], re = weight * value.real(), im = weight * value.imag();
        auto* cells = reinterpret_cast<double*>(of_term + cell(first_u + j, column));
        for (int i = 0; i < kWidth; ++i) {
          cells[2 * i] += along_psi[i] * re;
          cells[2 * i + 1] += along_psi[i] * im;
        }
      }
    }
  }
}

void ResponseGrid::add(const ResponseGrid& other) {
  SEAGLINT_CHECK(cells_.size() == other.cells_.size(),
                 fmt::format("{} and {} cells", cells_.size(), other.cells_.size()));
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i] += other.cells_[i];
}

void ResponseGrid::transform() {
  const int rows = terms_ * u_cells_;
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < kWidth; ++i) cells_[cell(row, i)] += cells_[cell(row, psi_cells_ + i)];
  }
  transform_rows(cells_.data(), psi_cells_, rows, row_length_, Fourier::kInverse);
}

void ResponseGrid::response(int first, double s, double cross_track, std::span<Complex> out) const {
  // Several frequencies in parallel, real and imaginary parts in separate arrays, for vectorisation by the compiler.
  constexpr std::size_t kLanes = 8;
  for (std::size_t begin = 0; begin < out.size(); begin += kLanes) {
    const std::size_t lanes = std::min(kLanes, out.size() - begin);
    // e^{jk u_j s} by recurrence over the cells in u.
    std::array<double, kLanes> turn_re{}, turn_im{}, step_re{}, step_im{}, sum_re{}, sum_im{};
    std::array<std::size_t, kLanes> bin{};
    std::array<double, kLanes> phase{};  // k v_limit q
    for (std::size_t l = 0; l < lanes; ++l) {
      const int q = first + static_cast<int>(begin + l);
      const int m = q - wavenumbers_.centre_index();
      const double k = wavenumbers_.at(q);
      bin[l] = static_cast<std::size_t>((m % psi_cells_ + psi_cells_) % psi_cells_);
      const Complex turn = std::polar(1.0, k * u_first_ * s), step = std::polar(1.0, k * u_cell_ * s);
      turn_re[l] = turn.real();
      turn_im[l] = turn.imag();
      step_re[l] = step.real();
      step_im[l] = step.imag();
      phase[l] = k * v_limit_ * cross_track;
    }
    for (int u = 0; u < u_cells_; ++u) {
      std::array<double, kLanes> re, im;
      const Complex* row = &cells_[cell(u, 0)];
      for (std::size_t l = 0; l < kLanes; ++l) {
        re[l] = row[bin[l]].real();
        im[l] = row[bin[l]].imag();
      }
      std::array<double, kLanes> power_term;  // phase^term / term!, without the factor j^term
      power_term.fill(1);
      for (int term = 1; term < terms_; ++term) {
        row += cells_per_term();
        for (std::size_t l = 0; l < kLanes; ++l) {
          power_term[l] *= phase[l] / term;
          const Complex more = power_term[l] * times_j(row[bin[l]], term);
          re[l] += more.real();
          im[l] += more.imag();
        }
      }
      for (std::size_t l = 0; l < kLanes; ++l) {
        sum_re[l] += re[l] * turn_re[l] - im[l] * turn_im[l];
        sum_im[l] += re[l] * turn_im[l] + im[l] * turn_re[l];
        const double next = turn_re[l] * step_re[l] - turn_im[l] * step_im[l];
        turn_im[l] = turn_re[l] * step_im[l] + turn_im[l] * step_re[l];
        turn_re[l] = next;
      }
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      const int q = first + static_cast<int>(begin + l);
      const double weight = psi_correction_[q] / fast_kernel_transform(wavenumbers_.at(q) * u_cell_ * s);
      out[begin + l] = weight * Complex(sum_re[l], sum_im[l]);
    }
  }
}

IntervalLimits interval_limits(const Scatterer& scatterer, double faint_m) {
  return {faint_m, 8 * scatterer.radius(), std::numbers::sqrt2 * scatterer.radius()};
}

void IntervalSum::add(std::size_t chunk, std::span<const Contribution> contributions, const Observation& observation) {
  auto& [grid_points, points] = chunks_[chunk];
  for (const Contribution& contribution : contributions) {
    points.clear();
    decompose(contribution, observation, at_, points);
    for (const Point& point : points) {
      const Complex amplitude = point.amplitude[0] * point.pattern_at(0, channel_);
      if (std::norm(amplitude) < limits_.faint_m * limits_.faint_m) continue;
      const double limit = std::min(1.0, limits_.slide_m / point.gradient.sum().norm());
      grid_points.push_back({amplitude, point.psi, limit * path_.along_track.path_rate(point.gradient),
                             limit * path_.cross_track.path_rate(point.gradient)});
    }
  }
}

ResponseGrid IntervalSum::grid(const WavenumberGrid& wavenumbers, int threads) const {
  // Points are spread on this many grids for any number of threads, each for every fourth chunk; they are added in
  // order.
  constexpr std::size_t kGrids = 4;
  double fastest = 0;
  for (const Chunk& chunk : chunks_) {
    for (const GridPoint& point : chunk.points) fastest = std::max(fastest, std::abs(point.u));
  }
  const GridLimits limits{fastest, path_.s_limit, limits_.cross_track_m, path_.q_limit};
  std::vector<ResponseGrid> grids(kGrids, ResponseGrid(wavenumbers, limits));
  parallel_for(kGrids, threads, [&](std::size_t g) {
    for (std::size_t chunk = g; chunk < chunks_.size(); chunk += kGrids) grids[g].spread(chunks_[chunk].points);
  });
  ResponseGrid sum = std::move(grids[0]);
  for (std::size_t g = 1; g < kGrids; ++g) sum.add(grids[g]);
  sum.transform();
  return sum;
}

}  // namespace seaglint
