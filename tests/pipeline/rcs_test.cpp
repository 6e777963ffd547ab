// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/pipeline/rcs_command.h"
#include "tests/refusal.h"

namespace seaglint {
namespace {

using RcsTarget = RcsCommand;
using testing::HasSubstr;
using testing::Not;

// `seaglint rcs`: its table, and a plate against the closed form.

TEST_F(RcsCommand, WritesTheHeaderAndFrequencySlowestThenElevationThenAzimuth) {
  completed(rcs({"--frequency-ghz", "9:10:0.5", "--azimuth-deg", "-1:1:1", "--elevation-deg", "0:2:2"}));
  const CsvTable read = read_table(table());
  EXPECT_EQ(read.header,
            "frequency_hz,azimuth_deg,elevation_deg,hh_re,hh_im,hv_re,hv_im,vh_re,vh_im,vv_re,vv_im,hh_dbsm,vv_dbsm");
  ASSERT_EQ(read.rows.size(), 3u * 2u * 3u);
  std::size_t row = 0;
  for (const double frequency_hz : {9e9, 9.5e9, 10e9}) {
    for (const double elevation_deg : {0.0, 2.0}) {
      for (const double azimuth_deg : {-1.0, 0.0, 1.0}) {
        const std::vector<double>& cells = read.rows[row++];
        ASSERT_EQ(cells.size(), 13u);
        EXPECT_EQ(cells[0], frequency_hz);
        EXPECT_EQ(cells[1], azimuth_deg);
        EXPECT_EQ(cells[2], elevation_deg);
      }
    }
  }
}

TEST_F(RcsCommand, DecibelsAreThoseOfTheAmplitudes) {
  completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0:3:0.5"}));
  for (const auto& cells : read_table(table()).rows) {
    // Four digits are printed after the point.
    EXPECT_NEAR(cells[11], 10 * std::log10(4 * kPi * std::norm(std::complex(cells[3], cells[4]))), 1e-4);
    EXPECT_NEAR(cells[12], 10 * std::log10(4 * kPi * std::norm(std::complex(cells[9], cells[10]))), 1e-4);
  }
}

// The same plate drawn in millimetres, ahead along -y and up along +x, half a metre from its place: as `rcs` places it
// and as `mesh convert` writes it.
TEST_F(RcsCommand, APlateOfAnotherUnitOrientationAndOriginHasTheSameMatrices) {
  const std::string drawn = folder_.path() / "drawn.obj", converted = folder_.path() / "converted.obj";
  TriangleMesh mesh = read_mesh(plate());
  for (Vec3& p : mesh.vertices) {
    const Vec3 q = 1e3 * (p - Vec3(0, 0.5, -0.25));
    p = Vec3(q.z(), -q.x(), -q.y());
  }
  write_mesh(drawn, mesh);
  const std::vector<std::string> placement{"--unit", "mm", "--forward",  "-y",
                                           "--up",   "+x", "--offset-m", "0,0.5,-0.25"};
  const auto solved = [&](const std::string& target, const Words& more) {
    completed({"rcs", "--target", target, "--frequency-ghz", "9:10:0.5", "--azimuth-deg", "-20:20:5", "--elevation-deg",
               "5", "-o", table()},
              more);
    return read_table(table()).rows;
  };
  const auto expected = solved(plate(), {}), turned = solved(drawn, placement);
  EXPECT_HAS(read_file(table()), "drawn.obj unit mm forward -y up +x offset_m 0,0.5,-0.25: ");
  std::vector<std::string> convert{"mesh", "convert", drawn, "-o", converted};
  convert.insert(convert.end(), placement.begin(), placement.end());
  EXPECT_HAS(completed(convert).out, "size       ");
  for (const auto& rows : {turned, solved(converted, {})}) {
    ASSERT_EQ(rows.size(), expected.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t i = 3; i < 11; ++i)
        EXPECT_NEAR(rows[row][i], expected[row][i], 2e-7 * 4) << row;  // digits of 0.5 m in float32 times 2 k
  }
}

TEST_F(RcsCommand, RefusesAxesThatAreNoFrame) {
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--forward", "+z", "--up", "-z"}),
                 "forward +z and up -z: must be perpendicular to each other");
  EXPECT_EQ(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--forward", "x"}).code, 2);
  for (const std::string offset : {"1,2", "1,2,nan", "1,2,3,4", "a,b,c"}) {
    expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--offset-m", offset}),
                   "--offset-m: value " + offset + ": must be three numbers X,Y,Z");
  }
  EXPECT_EQ(run_program({"mesh", "convert", plate(), "-o", plate()}).code, 2);
}

TEST_F(RcsCommand, WritesTheSameBytesForOneAndTwoThreads) {
  std::string first;
  for (const char* threads : {"1", "2"}) {
    completed(rcs({"--frequency-ghz", "9:10:0.1", "--azimuth-deg", "-30:30:5", "--threads", threads}));
    const std::string bytes = read_file(table());
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first);
  }
}

