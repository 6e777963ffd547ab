// SPDX-License-Identifier: BSD-3-Clause
// Shells as Gmsh and meshio write them (tests/cases/README.md), whole and damaged.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "tests/refusal.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kFolder = SEAGLINT_SOURCE_DIR "/tests/cases/meshes/exchange/";

std::size_t triangles_of_part(const TriangleMesh& mesh, std::size_t part) {
  return static_cast<std::size_t>(std::count(mesh.triangle_part.begin(), mesh.triangle_part.end(), part));
}

class ExchangeFile : public MeshFile, public testing::WithParamInterface<const char*> {};

// A box of 1.2 x 0.7 x 0.5 m. Counts as meshio reads Gmsh's file: 38 triangles and 4 quadrilaterals at 25 corners.
TEST_P(ExchangeFile, HasTheBoxThatGmshMeshed) {
  const std::string name = GetParam();
  const TriangleMesh mesh = read_mesh(kFolder + name);
  EXPECT_EQ(mesh.triangles.size(), 46u);
  EXPECT_EQ(mesh.vertices.size(), 25u);
  // Six digits of small fields and of "%g", at 46 triangles.
  const double rounding = name.ends_with(".msh") || name.ends_with(".unv") ? 1e-14 : 46 * 1.2e-6;
  EXPECT_NEAR(surface_area(mesh), 3.58, rounding);
  EXPECT_NEAR(enclosed_volume(mesh), 0.42, rounding);
  const MeshDiagnostics found = diagnose(mesh);
  EXPECT_EQ(found.open_edges + found.inconsistent_edges + found.non_manifold_edges, 0u);
  if (name.find("second_order") != std::string::npos) {
    EXPECT_THAT(mesh.findings, ElementsAre("42 elements of higher order: read by the corners, sides are straight"));
  } else {
    EXPECT_THAT(mesh.findings, IsEmpty());
  }
}

TEST_P(ExchangeFile, HasItsParts) {
  const std::string name = GetParam();
  const TriangleMesh mesh = read_mesh(kFolder + name);
  if (name.ends_with(".bdf")) {
    EXPECT_THAT(mesh.part_names, testing::UnorderedElementsAre("property_1", "property_2", "property_3", "property_4",
                                                               "property_5", "property_6"));
  } else if (name.ends_with(".nas")) {
    EXPECT_THAT(mesh.part_names, ElementsAre("body"));  // meshio writes no properties
  } else {
    // Gmsh replaces blanks in names of universal files.
    EXPECT_THAT(mesh.part_names, ElementsAre("hull", name.ends_with(".unv") ? "deck_plate" : "deck plate"));
    EXPECT_EQ(triangles_of_part(mesh, 0), 38u);
    EXPECT_EQ(triangles_of_part(mesh, 1), 8u);
  }
}

// A file cut off anywhere before its last character is refused.
TEST_P(ExchangeFile, ThatIsCutOffIsRefused) {
  const std::string name = GetParam(), bytes = bytes_of(kFolder + name);
  const std::size_t end = bytes.find_last_not_of(" \r\n") + 1;
  for (std::size_t size = 1; size < end; size += 1 + end / 61) {
    const std::filesystem::path path = put(name, bytes.substr(0, size));
    const std::string message = refusal_of([&] {
      const TriangleMesh mesh = read_mesh(path);
      // Gmsh writes no BEGIN BULK, without which a file may be a part of another.
      const bool is_part =
          name.ends_with(".bdf") && !mesh.findings.empty() && mesh.findings[0].starts_with("ends without ENDDATA");
      EXPECT_TRUE(is_part) << name << " cut at byte " << size;
    });
    EXPECT_THAT(message, testing::AnyOf("accepted", testing::StartsWith(path.string())));
  }
}

