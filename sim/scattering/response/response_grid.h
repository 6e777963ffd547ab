// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The sum of many contributions on an oversampled range x velocity grid, and from it the response at every frequency
// and instant: a non-uniform FFT, exact in the coupling of frequency and velocity (range migration needs no
// approximation).
//
// With the direction moving along a straight line of the sphere, r^(t) - r^_0 = s(t) w^, every contribution is a point
// (psi, u), u = gradient . w^:
//     H(k_q, s) = sum_j F_q[j] e^{j k_q u_j s} / ( phi^(m_q dk h) phi^(k_q du s) ),   k_q = k_c + m_q dk,
// where F_q[j] is the Fourier transform along psi of the amplitudes spread with the kernel phi. Kernel: "exponential of
// semicircle" of A. H. Barnett, J. Magland and L. af Klinteberg, SIAM J. Sci. Comput. 41 (2019) C479, eq. 1.8, width W
// = 6, oversampling 2: relative error 1e-5.
//
// A path that bends leaves the line by q(t), which turns a point's phase by k v q, v = gradient . (the way it bends):
// less than a cycle, so that the first terms of e^{jkvq} = sum (jkvq)^p / p! do, each with a grid of its own of the
// amplitudes times v^p.

#include <span>
#include <vector>

#include "sim/scattering/surfaces/point_contributions.h"

namespace seaglint {

// A uniform frequency grid as wavenumbers k_q = first + q step, q = 0..count-1, count >= 1.
struct WavenumberGrid {
  double first = 0;  // rad/m
  double step = 0;   // rad/m, > 0
  int count = 1;

  double at(int q) const { return first + q * step; }
  int centre_index() const { return count / 2; }
};

// What one polarisation channel and one track need of a contribution.
struct GridPoint {
  Complex amplitude;  // pattern included, without the phase e^{jk psi}, m
  double psi = 0;     // m
  double u = 0;       // d psi / ds, m
  double v = 0;       // d psi / dq, m
};

// How fast points go, m, and how far the direction moves, rad: along the track and beside it.
struct GridLimits {
  double u = 0, s = 0;
  double v = 0, q = 0;
};

// Phase k v q beside the track that a grid takes: its series then has five terms.
inline constexpr double kMaxCrossTrackPhase = 1.2;  // rad

class ResponseGrid {
 public:
  // Bounds of |u| and |s|; for |q| <= limits.q and points with |v| <= limits.v, whose product times k is at most
  // kMaxCrossTrackPhase, the terms left out are below 3 % of such a point. A larger |v| counts as limits.v.
  ResponseGrid(const WavenumberGrid& wavenumbers, const GridLimits& limits);

  void spread(std::span<const GridPoint> points);
  // Adds another grid made with the same arguments.
  void add(const ResponseGrid& other);

  // Transforms along psi; afterwards the response can be asked for.
  void transform();
  // H at wavenumbers first..first + out.size() - 1 for the displacements |s| <= limits.s along the track and
  // |beside| <= limits.q beside it.
  void response(int first, double s, double cross_track, std::span<Complex> out) const;

 private:
  std::size_t cell(int u, int psi) const { return static_cast<std::size_t>(u) * row_length_ + psi; }
  std::size_t cells_per_term() const { return static_cast<std::size_t>(u_cells_) * row_length_; }

  WavenumberGrid wavenumbers_;
  double kc_;                // of centre_index
  int psi_cells_;            // 2 count, rounded up to a length FFTs like
  int row_length_ = 0;       // of one u: its period and a kernel's width
  double psi_cell_;          // m
  double u_cell_, u_first_;  // m
  int u_cells_;
  double v_limit_;                      // m; the grid of v^p holds amplitudes times (v / v_limit)^p
  int terms_;                           // of the series in q, 1..5
  std::vector<Complex> cells_;          // [term][u][psi], after transform [term][u][frequency]
  std::vector<double> psi_correction_;  // 1 / phi^ per frequency
};

}  // namespace seaglint
