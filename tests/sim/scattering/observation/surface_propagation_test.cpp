// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/observation/surface_propagation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/motion/float/float.h"
#include "sim/scattering/solver/solve.h"
#include "sim/sea/realisation.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

constexpr double kXBand = 2 * kPi * 9.39e9 / kSpeedOfLight;  // rad/m

SeaReflection water_of_roughness(double rms_m, SeaSurface surface = SeaSurface::kSeaWater) {
  SeaReflectionSpec spec;
  spec.surface = surface;
  return {spec, 4 * rms_m};
}

SurfaceProfile flat_profile(double length_m, double step_m) {
  const auto samples = static_cast<std::size_t>(std::lround(length_m / step_m)) + 1;
  return {step_m, std::vector<double>(samples, 0.0), std::vector<double>(samples, 0.0)};
}

// Elevation and slope of a function of x.
template <typename Function>
SurfaceProfile profile_of(double length_m, double step_m, const Function& elevation) {
  SurfaceProfile profile = flat_profile(length_m, step_m);
  for (std::size_t i = 1; i < profile.slope.size(); ++i) {
    const double x = static_cast<double>(i) * step_m, d = 1e-6;
    profile.elevation_m[i] = elevation(x);
    profile.slope[i] = (elevation(x + d) - elevation(x - d)) / (2 * d);
  }
  return profile;
}

WaveField wind_sea(double height_m, double period_s, std::uint64_t seed) {
  SeaState state;
  state.significant_wave_height_m = height_m;
  state.peak_period_s = period_s;
  state.propagation_rad = kPi;  // towards the body from the radar's side is 180 deg: a head sea
  state.second_order_cutoff_rad_s = std::sqrt(2 * kGravity / height_m);
  return realise_sea(state, seed, 0);
}

// The direct wave and the wave from the image of a plane with the Fresnel coefficient.
TEST(SurfacePropagation, FlatSeaHasTwoRayInterferenceAtEveryHeight) {
  const SeaReflection sea = water_of_roughness(0);
  for (const auto& [elevation_deg, tolerance] : {std::pair(0.3, 0.01), std::pair(1.0, 0.03), std::pair(3.0, 0.08)}) {
    const double s = std::sin(radians(elevation_deg));
    const SeaReflectionCoefficients rho = sea.at(kXBand, s);
    const SurfaceField field(flat_profile(150, profile_step_m(kXBand)), kXBand, s, sea, rho);
    double worst_h = 0, worst_v = 0;
    for (double z = 0.02; z < 12; z *= 1.15) {
      const Complex direct = std::polar(1.0, kXBand * s * z);
      const SeaReflectionCoefficients u = field.at(z);
      worst_h = std::max(worst_h, std::abs(u.h - (direct + rho.h / direct)));
      worst_v = std::max(worst_v, std::abs(u.v - (direct + rho.v / direct)));
    }
    EXPECT_LT(worst_h, tolerance) << elevation_deg;
    EXPECT_LT(worst_v, tolerance) << elevation_deg;
    std::cout << fmt::format("elevation {} deg: largest error hh {:.4f}, vv {:.4f}\n", elevation_deg, worst_h, worst_v);
  }
}

// The power of the echo is |F|^4; low over a sea with rho = -1, F is 2 sin(k z sin(elevation)).
TEST(SurfacePropagation, EchoLowOverAFlatSeaGrowsWithTheFourthPowerOfHeight) {
  const SeaReflection sea = water_of_roughness(0, SeaSurface::kConductor);
  const double s = std::sin(radians(0.3));
  const SurfaceField field(flat_profile(150, 0.2), kXBand, s, sea, sea.at(kXBand, s));
  for (const double z : {0.05, 0.1, 0.2}) {
    const double ratio = std::norm(field.at(2 * z).h) / std::norm(field.at(z).h);
    const double exact = std::pow(std::sin(2 * kXBand * s * z) / std::sin(kXBand * s * z), 2);
    EXPECT_NEAR(ratio / exact, 1, 0.05) << z;
    EXPECT_NEAR(std::abs(field.at(z).h), 2 * std::sin(kXBand * s * z), 0.004) << z;
  }
}