TEST_P(ExchangeFile, WithChangedBytesIsNeverACrash) {
  const std::string name = GetParam(), bytes = bytes_of(kFolder + name);
  Random random({.seed = 4, .stream = Stream::kTest, .index = 0});
  for (int i = 0; i < 100; ++i) {
    std::string changed = bytes;
    const std::uint32_t count = 1 + random.below(4);
    for (std::uint32_t k = 0; k < count; ++k) {
      char& c = changed[random.below(static_cast<std::uint32_t>(changed.size()))];
      c = static_cast<char>(i % 2 == 0 ? random.below(256) : '0' + random.below(10));
    }
    const std::filesystem::path path = put(name, changed);
    const std::string message = refusal_of([&] {
      const TriangleMesh mesh = read_mesh(path);
      for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle) EXPECT_LT(v, mesh.vertices.size());
    });
    EXPECT_THAT(message, testing::AnyOf("accepted", testing::StartsWith(path.string())));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, ExchangeFile,
                         testing::Values("v22.msh", "v22_binary.msh", "v22_big_endian.msh", "v41.msh", "v41_binary.msh",
                                         "v41_big_endian.msh", "v41_second_order.msh", "box.unv", "second_order.unv",
                                         "small_field.bdf", "free_field.bdf", "large_field.bdf", "second_order.bdf",
                                         "meshio_large_field.nas"),
                         [](const auto& file) {
                           std::string name = file.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

// NASTRAN bulk data: fields, continuation lines, numbers, coordinate systems, names, what is refused.

using testing::HasSubstr;

// A text in a file of one name.
class ShellText : public MeshFile {
 protected:
  explicit ShellText(const char* name) : name_(name) {}
  TriangleMesh read(const std::string& text, const char* unit = "m") const { return read_mesh(put(name_, text), unit); }
  void refuse(const std::string& text, const std::string& what) const { expect_error(put(name_, text), what); }

 private:
  const char* name_;
};

class Nastran : public ShellText {
 protected:
  Nastran() : ShellText("a.bdf") {}
};

const std::string kTriangle = "CTRIA3,1,7,1,2,3\nENDDATA\n";
const std::string kGrid = "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,2.,1.,0.\n";

// One rectangle of 2 m x 1 m in every way to write it.
TEST_F(Nastran, HasSmallLargeAndFreeFieldsWithContinuationLines) {
  const std::string small_fields =
      "GRID           1              0.      0.      0.\nGRID           2              2.      0.      0.\n"
      "GRID           3              2.      1.      0.\nGRID           4              0.      1.      0.\n"
      "CQUAD4         5       7       1       2       3       4\nENDDATA\n";
  // Tabs lead to the next field; lower case.
  const std::string tabs =
      "grid\t1\t\t0.\t0.\t0.\ngrid\t2\t\t2.\t0.\t0.\ngrid\t3\t\t2.\t1.\t0.\ngrid\t4\t\t0.\t1.\t0.\n"
      "cquad4\t5\t7\t1\t2\t3\t4\nenddata\n";
  // With labels and without; a comment between the lines of a card.
  const std::string large_fields =
      "GRID*                  1                              0.              0.*A\n$ comment\n*A                    "
      "0.\n"
      "GRID*                  2                             2.0             0.0\n*                   0.0\n"
      "GRID*                  3                          2.0D+0          1.0E+0*B1\n*B1                   0.\n"
      "GRID*                  4                                             1.0\n*\n"
      "CQUADR         5       7       1       2       3       4\nENDDATA\n";
  // Eight corners, whose last two are in the next line.
  const std::string free_fields =
      "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,1.,0.\nGRID,4,,0.,1.,0.\nGRID,5,,1.,0.,0.\nGRID,6,,2.,.5,0.\n"
      "GRID,7,,1.,1.,0.\nGRID,8,,0.,.5,0.\nCQUAD8,5,7,1,2,3,4,5,6,+Q\n+Q,7,8\nENDDATA\n";
  // Exponents without a letter.
  const std::string large_free_fields =
      "GRID*,1,,0.,0.\n*,0.\nGRID*,2,,2.+0,0.\n*,0.\nGRID*,3,,.2+1,1.\n*,0.\nGRID*,4,,0.,10.-1\n*,\n"
      "CSHEAR,5,7,1,2,3,4\nENDDATA\n";
  for (const std::string& deck : {small_fields, tabs, large_fields, free_fields, large_free_fields}) {
    SCOPED_TRACE(deck);
    const TriangleMesh mesh = read(deck);
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_NEAR(surface_area(mesh), 2, 1e-14);
    EXPECT_GT(area_vector(mesh, 0).z(), 0);
    EXPECT_THAT(mesh.part_names, ElementsAre("property_7"));
  }
}

TEST_F(Nastran, HasNumbersWithExponentsOfASignAlone) {
  const TriangleMesh mesh =
      read("GRID,1,,1.5-3,-1.5+2,.25\nGRID,2,,2.5D-1,-.5E+1,1\nGRID,3,,7.,1.-30,+3.\n" + kTriangle);
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], Vec3(1.5e-3, -150, 0.25));
  EXPECT_EQ(mesh.vertices[1], Vec3(0.25, -5, 1));
  EXPECT_EQ(mesh.vertices[2], Vec3(7, 1e-30, 3));
  for (const char* bad : {"1.5-3-2", "+-1.", "1.5x", "0x1p3", "nan", "1.5 -3", "--1.", "1e", "1.5E"})
    refuse(std::string("GRID,1,,") + bad + ",0.,0.\n" + kTriangle, "a.bdf:1:9: GRID: value '" + std::string(bad));
  refuse("GRID,1.5,,0.,0.,0.\n" + kTriangle, "a.bdf:1:6: GRID: value '1.5': must be an integer");
}

