// SPDX-License-Identifier: BSD-3-Clause
// Meshes as other programs write them, and damaged ones (tests/cases/README.md).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string kMeshes = SEAGLINT_SOURCE_DIR "/tests/cases/meshes/";

class FieldMesh : public MeshFile {
 protected:
  static std::string refusal(const std::string& path) { return MeshFile::refusal(path).substr(path.rfind('/') + 1); }
};

TEST_F(FieldMesh, WithOddPolygonsIsReadAndCountsThem) {
  const TriangleMesh crossing = read_mesh(kMeshes + "bowtie_among_good.obj");
  EXPECT_EQ(crossing.triangles.size(), 3u);  // a fan of two, and the triangle
  EXPECT_THAT(
      diagnostic_messages(diagnose(crossing)),
      Contains("1 polygon crosses itself: taken as the fan of the first corner (the first odd polygon: line 8)"));
  const TriangleMesh back = read_mesh(kMeshes + "quad_out_and_back.obj");
  EXPECT_EQ(back.triangles.size(), 2u);
  EXPECT_THAT(diagnostic_messages(diagnose(back)),
              Contains("1 polygon goes out and back without area: dropped (the first odd polygon: line 7)"));
  // A spike on a polygon is removed without a word: its area is the same.
  const TriangleMesh spike = read_mesh(put("a.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 5 0 3\nf 1 2 5 2 3 4\n"));
  EXPECT_NEAR(surface_area(spike), 4, 1e-12);
  EXPECT_THAT(spike.findings, testing::IsEmpty());
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n3 0 1 2\n";
  EXPECT_THAT(read_mesh(put("a.ply", ply)).findings, Contains(HasSubstr("1 polygon crosses itself")));
}

