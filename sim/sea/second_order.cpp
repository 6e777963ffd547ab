// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/second_order.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr std::size_t kLanes = 4;  // columns added together

// Quantities of one wave in the kernels.
struct Wave {
  double omega = 0;
  double R = 0;       // k tanh(k h)
  double excess = 0;  // k^2 - R^2 = k^2 / cosh^2(k h)
  Vec2 k = Vec2::Zero();
};

double k_tanh(double k, double depth) { return std::isinf(depth) ? k : k * reproducible_tanh(k * depth); }

Wave wave_of(const WaveComponent& component, double depth) {
  const double k = component.wavenumber;
  const double e = std::isinf(depth) ? 0 : reproducible_exp(-k * depth);
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
// `quotient` is D+- / (r_i +- r_j), which is finite for two waves of one frequency and different directions. Two waves
// of one frequency and direction have no difference wave: their contribution to the mean level is omitted, as for i =
// j.
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

// kernel times x, four columns at a time: each element is summed in the same order on all processors.
std::vector<double> multiply(const std::vector<double>& kernel, const std::vector<double>& x) {
  const std::size_t stride = x.size();
  std::vector<double> result(stride);
  double* y = result.data();
  for (std::size_t j = 0; j < stride; j += kLanes) {
    const double* k0 = kernel.data() + j * stride;
    const double *k1 = k0 + stride, *k2 = k1 + stride, *k3 = k2 + stride;
    const double x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
    for (std::size_t i = 0; i < stride; ++i) y[i] += (k0[i] * x0 + k1[i] * x1) + (k2[i] * x2 + k3[i] * x3);
  }
  return result;
}

}  // namespace

PairInteractions::PairInteractions(std::span<const WaveComponent> components, double depth)
    : size_(components.size()), stride_((size_ + kLanes - 1) / kLanes * kLanes) {
  SEAGLINT_CHECK(size_ <= kMaxComponents, fmt::format("{} components", size_));
  std::vector<Wave> waves;
  for (const WaveComponent& component : components) waves.push_back(wave_of(component, depth));
  const std::size_t entries = stride_ * stride_;
  elevation_even_.resize(entries);
  elevation_odd_.resize(entries);
  potential_even_.resize(entries);
  potential_odd_.resize(entries);
  for (std::size_t j = 0; j < size_; ++j) {
    for (std::size_t i = 0; i <= j; ++i) {
      const Kernels k = kernels_of(waves[i], waves[j], depth);
      const std::size_t upper = j * stride_ + i, lower = i * stride_ + j;
      elevation_even_[upper] = elevation_even_[lower] = k.elevation_sum + k.elevation_difference;
      elevation_odd_[upper] = elevation_odd_[lower] = k.elevation_sum - k.elevation_difference;
      // P- is antisymmetric.
      potential_even_[upper] = potential_odd_[lower] = k.potential_sum + k.potential_difference;
      potential_odd_[upper] = potential_even_[lower] = k.potential_sum - k.potential_difference;
    }
  }
}

// With z_i = a_i e^{j th_i} and symmetric kernels, eta2 = Re sum_i z_i [(B+ z)_i + conj (B- z)_i], and the bracket has
// the real part (B+ + B-) Re z and the imaginary part (B+ - B-) Im z. A derivative acts on both factors equally and
// doubles that of the first: d/dt z = j w z, d/dx z = -j k_x z. Likewise for the potential.
SecondOrder PairInteractions::evaluate(std::span<const WaveComponent> components, std::span<const double> cosine,
                                       std::span<const double> sine, bool motion) const {
  SEAGLINT_CHECK(components.size() == size_ && cosine.size() == size_ && sine.size() == size_,
                 fmt::format("{} components instead of {}", components.size(), size_));
  std::vector<double> re(cosine.begin(), cosine.end()), im(sine.begin(), sine.end());
  re.resize(stride_);
  im.resize(stride_);
  const std::vector<double> bracket_re = multiply(elevation_even_, re);
  const std::vector<double> bracket_im = multiply(elevation_odd_, im);
  SecondOrder second;
  for (std::size_t i = 0; i < size_; ++i) {
    second.elevation += re[i] * bracket_re[i] - im[i] * bracket_im[i];
    const double imaginary = re[i] * bracket_im[i] + im[i] * bracket_re[i];
    second.slope += 2 * components[i].wavenumber * imaginary * components[i].direction;
  }
  if (!motion) return second;

  std::vector<double> w_re(stride_), w_im(stride_);
  for (std::size_t i = 0; i < size_; ++i) {
    w_re[i] = components[i].omega * re[i];
    w_im[i] = components[i].omega * im[i];
  }
  const std::vector<double> mixed_re = multiply(elevation_odd_, w_re);
  const std::vector<double> mixed_im = multiply(elevation_even_, w_im);
  const std::vector<double> potential_re = multiply(potential_even_, re);
  const std::vector<double> potential_im = multiply(potential_odd_, im);
  for (std::size_t i = 0; i < size_; ++i) {
    const double w = components[i].omega;
    second.elevation_t -= 2 * w * (re[i] * bracket_im[i] + im[i] * bracket_re[i]);
    // (w_i +- w_j)^2 = w_i^2 + w_j^2 +- 2 w_i w_j
    const double equal = re[i] * bracket_re[i] - im[i] * bracket_im[i];
    const double mixed = re[i] * mixed_re[i] - im[i] * mixed_im[i];
    second.elevation_tt -= 2 * w * (w * equal + mixed);
    const double flow = re[i] * potential_re[i] - im[i] * potential_im[i];
    second.velocity += 2 * components[i].wavenumber * flow * components[i].direction;
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
      sum += (i == j ? 3.0 : 6.0) * ei * ej * elevation_even_[j * stride_ + i];
    }
  }
  return sum;
}

}  // namespace seaglint
