// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reflection and transmission of a plane wave at a flat surface of a material, at one frequency.
//
// Time factor e^{+jwt}, eps = eps' - j eps''. The wave propagates along d and is incident on a surface with normal n
// (towards the wave). s: unit vector normal to the plane of incidence; p = s x d; d' = d - 2 (n.d) n the direction of
// the reflected wave, p' = s x d'. In this ray-fixed basis
//
//     E' = te (s.E) s + tm (p.E) p'
//
// so that a perfect conductor, E' = 2 (n.E) n - E, has te = -1, tm = +1, and tm = -te at normal incidence.

#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

// Value of a dispersive quantity at a frequency in Hz: constant, Debye terms or table.
Complex value_at(const DispersionSpec& spec, double frequency_hz);

struct InterfaceCoefficients {
  Complex te = -1, tm = 1;  // reflection
  // Field behind an air-backed sheet relative to the incident field there, phase referred to the front face; 0 for all
  // other surfaces.
  Complex te_transmission = 0, tm_transmission = 0;
};

// Material at one frequency.
class MaterialSurface {
 public:
  // k: free-space wavenumber, rad/m. The frequency range of the material's source is not checked here.
  MaterialSurface(const MaterialSpec& spec, double k);

  bool is_submerged() const { return kind_ == SurfaceKind::kSubmerged; }

  // Of all layers, m; 0 without layers.
  double thickness() const;

  // Coefficients of the smooth surface at cos_incidence = |n.d|, 0 < x <= 1. Layers: recursion of generalised
  // reflection coefficients (W. C. Chew, Waves and Fields in Inhomogeneous Media, eq. 2.1.24, with j for -i).
  InterfaceCoefficients at(double cos_incidence) const;

  // Factor of the coherent field scattered from cos_in = |n.d| to cos_out = n.r^ by roughness, e^{-(k sigma (cos_in +
  // cos_out))^2 / 2}: the mean of e^{jk zeta (cos_in + cos_out)} over Gaussian heights zeta of RMS sigma; in the
  // specular direction Ament's factor.
  double roughness_factor(double cos_in, double cos_out) const;

 private:
  struct Slab {
    Complex eps, mu;
    double thickness = 0;  // m
  };
  InterfaceCoefficients stack(double cos_incidence) const;

  SurfaceKind kind_;
  double k_;
  double roughness_;       // RMS height, m
  Complex impedance_ = 0;  // relative to free space
  bool air_behind_ = false;
  std::vector<Slab> slabs_;  // layers, then the half-space behind them if it is a medium
  bool half_space_ = false;  // the last slab is a half-space
};

}  // namespace seaglint
