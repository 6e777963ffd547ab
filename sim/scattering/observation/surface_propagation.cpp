// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/surface_propagation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/reproducible_functions.h"
#include "sim/core/process/error.h"
#include "sim/scattering/coefficients/amplitude_laws.h"
#include "sim/scattering/observation/look_directions.h"

namespace seaglint {

namespace {

constexpr Complex kImaginary{0, 1};
const Complex kRootOfJ = std::polar(1.0, kPi / 4);
constexpr std::size_t kFineSteps = 24, kFineParts = 16;  // steps in front of the body, and the parts of each
constexpr double kLowestPoint = 3;                       // height above the surface, wavelengths

// erfc(sqrt(j) y) of real y, by the transition function F(y^2) = sqrt(j pi) y e^{j y^2} erfc(sqrt(j) y) for y > 0.
Complex rotated_erfc(double y) {
  if (y < 0) return 2.0 - rotated_erfc(-y);
  if (y < 1e-3) return 1.0 - 2 / std::sqrt(kPi) * kRootOfJ * y * (1.0 - kImaginary * (y * y / 3));
  return transition_function(y * y) * std::polar(1.0, -y * y) / (kRootOfJ * std::sqrt(kPi) * y);
}

// Integrals over x from X to infinity of e^{-j k (s^2 x + z^2 / x) / 2} times x^{-1/2}, and of the same times z
// x^{-3/2}: the field of a half-plane of sources of constant amplitude.
struct HalfPlaneIntegrals {
  Complex even, odd;
};

HalfPlaneIntegrals half_plane_integrals(double k, double s, double z, double X) {
  const double root = std::sqrt(0.5 * k), incident = s * std::sqrt(X), height = std::abs(z) / std::sqrt(X);
  const Complex near = std::polar(1.0, -k * s * std::abs(z)) * rotated_erfc(root * (incident - height));
  const Complex far = std::polar(1.0, k * s * std::abs(z)) * rotated_erfc(root * (incident + height));
  const Complex scale = 0.5 * std::sqrt(kPi) / (kRootOfJ * root);
  return {scale / s * (near + far), std::copysign(1.0, z) * scale * (near - far)};
}

}  // namespace

void SurfaceField::Sources::append(const Complex& p, const Complex& q) {
  p_re.push_back(p.real());
  p_im.push_back(p.imag());
  q_re.push_back(q.real());
  q_im.push_back(q.imag());
}

SurfaceField::SurfaceField(SurfaceProfile profile, double k, double sin_grazing, const SeaReflection& ripples,
                           const SeaReflectionCoefficients& mean_plane)
    : k_(k), sin_grazing_(sin_grazing), mean_plane_(mean_plane), whole_{std::move(profile), {}, {}} {
  SEAGLINT_CHECK(sin_grazing > 0 && sin_grazing < 0.25, fmt::format("sine of grazing angle {}", sin_grazing));
  const std::vector<double>&h = whole_.profile.elevation_m, &slope = whole_.profile.slope;
  const std::size_t count = h.size();
  SEAGLINT_CHECK(count > kFineSteps && slope.size() == count && h[0] == 0 && slope[0] == 0,
                 fmt::format("{} samples", count));
  excess_ = sin_grazing * sin_grazing / (1 + std::sqrt(1 - sin_grazing * sin_grazing));
  // Product integration (trapezoidal): the singular factor 1/sqrt(x) is integrated exactly over linear functions.
  for (std::size_t m = 0; m < std::max(count, kFineSteps * kFineParts + 1); ++m) {
    const auto d = static_cast<double>(m);
    const double below = d > 1 ? (d - 1) * std::sqrt(d - 1) : 0, here = d * std::sqrt(d);
    const double above = (d + 1) * std::sqrt(d + 1);
    weight_.push_back(m == 0 ? 4.0 / 3 : 4.0 / 3 * (above - 2 * here + below));
    first_weight_.push_back(m == 0 ? 0 : 4.0 / 3 * (below - here + 1.5 * std::sqrt(d)));
  }
  whole_.h.append(sin_grazing * (1.0 - mean_plane.h), 1.0 + mean_plane.h);
  whole_.v.append(sin_grazing * (1.0 - mean_plane.v), 1.0 + mean_plane.v);
  const Complex self = std::sqrt(k * whole_.profile.step_m / (8 * kPi)) * kRootOfJ * weight_[0];
  for (std::size_t i = 1; i < count; ++i) {
    const SeaReflectionCoefficients before = incident(i, h[i]), scattered = integral(whole_, i, 1, h[i], false);
    const double local = std::clamp(sin_grazing + slope[i], sin_grazing, 1.0);
    const double stretch = std::sqrt(1 + slope[i] * slope[i]);
    const SeaReflectionCoefficients rho = ripples.at(k, local);
    // u / 2 + self p = field of the samples before, p / u = stretch s (1 - rho) / (1 + rho).
    const auto solve = [&](Sources& sources, const Complex& arriving, const Complex& reflection) {
      const Complex u = 1.0 + reflection, p = stretch * local * (1.0 - reflection);
      const Complex amplitude = arriving / (0.5 * u + self * p);
      sources.append(p * amplitude, u * amplitude);
    };
    solve(whole_.h, before.h - scattered.h, rho.h);
    solve(whole_.v, before.v - scattered.v, rho.v);
  }
  // The end of the profile: cubic elevation, linear sources.
  fine_.profile.step_m = whole_.profile.step_m / static_cast<double>(kFineParts);
  for (std::size_t n = 0; n <= kFineSteps * kFineParts; ++n) {
    const std::size_t i = std::min(count - 1 - kFineSteps + n / kFineParts, count - 2);
    const double f = static_cast<double>(n - (i - (count - 1 - kFineSteps)) * kFineParts) / kFineParts, g = 1 - f;
    const double step = whole_.profile.step_m;
    fine_.profile.elevation_m.push_back(g * g * (1 + 2 * f) * h[i] + f * f * (1 + 2 * g) * h[i + 1] +
                                        f * g * step * (g * slope[i] - f * slope[i + 1]));
    fine_.profile.slope.push_back(g * slope[i] + f * slope[i + 1]);
    for (auto [to, from] : {std::pair(&fine_.h, &whole_.h), std::pair(&fine_.v, &whole_.v)})
      to->append(g * from->p(i) + f * from->p(i + 1), g * from->q(i) + f * from->q(i + 1));
  }
}

SeaReflectionCoefficients SurfaceField::integral(const Stretch& stretch, std::size_t end, std::size_t gap,
                                                 double height_m, bool limited) const {
  constexpr std::size_t kBlock = 256;
  std::array<double, kBlock> amplitude, normal, phase, cosine, sine;
  const SurfaceProfile& profile = stretch.profile;
  const double inverse_step = 1 / profile.step_m, phase_step = k_ * profile.step_m;
  SeaReflectionCoefficients total{0, 0};
  for (std::size_t first = 0; first < end; first += kBlock) {
    const std::size_t count = std::min(kBlock, end - first), distance = end - 1 - first + gap;
    // Series in the slope a of the ray: r - x = x (a^2/2 - a^4/8 + ...), (x/r)^(1/2) and x/r.
    const double *elevation = profile.elevation_m.data() + first, *slope = profile.slope.data() + first;
    for (std::size_t n = 0; n < count; ++n) {
      const auto steps = static_cast<double>(distance - n);
      const double a = (height_m - elevation[n]) * inverse_step / steps, a2 = a * a;
      phase[n] = phase_step * steps * (excess_ + a2 * (0.5 - a2 * (0.125 - a2 * (0.0625 - a2 * 0.0390625))));
      amplitude[n] = weight_[distance - n] * (1 - a2 * (0.25 - a2 * (0.15625 - a2 * 0.1171875)));
      normal[n] = (a - slope[n]) * (1 - a2 * (0.5 - a2 * (0.375 - a2 * 0.3125)));
    }
    if (limited) {
      for (std::size_t n = 0; n < count; ++n) {
        const double x = static_cast<double>(distance - n) * profile.step_m;
        const double taper = smooth_taper(std::abs(height_m - elevation[n]) / x, kSteepestRay);
        amplitude[n] *= taper;
        if (taper == 0) phase[n] = normal[n] = 0;
      }
    }
    if (first == 0) amplitude[0] *= first_weight_[distance] / weight_[distance];
    if (gap > 1 && first + count == end) amplitude[count - 1] *= 1 - first_weight_[gap] / weight_[gap];
    unit_phasors(std::span(phase).first(count), std::span(cosine).first(count), std::span(sine).first(count));
    const auto sum = [&](const Sources& from) {
      const double *p_re = from.p_re.data() + first, *p_im = from.p_im.data() + first;
      const double *q_re = from.q_re.data() + first, *q_im = from.q_im.data() + first;
      double re = 0, im = 0;
      for (std::size_t n = 0; n < count; ++n) {
        const double a = p_re[n] - normal[n] * q_re[n], b = p_im[n] - normal[n] * q_im[n];
        re += amplitude[n] * (a * cosine[n] + b * sine[n]);
        im += amplitude[n] * (b * cosine[n] - a * sine[n]);
      }
      return Complex{re, im};
    };
    total.h += sum(stretch.h);
    total.v += sum(stretch.v);
  }
  const Complex scale = std::sqrt(k_ * profile.step_m / (8 * kPi)) * kRootOfJ;
  return {scale * total.h, scale * total.v};
}

SeaReflectionCoefficients SurfaceField::incident(std::size_t i, double height_m) const {
  const HalfPlaneIntegrals plane =
      half_plane_integrals(k_, sin_grazing_, height_m, static_cast<double>(i) * whole_.profile.step_m);
  const Complex scale = std::sqrt(k_ / (8 * kPi)) * kRootOfJ;
  const auto of = [&](const Complex& rho) {
    return std::polar(1.0, k_ * sin_grazing_ * height_m) -
           scale * (sin_grazing_ * (1.0 - rho) * plane.even - (1.0 + rho) * plane.odd);
  };
  return {of(mean_plane_.h), of(mean_plane_.v)};
}

SeaReflectionCoefficients SurfaceField::above_surface(double height_m) const {
  const std::size_t last = whole_.profile.elevation_m.size() - 1, joint = last - kFineSteps;
  const SeaReflectionCoefficients arriving = incident(last, height_m),
                                  far = integral(whole_, joint + 1, kFineSteps, height_m, true),
                                  near = integral(fine_, kFineSteps * kFineParts, 1, height_m, true);
  return {arriving.h - far.h - near.h, arriving.v - far.v - near.v};
}

SeaReflectionCoefficients SurfaceField::at(double height_m) const {
  const double surface_m = whole_.profile.elevation_m.back(), above_m = height_m - surface_m;
  if (above_m <= 0) return {0, 0};
  // Near the surface, where the rays to a point are too steep, the field is quadratic in the height, with value and
  // vertical derivative of the sources, du/dz = jk (p - cos(grazing) h' u).
  const double lowest_m = 2 * kPi * kLowestPoint / k_;
  if (above_m >= lowest_m) return above_surface(height_m);
  const SeaReflectionCoefficients over = above_surface(surface_m + lowest_m);
  const std::size_t last = whole_.profile.elevation_m.size() - 1;
  const double slope = (1 - excess_) * whole_.profile.slope[last], fraction = above_m / lowest_m;
  const auto near = [&](const Sources& sources, const Complex& upper) {
    const Complex u = sources.q(last), rise = kImaginary * (k_ * lowest_m) * (sources.p(last) - slope * u);
    return u + fraction * (rise + fraction * (upper - u - rise));
  };
  return {near(whole_.h, over.h), near(whole_.v, over.v)};
}

double profile_length_m(double significant_wave_height_m, double top_m, double sin_grazing) {
  constexpr double kMargin_m = 50, kShadows = 1.5;
  return std::clamp(kMargin_m + kShadows * (significant_wave_height_m + std::max(top_m, 0.0)) / sin_grazing, 100.0,
                    600.0);
}

double profile_step_m(double k) { return std::min(0.2, 12 * kPi / k); }

namespace {

// Profiles of the waves below a body, with the roughness that they do not resolve.
class ProfileSource {
 public:
  ProfileSource(const SeaReflection& sea, double step_m) : waves_(*sea.waves()), step_m_(step_m) {
    // Waves shorter than four steps are roughness. The pairs of a directional sea would cost the square of its
    // components at every point: its profile is of first order.
    const double shortest = 2 * kPi / (4 * step_m);
    double variance = waves_.rms_above_cutoff_m * waves_.rms_above_cutoff_m;
    for (const WaveComponent& c : waves_.field->components())
      if (c.wavenumber > shortest) variance += 0.5 * c.amplitude * c.amplitude;
    rms_m_ = std::sqrt(variance);
    const bool closed = waves_.field->long_crested() && std::isinf(waves_.field->depth());
    const WaveField field = closed ? *waves_.field : WaveField(waves_.field->components(), 1, 0, waves_.field->depth());
    field_ = field.filtered([&](double wavenumber) { return wavenumber > shortest ? 0.0 : 1.0; });
  }