// A point at radius 2, azimuth 90 deg, in systems about an origin at (1, 0, 0), given relative to one that is turned
// by 90 deg about z; the systems follow their use.
TEST_F(Nastran, HasRectangularCylindricalAndSphericalSystems) {
  const TriangleMesh mesh = read(
      "GRID,1,10,0.,2.,3.\nGRID,2,11,2.,90.,3.\nGRID,3,12,2.,90.,90.\nCTRIA3,1,7,1,2,3\n"
      "CORD2R,10,20,0.,-1.,0.,0.,-1.,1.,+A\n+A,1.,-1.,0.\nCORD2C,11,20,0.,-1.,0.,0.,-1.,1.\n,1.,-1.,0.\n"
      "CORD2S,12,0,1.,0.,0.,1.,0.,1.\n,2.,0.,0.\n"
      "CORD2R,20,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\nENDDATA\n");
  // x of system 20 is the base's y, its y is -x: its point (0, -1, 0) is (1, 0, 0); its point (1, -1, 0) adds (0, 1,
  // 0).
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_LT((mesh.vertices[0] - Vec3(-1, 0, 3)).norm(), 1e-14);
  EXPECT_LT((mesh.vertices[1] - Vec3(-1, 0, 3)).norm(), 1e-14);
  EXPECT_LT((mesh.vertices[2] - Vec3(1, 2, 0)).norm(), 1e-14);

  const std::string node = "GRID,1,10,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,1.,0.\n";
  refuse(node + kTriangle, "a.bdf:1:6: GRID 1: coordinate system 10 is not given");
  refuse(node + "CORD1R,10,1,2,3\n" + kTriangle, "coordinate system 10 is not CORD2R, CORD2C or CORD2S");
  refuse(node + "CORD2R,10,10,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n" + kTriangle,
         "a.bdf:4:1: coordinate system 10 refers to itself");
  refuse(node + "CORD2R,10,9,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n" + kTriangle,
         "a.bdf:4:1: coordinate system 9, which it refers");
  refuse(node + "CORD2R,10,,0.,0.,0.,0.,0.,1.\n,0.,0.,3.\n" + kTriangle, "a.bdf:4:1: the three points");
  refuse("GRDSET,,5\n" + kGrid + kTriangle, "GRID 1: coordinate system 5 is not given");
}

