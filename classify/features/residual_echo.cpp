// SPDX-License-Identifier: BSD-3-Clause
#include "classify/features/residual_echo.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

// Largest phase at the chirp's edge, rad, for which moments up to the third suffice (error 0.2^4/24 = 7e-5); a fit that
// moves further recomputes them at its new position.
constexpr double kMomentReach = 0.2;
constexpr int kMaxPasses = 4;
// Ratio of the curvatures of ln |RV| along the two axes below which the echo has no resolution along the flatter one.
constexpr double kFlat = 1e-9;

// Phase factors e^{j phase(b)} of one pulse, phase = 4 pi [f v (t + f_b/mu) + (f - f_c) r] / c, quadratic in b: each
// factor is the previous one times a ratio, and the ratio changes by a constant factor (1 without motion during the
// pulse).
struct PulsePhasor {
  Complex value, ratio, ratio_step;
  bool is_quadratic;

  PulsePhasor(const PulseTrain& train, std::size_t pulse, double range_m, double velocity_mps,
              bool intra_pulse_motion) {
    const double slope = intra_pulse_motion ? velocity_mps / train.chirp_rate_hz_s : 0;  // metres per hertz
    const double lowest = train.baseband_hz.front(), step = train.baseband_step_hz;
    const auto phase = [&](double b) {
      const double baseband = lowest + b * step;
      const double f = train.carrier_hz[pulse] + baseband;
      return 4 * kPi / kSpeedOfLight *
             (f * (velocity_mps * train.time_s[pulse] + slope * baseband) + (f - train.band_centre_hz()) * range_m);
    };
    value = std::polar(1.0, phase(0));
    ratio = std::polar(1.0, phase(1) - phase(0));
    is_quadratic = intra_pulse_motion;
    ratio_step = std::polar(1.0, 8 * kPi / kSpeedOfLight * slope * step * step);
  }

  void next() {
    value *= ratio;
    if (is_quadratic) ratio *= ratio_step;
  }
};

// Value and derivatives of RV at an offset from the position of the moments.
struct Taylor {
  Complex rv, r, v, rr, rv_mixed, vv;
};

}  // namespace

ResidualEcho::ResidualEcho(std::span<const Complex> echo, const PulseTrain& train, const MapSpec& spec,
                           bool intra_pulse_motion)
    : train_(train),
      spec_(spec),
      intra_pulse_motion_(intra_pulse_motion),
      echo_(echo.begin(), echo.end()),
      weight_(echo.size()) {
  const MapWeights weights = map_weights(train, spec);
  const std::vector<Complex> filter = compression_filter(train, spec.compression);
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const std::size_t k = static_cast<std::size_t>(train.code[n]) * train.bins_per_hop + b;
      weight_[n * train.frequencies() + b] = weights.pulse[n] * weights.bin[k] * filter[b];
    }
  }
}

RvMap ResidualEcho::map() const { return form_rv_map(echo_, train_, spec_, intra_pulse_motion_); }

Complex ResidualEcho::value(double range_m, double velocity_mps) const {
  Complex sum;
  for (const PulseMoments& m : moments(range_m, velocity_mps)) sum += m.m0;
  return sum;
}

std::vector<ResidualEcho::PulseMoments> ResidualEcho::moments(double range_m, double velocity_mps) const {
  const std::size_t frequencies = train_.frequencies();
  std::vector<PulseMoments> all(train_.pulses());
  for (std::size_t n = 0; n < all.size(); ++n) {
    PulsePhasor phasor(train_, n, range_m, velocity_mps, intra_pulse_motion_);
    PulseMoments m;
    for (std::size_t b = 0; b < frequencies; ++b, phasor.next()) {
      const std::size_t i = n * frequencies + b;
      const double wavenumber = 4 * kPi / kSpeedOfLight * train_.baseband_hz[b];
      const Complex x = weight_[i] * echo_[i] * phasor.value;
      const Complex kx = wavenumber * x, kkx = wavenumber * kx;
      m.m0 += x;
      m.m1 += kx;
      m.m2 += kkx;
      m.m3 += wavenumber * kkx;
    }
    all[n] = m;
  }
  return all;
}

