// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/random.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scattering/points/decomposition.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Edges of sheets of finite thickness: against integral equations, reciprocity, continuity and symmetry.

WedgeFrame edge_of(double thickness_m) {
  const Vec3 x = Vec3::UnitX(), n = Vec3::UnitY(), t = x.cross(n);
  return {{{x, n, t}, {x, -n, -t}}, 2, thickness_m};
}

Scatterer strip(double height_m, double thickness_m) {
  return Scatterer(make_plate(0.2667, height_m), {}, radians(kDefaultCreaseDeg), thickness_m);
}

Vec3 any_direction(Random& random) {
  const double z = 2 * random.uniform() - 1, angle = 2 * kPi * random.uniform();
  return {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
}

Vec3 any_field(Random& random, const Vec3& direction) { return any_direction(random).cross(direction).normalized(); }

Vec3 about_the_edge(double angle_from_extension) {
  return {-std::cos(angle_from_extension), std::sin(angle_from_extension), 0};
}

struct Deviation {
  double relative = 0, mean_db = 0;  // of the field in L2; of its level up to 60 deg
};

// Difference of the echoes of upright strips of 4 m and 2 m height and 9.1 wavelengths width, against the integral
// equations of the infinite strip, over all pairs of directions that `wanted` selects.
template <typename Selected>
Deviation against_integral_equations(double thickness_mm, bool soft, const Selected& selected) {
  const double k = wavenumber(10.24e9), height = 2;
  const Scatterer one = strip(height, 1e-3 * thickness_mm), two = strip(2 * height, 1e-3 * thickness_mm);
  RelativeError error;
  double decibels = 0;
  int count = 0;
  for (const auto& row : read_csv("strip.csv")) {
    const double transmit = std::stod(row[1]), receive = std::stod(row[2]);
    if (std::stod(row[0]) != thickness_mm || !selected(transmit, receive)) continue;
    const Complex reference(std::stod(row[soft ? 3 : 5]), std::stod(row[soft ? 4 : 6]));
    const BistaticGeometry geometry =
        transmit == receive ? monostatic(radar_basis(direction(receive, 0)))
                            : bistatic(radar_basis(direction(transmit, 0)), radar_basis(direction(receive, 0)));
    const auto echo_of = [&](const Scatterer& target) {
      return scattering_matrices(target, geometry, std::array{k}, {0, 8, true})[0][soft ? kVvChannel : kHhChannel];
    };
    // S per metre is j P / pi, of the hard wave with H opposite to the axis; the sheet is meshed t/2 in front of its
    // middle.
    const double before_middle = 0.5e-3 * thickness_mm * (std::cos(radians(transmit)) + std::cos(radians(receive)));
    const Complex P =
        (soft ? 1.0 : -1.0) * (echo_of(two) - echo_of(one)) / height * kPi / kJ * std::polar(1.0, k * before_middle);
    error.add(P, reference);
    if (std::abs(receive) > 60) continue;
    decibels += std::abs(20 * std::log10(std::abs(P) / std::abs(reference)));
    ++count;
  }
  const Deviation deviation{error.value(), decibels / count};
  std::printf("%g mm %s: relative %.5f, mean to 60 deg %.3f dB\n", thickness_mm, soft ? "soft" : "hard",
              deviation.relative, deviation.mean_db);
  return deviation;
}

// Limits by thickness: without one, the fifth and higher orders of diffraction; else the next order, (k t)^2 of the
// field times 0.06 to 0.03 (soft) and 0.15 to 0.06 (hard, which is diffracted at two edges on each path along the
// strip), decreasing as a logarithm of k t. Without the thickness term the errors are 0.64 and 1.2 dB at 1.6 mm.
TEST(ThickEdge, OfStripsMatchesIntegralEquations) {
  struct Case {
    double t_mm, soft, hard;  // largest relative errors, 0 to 90 deg
  };
  const auto backscatter = [](double transmit, double receive) { return transmit == receive; };
  for (const Case& limits : {Case{0, 0.0005, 0.0005}, {0.5, 0.001, 0.002}, {1.6256, 0.006, 0.012}, {3, 0.015, 0.03}}) {
    for (const bool soft : {true, false}) {
      const Deviation found = against_integral_equations(limits.t_mm, soft, backscatter);
      EXPECT_LT(found.relative, soft ? limits.soft : limits.hard) << limits.t_mm;
      const int thickness_um = static_cast<int>(1e3 * limits.t_mm);
      record_figure(found.relative, thickness_um == 0 ? 5 : 4, "strip_{}_um_{}", thickness_um, soft ? "soft" : "hard");
      record_figure(found.mean_db, thickness_um == 0 ? 3 : 2, "strip_{}_um_{}_mean_db", thickness_um,
                    soft ? "soft" : "hard");
    }
  }
}

// Bistatic echo to 75 deg from the normal: physical optics is not reciprocal there, its sum with the fringe currents
// must be. Soft waves at grazing incidence on the strip (slope diffraction) leave 0.2 % from 51 deg.
TEST(ThickEdge, OfStripsMatchesIntegralEquationsForOtherReceivers) {
  for (const double transmit : {21.0, 51.0}) {
    const auto from = [&](double at, double receive) { return at == transmit && receive != at; };
    for (const double t_mm : {0.0, 1.6256}) {
      const double limit = t_mm > 0 ? 0.008 : 0.003;
      for (const bool soft : {true, false}) {
        const Deviation found = against_integral_equations(t_mm, soft, from);
        EXPECT_LT(found.relative, limit) << transmit;
        const int thickness_um = static_cast<int>(1e3 * t_mm);
        record_figure(found.relative, thickness_um == 0 ? 5 : 4, "strip_{}_um_from_{}_deg_{}", thickness_um, transmit,
                      soft ? "soft" : "hard");
        if (thickness_um > 0) {
          record_figure(found.mean_db, 2, "strip_{}_um_from_{}_deg_{}_mean_db", thickness_um, transmit,
                        soft ? "soft" : "hard");
        }
      }
    }
  }
}

TEST(ThickEdge, IsReciprocal) {
  const WedgeFrame edge = edge_of(1e-3);
  Random random({11, Stream::kTest, 41});
  for (int i = 0; i < 200; ++i) {
    const Vec3 in = any_direction(random), out = any_direction(random);
    const Vec3 E = any_field(random, in), p = any_field(random, out);
    const auto forward = thick_edge_currents(edge, in, {E, E}, out)[0],
               reversed = thick_edge_currents(edge, -out, {p, p}, -in)[0];
    const Complex a = p.dot(forward.constant), b = E.dot(reversed.constant);
    EXPECT_LT(std::abs(a - b), 1e-9 * (1 + std::abs(a))) << i;
    EXPECT_LT(std::abs(Complex(p.dot(forward.logarithm)) - Complex(E.dot(reversed.logarithm))),
              1e-12 * (1 + std::abs(a)))
        << i;
  }
}

// At the reflection and the incident shadow boundary and in the sheet's plane the closed forms are 0/0: there the
// currents equal the mean of adjacent ones up to the square of the distance times a curvature of 30 at 0.1 rad from the
// plane.
TEST(ThickEdge, HasNoJumps) {
  const WedgeFrame edge = edge_of(1e-3);
  const auto response = [&](double phi, double phi_in) {
    const Vec3 in = -about_the_edge(phi_in), s = about_the_edge(phi), z = Vec3::UnitZ();
    const auto currents = thick_edge_currents(edge, in, {z, z.cross(in)}, s);
    return std::array{Complex(z.dot(currents[0].constant)), Complex(z.cross(s).dot(currents[1].constant))};
  };
  for (double phi_in = 0.1; phi_in < kPi - 0.1; phi_in += 0.1) {
    for (const double phi : {kPi - phi_in, phi_in - kPi}) {
      constexpr double kOffset = 1e-3;
      const auto at = response(phi, phi_in), before = response(phi - kOffset, phi_in),
                 after = response(phi + kOffset, phi_in);
      for (int i = 0; i < 2; ++i)
        EXPECT_LT(std::abs(at[i] - 0.5 * (before[i] + after[i])), 3e-5) << phi_in << ' ' << phi << ' ' << i;
    }
  }
  for (const double phi_in : {0.0, 1e-9, 1e-5, 1.0, kPi - 1e-5, kPi}) {
    for (const double phi : {0.0, 1e-9, 1e-5, 1.0, kPi - 1e-5, kPi, -1e-9, -1.0, -kPi + 1e-5})
      for (const Complex& x : response(phi, phi_in)) EXPECT_LT(std::abs(x), 10) << phi_in << ' ' << phi;
  }
  const Vec3 along = Vec3::UnitZ();
  const auto end_on = thick_edge_currents(edge, along, {Vec3::UnitX(), Vec3::UnitY()}, -along);
  EXPECT_TRUE(std::isfinite(norm_of(end_on[0].constant)) && std::isfinite(norm_of(end_on[1].constant)));
}

// Either side of a sheet is its illuminated face: a rotated sheet has the same echo, but for the tilt of 1e-7 rad of
// face-grazing diffracted waves towards their face (3e-7 m, also without thickness).
TEST(ThickEdge, IsTheSameFromEitherSide) {
  const Scatterer plate = strip(0.1524, 1.6e-3);
  const double k = wavenumber(10.24e9);
  for (const double azimuth : {3.0, 37.0, 81.0}) {
    const auto front = echo(plate, radar_basis(direction(azimuth, 12)), k, 0, 8, true),
               reversed = echo(plate, radar_basis(direction(180 - azimuth, 12)), k, 0, 8, true);
    EXPECT_LT(std::abs(front[kHhChannel] - reversed[kHhChannel]), 1e-6) << azimuth;
    EXPECT_LT(std::abs(front[kVvChannel] - reversed[kVvChannel]), 1e-6) << azimuth;
    EXPECT_LT(std::abs(front[kHvChannel] + reversed[kHvChannel]), 1e-6) << azimuth;
  }
}

// The points of an interval contain the thickness term at their carrier (patterns are stored in single precision).
TEST(ThickEdge, IsInTheContributionsOfAnAspect) {
  const Scatterer plate = strip(0.1524, 1.6e-3), thin = strip(0.1524, 0);
  const double k = wavenumber(10.24e9);
  const RadarBasis basis = radar_basis(direction(33, 7));
  const TracingSettings settings{0, 8, true};
  const auto sum = direct_sum(points_of(plate, monostatic(basis), k, 1e-3, settings).points, k, Vec3::Zero());
  const auto matrix = echo(plate, basis, k, 0, 8, true), without = echo(thin, basis, k, 0, 8, true);
  for (const int channel : {kHhChannel, kVvChannel}) {
    EXPECT_LT(std::abs(sum[channel] - matrix[channel]), 1e-5 * largest(matrix));
    EXPECT_GT(std::abs(without[channel] - matrix[channel]), 0.03 * largest(matrix));
  }
}

// Weights of complementary forms sum to one, for the directions as each form computes its own.

constexpr double kRounding = 1e-12;

Vec3 reflected(const Vec3& x, const Vec3& n) { return x - 2 * n.dot(x) * n; }

// A wall 1 m high on a deck of 6 x 6 m.
struct WallOnDeck {
  std::vector<Vec3> deck{{3, -3, 0}, {3, 3, 0}, {-3, 3, 0}, {-3, -3, 0}}, wall;
  Vec3 wall_normal;

  explicit WallOnDeck(double lean) : wall_normal(std::cos(lean), 0, std::sin(lean)) {
    const Vec3 up(-std::sin(lean), 0, std::cos(lean));
    wall = {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0, 1, 0) + up, Vec3(0, -1, 0) + up};
  }
  ReflectorPanel deck_panel() const { return {Vec3::UnitZ(), deck}; }
  ReflectorPanel wall_panel() const { return {wall_normal, wall}; }
};