TEST_F(Nastran, HasTheNamesOfPreProcessorsAsParts) {
  const auto parts = [&](const std::string& notes) {
    return read(kGrid + notes + "CTRIA3,1,7,1,2,3\nCTRIA3,2,8,2,4,3\nENDDATA\n").part_names;
  };
  EXPECT_THAT(parts(""), ElementsAre("property_7", "property_8"));
  EXPECT_THAT(
      parts("$HMNAME COMP                   1\"plates\" 8 \"steel\" 4\n$HMNAME PROP                   7\"hull\" 4\n"),
      ElementsAre("hull", "plates"));
  EXPECT_THAT(parts("$ANSA_NAME_COMMENT;7;PSHELL;fore deck;;NO;NO;\n"), ElementsAre("fore deck", "property_8"));
  EXPECT_THAT(parts("$ Femap Property 8 : mast\n$ Femap with NX Nastran Property 7 : hull: low\n"),
              ElementsAre("hull: low", "mast"));
  EXPECT_THAT(parts("$ Elements and Element Properties for region : house\nPSHELL,7,1,.01\n"
                    "$ Elements and Element Properties for region : funnel\nPSHELL,8,1,.01\n"),
              ElementsAre("house", "funnel"));
}

TEST_F(Nastran, BeginsBehindBeginBulkAndNeedsItsEnd) {
  const std::string head = "SOL 101\nCEND\nTITLE = a, b\nBEGIN BULK\n";
  EXPECT_EQ(read(head + "PARAM,POST,-1\n" + kGrid + kTriangle + "anything\n").triangles.size(), 1u);
  refuse(head + kGrid + "CTRIA3,1,7,1,2,3\n", "a.bdf:10:1: ends without ENDDATA: the file is cut off");
  EXPECT_THAT(read(kGrid + "CTRIA3,1,7,1,2,3\n").findings, ElementsAre(HasSubstr("ends without ENDDATA")));
}

TEST_F(Nastran, CountsWhatItDoesNotRead) {
  const TriangleMesh mesh = read(
      kGrid +
      "CTRIA6,1,7,1,2,3,4,4,4\nCTETRA,3,1,1,2,3,4\nCTETRA,4,1,1,2,3,4\nCTRIAX6,5,1,1,2,3,4,5,6\nCTRA3,9,1,1,2,3\n" +
      "CTRIA3,9,7,2,4,3,,.01\nCBAR,6,1,1,2\n" + kTriangle);
  EXPECT_THAT(mesh.findings, ElementsAre("1 shell with an offset from the nodes (ZOFFS): read at the nodes",
                                         "1 element of higher order: read by the corners, sides are straight",
                                         "2 solid elements (CTETRA): not read, only shells are",
                                         "2 other elements (CTRA3, CTRIAX6): not read"));
  refuse(kGrid + "CHEXA,3,1,1,2,3,4,1,2,+\n+,3,4\nENDDATA\n", "a.bdf: contains 1 solid element (CHEXA), no shells");
}

TEST_F(Nastran, ThatIsDamagedOrUnreadableIsRefusedWithItsPlace) {
  refuse("INCLUDE 'hull.bdf'\n" + kGrid + kTriangle, "a.bdf:1:1: INCLUDE: other files are not read");
  refuse("BEGIN SUPER=2\n" + kGrid + kTriangle, "a.bdf:1:7: BEGIN SUPER=2: superelements are not read");
  refuse(kGrid + "=,*1,=,=,*1.\n" + kTriangle, "a.bdf:5:1: replicated cards are not read");
  refuse("+A,1.\n" + kGrid + kTriangle, "a.bdf:1:1: a continuation line without a card before it");
  refuse(kGrid + "CQUAD8,5,7,1,2,4,3,1,2,+A\n+B,4,3\n" + kTriangle,
         "a.bdf:6:1: continuation '+B' where '+A' should follow");
  refuse(kGrid + "CTRIA3,1,7,1,2\nENDDATA\n", "a.bdf:5:1: CTRIA3: field 6 is empty");
  refuse(kGrid + "CTRIA3,1,7,1,2,9\nENDDATA\n", "a.bdf:5:1: the element names node 9, which the file does not have");
  refuse("GRID,1,,0.,0.,5.\n" + kGrid + kTriangle, "a.bdf:2:6: node 1 is given twice, at different positions");
  EXPECT_EQ(read("GRID,1,,0.,0.,0.\n" + kGrid + kTriangle).triangles.size(), 1u);
  refuse("GRID,1,,0.,0.,0.,,,,+A,5\n" + kTriangle, "a.bdf:1:24: more than 10 fields in one line");
  refuse("GRID,1,,1e40,0.,0.\n" + kTriangle, "node 1 has the coordinate 1e+40");
  refuse("SOL 101\n", "a.bdf:1:1: no card GRID");
  refuse(kGrid + "ENDDATA\n", "a.bdf: contains no shell elements");
  // A chain of coordinate systems is as long as the file.
  std::string chain = kGrid;
  for (int i = 1; i < 20000; ++i)
    chain += "CORD2R," + std::to_string(i) + "," + std::to_string(i + 1) + ",0.,0.,0.,0.,0.,1.\n,1.\n";
  refuse(chain + kTriangle, "coordinate system 20000, which it refers to, is not given");
}

