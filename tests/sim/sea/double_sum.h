// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Second-order waves derived pair by pair from the boundary conditions at the free surface, without the kernels of
// Sharma and Dean: the reference for sim/sea.

#include <cmath>
#include <complex>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/linear.h"
#include "sim/sea/second_order.h"

namespace seaglint {

// Linear and second-order surface at one place and time, with the velocity of the water there to second order.
struct ReferenceSurface {
  double linear = 0, second = 0;  // elevation
  Vec2 second_slope = Vec2::Zero();
  Vec3 velocity = Vec3::Zero(), acceleration = Vec3::Zero();
};

namespace double_sum {

// Complex amplitudes of e^{j th}, th = w t - k.x + phase, of one linear wave at z = 0: phi1 = Re{j a g/w e^{j th}}.
struct Wave {
  double w;
  Vec2 k;
  Complex eta, phi, z, zz, tz, at;  // phi1, its z derivatives, d2/dt dz, and e^{j th} itself

  Wave(const WaveComponent& c, double depth, double x, double y, double t) : w(c.omega), k(c.wavenumber * c.direction) {
    const Complex j(0, 1);
    const double tanh_kh = std::isinf(depth) ? 1 : std::tanh(c.wavenumber * depth);
    eta = c.amplitude;
    phi = j * c.amplitude * kGravity / w;
    z = c.wavenumber * tanh_kh * phi;
    zz = c.wavenumber * c.wavenumber * phi;
    tz = j * w * z;
    at = std::polar(1.0, w * t - k.x() * x - k.y() * y + c.phase);
  }
  Complex u(int axis) const { return Complex(0, -1) * k[axis] * phi; }
  Complex uz(int axis) const { return Complex(0, -1) * k[axis] * z; }
  Complex eta_slope(int axis) const { return Complex(0, -1) * k[axis] * eta; }
};

inline double real(const Complex& amplitude, const Complex& at) { return (amplitude * at).real(); }

}  // namespace double_sum

// Second order at z = 0 (Stokes' expansion):
//   phi2_z - eta2_t = grad phi1 . grad eta1 - eta1 phi1_zz
//   phi2_t + g eta2 = -1/2 |grad3 phi1|^2 - eta1 phi1_tz
// and a pair's wave of frequency W and wavenumber K has phi2_z = K tanh(K h) phi2.
inline ReferenceSurface second_order_surface(const std::vector<WaveComponent>& components, double depth, double x,
                                             double y, double t) {
  using double_sum::real;
  using double_sum::Wave;
  const Complex j(0, 1);
  std::vector<Wave> waves;
  for (const WaveComponent& c : components) waves.emplace_back(c, depth, x, y, t);

  ReferenceSurface surface;
  double eta1 = 0, u1[3] = {}, u1_z[3] = {}, u1_t[3] = {}, u1_tz[3] = {}, u1_x[3] = {}, u1_y[3] = {};
  for (const Wave& a : waves) {
    eta1 += real(a.eta, a.at);
    const Complex u[3] = {a.u(0), a.u(1), a.z}, uz[3] = {a.uz(0), a.uz(1), a.zz};
    for (int i = 0; i < 3; ++i) {
      u1[i] += real(u[i], a.at);
      u1_z[i] += real(uz[i], a.at);
      u1_t[i] += real(j * a.w * u[i], a.at);
      u1_tz[i] += real(j * a.w * uz[i], a.at);
      u1_x[i] += real(-j * a.k.x() * u[i], a.at);
      u1_y[i] += real(-j * a.k.y() * u[i], a.at);
    }
  }
  surface.linear = eta1;
  for (int i = 0; i < 3; ++i) {
    surface.velocity[i] = u1[i] + eta1 * u1_z[i];
    surface.acceleration[i] = u1_t[i] + eta1 * u1_tz[i] + u1[0] * u1_x[i] + u1[1] * u1_y[i] + u1[2] * u1_z[i];
  }

  for (std::size_t m = 0; m < waves.size(); ++m) {
    for (std::size_t n = 0; n < waves.size(); ++n) {
      const Wave& a = waves[m];
      for (const bool sum : {true, false}) {
        if (!sum && m == n) continue;  // mean level and uniform flow
        Wave b = waves[n];
        if (!sum) {  // Re{q e^{j th}} = Re{q* e^{-j th}}
          for (Complex* q : {&b.eta, &b.phi, &b.z, &b.zz, &b.tz, &b.at}) *q = std::conj(*q);
          b.w = -b.w;
          b.k = -b.k;
        }
        // Products of two real waves: half of the amplitudes' product belongs to th_a + th_b.
        const Complex kinematic = 0.5 * (a.u(0) * b.eta_slope(0) + a.u(1) * b.eta_slope(1) - a.eta * b.zz);
        const Complex dynamic = 0.5 * (-0.5 * (a.u(0) * b.u(0) + a.u(1) * b.u(1) + a.z * b.z) - a.eta * b.tz);
        const double W = a.w + b.w;
        const Vec2 K = a.k + b.k;
        const double Kz = std::isinf(depth) ? K.norm() : K.norm() * std::tanh(K.norm() * depth);
        const Complex phi = (j * W * dynamic + kGravity * kinematic) / (kGravity * Kz - W * W);
        const Complex eta = (dynamic - j * W * phi) / kGravity, at = a.at * b.at;
        surface.second += real(eta, at);
        const Complex u[3] = {-j * K.x() * phi, -j * K.y() * phi, Kz * phi};
        for (int i = 0; i < 2; ++i) surface.second_slope[i] += real(-j * K[i] * eta, at);
        for (int i = 0; i < 3; ++i) {
          surface.velocity[i] += real(u[i], at);
          surface.acceleration[i] += real(j * W * u[i], at);
        }
      }
    }
  }
  return surface;
}

}  // namespace seaglint
