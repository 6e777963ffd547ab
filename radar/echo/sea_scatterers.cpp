// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_scatterers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
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

int scatterers_per_cell(const ClutterSpec& spec, double range_cell_m) {
  return texture_is_by_waves(spec) ? std::max(2, static_cast<int>(std::ceil(range_cell_m))) : 2;
}

int signed_index(int k, int count) { return k < (count + 1) / 2 ? k : k - count; }

namespace {

constexpr double kLongWaves_rad_s = 2.5;
constexpr double kTiltExponent = 2.6;
const double kLead_rad = radians(25);
constexpr double kMostByWaves = 0.81;   // of the variance of g
constexpr double kFullBreaking = 0.06;  // rms slope of the long waves from which b is 1
constexpr double kLogWidth = 1.3;       // deviation of the logarithm of the width by breaking
constexpr double kMostBreaking = 3;     // of h: a width of 13 w0, one scatterer in 700
constexpr double kWidthOfPower = 0.85;  // correlation of the logarithm of width with g
constexpr double kExcess = 2;           // of velocity over that of width, vv
constexpr double kSpikePart = 0.3;      // of the variance of n, polarisations other than vv
constexpr double kSpikeTime_s = 0.2;
constexpr double kLongestStep_s = 0.1;
constexpr double kStepOfCorrelation = 0.3;  // linear between nodes: mean power 0.07 dB low at shape 0.1
constexpr double kSteady = 0.2;             // of the correlation time: the texture's correlation is 0.98

// Second derivative of log gamma, by its recurrence and asymptotic series (Abramowitz and Stegun 6.4.12); error 1e-9.
double trigamma(double x) {
  double sum = 0;
  for (; x < 10; ++x) sum += 1 / (x * x);
  const double y = 1 / (x * x);
  return sum + 1 / x + y / 2 + y / x * (1.0 / 6 - y * (1.0 / 30 - y * (1.0 / 42 - y / 30)));
}

// Horizontal unit vectors away from the radar and across the line of sight.
struct GroundAxes {
  explicit GroundAxes(const ClutterScene& scene)
      : cos_grazing(std::hypot(scene.r_hat.x(), scene.r_hat.y())),
        away(-Vec2(scene.r_hat.x(), scene.r_hat.y()) / cos_grazing),
        across(-away.y(), away.x()) {}
  double cos_grazing;
  Vec2 away, across;
};

// The waves that modulate, linear: elevation and facing slope in units of their deviations, as one Gaussian field of
// variance 1.
class LongWaves {
 public:
  explicit LongWaves(const ClutterScene& scene) : axes_(scene), waves_(long_waves(*scene.waves)) {
    double elevation_2 = 0;
    for (const WaveComponent& wave : waves_.components()) {
      const double variance = wave.amplitude * wave.amplitude / 2,
                   along = wave.wavenumber * wave.direction.dot(axes_.away);
      elevation_2 += variance;
      facing_slope_2_ += variance * along * along;
      slope_2_ += variance * wave.wavenumber * wave.wavenumber;
    }
    if (!(facing_slope_2_ > 0)) return;
    of_elevation_ = std::cos(kLead_rad) / std::sqrt(elevation_2);
    of_slope_ = std::sin(kLead_rad) / std::sqrt(facing_slope_2_);
  }
  double facing_slope() const { return std::sqrt(facing_slope_2_); }  // rms, along the line of sight
  double slope() const { return std::sqrt(slope_2_); }                // rms, both components

  double at(const Vec2& position, double time_s) const {
    const SurfaceState state =
        waves_.surface(position.x(), position.y(), time_s, SurfaceQuantities::kElevationAndSlope);
    return of_elevation_ * state.elevation + of_slope_ * axes_.away.dot(Vec2(state.slope_x, state.slope_y));
  }
  // E cos(k . d) of two positions along_m of slant range apart, each at a normal distance across of deviation across_m.
  double correlation(double along_m, double across_m) const {
    double sum = 0;
    for (const WaveComponent& wave : waves_.components()) {
      const double along = wave.wavenumber * wave.direction.dot(axes_.away),
                   sideways = wave.wavenumber * wave.direction.dot(axes_.across) * across_m;
      const double elevation = of_elevation_ * wave.amplitude, slope = of_slope_ * wave.amplitude * along;
      sum += 0.5 * (elevation * elevation + slope * slope) * std::cos(along * along_m / axes_.cos_grazing) *
             std::exp(-sideways * sideways);
    }
    return sum;
  }