// I-DEAS universal files: datasets, units, groups, what is refused.

std::string dataset(int number, const std::string& records) {
  return "    -1\n" + std::string(number < 1000 ? "   " : "  ") + std::to_string(number) + "\n" + records + "    -1\n";
}

// A rectangle of 2 x 1 as a quadrilateral and two triangles, one of them parabolic with its corners at every other
// node.
const std::string kUnvNodes = dataset(2411,
                                      "         1         1         1        11\n   0.0D+00   0.0D+00   0.0D+00\n"
                                      "         2         1         1        11\n   1.0D+00   0.0D+00   0.0D+00\n"
                                      "         3         1         1        11\n   1.0D+00   1.0D+00   0.0D+00\n"
                                      "         4         1         1        11\n   0.0D+00   1.0D+00   0.0D+00\n"
                                      "         5         1         1        11\n   2.0D+00   0.0D+00   0.0D+00\n"
                                      "         6         1         1        11\n   2.0D+00   1.0D+00   0.0D+00\n"
                                      "         7         1         1        11\n   1.5D+00   0.5D+00   0.0D+00\n"),
                  kUnvElements =
                      dataset(2412,
                              "        10        94         3         0         7         4\n         1         2  "
                              "       3         4\n        11        91         3         0         7         3\n"
                              "         2         5         3\n        12        92         4         0         "
                              "7         6\n         5         7         6         7         3         7\n"
                              "        13        21         4         0         7         2\n         0         "
                              "1         1\n         1         2\n");

class Unv : public ShellText {
 protected:
  Unv() : ShellText("a.unv") {}
};

TEST_F(Unv, HasShellsWithPropertiesAndGroups) {
  const TriangleMesh mesh = read(kUnvNodes + dataset(58, "any\n") + kUnvElements);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.vertices.size(), 6u);
  EXPECT_NEAR(surface_area(mesh), 2, 1e-14);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_GT(area_vector(mesh, t).z(), 0);
  EXPECT_THAT(mesh.part_names, ElementsAre("property_3", "property_4"));
  EXPECT_THAT(mesh.findings, ElementsAre(HasSubstr("1 element of higher order")));

  // A group of two elements and a node; a second group repeats one of them.
  const std::string groups =
      dataset(2467,
              "         1         0         0         0         0         0         0         3\n"
              "bridge wing\n         8        10         0         0         7         1         0 "
              "        0\n         8        12         0         0\n         2         0         0  "
              "       0         0         0         0         1\nother\n         8        10        "
              " 0         0\n");
  const std::string last = kUnvNodes + kUnvElements + groups, first = groups + kUnvElements + kUnvNodes;
  for (const TriangleMesh& grouped : {read(last), read(first)}) {
    EXPECT_THAT(grouped.part_names, ElementsAre("bridge wing", "property_3"));
    EXPECT_THAT(grouped.findings, testing::Contains("1 element in several groups: taken as of the first"));
  }
}

TEST_F(Unv, HasOlderDatasets) {
  const TriangleMesh mesh = read(
      dataset(15,
              "         1         0         0        11  0.00000E+00  0.00000E+00  0.00000E+00\n"
              "         2         0         0        11  2.00000E+00  0.00000E+00 -1.00000E+00\n") +
      dataset(781, "         3         0         0        11\n  0.0000000000000000D+00  3.0D+00  0.0D+00\n") +
      dataset(
          780,
          "         1        91         1         5         1         1         7         3\n         1         2     "
          "    3\n"));
  EXPECT_THAT(mesh.part_names, ElementsAre("property_5"));
  EXPECT_EQ(mesh.vertices[1], Vec3(2, 0, -1));
}

