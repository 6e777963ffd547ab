// SPDX-License-Identifier: BSD-3-Clause
// Statistics over sectors of azimuth, of the whole target and by part; steps beside lobes.
#include "tools/rcs/rcs_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/refusal.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

constexpr double kSumRounding = 1e-12;

// A sweep of one model whose elements have these cross-sections, m^2, by view and frequency.
template <class Area>
RcsSweep sweep_with(std::vector<double> azimuth_deg, std::vector<double> elevation_deg, std::size_t frequencies,
                    const Area& area_m2) {
  RcsSweep sweep;
  sweep.azimuth_deg = std::move(azimuth_deg);
  sweep.elevation_deg = std::move(elevation_deg);
  for (std::size_t q = 0; q < frequencies; ++q) sweep.frequency_hz.push_back(9e9 + 1e7 * static_cast<double>(q));
  RcsSweep::Model& model = sweep.models.emplace_back();
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    auto& values = model.matrices.emplace_back();
    for (std::size_t q = 0; q < frequencies; ++q) {
      const double s = std::sqrt(area_m2(view, q) / (4 * kPi));
      values.push_back({s, s / 2, s / 2, Complex(0, -s)});
    }
  }
  return sweep;
}

std::vector<double> azimuths_from(double first, double last, double step) {
  std::vector<double> values;
  for (double i = 0; first + i * step <= last + 1e-9; ++i) values.push_back(first + i * step);
  return values;
}

using Choice = std::optional<std::size_t>;

const SectorStatistics& row_of(const RcsStatistics& statistics, std::size_t element, Choice elevation, Choice sector) {
  const auto found = std::ranges::find_if(statistics.rows, [&](const SectorStatistics& row) {
    return !row.part && row.element == element && row.elevation == elevation && row.sector == sector;
  });
  EXPECT_NE(found, statistics.rows.end());
  return *found;
}

// Percentiles of 0, 1, ... 100 by quantile(): the value of rank p (n - 1). Of 0 and 1: linear between both.
TEST(AreaStatistics, AreTheRanksOfOrderedValues) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  const AreaStatistics ranks = area_statistics(values);
  EXPECT_EQ(ranks.values, 101u);
  EXPECT_NEAR(ranks.p5_m2, 5, kSumRounding * 100);
  EXPECT_NEAR(ranks.p25_m2, 25, kSumRounding * 100);
  EXPECT_NEAR(ranks.median_m2, 50, kSumRounding * 100);
  EXPECT_NEAR(ranks.p75_m2, 75, kSumRounding * 100);
  EXPECT_NEAR(ranks.p95_m2, 95, kSumRounding * 100);
  EXPECT_NEAR(ranks.mean_m2, 50, kSumRounding * 100);
  EXPECT_EQ(ranks.largest_m2, 100);
  EXPECT_NEAR(area_statistics({1, 0}).p5_m2, 0.05, kSumRounding);
  EXPECT_TRUE(std::isnan(area_statistics({}).median_m2));
}

// The cross-section of many scatterers of random phase is distributed exponentially: percentile p of mean 1 is
// -ln(1 - p) (Swerling, IRE Transactions IT-6, 1960, 269, case 1). Of the N values at the middles of N
// equal probabilities the percentile of rank p (N - 1) has the probability p + (0.5 - p) / N, and the quantile's slope
// is 1 / (1 - p). Their mean lacks ln(2) / 2N of the last interval (Stirling).
TEST(AreaStatistics, OfAnExponentialDistributionAreItsQuantiles) {
  constexpr double kValues = 20000;
  std::vector<double> values;
  for (double i = 0; i < kValues; ++i) values.push_back(-std::log(1 - (i + 0.5) / kValues));
  const AreaStatistics areas = area_statistics(values);
  for (const auto& [p, found] : {std::pair{0.05, areas.p5_m2},
                                 {0.25, areas.p25_m2},
                                 {0.5, areas.median_m2},
                                 {0.75, areas.p75_m2},
                                 {0.95, areas.p95_m2}}) {
    const double rank = std::abs(0.5 - p) / kValues / (1 - p), between = 1 / kValues / (1 - p) / kValues / (1 - p);
    EXPECT_NEAR(found, -std::log(1 - p), rank + between + kSumRounding) << p;
  }
  EXPECT_NEAR(areas.mean_m2, 1 - std::log(2) / (2 * kValues), 1 / (kValues * kValues) + kSumRounding);
}

