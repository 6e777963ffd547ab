// SPDX-License-Identifier: BSD-3-Clause
// Where beams end: the width of what two rims share against Fresnel's integral, its points against fresh traces. The
// echo is held to integral equations in infinite_prism_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim/geometry/files/mesh_io.h"
#include "sim/scattering/diffraction/transition.h"
#include "sim/scattering/edges/edge_decomposition.h"
#include "sim/scattering/response/illumination.h"
#include "sim/scattering/surfaces/phase_integral.h"
#include "sim/scattering/surfaces/point_contributions.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

constexpr Complex j(0, 1);

std::vector<EdgeContribution> beam_ends(const Scatterer& scatterer, const Vec3& r) {
  std::vector<EdgeContribution> all;
  Illumination(scatterer, monostatic(radar_basis(r)), {0, 8, true})
      .trace_all(1, [&](std::size_t, std::size_t, const PanelContributions& contributions) {
        all.insert(all.end(), contributions.boundary_terms.begin(), contributions.boundary_terms.end());
      });
  return all;
}

// Behind a half-plane the field at u beyond the shadow line is erfc(e^{j pi/4} u) / 2; the beam lacks its integral from
// the second rim on. With both integrals turned by e^{-j pi/4} and their order changed it is that of t e^{-(a + t)^2} /
// sqrt(pi) over t > 0, a = e^{j pi/4} u.
TEST(DoubleKnifeEdge, LackWhatFresnelsFieldHasBeyondTheSecondRim) {
  const double k = wavenumber(10e9), d = 0.7;
  for (const double apart : {0.0, 0.01, 0.05, 0.2}) {
    DoubleKnifeEdge knives{{d, d}, {apart * apart / (2 * d), apart * apart / (2 * d)}, 0};
    const Complex a = std::polar(apart * std::sqrt(k / (2 * d)), kPi / 4);
    Complex integral = 0;
    constexpr double step = 1e-3;
    for (double t = step / 2; t < 12; t += step) integral += step * t * std::exp(-(a + t) * (a + t)) / std::sqrt(kPi);
    const Complex lacking =
        k * std::sqrt(2 * d / k) * std::polar(1.0, -kPi / 4) * integral * std::exp(j * std::norm(a));
    // The transition function errs by 1e-7, the sum by step^2 / 24 of the integrand's slope.
    EXPECT_NEAR(std::abs(knives.at(k, 0.5) - lacking), 0, 1e-6 * k * std::sqrt(2 * d / k)) << apart;
  }
}

// The same where psi slopes by `slope`: what is left of the integral of E(x) e^{jk slope x} up to the second rim at w,
// when the end of physical optics there and the first rim's own, as far as it lands within the second one, are taken
// off. The field beyond the second rim is turned and its order changed as above.
TEST(DoubleKnifeEdge, ShareTheirEndsWherePsiSlopes) {
  const double k = wavenumber(10e9), d = 0.7, unit = std::sqrt(2 * d / k);
  for (const double slope : {-0.3, -0.05, 0.04, 0.15}) {
    for (const double w : {-0.3, -0.08, -0.01, 0.003, 0.05, 0.4}) {
      const double landed = w - slope * d, sigma = k * slope * unit;
      DoubleKnifeEdge knives{{d, d}, {w * w / (2 * d), w * w / (2 * d)}, slope};
      knives.exit_excess.fill(std::copysign(landed * landed / (2 * d), landed));
      knives.second_in_shadow = w > 0;
      knives.off_axis_weight = 1;
      knives.axial_weight = 0;
      // What the first rim's field has beyond the second one, times e^{-jk slope w}.
      const Complex a = std::polar(1.0, kPi / 4) * (w / unit), c = j * sigma * std::polar(1.0, -kPi / 4);
      Complex beyond = 0;
      constexpr double step = 2e-4;
      for (double r = step / 2; r < 40; r += step)
        beyond += step * (std::exp(c * r - (a + r) * (a + r)) - std::exp(-(a + r) * (a + r))) / (c * std::sqrt(kPi));
      beyond *= unit * std::polar(1.0, -kPi / 4);
      const auto end = [&](double phase) { return std::polar(1.0, phase) / (j * k * slope); };
      // All of it is e^{j k slope^2 d / 2}'s, of which the second rim takes `beyond`.
      const Complex all = end(0.5 * k * slope * slope * d - k * slope * w) - beyond;
      const Complex told =
          (landed > 0 ? end(0.5 * k * slope * slope * d - k * slope * w) : 0.0) + (w < 0 ? end(0) : 0.0);
      const Complex width = -k * (all - told) * std::polar(1.0, k * w * w / (2 * d));
      // The transition function errs by 1e-7 of the ends, nearly equal arguments by the square of 0.05 over 24.
      EXPECT_NEAR(std::abs(knives.at(k, 0.5) - width), 0, 2e-4 / std::abs(slope) + 1e-6 * k * unit)
          << slope << " " << w;
    }
  }
}

