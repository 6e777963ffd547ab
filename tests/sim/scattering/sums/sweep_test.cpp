// SPDX-License-Identifier: BSD-3-Clause
// Frequency sweeps: a frequency within a sweep has the echo that it has alone.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/sums/sweep_sum.h"
#include "sim/scenario/material_file.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;
using Sweep = std::function<Matrices(std::span<const double>)>;

// Interpolation over cells of path length and over amplitudes (kCellHalfPhase), of every contribution; weak
// contributions that are left out below a tenth of the smallest patch differ with the lowest frequency: 1e-4.
constexpr double kInterpolation = 9e-5, kOmitted = 1e-4;

// Frequencies of the two sweeps: 40 equidistant ones of 200 MHz, and 161 of 2 to 18 GHz at random distances and in
// random order.
std::vector<double> narrow_band() {
  std::vector<double> k;
  for (int q = 0; q < 40; ++q) k.push_back(wavenumber(9.3e9 + 200e6 * q / 39));
  return k;
}
std::vector<double> wide_band() {
  Random random({5, Stream::kTest, 0});
  std::vector<double> k;
  for (int q = 0; q < 161; ++q) k.push_back(wavenumber(2e9 * std::pow(9.0, random.uniform())));
  return k;
}

// Largest difference between some frequencies of the sweep and the same ones alone, relative to the rms of the largest
// element over these.
double error_against_single_frequencies(const Sweep& sweep, const std::vector<double>& wavenumbers) {
  const Matrices together = sweep(wavenumbers);
  double error = 0, power = 0;
  int count = 0;
  for (std::size_t q = 0; q < wavenumbers.size(); q += wavenumbers.size() / 6, ++count) {
    const std::array<Complex, 4> alone = sweep(std::span(&wavenumbers[q], 1)).front();
    for (int i = 0; i < 4; ++i) error = std::max(error, std::abs(together[q][i] - alone[i]));
    power += largest(alone) * largest(alone);
  }
  return error / std::sqrt(power / count);
}

void expect_equal_alone_and_in_a_sweep(const char* name, const Sweep& sweep) {
  const double narrow = error_against_single_frequencies(sweep, narrow_band()),
               wide = error_against_single_frequencies(sweep, wide_band());
  fmt::print("{}: {:.1e} over 200 MHz, {:.1e} over 2 to 18 GHz\n", name, narrow, wide);
  EXPECT_LT(narrow, kInterpolation + kOmitted) << name;
  EXPECT_LT(wide, kInterpolation + kOmitted) << name;
}

Sweep monostatic_sweep(const Scatterer& scatterer, const Vec3& r, bool edges, double range_m = 0) {
  return [&scatterer, r, edges, range_m](std::span<const double> k) {
    return scattering_matrices(scatterer, monostatic(radar_basis(r)), k, {0, 8, edges}, 1, {range_m});
  };
}

// A ball beside a corner of plates, which reflects it.
TriangleMesh ball_and_corner() {
  TriangleMesh mesh = stepped_corner();
  mesh.append(transformed(make_sphere(0.12, 3), Mat3::Identity(), {0.25, 0.1, 0.3}));
  return mesh;
}

TEST(BandSum, OfPointsIsTheirDirectSumAtEveryFrequency) {
  Random random({3, Stream::kTest, 0});
  const FrequencyBand band(wavenumber(9.3e9), wavenumber(9.5e9));
  std::vector<Point> points(300);
  BandSum sum(band);
  for (Point& point : points) {
    point.psi = 80 * (random.uniform() - 0.5);
    for (Complex& element : point.pattern) element = std::polar(random.uniform(), 2 * kPi * random.uniform());
    for (std::size_t n = 0; n < kBandNodes; ++n) point.amplitude[n] = 1 / band.nodes()[n];
    sum.add(point);
  }
  for (const double hz : {9.3e9, 9.333e9, 9.4e9, 9.47e9, 9.5e9}) {
    const double k = wavenumber(hz);
    const std::array<Complex, 4> of_sum = sum.at(k);
    for (int i = 0; i < 4; ++i) {
      Complex direct = 0;
      double size = 0;
      for (const Point& point : points) {
        direct += std::polar(1 / k, k * point.psi) * point.pattern[i];
        size += std::abs(point.pattern[i]) / k;
      }
      EXPECT_LT(std::abs(of_sum[i] - direct), 0.0058 * std::pow(kCellHalfPhase, 4) * size) << hz;
    }
  }
}

