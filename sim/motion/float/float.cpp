// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/float/float.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/motion/float/tether.h"

namespace seaglint {

// The rate's spectrum 1 / (1 + (w tau)^2) has the distribution (2/pi) atan(w tau): harmonic m is drawn from the m-th of
// the intervals of equal probability.
RandomYaw::RandomYaw(double rate, double period, double damping, std::uint64_t seed, std::uint64_t index) {
  if (rate <= 0) return;
  Random random({seed, Stream::kFloatYaw, index});
  if (period <= 0) heading_ = 2 * kPi * (random.uniform() - 0.5);
  double variance = 0;
  for (int m = 0; m < kYawHarmonics; ++m) {
    const double omega = std::tan(0.5 * kPi * (m + random.uniform()) / kYawHarmonics) / kYawCorrelationTime;
    double amplitude = 1;
    if (period > 0) {
      const Oscillator spring{2 * kPi / period, damping, 0};
      amplitude = omega * omega * std::abs(linear_response(spring, omega));
    }
    omega_.push_back(omega);
    phase_.push_back(2 * kPi * random.uniform());
    amplitude_.push_back(amplitude);
    variance += 0.5 * amplitude * amplitude;
  }
  for (double& amplitude : amplitude_) amplitude *= rate / std::sqrt(variance);
  if (period <= 0) heading_ -= at(0).x - heading_;
}

OscillatorState RandomYaw::at(double t) const {
  std::array<double, kYawHarmonics> angle, cosine, sine;
  const std::size_t count = omega_.size();
  for (std::size_t m = 0; m < count; ++m) angle[m] = omega_[m] * t + phase_[m];
  unit_phasors({angle.data(), count}, {cosine.data(), count}, {sine.data(), count});
  OscillatorState yaw{heading_, 0};
  for (std::size_t m = 0; m < count; ++m) {
    yaw.x += amplitude_[m] * sine[m] / omega_[m];
    yaw.rate += amplitude_[m] * cosine[m];
  }
  return yaw;
}

namespace {

// A disc-like float of 1 m: roll and pitch 1.3 s, heave 1.2 s (a section 0.4 m wide has 1.26 s and 1.17 s, NTNU);
// periods scale with the square root of the size (Froude).
constexpr double kTiltPeriod = 1.3;   // s at a diameter of 1 m
constexpr double kHeavePeriod = 1.2;  // s at a diameter of 1 m
constexpr double kTiltDamping = 0.25;
constexpr double kHeaveDamping = 0.3;

// Time constant with which a mooring returns a float to its position, against the wave drift.
constexpr double kMooringTime = 10;  // s

Vec2 rotated(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

}  // namespace

FloatParticulars float_particulars(const MotionSpec& spec, const Bounds& bounds) {
  const Vec3 size = bounds.upper - bounds.lower;
  FloatParticulars body;
  body.diameter = given_or(spec.diameter_m, std::max(size.x(), size.y()));
  if (!(body.diameter > 0)) {
    throw InputError("motion.diameter_m: the mesh has no width to derive a float's diameter from; write it down");
  }
  body.draught = spec.draught_m;
  body.effective_slope = spec.effective_slope;
  const double scale = std::sqrt(body.diameter);
  const auto tilt = [&](double period, double damping) {
    return Oscillator{2 * kPi / given_or(period, kTiltPeriod * scale), given_or(damping, kTiltDamping), 0};
  };
  body.roll = tilt(spec.roll_period_s, spec.roll_damping);
  body.roll.quadratic = spec.roll_quadratic_damping;
  body.pitch = tilt(spec.pitch_period_s, spec.pitch_damping);
  body.heave = {2 * kPi / given_or(spec.heave_period_s, kHeavePeriod * scale),
                given_or(spec.heave_damping, kHeaveDamping), 0};
  return body;
}

double disc_slope_filter(double wavenumber, double radius) {
  // 8 J2(x)/x^2 = sum (-1)^m 2 (x/2)^2m / (m! (m+2)!), for small x; elsewhere the C library's Bessel function.
  const double x = std::abs(wavenumber * radius);
  if (x < 1) {
    const double q = -0.25 * x * x;
    double term = 1, sum = 1;
    for (int m = 1; m < 12; ++m) {
      term *= q / (m * (m + 2));
      sum += term;
    }
    return sum;
  }
  return 8 * ::jn(2, x) / (x * x);  // std::cyl_bessel_j writes a global by lgamma, from several threads
}

Vec2 soft_limited_slope(const Vec2& slope) {
  const double ratio = slope.squaredNorm() / (kBreakingSlope * kBreakingSlope);
  return slope / std::sqrt(std::sqrt(1 + ratio * ratio));
}

namespace {

// Transfer from the surface wave to the forcing of a float: mean over the disc, and pressure decay to its draught,
// e^{-kT} (Smith correction, as for the effective slope of a ship: Jensen, Mansour and Olsen 2004, Ocean Engineering
// 31, 61).
double float_wave_filter(const FloatParticulars& body, double wavenumber) {
  return disc_slope_filter(wavenumber, 0.5 * body.diameter) * std::exp(-wavenumber * body.draught);
}

// State of the water at the float at uniform half steps, at its place or at its displaced position.
class Water {
 public:
  Water(const FloatRequest& request, double start, double step)
      : field_(request.sea.filtered([&](double k) { return float_wave_filter(request.body, k); })),
        place_(request.place),
        velocity_(request.speed_mps, 0),
        start_(start),
        step_(step),
        detail_(request.spec.translations ? SurfaceQuantities::kKinematics : SurfaceQuantities::kElevationAndSlope) {
    if (!request.spec.translations && request.speed_mps == 0)
      series_.emplace(field_, place_.x(), place_.y(), start, step, detail_);
  }
  Water(const Water&) = delete;
  Water& operator=(const Water&) = delete;