// Rims that meet in one point: the way between them grows from 0. The closed form of the ends takes over where the
// phase runs through ten cycles.
TEST(DoubleKnifeEdge, AnswerFromTheirEndsWherePhasesRun) {
  const double k = wavenumber(10e9);
  EdgeContribution contribution;
  contribution.length = 0.4;
  contribution.amplitude = DoubleKnifeEdge{{0, 0.5}, {0, 1e-4}, 0};
  contribution.psi = {0, 59.9 / k};
  const Complex summed = interval_integral(contribution, k, 0, 1), half = std::polar(1.0, 0.5 * 59.9);
  const Complex ends = endpoint_term(contribution, k, 1) * half - endpoint_term(contribution, k, 0) * std::conj(half);
  EXPECT_LT(std::abs(summed - ends), 0.02 * std::abs(summed));
  // Parts sum to the whole.
  Complex parts = 0;
  for (int i = 0; i < 5; ++i)
    parts += interval_integral(contribution, k, 0.2 * i, 0.2 * (i + 1)) * std::polar(1.0, 59.9 * (0.2 * i - 0.4));
  EXPECT_NEAR(std::abs(parts - summed), 0, 1e-3 * std::abs(summed));
}

// Rims that meet in a corner share nothing there, on whichever side of 0 rounding puts the ways: else a long stretch,
// of which the ends answer alone, would have an end of its own.
TEST(DoubleKnifeEdge, VanishesWhereEdgesMeet) {
  const Scatterer reflector(read_mesh(SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb"));
  int corners = 0;
  for (double azimuth = 40; azimuth < 60; azimuth += 0.25) {
    for (const EdgeContribution& contribution : beam_ends(reflector, direction(azimuth, 20))) {
      const auto* term = std::get_if<DoubleKnifeEdge>(&contribution.amplitude);
      if (!term) continue;
      const DoubleKnifeEdge& knives = *term;
      for (std::size_t end = 0; end < 2; ++end) {
        // Where only one of both is hidden the end of the other stands beside, and they do share.
        if (knives.separation[end] > 1e-9 || (knives.exit_excess[1 - end] > 0) != knives.second_in_shadow) continue;
        ++corners;
        // F(u^2) / u of u below 1e-6 over slopes from 0.03
        EXPECT_LT(std::abs(knives.at(wavenumber(16e9), static_cast<double>(end))), 1e-3) << azimuth;
      }
    }
  }
  EXPECT_GT(corners, 100);
}

// What one trace knows of them serves a turn of 0.1 deg: the icosahedral reflector, where they answer most.
TEST(DoubleKnifeEdge, FollowATurnAsFreshTracesDo) {
  const Scatterer reflector(read_mesh(SEAGLINT_SOURCE_DIR "/assets/icosahedral_reflector.glb"));
  const double k = wavenumber(16e9);
  for (const auto& [azimuth, elevation] : {std::pair{48.0, 20.0}, {70.0, 2.0}, {33.0, 20.0}}) {
    const Vec3 r = direction(azimuth, elevation);
    std::vector<PointContribution> points;
    for (const EdgeContribution& contribution : beam_ends(reflector, r))
      decompose(contribution, {k, radians(0.15)}, points);
    double error = 0, power = 0;
    for (const double turn : {-0.07, 0.07}) {
      const Vec3 turned = direction(azimuth + turn, elevation + 0.7 * turn);
      const auto frozen = direct_sum(points, k, turned - r);
      std::array<Complex, 4> fresh{};
      for (const EdgeContribution& footprint : beam_ends(reflector, turned)) {
        const auto s = scattered(footprint, k);
        for (int i = 0; i < 4; ++i) fresh[i] += s[i];
      }
      for (int i = 0; i < 4; ++i) {
        error += std::norm(frozen[i] - fresh[i]);
        power += std::norm(fresh[i]);
      }
    }
    std::printf("%g deg: %.3f m, error %.1f dB\n", azimuth, std::sqrt(power / 2), 10 * std::log10(error / power));
    EXPECT_GT(std::sqrt(power / 2), 0.05);
    // ends that slip and widths are frozen: -27 dB of what is -30 dB of the reflector's echo itself
    EXPECT_LT(error, 2e-3 * power) << azimuth;
  }
}

}  // namespace
}  // namespace seaglint