TEST(SweepPlan, BandsHoldEveryFrequencyOnceAndFewNodes) {
  const Scatterer plate(make_plate(0.3, 0.2));
  for (const std::vector<double>& k : {narrow_band(), wide_band(), std::vector<double>(7, 300.0)}) {
    const SweepPlan plan(plate, k);
    std::vector<int> held(k.size());
    for (const SweepPlan::Band& band : plan.bands()) {
      for (const std::size_t q : band.points) {
        ++held[q];
        const FormRange form = form_range(k[q]);
        EXPECT_GE(k[q], form.lowest);
        EXPECT_LT(k[q], form.highest);
        EXPECT_EQ(form.lowest, band.band.form().lowest);
        EXPECT_LE(std::abs(k[q] - band.band.centre()), band.band.half_width() * (1 + 1e-12));
      }
    }
    EXPECT_TRUE(std::ranges::all_of(held, [](int times) { return times == 1; }));
  }
  EXPECT_LE(SweepPlan(plate, narrow_band()).nodes().size(), 2 * kBandNodes);
  EXPECT_EQ(SweepPlan(plate, std::vector<double>(7, 300.0)).nodes().size(), 1u);
}

TEST(Sweep, HasTheEchoOfEveryFrequencyAlone) {
  const Scatterer reflector(make_icosahedral_reflector()), curved(ball_and_corner());
  expect_equal_alone_and_in_a_sweep("flat", monostatic_sweep(reflector, direction(20, 5), false));
  expect_equal_alone_and_in_a_sweep("edges", monostatic_sweep(Scatterer(stepped_corner()), direction(35, 25), true));
  expect_equal_alone_and_in_a_sweep("curved", monostatic_sweep(curved, direction(38, 20), true));
  expect_equal_alone_and_in_a_sweep("finite_range", monostatic_sweep(curved, direction(38, 20), true, 30));
  expect_equal_alone_and_in_a_sweep("bistatic", [&](std::span<const double> k) {
    return scattering_matrices(curved, bistatic(radar_basis(direction(38, 20)), radar_basis(direction(20, 30))), k,
                               {0, 8, true});
  });
  const SeaReflection sea({}, 0.2);
  expect_equal_alone_and_in_a_sweep("over_the_sea", [&](std::span<const double> k) {
    return matrices_over_sea(curved, direction(38, 4), {sea, 2}, k, {0, 8, true});
  });
}

TEST(Sweep, HasTheCoefficientsOfMaterialsAtEveryFrequency) {
  for (const char* name : {"ram_loaded_epoxy", "grp_sheet", "sea_water"}) {
    TriangleMesh mesh = ball_and_corner();
    mesh.materials = {{name}};
    std::ranges::fill(mesh.triangle_material, 0);
    const Scatterer coated(mesh,
                           {read_material(SEAGLINT_SOURCE_DIR "/assets/materials/" + std::string(name) + ".yaml")});
    expect_equal_alone_and_in_a_sweep(name, monostatic_sweep(coated, direction(38, 20), true));
  }
}

TEST(Sweep, OfAPlateIsItsClosedFormOverTheBand) {
  // Physical optics of a plate in x = 0 at azimuth phi: -(jk / 2 pi) 2 a b cos(phi) sinc(k a sin(phi)), from the
  // centre.
  const double a = 1.5, b = 0.4;
  const Scatterer plate(make_plate(a, b));
  for (const double azimuth : {0.0, 0.4, 12.0}) {
    const double phi = radians(azimuth);
    for (const std::vector<double>& ks : {narrow_band(), wide_band()}) {
      const Matrices s = scattering_matrices(plate, monostatic(radar_basis(direction(azimuth, 0))), ks, {0, 1});
      for (std::size_t q = 0; q < ks.size(); ++q) {
        const double k = ks[q], x = k * a * std::sin(phi), size = k * a * b / (2 * kPi);
        const double expected = size * std::cos(phi) * (x == 0 ? 1 : std::sin(x) / x);
        // 1e-6 rad of the look direction in the plane of the edges changes the phase by k a 1e-6.
        EXPECT_NEAR(std::abs(s[q][kVvChannel]), std::abs(expected), (kInterpolation + 1e-6 * k * a) * size) << azimuth;
      }
    }
  }
}

TEST(Sweep, HasTheSameBitsForAnyNumberOfThreads) {
  const Scatterer curved(ball_and_corner());
  const BistaticGeometry pair = monostatic(radar_basis(direction(38, 20)));
  const std::vector<double> k = wide_band();
  const Matrices one = scattering_matrices(curved, pair, k, {0, 8, true}, 1);
  for (const int threads : {2, 5}) EXPECT_EQ(one, scattering_matrices(curved, pair, k, {0, 8, true}, threads));
}

}  // namespace
}  // namespace seaglint
