// SPDX-License-Identifier: BSD-3-Clause
// Interpolated values of point scatterers against their sum, and the stated errors against the true ones.
#include "tools/compare/paired_cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"
#include "tests/tools/compare/grid.h"

namespace seaglint {
namespace {

constexpr double kFrequency_hz = 10e9, kWavelength = kSpeedOfLight / kFrequency_hz;
constexpr double kRadius_m = 0.6;

struct Centre {
  Vec3 place;
  Complex amplitude_m;
};

// Equally dense in the sphere.
std::vector<Centre> random_centres(int count, double radius_m, std::uint64_t seed) {
  Random random({seed, Stream::kTest, 0});
  std::vector<Centre> centres;
  while (static_cast<int>(centres.size()) < count) {
    const Vec3 x(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
    const Complex a(random.normal(), random.normal());
    if (x.norm() <= 1) centres.push_back({radius_m * x, a});
  }
  return centres;
}

Complex sum(const std::vector<Centre>& centres, double azimuth_deg, double elevation_deg,
            const DeclaredTransmitter& transmitter) {
  const Vec3 r = direction_to_radar(radians(azimuth_deg), radians(elevation_deg));
  const Vec3 t = transmitter.is_monostatic
                     ? r
                     : direction_to_radar(radians(transmitter.phi_deg), radians(90 - transmitter.theta_deg));
  Complex s = 0;
  for (const Centre& c : centres) s += c.amplitude_m * std::polar(1.0, 2 * kPi / kWavelength * (t + r).dot(c.place));
  return s;
}

double mean_power(const std::vector<Centre>& centres) {
  double power = 0;
  for (const Centre& c : centres) power += std::norm(c.amplitude_m);
  return power;
}

RcsCut cut_of(const std::vector<Centre>& centres, const std::vector<double>& azimuths,
              const std::vector<double>& elevations, const DeclaredTransmitter& transmitter = {}) {
  RcsCut cut;
  cut.name = "centres";
  cut.transmitter = transmitter;
  for (const double el : elevations) {
    for (const double az : azimuths) {
      const Complex s = sum(centres, az, el, transmitter);
      cut.values.push_back({kFrequency_hz, 90 - el, az < 0 ? az + 360 : az, dbsm(s), s, 0});
    }
  }
  return cut;
}

std::vector<ViewPoint> places(const std::vector<double>& azimuths, double elevation_deg) {
  std::vector<ViewPoint> all;
  for (const double az : azimuths) all.push_back({kFrequency_hz, az, elevation_deg});
  return all;
}

// rms error of the interpolated amplitudes relative to the mean level of the centres.
double rms_error(const RcsCut& cut, const std::vector<Centre>& centres) {
  double error = 0;
  for (const FieldValue& v : cut.values)
    error += std::norm(*v.amplitude_m - sum(centres, v.phi_deg, 90 - v.theta_deg, *cut.transmitter));
  return std::sqrt(error / static_cast<double>(cut.values.size()) / mean_power(centres));
}

const double kStep_deg = degrees(kWavelength / (4 * kRadius_m));  // the largest that determines the values

TEST(Interpolation, HasTheStatedStandardError) {
  for (const double fraction : {0.5, 0.7, 0.85}) {
    SCOPED_TRACE(fraction);
    double error = 0;
    InterpolationQuality quality;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const auto centres = random_centres(40, kRadius_m, seed);
      const RcsCut cut = cut_of(centres, grid(0, fraction * kStep_deg, 200), {0});
      const InterpolatedCut found = interpolated_cut(cut, places(grid(30, 0.37, 60), 0), kRadius_m, 2);
      EXPECT_EQ(found.quality.omitted, 0u);
      error += std::pow(rms_error(found.cut, centres), 2) / 20;
      quality = found.quality;
    }
    // The rms of 20 independent sets has a standard error of 1 / sqrt(40) at most: two of them. With fine steps it is
    // lower, since the errors of 1e-4 that are assumed of the samples are absent here.
    EXPECT_LT(std::sqrt(error), 1.32 * quality.standard_error);
    EXPECT_GT(std::sqrt(error), quality.standard_error / 100);
    EXPECT_LT(quality.standard_error, fraction < 0.6 ? 1e-4 : fraction < 0.8 ? 1e-3 : 1e-2);
  }
}

// Each centre alone, also at the edge of the sphere, is reproduced within the stated largest error.
TEST(Interpolation, IsWithinTheLargestErrorOfACentre) {
  const std::vector<ViewPoint> wanted = places(grid(20, 0.11, 40), 0);
  for (const double angle : grid(0, 30, 12)) {
    const std::vector<Centre> centre{
        {kRadius_m * Vec3(std::cos(radians(angle)), std::sin(radians(angle)), 0), Complex(0.6, 0.8)}};
    const InterpolatedCut found =
        interpolated_cut(cut_of(centre, grid(0, 0.7 * kStep_deg, 100), {0}), wanted, kRadius_m, 1);
    // 5 %: the largest error is that of 500 centres on the sphere, 0.16 rad apart.
    for (const FieldValue& v : found.cut.values)
      EXPECT_LE(std::abs(*v.amplitude_m - sum(centre, v.phi_deg, 0, {})), 1.05 * found.quality.largest_error);
    EXPECT_LT(found.quality.largest_error, 0.1);
    EXPECT_GT(found.quality.largest_error, found.quality.standard_error);
  }
}

TEST(Interpolation, OfDirectionsInTwoAnglesAndOfABistaticCut) {
  const auto centres = random_centres(40, kRadius_m, 3);
  const auto angles = grid(0, 0.5 * kStep_deg, 40);
  const InterpolatedCut mono = interpolated_cut(cut_of(centres, angles, grid(0, 0.5 * kStep_deg, 20)),
                                                places(grid(5, 0.3, 20), 3.3), kRadius_m, 1);
  EXPECT_EQ(mono.quality.omitted, 0u);
  EXPECT_LT(rms_error(mono.cut, centres), 0.02);
  EXPECT_LT(rms_error(mono.cut, centres), 3 * mono.quality.standard_error);
  const DeclaredTransmitter transmitter{false, 80, 40};
  const InterpolatedCut bistatic = interpolated_cut(cut_of(centres, grid(0, kStep_deg, 60), {10}, transmitter),
                                                    places(grid(15, 0.3, 60), 10), kRadius_m, 1);
  EXPECT_LT(rms_error(bistatic.cut, centres), 1e-3);
}

// Powers hold the differences of two centres: they need half the step.
TEST(Interpolation, OfLevelsWithoutPhases) {
  const auto centres = random_centres(40, kRadius_m, 4);
  RcsCut cut = cut_of(centres, grid(0, 0.25 * kStep_deg, 400), {0});
  for (FieldValue& v : cut.values) v.amplitude_m.reset();
  const InterpolatedCut found = interpolated_cut(cut, places(grid(20, 0.21, 60), 0), kRadius_m, 1);
  for (const FieldValue& v : found.cut.values) {
    EXPECT_FALSE(v.amplitude_m.has_value());
    EXPECT_NEAR(std::pow(10.0, v.level_dbsm / 10), 4 * kPi * std::norm(sum(centres, v.phi_deg, 0, {})),
                1e-3 * 4 * kPi * mean_power(centres));
  }
}

TEST(Interpolation, KeepsValuesAndOmitsPlacesBeyondThem) {
  const auto centres = random_centres(20, kRadius_m, 5);
  const RcsCut cut = cut_of(centres, grid(0, 0.6 * kStep_deg, 50), {0});
  const InterpolatedCut same = interpolated_cut(cut, places(grid(0, 0.6 * kStep_deg, 50), 0), kRadius_m, 1);
  EXPECT_LT(rms_error(same.cut, centres), 1e-4);
  const InterpolatedCut beyond = interpolated_cut(cut, places(grid(-20, 0.5, 60), 0), kRadius_m, 1);
  EXPECT_GT(beyond.quality.omitted, 35u);
  EXPECT_EQ(beyond.quality.interpolated + beyond.quality.omitted, 60u);
  EXPECT_LT(rms_error(beyond.cut, centres), kLargestInterpolationError);
}

TEST(Interpolation, RefusesDirectionsTooFarApart) {
  const auto centres = random_centres(20, kRadius_m, 6);
  const RcsCut cut = cut_of(centres, grid(0, 2.5 * kStep_deg, 50), {0});
  try {
    interpolated_cut(cut, places(grid(20.1, 2.5 * kStep_deg, 10), 0), kRadius_m, 1);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("needs steps below 0.716 deg at 10 GHz"));
  }
}

}  // namespace
}  // namespace seaglint
