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
SurfaceState surface_along(std::span<const WaveComponent> component, std::span<const double> cosine,
                           std::span<const double> sine, std::size_t quadratic) {
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
  for (std::size_t i = quadratic; i < component.size(); ++i) {
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

  const Vec2& xi = component.front().direction;
  SurfaceState state;
  state.elevation_linear = elevation + sum0.c;
  const double sum = 0.5 * (sum1.c * sum0.c - sum1.s * sum0.s);
  state.elevation = state.elevation_linear + sum - 0.5 * (difference.c + difference.s);
  // d/d xi of the sums: products of running sums for eta2+, (k_i - k_j)^2 (s_i c_j - c_i s_j) for each pair of eta2-.
  const double sum_slope = 0.5 * (sum2.s * sum0.c + 2 * sum1.c * sum1.s + sum2.c * sum0.s);
  const double difference_slope_sum = -0.5 * (difference_slope.c - difference_slope.s);
  const double slope_along = slope + sum1.s + sum_slope + difference_slope_sum;
  state.slope_x = slope_along * xi.x();
  state.slope_y = slope_along * xi.y();
  if constexpr (kWithMotion) {
    const double eta = sum0.c, eta_slope = sum1.s;  // of the linear waves in the quadratic sums
    const double lift = -kGravity * sum1.c;         // their vertical acceleration
    const double rate2 =
        -0.5 * (omega1.s * sum0.c + omega1.c * sum0.s + sum1.s * omega0.c + sum1.c * omega0.s) + 0.5 * rate;
    const double rate_of_rate2 =
        -0.5 * (kGravity * (sum2.c * sum0.c - sum2.s * sum0.s) + 2 * (omega1.c * omega0.c - omega1.s * omega0.s) +
                kGravity * (sum1.c * sum1.c - sum1.s * sum1.s)) +
        0.5 * elevation_tt;
    const double velocity = high.c + omega0.c + eta * omega1.c - drift;
    const double acceleration = -kGravity * slope_along - lift * eta_slope;
    state.velocity = {velocity * xi.x(), velocity * xi.y(), -high.s - omega0.s + rate2 + omega0.c * eta_slope};
    state.acceleration = {
        acceleration * xi.x(), acceleration * xi.y(),
        -high_lift + lift + rate_of_rate2 + 2 * omega0.c * omega1.c - kGravity * eta_slope * eta_slope};
  }
  return state;
}

}  // namespace

SurfaceState long_crested_surface(std::span<const WaveComponent> components, std::span<const double> cosine,
                                  std::span<const double> sine, std::size_t quadratic, SurfaceQuantities detail) {
  return detail == SurfaceQuantities::kKinematics ? surface_along<true>(components, cosine, sine, quadratic)
                                                  : surface_along<false>(components, cosine, sine, quadratic);
}

}  // namespace seaglint