  // State at the next half step; `shift`: displacement of a moving float.
  SurfaceState next(const Vec2& shift) {
    if (!series_) {
      const double t = start_ + step_ * static_cast<double>(count_++);
      const Vec2 at = place_ + t * velocity_ + shift;
      return field_.surface(at.x(), at.y(), t, detail_);
    }
    if (count_++ > 0) series_->advance();
    return series_->state();
  }

 private:
  WaveField field_;
  Vec2 place_, velocity_;
  double start_, step_;
  SurfaceQuantities detail_;
  long long count_ = 0;
  std::optional<SurfaceSeries> series_;
};

// Tilt about the axes x and y of T (not rotating with the float), and the displacement of the centre of flotation.
struct FloatState {
  Vec2 tilt = Vec2::Zero();
  Vec2 tilt_rate = Vec2::Zero();
  Vec3 shift = Vec3::Zero();
  double heave_rate = 0;
};

FloatState operator+(const FloatState& a, const FloatState& b) {
  return {a.tilt + b.tilt, a.tilt_rate + b.tilt_rate, a.shift + b.shift, a.heave_rate + b.heave_rate};
}
FloatState operator*(double h, const FloatState& a) {
  return {h * a.tilt, h * a.tilt_rate, h * a.shift, h * a.heave_rate};
}

class Equations {
 public:
  Equations(const FloatParticulars& body, bool moving) : body_(body), moving_(moving) {}