// Millimetres: a length in SI units times 1000 is that of the file.
TEST_F(Unv, HasItsUnitFromItsDataset) {
  const std::string
      millimetres = dataset(
          164,
          "         5mm (milli-newton)     2\n    1.00000000000000000D+03    1.00000000000000000D+03    1.0D+00\n"
          "    2.73149999999999977D+02\n"),
      metres = dataset(164, "         1SI: Meter (newton)    2\n    1.0D+00    1.0D+00    1.0D+00\n    2.7315D+02\n");
  const auto length = [](const TriangleMesh& mesh) { return bounds(mesh).upper.x(); };
  const TriangleMesh converted = read(millimetres + kUnvNodes + kUnvElements);
  EXPECT_DOUBLE_EQ(length(converted), 0.002);
  EXPECT_THAT(converted.findings, testing::Contains("its lengths are in units of 0.001 m by its dataset 164"));
  EXPECT_DOUBLE_EQ(length(read(millimetres + kUnvNodes + kUnvElements, "mm")), 0.002);
  EXPECT_DOUBLE_EQ(length(read(metres + kUnvNodes + kUnvElements)), 2);
  // Programs without units state metres.
  const TriangleMesh asked = read(metres + kUnvNodes + kUnvElements, "mm");
  EXPECT_DOUBLE_EQ(length(asked), 0.002);
  EXPECT_THAT(asked.findings, testing::Contains("its dataset 164 states metres: read in mm as asked for"));
  EXPECT_DOUBLE_EQ(length(read(kUnvNodes + kUnvElements, "cm")), 0.02);
  EXPECT_HAS(refusal_of([&] { read(millimetres + kUnvNodes + kUnvElements, "in"); }),
             "unit \"in\": must be that of the file, 0.001 m by its dataset 164");
}

TEST_F(Unv, ThatIsDamagedOrUnreadableIsRefusedWithItsPlace) {
  refuse("anything\n" + kUnvNodes, "a.unv:1:1: 'anything' where -1 begins a dataset");
  refuse(kUnvNodes.substr(0, kUnvNodes.size() - 7), "a.unv:2:3: dataset 2411: ends without -1: the file is cut off");
  refuse("    -1\n  24x1\n    -1\n", "a.unv:2:3: '24x1' where the number of a dataset belongs");
  refuse(dataset(2411, "         1         1         1        11\n   0.0D+00   zero   0.0D+00\n"),
         "a.unv:4:14: coordinates: value 'zero': must be a number");
  refuse(dataset(2411, "         1         1         1        11\n   0.0D+00   0.0D+00\n"),
         "a.unv:4:4: dataset 2411: coordinates: 2 fields: must be 3");
  refuse(dataset(2411, "         1         1         1        11\n"), "dataset 2411: ends within a record");
  refuse(kUnvNodes +
             dataset(2412,
                     "         1        91         3         0         7         3\n         1         2      0.5\n"),
         "nodes of the element: value '0.5': must be an integer");
  refuse(kUnvNodes +
             dataset(2412,
                     "         1        92         3         0         7         3\n         1         2         3\n"),
         "element 1 has 3 nodes: its descriptor has 6");
  refuse(kUnvNodes +
             dataset(2412,
                     "         1        91         3         0         7 999999999\n         1         2         3\n"),
         "element of 999999999 nodes: must be within 1 and 1000");
  refuse(
      kUnvNodes + dataset(2412,
                          "         1       111         3         0         7         4\n         1         2         "
                          "3         4\n"),
      "contains 1 solid element (descriptor 111), no shells");
  refuse(kUnvNodes, "contains no shell elements");
  refuse(dataset(2411, "         1         4         1        11\n   0.0D+00   0.0D+00   0.0D+00\n") + kUnvElements,
         "a.unv:3:1: the node is in coordinate system 4");
  refuse(
      dataset(164, "         5mm                     2\n   -1.0D+00   1.0D+00   1.0D+00\n") + kUnvNodes + kUnvElements,
      "factor of length -1: must be greater than 0");
}

