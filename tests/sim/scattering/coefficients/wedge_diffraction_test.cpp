// SPDX-License-Identifier: BSD-3-Clause
// Fringe currents of convex wedges and concave edges against Keller's coefficients.
#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scattering/points/phase_integral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

constexpr Complex j(0, 1);

WedgeFrame wedge(double N) {
  const Vec3 x2(std::cos(N * kPi), std::sin(N * kPi), 0);
  const Vec3 t1 = Vec3::UnitX().cross(Vec3::UnitY());
  return {{{Vec3::UnitX(), Vec3::UnitY(), t1}, {x2, (-t1).cross(x2), -t1}}, N};
}

// J. B. Keller, J. Opt. Soc. Am. 52 (1962) 116-130: diffraction coefficients of a wedge, soft and hard, without their
// e^{-jks} / sqrt(s).
std::pair<double, double> keller(double N, double phi, double phi_in) {
  const double a = std::sin(kPi / N) / N;
  const double minus = 1 / (std::cos(kPi / N) - std::cos((phi - phi_in) / N)),
               plus = 1 / (std::cos(kPi / N) - std::cos((phi + phi_in) / N));
  return {a * (minus - plus), a * (minus + plus)};
}

// The same of physical optics on one illuminated face: half-line integrals of 2 n x H, as given by Ufimtsev, sin phi' /
// (cos phi + cos phi') for the soft one, -sin phi for the hard one, in the same scale.
std::pair<double, double> optics(double phi, double phi_in) {
  if (phi_in >= kPi) return {0, 0};
  const double pole = std::cos(phi) + std::cos(phi_in);
  return {std::sin(phi_in) / pole, -std::sin(phi) / pole};
}

// In the plane normal to the edge the exact wedge field is Keller's: fringe current = Keller's coefficient less that of
// physical optics. A line of p . K per metre radiates K sqrt(2 pi / k) e^{-j pi/4} e^{-jk rho} / sqrt(rho) in that
// plane; Keller's coefficients contain e^{-j pi/4} / sqrt(2 pi k): K = D / 2 pi.
TEST(FringeCurrent, IsKellersCoefficientLessThatOfPhysicalOptics) {
  Random random({3, Stream::kTest, 17});
  for (int i = 0; i < 300; ++i) {
    const double N = 1.05 + 0.95 * random.uniform();
    const double phi_in = N * kPi * random.uniform(), phi = N * kPi * random.uniform();
    // Keller's coefficients are infinite at the incident and the reflection shadow boundary; near them rounding errors
    // grow.
    if (std::abs(std::abs(phi - phi_in) - kPi) < 0.05 || std::abs(phi + phi_in - kPi) < 0.05 ||
        std::abs(2 * N * kPi - phi - phi_in - kPi) < 0.05) {
      continue;
    }
    const Vec3 k_hat(-std::cos(phi_in), -std::sin(phi_in), 0), s(std::cos(phi), std::sin(phi), 0);
    const auto [soft, hard] = keller(N, phi, phi_in);
    const auto [soft_1, hard_1] = optics(phi, phi_in);
    const auto [soft_2, hard_2] = optics(N * kPi - phi, N * kPi - phi_in);
    const Vec3 z = Vec3::UnitZ();
    const Vec3 K_soft = fringe_current(wedge(N), k_hat, z, s);
    EXPECT_NEAR(std::abs(K_soft.z() - (soft - soft_1 - soft_2) / (2 * kPi)), 0, 1e-9 * (1 + std::abs(soft)))
        << N << ' ' << phi_in << ' ' << phi;
    // Hard: H along z, E = H x k; the scattered H along z is (s x E_s).
    const Vec3 K_hard = fringe_current(wedge(N), k_hat, z.cross(k_hat), s);
    const Vec3 p = z.cross(s);
    EXPECT_NEAR(std::abs(p.dot(K_hard) - (hard - hard_1 - hard_2) / (2 * kPi)), 0, 1e-9 * (1 + std::abs(hard)))
        << N << ' ' << phi_in << ' ' << phi;
  }
}

