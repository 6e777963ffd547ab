// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/coefficients/impedance_wedge.h"

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

constexpr Complex j(0, 1);
// Phase of sin(theta) beyond which the path of s is rotated by the rest, rad: its integrand has poles at tan v = +-j
// e^{j phase}, on the path for a reactive face. The path stays in Re s > 0, where the logarithm is regular.
constexpr double kMaxPhase = 0.9;
constexpr int kNodes = 48;  // of the quadrature over v

// Nodes v and weights over 0..pi/2: Gauss-Legendre quadrature, by Newton's method on the Legendre polynomial, in y with
// pi/2 - v = (pi/2) y^2, since the integrand ends as (pi/2 - v)^(1/N).
struct Quadrature {
  std::array<double, kNodes> tangent, sine_squared, weight;

  Quadrature() {
    for (int i = 0; i < kNodes; ++i) {
      double x = std::cos(kPi * (i + 0.75) / (kNodes + 0.5)), slope = 1;
      for (int step = 0; step < 20; ++step) {
        double p = 1, before = 0;
        for (int n = 1; n <= kNodes; ++n) {
          const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
          before = p;
          p = next;
        }
        slope = kNodes * (before - x * p) / (1 - x * x);
        x -= p / slope;
      }
      const double y = 0.5 * (1 + x), v = kPi / 2 * (1 - y * y);
      tangent[i] = std::tan(v);
      sine_squared[i] = std::sin(v) * std::sin(v);
      weight[i] = kPi / 2 * y * 2 / ((1 - x * x) * slope * slope);
    }
  }
};

bool is_soft(const Complex& brewster_sine) { return std::abs(brewster_sine) >= kSoftConductor; }

// One face of the wedge: g(x) / g(0), and the elementary products of g at arguments pi apart.
class FaceFactor {
 public:
  FaceFactor(const Complex& brewster_sine, double N) : size_(std::abs(brewster_sine)), N_(N) {
    is_soft_ = is_soft(brewster_sine);
    const double phase = size_ > 0 ? std::arg(brewster_sine) : 0, within = std::clamp(phase, -kMaxPhase, kMaxPhase);
    turn_ = std::polar(1.0, within);
    path_ = std::polar(size_, phase - within);
    // Inverse of cos((pi/2 - theta) / N).
    if (!is_soft_) inverse_ = 1.0 / std::cos(std::acos(brewster_sine) / N);
    const Complex at_right_angle = ratio(kPi / 2);
    normalisation_ = at_right_angle * at_right_angle;
  }

  // g(x) / g(0)
  Complex ratio(double x) const {
    if (is_soft_) return 1;
    const double cosine = std::cos(x / N_);
    if (size_ == 0) return std::sqrt(std::max(0.5 * (1 + cosine), 0.0));  // |cos(x / 2N)|, |x| <= N pi
    static const Quadrature nodes;
    Complex sum = 0;
    for (int i = 0; i < kNodes; ++i) {
      const Complex cosh = std::cosh(std::asinh(path_ * nodes.tangent[i]) / N_);
      const double s2 = nodes.sine_squared[i];
      sum += nodes.weight[i] * std::log((cosine + cosh) / (1.0 + cosh)) * turn_ / (s2 + turn_ * turn_ * (1 - s2));
    }
    return std::exp(sum / kPi);
  }

  // g(x + pi sign) g(x) / g(0)^2
  Complex product(double x, double sign) const {
    if (is_soft_) return normalisation_;
    return normalisation_ * (std::cos((x + sign * kPi / 2) / N_) * inverse_ + 1.0) / (inverse_ + 1.0);
  }

 private:
  double size_;
  double N_;
  bool is_soft_ = false;
  Complex turn_ = 1, path_ = 0;  // sinh s = path tan v, sin(theta) = path turn
  Complex inverse_ = 0, normalisation_ = 1;
};

}  // namespace

Complex brewster_sine(const Complex& reflection, double sin_phi) {
  const Complex below = 1.0 + reflection, above = sin_phi * (1.0 - reflection);
  if (std::abs(above) >= kSoftConductor * std::abs(below)) return kSoftConductor;
  const Complex sine = above / below;
  return {std::max(sine.real(), 0.0), sine.imag()};
}

Complex impedance_wedge(double phi, double phi0, const std::array<Complex, 2>& brewster_sines, double N) {
  // A face enters with the angle from the other face, x: phi for face 1 and phi - N pi for face 0.
  const FaceFactor first(brewster_sines[0], N), second(brewster_sines[1], N);
  const double round = N * kPi, middle = round / 2;
  const auto of_direction = [&](double angle) { return second.ratio(angle) * first.ratio(angle - round); };
  const Complex receiver = of_direction(phi), transmitter = phi == phi0 ? receiver : of_direction(phi0);
  const double sine_0 = std::sin((phi0 - middle) / N);
  const auto part = [&](double sign) {
    return second.product(phi, sign) * first.product(phi - round, sign) /
           (std::sin((phi - middle + sign * kPi) / N) - sine_0);
  };
  return -0.5 * j * std::cos((phi0 - middle) / N) / N * (part(-1) - part(1)) / (receiver * transmitter);
}

Complex half_plane_optics(double phi, double phi0, const Complex& reflection, const Complex& transmission) {
  return 0.25 * j *
         ((1.0 + reflection - transmission) * std::sin(phi) - (1.0 - reflection - transmission) * std::sin(phi0)) /
         (std::cos(phi) + std::cos(phi0));
}

}  // namespace seaglint