TEST_F(RcsCommand, EqualsItsOwnTableAndDrawsIt) {
  const std::vector<std::string> sweep{"--frequency-ghz", "10", "--azimuth-deg", "-30:30:1"};
  completed(rcs(sweep));
  const std::string reference = folder_.path() / "reference.csv";
  std::filesystem::copy_file(table(), reference);
  const ProgramResult result =
      completed(rcs(with(sweep, {"--reference", reference, "--reference-polarisation", "vv", "--floor-db", "40"})));
  EXPECT_HAS(result.out, "both clipped at 40 dB");
  // 61 directions, no difference, full correlation without a phase rotation.
  EXPECT_THAT(
      result.out,
      testing::ContainsRegex(
          "reference.csv +vv +10 +po\\+diffraction +61 +0.000 +-?0.000 +-?0.000 +-?0.000 .* 1.0000 at -?0.0 deg"));
  const std::string figure = folder_.path() / "rcs.png";
  EXPECT_HAS(result.out, "Figure: " + figure);
  EXPECT_TRUE(std::filesystem::exists(figure));
}

// Images in the style of paper, with what they are of in the small print; nothing is solved where they are refused.
TEST_F(RcsCommand, DrawsATurntableImageProfilesAndAPolarDiagram) {
  const std::string image = folder_.path() / "image.svg", profiles = folder_.path() / "profiles.svg",
                    polar = folder_.path() / "polar.svg";
  const ProgramResult result =
      completed(rcs({"--frequency-ghz", "9:11:0.1", "--azimuth-deg", "-20:20:1", "--isar", image, "--profiles",
                     profiles, "--polarisation", "hh", "--style", "paper", "--polar", "--figure", polar}));
  EXPECT_HAS(result.out, "Turntable image: " + image);
  EXPECT_HAS(result.out, "Range profiles: " + profiles);
  EXPECT_HAS(read_file(image), "cross range (m)");
  EXPECT_HAS(read_file(image), "plate.glb, hh");
  EXPECT_HAS(read_file(image), "9 to 11 GHz in steps of 100 MHz");
  EXPECT_HAS(read_file(profiles), "azimuth (deg)");
  EXPECT_HAS(read_file(polar), "0 bow");
  std::filesystem::remove(table());
  const auto refused = [&](Words arguments, const std::string& message) {
    expect_refused(rcs(with({"--isar", image}, arguments)), message);
    EXPECT_FALSE(std::filesystem::exists(table()));
  };
  refused({"--frequency-ghz", "10", "--azimuth-deg", "0:10:1"}, "--frequency-ghz: 1 value: --isar needs at least 8");
  refused({"--frequency-ghz", "9:11:0.1", "--azimuth-deg", "0:40:4"}, "--azimuth-deg: step 4: must be at most 1.");
  refused({"--frequency-ghz", "9:11:0.1", "--azimuth-deg", "0:10:1", "--transmit-azimuth-deg", "5"},
          "--isar does not support --transmit-azimuth-deg");
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0:3:1", "--polar"}),
                 "--azimuth-deg: 4 values: --polar needs at least 8");
}

// Rows 4 deg apart, each the mean of eight azimuths: that of the rows of a fine table half a degree apart.
TEST_F(RcsCommand, AveragesTheCrossSectionOverEveryStep) {
  completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "-9.75:9.75:0.5"}));
  const auto fine = read_table(table()).rows;
  ASSERT_EQ(fine.size(), 40u);
  completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "-8:8:4", "--average", "8"}));
  const CsvTable mean = read_table(table());
  EXPECT_EQ(mean.header, "frequency_hz,azimuth_deg,elevation_deg,hh_dbsm,hv_dbsm,vh_dbsm,vv_dbsm");
  ASSERT_EQ(mean.rows.size(), 5u);
  for (std::size_t row = 0; row < 5; ++row) {
    double area_m2 = 0;
    for (std::size_t i = 0; i < 8; ++i) area_m2 += std::pow(10, fine[8 * row + i][12] / 10) / 8;
    EXPECT_NEAR(mean.rows[row][6], 10 * std::log10(area_m2), 2e-4);  // four digits are printed
  }
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--average", "8"}), "--average 8: --azimuth-deg");
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "-8:8:4", "--average", "8", "--uncertainty"}),
                 "--average");
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "-8:8:1", "--polar", "--uncertainty"}), "--polar");
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "-8:8:1", "--polar", "--figure", "off"}), "--polar");
}