TEST_F(FieldMesh, NamesFreeFormGeometryThatItDoesNotRead) {
  const TriangleMesh mesh = read_mesh(
      put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncstype bspline\ncurv 0 1 1 2 3\nsurf 0 1 0 1 1 2 3 1\n"));
  EXPECT_THAT(mesh.findings, Contains("3 lines of free-form geometry (cstype in line 5, ...): not read, export it as "
                                      "triangles"));
}

TEST_F(FieldMesh, HasTriangleStrips) {
  const TriangleMesh mesh = read_mesh(kMeshes + "tristrips.ply");
  EXPECT_EQ(mesh.triangles.size(), 24u);
  // One strip of a quad; both triangles have the orientation of the first.
  const std::string quad =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement "
      "tristrips "
      "1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const TriangleMesh strip = read_mesh(put("a.ply", quad + "4 0 1 2 3\n"));
  ASSERT_EQ(strip.triangles.size(), 2u);
  EXPECT_GT(area_vector(strip, 0).z(), 0);
  EXPECT_GT(area_vector(strip, 1).z(), 0);
  EXPECT_EQ(read_mesh(put("a.ply", quad + "7 0 1 2 -1 1 3 2\n")).triangles.size(), 2u);
}

// One mesh with float positions, with 16-bit integers, and with four positions replaced.
TEST_F(FieldMesh, OfGltfIsReadQuantisedAndSparse) {
  const TriangleMesh plain = read_mesh(kMeshes + "texture_webp_required.gltf");  // an extension of its textures
  ASSERT_EQ(plain.vertices.size(), 16u);
  for (const auto& [name, tolerance] : {std::pair{"sparse.gltf", 1e-6},
                                        {"quantised.gltf", 0.5 * 2.2e-5 + 1e-7},
                                        {"gltfpack_default.glb", 0.5 * 7.4e-5 + 1e-7}}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = read_mesh(kMeshes + name);
    ASSERT_EQ(mesh.triangles.size(), plain.triangles.size());
    // Optimisers renumber vertices and triangles.
    const auto centroid = [](const TriangleMesh& m, std::size_t t) {
      return Vec3((m.vertices[m.triangles[t][0]] + m.vertices[m.triangles[t][1]] + m.vertices[m.triangles[t][2]]) / 3);
    };
    for (std::size_t t = 0; t < plain.triangles.size(); ++t) {
      double nearest = 1;
      for (std::size_t u = 0; u < mesh.triangles.size(); ++u)
        nearest = std::min(nearest, (centroid(plain, t) - centroid(mesh, u)).cwiseAbs().maxCoeff());
      EXPECT_LE(nearest, tolerance) << t;
    }
    EXPECT_NEAR(surface_area(mesh), surface_area(plain), 24 * 4 * tolerance);
  }
}

// A decoy of 0.98 m drawn in millimetres, a ship drawn 2.8 m long, a ship of 144 m in millimetres.
TEST_F(FieldMesh, OfAnUnlikelySizeAsksForItsUnit) {
  const auto asks = [](const std::string& file, const char* unit) {
    const std::vector<std::string> messages = diagnostic_messages(diagnose(read_mesh(file, unit)));
    return std::any_of(messages.begin(), messages.end(),
                       [](const std::string& line) { return line.find("an unlikely size") != std::string::npos; });
  };
  const std::string assets = SEAGLINT_SOURCE_DIR "/assets/",
                    moskva = SEAGLINT_SOURCE_DIR "/tests/reference/meshes/moskva.glb";
  EXPECT_TRUE(asks(kMeshes + "reflector_in_mm.stl", "m"));
  EXPECT_FALSE(asks(kMeshes + "reflector_in_mm.stl", "mm"));
  EXPECT_TRUE(asks(moskva, "m"));
  EXPECT_FALSE(asks(assets + "combatant_144m.glb", "m"));
  EXPECT_TRUE(asks(assets + "combatant_144m.glb", "km"));
  EXPECT_TRUE(asks(assets + "combatant_144m.glb", "cm"));
  EXPECT_FALSE(asks(assets + "icosahedral_reflector.glb", "m"));
  EXPECT_TRUE(asks(assets + "icosahedral_reflector.glb", "mm"));
}

TEST_F(FieldMesh, ThatIsCutOffOrBrokenIsRefusedWithItsLine) {
  EXPECT_EQ(refusal(kMeshes + "cut.stl"), "cut.stl:9: ends without endsolid: the file is cut off");
  EXPECT_EQ(
      refusal(kMeshes + "fractional_index.ply"),
      "fractional_index.ply:14: \"0.9\" where the header promises a whole number within -2147483648 and 2147483647");
  EXPECT_EQ(refusal(kMeshes + "fewer_promised.ply"), "fewer_promised.ply:14: more follows than the header promises");
  EXPECT_EQ(refusal(kMeshes + "values_beyond_types.ply"),
            "values_beyond_types.ply:10: \"0.5\" where the header promises a whole number within -2147483648 and "
            "2147483647");
  EXPECT_EQ(refusal(kMeshes + "plus_minus.obj"), "plus_minus.obj:1: \"+-1\" is not a coordinate");
  expect_error(put("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar x\nproperty float y\nproperty float "
                   "z\nend_header\n300 0 0\n"),
               ":8: \"300\" where the header promises a whole number within 0 and 255");
}

TEST_F(FieldMesh, ThatIsNoSuchFileIsNamedAsWhatItIs) {
  expect_error(put("a.obj", std::string("\xff\xfev\0 \0", 6)),
               "no .obj file: it is a text in UTF-16: save it as UTF-8");
  expect_error(put("a.stl", std::string("\xff\xfes\0o\0l\0i\0d\0", 12)), "UTF-16");
  expect_error(put("a.obj", "PK\x03\x04....."), "a zip archive");
}

std::string quoted_size(const TriangleMesh& mesh) {
  const Bounds box = bounds(mesh);
  const Vec3 size = box.upper - box.lower;
  return fmt::format("{} triangles, {:.4g} x {:.4g} x {:.4g} m, {:.4g} m^3", mesh.triangles.size(), size.x(), size.y(),
                     size.z(), enclosed_volume(mesh));
}

// A box of 3 x 1.2 x 0.8 m in each spelling.
const char* const kFloat = "12 triangles, 3 x 1.2 x 0.8 m, 2.88 m^3";

TEST_F(FieldMesh, OfTextIsReadWithEveryLineEndAByteOrderMarkAndKeywordsInTwoWords) {
  for (const char* name : {"end_solid.stl", "bom.stl", "cr_line_ends.stl"}) {
    const TriangleMesh mesh = read_mesh(kMeshes + name);
    EXPECT_EQ(quoted_size(mesh), kFloat) << name;
    EXPECT_EQ(mesh.part_names, std::vector<std::string>{"float"}) << name;
    EXPECT_THAT(mesh.findings, testing::IsEmpty()) << name;
  }
  const std::string text = "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  EXPECT_EQ(read_mesh(put("a.stl", text + "end loop\nEnd Facet\nEND SOLID a b\n")).triangles.size(), 1u);
  expect_error(put("a.stl", text + "end\nfacet\n"), "a.stl:8: \"endfacet\" where endloop belongs");

  // The same triangle in the other text formats; a line end \r is one also where others are \r\n or \n elsewhere.
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", mark = "\xef\xbb\xbf";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const auto old_mac = [](std::string lines) {
    std::replace(lines.begin(), lines.end(), '\n', '\r');
    return lines;
  };
  for (const auto& [name, written] : {std::pair{"a.obj", obj}, {"a.ply", ply}})
    for (const std::string& other : {written, mark + written, old_mac(written), mark + old_mac(written)})
      EXPECT_EQ(read_mesh(put(name, other)).triangles.size(), 1u) << name << ' ' << other;
  expect_error(put("a.obj", old_mac("v 0 0 0\nv x 0 0\n")), "a.obj:2: \"x\" is not a coordinate");

  // A binary PLY has lines in its header only, and \r and \n among its numbers.
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  const std::string numbers("\r\r\0\n\r\0\r\n\0\3\0\1\2", 13);
  EXPECT_EQ(read_mesh(put("a.ply", header + numbers)).vertices,
            read_mesh(put("a.ply", old_mac(header) + numbers)).vertices);
}

