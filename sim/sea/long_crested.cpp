// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/long_crested.h"

#include "sim/core/numbers/constants.h"

namespace seaglint {

namespace {

// A pair of sums, over a cos(theta) and over a sin(theta), theta = w t - k xi + phase.
struct Pair {
  double c = 0;
  double s = 0;
};

// Sharma and Dean (1981), "Second-order directional seas and associated wave forces", SPE J. 21, 129, in deep water for
// waves of one direction: B+ = (k_i + k_j)/4 and B- = -|k_i - k_j|/4, and the potential of a pair is -a_i a_j
// max(w_i, w_j) e^{|k_i - k_j| z} times the sine of the difference of their phases (Longuet-Higgins 1962). Sorted by k
// the double sums collapse:
//   eta2+ = 1/2 [(sum k c)(sum c) - (sum k s)(sum s)]
//   eta2- = -1/2 sum_i sum_{j<i} (k_i - k_j)(c_i c_j + s_i s_j)
//   u2 = -sum_i w_i sum_{j<i} (k_i - k_j)(c_i c_j + s_i s_j)
// with running sums over j < i. Slopes follow from d c/d xi = k s, d s/d xi = -k c, rates from d c/dt = -w s, d s/dt =
// w c. The terms i = j of the difference sum vanish in deep water, so the mean level is zero.
template <bool kWithMotion>
LongCrestedSurface surface(const WaveComponent* component, const double* cosine, const double* sine, std::size_t count,
                           std::size_t quadratic) {
  double elevation = 0, slope = 0;               // components beyond the quadratic sums
  Pair sum0, sum1, sum2;                         // sum v, sum k v, sum k^2 v over the components so far
  Pair difference, difference_slope;             //
  Pair omega0, omega1;                           // sum w v, sum k w v
  double drift = 0, rate = 0, elevation_tt = 0;  // of the difference waves: -u2, and 2 d/dt, 2 d^2/dt^2 of eta2-
  for (std::size_t i = 0; i < quadratic; ++i) {
    const double k = component[i].wavenumber;
    const Pair v{component[i].amplitude * cosine[i], component[i].amplitude * sine[i]};
    // sum_{j<i} (k_i - k_j) v_j and sum_{j<i} (k_i - k_j)^2 v_j
    const Pair first{k * sum0.c - sum1.c, k * sum0.s - sum1.s};
    const Pair second{k * (first.c - sum1.c) + sum2.c, k * (first.s - sum1.s) + sum2.s};
    difference.c += v.c * first.c;
    difference.s += v.s * first.s;
    difference_slope.c += v.s * second.c;
    difference_slope.s += v.c * second.s;
    const Pair kv{k * v.c, k * v.s};
    if constexpr (kWithMotion) {
      const double w = component[i].omega;
      // sum_{j<i} (k_i - k_j)(w_i - w_j) v_j and sum_{j<i} (k_i - k_j)(w_i - w_j)^2 v_j, with w_j^2 = g k_j
      const Pair w_first{k * omega0.c - omega1.c, k * omega0.s - omega1.s};
      const Pair product{w * first.c - w_first.c, w * first.s - w_first.s};
      const Pair twice{w * (product.c - w_first.c) + kGravity * (k * sum1.c - sum2.c),
                       w * (product.s - w_first.s) + kGravity * (k * sum1.s - sum2.s)};
      drift += w * (v.c * first.c + v.s * first.s);
      rate += v.s * product.c - v.c * product.s;
      elevation_tt += v.c * twice.c + v.s * twice.s;
      omega0 = {omega0.c + w * v.c, omega0.s + w * v.s};
      omega1 = {omega1.c + w * kv.c, omega1.s + w * kv.s};
    }
    sum0 = {sum0.c + v.c, sum0.s + v.s};
    sum1 = {sum1.c + kv.c, sum1.s + kv.s};
    sum2 = {sum2.c + k * kv.c, sum2.s + k * kv.s};
  }
  Pair high;             // sum w v
  double high_lift = 0;  // sum w^2 c
  for (std::size_t i = quadratic; i < count; ++i) {
    const double v_c = component[i].amplitude * cosine[i];
    const double v_s = component[i].amplitude * sine[i];
    elevation += v_c;
    slope += component[i].wavenumber * v_s;
    if constexpr (kWithMotion) {
      const double w = component[i].omega;
      high = {high.c + w * v_c, high.s + w * v_s};
      high_lift += w * (w * v_c);
    }
  }

  LongCrestedSurface state;
  state.elevation_linear = elevation + sum0.c;
  const double sum = 0.5 * (sum1.c * sum0.c - sum1.s * sum0.s);
  state.elevation = state.elevation_linear + sum - 0.5 * (difference.c + difference.s);
  // d/d xi of the sums: products of running sums for eta2+, (k_i - k_j)^2 (s_i c_j - c_i s_j) for each pair of eta2-.
  const double sum_slope = 0.5 * (sum2.s * sum0.c + 2 * sum1.c * sum1.s + sum2.c * sum0.s);
  const double difference_slope_sum = -0.5 * (difference_slope.c - difference_slope.s);
  state.slope = slope + sum1.s + sum_slope + difference_slope_sum;
  if constexpr (kWithMotion) {
    const double eta = sum0.c, eta_slope = sum1.s;  // of the linear waves in the quadratic sums
    const double lift = -kGravity * sum1.c;         // their vertical acceleration
    const double rate2 =
        -0.5 * (omega1.s * sum0.c + omega1.c * sum0.s + sum1.s * omega0.c + sum1.c * omega0.s) + 0.5 * rate;
    const double rate_of_rate2 =
        -0.5 * (kGravity * (sum2.c * sum0.c - sum2.s * sum0.s) + 2 * (omega1.c * omega0.c - omega1.s * omega0.s) +
                kGravity * (sum1.c * sum1.c - sum1.s * sum1.s)) +
        0.5 * elevation_tt;
    state.velocity = high.c + omega0.c + eta * omega1.c - drift;
    state.vertical_velocity = -high.s - omega0.s + rate2 + omega0.c * eta_slope;
    state.acceleration = -kGravity * state.slope - lift * eta_slope;
    state.vertical_acceleration =
        -high_lift + lift + rate_of_rate2 + 2 * omega0.c * omega1.c - kGravity * eta_slope * eta_slope;
  }
  return state;
}

}  // namespace

LongCrestedSurface long_crested_kinematics(const WaveComponent* component, const double* cosine, const double* sine,
                                           std::size_t count, std::size_t quadratic) {
  return surface<true>(component, cosine, sine, count, quadratic);
}

LongCrestedSurface long_crested_elevation(const WaveComponent* component, const double* cosine, const double* sine,
                                          std::size_t count, std::size_t quadratic) {
  return surface<false>(component, cosine, sine, count, quadratic);
}

}  // namespace seaglint