TEST_F(RcsCommand, WritesAndPrintsTheStatisticsOfItsSectors) {
  const std::string file = folder_.path() / "statistics.csv";
  const Words turn{"--frequency-ghz", "10", "--azimuth-deg", "-30:30:1", "--statistics", file};
  const ProgramResult result = completed(rcs(with(turn, {"--sector-deg", "20"})));
  EXPECT_HAS(result.out, "dBsm over views and frequencies, elevation 0 deg, 10 GHz\n");
  EXPECT_HAS(result.out, "azimuth step 1 deg, lobes 1.7 deg (lambda / 2D, D = 0.5 m): about 12 independent samples");
  EXPECT_HAS(result.out, "Statistics: " + file);
  double largest = -300;
  for (const auto& row : read_table(table()).rows) largest = std::max(largest, row[11]);
  const std::string text = read_file(file);
  EXPECT_HAS(text, "# seaglint");
  EXPECT_HAS(text, "\nwhole,hh,0,0,20,20,");
  EXPECT_HAS(text, "\nwhole,vv,all,340,20,20,");
  const std::string all = text.substr(text.find("\nwhole,hh,all,all,61,61,") + 1);
  EXPECT_HAS(all.substr(0, all.find('\n')), fmt::format(",{:.4f}", largest));
  expect_refused(rcs(with(turn, {"--sector-deg", "50"})), "--sector-deg: value 50: must divide 360");
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--statistics", table()}), "written twice");
  EXPECT_EQ(rcs(with(turn, {"--average", "4"})).code, 2);
  EXPECT_EQ(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--sector-deg", "20"}).code, 2);
}

// The lower third of a plate from z = -0.15 to 0.15 m is under water.
TEST_F(RcsCommand, CutsAtTheWaterlineAsMeshConvertDoes) {
  const Words sweep{"--frequency-ghz", "10", "--azimuth-deg", "0:20:5"};
  const std::string cut = folder_.path() / "cut.glb";
  EXPECT_HAS(completed(rcs(with(sweep, {"--waterline-m", "-0.05"}))).err, "0.1 m below the water, is cut off");
  EXPECT_HAS(read_file(table()), "plate.glb unit m waterline_m -0.05: ");
  const auto rows = read_table(table()).rows;
  const ProgramResult converted = completed({"mesh", "convert", plate(), "--waterline-m", "-0.05", "-o", cut});
  EXPECT_HAS(converted.out, "cut        0.05 m^2 of its surface, down to 0.1 m below the water");
  completed(with({"rcs", "--target", cut, "-o", table()}, sweep));
  const auto expected = read_table(table()).rows;
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t i = 3; i < 11; ++i)
      EXPECT_NEAR(rows[row][i], expected[row][i], 2e-7 * 4) << row;  // digits of 0.5 m in float32 times 2 k
  for (const Words& command :
       {with({"rcs", "--target", plate(), "-o", table()}, sweep), Words{"mesh", "convert", plate(), "-o", cut}})
    expect_refused(run_program(with(command, {"--waterline-m", "0.2"})),
                   "--waterline-m: value 0.2: must be less than 0.15, else the whole target is under water");
}

// The curves of the comparison's figure are the levels of the table, and their differences from the reference.
TEST_F(RcsCommand, CurvesAreThoseOfTheTable) {
  const std::string curves = folder_.path() / "curves.json";
  completed(rcs({"--frequency-ghz", "10.24", "--azimuth-deg", "0:2:0.5", "--reference",
                 "tests/reference/rcs/austin/ref_rcs.II.B.sx1.f11.V.txt", "--curves", curves}));
  const auto json = nlohmann::json::parse(read_file(curves));
  ASSERT_EQ(json.at("panels").size(), 2u);  // levels, differences
  const CsvTable read = read_table(table());
  const auto& levels = json.at("panels")[0].at("series");
  const auto ours = std::ranges::find_if(levels, [](const auto& s) { return s.at("name") == "po+diffraction"; });
  ASSERT_NE(ours, levels.end());
  ASSERT_EQ(ours->at("y").size(), read.rows.size());
  for (std::size_t i = 0; i < read.rows.size(); ++i) {
    EXPECT_DOUBLE_EQ(ours->at("x")[i].template get<double>(), read.rows[i][1]);
    EXPECT_NEAR(ours->at("y")[i].template get<double>(), read.rows[i][12], 1e-3);  // six digits of 10 dBsm
  }
}

// Plate of problem set IIB: near its normal the echo is that of physical optics. The residual is the edges'
// diffraction, 1/(k L) = 2 % of the peak at 0.15 m and 10.24 GHz or 0.2 dB, and the difference between the measured and
// the computed reference there (0.4 dB).
TEST_F(RcsCommand, MatchesTheMeasuredPlateNearItsNormal) {
  completed({"mesh", "make", "plate", "--length-m", "0.2667", "--width-m", "0.1524", "-o", plate()});
  const std::string folder = "tests/reference/rcs/austin/";
  const ProgramResult result =
      completed(rcs({"--frequency-ghz", "10.24", "--azimuth-deg", "0:2:0.5", "--reference",
                     folder + "meas.m1_rcs.II.B.sx1.f11.H.txt", "--reference", folder + "ref_rcs.II.B.sx1.f11.V.txt"}));
  std::istringstream lines(result.out);
  int found = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string name, element, frequency, model;
    double points = 0, mean = 0;
    cells >> name >> element >> frequency >> model >> points >> mean;
    if (model != "po") continue;
    ++found;
    EXPECT_EQ(points, 5);
    EXPECT_LT(mean, 0.6) << name;
  }
  EXPECT_EQ(found, 2);
}

