// SPDX-License-Identifier: BSD-3-Clause
// Matching of references with a sweep, grids of views, statistics of differences; lobes, nulls and range profiles
// against closed forms.
#include "tools/compare/differences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "tools/compare/paired_cut.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

constexpr double kPrinted_db = 1e-9;  // rounding of logarithm and power

RcsSweep sweep_of(std::vector<double> azimuth_deg, const std::vector<Complex>& vv) {
  RcsSweep sweep;
  sweep.frequency_hz = {10e9};
  sweep.azimuth_deg = std::move(azimuth_deg);
  sweep.elevation_deg = {0};
  sweep.models = {{"po", false, {}}};
  for (const Complex& s : vv) sweep.models[0].matrices.push_back({std::array<Complex, 4>{0, 0, 0, s}});
  return sweep;
}

RcsCut cut_of(const std::vector<std::pair<double, Complex>>& values) {
  RcsCut cut;
  cut.name = "other";
  cut.element = Polarisation::kVv;
  for (const auto& [phi, s] : values) cut.values.push_back({10e9, 90, phi, 10 * std::log10(4 * kPi * std::norm(s)), s});
  return cut;
}

TEST(RcsComparison, FindsTheSameDirectionsThroughTheAnglesMap) {
  RcsCut cut = cut_of({{180.0004, 10}, {89.9996, 30}, {340, 40}, {7, 70}});
  cut.phi_scale = -1;
  cut.phi_offset_deg = 180;
  // Azimuth 0, 90, 200 deg are phi 180, 90, 340 of the reference; 0.0004 deg are the printed digits' rounding.
  const auto cuts = match_reference(sweep_of({0, 45, 90, 200}, {1, 2, 3, 4}), cut);
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_EQ(cuts[0].x, (std::vector<double>{0, 90, 200}));
  EXPECT_EQ(cuts[0].models[0].amplitude_m, (std::vector<Complex>{1, 3, 4}));
  EXPECT_EQ(*cuts[0].frequency_hz, 10e9);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(error_statistics(cuts[0], cuts[0].models[0], 80).bias_db, -20, kPrinted_db);
}

TEST(RcsComparison, ClipsLevelsToTheFloor) {
  // 0, -10 and -300 dB against 0, -13 and -90 dB below the maximum.
  const auto db = [](double x) { return std::pow(10.0, x / 20); };
  const auto cuts =
      match_reference(sweep_of({0, 1, 2}, {1, db(-10), db(-300)}), cut_of({{0, 1}, {1, db(-13)}, {2, db(-90)}}));
  const Difference wide = error_statistics(cuts[0], cuts[0].models[0], 80);
  EXPECT_NEAR(wide.mean_db, 1, kPrinted_db);  // 0, 3, 0
  EXPECT_NEAR(wide.rms_db, std::sqrt(3.0), kPrinted_db);
  EXPECT_NEAR(wide.largest_db, 3, kPrinted_db);
  EXPECT_EQ(wide.largest_at, 1);
  const Difference deep = error_statistics(cuts[0], cuts[0].models[0], 100);
  EXPECT_NEAR(deep.largest_db, -10, kPrinted_db);
  EXPECT_NEAR(deep.bias_db, (3.0 - 10) / 3, kPrinted_db);
}

TEST(RcsComparison, CorrelatesComplexValuesAboutTheBodysOrigin) {
  // The same point scatterer at x0, with the phase reference at the body's origin here and at x0 there: S = e^{2jk
  // r.x0} (CONVENTIONS.md).
  const Vec3 x0(0.3, -0.2, 0.1);
  const double k = 2 * kPi * 10e9 / kSpeedOfLight;
  std::vector<double> azimuths;
  std::vector<Complex> ours;
  std::vector<std::pair<double, Complex>> theirs;
  for (double az = 0; az < 90; az += 5) {
    azimuths.push_back(az);
    ours.push_back(std::polar(1.0, 2 * k * Vec3(std::cos(radians(az)), std::sin(radians(az)), 0).dot(x0)));
    theirs.push_back({az, std::polar(1.0, radians(-25))});
  }
  RcsCut about_x0 = cut_of(theirs);
  about_x0.origin_m = x0;
  const auto moved = match_reference(sweep_of(azimuths, ours), about_x0);
  const Complex correlation = *error_statistics(moved[0], moved[0].models[0], 80).correlation;
  EXPECT_NEAR(std::abs(correlation), 1, 1e-9);
  EXPECT_NEAR(degrees(std::arg(correlation)), 25, 1e-6);
  const auto unmoved = match_reference(sweep_of(azimuths, ours), cut_of(theirs));
  EXPECT_LT(std::abs(*error_statistics(unmoved[0], unmoved[0].models[0], 80).correlation), 0.5);
}

