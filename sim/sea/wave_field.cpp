// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/wave_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/core/error.h"

namespace seaglint {

namespace {

// A pair of sums, over a cos(theta) and over a sin(theta), theta = w t - k xi + phase, xi along the waves.
struct Pair {
  double c = 0;
  double s = 0;
};

// Sharma and Dean (1981), "Second-order directional seas and associated wave forces", SPE J. 21, 129, in deep water for
// waves of one direction: B+ = (k_i + k_j)/4 and B- = -|k_i - k_j|/4. Sorted by k the double sums collapse:
//   eta2+ = 1/2 [(sum k c)(sum c) - (sum k s)(sum s)]
//   eta2- = -1/2 sum_i sum_{j<i} (k_i - k_j)(c_i c_j + s_i s_j)
// with running sums over j < i. Slopes follow from d c/d xi = k s, d s/d xi = -k c. The terms i = j of the difference
// sum vanish in deep water, so the mean level is zero.
class SurfaceSums {
 public:
  void add(const WaveComponent* component, const double* cosine, const double* sine, std::size_t count,
           std::size_t quadratic) {
    for (std::size_t i = 0; i < quadratic; ++i) {
      const double k = component[i].wavenumber;
      const double w = component[i].omega;
      const Pair v{component[i].amplitude * cosine[i], component[i].amplitude * sine[i]};
      // sum_{j<i} (k_i - k_j) v_j and sum_{j<i} (k_i - k_j)^2 v_j
      const Pair first{k * sum0_.c - sum1_.c, k * sum0_.s - sum1_.s};
      const Pair second{k * (first.c - sum1_.c) + sum2_.c, k * (first.s - sum1_.s) + sum2_.s};
      difference_.c += v.c * first.c;
      difference_.s += v.s * first.s;
      difference_slope_.c += v.s * second.c;
      difference_slope_.s += v.c * second.s;
      const Pair kv{k * v.c, k * v.s};
      sum0_ = {sum0_.c + v.c, sum0_.s + v.s};
      sum1_ = {sum1_.c + kv.c, sum1_.s + kv.s};
      sum2_ = {sum2_.c + k * kv.c, sum2_.s + k * kv.s};
      velocity_ = {velocity_.c + w * v.c, velocity_.s + w * v.s};
    }
    for (std::size_t i = quadratic; i < count; ++i) {
      const double v_c = component[i].amplitude * cosine[i];
      const double v_s = component[i].amplitude * sine[i];
      elevation_ += v_c;
      slope_ += component[i].wavenumber * v_s;
      velocity_ = {velocity_.c + component[i].omega * v_c, velocity_.s + component[i].omega * v_s};
    }
  }

  SurfaceState state(const Vec2& direction) const {
    SurfaceState state;
    state.elevation_linear = elevation_ + sum0_.c;
    const double sum = 0.5 * (sum1_.c * sum0_.c - sum1_.s * sum0_.s);
    const double difference = -0.5 * (difference_.c + difference_.s);
    state.elevation = state.elevation_linear + sum + difference;
    // d/d xi of the sums: products of running sums for eta2+, (k_i - k_j)^2 (s_i c_j - c_i s_j) for each pair of eta2-.
    const double sum_slope = 0.5 * (sum2_.s * sum0_.c + 2 * sum1_.c * sum1_.s + sum2_.c * sum0_.s);
    const double difference_slope = -0.5 * (difference_slope_.c - difference_slope_.s);
    const double slope = slope_ + sum1_.s + sum_slope + difference_slope;
    state.slope_x = slope * direction.x();
    state.slope_y = slope * direction.y();
    // Airy: u = a w cos(theta) along the waves, vertical velocity = d eta/dt = -a w sin(theta).
    state.velocity = {velocity_.c * direction.x(), velocity_.c * direction.y(), -velocity_.s};
    return state;
  }

 private:
  double elevation_ = 0, slope_ = 0;  // components beyond the quadratic sums
  Pair sum0_, sum1_, sum2_;           // sum v, sum k v, sum k^2 v over the components so far
  Pair difference_, difference_slope_;
  Pair velocity_;
};

}  // namespace

WaveField::WaveField(std::vector<WaveComponent> components, Vec2 direction, int order, double second_order_cutoff_rad_s)
    : components_(std::move(components)), direction_(direction.normalized()), order_(order) {
  SEAGLINT_CHECK(order == 1 || order == 2, fmt::format("order {}", order));
  SEAGLINT_CHECK(direction.norm() > 0, "a direction of length zero");
  const auto by_omega = [](const WaveComponent& a, const WaveComponent& b) { return a.omega < b.omega; };
  SEAGLINT_CHECK(std::is_sorted(components_.begin(), components_.end(), by_omega), "components out of order");
  if (order_ == 2) {
    const auto end = std::find_if(components_.begin(), components_.end(),
                                  [&](const WaveComponent& c) { return c.omega > second_order_cutoff_rad_s; });
    second_order_count_ = static_cast<std::size_t>(end - components_.begin());
  }
}

SurfaceState WaveField::surface(double x, double y, double t) const {
  constexpr std::size_t kBlock = 128;
  std::array<double, kBlock> angle, cosine, sine;
  const double xi = direction_.x() * x + direction_.y() * y;
  SurfaceSums sums;
  for (std::size_t begin = 0; begin < components_.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, components_.size() - begin);
    const WaveComponent* component = components_.data() + begin;
    for (std::size_t i = 0; i < count; ++i) {
      angle[i] = component[i].omega * t - component[i].wavenumber * xi + component[i].phase;
    }
    // The highest component turns fastest, but a far point can make any of them large.
    for (std::size_t i = 0; i < count; ++i) {
      SEAGLINT_CHECK(std::abs(angle[i]) <= kLargestAngle, fmt::format("phase of a wave {} rad", angle[i]));
    }
    unit_phasors({angle.data(), count}, {cosine.data(), count}, {sine.data(), count});
    const std::size_t quadratic = second_order_count_ > begin ? std::min(count, second_order_count_ - begin) : 0;
    sums.add(component, cosine.data(), sine.data(), count, quadratic);
  }
  return sums.state(direction_);
}

namespace {

UniformPhasors phasors_at(const WaveField& field, double x, double y, double start, double step) {
  const double xi = field.direction().x() * x + field.direction().y() * y;
  std::vector<double> omega, phase;
  for (const WaveComponent& component : field.components()) {
    omega.push_back(component.omega);
    phase.push_back(component.phase - component.wavenumber * xi);
  }
  return UniformPhasors(std::move(omega), std::move(phase), start, step);
}

}  // namespace

SurfaceSeries::SurfaceSeries(const WaveField& field, double x, double y, double start, double step)
    : field_(&field), phasors_(phasors_at(field, x, y, start, step)) {}

SurfaceState SurfaceSeries::state() const {
  SurfaceSums sums;
  sums.add(field_->components_.data(), phasors_.cosine().data(), phasors_.sine().data(), field_->components_.size(),
           field_->second_order_count_);
  return sums.state(field_->direction_);
}

}  // namespace seaglint