// Fresnel integral of a half-screen (M. Born and E. Wolf, Principles of Optics, 8.7.3), by quadrature: e^{j pi/4} /
// sqrt(2) times the integral of e^{-j pi t^2 / 2} over t > v.
Complex half_screen(double v) {
  Complex sum = 0;
  constexpr double kStep = 1e-3, kEnd = 40;
  for (double t = v + 0.5 * kStep; t < kEnd; t += kStep) sum += std::polar(kStep, -0.5 * kPi * t * t);
  sum += std::polar(1.0, -0.5 * kPi * kEnd * kEnd) / (Complex(0, 1) * kPi * kEnd);
  return std::polar(std::sqrt(0.5), kPi / 4) * sum;
}

// A wedge with faces far from grazing incidence diffracts as a half-screen near its shadow boundary.
TEST(SurfacePropagation, CrestDiffractsAsAHalfScreen) {
  constexpr double kSlope = 0.25, kApex_m = 40, kBehind_m = 100;
  const auto wedge = [&](double x) { return kSlope * (kApex_m - std::abs(x - kApex_m)); };
  const SurfaceProfile profile = profile_of(kApex_m + kBehind_m, 0.1, wedge);
  const double s = std::sin(radians(0.5)), top_m = kSlope * kApex_m;
  // In front of the wedge there is the incident wave alone.
  const SurfaceField field(profile, kXBand, s, water_of_roughness(0), {0, 0});
  const double boundary_m = top_m - s * kBehind_m;
  for (const double above_m : {-3.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0}) {
    const double z = boundary_m + above_m;
    const Complex incident = std::polar(1.0, kXBand * s * z);
    const Complex expected = half_screen(-above_m * std::sqrt(kXBand / (kPi * kBehind_m)));
    const SeaReflectionCoefficients u = field.at(z);
    EXPECT_NEAR(std::abs(u.h / incident - expected), 0, 0.025) << above_m;
    EXPECT_NEAR(std::abs(u.v / incident - expected), 0, 0.025) << above_m;
  }
  const double on_boundary_db = 20 * std::log10(std::abs(field.at(boundary_m).h));
  EXPECT_NEAR(on_boundary_db, -6.02, 0.2);
}

// Amplitude at the grazing sine `scattered` in the spectrum of what a bump on a flat surface adds to the field.
double scattered_amplitude(const SurfaceProfile& profile, double incident, double scattered) {
  const SeaReflection conductor = water_of_roughness(0, SeaSurface::kConductor);
  const SurfaceField field(profile, kXBand, incident, conductor, {-1, 1});
  Complex sum = 0;
  constexpr double kStep = 0.05;
  for (double z = 0.5 * kStep; z < 14; z += kStep) {
    const Complex flat = 2.0 * Complex(0, 1) * std::sin(kXBand * incident * z);
    sum += kStep * smooth_taper(z, {8, 14}) * (field.at(z).h - flat) * std::sin(kXBand * scattered * z);
  }
  return std::abs(sum);
}

TEST(SurfacePropagation, ScatteringByABumpIsReciprocal) {
  constexpr double kLength_m = 60;
  const auto bump = [](double x) { return 0.3 * std::exp(-0.5 * x * x) + 0.2 * std::exp(-0.5 * std::pow(x - 2.5, 2)); };
  const auto forward = [&](double x) { return bump(x - 0.5 * kLength_m); };
  const auto backward = [&](double x) { return bump(0.5 * kLength_m - x); };
  const double low = 0.02, high = 0.06;
  const double there = scattered_amplitude(profile_of(kLength_m, 0.1, forward), low, high);
  const double back = scattered_amplitude(profile_of(kLength_m, 0.1, backward), high, low);
  EXPECT_NEAR(there / back, 1, 0.03);
}