TEST_F(RcsCommand, RefusesAReferenceThatDoesNotFitBeforeAnyWork) {
  const auto refused = [&](Words more, const std::string& message) {
    expect_refused(rcs(with({"--frequency-ghz", "10", "--azimuth-deg", "0:2:0.5", "--reference",
                             "tests/reference/rcs/austin/ref_rcs.II.B.sx1.f11.H.txt"},
                            more)),
                   message);
    EXPECT_FALSE(std::filesystem::exists(table()));
  };
  refused({}, "no direction in common with the sweep; the file has 10.24 GHz");
  refused({"--reference-polarisation", "hv2"}, "--reference-polarisation hv2: must be");
  refused({"--reference-phi", "-1"}, "--reference-phi -1: must be 2 numbers");
  refused({"--reference-phi", "0,5"}, "must not be 0");
  refused({"--reference-phi", "1,0", "--reference-phi", "1,0"}, "is given 2 times for 1 references");
  refused({"--reference", "missing.H.txt"}, "missing.H.txt");
  refused({"--floor-db", "0"}, "--floor-db");
}

TEST_F(RcsCommand, ExportsSelectedCentresAndHotSpotsOfOneAspect) {
  const std::string centres = folder_.path() / "centres.csv", spots = folder_.path() / "spots.glb";
  const auto reflector = [&](Words more) {
    return run_program({"rcs", "--target", "assets/icosahedral_reflector.glb", "-o", table(), "--frequency-ghz", "16",
                        "--azimuth-deg", "0"},
                       more);
  };
  completed(reflector(
      {"--export-scattering-centres", centres, "--export-hot-spots", spots, "--export-dynamic-range-db", "40"}));
  std::istringstream lines(read_file(centres));
  std::string line;
  while (std::getline(lines, line) && line.starts_with("#")) continue;
  EXPECT_EQ(line, "x_m,y_m,z_m,psi_m,hh_re,hh_im,hv_re,hv_im,vh_re,vh_im,vv_re,vv_im,max_dbsm,part,bounces,mechanism");
  // Face-on, the cell that faces the radar is the strongest: its three-bounce echo is centred at the apex.
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_THAT(line, testing::EndsWith("cell_01,3,po"));
  // The picture has the mesh's facets and materials named by level.
  const TriangleMesh coloured = read_mesh(spots);
  EXPECT_EQ(coloured.triangles.size(), 60u);
  EXPECT_HAS(coloured.materials.front().name, "dBsm");

  const auto vv = [&] {
    const auto cells = read_table(table()).rows.at(0);
    return std::complex<double>(cells[9], cells[10]);
  };
  const std::complex<double> all = vv();
  completed(reflector({"--only", "part=cell_01", "--only", "bounces=3"}));
  const std::complex<double> one = vv();
  completed(reflector({"--without", "part=cell_01"}));
  const std::complex<double> rest = vv();
  completed(reflector({"--only", "part=cell_01", "--without", "bounces=3"}));
  EXPECT_LT(std::abs(one + rest + vv() - all), 1e-7 * std::abs(all)) << "nine printed digits";
  completed(reflector({"--only", "mechanism=edge"}));
  const std::complex<double> edges = vv();
  EXPECT_GT(std::abs(edges), 1e-4 * std::abs(all));
  completed(reflector({"--without", "mechanism=edge"}));
  EXPECT_LT(std::abs(edges + vv() - all), 1e-7 * std::abs(all)) << "nine printed digits";
  std::complex<double> sum = 0;
  for (const char* mechanism : {"single", "multiple", "reflected_edge", "shadow_boundary", "penumbra", "concave"}) {
    completed(reflector({"--only", std::string("mechanism=") + mechanism}));
    sum += vv();
  }
  EXPECT_LT(std::abs(sum - edges), 1e-6 * std::abs(edges)) << "nine printed digits";

  const auto refused = [&](Words more, const std::string& message) {
    expect_refused(reflector(std::move(more)), message);
  };
  refused({"--only", "part=cell_1"}, "did you mean 'cell_01'?");
  refused({"--only", "bounces=0"}, "bounces must be 1, 2, ... 200");
  refused({"--without", "mechanism=magic"}, "must be edge or one of po, single, multiple");
  refused({"--only", "colour=red"}, "must be part=NAME");
  refused({"--only", "bounces=41"}, "--only bounces=41 requires --max-bounces 41 or more; 40 are traced");
  refused({"--only", "mechanism=edge", "--edges", "off"}, "--only mechanism=edge requires --edges on");
  refused({"--only", "mechanism=po", "--without", "mechanism=po"},
          "--only mechanism=po and --without mechanism=po leave nothing of it");
  refused({"--centre-cell-m", "0.2"}, "--centre-cell-m requires --export-scattering-centres (see seaglint rcs --help)");
  refused({"--centre-cell-m", "0.2", "--export-hot-spots", spots},
          "--centre-cell-m requires --export-scattering-centres");
  refused({"--export-dynamic-range-db", "40"},
          "--export-dynamic-range-db requires --export-scattering-centres or --export-hot-spots");
  refused({"--export-scattering-centres", centres, "--elevation-deg", "0:1:1"},
          "one frequency, azimuth and elevation; there are 2 rows");
  refused({"--export-hot-spots", folder_.path() / "spots.stl"},
          "spots.stl: hot spots need the ending .html (page), .png, .svg or .pdf (picture), .glb or .gltf (mesh)");
  refused({"--export-hot-spots", folder_.path() / "rcs.csv"}, "would be written twice");
}

