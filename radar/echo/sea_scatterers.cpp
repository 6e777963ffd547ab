// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_scatterers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "radar/echo/speckle.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/sea/wave_field.h"

namespace seaglint {

double gamma_texture(double shape, double normal) {
  SEAGLINT_CHECK(shape >= 0.1 && shape <= 1000, fmt::format("shape = {}", shape));
  return gamma_of_normal(shape, normal) / shape;
}

std::vector<double> ring_field(int cells, double correlation_cells, double correlation_time_s, double time_s,
                               std::uint64_t seed) {
  // White on the ring, correlated in time. Each node has its own key, so that any time can be evaluated independently;
  // nodes before t = 0 have negative indices.
  const Kernel in_time = kernel_at(time_s / correlation_time_s);
  std::vector<double> white(cells);
  for (std::size_t i = 0; i < in_time.weight.size(); ++i) {
    const auto node = static_cast<std::int64_t>(in_time.first) + static_cast<std::int64_t>(i);
    Random random({seed, Stream::kTexture, static_cast<std::uint64_t>(node)});
    for (double& value : white) value += in_time.weight[i] * random.normal();
  }
  // The kernel e^{-d^2/l^2} folded onto the ring.
  const int half_width = static_cast<int>(std::ceil(kKernelReach * correlation_cells));
  std::vector<double> kernel(std::min(cells, 2 * half_width + 1));
  for (int d = -half_width; d <= half_width; ++d) {
    const double x = d / correlation_cells;
    kernel[(d + static_cast<long>(half_width)) % static_cast<long>(kernel.size())] += std::exp(-x * x);
  }
  double power = 0;
  for (const double w : kernel) power += w * w;
  std::vector<double> field(cells);
  for (int k = 0; k < cells; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < kernel.size(); ++i) sum += kernel[i] * white[(k + i) % cells];
    field[k] = sum / std::sqrt(power);
  }
  return field;
}

int place_of(int k, int count) { return k < (count + 1) / 2 ? k : k - count; }

