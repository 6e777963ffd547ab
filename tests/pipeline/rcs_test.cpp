// SPDX-License-Identifier: BSD-3-Clause
// `seaglint rcs`: its table, and a plate against the closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/pipeline/rcs_command.h"

namespace seaglint {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(RcsCommand, WritesTheHeaderAndFrequencySlowestThenElevationThenAzimuth) {
  const ProgramResult result =
      rcs({"--frequency-ghz", "9:10:0.5", "--azimuth-deg", "-1:1:1", "--elevation-deg", "0:2:2"});
  ASSERT_EQ(result.code, 0) << result.err;
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
  ASSERT_EQ(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0:3:0.5"}).code, 0);
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
  const auto solved = [&](const std::string& target, const std::vector<std::string>& more) {
    std::vector<std::string> words{
        "rcs", "--target", target, "--frequency-ghz", "9:10:0.5", "--azimuth-deg", "-20:20:5", "--elevation-deg",
        "5",   "-o",       table()};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_program(words);
    EXPECT_EQ(result.code, 0) << result.err;
    return read_table(table()).rows;
  };
  const auto expected = solved(plate(), {}), turned = solved(drawn, placement);
  EXPECT_THAT(read_file(table()), HasSubstr("drawn.obj unit mm forward -y up +x offset_m 0,0.5,-0.25: "));
  std::vector<std::string> convert{"mesh", "convert", drawn, "-o", converted};
  convert.insert(convert.end(), placement.begin(), placement.end());
  const ProgramResult written = run_program(convert);
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_THAT(written.out, HasSubstr("size       "));
  for (const auto& rows : {turned, solved(converted, {})}) {
    ASSERT_EQ(rows.size(), expected.size());
    for (std::size_t row = 0; row < rows.size(); ++row) {
      for (std::size_t i = 3; i < 11; ++i)
        EXPECT_NEAR(rows[row][i], expected[row][i], 2e-7 * 4) << row;  // digits of 0.5 m in float32 times 2 k
    }
  }
}

TEST_F(RcsCommand, RefusesAxesThatAreNoFrame) {
  const ProgramResult parallel = rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--forward", "+z", "--up", "-z"});
  EXPECT_EQ(parallel.code, 2);
  EXPECT_THAT(parallel.err, HasSubstr("forward +z and up -z: must be perpendicular to each other"));
  EXPECT_EQ(rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--forward", "x"}).code, 2);
  for (const std::string offset : {"1,2", "1,2,nan", "1,2,3,4", "a,b,c"}) {
    const ProgramResult refused = rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--offset-m", offset});
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--offset-m: value " + offset + ": must be three numbers X,Y,Z"));
  }
  EXPECT_EQ(run_program({"mesh", "convert", plate(), "-o", plate()}).code, 2);
}

// Physical optics of a flat plate of area A at normal incidence: S = -j A / lambda in e^{+jwt}, so sigma = 4 pi A^2 /
// lambda^2.
TEST_F(RcsCommand, APlateAtNormalIncidenceHasItsClosedForm) {
  ASSERT_EQ(rcs({"--frequency-ghz", "8:16:4", "--azimuth-deg", "0", "--elevation-deg", "0"}).code, 0);
  const CsvTable read = read_table(table());
  ASSERT_EQ(read.rows.size(), 3u);
  for (const auto& cells : read.rows) {
    const double area = kLengthM * kWidthM, wavelength = kSpeedOfLight / cells[0];
    const double sigma_db = 10 * std::log10(4 * kPi * area * area / (wavelength * wavelength));
    EXPECT_NEAR(cells[11], sigma_db, 0.05) << cells[0];
    EXPECT_NEAR(cells[12], sigma_db, 0.05) << cells[0];
    EXPECT_NEAR(degrees(std::arg(std::complex(cells[3], cells[4]))), -90, 1) << cells[0];
    EXPECT_NEAR(degrees(std::arg(std::complex(cells[9], cells[10]))), -90, 1) << cells[0];
  }
}

TEST_F(RcsCommand, WritesTheSameBytesForOneAndTwoThreads) {
  std::string first;
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(rcs({"--frequency-ghz", "9:10:0.1", "--azimuth-deg", "-30:30:5", "--threads", threads}).code, 0);
    const std::string bytes = read_file(table());
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first);
  }
}

TEST_F(RcsCommand, EqualsItsOwnTableAndDrawsIt) {
  const std::vector<std::string> sweep{"--frequency-ghz", "10", "--azimuth-deg", "-30:30:1"};
  ASSERT_EQ(rcs(sweep).code, 0);
  const std::string reference = folder_.path() / "reference.csv";
  std::filesystem::copy_file(table(), reference);
  std::vector<std::string> words = sweep;
  words.insert(words.end(), {"--reference", reference, "--reference-polarisation", "vv", "--floor-db", "40"});
  const ProgramResult result = rcs(words);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("both clipped at 40 dB"));
  // 61 directions, no difference, full correlation without a phase rotation.
  EXPECT_THAT(
      result.out,
      testing::ContainsRegex(
          "reference.csv +vv +10 +po\\+diffraction +61 +0.000 +-?0.000 +-?0.000 +-?0.000 .* 1.0000 at -?0.0 deg"));
  const std::string figure = folder_.path() / "rcs.png";
  EXPECT_THAT(result.out, HasSubstr("Figure: " + figure));
  EXPECT_TRUE(std::filesystem::exists(figure));
}

