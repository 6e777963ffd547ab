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

  bool ends_beams() const { return seaglint::ends_beams(kind_); }

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

// Reflected field of a beam at a material surface, and the field radiated by its surface currents.

// Field of one beam at one wavenumber, per h and v transmit polarisation.
struct BeamField {
  CVec3 h = CVec3::Zero();
  CVec3 v = CVec3::Zero();
};

// Component of a complex vector E along a real vector a.
inline Complex component_along(const Vec3& a, const CVec3& E) { return a.x() * E.x() + a.y() * E.y() + a.z() * E.z(); }

// Field of the reflected plane wave for incidence of E along d on a surface with normal n towards the wave: te (s.E) s
// + tm (p.E) p' (material.h).
CVec3 reflected_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const CVec3& E);

// Pattern vector of the surface currents of the total field towards r^, per unit of projected area:
//
//     (1/2) [n x eta H + r^ x (n x E)] / |n.d|,   E = E_i + E_r - E_t,  eta H = d x E_i + d' x E_r - d x E_t,
//
// from E_s = -(jk/4 pi) (e^{-jkr}/r) integral [eta (J - r^ r^.J) - r^ x M] e^{jk r^.x} dS with J = n x H, M = -n x E
// (Balanis, Advanced Engineering Electromagnetics, eqs. 6-122). E_t: field behind an air-backed sheet, 0 for all other
// surfaces. A perfect conductor gives n x (d x E_i) / |n.d|.
CVec3 radiated_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const Vec3& r_hat,
                     const CVec3& E);

// Permittivity of sea water at radar frequencies, and the coherent specular reflection of a rough sea.

// Relative permittivity eps' - j eps'' including conductivity, double Debye model of T. Meissner and F. J. Wentz, IEEE
// Trans. Geosci. Remote Sens. 42 (2004) 1836-1849. Valid for -2 <= temperature_c <= 29, 0 <= salinity_psu <= 40,
// frequencies up to 90 GHz.
Complex sea_water_permittivity(double frequency_hz, double temperature_c, double salinity_psu);

// Conductivity, S/m (Stogryn et al. 1995 as given in Meissner and Wentz 2004, eqs. 11-16).
double sea_water_conductivity(double temperature_c, double salinity_psu);

// Coherent reflection of a surface with Gaussian heights relative to the smooth one: e^{-2 (k sigma sin psi)^2}, psi
// the grazing angle, sigma the RMS height in m, k in rad/m (W. S. Ament, Proc. IRE 41 (1953) 142-146).
double ament_factor(double k, double rms_height, double sin_grazing);

// The same for a height that is a sine of random phase and Gaussian amplitude, close to the sea's: e^{-z} I0(z), z = 2
// (k sigma sin psi)^2 (A. R. Miller, R. M. Brown and E. Vegh, IEE Proc. H 131 (1984) 114-116).
double miller_brown_vegh_factor(double k, double rms_height, double sin_grazing);

}  // namespace seaglint