namespace {

constexpr double kLongWaves_rad_s = 2.5;  // waves that modulate: longer than 10 m, as scatterers' patches are shorter
constexpr double kTiltExponent = 2.6;     // sigma0 ~ sin^p(grazing), vv of nrl_db
const double kLead_rad = radians(25);     // power before elevation
constexpr double kBoundPart = 0.81;       // of the variance of the normal score of power that waves can explain
constexpr double kBreakingSlope = 0.06;   // rms slope of waves that break everywhere
constexpr double kWidthOfPower = 0.85;    // correlation of the logarithm of width with the normal score of power
constexpr double kExcess = 2;             // of velocity over that of width, vv
constexpr double kSpikePart = 0.3;        // of the variance of n, polarisations other than vv
constexpr double kSpikeTime_s = 0.2;
constexpr double kLongestStep_s = 0.1;

// Second derivative of log gamma, by its recurrence and asymptotic series (Abramowitz and Stegun 6.4.12); error 1e-9.
double trigamma(double x) {
  double sum = 0;
  for (; x < 10; ++x) sum += 1 / (x * x);
  const double y = 1 / (x * x);
  return sum + 1 / x + y / 2 + y / x * (1.0 / 6 - y * (1.0 / 30 - y * (1.0 / 42 - y / 30)));
}

// Horizontal directions of a line of sight.
struct LineOfSight {
  explicit LineOfSight(const ClutterScene& scene)
      : cos_grazing(std::hypot(scene.r_hat.x(), scene.r_hat.y())),
        away(-Vec2(scene.r_hat.x(), scene.r_hat.y()) / cos_grazing),
        across(-away.y(), away.x()) {}
  double cos_grazing;
  Vec2 away, across;
};

// The long waves of a scene, linear.
WaveField long_waves(const WaveField& waves) {
  std::vector<WaveComponent> components;
  for (const WaveComponent& wave : waves.components())
    if (wave.omega < kLongWaves_rad_s) components.push_back(wave);
  return {components, 1, 0, waves.depth()};
}

// Elevation and facing slope of the waves in units of their deviations, as one Gaussian field of variance 1.
struct NormalisedWaves {
  NormalisedWaves(const WaveField& all, const LineOfSight& sight) : waves(long_waves(all)), away(sight.away) {
    double elevation_2 = 0, slope_2 = 0;
    for (const WaveComponent& wave : waves.components()) {
      const double slope = wave.wavenumber * wave.direction.dot(away);
      elevation_2 += wave.amplitude * wave.amplitude / 2;
      slope_2 += wave.amplitude * wave.amplitude / 2 * slope * slope;
    }
    slope_deviation = std::sqrt(slope_2);
    if (!(slope_deviation > 0)) return;
    of_elevation = std::cos(kLead_rad) / std::sqrt(elevation_2);
    of_slope = std::sin(kLead_rad) / slope_deviation;
  }
  double at(const Vec2& place, double time_s) const {
    const SurfaceState state = waves.surface(place.x(), place.y(), time_s, SurfaceQuantities::kElevationAndSlope);
    return of_elevation * state.elevation + of_slope * away.dot(Vec2(state.slope_x, state.slope_y));
  }
  WaveField waves;
  Vec2 away;
  double slope_deviation = 0, of_elevation = 0, of_slope = 0;
};

// Squared Hermite coefficients of the gamma texture of a shape: two textures whose normal scores have correlation c
// have the covariance sum over k of a_k^2 c^k (Mehler's formula). Orders above the last count as the last.
using HermiteSquares = std::array<double, 25>;  // [k - 1]

HermiteSquares hermite_squares(double shape) {
  std::array<double, 26> a{};
  constexpr double kStep = 1.0 / 16, kEnd = 8;
  for (double x = -kEnd; x <= kEnd; x += kStep) {
    const double weight = gamma_texture(shape, x) * std::exp(-x * x / 2) * kStep / std::sqrt(2 * kPi);
    double before = 0, polynomial = 1;  // He_k / sqrt(k!)
    for (std::size_t k = 0; k < a.size(); ++k) {
      a[k] += weight * polynomial;
      const double next = (x * polynomial - std::sqrt(static_cast<double>(k)) * before) / std::sqrt(k + 1.0);
      before = polynomial;
      polynomial = next;
    }
  }
  HermiteSquares squares;
  double sum = 0;
  for (std::size_t k = 0; k < squares.size(); ++k) sum += squares[k] = a[k + 1] * a[k + 1];
  squares.back() += std::max(0.0, 1 / shape - sum);
  return squares;
}

// Shapes of scatterers among which the one of a cell's shape is interpolated, with their coefficients.
constexpr int kShapes = 33;
double shape_of(int i) { return 0.1 * std::pow(1e4, i / (kShapes - 1.0)); }
const std::array<HermiteSquares, kShapes>& hermite_table() {
  static const std::array<HermiteSquares, kShapes> table = [] {
    std::array<HermiteSquares, kShapes> all;
    for (int i = 0; i < kShapes; ++i) all[i] = hermite_squares(shape_of(i));
    return all;
  }();
  return table;
}

// Sum over pairs of scatterers that are 0, 1, .. steps apart of the products of their weights in the power of a range
// cell; weights: squared magnitude of the point response with Hann's taper over the band, sum 1.
std::vector<double> pair_weights(int scatterers_per_cell) {
  const auto sinc = [](double x) { return x == 0 ? 1 : std::sin(kPi * x) / (kPi * x); };
  std::vector<double> weights;
  double sum = 0;
  for (int i = -2 * scatterers_per_cell; i <= 2 * scatterers_per_cell; ++i) {
    const double x = static_cast<double>(i) / scatterers_per_cell;
    const double amplitude = sinc(x) + 0.5 * (sinc(x - 1) + sinc(x + 1));
    weights.push_back(amplitude * amplitude);
    sum += weights.back();
  }
  std::vector<double> pairs(weights.size());
  for (std::size_t step = 0; step < weights.size(); ++step)
    for (std::size_t i = 0; i + step < weights.size(); ++i)
      pairs[step] += (step == 0 ? 1 : 2) * weights[i] * weights[i + step] / (sum * sum);
  return pairs;
}

double rho_2(double tilt_log_deviation, double shape) {
  return std::min(kBoundPart, tilt_log_deviation * tilt_log_deviation / trigamma(shape));
}

}  // namespace