// The curves of the comparison's figure are the levels of the table, and their differences from the reference.
TEST_F(RcsCommand, CurvesAreThoseOfTheTable) {
  const std::string curves = folder_.path() / "curves.json";
  const ProgramResult result = rcs({"--frequency-ghz", "10.24", "--azimuth-deg", "0:2:0.5", "--reference",
                                    "tests/reference/rcs/austin/ref_rcs.II.B.sx1.f11.V.txt", "--curves", curves});
  ASSERT_EQ(result.code, 0) << result.err;
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
  ASSERT_EQ(run_program({"mesh", "make", "plate", "--length-m", "0.2667", "--width-m", "0.1524", "-o", plate()}).code,
            0);
  const std::string folder = "tests/reference/rcs/austin/";
  const ProgramResult result =
      rcs({"--frequency-ghz", "10.24", "--azimuth-deg", "0:2:0.5", "--reference",
           folder + "meas.m1_rcs.II.B.sx1.f11.H.txt", "--reference", folder + "ref_rcs.II.B.sx1.f11.V.txt"});
  ASSERT_EQ(result.code, 0) << result.err;
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
  const auto refused = [&](std::vector<std::string> more, const std::string& message) {
    more.insert(more.begin(), {"--frequency-ghz", "10", "--azimuth-deg", "0:2:0.5", "--reference",
                               "tests/reference/rcs/austin/ref_rcs.II.B.sx1.f11.H.txt"});
    const ProgramResult result = rcs(more);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(message));
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
  const auto reflector = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"rcs", "--target", "assets/icosahedral_reflector.glb", "-o", table(), "--frequency-ghz",
                               "16", "--azimuth-deg", "0"});
    return run_program(more);
  };
  const ProgramResult result = reflector(
      {"--export-scattering-centres", centres, "--export-hot-spots", spots, "--export-dynamic-range-db", "40"});
  ASSERT_EQ(result.code, 0) << result.err;
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
  EXPECT_THAT(coloured.materials.front().name, HasSubstr("dBsm"));

  const auto vv = [&] {
    const auto cells = read_table(table()).rows.at(0);
    return std::complex<double>(cells[9], cells[10]);
  };
  const std::complex<double> all = vv();
  ASSERT_EQ(reflector({"--only", "part=cell_01", "--only", "bounces=3"}).code, 0);
  const std::complex<double> one = vv();
  ASSERT_EQ(reflector({"--without", "part=cell_01"}).code, 0);
  const std::complex<double> rest = vv();
  ASSERT_EQ(reflector({"--only", "part=cell_01", "--without", "bounces=3"}).code, 0);
  EXPECT_LT(std::abs(one + rest + vv() - all), 1e-7 * std::abs(all)) << "nine printed digits";
  ASSERT_EQ(reflector({"--only", "mechanism=edge"}).code, 0);
  const std::complex<double> edges = vv();
  EXPECT_GT(std::abs(edges), 1e-4 * std::abs(all));
  ASSERT_EQ(reflector({"--without", "mechanism=edge"}).code, 0);
  EXPECT_LT(std::abs(edges + vv() - all), 1e-7 * std::abs(all)) << "nine printed digits";
  std::complex<double> sum = 0;
  for (const char* mechanism : {"single", "multiple", "reflected_edge", "shadow_boundary", "penumbra", "concave"}) {
    ASSERT_EQ(reflector({"--only", std::string("mechanism=") + mechanism}).code, 0);
    sum += vv();
  }
  EXPECT_LT(std::abs(sum - edges), 1e-6 * std::abs(edges)) << "nine printed digits";

  const auto refused = [&](std::vector<std::string> more, const std::string& message) {
    const ProgramResult invalid = reflector(std::move(more));
    EXPECT_EQ(invalid.code, 2);
    EXPECT_THAT(invalid.err, HasSubstr(message));
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
  refused({"--export-hot-spots", folder_.path() / "spots.stl"}, "colours need the ending .glb or .gltf");
}