// On Keller's cone Keller's coefficients grow by 1 / sin(beta), and so does the field of a line of currents with the
// phase of cos(beta) along it: K is constant.
TEST(FringeCurrent, IsTheSameOnEveryKellerCone) {
  const double N = 1.5, phi_in = 0.8, phi = 2.9;
  const auto [soft, hard] = keller(N, phi, phi_in);
  const auto [soft_1, hard_1] = optics(phi, phi_in);
  const auto [soft_2, hard_2] = optics(N * kPi - phi, N * kPi - phi_in);
  for (const double beta : {1.5, 1.0, 0.5}) {
    const double sb = std::sin(beta), cb = std::cos(beta);
    const Vec3 k_hat(-sb * std::cos(phi_in), -sb * std::sin(phi_in), cb), s(sb * std::cos(phi), sb * std::sin(phi), cb);
    // Ray-fixed unit vectors: phi^ and beta^ = k x phi^ of either ray (Kouyoumjian and Pathak).
    const Vec3 phi_hat_in = Vec3::UnitZ().cross(k_hat).normalized(), beta_in = k_hat.cross(phi_hat_in);
    const Vec3 phi_hat = Vec3::UnitZ().cross(s).normalized(), beta_out = s.cross(phi_hat);
    // The field along the edge keeps its sign with respect to beta^ of either ray; H along the edge with respect to
    // phi^.
    const double K_soft = beta_out.dot(fringe_current(wedge(N), k_hat, beta_in, s));
    const double K_hard = phi_hat.dot(fringe_current(wedge(N), k_hat, phi_hat_in, s));
    EXPECT_NEAR(std::abs(K_soft), std::abs(soft - soft_1 - soft_2) / (2 * kPi), 1e-9) << beta;
    EXPECT_NEAR(std::abs(K_hard), std::abs(hard - hard_1 - hard_2) / (2 * kPi), 1e-9) << beta;
  }
}

