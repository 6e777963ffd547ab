// SPDX-License-Identifier: BSD-3-Clause
// Shadow boundaries of reflected beams: the effective width of a double knife-edge against Fresnel's integral, its
// point contributions against independent traces. The echo is compared with integral equations in
// infinite_prism_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "sim/geometry/files/mesh_io.h"
#include "sim/scattering/coefficients/amplitude_laws.h"
#include "sim/scattering/points/decomposition.h"
#include "sim/scattering/points/phase_integral.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr Complex j(0, 1);

std::vector<Contribution> boundary_terms(const Scatterer& scatterer, const Vec3& r) {
  std::vector<Contribution> all;
  illumination(scatterer, monostatic(radar_basis(r)), {0, 8, true})
      .trace(1, [&](std::size_t, std::size_t, std::span<const Contribution> contributions) {
        std::ranges::copy_if(contributions, std::back_inserter(all), &Contribution::interval);
      });
  return all;
}

// Behind a half-plane the field at u beyond the shadow-boundary line is erfc(e^{j pi/4} u) / 2; the correction of the
// beam is its integral beyond the second edge. With both integrals rotated by e^{-j pi/4} and their order exchanged it
// is that of t e^{-(a + t)^2} / sqrt(pi) over t > 0, a = e^{j pi/4} u.
TEST(DoubleKnifeEdge, HasTheWidthOfFresnelsFieldBeyondTheSecondEdge) {
  const double k = wavenumber(10e9), d = 0.7;
  for (const double width : {0.0, 0.01, 0.05, 0.2}) {
    DoubleKnifeEdge knife_edges{{d, d}, {width * width / (2 * d), width * width / (2 * d)}, 0};
    const Complex a = std::polar(width * std::sqrt(k / (2 * d)), kPi / 4);
    Complex integral = 0;
    constexpr double step = 1e-3;
    for (double t = step / 2; t < 12; t += step) integral += step * t * std::exp(-(a + t) * (a + t)) / std::sqrt(kPi);
    const Complex correction =
        k * std::sqrt(2 * d / k) * std::polar(1.0, -kPi / 4) * integral * std::exp(j * std::norm(a));
    // The error of the transition function is 1e-7, that of the sum step^2 / 24 of the integrand's slope.
    EXPECT_NEAR(std::abs(knife_edges.at(k, 0.5) - correction), 0, 1e-6 * k * std::sqrt(2 * d / k)) << width;
  }
}

// The same for a psi of slope `slope`: the residual of the integral of E(x) e^{jk slope x} up to the second edge at w,
// less the end-point contribution of physical optics there and that of the first edge where its path lands within the
// second one. The field beyond the second edge is rotated and its order exchanged as above.
TEST(DoubleKnifeEdge, CouplesEndPointsForASlopingPsi) {
  const double k = wavenumber(10e9), d = 0.7, unit = std::sqrt(2 * d / k);
  for (const double slope : {-0.3, -0.05, 0.04, 0.15}) {
    for (const double w : {-0.3, -0.08, -0.01, 0.003, 0.05, 0.4}) {
      const double landing = w - slope * d, sigma = k * slope * unit;
      DoubleKnifeEdge knife_edges{{d, d}, {w * w / (2 * d), w * w / (2 * d)}, slope};
      knife_edges.exit_excess.fill(std::copysign(landing * landing / (2 * d), landing));
      knife_edges.second_in_shadow = w > 0;
      knife_edges.off_axis_weight = 1;
      knife_edges.axial_weight = 0;
      // The first edge's field beyond the second one, times e^{-jk slope w}.
      const Complex a = std::polar(1.0, kPi / 4) * (w / unit), c = j * sigma * std::polar(1.0, -kPi / 4);
      Complex beyond = 0;
      constexpr double step = 2e-4;
      for (double r = step / 2; r < 40; r += step)
        beyond += step * (std::exp(c * r - (a + r) * (a + r)) - std::exp(-(a + r) * (a + r))) / (c * std::sqrt(kPi));
      beyond *= unit * std::polar(1.0, -kPi / 4);
      const auto end = [&](double phase) { return std::polar(1.0, phase) / (j * k * slope); };
      // The whole integral is that of e^{j k slope^2 d / 2}, from which the second edge removes `beyond`.
      const Complex all = end(0.5 * k * slope * slope * d - k * slope * w) - beyond;
      const Complex endpoints =
          (landing > 0 ? end(0.5 * k * slope * slope * d - k * slope * w) : 0.0) + (w < 0 ? end(0) : 0.0);
      const Complex width = -k * (all - endpoints) * std::polar(1.0, k * w * w / (2 * d));
      // The error of the transition function is 1e-7 of the end-point contributions, that of nearly equal arguments the
      // square of 0.05 over 24.
      EXPECT_NEAR(std::abs(knife_edges.at(k, 0.5) - width), 0, 2e-4 / std::abs(slope) + 1e-6 * k * unit)
          << slope << " " << w;
    }
  }
}

