// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sum of many point contributions on an oversampled range-velocity grid, evaluated at every frequency and instant: a
// non-uniform FFT, exact in the coupling of frequency and velocity (range migration is not approximated).
//
// When the look direction moves along a straight line, r^(t) - r^_0 = s(t) w^, every contribution is a point (psi, u),
// u = gradient . w^:
//     H(k_q, s) = sum_j F_q[j] e^{j k_q u_j s} / ( phi^(m_q dk h) phi^(k_q du s) ),   k_q = k_c + m_q dk,
// where F_q[j] is the Fourier transform along psi of the amplitudes spread with the kernel phi. Kernel: "exponential of
// semicircle" of A. H. Barnett, J. Magland and L. af Klinteberg, SIAM J. Sci. Comput. 41 (2019) C479, eq. 1.8, width W
// = 6, oversampling 2: relative error 1e-5.
//
// A cross-track displacement q(t) changes the phase of a point by k v q, v = gradient . (cross-track direction), less
// than a cycle: the first terms of e^{jkvq} = sum (jkvq)^p / p! are used, each with a grid of the amplitudes times v^p.

#include <span>
#include <vector>

#include "sim/scattering/observation/look_directions.h"
#include "sim/scattering/points/decomposition.h"

namespace seaglint {

// Uniform frequency grid as wavenumbers k_q = first + q step, q = 0..count-1, count >= 1.
struct WavenumberGrid {
  double first = 0;  // rad/m
  double step = 0;   // rad/m, > 0
  int count = 1;

  double at(int q) const { return first + q * step; }
  int centre_index() const { return count / 2; }
};

// One polarisation of a point contribution, with its path rates.
struct GridPoint {
  Complex amplitude;  // with the pattern, without the phase e^{jk psi}, m
  double psi = 0;     // m
  double u = 0;       // d psi / ds, m
  double v = 0;       // d psi / dq, m
};

// Bounds of the path rates, m, and of the displacements, rad: along-track u, s and cross-track v, q.
struct GridLimits {
  double u = 0, s = 0;
  double v = 0, q = 0;
};

// Largest cross-track phase k v q of a grid, for which its series has five terms.
inline constexpr double kMaxCrossTrackPhase = 1.2;  // rad

class ResponseGrid {
 public:
  // Bounds of |u|, |s| and |q|. For points with |v| <= limits.v and a product k limits.v limits.q of at most
  // kMaxCrossTrackPhase the truncation error is below 3 % of the point; a larger |v| counts as limits.v.
  ResponseGrid(const WavenumberGrid& wavenumbers, const GridLimits& limits);

  void spread(std::span<const GridPoint> points);
  // Adds a grid constructed with the same arguments.
  void add(const ResponseGrid& other);

  // Fourier transform along psi; required before response().
  void transform();
  // H at wavenumbers first..first + out.size() - 1 for displacements |s| <= limits.s along-track and |cross_track| <=
  // limits.q.
  void response(int first, double s, double cross_track, std::span<Complex> out) const;

 private:
  std::size_t cell(int u, int psi) const { return static_cast<std::size_t>(u) * row_length_ + psi; }
  std::size_t cells_per_term() const { return static_cast<std::size_t>(u_cells_) * row_length_; }

  WavenumberGrid wavenumbers_;
  double kc_;                // at centre_index()
  int psi_cells_;            // at least 2 count, with factors 2, 3 and 5 only
  int row_length_ = 0;       // of one u: a period and the kernel's width
  double psi_cell_;          // m
  double u_cell_, u_first_;  // m
  int u_cells_;
  double v_limit_;                      // m; the grid of term p holds amplitudes times (v / v_limit)^p
  int terms_;                           // of the series in q, 1..5
  std::vector<Complex> cells_;          // [term][u][psi], after transform() [term][u][frequency]
  std::vector<double> psi_correction_;  // 1 / phi^ per frequency
};

// Limits of what an interval's sum takes from a trace of a scatterer.
struct IntervalLimits {
  double faint_m = 0;  // half of all points, mostly tapered or cancelling end points, are weaker
  // A shadow boundary at grazing incidence slides along its facet much faster than any point of the body. Its rate is
  // limited to that of a point at four radii: such end points are weak and cross many velocity cells.
  double slide_m = 0;
  // Cross-track path rate of body-fixed points for a track tangent of unit length; contributions of shadow boundaries
  // that exceed it are weak.
  double cross_track_m = 0;
};
IntervalLimits interval_limits(const Scatterer& scatterer, double faint_m);

// Sum of the contributions to one polarisation over the band and the look directions of an interval.
class IntervalSum {
 public:
  // channel: index of the polarisation in a scattering matrix. The path must outlive the object.
  IntervalSum(const LookDirectionPath& path, const PointBand& at, const IntervalLimits& limits, int channel,
              std::size_t chunks)
      : path_(path), at_(at), limits_(limits), channel_(static_cast<std::size_t>(channel)), chunks_(chunks) {}

  // Adds to one chunk, which one thread fills.
  void add(std::size_t chunk, std::span<const Contribution> contributions, const Observation& observation);

  // The sum; bits do not depend on the number of threads.
  ResponseGrid grid(const WavenumberGrid& wavenumbers, int threads) const;

 private:
  // Aligned to cache lines: threads fill neighbouring chunks concurrently.
  struct alignas(64) Chunk {
    std::vector<GridPoint> points;
    std::vector<Point> of_contribution;  // work memory
  };

  const LookDirectionPath& path_;
  PointBand at_;
  IntervalLimits limits_;
  std::size_t channel_;
  std::vector<Chunk> chunks_;
};

}  // namespace seaglint
