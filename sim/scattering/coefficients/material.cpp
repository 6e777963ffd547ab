// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/material.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {

namespace {

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
    case SurfaceKind::kSubmerged:
    case SurfaceKind::kLens: break;
  }
}

InterfaceCoefficients MaterialSurface::at(double cos_incidence) const {
  InterfaceCoefficients fields;
  if (kind_ == SurfaceKind::kImpedance) {
    // Z_s against the wave impedances 1 / cos and cos; the sign of tm converts tangential E to the ray-fixed basis.
    const Complex z = impedance_;
    fields.te = (z * cos_incidence - 1.0) / (z * cos_incidence + 1.0);
    fields.tm = (cos_incidence - z) / (cos_incidence + z);
  } else if (ends_beams()) {
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

namespace {

// Basis vectors normal to and in the plane of incidence, for the incident and the reflected wave.
struct IncidenceBasis {
  Vec3 s, p, leaving, p_leaving;
};

IncidenceBasis incidence_basis(const Vec3& d, const Vec3& n) {
  IncidenceBasis basis;
  const Vec3 across = d.cross(n);
  // At normal incidence any s normal to d is valid, since te = -tm.
  const Vec3 any = std::abs(d.x()) < 0.7 ? Vec3(d.cross(Vec3::UnitX())) : Vec3(d.cross(Vec3::UnitY()));
  basis.s = (across.norm() > 1e-9 ? across : any).normalized();
  basis.p = basis.s.cross(d);
  basis.leaving = d - 2 * n.dot(d) * n;
  basis.p_leaving = basis.s.cross(basis.leaving);
  return basis;
}

}  // namespace

CVec3 reflected_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const CVec3& E) {
  const IncidenceBasis basis = incidence_basis(d, n);
  return surface.te * component_along(basis.s, E) * basis.s.cast<Complex>() +
         surface.tm * component_along(basis.p, E) * basis.p_leaving.cast<Complex>();
}

CVec3 radiated_field(const InterfaceCoefficients& surface, const Vec3& d, const Vec3& n, const Vec3& r_hat,
                     const CVec3& E) {
  const IncidenceBasis b = incidence_basis(d, n);
  // Each of the plane waves is a complex amplitude times a real vector, so that the cross products are real.
  const auto currents = [&](const Vec3& direction, const Vec3& field) -> Vec3 {
    return n.cross(direction.cross(field)) + r_hat.cross(n.cross(field));
  };
  const Complex s = component_along(b.s, E), p = component_along(b.p, E);
  const CVec3 sum = s * ((1.0 - surface.te_transmission) * currents(d, b.s).cast<Complex>() +
                         surface.te * currents(b.leaving, b.s).cast<Complex>()) +
                    p * ((1.0 - surface.tm_transmission) * currents(d, b.p).cast<Complex>() +
                         surface.tm * currents(b.leaving, b.p_leaving).cast<Complex>());
  return sum * (0.5 / std::abs(n.dot(d)));
}

double sea_water_conductivity(double T, double S) {
  const double sigma35 =
      2.903602 + 8.607e-2 * T + 4.738817e-4 * T * T - 2.991e-6 * T * T * T + 4.3047e-9 * T * T * T * T;  // eq. 12
  const double R15 = S * (37.5109 + 5.45216 * S + 1.4409e-2 * S * S) / (1004.75 + 182.283 * S + S * S);  // eq. 13
  const double alpha0 = (6.9431 + 3.2841 * S - 9.9486e-2 * S * S) / (84.850 + 69.024 * S + S * S);       // eq. 15
  const double alpha1 = 49.843 - 0.2276 * S + 0.198e-2 * S * S;                                          // eq. 16
  return sigma35 * R15 * (1 + alpha0 * (T - 15) / (alpha1 + T));                                         // eqs. 11, 14
}

Complex sea_water_permittivity(double frequency_hz, double T, double S) {
  const double nu = 1e-9 * frequency_hz;  // GHz
  // Pure water: eqs. 7 and 8 with table III.
  double eps_s = (3.70886e4 - 8.2168e1 * T) / (4.21854e2 + T);
  double eps_1 = 5.7230 + 2.2379e-2 * T - 7.1237e-4 * T * T;
  double nu_1 = (45 + T) / (5.0478 - 7.0315e-2 * T + 6.0059e-4 * T * T);
  double eps_inf = 3.6143 + 2.8841e-2 * T;
  double nu_2 = (45 + T) / (1.3652e-1 + 1.4825e-3 * T + 2.4166e-4 * T * T);
  // Salt: eq. 17 with table VI.
  eps_s *= std::exp(-3.56417e-3 * S + 4.74868e-6 * S * S + 1.15574e-5 * T * S);
  nu_1 *= 1 + S * (2.39357e-3 - 3.13530e-5 * T + 2.52477e-7 * T * T);
  eps_1 *= std::exp(-6.28908e-3 * S + 1.76032e-4 * S * S - 9.22144e-5 * T * S);
  nu_2 *= 1 + S * (-1.99723e-2 + 1.81176e-4 * T);
  eps_inf *= 1 + S * (-2.04265e-3 + 1.57883e-4 * T);
  // Eq. 6 with 1 / (2 pi eps0) = 17.97510 GHz m/S.
  return (eps_s - eps_1) / Complex(1, nu / nu_1) + (eps_1 - eps_inf) / Complex(1, nu / nu_2) + eps_inf -
         Complex(0, sea_water_conductivity(T, S) * 17.97510 / nu);
}

double ament_factor(double k, double rms_height, double sin_grazing) {
  const double g = k * rms_height * sin_grazing;
  return std::exp(-2 * g * g);
}

namespace {

// I0(z) = sum_m (z/2)^2m / (m!)^2 (Abramowitz and Stegun, 9.6.12), 0 <= z < 500. std::cyl_bessel_i writes a global by
// lgamma, from several threads.
double bessel_i0(double z) {
  const double q = 0.25 * z * z;
  double term = 1, sum = 1;
  for (int m = 1; term > 1e-17 * sum; ++m) {
    term *= q / (static_cast<double>(m) * m);
    sum += term;
  }
  return sum;
}

}  // namespace

double miller_brown_vegh_factor(double k, double rms_height, double sin_grazing) {
  const double g = k * rms_height * sin_grazing, z = 2 * g * g;
  if (z < 500) return std::exp(-z) * bessel_i0(z);
  // e^{-z} I0(z) = (1 + 1/(8z) + ...) / sqrt(2 pi z) (Abramowitz and Stegun, 9.7.1).
  return (1 + 1 / (8 * z) + 9 / (128 * z * z)) / std::sqrt(2 * kPi * z);
}

}  // namespace seaglint