// Edges that meet in one point: the path between them grows from 0. The end-point contributions replace the integral
// where the phase difference reaches ten cycles.
TEST(DoubleKnifeEdge, EqualsItsEndPointsOverManyCycles) {
  const double k = wavenumber(10e9);
  EdgeInterval contribution;
  contribution.length = 0.4;
  contribution.amplitude = DoubleKnifeEdge{{0, 0.5}, {0, 1e-4}, 0};
  contribution.psi = {0, 59.9 / k};
  const Complex summed = interval_integral(contribution, k, 0, 1), half = std::polar(1.0, 0.5 * 59.9);
  const Complex endpoints =
      endpoint_term(contribution, k, 1) * half - endpoint_term(contribution, k, 0) * std::conj(half);
  EXPECT_LT(std::abs(summed - endpoints), 0.02 * std::abs(summed));
  // Parts sum to the whole.
  Complex parts = 0;
  for (int i = 0; i < 5; ++i)
    parts += interval_integral(contribution, k, 0.2 * i, 0.2 * (i + 1)) * std::polar(1.0, 59.9 * (0.2 * i - 0.4));
  EXPECT_NEAR(std::abs(parts - summed), 0, 1e-3 * std::abs(summed));
}

// Edges that meet in a vertex are not coupled there, for either sign of the paths' rounding: otherwise a long interval
// that is represented by its end-point contributions would have one there.
TEST(DoubleKnifeEdge, VanishesWhereEdgesMeet) {
  const Scatterer reflector(read_mesh(SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb"));
  int vertices = 0;
  for (double azimuth = 40; azimuth < 60; azimuth += 0.25) {
    for (const Contribution& contribution : boundary_terms(reflector, direction(azimuth, 20))) {
      const auto* term = std::get_if<DoubleKnifeEdge>(&contribution.interval()->amplitude);
      if (!term) continue;
      const DoubleKnifeEdge& knife_edges = *term;
      for (std::size_t end = 0; end < 2; ++end) {
        // Where only one of both is in shadow the end-point contribution of the other remains, and they are coupled.
        if (knife_edges.separation[end] > 1e-9 ||
            (knife_edges.exit_excess[1 - end] > 0) != knife_edges.second_in_shadow)
          continue;
        ++vertices;
        // F(u^2) / u of u below 1e-6 over slopes from 0.03
        EXPECT_LT(std::abs(knife_edges.at(wavenumber(16e9), static_cast<double>(end))), 1e-3) << azimuth;
      }
    }
  }
  EXPECT_GT(vertices, 100);
}

// One trace is valid over an aspect change of 0.1 deg: the icosahedral reflector, where these contributions are
// largest.
TEST(DoubleKnifeEdge, MatchesIndependentTracesOverAnAspectChange) {
  const Scatterer reflector(read_mesh(SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb"));
  const double k = wavenumber(16e9);
  for (const auto& [azimuth, elevation] : {std::pair{48.0, 20.0}, {70.0, 2.0}, {33.0, 20.0}}) {
    const Vec3 r = direction(azimuth, elevation);
    std::vector<Point> points;
    for (const Contribution& contribution : boundary_terms(reflector, r))
      decompose(contribution, {monostatic(radar_basis(r))}, {FrequencyBand(k), 0, radians(0.15)}, points);
    double error = 0, power = 0;
    for (const double change : {-0.07, 0.07}) {
      const Vec3 changed = direction(azimuth + change, elevation + 0.7 * change);
      const auto frozen = direct_sum(points, k, changed - r);
      std::array<Complex, 4> independent{};
      for (const Contribution& footprint : boundary_terms(reflector, changed)) {
        const auto s = scattered(footprint, {monostatic(radar_basis(changed))}, k);
        for (int i = 0; i < 4; ++i) independent[i] += s[i];
      }
      for (int i = 0; i < 4; ++i) {
        error += std::norm(frozen[i] - independent[i]);
        power += std::norm(independent[i]);
      }
    }
    std::printf("%g deg: %.3f m, error %.1f dB\n", azimuth, std::sqrt(power / 2), 10 * std::log10(error / power));
    EXPECT_GT(std::sqrt(power / 2), 0.05);
    // end points that slide and widths are frozen: -27 dB of what is -30 dB of the reflector's own echo
    EXPECT_LT(error, 2e-3 * power) << azimuth;
  }
}

}  // namespace
}  // namespace seaglint