TEST(Sectors, AreCentredOnTheBowAndGoOnAcrossTheTurn) {
  for (const double azimuth : {-15.0, 0.0, 14.99, 345.0, 359.9, 360.0, 374.9, -375.0, 705.0, -720.0})
    EXPECT_EQ(sector_of(azimuth, 30), 0u) << azimuth;
  for (const double azimuth : {15.0, 44.9, 375.0, -345.0}) EXPECT_EQ(sector_of(azimuth, 30), 1u) << azimuth;
  for (const double azimuth : {165.0, 180.0, 194.9, -180.0, -165.1}) EXPECT_EQ(sector_of(azimuth, 30), 6u) << azimuth;
  for (const double azimuth : {315.0, 344.9, -15.1}) EXPECT_EQ(sector_of(azimuth, 30), 11u) << azimuth;
  // 150 steps of 0.1 deg are 15.000000000000002 deg, three of 0.1 are 0.30000000000000004.
  EXPECT_EQ(sector_of(-0.1 * 150, 30), 0u);
  EXPECT_EQ(sector_of(0.1 * 3, 0.6), 1u);
  EXPECT_EQ(sector_of(123, 360), 0u);
}

TEST(Sectors, DivideTheTurn) {
  EXPECT_EQ(sector_count(30), 12u);
  EXPECT_EQ(sector_count(22.5), 16u);
  EXPECT_EQ(sector_count(360), 1u);
  EXPECT_EQ(sector_count(0.1), 3600u);
  for (const double width : {50.0, 0.0, -30.0, 720.0, 0.05, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_HAS(refusal_of([&] { sector_count(width); }), "must divide 360 and be within 0.1 and 360") << width;
  EXPECT_HAS(refusal_of([] { sector_count(50); }), "--sector-deg: value 50:");
}

// Every view is in one sector; 360 deg is the view at 0.
TEST(SectorStatistics, HaveEveryViewOnce) {
  const auto one = [](std::size_t, std::size_t) { return 1.0; };
  const RcsStatistics turn = rcs_statistics(sweep_with(azimuths_from(0, 360, 0.5), {1, 5}, 3, one));
  EXPECT_EQ(turn.azimuths, 720u);
  for (std::size_t sector = 0; sector < 12; ++sector) {
    EXPECT_EQ(row_of(turn, 0, 0, sector).views, 60u);
    EXPECT_EQ(row_of(turn, 0, 1, sector).area.values, 180u);
    EXPECT_EQ(row_of(turn, 3, {}, sector).views, 120u);
  }
  EXPECT_EQ(row_of(turn, 0, {}, {}).views, 1440u);
  EXPECT_EQ(row_of(turn, 0, {}, {}).area.values, 4320u);
  EXPECT_EQ(turn.rows.size(), 4u * 3 * 13);
  // The same views from -180 deg on.
  EXPECT_EQ(row_of(rcs_statistics(sweep_with(azimuths_from(-180, 180, 0.5), {1}, 1, one)), 0, 0, 6).views, 60u);
  // Sectors without views have no row: bow, next sector and all of either elevation and of both.
  EXPECT_EQ(rcs_statistics(sweep_with(azimuths_from(-10, 40, 1), {1, 5}, 1, one)).rows.size(), 4u * 3 * 3);
}

// All azimuths are the union of the sectors, all elevations that of the elevations.
TEST(SectorStatistics, OfAllAreThoseOfTheUnionOfSectors) {
  Random random({.seed = 11});
  std::vector<double> drawn;
  const auto draw = [&](std::size_t, std::size_t) { return drawn.emplace_back(-std::log(random.uniform())); };
  const RcsStatistics statistics = rcs_statistics(sweep_with(azimuths_from(0, 359, 1), {0, 2, 4}, 2, draw), 45);
  for (const std::size_t element : {0u, 3u}) {
    const AreaStatistics all = row_of(statistics, element, {}, {}).area, direct = area_statistics(drawn);
    EXPECT_NEAR(all.median_m2, direct.median_m2, kSumRounding);
    EXPECT_NEAR(all.p95_m2, direct.p95_m2, kSumRounding * 10);
    double sum = 0, largest = 0;
    std::size_t values = 0;
    for (std::size_t elevation = 0; elevation < 3; ++elevation) {
      for (std::size_t sector = 0; sector < 8; ++sector) {
        const AreaStatistics& part = row_of(statistics, element, elevation, sector).area;
        sum += part.mean_m2 * static_cast<double>(part.values);
        largest = std::max(largest, part.largest_m2);
        values += part.values;
      }
    }
    EXPECT_EQ(values, all.values);
    EXPECT_NEAR(sum / static_cast<double>(values), all.mean_m2, kSumRounding);
    EXPECT_EQ(largest, all.largest_m2);
    EXPECT_NEAR(all.mean_m2, direct.mean_m2, kSumRounding);
  }
  EXPECT_NEAR(row_of(statistics, 1, {}, {}).area.mean_m2, row_of(statistics, 0, {}, {}).area.mean_m2 / 4, kSumRounding);
}

// A sphere of radius a has pi a^2 from everywhere. Its mesh of 5,120 facets differs by the contour terms of its curved
// facets (0.9 % of the field, sim/scattering/solver/README.md), physical optics by 1 / 2ka.
TEST(SectorStatistics, OfASphereAreThoseOfOneValue) {
  constexpr double kRadius = 1, kFrequency = 8.64e9, kContourTerms = 0.009;
  RcsRequest request;
  request.mesh = std::make_shared<TriangleMesh>(make_sphere(kRadius, 4));
  request.target = "sphere";
  request.frequency_hz = {kFrequency};
  request.azimuth_deg = azimuths_from(0, 330, 30);
  request.edges = false;
  const RcsTarget target = prepare_rcs_target(request);
  const RcsStatistics statistics = rcs_statistics(compute_rcs(request, target, 1).sweep, 90);
  const double optics = kSpeedOfLight / (4 * kPi * kFrequency * kRadius), area = kPi * kRadius * kRadius,
               tolerance = 2 * (kContourTerms + optics) * area;
  for (const std::size_t element : {0u, 3u}) {
    for (const Choice sector : {Choice(), Choice(0), Choice(1), Choice(2), Choice(3)}) {
      const AreaStatistics& of = row_of(statistics, element, {}, sector).area;
      for (const double value : {of.p5_m2, of.p25_m2, of.median_m2, of.p75_m2, of.p95_m2, of.mean_m2, of.largest_m2})
        EXPECT_NEAR(value, area, tolerance);
    }
  }
  EXPECT_TRUE(std::ranges::all_of(statistics.rows, [](const SectorStatistics& row) { return !row.part; }));
}

// Parts are stored in single precision: each element within 2^-24 of its real and imaginary part. The sums have the
// points of one view, at most some 10^5, in another order: 10^5 times 2^-53 of the largest part.
void expect_the_whole_is_the_sum(const RcsSweep& sweep, std::size_t least_parts) {
  ASSERT_EQ(sweep.parts.size(), sweep.views());
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    EXPECT_GE(sweep.parts[view].size(), least_parts);
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      for (std::size_t element = 0; element < 4; ++element) {
        Complex sum = 0;
        double size = 0;
        for (const auto& [part, matrices] : sweep.parts[view]) {
          ASSERT_EQ(matrices.size(), sweep.frequency_hz.size());
          sum += Complex(matrices[q][element]);
          size += std::abs(Complex(matrices[q][element]));
        }
        const double single_precision = size * std::pow(2, -24), order = 1e5 * std::pow(2, -53) * size;
        EXPECT_LE(std::abs(sum - sweep.models.back().matrices[view][q][element]), single_precision + order)
            << view << ' ' << q << ' ' << element;
      }
    }
  }
}

