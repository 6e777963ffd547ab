// SPDX-License-Identifier: BSD-3-Clause
// Diffraction by wedges with surface impedances: limits, reciprocity, shadow boundaries, and the solution of Wiener and
// Hopf for a plane whose impedance changes along a line.
#include "sim/scattering/coefficients/material_edge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

constexpr Complex j(0, 1);

Complex random_sine(Random& random) { return std::polar(3 * random.uniform(), 1.3 * (2 * random.uniform() - 1)); }

double off_boundaries(double phi, double phi0, double N) {
  return std::min(
      {std::abs(std::abs(phi - phi0) - kPi), std::abs(phi + phi0 - kPi), std::abs(2 * N * kPi - phi - phi0 - kPi)});
}

// J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130, as P = -(j/2) of this form.
TEST(ImpedanceWedge, HasKellersCoefficientsAsLimits) {
  Random random({3, Stream::kTest, 41});
  for (int i = 0; i < 300; ++i) {
    const double N = 1 + random.uniform(), phi = N * kPi * random.uniform(), phi0 = N * kPi * random.uniform();
    if (off_boundaries(phi, phi0, N) < 0.05) continue;
    const double scale = std::sin(kPi / N) / N, minus = scale / (std::cos(kPi / N) - std::cos((phi - phi0) / N)),
                 plus = scale / (std::cos(kPi / N) - std::cos((phi + phi0) / N));
    const Complex soft = impedance_wedge(phi, phi0, {kSoftConductor, kSoftConductor}, N),
                  hard = impedance_wedge(phi, phi0, {0.0, 0.0}, N);
    EXPECT_LT(std::abs(soft + 0.5 * j * (minus - plus)), 1e-9) << N << " " << phi << " " << phi0;
    EXPECT_LT(std::abs(hard + 0.5 * j * (minus + plus)), 1e-9) << N << " " << phi << " " << phi0;
  }
}

TEST(ImpedanceWedge, TendsContinuouslyToPerfectConductors) {
  for (const double N : {1.3, 1.5, 2.0}) {
    const Complex hard = impedance_wedge(1, 2.4, {0.0, 0.0}, N), nearly = impedance_wedge(1, 2.4, {1e-5, 1e-5}, N);
    EXPECT_LT(std::abs(nearly - hard), 1e-3 * std::abs(hard)) << N;  // first order in sin(theta) ln sin(theta)
    const Complex soft = impedance_wedge(1, 2.4, {kSoftConductor, kSoftConductor}, N);
    EXPECT_LT(std::abs(impedance_wedge(1, 2.4, {1e5, 1e5}, N) - soft), 1e-3 * std::abs(soft)) << N;
  }
}

TEST(ImpedanceWedge, IsReciprocalAndSymmetricInItsFaces) {
  Random random({3, Stream::kTest, 42});
  for (int i = 0; i < 300; ++i) {
    const double N = 1 + random.uniform(), phi = N * kPi * random.uniform(), phi0 = N * kPi * random.uniform();
    if (off_boundaries(phi, phi0, N) < 0.05) continue;
    const Complex a = random_sine(random), b = random_sine(random);
    const Complex P = impedance_wedge(phi, phi0, {a, b}, N);
    EXPECT_LT(std::abs(P - impedance_wedge(phi0, phi, {a, b}, N)), 1e-9 * (1 + std::abs(P)));
    EXPECT_LT(std::abs(P - impedance_wedge(N * kPi - phi, N * kPi - phi0, {b, a}, N)), 1e-9 * (1 + std::abs(P)));
  }
}

// Keller's field is infinite on the shadow boundary and, times the reflection coefficient, on that of the reflection,
// as physical optics is: their ratio tends to 1 with the distance from the boundary, 1e-5.
TEST(ImpedanceWedge, HasThePolesOfPhysicalOptics) {
  Random random({3, Stream::kTest, 43});
  for (int i = 0; i < 100; ++i) {
    const double N = 1.5 + 0.5 * random.uniform(), phi0 = 0.2 + 1.1 * random.uniform(), step = 1e-5;
    const std::array sines{random_sine(random), random_sine(random)};
    const Complex R = (std::sin(phi0) - sines[0]) / (std::sin(phi0) + sines[0]);
    if (std::abs(R) < 0.05) continue;  // no pole
    for (const double phi : {kPi - phi0 + step, kPi + phi0 + step}) {
      if (phi > N * kPi - 0.1) continue;
      EXPECT_LT(std::abs(impedance_wedge(phi, phi0, sines, N) / half_plane_optics(phi, phi0, R) - 1.0), 3e-3)
          << N << " " << phi0 << " " << sines[0];
    }
  }
}

// A plane with an impedance for x > 0 and a hard surface for x < 0, by the method of Wiener and Hopf instead of
// Maliuzhinets': P = -j L(cos phi) L(cos phi0) / (cos phi + cos phi0), L(c) L(-c) = S sin phi / (S + sin phi), S =
// sin(theta), L regular for Re c < 0; ln of 1 + S / gamma factorised by its integral along the imaginary axis of c.
TEST(ImpedanceWedge, OfAFlatJunctionIsTheSolutionOfWienerAndHopf) {
  const auto factor = [](const Complex& S, double c) {
    constexpr int kSteps = 200000;
    Complex integral = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double u = std::abs(c) * std::tan((i + 0.5) / kSteps * kPi / 2);
      integral += std::log(1.0 + S / std::sqrt(1 + u * u)) / (2.0 * kSteps);
    }
    const Complex whole = std::log(1.0 + S / std::sqrt(1 - c * c));
    return std::sqrt(S) * std::exp(-(c > 0 ? whole - integral : integral));
  };
  Random random({3, Stream::kTest, 44});
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const Complex S = random_sine(random);
    const double phi = kPi * random.uniform(), phi0 = kPi * random.uniform();
    if (std::abs(phi + phi0 - kPi) < 0.05 || std::min({phi, phi0, kPi - phi, kPi - phi0}) < 0.02) continue;
    const Complex expected =
        -j * factor(S, std::cos(phi)) * factor(S, std::cos(phi0)) / (std::cos(phi) + std::cos(phi0));
    const Complex P = impedance_wedge(phi, phi0, {S, 0.0}, 1);
    worst = std::max(worst, std::abs(P - expected) / std::abs(expected));
  }
  EXPECT_LT(worst, 1e-6);  // both quadratures
}

TEST(ImpedanceWedge, ReflectionCoefficientsAndSinesAreInverse) {
  Random random({3, Stream::kTest, 45});
  for (int i = 0; i < 50; ++i) {
    const Complex S = random_sine(random);
    const double sine = 0.01 + 0.99 * random.uniform();
    EXPECT_LT(std::abs(brewster_sine((sine - S) / (sine + S), sine) - S), 1e-9 * (1 + std::norm(S) / sine));
  }
  EXPECT_EQ(brewster_sine(-1, 0.5), kSoftConductor);
  EXPECT_EQ(brewster_sine(1, 0.5), 0.0);
}

}  // namespace
}  // namespace seaglint