// Relative difference of the fields of two steps at heights over the water, over some instants.
TEST(SurfacePropagation, FieldOverWavesConvergesWithTheStep) {
  const WaveField sea = wind_sea(0.9, 4.75, 3);
  const double s = std::sin(radians(0.6)), length_m = 120;
  const auto over = [&](double time_s, double step_m) {
    return profile_of(length_m, step_m, [&](double x) {
      return (1 - smooth_taper(x, {0, 30})) *
             sea.surface(length_m - x, 0, time_s, SurfaceQuantities::kElevationAndSlope).elevation;
    });
  };
  const auto difference = [&](double step_m, double reference_m) {
    double error_h = 0, error_v = 0, power_h = 0, power_v = 0;
    for (const double time_s : {0.0, 7.0, 13.0}) {
      const SeaReflection ripples = water_of_roughness(0.005), mean = water_of_roughness(0.225);
      const auto field = [&](double step) {
        return SurfaceField(over(time_s, step), kXBand, s, ripples, mean.at(kXBand, s));
      };
      const SurfaceField coarse = field(step_m), fine = field(reference_m);
      const double water_m = over(time_s, reference_m).elevation_m.back();
      for (const double above_m : {0.3, 0.6, 1.2}) {
        const SeaReflectionCoefficients a = coarse.at(water_m + above_m), b = fine.at(water_m + above_m);
        error_h += std::norm(a.h - b.h), power_h += std::norm(b.h);
        error_v += std::norm(a.v - b.v), power_v += std::norm(b.v);
      }
    }
    return std::pair(std::sqrt(error_h / power_h), std::sqrt(error_v / power_v));
  };
  const auto [used_h, used_v] = difference(0.2, 0.05);
  const auto [half_h, half_v] = difference(0.1, 0.05);
  EXPECT_LT(used_h, 0.002);
  EXPECT_LT(used_v, 0.004);
  EXPECT_LT(half_h, 0.5 * used_h);
  EXPECT_LT(half_v, 0.5 * used_v);
  std::cout << fmt::format("step 0.2 m: hh {:.4f}, vv {:.4f}; 0.1 m: {:.4f}, {:.4f}\n", used_h, used_v, half_h, half_v);
}

IntervalSampling pulses_every(double step_s, double duration_s) {
  IntervalSampling sampling;
  sampling.first_hz = 9.39e9;
  sampling.step_hz = 1e6;
  sampling.count = sampling.frequencies_per_pulse = 1;
  for (int n = 0; n * step_s < duration_s; ++n) sampling.pulse_time_s.push_back(n * step_s);
  sampling.pulse_first.assign(sampling.pulse_time_s.size(), 0);
  return sampling;
}

Vec3 at_elevation(double elevation_deg) {
  return {std::cos(radians(elevation_deg)), 0, std::sin(radians(elevation_deg))};
}

// Waves of 1 cm leave the direct wave and the coherent reflection of the mean plane.
TEST(SurfacePropagation, AmplitudesOverLowWavesAreThoseOfTheMeanPlane) {
  const WaveField sea = wind_sea(0.01, 3, 1);
  const SeaReflection reflection({}, 0.01, WavesBelow{&sea, {}, {}, 0});
  const Vec3 r_hat = at_elevation(1);
  const IntervalSampling sampling = pulses_every(0.01, 0.05);
  const OneWayAmplitudes amplitudes(reflection, {[](double) { return Vec3(0, 0, 0.8); }, 0.5, 0}, sampling, r_hat);
  const SeaReflectionCoefficients rho = reflection.at(kXBand, r_hat.z());
  for (int pulse = 0; pulse < 5; ++pulse) {
    const OneWayPaths at = amplitudes.at(pulse, 0);
    EXPECT_NEAR(std::abs(at.direct.h - 1.0), 0, 0.03);
    EXPECT_NEAR(std::abs(at.direct.v - 1.0), 0, 0.03);
    EXPECT_NEAR(std::abs(at.image.h - rho.h), 0, 0.03);
    EXPECT_NEAR(std::abs(at.image.v - rho.v), 0, 0.03);
  }
}

