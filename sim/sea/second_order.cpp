// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/second_order.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/core/exact_functions.h"

namespace seaglint {

namespace {

constexpr std::size_t kLanes = 4;  // columns that are added at once

// A wave as the kernels see it.
struct Wave {
  double omega = 0;
  double R = 0;       // k tanh(k h)
  double excess = 0;  // k^2 - R^2 = k^2 / cosh^2(k h)
  Vec2 k = Vec2::Zero();
};

double k_tanh(double k, double depth) { return std::isinf(depth) ? k : k * exact_tanh(k * depth); }

Wave wave_of(const WaveComponent& component, double depth) {
  const double k = component.wavenumber;
  const double e = std::isinf(depth) ? 0 : exact_exp(-k * depth);
  const double per_cosh = 2 * k * e / (1 + e * e);  // k / cosh(k h)
  return {component.omega, k_tanh(k, depth), per_cosh * per_cosh, k * component.direction};
}

// Kernels of one pair: the elevation is sum_ij a_i a_j [B+ cos(th_i + th_j) + B- cos(th_i - th_j)], the potential at
// the mean level -sum_ij a_i a_j [P+ sin(th_i + th_j) + P- sin(th_i - th_j)], th = w t - k.x + phase.
struct Kernels {
  double elevation_sum, elevation_difference, potential_sum, potential_difference;
};

// Sharma and Dean (1981), "Second-order directional seas and associated wave forces", SPE J. 21, 129:
//   B+- = 1/4 [(D+- - (k_i.k_j -+ R_i R_j)) / sqrt(R_i R_j) + R_i + R_j]
//   D+- = {(r_i +- r_j)[r_j (k_i^2 - R_i^2) +- r_i (k_j^2 - R_j^2)] + 2 (r_i +- r_j)^2 (k_i.k_j -+ R_i R_j)}
//         / {(r_i +- r_j)^2 - k+- tanh(k+- h)},   r = sqrt R,  k+- = |k_i +- k_j|
//   P+- = 1/4 g^2 D+- / (w_i w_j (w_i +- w_j)),   w = sqrt(g) r
// `quotient` is D+- / (r_i +- r_j), which is finite where two waves of one frequency cross. Two waves of one frequency
// and direction have no difference wave: what they add to the mean level is left out, as for i = j.
Kernels kernels_of(const Wave& a, const Wave& b, double depth) {
  const double ra = std::sqrt(a.R), rb = std::sqrt(b.R);
  const double dot = a.k.dot(b.k);
  const double product = ra * rb;  // sqrt(R_i R_j)
  const double RR = product * product;
  const auto kernels = [&](double sign) {
    const double r = ra + sign * rb;
    const double inner = dot - sign * RR;
    const double numerator = rb * a.excess + sign * ra * b.excess + 2 * r * inner;
    const double quotient = numerator / (r * r - k_tanh((a.k + sign * b.k).norm(), depth));
    const double elevation = 0.25 * ((r * quotient - inner) / product + a.R + b.R);
    const double potential = 0.25 * std::sqrt(kGravity) * quotient / product;
    return std::pair{elevation, potential};
  };
  const auto [elevation_sum, potential_sum] = kernels(1);
  if ((a.k - b.k).norm() == 0) return {elevation_sum, 0, potential_sum, 0};
  const auto [elevation_difference, potential_difference] = kernels(-1);
  return {elevation_sum, elevation_difference, potential_sum, potential_difference};
}

// One complex number per component, padded with zeros to whole lanes.
struct Column {
  explicit Column(std::size_t stride) : re(stride), im(stride) {}
  std::vector<double> re, im;
};

// kernel times x, four columns at a time: every element of the result is summed in the same order on any processor.
Column multiply(const std::vector<double>& kernel, const Column& x) {
  const std::size_t stride = x.re.size();
  Column y(stride);
  double* re = y.re.data();
  double* im = y.im.data();
  for (std::size_t j = 0; j < stride; j += kLanes) {
    const double* k0 = kernel.data() + j * stride;
    const double *k1 = k0 + stride, *k2 = k1 + stride, *k3 = k2 + stride;
    const double re0 = x.re[j], re1 = x.re[j + 1], re2 = x.re[j + 2], re3 = x.re[j + 3];
    const double im0 = x.im[j], im1 = x.im[j + 1], im2 = x.im[j + 2], im3 = x.im[j + 3];
    for (std::size_t i = 0; i < stride; ++i) {
      re[i] += (k0[i] * re0 + k1[i] * re1) + (k2[i] * re2 + k3[i] * re3);
      im[i] += (k0[i] * im0 + k1[i] * im1) + (k2[i] * im2 + k3[i] * im3);
    }
  }
  return y;
}

}  // namespace

PairInteractions::PairInteractions(std::span<const WaveComponent> components, double depth)
    : size_(components.size()), stride_((size_ + kLanes - 1) / kLanes * kLanes) {
  SEAGLINT_CHECK(size_ <= kMostComponents, fmt::format("{} components", size_));
  std::vector<Wave> waves;
  for (const WaveComponent& component : components) waves.push_back(wave_of(component, depth));
  const std::size_t entries = stride_ * stride_;
  elevation_sum_.resize(entries);
  elevation_difference_.resize(entries);
  potential_sum_.resize(entries);
  potential_difference_.resize(entries);
  for (std::size_t j = 0; j < size_; ++j) {
    for (std::size_t i = 0; i <= j; ++i) {
      const Kernels k = kernels_of(waves[i], waves[j], depth);
      const std::size_t upper = j * stride_ + i, lower = i * stride_ + j;
      elevation_sum_[upper] = elevation_sum_[lower] = k.elevation_sum;
      elevation_difference_[upper] = elevation_difference_[lower] = k.elevation_difference;
      potential_sum_[upper] = potential_sum_[lower] = k.potential_sum;
      potential_difference_[upper] = k.potential_difference;
      potential_difference_[lower] = -k.potential_difference;
    }
  }
}

// With z_i = a_i e^{j th_i} and symmetric kernels, eta2 = Re sum_i z_i [(B+ z)_i + conj (B- z)_i]; a derivative acts on
// both factors alike and so doubles that of the first: d/dt z = j w z, d/dx z = -j k_x z. Likewise for the potential.
SecondOrder PairInteractions::evaluate(std::span<const WaveComponent> components, std::span<const double> cosine,
                                       std::span<const double> sine, bool motion) const {
  SEAGLINT_CHECK(components.size() == size_ && cosine.size() == size_ && sine.size() == size_,
                 fmt::format("{} components instead of {}", components.size(), size_));
  Column z(stride_);
  for (std::size_t i = 0; i < size_; ++i) {
    z.re[i] = cosine[i];
    z.im[i] = sine[i];
  }
  const Column sum = multiply(elevation_sum_, z);
  const Column difference = multiply(elevation_difference_, z);
  SecondOrder second;
  for (std::size_t i = 0; i < size_; ++i) {
    const double k = components[i].wavenumber;
    second.elevation += z.re[i] * (sum.re[i] + difference.re[i]) - z.im[i] * (sum.im[i] - difference.im[i]);
    const double imaginary = z.re[i] * (sum.im[i] - difference.im[i]) + z.im[i] * (sum.re[i] + difference.re[i]);
    second.slope += 2 * k * imaginary * components[i].direction;
    second.rate -= 2 * components[i].omega * imaginary;
  }
  if (!motion) {
    second.rate = 0;
    return second;
  }

  Column wz(stride_);
  for (std::size_t i = 0; i < size_; ++i) {
    wz.re[i] = components[i].omega * z.re[i];
    wz.im[i] = components[i].omega * z.im[i];
  }
  const Column sum_w = multiply(elevation_sum_, wz);
  const Column difference_w = multiply(elevation_difference_, wz);
  const Column sum_p = multiply(potential_sum_, z);
  const Column difference_p = multiply(potential_difference_, z);
  for (std::size_t i = 0; i < size_; ++i) {
    const double w = components[i].omega;
    // (w_i +- w_j)^2 = w_i^2 + w_j^2 +- 2 w_i w_j
    const double first = z.re[i] * (sum.re[i] + difference.re[i]) - z.im[i] * (sum.im[i] - difference.im[i]);
    const double mixed = z.re[i] * (sum_w.re[i] - difference_w.re[i]) - z.im[i] * (sum_w.im[i] + difference_w.im[i]);
    second.rate_of_rate -= 2 * w * (w * first + mixed);
    const double real = z.re[i] * (sum_p.re[i] + difference_p.re[i]) - z.im[i] * (sum_p.im[i] - difference_p.im[i]);
    second.velocity += 2 * components[i].wavenumber * real * components[i].direction;
  }
  return second;
}

// 3 E[eta1^2 eta2] = 6 sum_ij e_i e_j (B+ + B-), e = a^2/2; the term i = j of a wave of fixed amplitude is half of
// that.
double PairInteractions::third_cumulant(std::span<const WaveComponent> components) const {
  SEAGLINT_CHECK(components.size() == size_, fmt::format("{} components instead of {}", components.size(), size_));
  double sum = 0;
  for (std::size_t j = 0; j < size_; ++j) {
    const double ej = 0.5 * components[j].amplitude * components[j].amplitude;
    for (std::size_t i = 0; i < size_; ++i) {
      const double ei = 0.5 * components[i].amplitude * components[i].amplitude;
      const std::size_t pair = j * stride_ + i;
      sum += (i == j ? 3.0 : 6.0) * ei * ej * (elevation_sum_[pair] + elevation_difference_[pair]);
    }
  }
  return sum;
}

}  // namespace seaglint
