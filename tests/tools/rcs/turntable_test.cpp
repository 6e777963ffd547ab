// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/turntable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/geometry/look_basis.h"
#include "tests/refusal.h"
#include "tests/tools/compare/grid.h"
#include "tools/rcs/rcs_views.h"
#include "tools/rcs/turntable_figure.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

struct IdealPoint {
  Vec3 place_m;
  double area_m2 = 1;
};

// S = sum of a e^{+j 2k r^.x} (CONVENTIONS.md), a of its cross-section.
TurntableEcho echo_of(const std::vector<IdealPoint>& points, std::vector<double> frequency_hz,
                      std::vector<double> azimuth_deg, double elevation_deg = 0) {
  TurntableEcho echo{std::move(frequency_hz), std::move(azimuth_deg), elevation_deg, {}};
  for (const double azimuth : echo.azimuth_deg) {
    const Vec3 r = direction_to_radar(radians(azimuth), radians(elevation_deg));
    for (const double f : echo.frequency_hz) {
      Complex sum = 0;
      for (const IdealPoint& point : points)
        sum += std::sqrt(point.area_m2 / (4 * kPi)) *
               std::polar(1.0, 2 * (2 * kPi * f / kSpeedOfLight) * r.dot(point.place_m));
      echo.amplitude_m.push_back(sum);
    }
  }
  return echo;
}

// The highest cell within 1.5 m of a place of the image.
struct Peak {
  double range_m = 0, cross_m = 0, dbsm = -1e300;
};

Peak peak_near(const TurntableImage& image, double range_m, double cross_m) {
  Peak peak;
  for (std::size_t j = 0; j < image.cross_m.size(); ++j) {
    for (std::size_t i = 0; i < image.range_m.size(); ++i) {
      if (std::hypot(image.range_m[i] - range_m, image.cross_m[j] - cross_m) > 1.5) continue;
      const double level = image.level_dbsm[j * image.range_m.size() + i];
      if (level > peak.dbsm) peak = {image.range_m[i], image.cross_m[j], level};
    }
  }
  return peak;
}

double cell_of(const std::vector<double>& cells) { return cells[1] - cells[0]; }

const TurntableArea kSquare{{-12, 12}, {-12, 12}};

// The middle of a cell is at most half a cell from the point along both axes: a sixth of the resolution, 0.25 dB each
// for Taylor's weights.
constexpr double kScalloping_db = 0.5;

RcsRequest request_of(std::vector<double> ghz, std::vector<double> azimuths) {
  RcsRequest request;
  for (double& f : ghz) f *= 1e9;
  request.frequency_hz = std::move(ghz);
  request.azimuth_deg = std::move(azimuths);
  return request;
}

