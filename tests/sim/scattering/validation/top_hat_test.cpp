// SPDX-License-Identifier: BSD-3-Clause
// A cylinder on a plate of two triangles: the double bounce of a top hat against its closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "sim/scattering/points/phase_integral.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr double kCell = 0.03;  // m, of the wall's facets

std::uint32_t add_vertex(TriangleMesh& mesh, double x, double y, double z) {
  mesh.vertices.push_back({x, y, z});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

// The part of a cylinder's wall within 1.3 rad of the x axis, of quads about kCell wide, upright on the plate z = 0,
// which reaches as far beyond it as a wave from `elevation_deg` needs to illuminate the whole wall. The plate's two
// triangles start at its corner number `cut`, 0..3.
TriangleMesh top_hat(double radius, double height, double elevation_deg, std::size_t cut = 0) {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.vertices.clear();
  mesh.triangles.clear();
  constexpr double kHalf = 1.3;
  const int columns = static_cast<int>(std::ceil(2 * kHalf * radius / kCell)),
            rows = static_cast<int>(std::ceil(height / kCell));
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double angle = kHalf * (2.0 * i / columns - 1);
      add_vertex(mesh, radius * std::cos(angle), radius * std::sin(angle), height * j / rows);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i), c = a + static_cast<std::uint32_t>(columns) + 1;
      mesh.triangles.push_back({a, a + 1, c + 1});
      mesh.triangles.push_back({a, c + 1, c});
    }
  }
  const double reach = radius + 1.5 * height / std::tan(radians(elevation_deg));
  const std::array<std::uint32_t, 4> corner{add_vertex(mesh, 0, -reach, 0), add_vertex(mesh, reach, -reach, 0),
                                            add_vertex(mesh, reach, reach, 0), add_vertex(mesh, 0, reach, 0)};
  const auto at = [&](std::size_t i) { return corner[(cut + i) % 4]; };
  mesh.triangles.push_back({at(0), at(2), at(3)});  // with cut 0 the wall reflects to the other triangle of the panel
  mesh.triangles.push_back({at(0), at(1), at(2)});
  mesh.triangle_part.assign(mesh.triangles.size(), 0);
  mesh.triangle_material.assign(mesh.triangles.size(), 0);
  return mesh;
}

// Two bounces, plate and wall in either order. By image theory in the plate, stationary phase about the azimuth of the
// radar gives each the amplitude of a cylinder of radius R cos(el) and height h at normal incidence, h sqrt(k R cos(el)
// / 4 pi) (sigma = k a h^2 of a cylinder of radius a); both orders have the same path and add in phase.
double closed_form(double k, double radius, double height, double elevation_deg) {
  return 2 * height * std::sqrt(k * radius * std::cos(radians(elevation_deg)) / (4 * kPi));
}

struct TopHat {
  double radius, height, elevation_deg;
};

class TopHatEcho : public testing::TestWithParam<TopHat> {};

// Terms of the bound: stationary phase, 1 / (8 k R cos(el)) of the amplitude, 0.05 dB at most here; the facets' second
// order, edge^3, 0.1 dB.
TEST_P(TopHatEcho, HasTheClosedFormInEveryView) {
  const auto& [radius, height, elevation_deg] = GetParam();
  const Scatterer scatterer(top_hat(radius, height, elevation_deg));
  const double k = wavenumber(8e9);
  const double expected = dbsm(closed_form(k, radius, height, elevation_deg));
  TracingSettings settings{0, 2};
  settings.filter.included.push_back({ContributionSelector::Kind::kBounces, 2});
  double min = 1e9, max = -1e9;
  for (int i = 0; i <= 7; ++i) {
    const Vec3 r_hat = direction(-1.5 + 0.67 * i, elevation_deg);
    const auto s = scattering_matrices(scatterer, monostatic(radar_basis(r_hat)), std::array{k}, settings)[0];
    for (const Channel channel : {kHhChannel, kVvChannel}) {
      min = std::min(min, dbsm(s[channel]));
      max = std::max(max, dbsm(s[channel]));
    }
  }
  std::printf("R %.1f m, h %.1f m, elevation %.0f deg: %.2f to %.2f dBsm, closed form %.2f\n", radius, height,
              elevation_deg, min, max, expected);
  record_figure(std::max(max - expected, expected - min), 2, "top_hat_{:.0f}cm_{:.0f}cm_{:.0f}deg_db", 100 * radius,
                100 * height, elevation_deg);
  constexpr double bound_db = 0.15;
  EXPECT_GT(min, expected - bound_db);
  EXPECT_LT(max, expected + bound_db);
}

INSTANTIATE_TEST_SUITE_P(RadiiHeightsAndElevations, TopHatEcho,
                         testing::Values(TopHat{0.5, 0.4, 40}, TopHat{1, 0.4, 40}, TopHat{1, 0.6, 40},
                                         TopHat{1, 0.4, 25}, TopHat{0.3, 0.4, 40}, TopHat{0.5, 0.8, 40},
                                         TopHat{0.5, 0.4, 25}));

// An odd number of columns has a facet that faces the x axis, so that the phase is stationary inside its footprint.
// Bound: the choice between contour and area depends on the triangle, and the two differ by kContourRatio^-1.5.
TEST(TopHat, IsIndependentOfTriangulation) {
  constexpr double kRadius = 0.49, kHeight = 0.4, kElevationDeg = 40;
  const double k = wavenumber(8e9);
  TracingSettings settings{0, 2};
  settings.filter.included.push_back({ContributionSelector::Kind::kBounces, 2});
  std::vector<Scatterer> hats;
  hats.reserve(4);
  for (std::size_t cut = 0; cut < 4; ++cut) hats.emplace_back(top_hat(kRadius, kHeight, kElevationDeg, cut));
  double max = 0;
  for (int i = 0; i <= 12; ++i) {
    const auto antennas = monostatic(radar_basis(direction(-1.5 + 0.4 * i, kElevationDeg)));
    const auto echo_of = [&](const Scatterer& hat) {
      return scattering_matrices(hat, antennas, std::array{k}, settings)[0][kVvChannel];
    };
    const Complex first = echo_of(hats[0]);
    for (std::size_t cut = 1; cut < 4; ++cut)
      max = std::max(max, std::abs(echo_of(hats[cut]) - first) / closed_form(k, kRadius, kHeight, kElevationDeg));
  }
  std::printf("four triangulations of the plate: echoes differ by %.5f of the closed form at most\n", max);
  record_figure(max, 5, "top_hat_cut");
  EXPECT_LT(max, std::pow(kContourRatio, -1.5));
}

}  // namespace
}  // namespace seaglint