CleanComponent ResidualEcho::fit(double range_m, double velocity_mps, double reach_r, double reach_v) const {
  CleanComponent point{range_m, velocity_mps, {}};
  const double edge = 4 * kPi / kSpeedOfLight * std::abs(train_.baseband_hz.front());
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const std::vector<PulseMoments> all = moments(point.range_m, point.velocity_mps);
    const auto expand = [&](double dr, double dv) {
      Taylor s;
      for (std::size_t n = 0; n < all.size(); ++n) {
        const double t = train_.time_s[n], f = train_.carrier_hz[n];
        const double kr = 4 * kPi / kSpeedOfLight * (f - train_.band_centre_hz()), kv = 4 * kPi / kSpeedOfLight * f * t;
        const Complex phasor = std::polar(1.0, kr * dr + kv * dv);
        const double y = dr + dv * t;
        const Complex z2 = phasor * (all[n].m2 + Complex(0, y) * all[n].m3);
        const Complex z1 = phasor * (all[n].m1 + Complex(0, y) * all[n].m2 - 0.5 * y * y * all[n].m3);
        const Complex z0 = phasor * (all[n].m0 + Complex(0, y) * all[n].m1 - 0.5 * y * y * all[n].m2 -
                                     Complex(0, y * y * y / 6) * all[n].m3);
        // d/dr gives a factor j (kr + k_b), d/dv a factor j (kv + k_b t), k_b the baseband wavenumber of the moments.
        s.rv += z0;
        s.r += kr * z0 + z1;
        s.v += kv * z0 + t * z1;
        s.rr += kr * kr * z0 + 2 * kr * z1 + z2;
        s.rv_mixed += kr * kv * z0 + (kv + kr * t) * z1 + t * z2;
        s.vv += kv * kv * z0 + 2 * kv * t * z1 + t * t * z2;
      }
      const Complex j(0, 1);
      return Taylor{s.rv, j * s.r, j * s.v, -s.rr, -s.rv_mixed, -s.vv};
    };

    // Newton's method on ln |RV|, which is concave in the main lobe; steps that do not increase it are halved.
    double dr = 0, dv = 0;
    Taylor here = expand(0, 0);
    for (int i = 0; i < 8 && std::abs(here.rv) > 0; ++i) {
      const double gr = std::real(here.r / here.rv), gv = std::real(here.v / here.rv);
      const double hrr = std::real(here.rr / here.rv - here.r * here.r / (here.rv * here.rv));
      const double hvv = std::real(here.vv / here.rv - here.v * here.v / (here.rv * here.rv));
      const double hrv = std::real(here.rv_mixed / here.rv - here.r * here.v / (here.rv * here.rv));
      // One pulse has no velocity resolution, one frequency no range resolution: then only the other is fitted.
      const double bend_r = -hrr * reach_r * reach_r, bend_v = -hvv * reach_v * reach_v;
      double step_r = 0, step_v = 0;
      if (bend_r > 0 && std::abs(bend_v) < kFlat * bend_r) {
        step_r = -gr / hrr;
      } else if (bend_v > 0 && std::abs(bend_r) < kFlat * bend_v) {
        step_v = -gv / hvv;
      } else {
        const double determinant = hrr * hvv - hrv * hrv;
        if (!(hrr < 0 && determinant > 0)) break;
        step_r = -(hvv * gr - hrv * gv) / determinant;
        step_v = -(hrr * gv - hrv * gr) / determinant;
      }
      // The iteration ends with a step below a hundredth of the reach: the remaining error of Newton's method is its
      // square.
      const bool last = std::abs(step_r) < 1e-2 * reach_r && std::abs(step_v) < 1e-2 * reach_v;
      bool climbed = false;
      for (int half = 0; half < (last ? 1 : 4) && !climbed; ++half, step_r *= 0.5, step_v *= 0.5) {
        const double to_r =
            std::clamp(point.range_m + dr + step_r, range_m - reach_r, range_m + reach_r) - point.range_m;
        const double to_v =
            std::clamp(point.velocity_mps + dv + step_v, velocity_mps - reach_v, velocity_mps + reach_v) -
            point.velocity_mps;
        const Taylor there = expand(to_r, to_v);
        if (std::abs(there.rv) <= std::abs(here.rv)) continue;
        climbed = true;
        dr = to_r;
        dv = to_v;
        here = there;
      }
      if (last || !climbed) break;
    }
    point = {point.range_m + dr, point.velocity_mps + dv, here.rv};
    if (edge * (std::abs(dr) + std::abs(dv) * train_.time_s.back()) < kMomentReach) break;
  }
  return point;
}

void ResidualEcho::subtract(const CleanComponent& point) {
  const std::size_t frequencies = train_.frequencies();
  std::vector<Complex> scaled(frequencies);
  for (std::size_t b = 0; b < frequencies; ++b) scaled[b] = point.amplitude_m * train_.chirp_spectrum[b];
  for (std::size_t n = 0; n < train_.pulses(); ++n) {
    PulsePhasor phasor(train_, n, point.range_m, point.velocity_mps, intra_pulse_motion_);
    for (std::size_t b = 0; b < frequencies; ++b, phasor.next()) {
      echo_[n * frequencies + b] -= scaled[b] * std::conj(phasor.value);
    }
  }
}

}  // namespace seaglint
