// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/sweep_sum.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/process/parallel.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/observation/frequency_band.h"
#include "sim/scattering/sums/response_grid.h"
#include "sim/scenario/material_spec.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Frequency sweeps: a frequency within a sweep has the echo that it has alone.

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

// Sums of chunks: bits that do not depend on the order in which they are complete, and the grid against a direct sum.

// A sum whose rounding depends on its order.
struct Rounded {
  double value = 0;
  void add(const Rounded& other) { value += other.value; }
};

std::vector<double> terms_of_many_sizes(std::size_t count) {
  Random random({61, Stream::kTest, 0});
  std::vector<double> terms;
  for (std::size_t i = 0; i < count; ++i) terms.push_back(random.normal() * std::pow(10.0, 12 * random.uniform()));
  return terms;
}

TEST(OrderedSum, HasTheBitsOfTheOrderOfChunksInWhateverOrderTheyAreComplete) {
  const std::vector<double> terms = terms_of_many_sizes(6);
  double in_order = 0;
  for (const double term : terms) in_order += term;
  std::vector<std::size_t> order(terms.size());
  std::iota(order.begin(), order.end(), 0);
  std::set<std::uint64_t> unordered;
  do {
    OrderedSum<Rounded> sum({}, terms.size());
    double as_completed = 0;
    for (const std::size_t i : order) {
      sum.chunk(i).value = terms[i];
      sum.complete(i);
      as_completed += terms[i];
    }
    EXPECT_EQ(std::bit_cast<std::uint64_t>(sum.sum().value), std::bit_cast<std::uint64_t>(in_order));
    unordered.insert(std::bit_cast<std::uint64_t>(as_completed));
  } while (std::ranges::next_permutation(order).found);
  EXPECT_GT(unordered.size(), 1u);  // the order of completion would be visible
}

TEST(OrderedSum, HasTheBitsOfOneThreadWithAnyNumberOfThem) {
  const std::vector<double> terms = terms_of_many_sizes(3000);
  double in_order = 0;
  for (const double term : terms) in_order += term;
  for (const int threads : {1, 2, 7}) {
    OrderedSum<Rounded> sum({}, terms.size());
    parallel_for(terms.size(), threads, [&](std::size_t i) {
      sum.chunk(i).value = terms[i];
      sum.complete(i);
    });
    EXPECT_EQ(std::bit_cast<std::uint64_t>(sum.sum().value), std::bit_cast<std::uint64_t>(in_order)) << threads;
  }
}

TEST(OrderedSum, ContainsAChunkOnceItAndAllBeforeItAreCompleteAlsoWhereTheyWereNeverFilled) {
  OrderedSum<Rounded> sum({}, 5);
  sum.chunk(1).value = 10;
  sum.chunk(3).value = 1000;
  sum.complete(3);
  sum.complete(1);
  EXPECT_EQ(sum.sum().value, 0);  // the first is not complete
  sum.complete(0);
  EXPECT_EQ(sum.sum().value, 10);
  sum.complete(2);
  EXPECT_EQ(sum.sum().value, 1010);
  sum.complete(4);
  EXPECT_EQ(sum.sum().value, 1010);
}