RcsRequest part_request(const char* mesh, double frequency_hz, std::vector<double> azimuth_deg) {
  RcsRequest request;
  request.target = std::filesystem::path(SEAGLINT_SOURCE_DIR) / mesh;
  request.frequency_hz = {frequency_hz};
  request.azimuth_deg = std::move(azimuth_deg);
  request.elevation_deg = {2};
  request.by_part = true;
  return request;
}

constexpr const char* kShip = "assets/combatant_144m.glb";

TEST(PartSums, AreTheWholeWhichTheyDoNotChange) {
  RcsRequest request = part_request(kShip, 9.2e9, {20, 90});
  request.frequency_hz = {9.2e9, 9.3e9, 9.4e9, 9.5e9, 9.6e9, 9.7e9};  // more than the nodes of a band
  const RcsTarget target = prepare_rcs_target(request);
  const RcsSweep sweep = compute_rcs(request, target, 2).sweep;
  expect_the_whole_is_the_sum(sweep, 20);
  request.by_part = false;
  const RcsSweep whole = compute_rcs(request, target, 1).sweep;
  EXPECT_EQ(whole.models.back().matrices, sweep.models.back().matrices);
  EXPECT_TRUE(whole.parts.empty());
}

TEST(PartSums, AreTheWholeOverTheSeaOfRaysAndOfTwoAntennas) {
  const RcsRequest request = part_request(kShip, 9.4e9, {50});
  RcsRequest sea = request, rays = request, bistatic = request;
  sea.sea.reflection = true;
  rays.method = SolverMethod::kRays;
  rays.ray_spacing_m = 0.1;
  bistatic.transmitter = FixedTransmitter{20, 2};
  for (const RcsRequest& of : {sea, rays, bistatic})
    expect_the_whole_is_the_sum(compute_rcs(of, prepare_rcs_target(of), 2).sweep, 20);
}

