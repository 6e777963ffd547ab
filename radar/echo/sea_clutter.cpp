// SPDX-License-Identifier: BSD-3-Clause
#include "radar/echo/sea_clutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <span>

#include "radar/echo/sea_reflectivity.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"
#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/sea/wave_field.h"

namespace seaglint {
namespace {

constexpr double kSurfaceTension = 0.074;  // N/m, sea water
constexpr double kWindDrift = 0.03;        // of the wind 10 m above the water
constexpr double kFullyDeveloped = 0.22;   // Hs = 0.22 U^2 / g

// Phase speed of the Bragg-resonant waves, k_B = 2 k cos(grazing).
double bragg_speed_mps(double wavelength_m, double cos_grazing) {
  const double k = 4 * kPi / wavelength_m * cos_grazing;
  return std::sqrt(kGravity / k + kSurfaceTension / kSeaWaterDensity * k);
}

// Two-way gain e^{-8 ln2 phi^2 / width^2} is a normal density of deviation width / (4 sqrt(ln 2)).
double beam_deviation_rad(const RadarSpec& radar) {
  return radians(radar.link_budget.beamwidth_deg) / (4 * std::sqrt(std::log(2.0)));
}

// coth(k h): ratio of horizontal to vertical orbital amplitude at the surface, 1 in deep water.
double orbit_ratio(const WaveComponent& wave, double depth) {
  return 1 / std::tanh(std::min(20.0, wave.wavenumber * depth));
}

// Mean velocity of the water particles at the surface, along the wave direction (Stokes 1847; Phillips, "The Dynamics
// of the Upper Ocean", 2nd ed. 1977, section 3.3):
// a^2 w k cosh(2 k h) / (2 sinh^2 k h) = a^2 w k (1 + coth^2 k h) / 2.
double stokes_drift(const WaveComponent& wave, double depth) {
  const double coth = orbit_ratio(wave, depth);
  return wave.amplitude * wave.amplitude * wave.omega * wave.wavenumber * (1 + coth * coth) / 2;
}

// Mean water velocity at the moving surface: the mean of eta1 du1/dz, 1/2 a^2 w k along each component's direction, in
// any depth; the remainder of the Stokes drift, the same times coth^2 kh, is Lagrangian. Zero at order 1.
Vec2 mean_at_the_surface(const WaveField& waves) {
  Vec2 mean = Vec2::Zero();
  for (const WaveComponent& wave : std::span(waves.components()).first(waves.second_order_count()))
    mean += 0.5 * wave.amplitude * wave.amplitude * wave.omega * wave.wavenumber * wave.direction;
  return mean;
}

}  // namespace

VelocityMoments clutter_velocity_moments(const ClutterSpec& spec, const ClutterScene& scene, double wavelength_m) {
  SEAGLINT_CHECK(scene.waves != nullptr, "clutter that follows the sea needs its waves");
  const double cos_grazing = std::hypot(scene.r_hat.x(), scene.r_hat.y()), sin_grazing = scene.r_hat.z();
  const Vec2 look = Vec2(scene.r_hat.x(), scene.r_hat.y());  // norm cos_grazing

  // Orbital velocity of a wave of amplitude a: a w vertical, a w coth(k h) along its direction.
  Vec2 stokes = Vec2::Zero();
  double variance = 0;
  for (const WaveComponent& wave : scene.waves->components()) {
    const double speed = wave.amplitude * wave.omega;
    stokes += stokes_drift(wave, scene.waves->depth()) * wave.direction;
    const double horizontal = look.dot(wave.direction) * orbit_ratio(wave, scene.waves->depth());
    variance += 0.5 * speed * speed * (horizontal * horizontal + sin_grazing * sin_grazing);
  }
  const double past_mps =
      scene.r_hat.dot(scene.target_velocity_mps);  // still water moves astern relative to the target
  if (!(stokes.norm() > 0)) return {past_mps, 0};
  const double wind = std::sqrt(kGravity * scene.significant_wave_height_m / kFullyDeveloped);
  const double along_waves = bragg_speed_mps(wavelength_m, cos_grazing) + kWindDrift * wind + stokes.norm();
  const double factor = scene.radar.polarisation == Polarisation::kVv ? 1 : spec.hh_velocity_factor;
  return {past_mps - factor * along_waves * look.dot(stokes.normalized()), std::sqrt(variance)};
}

double platform_doppler_spread_mps(const ClutterScene& scene) {
  const Vec3 velocity = Vec3(scene.radar.platform.velocity_mps) + scene.target_velocity_mps;
  const Vec3 sideways = Vec3::UnitZ().cross(scene.r_hat);
  const double level = sideways.norm();
  return level > 0 ? std::abs(velocity.dot(sideways)) / level * beam_deviation_rad(scene.radar) : 0;
}

FloatingScatterers floating_scatterers(const ClutterScene& scene, const std::vector<double>& range_m, double duration_s,
                                       std::uint64_t seed, std::uint64_t index) {
  SEAGLINT_CHECK(scene.waves != nullptr && duration_s > 0, "clutter on the waves needs waves and an interval");
  Random random({seed, Stream::kClutterPlace, index});
  const double cos_grazing = std::hypot(scene.r_hat.x(), scene.r_hat.y());
  const Vec2 away = -Vec2(scene.r_hat.x(), scene.r_hat.y()) / cos_grazing, across(-away.y(), away.x());
  const double deviation_m = scene.radar.range_km * 1e3 * beam_deviation_rad(scene.radar);
  const Vec2 sailed_m = scene.start_s * scene.target_velocity_mps.xy();  // position of the target in the waves
  const Vec2 mean = mean_at_the_surface(*scene.waves);
  FloatingScatterers floating;
  for (const double range : range_m) {
    const Vec2 place = sailed_m + away * (range / cos_grazing) + across * (deviation_m * random.normal());
    const auto radial = [&](double time_s) {
      const Vec3 velocity = scene.waves->surface(place.x(), place.y(), time_s).velocity;
      return -scene.r_hat.dot(velocity - Vec3(mean.x(), mean.y(), 0));
    };
    const double first = radial(scene.start_s), last = radial(scene.start_s + duration_s);
    floating.velocity_mps.push_back(first);
    floating.acceleration_mps2.push_back((last - first) / duration_s);
  }
  return floating;
}

std::optional<double> k_shape(const ClutterScene& scene, double frequency_hz, double range_cell_m) {
  const Polarisation polarisation = scene.radar.polarisation;
  const bool is_co_polar = polarisation == Polarisation::kHh || polarisation == Polarisation::kVv;
  const double grazing_rad = std::asin(scene.r_hat.z()), ghz = 1e-9 * frequency_hz, grazing_deg = degrees(grazing_rad);
  const double area_m2 = clutter_patch_area_m2(scene.radar, grazing_rad, range_cell_m),
               across_m = area_m2 * std::cos(grazing_rad) / range_cell_m;
  if (!is_co_polar || ghz < 9 || ghz > 10 || grazing_deg < 0.1 || grazing_deg > 10 || across_m < 100 || across_m > 800)
    return std::nullopt;
  const double theta = std::atan2(scene.r_hat.y(), scene.r_hat.x()) - scene.waves_towards_rad;
  const double of_polarisation = polarisation == Polarisation::kVv ? 1.39 : 2.09;
  return std::pow(10, 2.0 / 3 * std::log10(grazing_deg) + 5.0 / 8 * std::log10(area_m2) - of_polarisation -
                          std::cos(2 * theta) / 3);
}

double gamma_texture(double shape, double normal) {
  SEAGLINT_CHECK(shape >= 0.1 && shape <= 1000, fmt::format("shape = {}", shape));
  return gamma_of_normal(shape, normal) / shape;
}

namespace {

// Scatterers per synthetic range resolution c/(2 B_s): with two the speckle of a resolution cell is Gaussian and their
// phases remain independent.
constexpr int kScatterersPerCell = 2;
// Correlation length of the texture in synthetic range cells (3.75 m for the paper's radar): long compared with the
// main lobe, so that the texture is constant over a map cell and its intensity has <I^2>/<I>^2 = 2 (1 + 1/shape) to
// about 2 %.
constexpr double kTextureCells = 5;
// A Gaussian process with correlation e^{-(w tau)^2/2} is white noise at nodes every kNodeSpacing/w through the kernel
// e^{-(w t)^2}; spacing and reach cause errors of 1e-6 and 5e-6 in the correlation.
constexpr double kNodeSpacing = 0.6;
constexpr double kKernelReach = 3.5;
// Pulses further apart than this many 1/w are independent to 4e-6; larger Doppler spreads have no further effect.
constexpr double kIndependence = 5;

// Nodes for the time x (in 1/w), from index `first` on, with weights whose squares sum to 1.
struct Kernel {
  double first = 0;
  std::vector<double> weight;
};

Kernel kernel_at(double x) {
  Kernel kernel{std::ceil((x - kKernelReach) / kNodeSpacing), {}};
  const int nodes = static_cast<int>(std::floor((x + kKernelReach) / kNodeSpacing) - kernel.first) + 1;
  double power = 0;
  for (int n = 0; n < nodes; ++n) {
    const double q = kernel.first + n;
    kernel.weight.push_back(std::exp(-(x - q * kNodeSpacing) * (x - q * kNodeSpacing)));
    power += kernel.weight.back() * kernel.weight.back();
  }
  for (double& w : kernel.weight) w /= std::sqrt(power);
  return kernel;
}

Complex complex_normal(Random& random) {
  const double re = random.normal();
  return Complex(re, random.normal()) * std::sqrt(0.5);
}

// Speckle of all scatterers over time: independent complex Gaussian processes of power 1 with one Doppler width.
class Speckle {
 public:
  Speckle(int scatterers, double rate_rad_s, Random& random)
      : scatterers_(scatterers), rate_(rate_rad_s), random_(random), first_(-std::ceil(kKernelReach / kNodeSpacing)) {}

