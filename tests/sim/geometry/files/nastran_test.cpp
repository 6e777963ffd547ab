// SPDX-License-Identifier: BSD-3-Clause
// NASTRAN bulk data: fields, continuation lines, numbers, coordinate systems, names, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Nastran : public MeshFile {
 protected:
  TriangleMesh read(const std::string& cards) { return read_mesh(put("a.bdf", cards)); }
  void refuse(const std::string& cards, const std::string& what) { expect_error(put("a.bdf", cards), what); }
};

const std::string kTriangle = "CTRIA3,1,7,1,2,3\nENDDATA\n";
const std::string kNodes = "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,2.,1.,0.\n";

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
  refuse("GRDSET,,5\n" + kNodes + kTriangle, "GRID 1: coordinate system 5 is not given");
}

TEST_F(Nastran, HasTheNamesOfPreProcessorsAsParts) {
  const auto parts = [&](const std::string& notes) {
    return read(kNodes + notes + "CTRIA3,1,7,1,2,3\nCTRIA3,2,8,2,4,3\nENDDATA\n").part_names;
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
  EXPECT_EQ(read(head + "PARAM,POST,-1\n" + kNodes + kTriangle + "anything\n").triangles.size(), 1u);
  refuse(head + kNodes + "CTRIA3,1,7,1,2,3\n", "a.bdf:10:1: ends without ENDDATA: the file is cut off");
  EXPECT_THAT(read(kNodes + "CTRIA3,1,7,1,2,3\n").findings, ElementsAre(HasSubstr("ends without ENDDATA")));
}

TEST_F(Nastran, CountsWhatItDoesNotRead) {
  const TriangleMesh mesh = read(
      kNodes +
      "CTRIA6,1,7,1,2,3,4,4,4\nCTETRA,3,1,1,2,3,4\nCTETRA,4,1,1,2,3,4\nCTRIAX6,5,1,1,2,3,4,5,6\nCTRA3,9,1,1,2,3\n" +
      "CTRIA3,9,7,2,4,3,,.01\nCBAR,6,1,1,2\n" + kTriangle);
  EXPECT_THAT(mesh.findings, ElementsAre("1 shell with an offset from the nodes (ZOFFS): read at the nodes",
                                         "1 element of higher order: read by the corners, sides are straight",
                                         "2 solid elements (CTETRA): not read, only shells are",
                                         "2 other elements (CTRA3, CTRIAX6): not read"));
  refuse(kNodes + "CHEXA,3,1,1,2,3,4,1,2,+\n+,3,4\nENDDATA\n", "a.bdf: contains 1 solid element (CHEXA), no shells");
}

TEST_F(Nastran, ThatIsDamagedOrUnreadableIsRefusedWithItsPlace) {
  refuse("INCLUDE 'hull.bdf'\n" + kNodes + kTriangle, "a.bdf:1:1: INCLUDE: other files are not read");
  refuse("BEGIN SUPER=2\n" + kNodes + kTriangle, "a.bdf:1:7: BEGIN SUPER=2: superelements are not read");
  refuse(kNodes + "=,*1,=,=,*1.\n" + kTriangle, "a.bdf:5:1: replicated cards are not read");
  refuse("+A,1.\n" + kNodes + kTriangle, "a.bdf:1:1: a continuation line without a card before it");
  refuse(kNodes + "CQUAD8,5,7,1,2,4,3,1,2,+A\n+B,4,3\n" + kTriangle,
         "a.bdf:6:1: continuation '+B' where '+A' should follow");
  refuse(kNodes + "CTRIA3,1,7,1,2\nENDDATA\n", "a.bdf:5:1: CTRIA3: field 6 is empty");
  refuse(kNodes + "CTRIA3,1,7,1,2,9\nENDDATA\n", "a.bdf:5:1: the element names node 9, which the file does not have");
  refuse("GRID,1,,0.,0.,5.\n" + kNodes + kTriangle, "a.bdf:2:6: node 1 is given twice, at different positions");
  EXPECT_EQ(read("GRID,1,,0.,0.,0.\n" + kNodes + kTriangle).triangles.size(), 1u);
  refuse("GRID,1,,0.,0.,0.,,,,+A,5\n" + kTriangle, "a.bdf:1:24: more than 10 fields in one line");
  refuse("GRID,1,,1e40,0.,0.\n" + kTriangle, "node 1 has the coordinate 1e+40");
  refuse("SOL 101\n", "a.bdf:1:1: no card GRID");
  refuse(kNodes + "ENDDATA\n", "a.bdf: contains no shell elements");
  // A chain of coordinate systems is as long as the file.
  std::string chain = kNodes;
  for (int i = 1; i < 20000; ++i)
    chain += "CORD2R," + std::to_string(i) + "," + std::to_string(i + 1) + ",0.,0.,0.,0.,0.,1.\n,1.\n";
  refuse(chain + kTriangle, "coordinate system 20000, which it refers to, is not given");
}

}  // namespace
}  // namespace seaglint