// The scattering centres of a page are those of the table; the picture may have the name of the table.
TEST_F(RcsCommand, ShowsHotSpotsAsAPageAndAsAPicture) {
  const std::string centres = folder_.path() / "centres.csv", page = folder_.path() / "spots.html",
                    picture = folder_.path() / "rcs.png";
  const auto reflector = [&](Words more) {
    return completed({"rcs", "--target", "assets/icosahedral_reflector.glb", "-o", table(), "--frequency-ghz", "16",
                      "--azimuth-deg", "30", "--elevation-deg", "3", "--centre-cell-m", "0.05"},
                     more);
  };
  const ProgramResult result = reflector({"--export-scattering-centres", centres, "--export-hot-spots", page});
  EXPECT_HAS(result.out, "spots.html: page of the hot spots, the strongest cell_03, 3 bounces, ");
  const std::string html = read_file(page);
  EXPECT_LT(html.size(), 5'000'000u);
  EXPECT_HAS(html, "<h1>icosahedral_reflector.glb: hot spots</h1>");
  EXPECT_HAS(html, "16 GHz, azimuth 30 deg, elevation 3 deg. The whole echo: hh ");
  EXPECT_HAS(html, "cells of 0.05 m");
  const std::string before = "<div id=\"hot-spots\"><script type=\"application/json\">";
  const std::size_t from = html.find(before) + before.size();
  const auto json = nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
  const auto& target = json.at("targets").at(0);
  const auto& view = target.at("views").at(0);
  EXPECT_EQ(view.at("azimuth_deg"), 30);
  std::istringstream lines(read_file(centres));
  std::string line;
  while (std::getline(lines, line) && line.starts_with("#")) continue;
  const auto number = [](const nlohmann::json& value) { return value.get<double>(); };
  for (std::size_t i = 0; i < 5; ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 16u);
    const auto& centre = view.at("centres").at(i);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(number(centre[c]), std::stod(cells[c]), 6e-4);
    EXPECT_NEAR(number(centre[6]), std::stod(cells[12]), 0.051) << "dBsm, one digit";
    EXPECT_EQ(target.at("parts").at(centre[3].get<std::size_t>()), cells[13]);
    EXPECT_EQ(std::to_string(centre[4].get<int>()), cells[14]);
    // The same in the table of the page.
    EXPECT_HAS(html, fmt::format("<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.3f}</td>", i + 1, cells[13],
                                 "physical optics", cells[14], std::stod(cells[0])));
  }
  EXPECT_HAS(reflector({"--export-hot-spots", picture}).out, "rcs.png: picture of the hot spots");
  EXPECT_EQ(read_file(picture).substr(1, 3), "PNG");
}

TEST_F(RcsCommand, SweepsAReceiverAboutAFixedTransmitter) {
  completed({"mesh", "make", "plate", "--length-m", "0.3", "--width-m", "0.2", "-o", plate()});
  completed(
      rcs({"--frequency-ghz", "10", "--azimuth-deg", "-40:40:20", "--transmit-azimuth-deg", "20", "--edges", "off"}));
  const auto rows = read_table(table()).rows;
  ASSERT_EQ(rows.size(), 5u);
  // The whole plate is in phase in the specular direction: 4 pi (A cos(20 deg) / lambda)^2.
  const double area = 0.06 * std::cos(20 * kPi / 180), lambda = 0.0299792458;
  EXPECT_NEAR(rows[1].back(), 10 * std::log10(4 * kPi * area * area / (lambda * lambda)), 1e-3);
  for (const std::size_t other : {0u, 2u, 4u}) EXPECT_LT(rows[other].back(), rows[1].back() - 10);
  // The reciprocal path has the same echo.
  completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "20", "--transmit-azimuth-deg", "20", "--edges", "off"}));
  const double there = read_table(table()).rows.at(0).back();
  completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "20", "--edges", "off"}));
  EXPECT_NEAR(read_table(table()).rows.at(0).back(), there, 1e-3);
  // The table states the direction of its transmitter, and is not compared with tables of other transmitters.
  const std::string own = folder_.path() / "own.csv";
  const auto against = [&](Words more) {
    return run_program({"rcs", "--target", plate(), "-o", table(), "--frequency-ghz", "10", "--azimuth-deg",
                        "-40:40:20", "--reference", own, "--reference-polarisation", "vv"},
                       more);
  };
  std::filesystem::remove(table());
  completed({"rcs", "--target", plate(), "-o", own, "--frequency-ghz", "10", "--azimuth-deg", "-40:40:20",
             "--transmit-azimuth-deg", "20"});
  for (const auto& other : {Words{}, {"--transmit-azimuth-deg", "21"}}) {
    expect_refused(against(other), "own.csv: its transmitter is at azimuth 20 deg, elevation 0 deg, the sweep");
    EXPECT_FALSE(std::filesystem::exists(table()));
  }
  completed(against({"--transmit-azimuth-deg", "20"}));
  const auto warned = [&](const char* azimuth) {
    return rcs({"--frequency-ghz", "10", "--azimuth-deg", azimuth, "--transmit-azimuth-deg", "20"}).err;
  };
  EXPECT_THAT(warned("-90:130:20"), Not(HasSubstr("behind the target")));
  EXPECT_HAS(warned("-90:160:10"), "receivers up to 140 deg from the transmitter: behind the target");
}