  double rms_m() const { return rms_m_; }

  // Towards a body at p of the target frame; to_radar: horizontal unit vector.
  SurfaceProfile at(double time_s, const Vec3& p, const Vec2& to_radar, double length_m) const {
    const auto steps = static_cast<std::size_t>(std::ceil(length_m / step_m_));
    const Vec3 body = p + waves_.origin_m + time_s * waves_.velocity_mps;
    const double far_m = static_cast<double>(steps) * step_m_;
    SurfaceSeries line = SurfaceSeries::along_line(field_, Vec2(body.x(), body.y()) + far_m * to_radar,
                                                   -step_m_ * to_radar, time_s, SurfaceQuantities::kElevationAndSlope);
    SurfaceProfile profile{step_m_, {}, {}};
    const double rise_m = std::min(30.0, 0.25 * far_m);  // the waves grow from the mean plane
    for (std::size_t i = 0; i <= steps; ++i, line.advance()) {
      const SurfaceState water = line.state();
      const double x = static_cast<double>(i) * step_m_ / rise_m;
      const double gain = 1 - smooth_taper(x, {0, 1}), rate = x < 1 ? 6 * x * (1 - x) / rise_m : 0;
      const double along = -(water.slope_x * to_radar.x() + water.slope_y * to_radar.y());
      profile.elevation_m.push_back(gain * water.elevation);
      profile.slope.push_back(gain * along + rate * water.elevation);
    }
    return profile;
  }