// Off the cones the angle a of the grazing ray may be imaginary. Here it is complex and the cotangents are
// Sommerfeld's.
TEST(FringeCurrent, IsTheCotangentsOfAComplexAngle) {
  Random random({3, Stream::kTest, 19});
  int imaginary = 0;
  for (int i = 0; i < 2000; ++i) {
    const double N = 1.05 + 0.95 * random.uniform(), phi = N * kPi * random.uniform(),
                 beta = 0.2 + 1.2 * random.uniform();
    const Vec3 k_hat(-std::sin(beta) * std::cos(phi), -std::sin(beta) * std::sin(phi), std::cos(beta));
    const Vec3 E = k_hat.cross(Vec3(0.3, -0.5, 0.8)).normalized();
    const double z = 2 * random.uniform() - 1, angle = 2 * kPi * random.uniform();
    const Vec3 s(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    const WedgeFrame frame = wedge(N);
    CVec3 expected = CVec3::Zero();
    bool near_a_pole = false;
    for (int face = 0; face < 2; ++face) {
      const auto& [x, n, t] = frame.face[face];
      const double own = face == 0 ? phi : N * kPi - phi, sin_b = std::sin(beta), cos_b = k_hat.dot(t);
      const double mu = (sin_b * s.dot(x) + cos_b * (s.dot(t) - cos_b)) / (sin_b * sin_b);
      imaginary += mu < -1;
      const Complex a = std::acos(Complex(-mu, 0));
      near_a_pole |= std::abs(a - own) < 0.05 || std::abs(a - kPi) < 0.05 || std::abs(a) < 0.05;
      const auto currents = [&](double wedge_N) {
        const Complex minus = 1.0 / (wedge_N * std::tan((a - own) / (2 * wedge_N))),
                      plus = 1.0 / (wedge_N * std::tan((a + own) / (2 * wedge_N)));
        return std::array<Complex, 2>{0.5 * (minus + plus) / std::sin(a), 0.5 * (minus - plus)};
      };
      auto [sum, difference] = currents(N);
      const double H_t = k_hat.cross(E).dot(t), E_t = E.dot(t);
      Complex optics_along = 0;
      if (own < kPi) {
        const auto [sum_1, difference_1] = currents(1);
        sum -= sum_1;
        difference -= difference_1;
        optics_along = 2.0 * j * cos_b / (sin_b * sin_b) * H_t;
      }
      const Complex across = 2.0 * j * H_t / sin_b * sum;
      expected += -j / (4 * kPi) *
                  (x * across +
                   t * (2.0 * j * E_t / (sin_b * sin_b) * difference + cos_b / sin_b * mu * across + optics_along));
    }
    if (near_a_pole) continue;
    const Vec3 K = fringe_current(frame, k_hat, E, s);
    EXPECT_LT(testing_echoes::norm_of(K.cast<Complex>() - expected), 1e-9 * (1 + K.norm()))
        << N << ' ' << phi << ' ' << beta;
  }
  EXPECT_GT(imaginary, 200);
}

// The same at a concave edge, where physical optics is the sum over all images: each face is illuminated by the
// incident wave and by the reflections of the other face, and vanishes where image theory is exact.
TEST(FringeCurrent, OfAConcaveEdgeIsKellersCoefficientLessThatOfItsImages) {
  Random random({3, Stream::kTest, 21});
  int reflected = 0;
  for (int i = 0; i < 600; ++i) {
    const double N = i % 3 == 0 ? 1.0 / (2 + i % 4) : 0.3 + 0.65 * random.uniform();
    const double phi_in = N * kPi * random.uniform(), phi = N * kPi * random.uniform();
    const Vec3 k_hat(-std::cos(phi_in), -std::sin(phi_in), 0), s(std::cos(phi), std::sin(phi), 0), z = Vec3::UnitZ();
    auto [soft, hard] = keller(N, phi, phi_in);
    bool near_a_boundary = false;
    for (const bool second : {false, true}) {
      const double out = second ? N * kPi - phi : phi, in = second ? N * kPi - phi_in : phi_in;
      for (int m = -5; m <= 5; ++m) {
        const double image = in + 2 * m * N * kPi;
        near_a_boundary |= std::abs(std::abs(image) - kPi) < 0.02 || std::abs(std::cos(out) + std::cos(image)) < 0.05;
        if (std::abs(image) > kPi) continue;
        // With each further reflection the electric field along the edge changes its sign, the magnetic one does not.
        const double pole = std::cos(out) + std::cos(image);
        soft -= std::sin(image) / pole;
        hard += std::sin(out) / pole;
        reflected += m != 0;
      }
    }
    if (near_a_boundary) continue;
    const double K_soft = fringe_current(wedge(N), k_hat, z, s).z(),
                 K_hard = z.cross(s).dot(fringe_current(wedge(N), k_hat, z.cross(k_hat), s));
    EXPECT_NEAR(K_soft, soft / (2 * kPi), 1e-9 * (1 + std::abs(soft))) << N << ' ' << phi_in << ' ' << phi;
    EXPECT_NEAR(K_hard, hard / (2 * kPi), 1e-9 * (1 + std::abs(hard))) << N << ' ' << phi_in << ' ' << phi;
    if (i % 3 != 0) continue;
    EXPECT_NEAR(K_soft, 0, 1e-9) << N;
    EXPECT_NEAR(K_hard, 0, 1e-9) << N;
  }
  EXPECT_GT(reflected, 500);
}

// A face radiates only towards receivers that see it: towards others the edge has all of Keller's field, except near
// the incident shadow boundary.
TEST(EquivalentEdgeCurrents, ExcludePhysicalOpticsOnlyOfVisibleFaces) {
  Random random({3, Stream::kTest, 20});
  int invisible = 0;
  for (int i = 0; i < 1000; ++i) {
    const double N = 1.05 + 0.95 * random.uniform();
    const double phi_in = N * kPi * random.uniform(), phi = N * kPi * random.uniform();
    const double from_shadow = std::abs(std::abs(phi - phi_in) - kPi);
    if (std::abs(from_shadow - kShadowBoundaryGuard) < 1e-3 || std::abs(phi + phi_in - kPi) < 0.05 ||
        std::abs(2 * N * kPi - phi - phi_in - kPi) < 0.05)
      continue;
    if (from_shadow < 0.05) continue;
    const Vec3 k_hat(-std::cos(phi_in), -std::sin(phi_in), 0), s(std::cos(phi), std::sin(phi), 0), z = Vec3::UnitZ();
    auto [soft, hard] = keller(N, phi, phi_in);
    for (const bool second : {false, true}) {
      const double out = second ? N * kPi - phi : phi, in = second ? N * kPi - phi_in : phi_in;
      if (in < kPi && out > kPi) ++invisible;
      if (out > kPi && from_shadow > kShadowBoundaryGuard) continue;
      const auto [soft_face, hard_face] = optics(out, in);
      soft -= soft_face;
      hard -= hard_face;
    }
    const auto [K_soft, K_hard] = equivalent_edge_currents(wedge(N), k_hat, {z, z.cross(k_hat)}, s);
    EXPECT_NEAR(K_soft.z(), soft / (2 * kPi), 1e-9 * (1 + std::abs(soft))) << N << ' ' << phi_in << ' ' << phi;
    EXPECT_NEAR(z.cross(s).dot(K_hard), hard / (2 * kPi), 1e-9 * (1 + std::abs(hard)))
        << N << ' ' << phi_in << ' ' << phi;
  }
  EXPECT_GT(invisible, 300);
}

TEST(FringeCurrent, IsFiniteEverywhereButAlongTheGrazingRay) {
  Random random({3, Stream::kTest, 18});
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] {
      const double z = 2 * random.uniform() - 1, angle = 2 * kPi * random.uniform();
      return Vec3(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    };
    const Vec3 k_hat = any();
    const Vec3 E = k_hat.cross(any()).normalized();
    // Backscatter, as in every monostatic sweep: the received component is normal to the direction.
    for (const double N : {1.2, 1.5, 2.0}) {
      const Vec3 K = fringe_current(wedge(N), k_hat, E, -k_hat);
      EXPECT_LT((K - k_hat * k_hat.dot(K)).cwiseAbs().maxCoeff(), 1)
          << N << ' ' << k_hat.x() << ' ' << k_hat.y() << ' ' << k_hat.z();
      const auto [all, again] = equivalent_edge_currents(wedge(N), k_hat, {E, E}, -k_hat);
      EXPECT_LT((all - K).norm(), 1e-12) << N << ' ' << k_hat.x() << ' ' << k_hat.y() << ' ' << k_hat.z();
    }
  }
}

}  // namespace
}  // namespace seaglint
