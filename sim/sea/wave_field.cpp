// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sea/wave_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/sea/second_order.h"

namespace seaglint {

namespace {

// True when every component satisfies the dispersion relation, to the digits of tables.
bool disperse(const std::vector<WaveComponent>& components, double depth) {
  constexpr double kDigits = 1e-6;
  return std::all_of(components.begin(), components.end(), [&](const WaveComponent& c) {
    const double of_length =
        kGravity * c.wavenumber * (std::isinf(depth) ? 1.0 : reproducible_tanh(c.wavenumber * depth));  // g k tanh(k h)
    return std::abs(of_length - c.omega * c.omega) <= kDigits * c.omega * c.omega;
  });
}

}  // namespace

WaveField::WaveField(std::vector<WaveComponent> components, int order, double second_order_cutoff_rad_s, double depth)
    : components_(std::move(components)), depth_(depth), order_(order) {
  SEAGLINT_CHECK(order == 1 || order == 2, fmt::format("order {}", order));
  SEAGLINT_CHECK(depth > 0, fmt::format("depth {} m", depth));
  const auto by_omega = [](const WaveComponent& a, const WaveComponent& b) { return a.omega < b.omega; };
  SEAGLINT_CHECK(std::is_sorted(components_.begin(), components_.end(), by_omega), "components out of order");
  SEAGLINT_CHECK(disperse(components_, depth), "a wavenumber that is not of this depth");
  long_crested_ = std::all_of(components_.begin(), components_.end(),
                              [&](const WaveComponent& c) { return c.direction == components_.front().direction; });
  if (order_ == 2) {
    const auto end = std::find_if(components_.begin(), components_.end(),
                                  [&](const WaveComponent& c) { return c.omega > second_order_cutoff_rad_s; });
    second_order_count_ = static_cast<std::size_t>(end - components_.begin());
  }
  const bool closed = long_crested_ && std::isinf(depth_);
  if (!closed && second_order_count_ > 0) {
    pairs_ = std::make_shared<PairInteractions>(std::span(components_).first(second_order_count_), depth_);
  }
}

namespace {

// Sums over linear waves of any direction and depth; their kinematics at the mean level (Airy).
struct LinearSums {
  double elevation = 0;
  Vec2 slope = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();  // g k/w along each wave
  double vertical_velocity = 0;
  double lift = 0;            // vertical acceleration
  Vec2 shear = Vec2::Zero();  // d velocity / dz, and the gradient of vertical_velocity