 private:
  WavesBelow waves_;
  double step_m_, rms_m_ = 0;
  WaveField field_;
};

// Amplitudes of both waves from the fields at z - d and z + d.
OneWayPaths fitted(const SurfaceField& field, double k, double sin_grazing, double z, double d) {
  const SeaReflectionCoefficients low = field.at(z - d), high = field.at(z + d);
  const double turn = k * sin_grazing * d;
  const Complex direct = std::polar(1.0, -k * sin_grazing * z), image = std::conj(direct);
  const Complex half = std::polar(1.0, turn), scale = 1.0 / (2.0 * kImaginary * std::sin(2 * turn));
  const auto up = [&](const Complex& a, const Complex& b) { return direct * (half * b - std::conj(half) * a) * scale; };
  const auto down = [&](const Complex& a, const Complex& b) {
    return image * (half * a - std::conj(half) * b) * scale;
  };
  return {{up(low.h, high.h), up(low.v, high.v)}, {down(low.h, high.h), down(low.v, high.v)}};
}

}  // namespace

OneWayAmplitudes::Place OneWayAmplitudes::place_of(const std::vector<double>& nodes, double x) {
  const std::size_t stencil = std::min<std::size_t>(4, nodes.size());
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(nodes, x) - nodes.begin());
  Place place{std::min(above > 2 ? above - 2 : 0, nodes.size() - stencil), std::vector<double>(stencil, 1.0)};
  for (std::size_t i = 0; i < stencil; ++i)
    for (std::size_t j = 0; j < stencil; ++j)
      if (j != i) place.weights[i] *= (x - nodes[place.first + j]) / (nodes[place.first + i] - nodes[place.first + j]);
  return place;
}