TEST(RcsComparison, RefusesAReferenceWithoutCommonSamplesAndListsBoth) {
  try {
    match_reference(sweep_of({0, 1}, {1, 1}), cut_of({{30, 1}, {60, 1}}));
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("phi 30 to 60 (2 values)"));
    EXPECT_THAT(error.what(), HasSubstr("phi 0 to 1 (2 values)"));
  }
  EXPECT_THROW(match_reference(sweep_of({0}, {1}), cut_of({{0, 1}, {0, 2}})), InputError)
      << "one direction with two levels";
}

// At azimuth 20, elevation 10 deg by both, whatever the file's origin of phi; for a file that does not specify its
// transmitter it may be either.
TEST(RcsComparison, RefusesAReferenceOfAnotherTransmitter) {
  const auto refusal = [](const RcsSweep& sweep, const RcsCut& reference) -> std::string {
    try {
      match_reference(sweep, reference);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  RcsSweep sweep = sweep_of({0, 1}, {1, 1});
  RcsCut monostatic = cut_of({{0, 1}, {1, 1}}), bistatic = monostatic, silent = monostatic;
  monostatic.transmitter.emplace();
  bistatic.transmitter = DeclaredTransmitter{false, 80, 20};
  EXPECT_EQ(refusal(sweep, silent), "");
  EXPECT_EQ(refusal(sweep, monostatic), "");
  EXPECT_THAT(
      refusal(sweep, bistatic),
      HasSubstr("its transmitter is at azimuth 20 deg, elevation 10 deg, the sweep is monostatic: give --transmit"));
  sweep.transmitter = Vec3(std::cos(radians(10)) * std::cos(radians(20)), std::cos(radians(10)) * std::sin(radians(20)),
                           std::sin(radians(10)));
  EXPECT_EQ(refusal(sweep, silent), "");
  EXPECT_EQ(refusal(sweep, bistatic), "");
  EXPECT_THAT(refusal(sweep, monostatic),
              HasSubstr("is declared monostatic, the sweep's transmitter is at azimuth 20 deg"));
  bistatic.transmitter->phi_deg = 21;
  EXPECT_THAT(
      refusal(sweep, bistatic),
      HasSubstr("azimuth 21 deg, elevation 10 deg, the sweep's transmitter is at azimuth 20 deg, elevation 10 deg"));
  bistatic.phi_offset_deg = 1;
  EXPECT_EQ(refusal(sweep, bistatic), "");
}

std::vector<ViewPoint> points_of(const std::vector<ViewGrid>& grids) {
  std::vector<ViewPoint> points;
  for (const ViewGrid& grid : grids) {
    for (const double f : grid.frequency_hz) {
      for (const double az : grid.azimuth_deg) {
        for (const double el : grid.elevation_deg) points.push_back({f, az, el});
      }
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

TEST(ViewGrids, OfASweepAreOne) {
  std::vector<ViewPoint> points;
  for (const double f : {2.0, 1.0, 3.0}) {
    for (const double az : {0.0, 10.0, 20.0}) {
      for (const double el : {5.0, 1.0}) points.push_back({f, az, el});
    }
  }
  const std::vector<ViewGrid> grids = view_grids(points);
  ASSERT_EQ(grids.size(), 1u);
  EXPECT_THAT(grids[0].frequency_hz, testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(grids[0].elevation_deg, testing::ElementsAre(1, 5));
}

// Three principal cuts, one of them at fewer frequencies, and a point that stands twice.
TEST(ViewGrids, HoldEveryPointOnce) {
  std::vector<ViewPoint> points;
  for (double angle = 0; angle < 90; angle += 30) {
    points.push_back({1, angle, 0});
    points.push_back({2, angle, 0});
    points.push_back({1, 0, angle});
    points.push_back({1, 90, angle});
  }
  const std::vector<ViewGrid> grids = view_grids(points);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  EXPECT_EQ(points_of(grids), points);
  EXPECT_LE(grids.size(), 4u);
  EXPECT_THAT(view_grids({}), testing::IsEmpty());
}

// A cut over five azimuths at one frequency.
PairedCut cut_at(double ghz, Polarisation element, double reference_dbsm, double compared_dbsm, double step_deg = 1) {
  PairedCut cut;
  cut.reference = "other.csv";
  cut.element = element;
  cut.frequency_hz = 1e9 * ghz;
  cut.models.push_back({"seaglint", {}, {}});
  for (int n = 0; n < 5; ++n) {
    PairedCut::Place place;
    place.frequency_hz = 1e9 * ghz;
    place.azimuth_deg = n < 4 ? n : 3 + step_deg;
    cut.x.push_back(place.azimuth_deg);
    cut.places.push_back(place);
    cut.level_dbsm.push_back(reference_dbsm - n);
    cut.models[0].level_dbsm.push_back(compared_dbsm - 2 * n);
  }
  return cut;
}

TEST(ComparisonImages, HaveLevelsAndDifferencesOverAzimuthAndFrequency) {
  std::vector<PairedCut> cuts;
  for (const double ghz : {9.2, 9.0, 9.1}) {
    cuts.push_back(cut_at(ghz, Polarisation::kHh, 3 + ghz, 4 + ghz));
    cuts.push_back(cut_at(ghz, Polarisation::kHv, -20, -20));
  }
  const std::vector<Heatmap> images = comparison_images(cuts, 80);
  ASSERT_EQ(images.size(), 3u);
  EXPECT_THAT(images[0].title, testing::HasSubstr("hh"));
  EXPECT_THAT(images[0].map.y,
              testing::ElementsAre(testing::DoubleEq(9.0), testing::DoubleEq(9.1), testing::DoubleEq(9.2)));
  EXPECT_THAT(images[0].map.x, testing::ElementsAre(0, 1, 2, 3, 4));
  EXPECT_NEAR(images[0].map.values[5 * 2 + 3], 3 + 9.2 - 3, 1e-12);
  EXPECT_NEAR(images[1].map.values[5 * 2 + 3], 4 + 9.2 - 6, 1e-12);
  EXPECT_NEAR(images[2].map.values[5 * 2 + 3], 1 - 3, 1e-12);
  EXPECT_TRUE(images[2].diverging);
  EXPECT_EQ(images[2].colour.range->first, -images[2].colour.range->second);
  EXPECT_EQ(images[0].colour.range, images[1].colour.range);
}

TEST(ComparisonImages, AreNoneOfTwoFrequenciesAndOfUnevenAngles) {
  std::vector<PairedCut> cuts{cut_at(9, Polarisation::kHh, 0, 0), cut_at(10, Polarisation::kHh, 0, 0)};
  EXPECT_TRUE(comparison_images(cuts, 80).empty());
  for (PairedCut& cut : cuts) cut = cut_at(1e-9 * *cut.frequency_hz, Polarisation::kHh, 0, 0, 2);
  cuts.push_back(cut_at(11, Polarisation::kHh, 0, 0, 2));
  EXPECT_TRUE(comparison_images(cuts, 80).empty());
}

// Of nine frequencies in two polarisations the figure has two of each, not the first four.
TEST(ComparisonPlots, HaveTheExportBlackTheComputedBlueAndFrequenciesFromTheWholeBand) {
  std::vector<PairedCut> cuts;
  for (int n = 0; n < 9; ++n) {
    for (const Polarisation element : {Polarisation::kHh, Polarisation::kVv, Polarisation::kHv})
      cuts.push_back(cut_at(9 + 0.1 * n, element, element == Polarisation::kHv ? -20 : 0, 0));
  }
  const PlotPanels panels = comparison_plots(cuts, 80);
  ASSERT_EQ(panels.plots.size(), 8u);
  std::vector<std::string> titles;
  for (const LinePlot& plot : panels.plots) {
    if (plot.title.empty()) continue;
    titles.push_back(plot.title);
    EXPECT_EQ(plot.series[0].colour, kReferenceColour);
    EXPECT_EQ(plot.series[1].colour, kComputedColour);
  }
  EXPECT_THAT(titles, testing::UnorderedElementsAre("HH, 9.2 GHz", "VV, 9.2 GHz", "HH, 9.6 GHz", "VV, 9.6 GHz"));
}

// Levels of a uniform aperture, sinc(u), of which the lobes and nulls are known.
struct Pattern {
  std::vector<double> u, level_db;
};

Pattern aperture(double shift) {
  Pattern pattern;
  for (int i = -200; i <= 200; ++i) {
    const double u = 0.02 * i, v = kPi * (u - shift);
    pattern.u.push_back(u);
    pattern.level_db.push_back(20 * std::log10(std::max(std::abs(std::abs(v) < 1e-9 ? 1.0 : std::sin(v) / v), 1e-4)));
  }
  return pattern;
}

TEST(Lobes, OfAnApertureAreWhereTheyMustBe) {
  const Pattern p = aperture(0);
  const std::vector<Extremum> lobes = lobes_of(p.u, p.level_db, -60);
  ASSERT_EQ(lobes.size(), 7u);  // one and three on either side, at tan(pi u) = pi u
  EXPECT_NEAR(lobes[3].x, 0, 1e-6);
  EXPECT_NEAR(lobes[4].x, 1.4303, 1e-3);
  EXPECT_NEAR(lobes[4].level_db, -13.261, 0.01);
  EXPECT_NEAR(lobes[5].x, 2.4590, 1e-3);
  const std::vector<Extremum> nulls = nulls_of(p.u, p.level_db, -100);
  ASSERT_EQ(nulls.size(), 6u);
  EXPECT_NEAR(nulls[3].x, 1, 1e-3);
  EXPECT_THAT(lobes_of(p.u, p.level_db, -15), testing::SizeIs(3));
}

TEST(Lobes, ArePairedWithTheNearest) {
  const Pattern a = aperture(0), b = aperture(0.06);
  const ExtremumPairs pairs = paired_extrema(lobes_of(a.u, a.level_db, -30), lobes_of(b.u, b.level_db, -30));
  EXPECT_EQ(pairs.count, 7u);
  EXPECT_EQ(pairs.paired, 7u);
  EXPECT_NEAR(pairs.mean_shift, 0.06, 1e-3);
  EXPECT_NEAR(pairs.mean_db, 0, 0.01);
  EXPECT_EQ(paired_extrema(lobes_of(a.u, a.level_db, -30), {}).paired, 0u);
}

TEST(RangeProfile, OfAPointHasItsPlaceAndLevel) {
  std::vector<PairedCut::Place> places;
  std::vector<Complex> amplitudes;
  for (int i = 0; i < 101; ++i) {
    PairedCut::Place place;
    place.frequency_hz = 9e9 + 1e7 * i;
    place.path_gradient = Vec3(4 * kPi * place.frequency_hz / kSpeedOfLight, 0, 0);
    places.push_back(place);
    amplitudes.push_back(0.5 * std::polar(1.0, place.path_gradient.dot(Vec3(-1.25, 2, 0))));
  }
  const RangeProfile profile = range_profile(places, amplitudes);
  ASSERT_FALSE(profile.range_m.empty());
  const auto peak = std::max_element(profile.level_dbsm.begin(), profile.level_dbsm.end()) - profile.level_dbsm.begin();
  const double cell = profile.range_m[1] - profile.range_m[0];
  EXPECT_NEAR(profile.range_m[static_cast<std::size_t>(peak)], 1.25, cell);  // behind the origin
  EXPECT_NEAR(profile.level_dbsm[static_cast<std::size_t>(peak)], 10 * std::log10(4 * kPi * 0.25),
              0.3);  // of a quarter cell
  EXPECT_NEAR(profile.range_m.back() - profile.range_m.front(), kSpeedOfLight / 2e7, 1e-6);
  places[40].path_gradient *= 1.001;
  EXPECT_THAT(range_profile(places, amplitudes).range_m, testing::IsEmpty()) << "uneven steps";
}

}  // namespace
}  // namespace seaglint