  // Tilt: two oscillators about the yawed axes of the float, forced by r times the slope there (roll = +d eta/dy, pitch
  // = -d eta/dx), x'' + 2 z w0 x' + w0^2 (x - r s) = 0. The water gives the part r of the stiffness, towards the normal
  // of its surface; a mooring gives the part 1 - r, towards the vertical. Heave: stiffness and damping act on the
  // motion relative to the water, z'' + 2 z w0 (z' - w) + w0^2 (z - eta) = 0. Surge and sway: velocity of the water at
  // the float, with the mooring term.
  FloatState derivative(const FloatState& s, const SurfaceState& water, double yaw) const {
    const Vec2 slope = body_.effective_slope * rotated(soft_limited_slope({water.slope_x, water.slope_y}), -yaw);
    const Vec2 target(slope.y(), -slope.x());
    const Vec2 tilt = rotated(s.tilt, -yaw);
    const Vec2 rate = rotated(s.tilt_rate, -yaw);
    const auto acceleration = [](const Oscillator& o, double to, double x, double v) {
      return o.omega0 * o.omega0 * (to - x) - 2 * o.damping * o.omega0 * v - o.quadratic * std::abs(v) * v;
    };
    FloatState d;
    d.tilt = s.tilt_rate;
    d.tilt_rate = rotated({acceleration(body_.roll, target.x(), tilt.x(), rate.x()),
                           acceleration(body_.pitch, target.y(), tilt.y(), rate.y())},
                          yaw);
    if (moving_) {
      const Vec2 horizontal = horizontal_rate(s, water);
      d.shift = {horizontal.x(), horizontal.y(), s.heave_rate};
      const double w0 = body_.heave.omega0;
      d.heave_rate = w0 * w0 * (water.elevation - s.shift.z()) +
                     2 * body_.heave.damping * w0 * (water.velocity.z() - s.heave_rate);
    }
    return d;
  }

  Vec2 horizontal_rate(const FloatState& s, const SurfaceState& water) const {
    return water.velocity.xy() - s.shift.xy() / kMooringTime;
  }

 private:
  const FloatParticulars& body_;
  bool moving_;
};

// The angles of R = Rz(yaw) Ry(pitch) Rx(roll): roll and pitch are the tilt about the yawed axes.
MotionSample sample_of(const FloatState& s, const Vec2& horizontal_rate, const OscillatorState& yaw, bool moving) {
  const Vec2 tilt = rotated(s.tilt, -yaw.x);
  const Vec2 rate = rotated(s.tilt_rate, -yaw.x) + yaw.rate * Vec2(tilt.y(), -tilt.x());
  MotionSample sample;
  sample.angles = {tilt.x(), tilt.y(), yaw.x};
  sample.angle_rates = {rate.x(), rate.y(), yaw.rate};
  if (moving) {
    sample.translation = s.shift;
    sample.translation_rates = {horizontal_rate.x(), horizontal_rate.y(), s.heave_rate};
  }
  return sample;
}

// A float from the start of its motion, step by step.
class FloatMotion {
 public:
  FloatMotion(const FloatRequest& request, double start, double step)
      : place_(request.place),
        moving_(request.spec.translations),
        start_(start),
        step_(step),
        yaw_(radians(request.spec.yaw_rate_std_deg_s), request.spec.yaw_period_s, request.spec.yaw_damping,
             request.seed, request.index),
        equations_(request.body, moving_),
        water_(request, start, 0.5 * step),
        water0_(water_.next(Vec2::Zero())),
        yaw0_(yaw_.at(start)) {
    state_.shift.z() = moving_ ? water0_.elevation : 0;
  }

  // Horizontal velocity of a free float relative to its place, and position.
  Vec2 velocity() const { return moving_ ? equations_.horizontal_rate(state_, water0_) : Vec2::Zero(); }
  Vec2 position() const { return place_ + state_.shift.xy(); }
  void move_by(const Vec2& displacement) { state_.shift += Vec3(displacement.x(), displacement.y(), 0); }

  MotionSample sample(const Vec2& velocity) const { return sample_of(state_, velocity, yaw0_, moving_); }