TEST_F(RcsCommand, SweepsAReceiverAboutAFixedTransmitter) {
  ASSERT_EQ(run_program({"mesh", "make", "plate", "--length-m", "0.3", "--width-m", "0.2", "-o", plate()}).code, 0);
  ASSERT_EQ(
      rcs({"--frequency-ghz", "10", "--azimuth-deg", "-40:40:20", "--transmit-azimuth-deg", "20", "--edges", "off"})
          .code,
      0);
  const auto rows = read_table(table()).rows;
  ASSERT_EQ(rows.size(), 5u);
  // The whole plate is in phase in the specular direction: 4 pi (A cos(20 deg) / lambda)^2.
  const double area = 0.06 * std::cos(20 * kPi / 180), lambda = 0.0299792458;
  EXPECT_NEAR(rows[1].back(), 10 * std::log10(4 * kPi * area * area / (lambda * lambda)), 1e-3);
  for (const std::size_t other : {0u, 2u, 4u}) EXPECT_LT(rows[other].back(), rows[1].back() - 10);
  // The reciprocal path has the same echo.
  ASSERT_EQ(
      rcs({"--frequency-ghz", "10", "--azimuth-deg", "20", "--transmit-azimuth-deg", "20", "--edges", "off"}).code, 0);
  const double there = read_table(table()).rows.at(0).back();
  ASSERT_EQ(rcs({"--frequency-ghz", "10", "--azimuth-deg", "20", "--edges", "off"}).code, 0);
  EXPECT_NEAR(read_table(table()).rows.at(0).back(), there, 1e-3);
  // The table states the direction of its transmitter, and is not compared with tables of other transmitters.
  const std::string own = folder_.path() / "own.csv";
  const auto against = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"rcs", "--target", plate(), "-o", table(), "--frequency-ghz", "10", "--azimuth-deg",
                               "-40:40:20", "--reference", own, "--reference-polarisation", "vv"});
    return run_program(more);
  };
  std::filesystem::remove(table());
  ASSERT_EQ(run_program({"rcs", "--target", plate(), "-o", own, "--frequency-ghz", "10", "--azimuth-deg", "-40:40:20",
                         "--transmit-azimuth-deg", "20"})
                .code,
            0);
  for (const auto& other : {std::vector<std::string>{}, {"--transmit-azimuth-deg", "21"}}) {
    const ProgramResult compared = against(other);
    EXPECT_EQ(compared.code, 2);
    EXPECT_THAT(compared.err, HasSubstr("own.csv: its transmitter is at azimuth 20 deg, elevation 0 deg, the sweep"));
    EXPECT_FALSE(std::filesystem::exists(table()));
  }
  EXPECT_EQ(against({"--transmit-azimuth-deg", "20"}).code, 0);
  const auto warned = [&](const char* azimuth) {
    return rcs({"--frequency-ghz", "10", "--azimuth-deg", azimuth, "--transmit-azimuth-deg", "20"}).err;
  };
  EXPECT_THAT(warned("-90:130:20"), Not(HasSubstr("behind the target")));
  EXPECT_THAT(warned("-90:160:10"), HasSubstr("receivers up to 140 deg from the transmitter: behind the target"));
}

TEST_F(RcsCommand, HasAWavefrontCurvatureAtShortRange) {
  ASSERT_EQ(run_program({"mesh", "make", "plate", "--length-m", "2", "--width-m", "0.2", "-o", plate()}).code, 0);
  const auto level = [&](const std::string& range_m) {
    EXPECT_EQ(
        rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--edges", "off", "--wavefront-range-m", range_m}).code, 0);
    return read_table(table()).rows.at(0).back();
  };
  // 2 L^2 / lambda = 267 m: far beyond it the echo does not change, at 30 m the phase of the ends differs by 14 rad.
  EXPECT_NEAR(level("100000"), level("0"), 0.01);
  EXPECT_LT(level("30"), level("0") - 6);
  const ProgramResult inside = rcs({"--frequency-ghz", "10", "--azimuth-deg", "0", "--wavefront-range-m", "0.5"});
  EXPECT_EQ(inside.code, 2);
  EXPECT_THAT(inside.err, HasSubstr("wavefront range 0.5 m: must be at least ten times the target radius"));
}

// A leaning strip has no rotational symmetry: at the zenith its matrix rotates with the azimuth as it does just below.
TEST_F(RcsCommand, KeepsItsBasisThroughTheZenith) {
  const Mat3 leaning = axis_rotation(0.15, Vec3::UnitX()) * axis_rotation(kPi / 2 - 0.02, Vec3::UnitY());
  write_mesh(plate(), transformed(make_plate(0.04, 0.3), leaning, Vec3::Zero()));
  for (const char* azimuth : {"0", "60", "-110"}) {
    const ProgramResult result =
        rcs({"--frequency-ghz", "10", "--azimuth-deg", azimuth, "--elevation-deg", "89.999:90:0.001"});
    ASSERT_EQ(result.code, 0) << result.err;
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
  const auto refused = [&](std::vector<std::string> arguments, const std::string& message) {
    const ProgramResult result = rcs(std::move(arguments));
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("seaglint: "));
    EXPECT_THAT(result.err, HasSubstr(message));
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

}  // namespace
}  // namespace seaglint
