// SPDX-License-Identifier: BSD-3-Clause
// Gmsh's .msh files: groups, orientation, counts, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "sim/geometry/files/mesh_io.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using testing::ElementsAre;

const std::string kFolder = SEAGLINT_SOURCE_DIR "/tests/cases/meshes/exchange/",
                  kHeader = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                  kNodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n5 1 1 0\n7 0 1 0\n$EndNodes\n",
                  kHeader4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
                  kNodes4 =
                      "$Nodes\n1 4 1 7\n2 3 1 4\n1\n2\n5\n7\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n$EndNodes\n";

class Gmsh : public MeshFile {
 protected:
  TriangleMesh read(const std::string& text) { return read_mesh(put("a.msh", text)); }
  void refuse(const std::string& text, const std::string& what) { expect_error(put("a.msh", text), what); }
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