// A radar at 1 km and a body half as high: over waves of 1 cm the echo is that over the mean plane.
TEST(SurfacePropagation, OfAHighBodyBeforeANearRadarIsThatOfTheMeanPlane) {
  const WaveField sea = wind_sea(0.01, 3, 1);
  const SeaReflection over_waves({}, 0.01, WavesBelow{&sea, {}, {}, 0}), over_plane({}, 0.01);
  const Scatterer sphere(make_sphere(0.15, 4));
  SolverSpec solver;
  solver.wavefront_range_m = 1000;
  constexpr double kStrongest_m = 4 * 0.15 / 2;  // of a sphere at the maximum of the interference
  for (const double height_m : {7.9, 8.0, 8.1}) {
    const auto echo = [&](const SeaReflection& sea_below) {
      return solve({.scatterer = sphere,
                    .trajectory = Trajectory::at_rest(Vec3(0, 0, height_m)),
                    .r_hat = at_elevation(1),
                    .polarisation = Polarisation::kVv,
                    .sampling = pulses_every(0.01, 0.02),
                    .solver = solver,
                    .sea = &sea_below,
                    .threads = 1})
          .response.values[0];
    };
    const Complex waves = echo(over_waves), plane = echo(over_plane);
    // One-way amplitudes over such waves differ by 3 % (above), on both ways.
    EXPECT_NEAR(std::abs(waves - plane), 0, 0.05 * std::abs(plane) + 0.02 * kStrongest_m) << height_m;
  }
}

TEST(SurfacePropagation, AmplitudesBetweenNodesAreInterpolatedToAFewPercent) {
  const WaveField sea = wind_sea(0.9, 4.75, 3);
  const SeaReflection reflection({}, 0.9, WavesBelow{&sea, {}, {}, 0.005});
  const Vec3 r_hat = at_elevation(1);
  const BodyOverWaves body{[&](double t) { return Vec3(0, 0, 0.5 + sea.surface(0, 0, t).elevation); }, 0.5, 0};
  IntervalSampling dense = pulses_every(0.005, 2), few = pulses_every(0.105, 2);  // of `few` each pulse is a node
  dense.count = few.count = 2;
  dense.step_hz = few.step_hz = 200e6;
  dense.frequencies_per_pulse = few.frequencies_per_pulse = 2;
  const OneWayAmplitudes between(reflection, body, dense, r_hat, 2), exact(reflection, body, few, r_hat, 1);
  double error = 0, power = 0;
  for (int n = 0; n < static_cast<int>(few.pulse_time_s.size()); ++n) {
    const double z = body.centre(few.pulse_time_s[n]).z();
    for (int b = 0; b < 2; ++b) {
      const double k = 2 * kPi / kSpeedOfLight * (few.first_hz + b * few.step_hz);
      const auto field = [&](const OneWayPaths& at) {
        const Complex direct = std::polar(1.0, k * r_hat.z() * z);
        return at.direct.h * direct + at.image.h / direct;
      };
      error += std::norm(field(between.at(21 * n, b)) - field(exact.at(n, b)));
      power += std::norm(field(exact.at(n, b)));
    }
  }
  EXPECT_LT(std::sqrt(error / power), 0.006);
  std::cout << fmt::format("interpolation {:.4f}\n", std::sqrt(error / power));
}

// The frame of a ship under way moves over the waves.
TEST(SurfacePropagation, AFrameThatMovesOverTheWavesHasThoseAtItsPlace) {
  const WaveField sea = wind_sea(0.5, 4, 2);
  const Vec3 origin(20, -3, 0), velocity(6, 0, 0), place(4, 1, 0.6);
  const IntervalSampling sampling = pulses_every(0.02, 0.05);
  const SeaReflection moving({}, 0.5, WavesBelow{&sea, origin, velocity, 0}),
      fixed({}, 0.5, WavesBelow{&sea, {}, {}, 0});
  const OneWayAmplitudes a(moving, {[&](double) { return place; }, 0.5, 0}, sampling, at_elevation(2));
  const OneWayAmplitudes b(fixed, {[&](double t) { return place + origin + t * velocity; }, 0.5, 0}, sampling,
                           at_elevation(2));
  for (int n = 0; n < 3; ++n) {
    EXPECT_NEAR(std::abs(a.at(n, 0).direct.h - b.at(n, 0).direct.h), 0, 1e-9);
    EXPECT_NEAR(std::abs(a.at(n, 0).image.v - b.at(n, 0).image.v), 0, 1e-9);
  }
}