  // One step. The water is evaluated at the position that `velocity` predicts to first order in the step: error below
  // 1 mm.
  void advance(const Vec2& velocity) {
    const double h = step_, t = start_ + h * static_cast<double>(steps_++);
    const SurfaceState water_middle = water_.next(state_.shift.xy() + 0.5 * h * velocity);
    const SurfaceState water1 = water_.next(state_.shift.xy() + h * velocity);
    const double yaw_middle = yaw_.at(t + 0.5 * h).x;
    const OscillatorState yaw1 = yaw_.at(t + h);

    const FloatState k1 = equations_.derivative(state_, water0_, yaw0_.x);
    const FloatState k2 = equations_.derivative(state_ + 0.5 * h * k1, water_middle, yaw_middle);
    const FloatState k3 = equations_.derivative(state_ + 0.5 * h * k2, water_middle, yaw_middle);
    const FloatState k4 = equations_.derivative(state_ + h * k3, water1, yaw1.x);
    state_ = state_ + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    water0_ = water1;
    yaw0_ = yaw1;
  }

 private:
  Vec2 place_;
  bool moving_;
  double start_, step_;
  long long steps_ = 0;
  RandomYaw yaw_;
  Equations equations_;
  Water water_;
  SurfaceState water0_;
  OscillatorState yaw0_;
  FloatState state_;
};

// Steps of integration per sample.
long parts_of(const FloatParticulars& body, double step) {
  const double fastest = std::max({body.roll.omega0, body.pitch.omega0, body.heave.omega0});
  return std::max(1L, static_cast<long>(std::ceil(fastest * step / kLongestTurn)));
}

// rope_m: of the ropes between neighbours; infinite: free floats.
std::vector<std::vector<MotionSample>> simulate_line(std::span<const FloatRequest> line, double rope_m,
                                                     double duration_s) {
  const MotionSpec& spec = line.front().spec;
  const double step = spec.step_s;
  const auto before = static_cast<long>(std::ceil(spec.spin_up_s / step));
  const auto after = std::max(1L, static_cast<long>(std::ceil(duration_s / step)));
  long parts = 1;
  for (const FloatRequest& one : line) parts = std::max(parts, parts_of(one.body, step));
  const double part = step / static_cast<double>(parts);

  std::deque<FloatMotion> floats;
  for (const FloatRequest& one : line) floats.emplace_back(one, -step * static_cast<double>(before), part);
  const bool has_ropes = std::isfinite(rope_m);
  const auto positions = [&] {
    std::vector<Vec2> all;
    for (const FloatMotion& one : floats) all.push_back(one.position());
    return all;
  };
  const auto hold = [&] {
    if (!has_ropes) return;
    const std::vector<Vec2> free = positions();
    std::vector<Vec2> held = free;
    hold_places(held, rope_m);
    for (std::size_t i = 0; i < floats.size(); ++i)
      if (held[i] != free[i]) floats[i].move_by(held[i] - free[i]);
  };
  const auto velocities = [&] {
    std::vector<Vec2> all;
    for (const FloatMotion& one : floats) all.push_back(one.velocity());
    if (has_ropes) hold_velocities(positions(), rope_m, all);
    return all;
  };

  std::vector<std::vector<MotionSample>> samples(floats.size());
  for (auto& of_one : samples) of_one.reserve(static_cast<std::size_t>(after) + 1);
  hold();
  for (long n = -before;; ++n) {
    std::vector<Vec2> velocity = velocities();
    for (std::size_t i = 0; i < floats.size() && n >= 0; ++i) samples[i].push_back(floats[i].sample(velocity[i]));
    if (n == after) return samples;
    for (long p = 0; p < parts; ++p) {
      if (p > 0) velocity = velocities();
      for (std::size_t i = 0; i < floats.size(); ++i) floats[i].advance(velocity[i]);
      hold();
    }
  }
}

}  // namespace

std::vector<MotionSample> simulate_float(const FloatRequest& request, double duration_s) {
  return std::move(simulate_line({&request, 1}, std::numeric_limits<double>::infinity(), duration_s).front());
}

std::vector<std::vector<MotionSample>> simulate_tethered_floats(std::span<const FloatRequest> line, double rope_m,
                                                                double duration_s) {
  SEAGLINT_CHECK(!line.empty() && line.front().spec.translations && rope_m > 0, fmt::format("rope of {} m", rope_m));
  return simulate_line(line, rope_m, duration_s);
}

}  // namespace seaglint