// A plate of 30 m by 10 m lies flat.
TriangleMesh long_plate() {
  TriangleMesh mesh;
  mesh.vertices = {{-15, -5, 0}, {15, -5, 0}, {15, 5, 0}, {-15, 5, 0}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  return mesh;
}

// With the radar on the port beam, azimuth 90 deg, the bow is to the left seen from it: 5 m ahead is at cross range 5.
TEST(TurntableImage, APointIsAtItsRangeAndCrossRangeWithItsOwnLevel) {
  const std::vector<double> frequencies = grid(9.7e9, 6e6, 101);
  const TurntableEcho beam = echo_of({{{5, -3, 0}, 1}, {{-6, 4, 0}, 0.01}}, frequencies, grid(88, 0.04, 101));
  const TurntableImage image = turntable_image(beam, kSquare, 1);
  const Peak ahead = peak_near(image, 3, 5);  // 3 m to starboard is farther
  EXPECT_NEAR(ahead.range_m, 3, 0.51 * cell_of(image.range_m));
  EXPECT_NEAR(ahead.cross_m, 5, 0.51 * cell_of(image.cross_m));
  EXPECT_NEAR(ahead.dbsm, 0, kScalloping_db);
  const Peak astern = peak_near(image, -4, -6);
  EXPECT_NEAR(astern.cross_m, -6, 0.51 * cell_of(image.cross_m));
  EXPECT_NEAR(astern.dbsm, -20, kScalloping_db);
  EXPECT_LT(peak_near(image, 3, -5).dbsm, -34) << "the mirror image has the sidelobes alone";

  // Radar astern: the image is the plan, x to the right and y up.
  const TurntableImage plan =
      turntable_image(echo_of({{{5, -3, 0}, 1}}, frequencies, grid(178, 0.04, 101)), kSquare, 1);
  const Peak there = peak_near(plan, 5, -3);
  EXPECT_NEAR(there.range_m, 5, 0.51 * cell_of(plan.range_m));
  EXPECT_NEAR(there.cross_m, -3, 0.51 * cell_of(plan.cross_m));
}

// Exactly at a cell's middle nothing is lost: what remains is the interpolation of the profiles.
TEST(TurntableImage, HasNoScallopingAtTheMiddleOfACell) {
  constexpr double kInterpolation_db = 0.02;
  TurntableImage image =
      turntable_image(echo_of({{{0, 0, 0}, 1}}, grid(9.7e9, 6e6, 101), grid(88, 0.04, 101)), kSquare, 1);
  const double x = image.range_m[60], y = image.cross_m[40];
  image = turntable_image(echo_of({{{y, -x, 0}, 4}}, grid(9.7e9, 6e6, 101), grid(88, 0.04, 101)), kSquare, 1);
  const auto peak = std::ranges::max_element(image.level_dbsm) - image.level_dbsm.begin();
  EXPECT_EQ(peak, static_cast<std::ptrdiff_t>(40 * image.range_m.size() + 60));
  EXPECT_NEAR(image.level_dbsm[static_cast<std::size_t>(peak)], 10 * std::log10(4), kInterpolation_db);
}

// Over 60 deg a point 9 m from the centre moves by metres through range cells of 0.25 m: a Fourier transform of the
// samples would smear it.
TEST(TurntableImage, FocusesOverAWideSector) {
  const TurntableEcho echo = echo_of({{{5, 7.5, 0}, 1}}, grid(9.7e9, 6e6, 101), grid(-30, 0.05, 1201));
  const TurntableImage image = turntable_image(echo, {{-6, -4}, {-8.5, -6.5}}, 1);
  const Peak peak = peak_near(image, -5, -7.5);
  EXPECT_NEAR(peak.range_m, -5, 0.51 * cell_of(image.range_m));
  EXPECT_NEAR(peak.cross_m, -7.5, 0.51 * cell_of(image.cross_m));
  EXPECT_NEAR(peak.dbsm, 0, kScalloping_db);
}

// Half the level, 6.02 dB of |I|, across is that of Taylor's weights, 1.2 of lambda / 2 sector within a few percent.
TEST(TurntableImage, ResolvesWhatItsSamplingStates) {
  constexpr double kTaylor3dB = 1.18, kTolerance = 0.05;
  const TurntableEcho echo = echo_of({{{0, 0, 0}, 1}}, grid(9.7e9, 6e6, 101), grid(88, 0.04, 101));
  const TurntableSampling sampling = turntable_sampling(echo.frequency_hz, echo.azimuth_deg, 0);
  EXPECT_NEAR(sampling.range_cell_m, kSpeedOfLight / (2 * 6e6 * 101), 1e-9);
  EXPECT_NEAR(sampling.range_window_m, kSpeedOfLight / 12e6, 1e-9);
  EXPECT_NEAR(sampling.cross_cell_m, sampling.wavelength_m / (2 * radians(4.04)), 1e-3 * sampling.cross_cell_m);
  EXPECT_NEAR(sampling.cross_window_m, kSpeedOfLight / 10.3e9 / (2 * radians(0.04)), 1e-9);
  for (const bool along : {true, false}) {
    const double cell = along ? sampling.range_cell_m : sampling.cross_cell_m;
    // A line through the point, two resolution cells long.
    const Interval thin{-1e-3, 1e-3}, line{-cell, cell};
    const TurntableImage image =
        turntable_image(echo, along ? TurntableArea{line, thin} : TurntableArea{thin, line}, 1);
    const std::size_t columns = image.range_m.size(), rows = image.cross_m.size(), count = along ? columns : rows;
    const double highest = std::ranges::max(image.level_dbsm);
    double above = 0;
    for (std::size_t i = 0; i < count; ++i)
      above += image.level_dbsm[along ? rows / 2 * columns + i : i * columns + columns / 2] > highest - 3.01;
    EXPECT_NEAR(2 * above / static_cast<double>(count), kTaylor3dB, kTolerance) << along;
  }
}

// At an elevation the ranges are those along the line of sight; a point above the plane is nearer by its height.
TEST(TurntableImage, HasSlantRangesAtAnElevation) {
  const double el = radians(20);
  const TurntableEcho echo =
      echo_of({{{5, -3, 0}, 1}, {{-5, 6, 2}, 1}}, grid(9.7e9, 6e6, 101), grid(178, 0.04, 101), 20);
  const TurntableImage image = turntable_image(echo, kSquare, 1);
  const Peak flat = peak_near(image, 5 * std::cos(el), -3);
  EXPECT_NEAR(flat.range_m, 5 * std::cos(el), 0.51 * cell_of(image.range_m));
  EXPECT_NEAR(flat.cross_m, -3, 0.51 * cell_of(image.cross_m));
  const TurntableAxes axes(180, 20);
  const Vec3 high(-5, 6, 2);
  const Peak above = peak_near(image, axes.range.dot(high), axes.cross.dot(high));
  EXPECT_NEAR(above.range_m, -5 * std::cos(el) - 2 * std::sin(el), 0.51 * cell_of(image.range_m));
  EXPECT_NEAR(above.cross_m, 6, 0.51 * cell_of(image.cross_m));
}

// A translation of the target multiplies the echo by a phase and moves the image by as much.
TEST(TurntableImage, MovesWithTheTarget) {
  const std::vector<double> frequencies = grid(9.7e9, 6e6, 101), azimuths = grid(28, 0.04, 101);
  const std::vector<IdealPoint> points{{{1, 2, 0}, 1}, {{-2, -1, 0}, 2}};
  TurntableEcho echo = echo_of(points, frequencies, azimuths);
  const TurntableAxes axes(30, 0);
  const TurntableImage before = turntable_image(echo, kSquare, 1);
  // By whole cells, so that both images have the same samples.
  const Vec3 moved = 7 * cell_of(before.range_m) * axes.range + 4 * cell_of(before.cross_m) * axes.cross;
  for (std::size_t i = 0; i < echo.amplitude_m.size(); ++i) {
    const Vec3 r = direction_to_radar(radians(azimuths[i / 101]), 0);
    echo.amplitude_m[i] *= std::polar(1.0, 4 * kPi * frequencies[i % 101] / kSpeedOfLight * r.dot(moved));
  }
  const TurntableImage after = turntable_image(echo, kSquare, 1);
  const std::size_t columns = before.range_m.size();
  const double highest = std::ranges::max(before.level_dbsm);
  double largest = 0;
  for (std::size_t j = 20; j + 20 < before.cross_m.size(); ++j) {
    for (std::size_t i = 20; i + 20 < columns; ++i) {
      const double there = before.level_dbsm[j * columns + i];
      if (there > highest - 30)
        largest = std::max(largest, std::abs(after.level_dbsm[(j + 4) * columns + i + 7] - there));
    }
  }
  EXPECT_LT(largest, 0.1);
}

TEST(TurntableImage, IsTheSameForAnyNumberOfThreads) {
  const TurntableEcho echo = echo_of({{{5, -3, 0}, 1}}, grid(9.7e9, 12e6, 51), grid(88, 0.04, 101));
  EXPECT_EQ(turntable_image(echo, kSquare, 1).level_dbsm, turntable_image(echo, kSquare, 3).level_dbsm);
}

// Two spheres, solved: each focuses at its point nearest to the radar with the geometrical optics' pi a^2. The solver's
// mean error of a sphere's echo at ka = 42 is below 0.2 dB.
TEST(TurntableImage, OfTwoSpheresHasTheirFrontsWithTheirLevels) {
  constexpr double kRadius = 0.2, kSolver_db = 0.2;
  const Vec3 first(1.2, -1, 0), second(-0.8, 1.5, 0.1);
  TriangleMesh spheres;
  for (const Vec3& place : {first, second})
    spheres.append(transformed(make_sphere(kRadius, 3), Mat3::Identity(), place));
  RcsRequest request = request_of(grid(9.7, 0.015, 41), grid(58, 0.2, 21));
  request.mesh = std::make_shared<TriangleMesh>(spheres);
  request.edges = false;
  const RcsResult result = compute_rcs(request, prepare_rcs_target(request), 1);
  const TurntableExtent extent = turntable_extent(spheres, request.azimuth_deg, 0);
  for (const std::size_t element : {0u, 3u}) {
    const TurntableEcho echo = turntable_echo(result.sweep, element);
    const TurntableArea area = turntable_area(turntable_sampling(echo.frequency_hz, echo.azimuth_deg, 0), &extent);
    const TurntableImage image = turntable_image(echo, area, 1);
    const TurntableAxes axes(60, 0);
    for (const Vec3& place : {first, second}) {
      const Peak peak = peak_near(image, axes.range.dot(place) - kRadius, axes.cross.dot(place));
      EXPECT_NEAR(peak.range_m, axes.range.dot(place) - kRadius, 0.51 * cell_of(image.range_m) + 0.01);
      EXPECT_NEAR(peak.cross_m, axes.cross.dot(place), 0.51 * cell_of(image.cross_m) + 0.01);
      EXPECT_NEAR(peak.dbsm, 10 * std::log10(kPi * kRadius * kRadius), kScalloping_db + kSolver_db);
    }
    const auto highest = std::ranges::max_element(image.level_dbsm) - image.level_dbsm.begin();
    const Vec3 to_first(image.range_m[static_cast<std::size_t>(highest) % image.range_m.size()],
                        image.cross_m[static_cast<std::size_t>(highest) / image.range_m.size()], 0);
    EXPECT_LT(
        std::min(std::hypot(to_first.x() - axes.range.dot(first) + kRadius, to_first.y() - axes.cross.dot(first)),
                 std::hypot(to_first.x() - axes.range.dot(second) + kRadius, to_first.y() - axes.cross.dot(second))),
        0.15)
        << "nothing is stronger elsewhere";
  }
}

// The picture names the axes, the resolution and the windows, and has the outline of the mesh in the image's axes.
TEST(TurntableFigure, HasTheOutlineOfTheMeshAndItsSampling) {
  const TurntableEcho echo = echo_of({{{5, -3, 0}, 1}}, grid(9.7e9, 6e6, 101), grid(178, 0.04, 101));
  const TriangleMesh mesh = long_plate();
  const Heatmap figure = turntable_figure(echo, turntable_image(echo, {{-20, 20}, {-10, 10}}, 1), &mesh, {"plate", {}});
  EXPECT_TRUE(figure.equal_axes);
  EXPECT_NEAR(figure.colour.range->second, 0, kScalloping_db);
  double low = 1e300, high = -1e300;
  for (const auto& [x, y] : figure.outline) {
    if (std::isnan(x)) continue;
    low = std::min(low, x);
    high = std::max(high, x);
    EXPECT_LT(std::abs(y), 5.1);
  }
  EXPECT_NEAR(low, -15, 0.1);  // of samples of 0.03 m
  EXPECT_NEAR(high, 15, 0.1);
  EXPECT_THAT(figure.notes, testing::Contains(HasSubstr("resolution 0.247 m (c/2B) by 0.213 m")));
  EXPECT_THAT(figure.notes, testing::Contains(HasSubstr("repeats every 24.98 m by 20.85 m")));
}

TEST(TurntableFigure, OfProfilesHasNamesAtThePeaksOfTheMiddleOne) {
  const TurntableEcho echo = echo_of({{{5, 0, 0}, 1}, {{-5, 0, 0}, 0.5}}, grid(9.7e9, 6e6, 101), grid(-10, 0.01, 2001));
  const Heatmap figure = profiles_figure(
      echo, turntable_profiles(echo, {-12, 12}), {"two points", {}},
      [](std::vector<NamedPeak>& peaks, const ProfilePlace& place) {
        EXPECT_NEAR(place.view.azimuth_deg, 0, 1e-9);
        for (NamedPeak& peak : peaks) peak.name = peak.range_m < 0 ? "near" : "far";
      },
      2);
  EXPECT_LE(figure.map.y.size(), 800u);
  EXPECT_NEAR(figure.map.y.front(), -10, 0.02);
  ASSERT_EQ(figure.profile->peaks.size(), 2u);
  EXPECT_EQ(figure.profile->peaks[0].name, "near");  // the stronger one
  EXPECT_NEAR(figure.profile->peaks[0].x, -5, 0.1);
  EXPECT_NEAR(figure.profile->peaks[1].value, -3, kScalloping_db);
}

TEST(TurntableProfiles, HaveAPointAtItsRangeAtEveryAzimuth) {
  const TurntableEcho echo = echo_of({{{5, 7.5, 0}, 1}}, grid(9.7e9, 6e6, 101), grid(0, 1, 91));
  const TurntableProfiles profiles = turntable_profiles(echo, {-12, 12});
  const std::size_t ranges = profiles.range_m.size();
  for (std::size_t a = 0; a < echo.azimuth_deg.size(); ++a) {
    const auto row = profiles.level_dbsm.begin() + static_cast<std::ptrdiff_t>(a * ranges);
    const auto peak = std::max_element(row, row + static_cast<std::ptrdiff_t>(ranges)) - row;
    const double angle = radians(echo.azimuth_deg[a]);
    EXPECT_NEAR(profiles.range_m[static_cast<std::size_t>(peak)], -5 * std::cos(angle) - 7.5 * std::sin(angle),
                0.51 * cell_of(profiles.range_m));
    EXPECT_NEAR(row[peak], 0, kScalloping_db);
  }
}

TEST(TurntableRequest, IsRefusedWithThePlaceTheValueAndTheBound) {
  const auto refusal = [](const RcsRequest& request) {
    return refusal_of([&] {
      require_turntable(request, "--isar");
      require_window(request, long_plate(), "--isar", true);
    });
  };
  EXPECT_EQ(refusal(request_of(grid(9.9, 0.004, 51), grid(-1, 0.05, 41))), "accepted");
  EXPECT_THAT(refusal(request_of({10}, grid(-1, 0.05, 41))),
              HasSubstr("--frequency-ghz: 1 value: --isar needs at least 8"));
  EXPECT_THAT(refusal(request_of(grid(9.9, 0.004, 51), grid(0, 1, 7))),
              HasSubstr("--azimuth-deg: 7 values: --isar needs at least 8"));
  RcsRequest steep = request_of(grid(9.9, 0.004, 51), grid(-1, 0.05, 41));
  steep.elevation_deg = {85};
  EXPECT_THAT(refusal(steep), HasSubstr("--elevation-deg: value 85: with --isar it must be within -80 and 80"));
  steep.elevation_deg = {0, 1};
  EXPECT_THAT(refusal(steep), HasSubstr("--elevation-deg: 2 values: --isar needs one"));
  // The windows are c / (2 step) = 15 m of 30.2 m (the plate's length at 1 deg), lambda / (2 step) of 10.5 m.
  EXPECT_THAT(refusal(request_of(grid(9.9, 0.01, 21), grid(-1, 0.05, 41))),
              HasSubstr("--frequency-ghz: step 0.01: must be at most 0.00496 GHz for --isar, which repeats every 14.99 "
                        "m in range: the target is 30.17 m long there"));
  EXPECT_THAT(refusal(request_of(grid(9.9, 0.004, 51), grid(-1, 0.1, 21))),
              HasSubstr("--azimuth-deg: step 0.1: must be at most 0.0"));
}

}  // namespace
}  // namespace seaglint
