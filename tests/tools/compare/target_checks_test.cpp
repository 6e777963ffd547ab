// SPDX-License-Identifier: BSD-3-Clause
// Differences of an export and of compared values from exact and closed-form values.
#include "tools/compare/target_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/canonical/canonical_body.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

PairedCut::Place place_of(double frequency_hz, double azimuth_deg) {
  PairedCut::Place place;
  place.frequency_hz = frequency_hz;
  place.azimuth_deg = azimuth_deg;
  place.path_gradient = 4 * kPi * frequency_hz / kSpeedOfLight * direction_to_radar(radians(azimuth_deg), 0);
  return place;
}

// A cut over azimuth at one frequency with these levels everywhere.
PairedCut flat_cut(Polarisation element, double reference_dbsm, double compared_dbsm) {
  PairedCut cut;
  cut.reference = "other.csv";
  cut.element = element;
  cut.models.push_back({"seaglint", {}, {}});
  for (int n = 0; n < 5; ++n) {
    cut.x.push_back(n);
    cut.places.push_back(place_of(10e9, n));
    cut.level_dbsm.push_back(reference_dbsm);
    cut.models[0].level_dbsm.push_back(compared_dbsm);
  }
  return cut;
}

CanonicalBody sphere(double radius, const Vec3& centre) {
  return {CanonicalShape::kSphere, centre, radius, 0, Mat3::Identity()};
}

// The exact level of the sphere of 0.3 m at 10 GHz, ka 62.9, within 0.02 dB of pi a^2 (-5.486 dBsm).
TEST(KnownValues, StatesBothBiasesOfASphere) {
  std::vector<PairedCut> cuts{flat_cut(Polarisation::kVv, -6.54, -5.51), flat_cut(Polarisation::kHv, -80, -90)};
  const auto known = known_values(cuts, std::vector{sphere(0.3, Vec3::Zero())}, 80);
  ASSERT_TRUE(known);
  ASSERT_EQ(known->statistics.size(), 1u) << "a sphere has no cross-polar echo";
  const KnownStatistics& s = known->statistics[0];
  EXPECT_EQ(s.reference.points, 5u);
  EXPECT_EQ(s.error_db, 0);
  EXPECT_NEAR(s.reference.bias_db, -6.54 + 5.486, 0.02);
  EXPECT_NEAR(s.compared.bias_db, -5.51 + 5.486, 0.02);
  EXPECT_NEAR(s.reference.rms_db, std::abs(s.reference.bias_db), 1e-9);
  ASSERT_TRUE(cuts[0].known);
  EXPECT_EQ(cuts[0].known->name, "exact (Mie series)");
  EXPECT_NEAR(cuts[0].known->level_dbsm[2], -5.486, 0.02);
  EXPECT_FALSE(cuts[1].known);
  EXPECT_THAT(known_lines(*known, "seaglint"), ElementsAre(HasSubstr("rms 0.0")));
  EXPECT_THAT(known_lines(*known, "seaglint")[0], HasSubstr("vv: exact (Mie series) of a sphere of radius 0.3 m, 5 "));
  EXPECT_THAT(known_lines(*known, "seaglint")[0], HasSubstr(": seaglint is closer"));
}

TEST(KnownValues, OfATotalIsTheSumOverBothReceivedPolarisations) {
  std::vector<PairedCut> cuts{flat_cut(Polarisation::kVv, -6.54, -5.51), flat_cut(Polarisation::kVv, -6.54, -5.51)};
  cuts[1].total = true;
  const auto known = known_values(cuts, std::vector{sphere(0.3, Vec3::Zero())}, 80);
  ASSERT_TRUE(known);
  ASSERT_EQ(known->statistics.size(), 2u);
  EXPECT_EQ(known->statistics[1].quantity, quantity_of(Polarisation::kVv, true));
  EXPECT_NEAR(cuts[1].known->level_dbsm[0], cuts[0].known->level_dbsm[0], 1e-9);  // no cross-polar echo
}

