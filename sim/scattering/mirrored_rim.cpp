// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/mirrored_rim.h"

#include <cmath>

#include "sim/core/constants.h"

namespace seaglint {
namespace {

// |s - direction of reflection| within which the expansion holds and from where on it does not.
constexpr std::array<double, 2> kOffReflection{0.1, 0.2};
// The same as a part of the way from there to the wave's way on, where what another face that is grazed leaves has its pole.
constexpr std::array<double, 2> kOffGrazing{0.25, 0.5};
// Cosine against the normal, below which a wave grazes the rim's face: 2 and 6 deg. Nearer to it the next mirror stands in the zone that the beam, the wave beside it and what the rim diffracts
// share.
constexpr std::array<double, 2> kGrazingFace{0.035, 0.11};
// The ends are taken this far to either side of the direction of reflection, rad, and their poles cancel: the constant errs by its square times the ends' second derivative, 1e-6 at 10 deg.
constexpr double kAside = 1e-4;
// Cosine below which a beam grazes the last mirror: its end there would be far away, and infinite at last.
constexpr std::array<double, 2> kGrazing{0.05, 0.15};

Vec3 reflect(const Vec3& x, const Vec3& n) { return x - 2 * n.dot(x) * n; }

// n x (k^ x E): half of physical optics' current times eta, the wave being in the vacuum before the conductor.
Vec3 current(const Vec3& n, const Vec3& k_hat, const Vec3& E) { return n.cross(k_hat.cross(E)); }

}  // namespace

ReflectingFace reflecting_face(const WedgeFrame& wedge, const Vec3& k_hat, const Vec3& s) {
  ReflectingFace best;
  for (int i = 0; i < 2; ++i) {
    const Vec3& n = wedge.face[i].n;
    if (n.dot(k_hat) >= 0) continue;
    const double off = (s - reflect(k_hat, n)).norm(), cosine = -n.dot(k_hat);
    const double share = fading(off, kOffReflection) * fading(off / (2 * cosine), kOffGrazing) * (1 - fading(cosine, kGrazingFace)) * before_the_beam(k_hat, s);
    if (share > best.share) best = {i, share};
  }
  return best;
}

std::array<double, 4> ends_of_beam(const WedgeFace& face, const EdgeArrival& in, const EdgeArrival& out) {
  std::array<double, 4> ends{};
  if (out.mirrors == 0) return ends;
  const Vec3& k_hat = in.direction;
  const Vec3 beam = reflect(k_hat, face.n), n = out.first_mirror.dot(beam) < 0 ? out.first_mirror : Vec3(-out.first_mirror);
  const double cosine = n.dot(beam);
  const double share = 1 - fading(-cosine, kGrazing);
  if (share <= 0) return ends;
  // On the last mirror the rim's shadow, and into the light from there, as long as on the rim.
  const Vec3 shadow = face.t - face.t.dot(n) / cosine * beam, into = face.x - face.x.dot(n) / cosine * beam;
  const double area = shadow.cross(into).norm();
  for (const double aside : {-kAside, kAside}) {
    const Eigen::AngleAxisd turn(aside, face.t);
    const Vec3 away = turn * beam - beam;
    const std::array<Vec3, 2> received{turn * out.E_h, turn * out.E_v};
    for (int t = 0; t < 2; ++t) {
      const Vec3& E = t == 0 ? in.E_h : in.E_v;
      // The integral of e^{jk away.x u} du from 0 on, times -jk / 2 pi.
      const Vec3 of_face = current(face.n, k_hat, E) / (2 * kPi * away.dot(face.x));
      const Vec3 of_last = current(n, beam, -reflect(E, face.n)) * area / (2 * kPi * away.dot(into));
      for (int r = 0; r < 2; ++r) ends[2 * r + t] += 0.5 * share * (received[r].dot(of_face) + reflect(received[r], n).dot(of_last));
    }
  }
  return ends;
}

}  // namespace seaglint
