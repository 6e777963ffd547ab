// SPDX-License-Identifier: BSD-3-Clause
// No single edge contribution exceeds what an edge of its length can scatter.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <variant>
#include <vector>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/solver/aspect_trace.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/random_body.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Backscatter of a half-plane's edge less that of physical optics, per metre: (1 + 1 / cos phi - tan phi) / (4 pi) for
// a wave at the angle phi, largest at grazing (Keller's coefficients). Wedges and oblique waves scatter less.
constexpr double kFringe = 1 / (2 * kPi);
// End-point contribution of physical optics of unit current: 1 over 2 pi and the slope of psi. Where it is not
// cancelled at its pole, kSlopeWindow limits the slope, and kGrazingWindow the sine of the angle at which the beam
// meets the panel, over which the current of unit field is spread.
constexpr double kEndPoint = 1 / (2 * kPi * kSlopeWindow[1] * kGrazingWindow[1]);
// A path via reflectors and its reciprocal are one contribution.
constexpr double kBothSenses = 2;
// Terms of a wall in the penumbra that one contribution unites: at the foot, at the line, and the two of the path from
// the edge to the wall and back.
constexpr double kPenumbraTerms = 4;

// Bound of |S| of an edge contribution per metre of its length.
double bound(const Contribution& contribution, double k) {
  const AmplitudeLaw& amplitude = contribution.interval()->amplitude;
  // Width times k of the transition region of a half-plane over 2 pi, at distances up to `distance`.
  const auto transition = [&](double distance) { return std::sqrt(k * distance / (2 * kPi)) / (2 * kPi); };
  switch (contribution.source.mechanism) {
    case Mechanism::kSingleDiffraction: return kFringe;
    case Mechanism::kReflectedEdge: return kBothSenses * kEndPoint;
    case Mechanism::kShadowBoundary: {
      const auto* knives = std::get_if<DoubleKnifeEdge>(&amplitude);
      return kEndPoint + (knives ? transition(std::ranges::max(knives->separation)) / kGrazingWindow[1] : 0.0);
    }
    case Mechanism::kWallPenumbra:
      return kPenumbraTerms * std::sqrt(2.0) * transition(std::ranges::max(std::get<WallPenumbraTerm>(amplitude).l));
    // Each grazing wave is at most the field at the edge that launches it; at the last edge it radiates the fringe
    // current and the end of the current of the edge before.
    default: return kFringe + kEndPoint;
  }
}

// Largest |S| / bound of each mechanism.
using Excess = std::array<double, kMechanisms>;

Excess largest_excess(const Scatterer& scatterer, double frequency_hz, std::span<const Vec3> views,
                      double min_patch_m = 0) {
  const std::array k{wavenumber(frequency_hz)};
  const TracingSettings settings{min_patch_m, kDefaultBounces, true};
  Excess excess{};
  for (const Vec3& r_hat : views) {
    const std::array pair{monostatic(radar_basis(r_hat))};
    const AspectTrace trace(scatterer, pair, settings, k, Reciprocity::kNone, 1);
    trace.run([&](const PairContributions& from) {
      for (const Contribution& contribution : from.contributions) {
        if (!contribution.interval()) continue;
        double& of_kind = excess[static_cast<std::size_t>(contribution.source.mechanism)];
        of_kind = std::max(of_kind, largest(scattered(contribution, pair[0], k[0])) /
                                        (bound(contribution, k[0]) * contribution.interval()->length));
      }
    });
  }
  return excess;
}

void expect_bounded(const char* name, const Excess& excess) {
  const auto of = [&](Mechanism mechanism) { return excess[static_cast<std::size_t>(mechanism)]; };
  std::printf(
      "%s: at most %.3f (single), %.3f (reflected edge), %.3f (shadow boundary), %.3f (penumbra), %.3f (multiple), "
      "%.3f (concave edge) of the bound\n",
      name, of(Mechanism::kSingleDiffraction), of(Mechanism::kReflectedEdge), of(Mechanism::kShadowBoundary),
      of(Mechanism::kWallPenumbra), of(Mechanism::kMultipleDiffraction), of(Mechanism::kConcaveEdge));
  EXPECT_GT(of(Mechanism::kReflectedEdge), 0);
  constexpr double kRounding = 1e-6;
  for (const double ratio : excess) EXPECT_LE(ratio, 1 + kRounding);
}

TEST(EdgeContributionBound, HoldsOnTheShip) {
  const Scatterer ship(repair(read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb")));
  std::vector<Vec3> views;
  for (int i = 0; i < 8; ++i) views.push_back(direction(10 + 47.0 * i, 2 + 4.0 * i));
  expect_bounded("ship", largest_excess(ship, 10e9, views));
}

// At azimuth 129.508 psi does not vary across the image of an edge's face on a reflector askew to it.
TEST(EdgeContributionBound, HoldsOnADefectiveMesh) {
  const Scatterer moskva(repair(read_mesh(SEAGLINT_SOURCE_DIR "/tests/reference/meshes/moskva.glb")));
  expect_bounded("moskva", largest_excess(moskva, 635.49e9,
                                          std::array{direction(129.508, 5), direction(45, 2), direction(260, 20)}));
}

TEST(EdgeContributionBound, HoldsOnRandomBodies) {
  std::vector<Vec3> views;
  for (int i = 0; i < 3; ++i) views.push_back(direction(17 + 97.0 * i, 3 + 20 * i));
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
    expect_bounded("random body", largest_excess(Scatterer(random_body(seed)), 10e9, views, 1e-3));
}

}  // namespace
}  // namespace seaglint