OneWayAmplitudes::OneWayAmplitudes(const SeaReflection& sea, const BodyOverWaves& body,
                                   const IntervalSampling& sampling, const Vec3& r_hat, int threads,
                                   const StopFlag* stop) {
  SEAGLINT_CHECK(sea.waves() != nullptr && sea.waves()->field != nullptr, "no waves");
  // Nodes: uniform in time, or the pulses where these are fewer.
  const std::vector<double>& pulse_s = sampling.pulse_time_s;
  const double duration_s = pulse_s.back() - pulse_s.front();
  const auto intervals = static_cast<std::size_t>(std::ceil(duration_s / kNodeInterval_s));
  std::vector<double> node_s = pulse_s;
  if (pulse_s.size() > intervals + 1) {
    node_s.clear();
    for (std::size_t i = 0; i <= intervals; ++i)
      node_s.push_back(pulse_s.front() +
                       duration_s * static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(1, intervals)));
  }
  for (const double time_s : pulse_s) in_time_.push_back(place_of(node_s, time_s));
  const double band_hz = sampling.step_hz * (sampling.count - 1);
  frequencies_ = 1 + static_cast<std::size_t>(std::ceil(band_hz / kNodeInterval_hz));
  std::vector<double> node_hz;
  for (std::size_t f = 0; f < frequencies_; ++f)
    node_hz.push_back(
        sampling.first_hz +
        (frequencies_ > 1 ? band_hz * static_cast<double>(f) / static_cast<double>(frequencies_ - 1) : 0));
  pulse_first_ = sampling.pulse_first;
  for (int q = 0; q < sampling.count; ++q)
    in_band_.push_back(place_of(node_hz, sampling.first_hz + q * sampling.step_hz));

  constexpr double kToWavenumber = 2 * kPi / kSpeedOfLight;
  const ProfileSource source(sea, profile_step_m(kToWavenumber * node_hz.back()));
  const SeaReflection ripples = sea.with_rms_height(source.rms_m());
  // The interference over height z has the phase k (|x - image| - |x - radar|) = 2 k z sin(grazing), grazing the angle
  // of the radar above the plane: half of the difference of both directions.
  const auto sight_at = [&](double time_s) {
    return line_of_sight_from(line_of_sight_at(sampling, r_hat, time_s), body.centre(time_s), body.range_m);
  };
  const auto sine_of = [](const LineOfSight& sight) { return 0.5 * (sight.radar.r.z() - sight.image.r.z()); };
  // One length for the interval: the start of the profile follows the body without heaving with it.
  double length_m = 0;
  for (const double time_s : node_s)
    length_m += profile_length_m(sea.significant_wave_height_m(), body.centre(time_s).z() + body.half_height_m,
                                 sine_of(sight_at(time_s))) /
                static_cast<double>(node_s.size());
  nodes_.resize(node_s.size() * frequencies_);
  parallel_for(
      nodes_.size(), std::max(1, threads),
      [&](std::size_t node) {
        const double time_s = node_s[node / frequencies_], k = kToWavenumber * node_hz[node % frequencies_];
        const LineOfSight sight = sight_at(time_s);
        const Vec3 p = body.centre(time_s), r = sight.radar.r;
        const double sin_grazing = sine_of(sight), level = std::hypot(r.x(), r.y());
        const SeaReflectionCoefficients mean_plane = sea.at(k, sin_grazing);
        // Two heights, each at most a quarter of a period of the interference from the centre.
        const double half_m = std::min(std::max(0.5 * body.half_height_m, kLeastFit_m), kPi / (4 * k * sin_grazing));
        const SurfaceField field(source.at(time_s, p, Vec2(r.x(), r.y()) / level, length_m), k, sin_grazing, ripples,
                                 mean_plane);
        nodes_[node] = fitted(field, k, sin_grazing, p.z(), half_m);
      },
      stop);
}

OneWayPaths OneWayAmplitudes::at(int pulse, int b) const {
  const auto n = static_cast<std::size_t>(pulse);
  const Place &in_time = in_time_[n], &in_band = in_band_[static_cast<std::size_t>(pulse_first_[n] + b)];
  OneWayPaths sum{{0, 0}, {0, 0}};
  const auto add = [](SeaReflectionCoefficients& to, double weight, const SeaReflectionCoefficients& from) {
    to.h += weight * from.h;
    to.v += weight * from.v;
  };
  for (std::size_t t = 0; t < in_time.weights.size(); ++t) {
    for (std::size_t f = 0; f < in_band.weights.size(); ++f) {
      const OneWayPaths& node = nodes_[(in_time.first + t) * frequencies_ + in_band.first + f];
      const double weight = in_time.weights[t] * in_band.weights[f];
      add(sum.direct, weight, node.direct);
      add(sum.image, weight, node.image);
    }
  }
  return sum;
}

}  // namespace seaglint
