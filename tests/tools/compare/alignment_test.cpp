// SPDX-License-Identifier: BSD-3-Clause
// Phase, origin, conjugation and signs that were put into amplitudes are found again.
#include "tools/compare/alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/scattering/observation/observation.h"
#include "tests/tools/compare/grid.h"

namespace seaglint {
namespace {

// In this order by any compiler.
Complex complex_normal(Random& random) {
  const double im = random.normal();
  return {random.normal(), im};
}

// Points of a sweep; the computed amplitudes are those of seven point scatterers within a box of 2 x 1 x 0.6 m.
std::vector<AlignmentPoint> sweep(const std::vector<double>& ghz, const std::vector<double>& azimuths,
                                  const std::vector<double>& elevations, const std::vector<std::size_t>& elements) {
  std::vector<AlignmentPoint> points;
  Random random({5, Stream::kTest, 1});
  std::vector<std::pair<Vec3, std::array<Complex, 4>>> scatterers;
  for (int n = 0; n < 7; ++n) {
    const double z = 0.6 * random.uniform(), y = random.uniform() - 0.5;
    const Vec3 place(2 * random.uniform() - 1, y, z);
    std::array<Complex, 4> s;
    for (Complex& value : s) value = complex_normal(random);
    scatterers.emplace_back(place, s);
  }
  for (const std::size_t element : elements) {
    for (const double el : elevations) {
      for (const double az : azimuths) {
        for (const double f : ghz) {
          AlignmentPoint p{element, f * 1e9, az, el, {}, 0, 0, Vec3::Zero()};
          p.path_gradient = 4 * kPi * p.frequency_hz / kSpeedOfLight * direction_to_radar(radians(az), radians(el));
          for (const auto& [place, s] : scatterers)
            p.computed_m += s[element] * std::polar(1.0, p.path_gradient.dot(place));
          p.reference_m = p.computed_m;
          points.push_back(p);
        }
      }
    }
  }
  return points;
}

// The reference as another program would write it: 0.7 dB higher, about another origin, with a constant phase, with
// noise 30 dB below the mean power.
void disturb(std::vector<AlignmentPoint>& points, const Vec3& origin, double phase, bool conjugate, int vv_sign) {
  Random random({6, Stream::kTest, 1});
  double power = 0;
  for (const AlignmentPoint& p : points) power += std::norm(p.computed_m);
  const double noise = std::sqrt(power / static_cast<double>(points.size()) * 1e-3 / 2);
  for (AlignmentPoint& p : points) {
    p.reference_m = p.computed_m * std::pow(10.0, 0.7 / 20) * std::polar(1.0, phase - p.path_gradient.dot(origin)) +
                    noise * complex_normal(random);
    if (p.element == 3) p.reference_m *= vv_sign;
    if (conjugate) p.reference_m = std::conj(p.reference_m);
  }
}

TEST(Alignment, FindsWhatAnotherProgramsConventionsChange) {
  auto points = sweep(grid(9, 0.05, 21), grid(0, 0.5, 121), {2, 5}, {0, 3});
  const Vec3 origin(0.31, -0.2, 0.05);
  disturb(points, origin, 0.8, true, -1);
  const Alignment found = fit_alignment(points, 2);
  const double wavelength = kSpeedOfLight / 10e9;
  EXPECT_TRUE(found.conjugated);
  EXPECT_EQ(found.sign[0], 1);
  EXPECT_EQ(found.sign[3], -1);
  EXPECT_LT((found.origin_m - origin).norm(), wavelength / 50);
  EXPECT_LT((found.origin_m - origin).cwiseAbs().maxCoeff(), 5 * found.origin_error_m.maxCoeff());
  EXPECT_NEAR(found.phase_rad, 0.8, 0.01);
  EXPECT_NEAR(found.level_db, 0.7, 0.05);
  EXPECT_GT(found.correlation, 0.999);
  EXPECT_LT(found.other_correlation, 0.5);
  EXPECT_THAT(found.undetermined, testing::IsEmpty());
  double error = 0, power = 0;
  for (const AlignmentPoint& p : points) {
    error += std::norm(aligned(found, p) - std::pow(10.0, 0.7 / 20) * p.computed_m);
    power += std::norm(p.computed_m);
  }
  EXPECT_LT(std::sqrt(error / power), 0.05);
}

TEST(Alignment, LeavesAnOriginThatIsRight) {
  auto points = sweep({10}, grid(-30, 0.5, 121), {3}, {0});
  const Alignment found = fit_alignment(points, 2);
  EXPECT_FALSE(found.conjugated);
  EXPECT_NEAR(found.correlation, 1, 1e-12);
  EXPECT_LT(found.origin_m.norm(), 1e-9);
}

// A file of the other time factor that states its phase origin: nothing of it is left to fit.
TEST(Alignment, TurnsTheStatedOriginOfTheOtherTimeFactor) {
  auto points = sweep(grid(9, 0.05, 21), grid(0, 0.5, 121), {2, 5}, {0});
  const Vec3 stated(0.31, -0.2, 0.05);
  for (AlignmentPoint& p : points) {
    const Complex as_written = std::conj(p.computed_m * std::polar(1.0, -p.path_gradient.dot(stated)));
    p.reference_m = as_written * std::polar(1.0, p.path_gradient.dot(stated));
    p.stated_origin_m = stated;
  }
  const Alignment found = fit_alignment(points, 1);
  EXPECT_TRUE(found.conjugated);
  EXPECT_NEAR(found.correlation, 1, 1e-9);
  EXPECT_LT(found.origin_m.norm(), 1e-6);
  for (const AlignmentPoint& p : points) EXPECT_NEAR(std::abs(aligned(found, p) - p.computed_m), 0, 1e-3);
}

// A target whose reference has another scatterer at +-0.8 m: whatever origin fits its phases best, none at all is a
// choice, too.
TEST(Alignment, CorrelatesNoWorseThanWithoutAnOrigin) {
  for (int seed = 0; seed < 40; ++seed) {
    std::vector<AlignmentPoint> points = sweep(grid(9.8, 0.1, 5), grid(0, 1, 41), {5}, {3});
    Random random({7, Stream::kTest, static_cast<std::uint64_t>(seed)});
    const Vec3 place(1.6 * random.uniform() - 0.8, 1.6 * random.uniform() - 0.8, 0);
    Complex sum = 0;
    double computed = 0, reference = 0;
    for (AlignmentPoint& p : points) {
      p.reference_m += 3.0 * std::polar(1.0, p.path_gradient.dot(place));
      sum += p.reference_m * std::conj(p.computed_m);
      computed += std::norm(p.computed_m);
      reference += std::norm(p.reference_m);
    }
    EXPECT_GE(fit_alignment(points, 1).correlation, std::abs(sum) / std::sqrt(computed * reference) - 1e-9) << seed;
  }
}

// One elevation and one frequency: a shift along z is a constant phase.
TEST(Alignment, NamesWhatTheDataDoNotDetermine) {
  auto points = sweep({10}, grid(0, 1, 360), {0}, {0});
  const Vec3 origin(0.05, -0.1, 0.07);
  disturb(points, origin, 0, false, 1);
  const Alignment circle = fit_alignment(points, 2);
  ASSERT_EQ(circle.undetermined.size(), 1u);
  EXPECT_NEAR(std::abs(circle.undetermined[0].z()), 1, 1e-9);
  EXPECT_LT((circle.origin_m - Vec3(0.05, -0.1, 0)).norm(), kSpeedOfLight / 10e9 / 50);
  auto one_direction = sweep(grid(9, 0.01, 101), {20}, {0}, {0});
  disturb(one_direction, origin, 0, false, 1);
  const Alignment range = fit_alignment(one_direction, 2);
  EXPECT_EQ(range.undetermined.size(), 2u);
  const Vec3 r = direction_to_radar(radians(20), 0);
  EXPECT_NEAR(range.origin_m.dot(r), origin.dot(r), 5 * range.origin_error_m.norm());
}

// A far origin, of which neighbouring angles turn the phase by up to half a turn.
TEST(Alignment, FindsAFarOrigin) {
  auto points = sweep(grid(9.5, 0.02, 11), grid(0, 0.5, 41), {2}, {0});
  const Vec3 origin(-0.7, 0.6, 0);
  disturb(points, origin, -2, false, 1);
  const Alignment found = fit_alignment(points, 2);
  EXPECT_FALSE(found.conjugated);
  EXPECT_LT((found.origin_m - origin).xy().norm(), kSpeedOfLight / 9.7e9 / 50);
  // One elevation leaves a direction undetermined that is not quite the vertical: the origin's component along it is 0.
  ASSERT_EQ(found.undetermined.size(), 1u);
  const Vec3 axis = found.undetermined[0], determined = origin - axis * axis.dot(origin);
  EXPECT_LT((found.origin_m - determined).norm(), 4 * found.origin_error_m.norm());
}

}  // namespace
}  // namespace seaglint