// A band's cells are in the order of their first points, so that their sum has to keep the order of chunks.
TEST(OrderedSum, OfBandsHasEqualBitsInWhateverOrderTheyAreComplete) {
  const FrequencyBand band(wavenumber(9.3e9), wavenumber(9.5e9));
  constexpr std::size_t kChunks = 6;
  const auto sum_in = [&](const std::array<std::size_t, kChunks>& order) {
    OrderedSum<BandSum> sum(BandSum(band), kChunks);
    for (const std::size_t chunk : order) {
      Random random({62, Stream::kTest, chunk});
      for (int i = 0; i < 40 && chunk != 4; ++i) {
        Point point;
        point.psi = 3 * random.normal();
        for (Complex& element : point.pattern) element = {random.normal(), random.normal()};
        for (Complex& amplitude : point.amplitude) amplitude = random.normal();
        sum.chunk(chunk).add(point);
      }
      sum.complete(chunk);
    }
    return sum.sum().at(wavenumber(9.37e9));
  };
  const ScatteringMatrix expected = sum_in({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(sum_in({5, 4, 3, 2, 1, 0}), expected);
  EXPECT_EQ(sum_in({2, 0, 5, 4, 1, 3}), expected);
  EXPECT_GT(largest(expected), 0);
}

constexpr int kChannel = kHvChannel;

// Contributions whose phase is constant along them, so short that each is a point, over an interval of look directions.
struct IntervalOfPoints {
  LookDirectionPath path;
  PointBand at{FrequencyBand(40.0), 0, 0.02};
  WavenumberGrid wavenumbers{38, 0.05, 81};
  std::vector<Contribution> contributions;
  Observation observation;

  explicit IntervalOfPoints(double q_limit) {
    Random random({63, Stream::kTest, 0});
    const RadarBasis basis = radar_basis(direction(30, 10));
    path.along_track = {basis.h, Vec3::Zero()};
    path.cross_track = {basis.v, Vec3::Zero()};
    path.s_limit = 0.02;
    path.q_limit = q_limit;
    observation = {.antennas = monostatic(basis), .sense = PathSense::kOneWay};
    for (int i = 0; i < 200; ++i) {
      EdgeInterval interval;
      const Vec3 x(random.normal(), random.normal(), random.normal());
      interval.gradient.fill({x, x});
      interval.psi.fill(2 * x.dot(basis.r));
      interval.length = 0.6 * random.uniform();
      Contribution& contribution = contributions.emplace_back();
      contribution.element = interval;
      for (Complex& element : contribution.pattern.value) element = {random.normal(), random.normal()};
    }
  }
  const EdgeInterval& interval(std::size_t i) const { return *contributions[i].interval(); }
  Complex amplitude(std::size_t i) const { return interval(i).length * contributions[i].pattern.value[kChannel]; }

  // The contributions that are at least `faint` strong, s along the track and q across it, and the sum of their
  // magnitudes; path rates as of a gradient of at most `slide`, m.
  std::pair<Complex, double> direct(double k, double s, double q, double faint, double slide) const {
    Complex sum = 0;
    double size = 0;
    for (std::size_t i = 0; i < contributions.size(); ++i) {
      if (std::abs(amplitude(i)) < faint) continue;
      const Vec3 x = interval(i).gradient[0].transmit;
      const double limit = std::min(1.0, slide / (2 * x.norm()));
      const Vec3 turn = s * path.along_track.transmit + q * path.cross_track.transmit;
      sum += amplitude(i) * std::polar(1.0, k * (interval(i).psi[0] + limit * x.dot(turn)));
      size += std::abs(amplitude(i));
    }
    return {sum, size};
  }

  // In three of nine chunks, of which the first and the last stay empty.
  ResponseGrid grid(double faint, double slide, int threads) const {
    IntervalSum sum(path, at, {faint, slide, 6}, kChannel, 9);
    for (std::size_t i = 0; i < contributions.size(); ++i)
      sum.add(1 + 2 * (i % 3), std::span(&contributions[i], 1), observation);
    return sum.grid(wavenumbers, threads);
  }
};

constexpr double kKernel = 2 * (1e-5 + 7e-7);  // in psi and in u: the kernel, and the table of its values

constexpr double kNoLimit = 1e3;  // m

void expect_direct_sum(const IntervalOfPoints& of, double faint, double slide, double q, double series) {
  const ResponseGrid grid = of.grid(faint, slide, 1);
  for (const double s : {-0.02, -0.007, 0.0, 0.013, 0.02}) {
    std::vector<Complex> response(static_cast<std::size_t>(of.wavenumbers.count));
    grid.response(0, s, q, response);
    for (int n = 0; n < of.wavenumbers.count; n += 8) {
      const auto [sum, size] = of.direct(of.wavenumbers.at(n), s, q, faint, slide);
      EXPECT_LT(std::abs(response[n] - sum), (kKernel + series) * size) << s << ' ' << n;
    }
  }
}

TEST(IntervalSum, OfPointsIsTheirDirectSumAtEveryFrequencyAlongTheTrack) {
  expect_direct_sum(IntervalOfPoints(0), 0, kNoLimit, 0, 0);
}

TEST(IntervalSum, OfPointsIsTheirDirectSumAcrossTheTrackToTheOmittedTermOfTheSeries) {
  // k v q up to 42 x 6 x 0.004 = 1.01: the first term that is left out is 1.01^5 / 5!.
  expect_direct_sum(IntervalOfPoints(0.004), 0, kNoLimit, 0.004, std::pow(1.01, 5) / 120);
}

TEST(IntervalSum, LeavesOutContributionsThatAreFaint) {
  const IntervalOfPoints of(0);
  constexpr double kFaint = 0.2;
  EXPECT_LT(of.direct(40, 0, 0, kFaint, kNoLimit).second, of.direct(40, 0, 0, 0, kNoLimit).second - 1);
  expect_direct_sum(of, kFaint, kNoLimit, 0, 0);
}

TEST(IntervalSum, LimitsThePathRateToThatOfTheLongestGradient) {
  const IntervalOfPoints of(0);
  constexpr double kSlide = 2;  // m, the median of 2 |x| being 3.1
  const auto [limited, size] = of.direct(40, 0.02, 0, 0, kSlide);
  EXPECT_GT(std::abs(limited - of.direct(40, 0.02, 0, 0, kNoLimit).first), 10 * kKernel * size);
  expect_direct_sum(of, 0, kSlide, 0, 0);
}

TEST(IntervalSum, HasTheSameBitsForAnyNumberOfThreads) {
  const IntervalOfPoints of(0.004);
  const auto response = [&](int threads) {
    std::vector<Complex> values(static_cast<std::size_t>(of.wavenumbers.count));
    of.grid(0, kNoLimit, threads).response(0, 0.01, 0.003, values);
    return values;
  };
  const std::vector<Complex> one = response(1);
  for (const int threads : {2, 5}) EXPECT_EQ(response(threads), one) << threads;
}

}  // namespace
}  // namespace seaglint