Vec3 random_direction(Random& random, double highest_sine) {
  const double sine = highest_sine * random.uniform(), azimuth = 2 * kPi * random.uniform();
  const double cosine = std::sqrt(1 - sine * sine);
  return {cosine * std::cos(azimuth), cosine * std::sin(azimuth), sine};
}

TEST(PathWeights, PathAndReciprocalSumToTwo) {
  Random random({1, Stream::kTest, 0});
  int replaced = 0;
  for (int i = 0; i < 2000; ++i) {
    const WallOnDeck body(0.3 * (random.uniform() - 0.5));
    const Vec3 r = random_direction(random, 0.2);
    const double by_deck = double_bounce_weight(r, body.wall_panel(), body.deck_panel()),
                 by_wall = double_bounce_weight(r, body.deck_panel(), body.wall_panel());
    EXPECT_NEAR(by_deck + by_wall, 2, kRounding);
    EXPECT_GE(std::min(by_deck, by_wall), 0);
    replaced += by_deck < 0.5;
  }
  EXPECT_GT(replaced, 100);
}

TEST(PathWeights, PathAndImageSumToOne) {
  Random random({2, Stream::kTest, 0});
  int images = 0;
  for (int i = 0; i < 2000; ++i) {
    const WallOnDeck body(0.3 * (random.uniform() - 0.5));
    const Vec3 r = random_direction(random, 0.2);
    const double image = image_weight(r, body.deck_panel(), body.wall_panel());
    EXPECT_NEAR(multiple_bounce_weight(r, body.deck_panel(), body.wall_panel(), body.deck_panel()) + image, 1,
                kRounding);
    images += image > 0.5;
  }
  EXPECT_GT(images, 100);
}

// Edge of a deck along y with an upright wall behind it: incident from r, via the wall back to r.
TEST(PathWeights, EdgeFieldAndPenumbraSumToOne) {
  int both = 0;
  for (double sine = 0.001; sine < 0.99; sine += 0.001) {
    const Vec3 r(std::sqrt(1 - sine * sine), 0, sine), wall = Vec3::UnitX(), via_wall = reflected(r, wall);
    const double edge = reflected_edge_weight(Vec3::UnitZ(), Vec3::UnitY(), -r, via_wall, wall);
    const PenumbraWeights penumbra = penumbra_weights(sine);
    EXPECT_NEAR(edge + penumbra.foot, 1, kRounding) << sine;
    EXPECT_NEAR(grazing_wave_weight(-r, via_wall) + penumbra.edge_path, 1, kRounding) << sine;
    both += edge > 0.01 && edge < 0.99;
  }
  EXPECT_GT(both, 10);
}

}  // namespace
}  // namespace seaglint