 private:
  static WaveField long_waves(const WaveField& waves) {
    std::vector<WaveComponent> components;
    for (const WaveComponent& wave : waves.components())
      if (wave.omega < kLongWaves_rad_s) components.push_back(wave);
    return {components, 1, 0, waves.depth()};
  }

  GroundAxes axes_;
  WaveField waves_;
  double facing_slope_2_ = 0, slope_2_ = 0, of_elevation_ = 0, of_slope_ = 0;
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
      const double next =
          (x * polynomial - std::sqrt(static_cast<double>(k)) * before) / std::sqrt(static_cast<double>(k) + 1);
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

double wave_part(double tilt_log_deviation, double shape) {
  return std::min(kMostByWaves, tilt_log_deviation * tilt_log_deviation / trigamma(shape));
}

// t of a surface with this rms slope along the line of sight.
double tilt_log_deviation(double rms_slope, double tan_grazing) {
  if (!(rms_slope > 0)) return 0;
  const double x = tan_grazing / rms_slope;
  const double facing =
      tan_grazing * 0.5 * std::erfc(-x / std::sqrt(2.0)) + rms_slope * std::exp(-x * x / 2) / std::sqrt(2 * kPi);
  return kTiltExponent * rms_slope / facing;
}

// Variance of the power of a cell over its mean squared, for scatterers of a shape of the table. of_waves, apart:
// correlations of pairs of scatterers 0, 1, .. steps apart in range.
double cell_variance(int i, double tilt, const std::vector<double>& pairs, const std::vector<double>& of_waves,
                     const std::vector<double>& apart) {
  const HermiteSquares& squares = hermite_table()[i];
  const double part = wave_part(tilt, shape_of(i));
  double sum = pairs[0] / shape_of(i);
  for (std::size_t step = 1; step < pairs.size(); ++step) {
    const double correlation = part * of_waves[step] + (1 - part) * apart[step];
    double power = 1, covariance = 0;
    for (const double square : squares) covariance += square * (power *= correlation);
    sum += pairs[step] * covariance;
  }
  return sum;
}

WaveModulation modulation_of(const LongWaves& waves, const TextureParameters& texture, const ClutterScene& scene,
                             int scatterers_per_cell, double range_cell_m) {
  WaveModulation modulation;
  modulation.tilt_log_deviation =
      tilt_log_deviation(waves.facing_slope(), scene.r_hat.z() / std::hypot(scene.r_hat.x(), scene.r_hat.y()));
  modulation.breaking = std::min(1.0, std::pow(waves.slope() / kFullBreaking, 2));

  const std::vector<double> pairs = pair_weights(scatterers_per_cell);
  std::vector<double> of_waves, apart;
  for (std::size_t step = 0; step < pairs.size(); ++step) {
    const double distance_m = static_cast<double>(step) * range_cell_m / scatterers_per_cell;
    const double x = distance_m / (texture.correlation_cells * range_cell_m);
    of_waves.push_back(waves.correlation(distance_m, beam_deviation_m(scene.radar)));
    apart.push_back(std::exp(-x * x / 2));
  }
  const auto variance_of = [&](int i) {
    return cell_variance(i, modulation.tilt_log_deviation, pairs, of_waves, apart);
  };
  // The variance falls from shape to shape; between two of the table their logarithms are linear.
  const double wanted = 1 / texture.shape;
  double above = variance_of(0), below = above;
  int i = 0;
  while (i + 1 < kShapes && below > wanted) {
    above = below;
    below = variance_of(++i);
  }
  const bool is_between = i > 0 && below <= wanted;
  const double fraction = is_between ? std::log(above / wanted) / std::log(above / below) : 1;
  modulation.shape = i == 0 ? shape_of(0) : shape_of(i - 1) * std::pow(shape_of(i) / shape_of(i - 1), fraction);
  modulation.cell_shape = is_between ? texture.shape : 1 / below;
  modulation.rho = std::sqrt(wave_part(modulation.tilt_log_deviation, modulation.shape));
  return modulation;
}

}  // namespace

WaveModulation wave_modulation(const TextureParameters& texture, const ClutterScene& scene, int scatterers_per_cell,
                               double range_cell_m) {
  return modulation_of(LongWaves(scene), texture, scene, scatterers_per_cell, range_cell_m);
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

// Positions of the scatterers, and the velocity of the water there.
class ScattererPositions {
 public:
  explicit ScattererPositions(const ScattererRequest& request)
      : request_(request), axes_(request.scene), mean_(mean_at_the_surface(*request.scene.waves)) {
    Random random({request.seed, Stream::kClutterPlace, request.index});
    for (int k = 0; k < request.count; ++k)
      across_m_.push_back(beam_deviation_m(request.scene.radar) * random.normal());
    drift_mps_ =
        request.mean_mps - request.scene.r_hat.dot(request.scene.target_velocity_mps - request.scene.current_mps);
  }

  // Of scatterer k after time t of the interval.
  Vec2 at(int k, double t) const {
    const double start_m = signed_index(k, request_.count) * request_.window_m / request_.count;
    const double shift_m = request_.window_m * std::floor((start_m + request_.mean_mps * t) / request_.window_m + 0.5);
    const Vec2 sailed_m = request_.scene.start_s * request_.scene.target_velocity_mps.xy();
    return sailed_m + axes_.away * ((start_m + drift_mps_ * t - shift_m) / axes_.cos_grazing) +
           axes_.across * across_m_[k];
  }
  double radial_mps(const Vec2& position, double time_s) const {
    const Vec3 velocity = request_.scene.waves->surface(position.x(), position.y(), time_s).velocity;
    return -request_.scene.r_hat.dot(velocity - Vec3(mean_.x(), mean_.y(), 0));
  }

 private:
  ScattererRequest request_;
  GroundAxes axes_;
  Vec2 mean_;
  std::vector<double> across_m_;
  double drift_mps_ = 0;
};

// Steps of equal length, at most longest_s, of an interval.
double step_of(double duration_s, double longest_s) { return duration_s / std::ceil(duration_s / longest_s); }

class IndependentScatterers {
 public:
  explicit IndependentScatterers(const ScattererRequest& request)
      : request_(request),
        step_s_(step_of(request.duration_s,
                        std::min(kLongestStep_s, kStepOfCorrelation * request.texture.correlation_time_s))),
        texture_seed_(Random({request.seed, Stream::kTexture, request.scene.texture_key}).bits()) {
    if (request.spec.doppler == ClutterDoppler::kWaveResolved) positions_.emplace(request);
    if (is_steady()) amplitude_ = amplitude_at(0);
  }
  double step_s() const { return step_s_; }
  bool is_steady() const { return request_.duration_s <= kSteady * request_.texture.correlation_time_s; }

  ScattererState at_node(int node) const {
    const double t = node * step_s_;
    ScattererState state{is_steady() ? amplitude_ : amplitude_at(t), {}, {}};
    if (!positions_) return state;
    const double drifted_s = step_s_ < request_.duration_s ? t : 0;  // within one step by centimetres
    for (int k = 0; k < request_.count; ++k)
      state.velocity_mps.push_back(positions_->radial_mps(positions_->at(k, drifted_s), request_.scene.start_s + t));
    return state;
  }

 private:
  std::vector<double> amplitude_at(double t) const {
    std::vector<double> amplitude;
    for (const double normal :
         ring_field(request_.count, request_.per_cell * request_.texture.correlation_cells,
                    request_.texture.correlation_time_s, request_.scene.start_s + t, texture_seed_))
      amplitude.push_back(std::sqrt(gamma_texture(request_.texture.shape, normal) / request_.count));
    return amplitude;
  }

  ScattererRequest request_;
  double step_s_;
  std::uint64_t texture_seed_;
  std::optional<ScattererPositions> positions_;
  std::vector<double> amplitude_;
};

class ModulatedScatterers {
 public:
  explicit ModulatedScatterers(const ScattererRequest& request)
      : request_(request),
        step_s_(step_of(request.duration_s,
                        std::min(kLongestStep_s, kStepOfCorrelation * request.texture.correlation_time_s))),
        positions_(request),
        waves_(request.scene),
        modulation_(modulation_of(waves_, request.texture, request.scene, request.per_cell,
                                  request.per_cell * request.window_m / request.count)),
        has_spikes_(request.scene.radar.polarisation != Polarisation::kVv),
        excess_((has_spikes_ ? 2 : 1) * kExcess * -upwind_cosine(request.scene) *
                GroundAxes(request.scene).cos_grazing) {
    Random seeds({request.seed, Stream::kTexture, request.scene.texture_key});
    for (std::uint64_t* seed : {&power_seed_, &width_seed_, &spike_seed_}) *seed = seeds.bits();
  }
  double step_s() const { return step_s_; }

  ScattererState at_node(int node) const {
    const double t = node * step_s_, time_s = request_.scene.start_s + t;
    const double apart = std::sqrt(1 - modulation_.rho * modulation_.rho),
                 of_width = std::sqrt(1 - kWidthOfPower * kWidthOfPower);
    const double correlation_time_s = request_.texture.correlation_time_s;
    std::vector<double> n = field(correlation_time_s, time_s, power_seed_);
    const std::vector<double> m = field(correlation_time_s, time_s, width_seed_);
    if (has_spikes_) {
      const std::vector<double> spikes = field(std::min(kSpikeTime_s, correlation_time_s), time_s, spike_seed_);
      for (std::size_t k = 0; k < n.size(); ++k)
        n[k] = std::sqrt(1 - kSpikePart) * n[k] + std::sqrt(kSpikePart) * spikes[k];
    }
    ScattererState state;
    for (int k = 0; k < request_.count; ++k) {
      const Vec2 position = positions_.at(k, t);
      const double g = modulation_.rho * waves_.at(position, time_s) + apart * n[k];
      const double h = std::min(kMostBreaking, kWidthOfPower * g + of_width * m[k]);
      const double w0 = request_.texture.spread_mps, mean = w0 * modulation_.mean_width();
      const double width = w0 + (mean - w0) * std::exp(kLogWidth * h - kLogWidth * kLogWidth / 2);
      state.amplitude.push_back(std::sqrt(gamma_texture(modulation_.shape, g) / request_.count));
      state.width_mps.push_back(width);
      state.velocity_mps.push_back(positions_.radial_mps(position, time_s) + excess_ * (width - mean));
    }
    return state;
  }

 private:
  std::vector<double> field(double correlation_time_s, double time_s, std::uint64_t seed) const {
    return ring_field(request_.count, request_.per_cell * request_.texture.correlation_cells, correlation_time_s,
                      time_s, seed);
  }

  ScattererRequest request_;
  double step_s_;
  ScattererPositions positions_;
  LongWaves waves_;
  WaveModulation modulation_;
  bool has_spikes_;
  double excess_;  // of velocity over that of width
  std::uint64_t power_seed_ = 0, width_seed_ = 0, spike_seed_ = 0;
};

}  // namespace

SeaScatterers sea_scatterers(const ScattererRequest& request) {
  SEAGLINT_CHECK(request.duration_s > 0 && request.count > 0, "clutter of an interval");
  const bool by_waves = texture_is_by_waves(request.spec);
  SEAGLINT_CHECK(request.scene.waves != nullptr || (!by_waves && request.spec.doppler != ClutterDoppler::kWaveResolved),
                 "clutter on the waves needs waves");
  if (by_waves) {
    const auto scatterers = std::make_shared<const ModulatedScatterers>(request);
    return {scatterers->step_s(), false, [scatterers](int node) { return scatterers->at_node(node); }};
  }
  const auto scatterers = std::make_shared<const IndependentScatterers>(request);
  return {scatterers->step_s(), scatterers->is_steady(), [scatterers](int node) { return scatterers->at_node(node); }};
}

}  // namespace seaglint
