// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/material.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/coefficients/sea_water.h"

namespace seaglint {
namespace {

constexpr Complex kJ(0, 1);
constexpr double kVacuumPermittivity = 8.8541878128e-12;  // F/m, CODATA 2018

// Normal wavenumber over k0: the root that decays along e^{-j kappa z}, Im kappa <= 0; the propagating one where
// neither decays.
Complex decaying_root(const Complex& square) {
  const Complex root = std::sqrt(square);
  return root.imag() > 0 ? -root : root;
}

// Reflection of tangential E at an interface from medium a to b, kappa = k_z / k0: (Z_b - Z_a) / (Z_b + Z_a), with Z =
// mu / kappa for te and kappa / eps for tm; written without division by kappa, which may vanish.
Complex interface_te(const Complex& mu_a, const Complex& kappa_a, const Complex& mu_b, const Complex& kappa_b) {
  return (mu_b * kappa_a - mu_a * kappa_b) / (mu_b * kappa_a + mu_a * kappa_b);
}
Complex interface_tm(const Complex& eps_a, const Complex& kappa_a, const Complex& eps_b, const Complex& kappa_b) {
  return (kappa_b * eps_a - kappa_a * eps_b) / (kappa_b * eps_a + kappa_a * eps_b);
}

}  // namespace

Complex value_at(const DispersionSpec& spec, double frequency_hz) {
  const double ghz = 1e-9 * frequency_hz;
  if (!spec.table.empty()) {
    const auto above = std::find_if(spec.table.begin(), spec.table.end(),
                                    [&](const MeasuredSpec& row) { return row.frequency_ghz > ghz; });
    const MeasuredSpec& b = above == spec.table.end() ? spec.table.back() : *above;
    const MeasuredSpec& a = above == spec.table.begin() ? spec.table.front() : *(above - 1);
    const double s = &a == &b ? 0 : std::log(ghz / a.frequency_ghz) / std::log(b.frequency_ghz / a.frequency_ghz);
    return {a.real + s * (b.real - a.real), -(a.loss + s * (b.loss - a.loss))};
  }
  Complex value(spec.real, -spec.loss);
  for (const DebyeSpec& term : spec.debye) value += term.strength / Complex(1, ghz / term.relaxation_ghz);
  return value - kJ * spec.conductivity_s_m / (2 * kPi * frequency_hz * kVacuumPermittivity);
}

MaterialSurface::MaterialSurface(const MaterialSpec& spec, double k)
    : kind_(spec.kind), k_(k), roughness_(1e-3 * spec.roughness_mm) {
  const double frequency_hz = k * kSpeedOfLight / (2 * kPi);
  switch (spec.kind) {
    case SurfaceKind::kPec: break;
    case SurfaceKind::kConductor:
      slabs_.push_back({1.0 - kJ * spec.conductivity_s_m / (2 * kPi * frequency_hz * kVacuumPermittivity), 1.0, 0});
      half_space_ = true;
      break;
    case SurfaceKind::kImpedance: impedance_ = {spec.resistance, spec.reactance}; break;
    case SurfaceKind::kLayers:
      for (const LayerSpec& layer : spec.layers) {
        slabs_.push_back({value_at(layer.permittivity, frequency_hz), value_at(layer.permeability, frequency_hz),
                          1e-3 * layer.thickness_mm});
      }
      air_behind_ = spec.backing == Backing::kAir;
      break;
    case SurfaceKind::kSeaWater:
      slabs_.push_back({sea_water_permittivity(frequency_hz, spec.temperature_c, spec.salinity_psu), 1.0, 0});
      half_space_ = true;
      break;
    case SurfaceKind::kSubmerged: break;
  }
}

InterfaceCoefficients MaterialSurface::at(double cos_incidence) const {
  InterfaceCoefficients fields;
  if (kind_ == SurfaceKind::kImpedance) {
    // Z_s against the wave impedances 1 / cos and cos; the sign of tm converts tangential E to the ray-fixed basis.
    const Complex z = impedance_;
    fields.te = (z * cos_incidence - 1.0) / (z * cos_incidence + 1.0);
    fields.tm = (cos_incidence - z) / (cos_incidence + z);
  } else if (kind_ == SurfaceKind::kSubmerged) {
    fields.te = fields.tm = 0;
  } else if (kind_ != SurfaceKind::kPec) {
    fields = stack(cos_incidence);
  }
  return fields;
}

double MaterialSurface::thickness() const {
  double sum = 0;
  for (const Slab& slab : slabs_) sum += slab.thickness;
  return sum;
}

double MaterialSurface::roughness_factor(double cos_in, double cos_out) const {
  return roughness_ > 0 ? ament_factor(k_, roughness_, 0.5 * (cos_in + cos_out)) : 1.0;
}

InterfaceCoefficients MaterialSurface::stack(double cos_incidence) const {
  const double sin_squared = 1 - cos_incidence * cos_incidence;
  // Media from the free space in front (index 0) to the medium behind the last interface.
  struct Medium {
    Complex eps, mu, kappa;
  };
  std::vector<Medium> media{{1.0, 1.0, cos_incidence}};
  for (const Slab& slab : slabs_) {
    media.push_back({slab.eps, slab.mu, decaying_root(slab.eps * slab.mu - sin_squared)});
  }
  if (air_behind_) media.push_back(media.front());

  // Gamma at the front of the last interface, then interface by interface towards the wave:
  //     Gamma_i = (rho_i + Gamma_{i+1} e^{-2j delta}) / (1 + rho_i Gamma_{i+1} e^{-2j delta}),
  // delta = k0 kappa d of the medium between them.
  Complex te = -1, tm = -1;  // perfect conductor, tangential E
  Complex te_transmission = 1, tm_transmission = 1;
  const bool has_conductor = !half_space_ && !air_behind_;
  double depth = 0;
  for (std::size_t i = media.size() - 1; i-- > 0;) {
    const Medium &a = media[i], &b = media[i + 1];
    const Complex rho_te = interface_te(a.mu, a.kappa, b.mu, b.kappa),
                  rho_tm = interface_tm(a.eps, a.kappa, b.eps, b.kappa);
    const bool ends = i + 2 == media.size() && !has_conductor;  // b is a half-space without reflection
    const double thickness = ends ? 0 : slabs_[i].thickness;
    const Complex once = std::exp(-kJ * k_ * b.kappa * thickness);
    const Complex back_te = ends ? 0 : te * once * once, back_tm = ends ? 0 : tm * once * once;
    te = (rho_te + back_te) / (1.0 + rho_te * back_te);
    tm = (rho_tm + back_tm) / (1.0 + rho_tm * back_tm);
    te_transmission *= (1.0 + rho_te) * once / (1.0 + rho_te * back_te);
    tm_transmission *= (1.0 + rho_tm) * once / (1.0 + rho_tm * back_tm);
    depth += thickness;
  }
  InterfaceCoefficients fields;
  fields.te = te;
  fields.tm = -tm;
  if (air_behind_) {
    const Complex without = std::exp(kJ * k_ * cos_incidence * depth);
    fields.te_transmission = te_transmission * without;
    fields.tm_transmission = tm_transmission * without;
  }
  return fields;
}

}  // namespace seaglint
