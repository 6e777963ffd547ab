// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Edge contribution: pattern per metre of edge times the phase integral along an interval of the edge, at any
// frequency. Single diffraction, multiple diffraction, double knife-edge terms and wall penumbrae differ in the
// amplitude law along the interval.

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "sim/scattering/coefficients/double_knife_edge.h"
#include "sim/scattering/coefficients/grazing_wave_amplitude.h"
#include "sim/scattering/coefficients/wall_penumbra_term.h"
#include "sim/scattering/radiation/footprint.h"
#include "sim/scattering/tracing/contribution_filter.h"

namespace seaglint {

// Patterns hh, hv, vh, vv (received, transmitted) per metre of edge, dimensionless: thin + k t (thickness_linear +
// thickness_log ln(k t)), t the thickness of the sheets. Edges of materials depend on k by a table.
struct EdgePattern {
  std::array<Complex, 4> thin{}, thickness_linear{}, thickness_log{};
  double thickness_m = 0;  // t; 0: the thickness terms are unused

  struct AtWavenumber {
    double k;  // rad/m
    std::array<Complex, 4> value;
  };
  // Where not empty, in place of all other terms: ascending k, linear between, constant beyond.
  std::vector<AtWavenumber> by_wavenumber{};

  std::array<Complex, 4> at(double k) const;
  EdgePattern& operator+=(const EdgePattern& other);  // of the same edges, with as many wavenumbers
  EdgePattern& operator*=(double factor);
};
EdgePattern transposed(EdgePattern pattern);

// Mean of the pattern of a path and that of its reciprocal, `back`, whose matrix is the transposed one.
EdgePattern reciprocal_mean(EdgePattern pattern, const EdgePattern& back);

// Amplitude 1 along the interval, that of single diffraction.
struct UniformAmplitude {
  Complex at(double, double, double) const { return 1.0; }
};

// Amplitude law along an interval: at(k, fraction, run) is the dimensionless factor of the end-point term at a fraction
// 0..1 of the interval, run (rad, not zero) being the change of k psi over it.
using AmplitudeLaw = std::variant<UniformAmplitude, GrazingWaveAmplitude, DoubleKnifeEdge, WallPenumbraTerm>;

// Contribution of an interval of an edge: S = pattern times the integral of amplitude e^{jk psi} along it, psi linear.
struct EdgeContribution {
  std::array<double, 2> psi{};           // at the ends, m
  std::array<PathGradient, 2> gradient;  // at the ends, m
  double length = 0;                     // of the interval, m
  EdgePattern pattern;                   // after n grazing waves in m^(-(n - 1) / 2)
  AmplitudeLaw amplitude;                // along the interval
  // 2 d / depth^2 with d the distance between the edges and depth that of the shallower panel, rad/m. fresnel_taper()
  // reduces boundary and penumbra terms towards wavenumbers as low, at which the panel is no deeper than the transition
  // region and its opposite side contributes equally.
  double fresnel_wavenumber = 0;
  double fresnel_taper(double k) const;
  std::int32_t facet = -1;                 // first facet of the edge
  std::uint16_t part = 0, other_part = 0;  // of that facet, and of the second one
  std::uint8_t bounces = 1;                // reflections on both paths plus the number of diffractions
  Mechanism mechanism = Mechanism::kSingleDiffraction;
};

// End-point terms of the phase integral along the interval (m), amplitude law included: the integral is
// endpoint_term(1) e^{jk psi_1} - endpoint_term(0) e^{jk psi_0}. fraction 0..1 along the interval: at a common end the
// terms of two parts cancel.
Complex endpoint_term(const EdgeContribution& contribution, double k, double fraction);

// False for double knife-edge terms whose phase changes by less than ten cycles over the interval: end-point terms then
// have an error of the change of the width within one cycle.
bool endpoints_suffice(const EdgeContribution& contribution, double k);

// The phase integral over a part of the interval (fractions `from` to `to`) relative to the phase at its middle; valid
// also for constant psi.
Complex interval_integral(const EdgeContribution& contribution, double k, double from, double to);

// hh, hv, vh, vv of the contribution at wavenumber k, m.
std::array<Complex, 4> scattered(const EdgeContribution& contribution, double k);

}  // namespace seaglint
