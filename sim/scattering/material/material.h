// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a flat surface of some material does to a plane wave of one frequency.
//
// Time factor e^{+jwt}, eps = eps' - j eps''. The wave travels along d and meets the surface at normal n (towards the
// wave); s is a unit vector across the plane of incidence, p = s x d, and d' = d - 2 (n.d) n leaves along p' = s x d'.
// In this ray-fixed basis
//     E' = te (s.E) s + tm (p.E) p'
// so that a perfect conductor, E' = 2 (n.E) n - E, has te = -1, tm = +1, and tm = -te at normal incidence.

#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scenario/material_spec.h"

namespace seaglint {

// At one frequency, in Hz.
Complex value_at(const DispersionSpec& spec, double frequency_hz);

struct InterfaceCoefficients {
  Complex te = -1, tm = 1;  // reflected field
  // Field behind an air-backed sheet relative to the one that would be there without it (referred to the front face); 0
  // for all others.
  Complex te_transmission = 0, tm_transmission = 0;
};

// A material at one frequency.
class MaterialSurface {
 public:
  // k: wavenumber in free space, rad/m. The material's stated frequency range is not enforced here.
  MaterialSurface(const MaterialSpec& spec, double k);

  bool is_submerged() const { return kind_ == SurfaceKind::kSubmerged; }

  // cos_incidence = |n.d|, 0 < x <= 1, for the smooth surface. Layers by the recursion of generalised reflection
  // coefficients (W. C. Chew, Waves and Fields in Inhomogeneous Media, eq. 2.1.24, with j for -i).
  InterfaceCoefficients at(double cos_incidence) const;

  // What roughness leaves of the coherent field scattered from cos_in = |n.d| to cos_out = n.r^: e^{-(k sigma (cos_in +
  // cos_out))^2 / 2}, the mean of e^{jk zeta (cos_in + cos_out)} over Gaussian heights zeta; Ament's factor for a
  // mirror.
  double roughness_factor(double cos_in, double cos_out) const;

 private:
  struct Slab {
    Complex eps, mu;
    double thickness = 0;  // m
  };
  InterfaceCoefficients stack(double cos_incidence) const;

  SurfaceKind kind_;
  double k_;
  double roughness_;       // m
  Complex impedance_ = 0;  // relative to free space
  bool air_behind_ = false;
  std::vector<Slab> slabs_;  // layers, then the half-space behind when it is a medium
  bool half_space_ = false;  // the last slab has no end
};

}  // namespace seaglint