WaveModulation wave_modulation(const TextureParameters& texture, const ClutterScene& scene, int scatterers_per_cell,
                               double range_cell_m) {
  const LineOfSight sight(scene);
  const NormalisedWaves waves(*scene.waves, sight);
  WaveModulation modulation;
  if (waves.slope_deviation > 0) {
    const double tangent = scene.r_hat.z() / sight.cos_grazing, x = tangent / waves.slope_deviation;
    const double illuminated = tangent * 0.5 * std::erfc(-x / std::sqrt(2.0)) +
                               waves.slope_deviation * std::exp(-x * x / 2) / std::sqrt(2 * kPi);
    modulation.tilt_log_deviation = kTiltExponent * waves.slope_deviation / illuminated;
    modulation.breaking = std::min(1.0, waves.slope_deviation / kBreakingSlope);
  }

  // Correlations of pairs of scatterers 0, 1, .. steps apart in range: of the waves, E cos(k . d) over the beam with
  // the difference of two normal places across it, and of the field apart from them.
  const std::vector<double> pairs = pair_weights(scatterers_per_cell);
  const double across_m = scene.radar.range_km * 1e3 * beam_deviation_rad(scene.radar);
  std::vector<double> of_waves, apart;
  for (std::size_t step = 0; step < pairs.size(); ++step) {
    const double distance_m = static_cast<double>(step) * range_cell_m / scatterers_per_cell;
    double sum = 0;
    for (const WaveComponent& wave : waves.waves.components()) {
      const double along = wave.wavenumber * wave.direction.dot(sight.away),
                   sideways = wave.wavenumber * wave.direction.dot(sight.across) * across_m;
      const double elevation = waves.of_elevation * wave.amplitude, slope = waves.of_slope * wave.amplitude * along;
      sum += 0.5 * (elevation * elevation + slope * slope) * std::cos(along * distance_m / sight.cos_grazing) *
             std::exp(-sideways * sideways);
    }
    const double x = distance_m / (texture.correlation_cells * range_cell_m);
    of_waves.push_back(sum);
    apart.push_back(std::exp(-x * x / 2));
  }

  // Variance of a cell's power over its mean squared for each shape of the table; the wanted one is 1 / shape.
  const auto cell_variance = [&](int i) {
    const HermiteSquares& squares = hermite_table()[i];
    const double part = rho_2(modulation.tilt_log_deviation, shape_of(i));
    double sum = pairs[0] / shape_of(i);
    for (std::size_t step = 1; step < pairs.size(); ++step) {
      const double correlation = part * of_waves[step] + (1 - part) * apart[step];
      double power = 1, covariance = 0;
      for (const double square : squares) covariance += square * (power *= correlation);
      sum += pairs[step] * covariance;
    }
    return sum;
  };
  modulation.shape = shape_of(kShapes - 1);
  double higher = cell_variance(0);
  if (higher <= 1 / texture.shape) {
    modulation.shape = shape_of(0);
  } else {
    for (int i = 1; i < kShapes; ++i) {
      const double lower = cell_variance(i);
      if (lower <= 1 / texture.shape) {
        const double fraction = std::log(higher * texture.shape) / std::log(higher / lower);
        modulation.shape = shape_of(i - 1) * std::pow(shape_of(i) / shape_of(i - 1), fraction);
        break;
      }
      higher = lower;
    }
  }
  modulation.rho = std::sqrt(rho_2(modulation.tilt_log_deviation, modulation.shape));
  return modulation;
}

namespace {

// Mean water velocity at the moving surface: the mean of eta1 du1/dz, 1/2 a^2 w k along each component's direction, in
// any depth; the remainder of the Stokes drift, the same times coth^2 kh, is Lagrangian. Zero at order 1.
Vec2 mean_at_the_surface(const WaveField& waves) {
  Vec2 mean = Vec2::Zero();
  for (const WaveComponent& wave : std::span(waves.components()).first(waves.second_order_count()))
    mean += 0.5 * wave.amplitude * wave.amplitude * wave.omega * wave.wavenumber * wave.direction;
  return mean;
}

// Places of scatterers on the water and its velocity there.
class WaterBelow {
 public:
  explicit WaterBelow(const ScattererRequest& request)
      : request_(request), sight_(request.scene), mean_(mean_at_the_surface(*request.scene.waves)) {
    Random random({request.seed, Stream::kClutterPlace, request.index});
    const double deviation_m = request.scene.radar.range_km * 1e3 * beam_deviation_rad(request.scene.radar);
    for (int k = 0; k < request.count; ++k) across_m_.push_back(deviation_m * random.normal());
    drift_mps_ = request.mean_mps - request.scene.r_hat.dot(request.scene.target_velocity_mps);
  }

  // Of scatterer k after time t of the interval: it drifts with the water, and re-enters the window on its other side.
  Vec2 place(int k, double t) const {
    const double start_m = place_of(k, request_.count) * request_.window_m / request_.count;
    const double shift_m = request_.window_m * std::floor((start_m + request_.mean_mps * t) / request_.window_m + 0.5);
    const Vec2 sailed_m = request_.scene.start_s * request_.scene.target_velocity_mps.xy();
    return sailed_m + sight_.away * ((start_m + drift_mps_ * t - shift_m) / sight_.cos_grazing) +
           sight_.across * across_m_[k];
  }
  double radial_mps(const Vec2& place, double time_s) const {
    const Vec3 velocity = request_.scene.waves->surface(place.x(), place.y(), time_s).velocity;
    return -request_.scene.r_hat.dot(velocity - Vec3(mean_.x(), mean_.y(), 0));
  }

