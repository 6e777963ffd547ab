// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Transition functions of the uniform theory of diffraction, and the amplitude laws along an interval of an edge that
// contain them: grazing waves, double knife edges, walls in a penumbra.

#include <array>
#include <limits>

#include "sim/core/numbers/linear.h"

namespace seaglint {

// Transition function of the uniform theory of diffraction, and its divided differences for two and three boundaries.

// F(x) = 2j sqrt(x) e^{jx} integral from sqrt(x) to infinity of e^{-j t^2} dt (R. G. Kouyoumjian and P. H. Pathak,
// Proc. IEEE 62 (1974) 1448-1461, eq. 26): 0 on a shadow boundary, 1 far from it; F(-x) is its conjugate. x real; error
// below 1e-7.
Complex transition_function(double x);

// Transition function of a wave diffracted from one edge to another along a face, x and y > 0 the arguments of the two
// edges: (y F(x) - x F(y)) / (y - x). Tends to F(x) for large y and differs from F(x) F(y) where both are small: it is
// the value of the integral over both apertures on a hard plane (far-field limit of the generalised Fresnel integrals
// of F. Capolino, M. Albani, S. Maci and R. Tiberio, IEEE Trans. AP-45 (1997) 1240-1248).
Complex double_transition_function(double x, double y);

// The same with the end point of the second edge as third boundary, x, y > 0, z of either sign. All three are divided
// differences of F(x) / x. By parts, the integral of F(al) e^{jpl} / sqrt(l) over a length l is the difference of T(al,
// -pl) e^{jpl} / (jp sqrt(l)) at its ends, T the double transition function; that of T(al, bl) e^{jpl} / sqrt(l) is
// likewise that of the triple one of (al, bl, -pl).
Complex triple_transition_function(double x, double y, double z);

// Amplitude of multiple diffraction along an interval of the last edge: 1 / sqrt(k l) of a face-grazing diffracted wave
// of length l, times transition functions near the shadow boundaries of the edge that launches it and of the one that
// diffracts it last. Near its edge a wave is thus limited to the field there, sqrt(2 pi d) times its coefficient, d its
// transition_parameter(), at most that of the incident wave.

// Successive grazing waves: on a face with two edges the third edge is the first one again, and the fourth the second;
// near grazing all orders are equally large.
inline constexpr int kMaxGrazingWaves = 3;

struct GrazingWaveAmplitude {
  std::array<double, 2> l{};  // length of the last grazing wave at the ends of the interval, m; linear in between
  // transition_parameter() where the last wave starts, and at the last edge
  double launch_parameter = 0, exit_parameter = 0;
  // of the waves before, mean length times twice that parameter, m: argument of their transition functions over k
  std::array<double, kMaxGrazingWaves - 1> detour_m{};
  int grazing_waves = 1;  // successive waves along the face

  // Amplitude at a fraction 0..1 of the interval, in m^(-1/2) k^(-grazing_waves / 2): times length / (j run) it is the
  // end-point term of the integral of e^{jk psi} along the interval, run (rad, not zero) being the change of k psi.
  Complex at(double k, double fraction, double run) const;
};

// Amplitude of double knife-edge diffraction along an interval of an edge: the effective width of a beam between two
// edges near each other along the transmit or the receive path, times k. Derivation: radiation/beam_boundary.h.

struct DoubleKnifeEdge {
  // of the path over both edges, at the ends of the interval, m: the distance between the edges along the beam, and the
  // excess of the path over both edges above that over the second edge alone
  std::array<double, 2> separation{}, excess_path{};
  double psi_slope = 0;  // of psi across the edges, towards the shadow
  // excess of the path over both edges above the exit path over the first edge alone, m; negative where the second edge
  // obstructs that path
  std::array<double, 2> exit_excess{};
  bool second_in_shadow = false;                 // of the first edge
  double off_axis_weight = 0, axial_weight = 1;  // weights of the forms for slope != 0 and for slope = 0

  // k times the effective width, dimensionless, at a fraction 0..1 of the interval. `run`: phase change over the
  // interval, rad, which displaces an end point; infinite: none.
  Complex at(double k, double fraction, double run = std::numeric_limits<double>::infinity()) const;

  // True where the phase changes by ten cycles or more over an interval: end-point terms then have an error of the
  // change of the width within one cycle.
  static bool endpoints_suffice(double phase);

  // Mean of at(k, x) e^{j phase (y - 1/2)} over a part of the interval, x its fractions `from` to `to` and y those of
  // the part. Gauss-Legendre quadrature with four points per three radians, since the width varies as the square root
  // of the distance between edges that meet.
  Complex mean(double k, double phase, double from, double to) const;

  // Upper bound of |at| for all k >= lowest.
  double upper_bound(double lowest) const;

 private:
  Complex off_axis_width(double k, double fraction) const;
  // Taper of the forward form: 1 in the forward direction, 0 where k d slope^2 / 2 >= 1 rad, from where on the
  // end-point contributions are moved instead.
  double axial_taper(double k, double distance_m) const;
};

// Correction to physical optics, per metre, for a wall in the penumbra of the edge of a face at near-grazing incidence
// (multiple_diffraction.h), along an interval of the wall's foot.

// Sum of three contributions with s the sine of the wave's angle over the face, l the distance on the face from edge to
// wall and x = k l s^2: at the foot of the wall, -1 / (2jks); at the edge's shadow-boundary line on the wall (s < 0) or
// on its image, e^{-2jx} / (2jks); and of the path edge - wall - edge, (l / pi k)^(1/2) e^{-j pi/4} e^{-jx} [F(x) /
// (2jx) -+ (1 - F(x))] (soft, hard); each times -jk / 2 pi.
struct WallPenumbraTerm {
  std::array<double, 2> l{};  // distance from edge to wall at both ends of the interval, m; linear in between
  double sine = 0;            // s, -1 < s < 1
  // weights of the three contributions
  double foot_weight = 0, shadow_line_weight = 1, edge_path_weight = 1;
  bool soft = false;         // true: electric field parallel to the face; false: magnetic field parallel to it
  double psi_decrement = 0;  // decrease of psi relative to that of the foot, per metre of l
  // Part of a first-order expansion in s. Near grazing the contributions diverge as 1 / s and cancel, so their sum is
  // one amplitude with its derivative. The derivative is represented by a second contribution whose path gradient has
  // an additional component g (derivative_scale_m) along the face normal: its phase gives (e^{jk g ds} - 1) / (jk g)
  // for a change ds of s. kComplete: no expansion; kValue: the sum less the derivative's amplitude; kDerivative: the
  // derivative's amplitude.
  enum class Part { kComplete, kValue, kDerivative } part = Part::kComplete;
  double derivative_scale_m = 0;  // g, m

  // Amplitude at the fraction `fraction` of the interval: times length / (j run) it is the end-point contribution there
  // to the integral of e^{jk psi} over the interval, run (rad, not zero) being the change of k psi over it. k:
  // wavenumber, rad/m.
  Complex at(double k, double fraction, double run) const;

  // Largest difference between the psi of one of the contributions and that of the phase, m: at() oscillates with k
  // over it.
  double psi_spread() const;

 private:
  Complex at_sine(double s, double k, double fraction, double run) const;
};

}  // namespace seaglint