TEST(KnownValues, OfAPlateAreThoseOfItsMainLobe) {
  CanonicalBody plate{CanonicalShape::kPlate, Vec3::Zero(), 0.3, 0.2, Mat3::Identity()};
  plate.axes = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};  // sides along y and z, normal along x
  const double peak = 10 * std::log10(4 * kPi * std::pow(0.06 * 10e9 / kSpeedOfLight, 2));
  std::vector<PairedCut> cuts{flat_cut(Polarisation::kHh, peak + 1, peak)};
  const auto known = known_values(cuts, std::vector{plate}, 80);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->name, "closed form");
  // 3 dB at sin(X) / X = 0.708, X = 1.39 = k a sin(azimuth): 1.27 deg.
  EXPECT_EQ(known->statistics[0].reference.points, 2u);
  EXPECT_NEAR(cuts[0].known->level_dbsm[0], peak, 1e-9);
  EXPECT_TRUE(std::isnan(cuts[0].known->level_dbsm[2]));
  // 3 / (k b) of the amplitude, k b = 41.9.
  EXPECT_NEAR(known->statistics[0].error_db, 20 * std::log10(1 + 3 / 41.9), 1e-3);
}

// Two spheres apart in range, a third in the shadow of the first: their levels by range, the third left out. The export
// returns half the amplitude of the first.
TEST(KnownValues, OfSeveralSpheresAreLevelsByRange) {
  const std::vector<CanonicalBody> bodies{sphere(0.3, Vec3::Zero()), sphere(0.2, Vec3(3, 5, 0)),
                                          sphere(0.2, Vec3(-8, 0.4, 0))};
  PairedCut cut;
  cut.axis = CutAxis::kFrequency;
  cut.element = Polarisation::kVv;
  cut.models.push_back({"seaglint", {}, {}});
  for (int n = 0; n <= 200; ++n) {
    const double f = 9.25e9 + 7.5e6 * n;
    cut.places.push_back(place_of(f, 0));
    cut.x.push_back(1e-9 * f);
    const auto of = [&](const CanonicalBody& body) {
      return CanonicalSolution(body, f).at(monostatic(radar_basis(Vec3::UnitX())))->matrix_m[3];
    };
    cut.amplitude_m.push_back(0.5 * of(bodies[0]) + of(bodies[1]));
    cut.models[0].amplitude_m.push_back(of(bodies[0]) + of(bodies[1]));
    cut.level_dbsm.push_back(dbsm(cut.amplitude_m.back()));
    cut.models[0].level_dbsm.push_back(dbsm(cut.models[0].amplitude_m.back()));
  }
  std::vector<PairedCut> cuts{cut};
  const auto known = known_values(cuts, bodies, 80);
  ASSERT_TRUE(known);
  ASSERT_EQ(known->levels.size(), 2u);
  // pi a^2 within 0.1 dB; side lobes of Hann's window are below -31 dB.
  EXPECT_NEAR(known->levels[0].known_dbsm, -5.49, 0.1);
  EXPECT_NEAR(known->levels[0].reference_dbsm - known->levels[0].known_dbsm, -6.02, 0.1);
  EXPECT_NEAR(known->levels[0].compared_dbsm, known->levels[0].known_dbsm, 0.1);
  EXPECT_NEAR(known->levels[0].range_m, -0.3, 1e-9);
  EXPECT_NEAR(known->levels[1].known_dbsm, -9.01, 0.1);
  EXPECT_THAT(known_lines(*known, "seaglint")[0], HasSubstr("seaglint is closer"));
}

TEST(KnownValues, VerdictsRespectTheErrorOfTheClosedForm) {
  EXPECT_EQ(closer_text(1.05, 0.02, 0, "seaglint"), "seaglint is closer");
  EXPECT_EQ(closer_text(0.02, 1.05, 0, "seaglint"), "the export is closer");
  EXPECT_EQ(closer_text(0.5, 0.52, 0, "seaglint"), "both are equally close");
  EXPECT_EQ(closer_text(0.1, 0.3, 0.4, "seaglint"), "both are within its own error of about 0.40 dB");
  EXPECT_EQ(closer_text(3, 0.3, 0.4, "seaglint"), "seaglint is closer");
}

TEST(KnownValues, AreNoneOfOtherTargets) {
  std::vector<PairedCut> cuts{flat_cut(Polarisation::kVv, 0, 0)};
  EXPECT_FALSE(known_values(cuts, {}, 80));
}

}  // namespace
}  // namespace seaglint