// A small sphere at rest has the echo F^2 S with the factor F at its centre.
TEST(SurfacePropagation, EchoOfASmallSphereIsItsOwnTimesThePropagationFactorSquared) {
  const WaveField sea = wind_sea(0.5, 4, 2);
  SeaReflectionSpec direct;
  direct.paths = SeaPaths::kDirect;
  const SeaReflection over_waves({}, 0.5, WavesBelow{&sea, {}, {}, 0.005}), alone(direct, 0.5);
  const Scatterer sphere(make_sphere(0.15, 4));
  const Vec3 place(3, 1, 0.7), r_hat = at_elevation(1);
  const IntervalSampling sampling = pulses_every(0.01, 0.06);
  const auto echo = [&](const SeaReflection& reflection, int threads) {
    return solve({.scatterer = sphere,
                  .trajectory = Trajectory::at_rest(place),
                  .r_hat = r_hat,
                  .polarisation = Polarisation::kVv,
                  .sampling = sampling,
                  .sea = &reflection,
                  .threads = threads})
        .response.values;
  };
  const std::vector<Complex> response = echo(over_waves, 1), own = echo(alone, 1);
  const OneWayAmplitudes amplitudes(over_waves, {[&](double) { return place; }, 0.15, 0}, sampling, r_hat);
  for (int n = 0; n < 6; ++n) {
    const OneWayPaths at = amplitudes.at(n, 0);
    const Complex factor = at.direct.v + at.image.v * std::polar(1.0, -2 * kXBand * r_hat.z() * place.z());
    EXPECT_NEAR(std::abs(response[n] / own[n] - factor * factor), 0, 0.02 * std::norm(factor)) << n;
  }
  EXPECT_EQ(response, echo(over_waves, 2));
}

// Echo of a floating sphere of 1 m in blocks of 128 ms: levels of the power over its mean, dB, and the mean velocity.
struct FloatRecord {
  std::vector<double> power_db, velocity_mps;  // power at 5, 25, 50, 75, 95 %
  double velocity_std_mps = 0, correlation_256_ms = 0, scr_db = 0;
};

// A canonical sphere follows the water as a float does, its centre 0.35 m above its waterline (0.5 m^3 of foam and mesh
// float on a twentieth of it), in a head sea. The measured cell contains clutter: sigma0 of the NRL model for hh at 0.6
// deg in waves of 0.9 m, -45.3 dB, on 30 m by the two-way width of a beam of 0.9 deg at 2.66 km, 31 m.
FloatRecord float_record(std::uint64_t seed, double duration_s, double height_m, double period_s) {
  const WaveField sea = wind_sea(height_m, period_s, seed);
  MotionSpec motion;
  motion.model = MotionModel::kFloat;
  motion.translations = true;
  const Vec3 centre(0, 0, 0.35);
  const FloatParticulars body = float_particulars(motion, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}});
  const Trajectory trajectory(0, motion.step_s, simulate_float({body, motion, sea, {0, 0}, 0, seed}, duration_s + 1),
                              centre, -centre);
  const SeaReflection reflection({}, height_m, WavesBelow{&sea, {}, {}, 0.005});
  const IntervalSampling sampling = pulses_every(0.001, duration_s);
  const Vec3 r_hat = at_elevation(0.6), image = image_direction(r_hat);
  const auto place = [&](double time_s) { return trajectory.pose(time_s).p; };
  const OneWayAmplitudes amplitudes(reflection, {place, 0.5, 0}, sampling, r_hat, 2);
  std::vector<Complex> echo;
  for (std::size_t n = 0; n < sampling.pulse_time_s.size(); ++n) {
    const OneWayPaths at = amplitudes.at(static_cast<int>(n), 0);
    const Vec3 p = place(sampling.pulse_time_s[n]);
    const Complex field =
        at.direct.h * std::polar(1.0, kXBand * r_hat.dot(p)) + at.image.h * std::polar(1.0, kXBand * image.dot(p));
    echo.push_back(field * field);
  }
  constexpr std::size_t kBlock = 128;
  std::vector<double> power;
  FloatRecord record;
  double mean_power = 0;
  for (std::size_t first = 0; first + kBlock <= echo.size(); first += kBlock) {
    double sum = 0;
    Complex pair = 0;
    for (std::size_t n = first; n < first + kBlock; ++n) {
      sum += std::norm(echo[n]);
      if (n > first) pair += echo[n] * std::conj(echo[n - 1]);
    }
    power.push_back(sum);
    mean_power += sum;
    record.velocity_mps.push_back(std::arg(pair) / 0.001 / (2 * kXBand));
  }
  mean_power /= static_cast<double>(power.size());
  const double clutter_m2 = std::pow(10, -4.53) * 30 * 31.45, sphere_m2 = kPi * 0.25;
  record.scr_db = 10 * std::log10(mean_power / kBlock * sphere_m2 / clutter_m2);
  const double clutter = kBlock * clutter_m2 / sphere_m2;
  for (double& value : power) value += clutter;
  mean_power += clutter;
  std::ranges::sort(power);
  for (const double p : {0.05, 0.25, 0.5, 0.75, 0.95})
    record.power_db.push_back(10 * std::log10(quantile(power, p) / mean_power));
  const std::vector<double>& v = record.velocity_mps;
  double mean = 0, variance = 0, covariance = 0;
  for (const double value : v) mean += value / static_cast<double>(v.size());
  for (std::size_t i = 0; i + 2 < v.size(); ++i) {
    variance += (v[i] - mean) * (v[i] - mean) / static_cast<double>(v.size() - 2);
    covariance += (v[i] - mean) * (v[i + 2] - mean) / static_cast<double>(v.size() - 2);
  }
  record.velocity_std_mps = std::sqrt(variance);
  record.correlation_256_ms = covariance / variance;
  return record;
}