TEST(PartSums, AreTheWholeWithACavity) {
  RcsRequest request = part_request("tests/reference/rcs/austin/duct_box.glb", 3e9, {180, 210});
  request.cavities.parts = {"duct"};
  request.max_bounces = 4;
  const RcsTarget target = prepare_rcs_target(request);
  const RcsSweep sweep = compute_rcs(request, target, 1).sweep;
  expect_the_whole_is_the_sum(sweep, 2);
  const auto duct = static_cast<std::uint16_t>(target.cavities.front().part);
  EXPECT_GT(std::abs(sweep.parts[0].at(duct)[0][0]), 1e-3);
}

// Two plates side by side, which do not illuminate each other: each part has the echo of its plate alone. The look
// direction is perturbed by 1e-6 rad about the centre of the mesh where faces are seen at their limit (Aspect), which
// turns the phase of a plate at most 2.25 m away; parts are stored in single precision.
TEST(PartSums, OfPartsThatDoNotSeeEachOtherAreThoseOfEachAlone) {
  const auto plate_at = [](double y, double size) {
    TriangleMesh plate = transformed(make_plate(size, size), Mat3::Identity(), {0, y, 0});
    plate.part_names = {y < 0 ? "starboard" : "port"};
    return plate;
  };
  const TriangleMesh starboard = plate_at(-2, 0.5), port = plate_at(2, 0.3);
  TriangleMesh both = starboard;
  both.append(port);
  RcsRequest request;
  request.target = "plates";
  request.frequency_hz = {10e9};
  request.azimuth_deg = {0, 3, 17};
  request.by_part = true;
  const auto sweep_of_mesh = [&](const TriangleMesh& mesh) {
    request.mesh = std::make_shared<TriangleMesh>(mesh);
    return compute_rcs(request, prepare_rcs_target(request), 1).sweep;
  };
  const RcsSweep whole = sweep_of_mesh(both);
  const double perturbation = 2 * (2 * kPi * 10e9 / kSpeedOfLight) * 2.25 * 1e-6,
               tolerance = perturbation + std::pow(2, -24);
  for (std::uint16_t part = 0; part < 2; ++part) {
    const RcsSweep alone = sweep_of_mesh(part == 0 ? starboard : port);
    for (std::size_t view = 0; view < 3; ++view) {
      for (const std::size_t element : kCoPolar) {
        const Complex expected = alone.models.back().matrices[view][0][element];
        EXPECT_LE(std::abs(Complex(whole.parts[view].at(part)[0][element]) - expected), tolerance * std::abs(expected))
            << part << ' ' << view << ' ' << element;
      }
    }
  }
}