// Dataset 2420 may say what system 1 is.
TEST_F(Unv, HasGlobalCoordinatesOnly) {
  const auto system = [](const char* rows) {
    return dataset(2420, std::string("         1\nPart1\n         1         0         8\nCS1\n") + rows);
  };
  EXPECT_THAT(read(system(" 1. 0. 0.\n 0. 1. 0.\n 0. 0. 1.\n 0. 0. 0.\n") + kUnvNodes + kUnvElements).findings.size(),
              1u);
  refuse(system(" 1. 0. 0.\n 0. 1. 0.\n 0. 0. 1.\n 0. 5. 0.\n") + kUnvNodes + kUnvElements,
         "the node is in coordinate system 1");
}

// Gmsh's .msh files: groups, orientation, counts, what is refused.

const std::string kHeader = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                  kNodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n5 1 1 0\n7 0 1 0\n$EndNodes\n",
                  kHeader4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
                  kNodes4 =
                      "$Nodes\n1 4 1 7\n2 3 1 4\n1\n2\n5\n7\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n$EndNodes\n";

class Gmsh : public ShellText {
 protected:
  Gmsh() : ShellText("a.msh") {}
};

TEST_F(Gmsh, HasPhysicalAndElementarySurfacesAsParts) {
  const TriangleMesh mesh = read(
      kHeader + "$PhysicalNames\n2\n1 3 \"an edge\"\n2 3 \"upper deck\"\n$EndPhysicalNames\n" + kNodes +
      "$Elements\n5\n1 15 2 0 1 1\n2 1 2 3 1 1 2\n3 2 2 3 8 1 2 5\n4 2 2 4 8 1 5 7\n5 3 2 0 9 1 2 5 7\n$EndElements\n");
  EXPECT_THAT(mesh.part_names, ElementsAre("upper deck", "physical_4", "surface_9"));
  EXPECT_EQ(mesh.triangles.size(), 4u);
}

