// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Edge contribution: pattern per metre of edge times the phase integral along an interval of the edge, at any
// frequency. Single diffraction, multiple diffraction, double knife-edge terms and wall penumbrae differ in the
// amplitude law along the interval.

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "sim/scattering/diffraction/wall_penumbra_term.h"
#include "sim/scattering/surfaces/footprint.h"

namespace seaglint {

// Patterns hh, hv, vh, vv (received, transmitted) per metre of edge, dimensionless: thin + k t (thickness_linear +
// thickness_log ln(k t)), t the thickness of the sheets.
struct EdgePattern {
  std::array<Complex, 4> thin{}, thickness_linear{}, thickness_log{};
  double thickness_m = 0;  // t; 0: the thickness terms are unused

  std::array<Complex, 4> at(double k) const;
  EdgePattern& operator+=(const EdgePattern& other);  // of the same edges
  EdgePattern& operator*=(double factor);
};
EdgePattern transposed(EdgePattern pattern);

// Contribution of an interval of an edge: S = pattern times the integral of e^{jk psi} along it, psi linear.
struct EdgeContribution {
  std::array<double, 2> psi{};           // at the ends, m
  std::array<PathGradient, 2> gradient;  // at the ends, m
  double length = 0;                     // of the interval, m
  EdgePattern pattern;                   // after n grazing waves in m^(-(n - 1) / 2)
  // Amplitude law of a face-grazing diffracted wave of length l: 1/sqrt(k l) times transition functions near the shadow
  // boundaries of the edge that launches it and of the one that diffracts it last.
  struct MultipleDiffraction {
    // length of the last grazing wave at the ends of the interval, m; linear in between
    std::array<double, 2> l{};
    double launch_parameter = 0, exit_parameter = 0;  // transition_parameter() at the first and at the last edge
    double first_length_m = 0;  // mean length of the first grazing wave, used when there are several
    int grazing_waves = 1;      // successive waves along the face
  };
  std::optional<MultipleDiffraction> multiple_diffraction;
  // Amplitude law of double knife-edge diffraction (beam_boundary.h): effective width of the beam times k.
  struct DoubleKnifeEdge {
    // of the path over both edges, at the ends of the interval, m: the distance between the edges along the beam, and
    // the excess of the path over both edges above that over the second edge alone
    std::array<double, 2> separation{}, excess_path{};
    double psi_slope = 0;  // of psi across the edges, towards the shadow
    // excess of the path over both edges above the exit path over the first edge alone, m; negative where the second
    // edge obstructs that path
    std::array<double, 2> exit_excess{};
    bool second_in_shadow = false;                 // of the first edge
    double off_axis_weight = 0, axial_weight = 1;  // weights of the forms for slope != 0 and for slope = 0

    // k times the effective width, dimensionless, at a fraction of the interval. `run`: phase change over the interval,
    // rad, which displaces an end point; infinite: none.
    Complex effective_width(double k, double share, double run = std::numeric_limits<double>::infinity()) const;
    // Upper bound of its magnitude for all k >= lowest.
    double upper_bound(double lowest) const;

   private:
    Complex off_axis_width(double k, double share) const;
    // Taper of the forward form: 1 in the forward direction, 0 where k d slope^2 / 2 >= 1 rad, from where on the
    // end-point contributions are moved instead.
    double axial_taper(double k, double distance_m) const;
  };
  std::optional<DoubleKnifeEdge> double_knife_edge;
  std::optional<WallPenumbraTerm> penumbra;
  // 2 d / depth^2 with d the distance between the edges and depth that of the shallower panel, rad/m. fresnel_taper()
  // reduces boundary and penumbra terms towards wavenumbers as low, at which the panel is no deeper than the transition
  // region and its opposite side contributes equally.
  double fresnel_wavenumber = 0;
  double fresnel_taper(double k) const;
  std::int32_t facet = -1;                 // first facet of the edge
  std::uint16_t part = 0, other_part = 0;  // of that facet, and of the second one
  std::uint8_t bounces = 1;                // reflections on both paths plus the number of diffractions
};

// End-point terms of the phase integral along the interval (m), amplitude law included: the integral is
// endpoint_term(1) e^{jk psi_1} - endpoint_term(0) e^{jk psi_0}. fraction 0..1 along the interval: at a common end the
// terms of two parts cancel.
Complex endpoint_term(const EdgeContribution& contribution, double k, double share);

// False for double knife-edge terms whose phase changes by less than ten cycles over the interval: end-point terms then
// have an error of the change of the width within one cycle.
bool endpoints_suffice(const EdgeContribution& contribution, double k);

// The phase integral over a part of the interval (fractions `from` to `to`) relative to the phase at its middle; valid
// also for constant psi.
Complex interval_integral(const EdgeContribution& contribution, double k, double from, double to);

// hh, hv, vh, vv of the contribution at wavenumber k, m.
std::array<Complex, 4> scattered(const EdgeContribution& contribution, double k);

}  // namespace seaglint