  void add(const WaveComponent& component, double cosine, double sine) {
    const double v_c = component.amplitude * cosine, v_s = component.amplitude * sine;
    const double k = component.wavenumber, w = component.omega;
    elevation += v_c;
    slope += k * v_s * component.direction;
    velocity += kGravity * k / w * v_c * component.direction;
    vertical_velocity -= w * v_s;
    lift -= w * w * v_c;
    shear += k * w * v_c * component.direction;
  }
  LinearSums& operator+=(const LinearSums& other) {
    elevation += other.elevation;
    slope += other.slope;
    velocity += other.velocity;
    vertical_velocity += other.vertical_velocity;
    lift += other.lift;
    shear += other.shear;
    return *this;
  }
};

// Surface quantities from the linear waves and their interactions. Velocity: Taylor expansion from the mean level;
// vertically the kinematic condition w = eta_t + u.grad eta. Acceleration: with constant pressure along the surface,
// a_h = -(g + a_z) grad eta; vertically the material derivative of w.
SurfaceState assemble(const LinearSums& low, const LinearSums& all, const SecondOrder& second, bool motion) {
  SurfaceState state;
  state.elevation_linear = all.elevation;
  state.elevation = all.elevation + second.elevation;
  const Vec2 slope = all.slope + second.slope;
  state.slope_x = slope.x();
  state.slope_y = slope.y();
  if (!motion) return state;
  const Vec2 velocity = all.velocity + low.elevation * low.shear + second.velocity;
  state.velocity = {velocity.x(), velocity.y(),
                    all.vertical_velocity + second.elevation_t + low.velocity.dot(low.slope)};
  const Vec2 acceleration = -kGravity * slope - low.lift * low.slope;
  state.acceleration = {
      acceleration.x(), acceleration.y(),
      all.lift + second.elevation_tt + 2 * low.velocity.dot(low.shear) - kGravity * low.slope.squaredNorm()};
  return state;
}

}  // namespace

SurfaceState WaveField::state(std::span<const double> cosine, std::span<const double> sine,
                              SurfaceQuantities detail) const {
  const bool motion = detail == SurfaceQuantities::kKinematics;
  const std::size_t count = components_.size(), quadratic = second_order_count_;
  if (count == 0) return {};
  SurfaceState state;
  if (!pairs_ && long_crested_ && std::isinf(depth_)) {
    state = long_crested_surface(components_, cosine, sine, quadratic, detail);
  } else {
    LinearSums low, all;  // low: components in the quadratic sums
    for (std::size_t i = 0; i < quadratic; ++i) low.add(components_[i], cosine[i], sine[i]);
    for (std::size_t i = quadratic; i < count; ++i) all.add(components_[i], cosine[i], sine[i]);
    all += low;
    SecondOrder second;
    if (pairs_) {
      std::vector<double> c(quadratic), s(quadratic);
      for (std::size_t i = 0; i < quadratic; ++i) {
        c[i] = components_[i].amplitude * cosine[i];
        s[i] = components_[i].amplitude * sine[i];
      }
      second = pairs_->evaluate(std::span(components_).first(quadratic), c, s, motion);
    }
    state = assemble(low, all, second, motion);
  }
  if (!motion) state.velocity = state.acceleration = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  return state;
}

SurfaceState WaveField::surface(double x, double y, double t, SurfaceQuantities detail) const {
  const std::size_t count = components_.size();
  std::vector<double> angle(count), cosine(count), sine(count);
  for (std::size_t i = 0; i < count; ++i) {
    const WaveComponent& c = components_[i];
    angle[i] = c.omega * t - c.wavenumber * (c.direction.x() * x + c.direction.y() * y) + c.phase;
  }
  // Any angle can be large at a distant point.
  for (double& phase : angle) phase = wrapped_angle(phase);
  unit_phasors(angle, cosine, sine);
  return state(cosine, sine, detail);
}

// 3 E[eta1^2 eta2] = 3 sum_ij e_i e_j min(k_i, k_j) with e = a^2/2 in deep water, since B+ + B- = min(k_i, k_j)/2
// (Marthinsen and Winterstein 1992, ISOPE III, 472); the term i = j of a component of fixed amplitude is half of that.
double WaveField::third_cumulant() const {
  if (pairs_) return pairs_->third_cumulant(std::span(components_).first(second_order_count_));
  double below = 0;  // sum of k_j e_j over j < i
  double third = 0;
  for (std::size_t i = 0; i < second_order_count_; ++i) {
    const WaveComponent& c = components_[i];
    const double e = 0.5 * c.amplitude * c.amplitude;
    third += 3 * e * (2 * below + 0.5 * e * c.wavenumber);
    below += e * c.wavenumber;
  }
  return third;
}

namespace {

UniformPhasors phasors_at(const WaveField& field, double x, double y, double start, double step) {
  std::vector<double> omega, phase;
  for (const WaveComponent& c : field.components()) {
    omega.push_back(c.omega);
    phase.push_back(c.phase - c.wavenumber * (c.direction.x() * x + c.direction.y() * y));
  }
  return UniformPhasors(std::move(omega), std::move(phase), start, step);
}

}  // namespace

SurfaceSeries::SurfaceSeries(const WaveField& field, double x, double y, double start, double step,
                             SurfaceQuantities detail)
    : field_(&field), detail_(detail), phasors_(phasors_at(field, x, y, start, step)) {}

SurfaceSeries SurfaceSeries::along_line(const WaveField& field, const Vec2& start, const Vec2& step, double t,
                                        SurfaceQuantities detail) {
  std::vector<double> rate, phase;
  for (const WaveComponent& c : field.components()) {
    rate.push_back(-c.wavenumber * c.direction.dot(step));
    phase.push_back(wrapped_angle(c.omega * t - c.wavenumber * c.direction.dot(start) + c.phase));
  }
  return {field, UniformPhasors(std::move(rate), std::move(phase), 0, 1), detail};
}

}  // namespace seaglint