TEST_F(Gmsh, HasElementsWithoutTagsAsOnePart) {
  const TriangleMesh mesh = read(kHeader + kNodes + "$Elements\n2\n1 2 0 1 2 5\n2 2 0 1 5 7\n$EndElements\n");
  EXPECT_THAT(mesh.part_names, ElementsAre("surface_0"));
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

// A negative group turns its elements, in 4.1 by the reader and in 2.2 by Gmsh itself; nodes have parameters.
TEST_F(Gmsh, TurnsTheElementsOfANegativeGroup) {
  const auto file = [](const char* groups) {
    return kHeader4 + "$PhysicalNames\n1\n2 3 \"deck\"\n$EndPhysicalNames\n$Entities\n0 0 1 0\n8 0 0 0 1 1 0 " +
           groups + " 0\n$EndEntities\n" + kNodes4 + "$Elements\n1 2 1 2\n2 8 2 2\n1 1 2 5\n2 1 5 7\n$EndElements\n";
  };
  for (const auto& [groups, side] : {std::pair{"1 3", 1}, {"1 -3", -1}, {"2 3 4", 1}}) {
    const TriangleMesh mesh = read(file(groups));
    EXPECT_THAT(mesh.part_names, ElementsAre("deck"));
    EXPECT_DOUBLE_EQ(area_vector(mesh, 0).z(), 0.5 * side);
    EXPECT_DOUBLE_EQ(area_vector(mesh, 1).z(), 0.5 * side);
    EXPECT_EQ(mesh.findings.size(), groups[0] == '2' ? 1u : 0u);
  }
  EXPECT_THAT(read(file("0")).part_names, ElementsAre("surface_8"));
}

TEST_F(Gmsh, CountsSolidsAndRefusesThemAlone) {
  const std::string solids = "$Elements\n2\n1 4 2 0 1 1 2 5 7\n2 4 2 0 1 1 2 5 7\n$EndElements\n";
  refuse(kHeader + kNodes + solids, "contains 2 solid elements (type 4), no shells");
  const TriangleMesh mesh = read(kHeader + kNodes + solids + "$Elements\n1\n3 2 2 0 1 1 2 5\n$EndElements\n");
  EXPECT_THAT(mesh.findings, ElementsAre("2 solid elements (type 4): not read, only shells are"));
}

TEST_F(Gmsh, OfOtherVersionsIsRefusedByName) {
  expect_error(kFolder + "v1.msh", "v1.msh:1:1: version 1.0 of Gmsh's format is not read: save it as 2.2 or 4.1");
  expect_error(kFolder + "v40.msh", "v40.msh:2:1: version 4 of Gmsh's format is not read");
  refuse("(0 \"Fluent\")\n", "a.msh:1:1: '(0 \"Fluent\")' where a section begins with $");
  refuse("$MeshFormat\n4.1 0 4\n$EndMeshFormat\n", "values of 4 bytes: must be 8");
}

TEST_F(Gmsh, ThatIsDamagedIsRefusedWithItsPlace) {
  const std::string elements = "$Elements\n1\n1 2 2 0 1 1 2 5\n$EndElements\n";
  refuse(kHeader + kNodes, "ends without $Elements: the file is cut off");
  refuse(kHeader + "$Nodes\n5\n1 0 0 0\n2 1 0 0\n5 1 1 0\n7 0 1 0\n$EndNodes\n" + elements,
         "a.msh:10:1: $Nodes: value '$EndNodes': must be an integer");
  refuse(kHeader + "$Nodes\n3\n1 0 0 0\n2 1 0 0\n5 1 1 0\n7 0 1 0\n$EndNodes\n" + elements,
         "a.msh:9:1: '7' where $EndNodes belongs: the section has another length than its counts");
  refuse(kHeader + "$Nodes\n99999999999\n1 0 0 0\n$EndNodes\n" + elements, "a.msh:7:1: $Nodes: value '$EndNodes'");
  refuse(kHeader + "$Nodes\n1\n1 0 0 x0\n$EndNodes\n", "a.msh:6:7: $Nodes: value 'x0': must be a number");
  refuse(kHeader + "$Nodes\n1\n1 0 0 nan\n$EndNodes\n" + elements, "a.msh:6:1: node 1 has the coordinate nan");
  refuse(kHeader + kNodes + "$Elements\n1\n1 2 2 0 1 1 2 6\n$EndElements\n",
         "a.msh:13:1: the element names node 6, which the file does not have");
  refuse(kHeader + kNodes + "$Elements\n1\n1 200 2 0 1 1 2 6\n$EndElements\n",
         "a.msh:13:3: $Elements: elements of type 200");
  refuse(kHeader + kNodes + "$NodeData\n1\n", "ends within $NodeData: the file is cut off");
  refuse(kHeader4 + "$Nodes\n1 5 1 7\n2 3 0 4\n1\n2\n5\n7\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n",
         "$Nodes has 4 nodes: its header promises 5");
  refuse(kHeader4 + kNodes4 + "$Elements\n1 1 1 2\n2 8 2 2\n1 1 2 5\n2 1 5 7\n$EndElements\n",
         "$Elements has 2 elements: its header promises 1");
}

// The count of a binary section is no more than the file has.
TEST_F(Gmsh, BinaryIsRefusedWithItsByte) {
  std::string bytes = bytes_of(kFolder + "v22_binary.msh");
  const std::size_t nodes = bytes.find("$Nodes\n25\n") + 10;  // the first byte behind the count
  std::string changed = bytes;
  constexpr std::string_view kNotANumber("\0\0\0\0\0\0\xF8\x7F", 8);
  changed.replace(nodes + 4, kNotANumber.size(), kNotANumber);
  refuse(changed, "a.msh: byte " + std::to_string(nodes) + ": node 1 has the coordinate nan");
  changed = bytes;
  changed[nodes - 3] = '9';
  refuse(changed, "a.msh: ");
  changed = bytes;
  changed[20] = 'x';
  refuse(changed, "a.msh: byte 20: the byte order is not that of a 1");
}

}  // namespace
}  // namespace seaglint