  // Values at time_s >= 0, ascending from call to call.
  void at(double time_s, Complex* values) {
    const Kernel kernel = kernel_at(time_s * rate_);
    while (!nodes_.empty() && first_ < kernel.first) {
      nodes_.pop_front();
      ++first_;
    }
    first_ = std::max(first_, kernel.first);
    while (nodes_.size() < kernel.weight.size()) {
      std::vector<Complex> node(scatterers_);
      for (Complex& value : node) value = complex_normal(random_);
      nodes_.push_back(std::move(node));
    }
    std::fill(values, values + scatterers_, Complex{});
    for (std::size_t i = 0; i < kernel.weight.size(); ++i) {
      for (int k = 0; k < scatterers_; ++k) values[k] += kernel.weight[i] * nodes_[i][k];
    }
  }

 private:
  int scatterers_;
  double rate_;
  Random& random_;
  double first_;  // number of the node nodes_.front(), at time first_ kNodeSpacing / rate
  std::deque<std::vector<Complex>> nodes_;
};

}  // namespace

std::vector<double> sea_texture(int cells, double correlation_cells, const ClutterSpec& spec, double time_s,
                                std::uint64_t seed, std::uint64_t key) {
  // White on the ring, correlated in time. Each node has its own key, so that any time can be evaluated independently;
  // nodes before t = 0 have negative indices.
  const std::uint64_t own_seed = Random({seed, Stream::kTexture, key}).bits();
  const Kernel in_time = kernel_at(time_s / spec.texture_correlation_time_s);
  std::vector<double> white(cells);
  for (std::size_t i = 0; i < in_time.weight.size(); ++i) {
    const auto node = static_cast<std::int64_t>(in_time.first) + static_cast<std::int64_t>(i);
    Random random({own_seed, Stream::kTexture, static_cast<std::uint64_t>(node)});
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
  std::vector<double> texture(cells);
  for (int k = 0; k < cells; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < kernel.size(); ++i) sum += kernel[i] * white[(k + i) % cells];
    texture[k] = gamma_texture(spec.texture_shape, sum / std::sqrt(power));
  }
  return texture;
}

namespace {

// Range index of scatterer k of K: k, or k - K, so that they fill half a window on either side of the reference point.
int place_of(int k, int scatterers) { return k < (scatterers + 1) / 2 ? k : k - scatterers; }

std::vector<double> scatterer_ranges(double window_m, int scatterers) {
  std::vector<double> range_m;
  for (int k = 0; k < scatterers; ++k) range_m.push_back(place_of(k, scatterers) * window_m / scatterers);
  return range_m;
}

}  // namespace

std::vector<Complex> clutter_response(const PulseTrain& train, const ClutterSpec& spec, const ClutterScene& scene,
                                      std::uint64_t seed, std::uint64_t index) {
  Random random({seed, Stream::kClutter, index});
  const int scatterers = kScatterersPerCell * train.band_bins() / train.grid_refinement;
  const double window_m = train.unambiguous_range_m() / train.grid_refinement;
  const std::vector<double> texture =
      sea_texture(scatterers, kScatterersPerCell * kTextureCells, spec, scene.start_s, seed, scene.texture_key);

  // Contribution of the waves to the prescribed velocity.
  const double wavelength = kSpeedOfLight / train.band_centre_hz();
  const double duration = std::max(train.time_s.back(), train.pri_s);
  double mean_mps = spec.doppler_mean_mps, spread_mps = spec.doppler_spread_mps;
  spread_mps = std::hypot(spread_mps, platform_doppler_spread_mps(scene));
  FloatingScatterers floating;
  if (spec.doppler != ClutterDoppler::kPrescribed) {
    const VelocityMoments sea = clutter_velocity_moments(spec, scene, wavelength);
    mean_mps += sea.mean_mps;
    if (spec.doppler == ClutterDoppler::kSeaState) spread_mps = std::hypot(spread_mps, sea.spread_mps);
    if (spec.doppler == ClutterDoppler::kWaveResolved)
      floating = floating_scatterers(scene, scatterer_ranges(window_m, scatterers), duration, seed, index);
  }

  // Doppler f_D = -2 v / lambda, so a velocity spread s gives the correlation e^{-(4 pi s tau / lambda)^2 / 2}.
  const double rate = std::clamp(4 * kPi * spread_mps / wavelength, 1e-6 / duration, kIndependence / train.pri_s);
  Speckle speckle(scatterers, rate, random);

  // Scatterer k of K lies at range k W / K of the window W = c/(2 step): at frequency i step its phase -4 pi f R / c is
  // -2 pi i k / K, and a forward transform sums all of them. The phase of the first frequency is absorbed by the
  // speckle. On a grid m times finer the transform is m times longer, and (m - 1)/2 steps precede the first coarse
  // frequency.
  const int length = scatterers * train.grid_refinement;
  std::vector<Complex> first(scatterers);
  for (int k = 0; k < scatterers; ++k)
    first[k] = std::sqrt(texture[k] / scatterers) *
               std::polar(1.0, kPi * place_of(k, scatterers) * (train.grid_refinement - 1) / length);
  FourierBatch transform(length, 1, Fourier::kForward);
  std::vector<Complex> values(scatterers);
  std::vector<Complex> response;
  response.reserve(train.pulses() * train.frequencies());
  for (std::size_t n = 0; n < train.pulses(); ++n) {
    const double t = train.time_s[n];
    speckle.at(t, values.data());
    for (int k = 0; k < scatterers; ++k) values[k] *= first[k];
    // Phase of the displacement on the waves, at the carrier of the pulse.
    for (std::size_t k = 0; k < floating.velocity_mps.size(); ++k) {
      const double moved_m = t * (floating.velocity_mps[k] + 0.5 * t * floating.acceleration_mps2[k]);
      values[k] *= std::polar(1.0, -4 * kPi * train.carrier_hz[n] * moved_m / kSpeedOfLight);
    }
    Complex* row = transform.row(0);
    std::fill(row, row + length, Complex{});
    for (int k = 0; k < scatterers; ++k) row[(place_of(k, scatterers) + length) % length] = values[k];
    transform.execute();
    for (std::size_t b = 0; b < train.frequencies(); ++b) {
      const double sweep_s = train.intra_pulse_motion ? train.baseband_hz[b] / train.chirp_rate_hz_s : 0;
      const double range_m = mean_mps * (t + sweep_s);
      const double frequency = train.carrier_hz[n] + train.baseband_hz[b];
      response.push_back(row[train.code[n] * train.bins_per_hop + b] *
                         std::polar(1.0, -4 * kPi * frequency * range_m / kSpeedOfLight));
    }
  }
  return response;
}

}  // namespace seaglint