// Values of a quantity of both measured floats.
std::vector<double> measured_float(const std::string& quantity) {
  std::ifstream file(SEAGLINT_SOURCE_DIR "/tests/reference/sea_clutter/ipix_float.csv");
  for (std::string line; std::getline(file, line);) {
    double a = 0, b = 0;
    if (line.starts_with(quantity + ",") &&
        std::sscanf(line.c_str() + quantity.size(), ",%lf,%lf", &a, &b) == 2)  // NOLINT(cert-err34-c)
      return {a, b};
  }
  ADD_FAILURE() << quantity;
  return {0, 0};
}

// A record of 20 s has four times the scatter of one of 131 s in its levels (ten of these: README.md of the solver,
// "Propagation over the waves").
TEST(SurfacePropagation, FloatInWavesFadesAsTheMeasuredOne) {
  const FloatRecord record = float_record(1, 20.48, 0.9, 4.75);
  constexpr std::array levels{"5", "25", "50", "75", "95"};
  constexpr double kAllowed_db = 3;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::vector<double> measured = measured_float(fmt::format("power_db_{}", levels[i]));
    EXPECT_GT(record.power_db[i], std::ranges::min(measured) - kAllowed_db) << levels[i];
    EXPECT_LT(record.power_db[i], std::ranges::max(measured) + kAllowed_db) << levels[i];
  }
  const double fading_db = record.power_db[4] - record.power_db[0], velocity_mps = record.velocity_std_mps;
  EXPECT_GT(fading_db, 22 - kAllowed_db);
  EXPECT_LT(fading_db, 28 + kAllowed_db);
  EXPECT_GT(velocity_mps, 0.22);
  EXPECT_LT(velocity_mps, 0.40);
  EXPECT_NEAR(record.correlation_256_ms, measured_float("velocity_correlation_0.256_s")[0], 0.2);
  std::cout << fmt::format("float {:.1f} dB above clutter: {:.1f} dB, velocity {:.3f} m/s, correlation {:.2f}\n",
                           record.scr_db, fmt::join(record.power_db, " "), velocity_mps, record.correlation_256_ms);
  record_figure(fading_db, 0, "float_fading_db");
  record_figure(velocity_mps, 2, "float_velocity_mps");
}

}  // namespace
}  // namespace seaglint