TEST_F(RcsCommand, HasAWavefrontCurvatureAtShortRange) {
  completed({"mesh", "make", "plate", "--length-m", "2", "--width-m", "0.2", "-o", plate()});
  const auto level = [&](const std::string& range_m) {
    completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--edges", "off", "--wavefront-range-m", range_m}));
    return read_table(table()).rows.at(0).back();
  };
  // 2 L^2 / lambda = 267 m: far beyond it the echo does not change, at 30 m the phase of the ends differs by 14 rad.
  EXPECT_NEAR(level("100000"), level("0"), 0.01);
  EXPECT_LT(level("30"), level("0") - 6);
  expect_refused(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--wavefront-range-m", "0.5"}),
                 "wavefront range 0.5 m: must be at least ten times the target radius");
}

// A leaning strip has no rotational symmetry: at the zenith its matrix rotates with the azimuth as it does just below.
TEST_F(RcsCommand, KeepsItsBasisThroughTheZenith) {
  const Mat3 leaning = axis_rotation(0.15, Vec3::UnitX()) * axis_rotation(kPi / 2 - 0.02, Vec3::UnitY());
  write_mesh(plate(), transformed(make_plate(0.04, 0.3), leaning, Vec3::Zero()));
  for (const char* azimuth : {"0", "60", "-110"}) {
    completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", azimuth, "--elevation-deg", "89.999:90:0.001"}));
    const auto rows = read_table(table()).rows;
    ASSERT_EQ(rows.size(), 2u);
    // 1e-3 deg change the phase at the strip's ends by 2 k 0.15 m 1.7e-5 rad.
    const double tolerance = 1.1e-3 * std::hypot(rows[1][3], rows[1][4]);
    for (std::size_t column = 3; column <= 10; ++column)
      EXPECT_NEAR(rows[0][column], rows[1][column], tolerance) << azimuth << ' ' << column;
    EXPECT_GT(std::hypot(rows[1][9] - rows[1][3], rows[1][10] - rows[1][4]) + std::hypot(rows[1][5], rows[1][6]),
              10 * tolerance);
  }
}

TEST_F(RcsCommand, RefusesInvalidEdgesAndRanges) {
  const auto refused = [&](Words arguments, const std::string& message) {
    const ProgramResult result = rcs(std::move(arguments));
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("seaglint: "));
    EXPECT_HAS(result.err, message);
    EXPECT_FALSE(std::filesystem::exists(table()));
  };
  refused({"--frequency-ghz", "10", "--azimuth-deg", "0", "--edges", "perhaps"}, "--edges");
  refused({"--frequency-ghz", "0", "--azimuth-deg", "0"}, "--frequency-ghz: value 0: must be");
  refused({"--frequency-ghz", "nan", "--azimuth-deg", "0"}, "--frequency-ghz");
  refused({"--frequency-ghz", "10:9:1", "--azimuth-deg", "0"}, "--frequency-ghz");
  refused({"--frequency-ghz", "10", "--azimuth-deg", "0:360"}, "--azimuth-deg");
  refused({"--frequency-ghz", "10", "--azimuth-deg", "0", "--elevation-deg", "91"},
          "--elevation-deg: value 91: must be");
  refused({"--frequency-ghz", "10"}, "--azimuth-deg is required");
  refused({"--frequency-ghz", "10", "--azimuth-deg", "0", "--transmit-elevation-deg", "3"},
          "--transmit-elevation-deg requires --transmit-azimuth-deg");
  refused({"--frequency-ghz", "10", "--azimuth-deg", "0", "--elevation-deg", "2", "--transmit-azimuth-deg", "3",
           "--sea-reflection", "--origin-height-m", "5"},
          "are monostatic");
  refused({"--frequency-ghz", "10", "--azimuth-deg", "0", "--wavefront-range-m", "-1"}, "--wavefront-range-m");
}

// `seaglint rcs`: warnings about its target, the target's materials, and the sea below it.