TEST(StatisticsCsv, HasARowForEveryPartElementElevationAndSector) {
  RcsSweep sweep = sweep_with({0, 90}, {2}, 1, [](std::size_t view, std::size_t) { return view == 0 ? 10.0 : 1000.0; });
  sweep.parts.resize(2);
  sweep.parts[0][1] = {{1.0F, 0, 0, 0}};  // 4 pi m^2 in hh of the first view, nothing in the second
  const RcsStatistics statistics = rcs_statistics(sweep, 90);
  const std::vector<std::string> parts{"hull", "mast, main"};
  const std::string csv = statistics_csv(statistics, "# head\n", parts);
  EXPECT_THAT(csv, testing::StartsWith("# head\n# statistics of cross-sections in m^2"));
  EXPECT_HAS(csv,
             "\npart,polarisation,elevation_deg,sector_centre_deg,views,values,p5_dbsm,p25_dbsm,median_dbsm,"
             "p75_dbsm,p95_dbsm,mean_dbsm,largest_dbsm\n");
  EXPECT_HAS(csv, "\nwhole,hh,2,0,1,1,10.0000,10.0000,10.0000,10.0000,10.0000,10.0000,10.0000\n");
  EXPECT_HAS(csv, "\nwhole,vv,2,90,1,1,30.0000,30.0000,30.0000,30.0000,30.0000,30.0000,30.0000\n");
  // 10 and 1000 m^2: median and mean 505, percentile p 10 + 990 p m^2.
  EXPECT_HAS(csv, "\nwhole,vv,all,all,2,2,17.7452,24.1078,27.0329,28.7651,29.7795,27.0329,30.0000\n");
  EXPECT_HAS(csv, "\n\"mast, main\",hh,2,0,1,1,10.9921,");
  EXPECT_HAS(csv, "\n\"mast, main\",hh,2,90,1,1,-300.0000,");
  EXPECT_EQ(csv.find("\nhull,"), std::string::npos);
  const std::string text = statistics_table(statistics, parts);
  EXPECT_HAS(text, "dBsm over views and frequencies, elevation 2 deg, 9 GHz\n");
  EXPECT_HAS(text, "hh       -45 to 45       1    10.0");
  EXPECT_HAS(text, "vv             all       2    17.7    24.1    27.0    28.8    29.8    27.0    30.0\n");
  EXPECT_HAS(text, "mast, main");
}

// A plate of 0.6 m by 0.8 m lies flat: 1 m from corner to corner; lambda = 0.03 m, lambda / 2D = 0.859 deg.
class FlatPlate : public testing::Test {
 protected:
  FlatPlate() {
    mesh_.vertices = {{0, 0, 0}, {0.6, 0, 0}, {0.6, 0.8, 0}, {0, 0.8, 0}};
    mesh_.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
    request_.frequency_hz = {kSpeedOfLight / 0.03};
  }

  // Warning and text about azimuths of a full turn.
  std::pair<std::string, std::string> sampling(double step_deg) {
    request_.azimuth_deg = azimuths_from(0, 360 - step_deg / 2, step_deg);
    const RcsStatistics statistics =
        rcs_statistics(sweep_with(request_.azimuth_deg, {0}, 1, [](std::size_t, std::size_t) { return 1.0; }));
    const AzimuthSampling of = azimuth_sampling(request_, mesh_);
    return {sampling_warning(statistics, of).value_or(""), sampling_text(statistics, of)};
  }

  TriangleMesh mesh_;
  RcsRequest request_;
};

TEST_F(FlatPlate, HasAWarningWhereTheStepIsWiderThanItsLobes) {
  request_.azimuth_deg = azimuths_from(0, 19, 1);
  const std::optional<std::string> warning = lobe_warning(request_, mesh_);
  ASSERT_TRUE(warning);
  EXPECT_HAS(*warning, "1 deg apart, the narrowest lobes of a target of 1 m at 9.993 GHz 0.86 deg wide");
  EXPECT_HAS(*warning, "steps of 0.43 deg");
  for (double& azimuth : request_.azimuth_deg) azimuth *= 0.85;
  EXPECT_FALSE(lobe_warning(request_, mesh_));
}

// Coarse steps are random samples; only few of them are too few.
TEST_F(FlatPlate, HasIndependentSamplesAtStepsOfALobeAndMore) {
  EXPECT_EQ(sampling(1).first, "");
  EXPECT_HAS(sampling(1).second,
             "azimuth step 1 deg, lobes 0.86 deg (lambda / 2D, D = 1 m): every view is an "
             "independent sample");
  EXPECT_EQ(sampling(5).first, "");  // six views of a sector, but less than ten lobes apart
  EXPECT_HAS(sampling(10).first,
             "3 views of an elevation in a sector of 30 deg: statistics of few samples; the "
             "azimuths are 10 deg apart, lobes 0.86 deg wide (lambda / 2D); steps of 1 deg have 30");
  EXPECT_HAS(sampling(0.1).second, "about 35 independent samples in a sector of 30 deg");  // 30 / 0.859
  request_.transmitter = FixedTransmitter{};
  EXPECT_HAS(sampling(10).second, "lobes 1.7 deg (lambda / D, D = 1 m)");
  EXPECT_EQ(sampling(10).first, "");
}

}  // namespace
}  // namespace seaglint
