// SPDX-License-Identifier: BSD-3-Clause
// I-DEAS universal files: datasets, units, groups, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "sim/geometry/files/mesh_io.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string dataset(int number, const std::string& records) {
  return "    -1\n" + std::string(number < 1000 ? "   " : "  ") + std::to_string(number) + "\n" + records + "    -1\n";
}

// A rectangle of 2 x 1 as a quadrilateral and two triangles, one of them parabolic with its corners at every other
// node.
const std::string kNodes = dataset(2411,
                                   "         1         1         1        11\n   0.0D+00   0.0D+00   0.0D+00\n"
                                   "         2         1         1        11\n   1.0D+00   0.0D+00   0.0D+00\n"
                                   "         3         1         1        11\n   1.0D+00   1.0D+00   0.0D+00\n"
                                   "         4         1         1        11\n   0.0D+00   1.0D+00   0.0D+00\n"
                                   "         5         1         1        11\n   2.0D+00   0.0D+00   0.0D+00\n"
                                   "         6         1         1        11\n   2.0D+00   1.0D+00   0.0D+00\n"
                                   "         7         1         1        11\n   1.5D+00   0.5D+00   0.0D+00\n"),
                  kElements =
                      dataset(2412,
                              "        10        94         3         0         7         4\n         1         2  "
                              "       3         4\n        11        91         3         0         7         3\n"
                              "         2         5         3\n        12        92         4         0         "
                              "7         6\n         5         7         6         7         3         7\n"
                              "        13        21         4         0         7         2\n         0         "
                              "1         1\n         1         2\n");

class Unv : public MeshFile {
 protected:
  TriangleMesh read(const std::string& text, const std::string& unit = "m") {
    return read_mesh(put("a.unv", text), unit);
  }
  void refuse(const std::string& text, const std::string& what) { expect_error(put("a.unv", text), what); }
};

TEST_F(Unv, HasShellsWithPropertiesAndGroups) {
  const TriangleMesh mesh = read(kNodes + dataset(58, "any\n") + kElements);
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
  const std::string last = kNodes + kElements + groups, first = groups + kElements + kNodes;
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
  const TriangleMesh converted = read(millimetres + kNodes + kElements);
  EXPECT_DOUBLE_EQ(length(converted), 0.002);
  EXPECT_THAT(converted.findings, testing::Contains("its lengths are in units of 0.001 m by its dataset 164"));
  EXPECT_DOUBLE_EQ(length(read(millimetres + kNodes + kElements, "mm")), 0.002);
  EXPECT_DOUBLE_EQ(length(read(metres + kNodes + kElements)), 2);
  // Programs without units state metres.
  const TriangleMesh asked = read(metres + kNodes + kElements, "mm");
  EXPECT_DOUBLE_EQ(length(asked), 0.002);
  EXPECT_THAT(asked.findings, testing::Contains("its dataset 164 states metres: read in mm as asked for"));
  EXPECT_DOUBLE_EQ(length(read(kNodes + kElements, "cm")), 0.02);
  try {
    read(millimetres + kNodes + kElements, "in");
    ADD_FAILURE() << "inches accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("unit \"in\": must be that of the file, 0.001 m by its dataset 164"));
  }
}

TEST_F(Unv, ThatIsDamagedOrUnreadableIsRefusedWithItsPlace) {
  refuse("anything\n" + kNodes, "a.unv:1:1: 'anything' where -1 begins a dataset");
  refuse(kNodes.substr(0, kNodes.size() - 7), "a.unv:2:3: dataset 2411: ends without -1: the file is cut off");
  refuse("    -1\n  24x1\n    -1\n", "a.unv:2:3: '24x1' where the number of a dataset belongs");
  refuse(dataset(2411, "         1         1         1        11\n   0.0D+00   zero   0.0D+00\n"),
         "a.unv:4:14: coordinates: value 'zero': must be a number");
  refuse(dataset(2411, "         1         1         1        11\n   0.0D+00   0.0D+00\n"),
         "a.unv:4:4: dataset 2411: coordinates: 2 fields: must be 3");
  refuse(dataset(2411, "         1         1         1        11\n"), "dataset 2411: ends within a record");
  refuse(
      kNodes + dataset(2412,
                       "         1        91         3         0         7         3\n         1         2      0.5\n"),
      "nodes of the element: value '0.5': must be an integer");
  refuse(kNodes +
             dataset(2412,
                     "         1        92         3         0         7         3\n         1         2         3\n"),
         "element 1 has 3 nodes: its descriptor has 6");
  refuse(kNodes +
             dataset(2412,
                     "         1        91         3         0         7 999999999\n         1         2         3\n"),
         "element of 999999999 nodes: must be within 1 and 1000");
  refuse(kNodes + dataset(2412,
                          "         1       111         3         0         7         4\n         1         2         "
                          "3         4\n"),
         "contains 1 solid element (descriptor 111), no shells");
  refuse(kNodes, "contains no shell elements");
  refuse(dataset(2411, "         1         4         1        11\n   0.0D+00   0.0D+00   0.0D+00\n") + kElements,
         "a.unv:3:1: the node is in coordinate system 4");
  refuse(dataset(164, "         5mm                     2\n   -1.0D+00   1.0D+00   1.0D+00\n") + kNodes + kElements,
         "factor of length -1: must be greater than 0");
}

// Dataset 2420 may say what system 1 is.
TEST_F(Unv, HasGlobalCoordinatesOnly) {
  const auto system = [](const char* rows) {
    return dataset(2420, std::string("         1\nPart1\n         1         0         8\nCS1\n") + rows);
  };
  EXPECT_THAT(read(system(" 1. 0. 0.\n 0. 1. 0.\n 0. 0. 1.\n 0. 0. 0.\n") + kNodes + kElements).findings.size(), 1u);
  refuse(system(" 1. 0. 0.\n 0. 1. 0.\n 0. 0. 1.\n 0. 5. 0.\n") + kNodes + kElements,
         "the node is in coordinate system 1");
}

}  // namespace
}  // namespace seaglint