// A reflector inside out with a mesh with a hole next to it: the first is repaired, the interior of the second is
// visible; both are reported in one line each.
TEST_F(RcsTarget, WarnsOfDefectsOfAMeshAndContinues) {
  TriangleMesh mesh = make_icosahedral_reflector();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  TriangleMesh holed = transformed(make_sphere(0.3, 2), Mat3::Identity(), Vec3(0, 3, 0));
  holed.triangles[0] = holed.triangles[1];
  mesh.append(holed);
  write_mesh(plate(), mesh);
  const ProgramResult result = completed(rcs({"--frequency-ghz", "0.1:10:9.9", "--azimuth-deg", "0"}));
  EXPECT_THAT(result.err,
              testing::StartsWith("seaglint: warning: 1 triangle repeats another: removed\n"
                                  "seaglint: warning: 1 closed surface is inside out (60 triangles): turned outwards\n"
                                  "seaglint: warning: 3 open edges; 1 of 2 surfaces are open"));
  EXPECT_HAS(result.err, "wavelengths at 0.1 GHz; physical optics needs 3 and more");
}

TEST_F(RcsTarget, RefusesMeshesWithoutAnythingThatScatters) {
  const std::string file = folder_.path() / "bad.obj";
  const auto refused = [&](const std::string& text, const std::string& message) {
    write_file(file, text);
    expect_refused({"rcs", "--target", file, "-o", table(), "--frequency-ghz", "10", "--azimuth-deg", "0"}, message);
    EXPECT_FALSE(std::filesystem::exists(table()));
  };
  refused("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no triangle has an area: nothing scatters");
  refused("v 0 0 0\nv 1 0 0\nv 0 nan 1\nf 1 2 3\n", "bad.obj");
  refused("v 0 0 0\nv 1 0 0\nv 0 1 1\n", "contains no triangles");
  refused("v 9000 0 0\nv 9000 1 0\nv 9000 0 1\nf 1 2 3\n", "from the origin");
}

TEST_F(RcsTarget, IncludesTheThicknessOfSheets) {
  completed({"mesh", "make", "plate", "--length-m", "0.3", "--width-m", "0.2", "-o", plate()});
  const auto level = [&](const char* thickness_mm, const char* edges, const char* warning) {
    EXPECT_HAS(completed(rcs({"--frequency-ghz", "10", "--azimuth-deg", "50", "--sheet-thickness-mm", thickness_mm,
                              "--edges", edges}))
                   .err,
               warning);
    return read_table(table()).rows.at(0).back();
  };
  const double thin = level("0", "on", ""), thick = level("1.6", "on", "");
  EXPECT_GT(std::abs(thick - thin), 0.3);
  EXPECT_HAS(read_file(table()), "sheet_thickness_mm 1.6");
  EXPECT_DOUBLE_EQ(level("1.6", "off", "sheet thickness of 1.6 mm has no effect: edges are off"),
                   level("0", "off", ""));
  level("4", "on", "sheets of 4 mm are 0.13 wavelengths thick at 10 GHz");
  EXPECT_EQ(rcs({"--frequency-ghz", "10", "--azimuth-deg", "50", "--sheet-thickness-mm", "-1"}).code, 2);
}

TEST_F(RcsTarget, ACoatedPlateDropsByItsMaterial) {
  // Aluminium's surface resistance is 1e-4 of free space's: no measurable loss. The coating's |Gamma| is that of its
  // quarter-wave layer, about -11 dB at 16 GHz.
  const std::string library = SEAGLINT_SOURCE_DIR "/assets/materials/";
  const auto square = [&](const std::string& material) {
    completed(rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--material", material}));
    return read_table(table()).rows.at(0).at(12);
  };
  const double metal = square("pec");
  EXPECT_NEAR(square(library + "aluminium.yaml"), metal, 0.01);
  EXPECT_NEAR(square(library + "ram_loaded_epoxy.yaml"), metal - 11.1, 0.5);
  EXPECT_NEAR(square("*=" + library + "ram_loaded_epoxy.yaml"), metal - 11.1, 0.5);
}

TEST_F(RcsTarget, RefusesUnknownMaterials) {
  const std::string library = SEAGLINT_SOURCE_DIR "/assets/materials/";
  const auto refused = [&](const std::string& ghz, const std::string& material) {
    const ProgramResult done = rcs({"--frequency-ghz", ghz, "--azimuth-deg", "0", "--material", material});
    EXPECT_EQ(done.code, 2);
    return done.err;
  };
  EXPECT_HAS(refused("16", "unobtainium"), "--material unobtainium: value 'unobtainium': no such material");
  EXPECT_HAS(refused("16", "mast=pec"), "part 'mast': the mesh has no such part");
  EXPECT_HAS(refused("41", library + "grp_sheet.yaml"), "its source covers 1 to 40 GHz");
}

TEST_F(RcsTarget, APlateOnAConductingSeaIsADihedral) {
  // kWidthM high, its centre half of that above the water: image theory gives 2 A cos(el) / lambda, plus or minus the
  // direct lobe of the doubled plate, which is a sine over k kWidthM sin(el) = 50 at 30 deg, for two paths.
  completed(rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "30", "--sea-reflection",
                 "--sea-surface", "conductor", "--origin-height-m", "0.15"}));
  const auto row = read_table(table()).rows.at(0);
  const double lambda = kSpeedOfLight / 16e9, dihedral = 2 * kLengthM * kWidthM * std::cos(radians(30)) / lambda;
  const double level = 10 * std::log10(4 * kPi * dihedral * dihedral);
  EXPECT_NEAR(row.at(11), level, 20 * std::log10(1 + 1.0 / 50));
  EXPECT_NEAR(row.at(12), level, 20 * std::log10(1 + 1.0 / 50));
}

