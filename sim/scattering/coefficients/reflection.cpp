// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/reflection.h"

namespace seaglint {
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

}  // namespace seaglint
