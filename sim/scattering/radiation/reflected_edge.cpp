// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/reflected_edge.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/numbers/smooth_step.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/path_weights.h"
#include "sim/scattering/geometry/image_transform.h"

namespace seaglint {
namespace {

// Within this angle of the specular direction, rad, the end-point contributions are evaluated at this offset to either
// side, where their poles cancel: an error of the offset squared times their second derivative, 1e-6 at 10 deg.
constexpr double kAtSpecular = 1e-3, kAside = 1e-4;

// n x (k^ x E): half of the PO current times eta, for a wave incident from vacuum.
Vec3 half_po_current(const Vec3& n, const Vec3& k_hat, const Vec3& E) { return n.cross(k_hat.cross(E)); }

// Weight 0..1 of the end-point contribution of the last reflector, for the slopes of psi per metre of the edge's face,
// `of_face`, and of its image on that reflector, `of_last`; `across`: a metre of either, seen along the beam across the
// edge. Both slopes are zero in the direction of the beam, where the poles cancel: only the difference of the two
// contributions must stay finite, 1 / of_last - 1 / of_face = (1 - of_last / of_face) / of_last. Where the edge is not
// parallel to the reflector, `of_last` has a second zero on Keller's cone, a pole of this difference. psi varies there
// along the shadow-boundary line, which radiates from its ends only, and beam_boundary.h leaves the contribution there,
// by the slope across the line.
double last_end_weight(double of_last, double of_face, double across) {
  const double not_common = std::max(1 - of_last / of_face, 0.0);
  return 1 - smooth_taper(std::abs(of_last) / (not_common * across), kSlopeWindow);
}

}  // namespace

std::array<double, 2> reflected_face_weights(const WedgeFrame& wedge, const EdgeIllumination& in,
                                             const EdgeIllumination& out) {
  std::array<double, 2> weights{};
  const Vec3 &k_hat = in.direction, s = -out.direction;
  for (int i = 0; i < 2; ++i) {
    const auto& [x, n, t] = wedge.face[i];
    if (n.dot(k_hat) >= 0 || n.dot(s) <= 0) continue;
    weights[i] = 1;
    if (out.reflections > 0) weights[i] = reflected_edge_weight(n, t, k_hat, s, out.first_reflector_normal);
    if (in.reflections > 0)
      weights[i] = std::min(weights[i], reflected_edge_weight(n, t, -s, -k_hat, in.first_reflector_normal));
    if (in.reflections + out.reflections > kMaxCorrectedReflections) {
      weights[i] *= smooth_taper((s - reflect_direction(k_hat, n)).norm(), kOffSpecularWindow);
    }
  }
  return weights;
}

std::array<double, 4> endpoint_correction(const WedgeFace& face, const EdgeIllumination& in,
                                          const EdgeIllumination& out) {
  std::array<double, 4> ends{};
  if (out.reflections == 0) return ends;
  const Vec3 &k_hat = in.direction, s = -out.direction;
  const Vec3 beam = reflect_direction(k_hat, face.n), n = out.first_reflector_normal.dot(beam) < 0
                                                              ? out.first_reflector_normal
                                                              : Vec3(-out.first_reflector_normal);
  // Directions on the last reflector, of the same lengths as at the edge: along the edge's shadow boundary, and into
  // the lit region.
  const double cosine = n.dot(beam), lands = beam_incidence_taper(beam, s, n);
  const Vec3 shadow = face.t - face.t.dot(n) / cosine * beam, into = face.x - face.x.dot(n) / cosine * beam;
  const double area = shadow.cross(into).norm(), across = std::abs(face.n.dot(beam)) / face.t.cross(beam).norm();
  const auto about_edge = [&](const Vec3& x) { return std::atan2(face.n.dot(x), face.x.dot(x)); };
  const double off = std::remainder(about_edge(s) - about_edge(beam), 2 * kPi);
  const auto add = [&](double angle, double weight) {
    const Vec3 on_cone = axis_rotation(angle, face.t) * beam, away = on_cone - beam;
    const Quaternion turned = rotation_between(s, on_cone);
    const std::array<Vec3, 2> received{turned * out.E_h, turned * out.E_v};
    const double ends_there = lands * last_end_weight(away.dot(into), away.dot(face.x), across);
    // Where the last reflector has no end-point contribution, that of the edge's face is used alone, away from its
    // pole.
    const double alone = 1 - (1 - ends_there) * smooth_taper(std::abs(off), kOffSpecularWindow);
    for (int t = 0; t < 2; ++t) {
      const Vec3& E = t == 0 ? in.E_h : in.E_v;
      // The integral of e^{jk away.x u} du from 0 on, times -jk / 2 pi.
      Vec3 of_face = alone / (2 * kPi * away.dot(face.x)) * half_po_current(face.n, k_hat, E), of_last = Vec3::Zero();
      if (ends_there > 0)
        of_last =
            ends_there * area / (2 * kPi * away.dot(into)) * half_po_current(n, beam, -reflect_direction(E, face.n));
      for (int r = 0; r < 2; ++r)
        ends[2 * r + t] += weight * (received[r].dot(of_face) + reflect_direction(received[r], n).dot(of_last));
    }
  };
  if (std::abs(off) < kAtSpecular) {
    add(-kAside, 0.5);
    add(kAside, 0.5);
  } else {
    add(off, 1);
  }
  return ends;
}

}  // namespace seaglint