// kWidthM high about its middle: a table of zeros would suggest that it does not scatter.
TEST_F(RcsTarget, RefusesASubmergedTarget) {
  const ProgramResult done = rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "30",
                                  "--sea-reflection", "--origin-height-m", "-5"});
  EXPECT_EQ(done.code, 2);
  EXPECT_HAS(done.err,
             "--origin-height-m: value -5: must be greater than -0.15, else the whole target is under water\n");
  completed(rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "30", "--sea-reflection",
                 "--origin-height-m", "-0.14"}));
}

TEST_F(RcsTarget, RefusesASeaReflectionWithoutAnImage) {
  expect_refused(rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--elevation-deg", "0", "--sea-reflection"}),
                 "--elevation-deg: value 0: must be greater than 0 with --sea-reflection");
  EXPECT_EQ(rcs({"--frequency-ghz", "16", "--azimuth-deg", "0", "--origin-height-m", "3"}).code, 2);
  EXPECT_HAS(rcs({"--frequency-ghz", "94", "--azimuth-deg", "0", "--elevation-deg", "2", "--sea-reflection"}).err,
             "--frequency-ghz: value 94: must be at most 90");
}

// `seaglint rcs --method` on a plate, whose physical optics has a closed form.

class RcsMethod : public RcsCommand {
 protected:
  ProgramResult at_normal_incidence(Words more) const {
    return rcs(with({"--frequency-ghz", "10", "--azimuth-deg", "0", "--edges", "off"}, more));
  }
  void expect_refusal(const Words& more, const std::string& message) const {
    const ProgramResult result = at_normal_incidence(more);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("seaglint: "));
    EXPECT_HAS(result.err, message);
    EXPECT_FALSE(std::filesystem::exists(table()));
  }
};

// Normal incidence on a plate of area A: 4 pi (A / lambda)^2.
TEST_F(RcsMethod, APlateHasItsClosedFormByEachOfThem) {
  const double expected = dbsm(kLengthM * kWidthM * 10e9 / kSpeedOfLight);
  for (const Words& method :
       {Words{}, {"--method", "beams"}, {"--method", "rays"}, {"--method", "rays", "--ray-spacing-m", "0.01"}}) {
    completed(at_normal_incidence(method));
    const CsvTable swept = read_table(table());
    ASSERT_EQ(swept.rows.size(), 1u);
    EXPECT_NEAR(swept.rows[0][12], expected, 1e-4);
  }
  EXPECT_HAS(read_file(table()), ", method rays, ray_spacing_m 0.01\n");
}

TEST_F(RcsMethod, HeadsTheScatteringCentresToo) {
  const std::string centres = folder_.path() / "centres.csv";
  completed(at_normal_incidence({"--export-scattering-centres", centres}));
  EXPECT_HAS(read_file(centres), ", edges off, contributions: all\n");
  completed(
      at_normal_incidence({"--export-scattering-centres", centres, "--method", "rays", "--ray-spacing-m", "0.01"}));
  EXPECT_HAS(read_file(centres), ", edges off, method rays, ray_spacing_m 0.01, contributions: all\n");
}

TEST_F(RcsMethod, OfAnotherNameIsRefusedWithThoseThatExist) {
  expect_refusal({"--method", "sbr"}, "--method: sbr not in {beams,rays}");
}

TEST_F(RcsMethod, OfBeamsHasNoDistanceBetweenRays) {
  const std::string message = "--ray-spacing-m: value 0.01: valid only with --method rays; beams have --min-patch-m";
  expect_refusal({"--ray-spacing-m", "0.01"}, message);
  expect_refusal({"--method", "beams", "--ray-spacing-m", "0.01"}, message);
  expect_refusal({"--method", "rays", "--ray-spacing-m", "-1"}, "--ray-spacing-m: value -1: must be within");
  expect_refused({"mesh", "sensitivity", "--target", plate(), "--frequency-ghz", "10", "--azimuth-deg", "0",
                  "--ray-spacing-m", "0.01"},
                 message);
}

// Cuts, numbers and positions of the triangles do not change the echo of a plate at normal incidence.
TEST_F(RcsMethod, OfRaysServesTheSensitivityToTheMesh) {
  const ProgramResult result =
      completed({"mesh", "sensitivity", "--target", plate(), "--frequency-ghz", "10", "--azimuth-deg", "0", "--edges",
                 "off", "--method", "rays", "--ray-spacing-m", "0.01"});
  EXPECT_HAS(result.out, "0.0000      0.0000      0.0000      0.0000      0.0000");
}

TEST_F(RcsMethod, OfRaysIsRefusedForACavity) {
  expect_refusal({"--method", "rays", "--cavity", "plate"},
                 "--cavity does not support --method rays: only beams end at the walls of cavities");
}

}  // namespace
}  // namespace seaglint