 private:
  const ScattererRequest& request_;
  LineOfSight sight_;
  Vec2 mean_;
  std::vector<double> across_m_;
  double drift_mps_ = 0;
};

SeaScatterers independent_scatterers(const ScattererRequest& request) {
  SeaScatterers scatterers{.count = request.count, .step_s = request.duration_s};
  const std::uint64_t seed = Random({request.seed, Stream::kTexture, request.scene.texture_key}).bits();
  for (const double normal : ring_field(request.count, request.per_cell * request.texture.correlation_cells,
                                        request.texture.correlation_time_s, request.scene.start_s, seed))
    scatterers.amplitude.push_back(std::sqrt(gamma_texture(request.texture.shape, normal) / request.count));
  if (request.spec.doppler != ClutterDoppler::kWaveResolved) return scatterers;
  const WaterBelow water(request);
  for (const double t : {0.0, request.duration_s})
    for (int k = 0; k < request.count; ++k)
      scatterers.velocity_mps.push_back(water.radial_mps(water.place(k, 0), request.scene.start_s + t));
  return scatterers;
}

SeaScatterers modulated_scatterers(const ScattererRequest& request) {
  const ClutterScene& scene = request.scene;
  const TextureParameters& texture = request.texture;
  const int steps = static_cast<int>(std::ceil(request.duration_s / kLongestStep_s));
  SeaScatterers scatterers{.count = request.count, .step_s = request.duration_s / steps};
  const LineOfSight sight(scene);
  const WaterBelow water(request);
  const NormalisedWaves waves(*scene.waves, sight);
  const WaveModulation modulation =
      wave_modulation(texture, scene, request.per_cell, request.per_cell * request.window_m / request.count);
  const double apart = std::sqrt(1 - modulation.rho * modulation.rho), b = modulation.breaking,
               of_power = kWidthOfPower, of_width = std::sqrt(1 - kWidthOfPower * kWidthOfPower);
  const bool has_spikes = scene.radar.polarisation != Polarisation::kVv;
  const double towards = Vec2(std::cos(scene.waves_towards_rad), std::sin(scene.waves_towards_rad)).dot(sight.away);
  const double faster = (has_spikes ? 2 * kExcess : kExcess) * towards * sight.cos_grazing;
  const double scatterer_cells = request.per_cell * texture.correlation_cells;

  Random seeds({request.seed, Stream::kTexture, scene.texture_key});
  const std::uint64_t of_texture = seeds.bits(), of_speckle = seeds.bits(), of_spikes = seeds.bits();
  for (int node = 0; node <= steps; ++node) {
    const double t = node * scatterers.step_s, time_s = scene.start_s + t;
    std::vector<double> n = ring_field(request.count, scatterer_cells, texture.correlation_time_s, time_s, of_texture);
    const std::vector<double> m =
        ring_field(request.count, scatterer_cells, texture.correlation_time_s, time_s, of_speckle);
    if (has_spikes) {
      const std::vector<double> spikes = ring_field(
          request.count, scatterer_cells, std::min(kSpikeTime_s, texture.correlation_time_s), time_s, of_spikes);
      for (int k = 0; k < request.count; ++k)
        n[k] = std::sqrt(1 - kSpikePart) * n[k] + std::sqrt(kSpikePart) * spikes[k];
    }
    for (int k = 0; k < request.count; ++k) {
      const Vec2 place = water.place(k, t);
      const double g = modulation.rho * waves.at(place, time_s) + apart * n[k];
      const double h = of_power * g + of_width * m[k], width = texture.spread_mps * std::exp(b * h - b * b / 2);
      scatterers.amplitude.push_back(std::sqrt(gamma_texture(modulation.shape, g) / request.count));
      scatterers.width_mps.push_back(width);
      scatterers.velocity_mps.push_back(water.radial_mps(place, time_s) + faster * (width - texture.spread_mps));
    }
  }
  return scatterers;
}

}  // namespace

SeaScatterers sea_scatterers(const ScattererRequest& request) {
  SEAGLINT_CHECK(request.duration_s > 0 && request.count > 0, "clutter of an interval");
  const bool by_waves = texture_is_by_waves(request.spec);
  SEAGLINT_CHECK(request.scene.waves != nullptr || (!by_waves && request.spec.doppler != ClutterDoppler::kWaveResolved),
                 "clutter on the waves needs waves");
  return by_waves ? modulated_scatterers(request) : independent_scatterers(request);
}

}  // namespace seaglint