TEST_F(FieldMesh, OfBinaryStlIsReadWithAFindingOfTheBytesBehindIt) {
  const TriangleMesh mesh = read_mesh(kMeshes + "newline_behind.stl");
  EXPECT_EQ(quoted_size(mesh), kFloat);
  EXPECT_THAT(mesh.findings, testing::ElementsAre("1 byte is left over behind the last of 12 triangles: not read"));
  const std::string bytes = read_file(kMeshes + "newline_behind.stl"), file = bytes.substr(0, bytes.size() - 1);
  EXPECT_THAT(read_mesh(put("a.stl", file + std::string(512, '\0'))).findings,
              testing::ElementsAre("512 bytes are left over behind the last of 12 triangles: not read"));
  // The comment may begin with solid.
  EXPECT_EQ(quoted_size(read_mesh(put("a.stl", "solid" + bytes.substr(5)))), kFloat);
  // More triangles than promised, and a second file behind the first.
  expect_error(put("a.stl", file + std::string(50, '\0')),
               "12 triangles, which end at byte 684; 50 bytes are left over");
  expect_error(put("a.stl", file + bytes), "12 triangles, which end at byte 684; 685 bytes are left over");
}

TEST_F(FieldMesh, WithFacesOfTwoCornersIsReadAndCountsThem) {
  const TriangleMesh mesh = read_mesh(kMeshes + "face_of_two_corners.obj");
  EXPECT_EQ(quoted_size(mesh), kFloat);
  EXPECT_THAT(mesh.findings,
              testing::ElementsAre(HasSubstr("1 polygon has fewer than three corners: dropped (the first odd "
                                             "polygon: line ")));
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 3\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n1 2\n";
  const TriangleMesh other = read_mesh(put("a.ply", ply));
  EXPECT_EQ(other.triangles.size(), 1u);
  EXPECT_THAT(other.findings, testing::ElementsAre("2 polygons have fewer than three corners: dropped (the first odd "
                                                   "polygon: face 0)"));
  expect_error(put("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), "a.obj: contains no triangles");
  expect_error(put("a.obj", "v 0 0 0\nv 1 0 0\nf 1 7\n"), "a.obj:3: the face names vertex 7, there are 2");
}

TEST_F(FieldMesh, OfOptiStructIsReadAsBulkDataOfNastran) {
  const TriangleMesh mesh = read_mesh(kMeshes + "exchange/hypermesh.fem");
  EXPECT_EQ(quoted_size(mesh), kFloat);
  const std::string nodes = "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n";
  const TriangleMesh named = read_mesh(put("A.FEM",
                                           "$$ Optistruct Input Deck\nSUBCASE 1\nBEGIN BULK\n$$\n"
                                           "$HMNAME COMP                   7\"deck\" 7 \"steel\" 4\n"
                                           "$HWCOLOR COMP                  7       5\n" +
                                               nodes + "CQUAD4,1,7,1,2,3,4,,TOP\nENDDATA\n"));
  EXPECT_EQ(named.part_names, std::vector<std::string>{"deck"});
  EXPECT_THAT(named.findings, testing::ElementsAre(HasSubstr("1 shell with an offset from the nodes")));
}

TEST_F(FieldMesh, OfObjHasItsMaterialsAsPartsWhereItHasNoGroups) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const auto parts = [&](const std::string& faces) { return read_mesh(put("a.obj", corners + faces)).part_names; };
  using Names = std::vector<std::string>;
  EXPECT_EQ(parts("usemtl hull\nf 1 2 3\nusemtl glass of a\tbridge\nf 1 2 4\nusemtl hull\nf 2 3 4\n"),
            (Names{"hull", "glass of a bridge"}));
  EXPECT_EQ(parts("f 1 2 3\nusemtl glass\nf 1 2 4\n"), (Names{"body", "glass"}));
  EXPECT_EQ(parts("usemtl hull\nf 1 2 3\no mast\nf 1 2 4\n"), (Names{"body", "mast"}));
  EXPECT_EQ(parts("g deck\nusemtl hull\nf 1 2 3\nusemtl glass\nf 1 2 4\n"), (Names{"deck"}));
  const TriangleMesh mesh = read_mesh(put("a.obj", corners + "g deck\nusemtl hull\nf 1 2 3\nusemtl glass\nf 1 2 4\n"));
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.materials[1].name, "glass");
  EXPECT_EQ(mesh.triangle_material, (std::vector<std::uint16_t>{0, 1}));
}

}  // namespace
}  // namespace seaglint
