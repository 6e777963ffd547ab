// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_io.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/refusal.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

// OBJ and PLY hold doubles; glTF and binary STL are float32 by format.
bool keeps_doubles(const std::string& name) { return name.ends_with(".obj") || name.ends_with(".ply"); }

TEST_F(MeshFile, EveryFormatPreservesTheTriangles) {
  TriangleMesh mesh = make_icosahedral_reflector();
  mesh = transformed(mesh, axis_rotation(0.3, Vec3(1, 2, 3).normalized()), Vec3(2, -1, 5));
  for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.stl", "a.ply"}) {
    SCOPED_TRACE(name);
    write_mesh(folder / name, mesh);
    const TriangleMesh again = read_mesh(folder / name);
    ASSERT_EQ(again.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(again.vertices.size(), mesh.vertices.size());
    EXPECT_TRUE(topology_of(again).count(EdgeKind::kManifold) == topology_of(mesh).edges.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const Vec3 difference = again.vertices[again.triangles[t][i]] - mesh.vertices[mesh.triangles[t][i]];
        if (keeps_doubles(name)) {
          EXPECT_EQ(difference, Vec3::Zero());
        } else {
          EXPECT_LT(difference.cwiseAbs().maxCoeff(), 5.6 * kFloatRounding);  // the farthest coordinate is 5.5 m
        }
      }
    }
  }
}

// Each side of a mesh 1 km off its origin keeps its length to the rounding of the move, half a unit in the last place
// of 1 km per end and axis, and of the differences taken here, as much of 1 m; the files add none.
TEST_F(MeshFile, DoublesKeepTheShapeOfAMeshFarFromItsOrigin) {
  const TriangleMesh near = make_sphere(0.7, 2), far = transformed(near, Mat3::Identity(), Vec3(1000, -300, 20));
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double rounding = std::sqrt(3) * (2 * 0.5 * 512 * kEpsilon + 2 * 0.5 * kEpsilon);
  const auto expect_same_sides = [&](const TriangleMesh& again) {
    ASSERT_EQ(again.triangles.size(), near.triangles.size());
    ASSERT_EQ(again.vertices.size(), near.vertices.size());
    for (std::size_t t = 0; t < near.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const auto side = [&](const TriangleMesh& mesh) {
          return Vec3(mesh.vertices[mesh.triangles[t][(i + 1) % 3]] - mesh.vertices[mesh.triangles[t][i]]);
        };
        EXPECT_LT((side(again) - side(near)).norm(), rounding);
      }
    }
  };
  for (const char* name : {"a.obj", "a.ply"}) {
    SCOPED_TRACE(name);
    write_mesh(folder / name, far);
    expect_same_sides(read_mesh(folder / name));
  }
  std::string stl = "solid far\n";
  for (const auto& triangle : far.triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : triangle) {
      const Vec3& p = far.vertices[v];
      stl += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
    }
    stl += "endloop\nendfacet\n";
  }
  expect_same_sides(read_mesh(put("a.stl", stl + "endsolid\n")));
}

TEST_F(MeshFile, PartsAndMaterialsArePreservedWhereTheFormatHasThem) {
  TriangleMesh mesh = make_icosahedral_reflector();
  mesh.materials = {Material{"pec"}, Material{"canvas"}};
  mesh.triangle_material[4] = 1;
  write_mesh(folder / "a.glb", mesh);
  const TriangleMesh glb = read_mesh(folder / "a.glb");
  EXPECT_EQ(glb.part_names, mesh.part_names);
  EXPECT_EQ(std::count(glb.triangle_material.begin(), glb.triangle_material.end(), 1), 1);
  EXPECT_EQ(glb.materials[1].name, "canvas");
  write_mesh(folder / "a.obj", mesh);
  EXPECT_EQ(read_mesh(folder / "a.obj").part_names, mesh.part_names);
}

TEST_F(MeshFile, WritingIsReproducible) {
  const TriangleMesh mesh = make_sphere(1, 2);
  for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.stl", "a.ply"}) {
    write_mesh(folder / name, mesh);
    const std::string first = bytes_of(folder / name);
    write_mesh(folder / name, mesh);
    EXPECT_EQ(bytes_of(folder / name), first) << name;
  }
}

TEST_F(MeshFile, UnitsScaleLengths) {
  write_mesh(folder / "a.stl", make_plate(1, 1));
  const std::pair<const char*, double> units[] = {{"m", 1},     {"cm", 0.01},   {"mm", 0.001},
                                                  {"km", 1000}, {"in", 0.0254}, {"ft", 0.3048}};
  for (const auto& [unit, metres] : units)
    EXPECT_NEAR(surface_area(read_mesh(folder / "a.stl", unit)), metres * metres, 1e-12 * metres * metres) << unit;
  EXPECT_THROW(read_mesh(folder / "a.stl", "yard"), InputError);
}

TEST_F(MeshFile, NonManifoldSoupIsReadCompletely) {
  // Five sheets on one edge, then a flipped copy of the first: a half-edge mesh would accept two of them.
  std::string obj = "v 0 0 0\nv 0 0 1\n";
  for (int i = 0; i < 5; ++i) obj += "v " + std::to_string(std::cos(i)) + " " + std::to_string(std::sin(i)) + " 0.5\n";
  obj += "g fan\n";
  for (int i = 3; i <= 7; ++i) obj += "f 1 2 " + std::to_string(i) + "\n";
  obj += "g back\nf 2/1/1 1//2 3/4\n";
  const TriangleMesh mesh = read_mesh(put("soup.obj", obj));
  EXPECT_EQ(mesh.triangles.size(), 6u);
  EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"fan", "back"}));
  EXPECT_EQ(topology_of(mesh).count(EdgeKind::kNonManifold), 1u);
  for (const char* name : {"again.stl", "again.ply", "again.obj", "again.glb"}) {
    write_mesh(folder / name, mesh);
    EXPECT_EQ(read_mesh(folder / name).triangles.size(), 6u) << name;
  }
}

TEST_F(MeshFile, ObjReadsPolygonsRelativeIndicesAndContinuedLines) {
  const TriangleMesh mesh = read_mesh(put("a.obj",
                                          "# a comment\nmtllib /etc/passwd\no box lid\nv 0 0 0 1\nv +1.0e0 0 0\r\nv 1 "
                                          "1 0\nv 0 1 0\nvn 0 0 1\nusemtl steel\n"
                                          "f -4 -3 \\\n-2 -1 # the lid\nf 1 2 2\n"));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(surface_area(mesh), 1.0, 1e-15);
  EXPECT_EQ(mesh.part_names, std::vector<std::string>{"box lid"});
}

TEST_F(MeshFile, ConcavePolygonsAreCoveredOnce) {
  // An L of area 3, from a vertex whose fan would lie partly outside; its vertices follow the face.
  const std::string corners = "1 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 0\n";
  std::string obj = "f 2 3 4 5 6 7 1\n";
  std::istringstream lines(corners);
  for (std::string line; std::getline(lines, line);) obj += "v " + line + "\n";
  EXPECT_NEAR(surface_area(read_mesh(put("a.obj", obj))), 3.0, 1e-12);
  const std::string header = "property float x\nproperty float y\nproperty float z\n";
  const auto ply = [&](const std::string& face) {
    return put("a.ply",
               "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 7\n" +
                   header + "end_header\n" + face + corners);
  };
  EXPECT_NEAR(surface_area(read_mesh(ply("7 1 2 3 4 5 6 0\n"))), 3.0, 1e-12);
}

// A comment that ends in a backslash, as folders of Windows do, ends with its line; so does one after numbers.
TEST_F(MeshFile, ObjCommentsEndWithTheirLine) {
  const std::string corners = "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 3 0\n";
  for (const std::string& text :
       {"# made from C:\\models\\\n" + corners + "f 1 2 3\n", "  #\\\r\n" + corners + "f 1 2 3\n",
        corners + "f 1 2 2 # C:\\\n# C:\\\nf 1 2 3\n", "v 0 0 0 # C:\\\n" + corners.substr(8) + "f 1 2 3\n"})
    EXPECT_NEAR(surface_area(read_mesh(put("a.obj", text))), 1.0, 1e-15) << text;
  expect_error(put("a.obj", "v 0 0 0 \\\n" + corners.substr(8) + "f 1 2 3\n"),
               "4 lines begin with v, 3 of them are vertices");
}

// tests/bench/mesh_bench.cpp measures the run time.
TEST_F(MeshFile, SixtyThousandPartsAreReadAndWritten) {
  constexpr int kParts = 60000;
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  for (const char* face : {"f 1 2 3\n", "f 1 2 4\n"})
    for (int i = 0; i < kParts; ++i) obj += fmt::format("g part_number_{}\n{}", i, face);
  const TriangleMesh mesh = read_mesh(put("a.obj", obj));
  write_mesh(folder / "a.glb", mesh);
  EXPECT_EQ(mesh.part_names.size(), std::size_t{kParts});
  EXPECT_EQ(mesh.triangle_part.back(), kParts - 1);
  EXPECT_EQ(read_mesh(folder / "a.glb").part_names, mesh.part_names);
}

TEST_F(MeshFile, NamesThatAreNotUtf8AreLatin1) {
  const std::string corners = "v 0 0 0\nv 2 0 0\nv 0 1 0\n";
  for (const auto& [written, read] : {std::pair<std::string, std::string>{"Br\xFC"
                                                                          "cke",
                                                                          "Br\xC3\xBC"
                                                                          "cke"},
                                      {"Br\xC3\xBC"
                                       "cke",
                                       "Br\xC3\xBC"
                                       "cke"},
                                      {"\xE6\xA9\x8B \xF0\x9F\x9A\xA2", "\xE6\xA9\x8B \xF0\x9F\x9A\xA2"},
                                      {"cut \xC3", "cut \xC3\x83"},
                                      {"\xED\xA0\x80", "\xC3\xAD\xC2\xA0\xC2\x80"},
                                      {"\xC0\x80", "\xC3\x80\xC2\x80"}}) {
    const TriangleMesh mesh = read_mesh(put("a.obj", corners + fmt::format("g {}\nf 1 2 3\n", written)));
    EXPECT_EQ(mesh.part_names, std::vector<std::string>{read});
    write_mesh(folder / "a.glb", mesh);
    EXPECT_EQ(read_mesh(folder / "a.glb").part_names, mesh.part_names);
  }
}

TEST_F(MeshFile, ObjMayBeginWithAByteOrderMark) {
  EXPECT_NEAR(surface_area(read_mesh(put("a.obj", "\xEF\xBB\xBFv 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 3 0\nf 1 2 3\n"))), 1.0,
              1e-15);
}

TEST_F(MeshFile, BrokenObjIsRefusedWithItsLine) {
  expect_error(put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), ":4: the face names vertex 4");
  expect_error(put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n"), ":4: the face names vertex -4");
  expect_error(put("a.obj", "v 0 0 nan\n"), ":1: \"nan\"");
  expect_error(put("a.obj", "v 0 0\n"), ":1:");
  expect_error(put("a.obj", "v 1e39 0 0\n"), ":1:");
  expect_error(put("a.obj", "v 0 0 0\nf 1 x 1\n"), ":2:");
  expect_error(put("a.obj", "v 0 0 0\nf 1 1\n"), "contains no triangles");
  expect_error(put("a.obj", "v +-1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), ":1: \"+-1\"");
  expect_error(put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/xyz 2 3\n"), ":4: \"1/xyz\"");
  expect_error(put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 +-3\n"), ":4: \"+-3\"");
  expect_error(put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2.5\n"), ":4: \"2.5\"");
  expect_error(put("a.obj", "hello\n"), "no triangles");
  expect_error(put("a.obj", ""), "empty");
}

TEST_F(MeshFile, AsciiStlIsReadWithItsSolids) {
  const std::string facet =
      "facet normal 0 0 nan\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\nendfacet\n";
  const TriangleMesh mesh =
      read_mesh(put("a.stl", "solid hull\n" + facet + "endsolid hull\nsolid mast 2\n" + facet + "endsolid\n"));
  EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"hull", "mast 2"}));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  expect_error(put("a.stl", "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 inf"), ":2: \"inf\"");
  expect_error(put("a.stl", "solid a\nfacet normal 0 0 1 outer loop vertex 0 0"), "not a coordinate");
  expect_error(put("a.stl", "solid a\nendsolid a\n"), "no triangles");
}

TEST_F(MeshFile, StlWithFewerTrianglesThanDeclaredIsRefused) {
  write_mesh(folder / "a.stl", make_plate(1, 1));
  std::string bytes = bytes_of(folder / "a.stl");
  ASSERT_EQ(bytes.size(), 84u + 2 * 50);
  bytes[83] = 0x7f;
  expect_error(put("b.stl", bytes), "contains 2");
  expect_error(put("b.stl", bytes.substr(0, 40)), "84");
}

TEST_F(MeshFile, StlWithANanIsRefused) {
  write_mesh(folder / "a.stl", make_plate(1, 1));
  std::string bytes = bytes_of(folder / "a.stl");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  bytes.replace(84 + 12, 4, reinterpret_cast<const char*>(&nan), 4);
  expect_error(put("b.stl", bytes), "coordinate nan");
}

TEST_F(MeshFile, PlyIsReadInAllItsDialects) {
  const std::string ascii =
      "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty float y\nproperty "
      "float z\n"
      "property uchar red\nelement face 1\nproperty int flags\nproperty list int short vertex_index\nelement edge "
      "1\nproperty int a\nend_header\n"
      "0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0 255\n7 4 0 1 2 3\n12\n";
  EXPECT_NEAR(surface_area(read_mesh(put("a.ply", ascii))), 1.0, 1e-15);

  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list ushort int vertex_indices\nend_header\n";
  for (double value : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0}) {
    const auto* raw = reinterpret_cast<const char*>(&value);
    for (int i = 7; i >= 0; --i) big += raw[i];
  }
  big += std::string("\0\3\0\0\0\0\0\0\0\1\0\0\0\2", 14);
  EXPECT_NEAR(surface_area(read_mesh(put("b.ply", big))), 1.0, 1e-15);
}

TEST_F(MeshFile, BrokenPlyIsRefused) {
  const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
  const std::string face = "property list uchar int vertex_indices\n";
  const auto ply = [&](const std::string& header, const std::string& body) {
    return put("a.ply", "ply\nformat ascii 1.0\n" + header + "end_header\n" + body);
  };
  expect_error(ply("element vertex 100000000\n" + vertex, "0 0 0\n"), "promises 100000000");
  expect_error(ply("element vertex 1\n" + vertex + "element face 4000000000\n" + face, "0 0 0\n"),
               "promises 4000000000");
  expect_error(ply("element vertex 99999999999999999999\n" + vertex, ""), "promises");
  expect_error(ply("element vertex 3\n" + vertex + "element face 1\n" + face, "0 0 0 1 0 0 0 1 0 3 0 1 3"),
               "names vertex 3");
  expect_error(ply("element vertex 3\n" + vertex + "element face 1\n" + face, "0 0 0 1 0 0 0 1 0 3 0 1 -1"),
               "names vertex -1");
  expect_error(ply("element vertex 3\n" + vertex + "element face 1\n" + face, "0 0 0 1 0 0 0 1 0 200 0 1 2"),
               "list of 200");
  expect_error(ply("element vertex 3\n" + vertex + "element face 1\n" + face, "0 0 nan 1 0 0 0 1 0 3 0 1 2"),
               "coordinate nan");
  expect_error(ply("element vertex 1\nproperty float x\n", "0\n"), "must have x, y and z once each");
  expect_error(ply("element vertex 3\nproperty float x\nproperty float x\nproperty float y\nelement face 1\n" + face,
                   "0 0 0 1 0 0 0 1 0 3 0 1 2"),
               "must have x, y and z once each");
  // Faces without properties occupy no bytes; a count of 1e18 of them must not be iterated over.
  for (const char* properties : {"", "property uchar flags\n", "property list uchar int texcoord\n"}) {
    expect_error(ply("element vertex 1\n" + vertex + "element face " +
                         (*properties == 0 ? "1000000000000000000" : "1") + "\n" + properties,
                     "0 0 0\n0\n"),
                 "its faces have no vertex_indices");
  }
  expect_error(ply("element vertex 3\n" + vertex, "0 0 0 1 0 0 0 1 0"), "no triangles");
  expect_error(put("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), "no end_header");
  expect_error(put("a.ply", "ply\nformat binary_middle_endian 1.0\nend_header\n"), "binary_middle_endian");
  expect_error(put("a.ply", "plyx"), "not a PLY");
}

TEST_F(MeshFile, WrongNamesAndPlacesAreRefused) {
  expect_error(folder / "absent.glb", "");
  expect_error(put("a.step", "x"), ".step");
  expect_error(put("a.glb", "glTF"), "cut short");
  EXPECT_THROW(write_mesh(folder / "a.step", make_plate(1, 1)), InputError);
  EXPECT_THROW(write_mesh(folder / "a.glb", TriangleMesh{}), InputError);
  EXPECT_THROW(write_mesh(folder / "no" / "folder.glb", make_plate(1, 1)), WorkError);
  write_mesh(folder / "a.obj", make_plate(1, 1));
  EXPECT_THROW(read_mesh(put("far.obj", "v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n")), InputError);
}

// Mesh files with a valid encoding and invalid contents.

class MeshErrors : public MeshFile {
 protected:
  std::string refusal(const std::string& name, const std::string& content) const {
    return MeshFile::refusal(put(name, content));
  }
};

// The first `count` of four vertices, as a sheet of this mode placed by this node.
std::string gltf_of(int count, const std::string& mode, const std::string& node, const std::string& asset = "") {
  return R"({"asset":{"version":"2.0")" + asset + R"(},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node +
         R"(}],"meshes":[{"primitives":[{"mode":)" + mode +
         R"(,"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
         std::to_string(count) +
         R"(,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":48}],"buffers":[{"byteLength":48,)"
         R"("uri":"data:application/octet-stream;base64,AAAAvwAAAL8AAAAAAAAAPwAAAL8AAAAAAAAAPwAAAD8AAAAAAAAAvwAAAD8AAAAA"}]})";
}

TEST_F(MeshErrors, OfVerticesThatFormNoWholeTriangles) {
  EXPECT_EQ(refusal("a.gltf", gltf_of(3, "4", "")), "accepted");
  EXPECT_EQ(refusal("a.gltf", gltf_of(4, "5", "")), "accepted");
  EXPECT_HAS(refusal("a.gltf", gltf_of(4, "4", "")),
             "a.gltf: meshes[0].primitives[0]: 4 vertices without indices are no whole number of triangles");
  EXPECT_HAS(refusal("a.gltf", gltf_of(2, "6", "")), "2 vertices without indices make no triangle");
  write_mesh(folder / "plate.gltf", make_plate(1, 1));
  std::string indexed = bytes_of(folder / "plate.gltf");
  const std::size_t six = indexed.find("\"count\":6");
  ASSERT_NE(six, std::string::npos) << indexed;
  EXPECT_HAS(refusal("a.gltf", indexed.replace(six, 9, "\"count\":5")), "5 indices are no whole number of triangles");
}

TEST_F(MeshErrors, OfSingularTransforms) {
  const auto with = [&](const std::string& node) { return refusal("a.gltf", gltf_of(3, "4", node)); };
  EXPECT_EQ(with(R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1])"), "accepted");
  EXPECT_HAS(with(R"(,"matrix":[1,0,0,0.5, 0,1,0,0, 0,0,1,0, 0,0,0,1])"),
             "nodes[0].matrix has 0.5 in its last row, which must be 0 0 0 1");
  EXPECT_HAS(with(R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2])"), "nodes[0].matrix has 2 in its last row");
  EXPECT_HAS(with(R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],"scale":[2,2,2])"),
             "nodes[0] has a matrix and a scale");
  EXPECT_HAS(with(R"(,"rotation":[0,0,0,0])"), "nodes[0].rotation is zero");
  EXPECT_EQ(with(R"(,"rotation":[0,0,0,1],"scale":[2,2,2])"), "accepted");
}

TEST_F(MeshErrors, OfAFileForALaterGltf) {
  EXPECT_EQ(refusal("a.gltf", gltf_of(3, "4", "", R"(,"minVersion":"2.0")")), "accepted");
  EXPECT_HAS(refusal("a.gltf", gltf_of(3, "4", "", R"(,"minVersion":"3.0")")),
             "a.gltf: needs more than glTF 2 (asset.minVersion)");
}

// Two solids in one file, or a count that is smaller than the contents.
TEST_F(MeshErrors, OfBinaryStlWithMoreTrianglesThanDeclared) {
  write_mesh(folder / "plate.stl", make_plate(1, 1));
  std::string bytes = bytes_of(folder / "plate.stl");
  EXPECT_HAS(refusal("a.stl", bytes + bytes),
             "a.stl: promises 2 triangles, which end at byte 184; 184 bytes are left over");
  bytes[80] = 1;
  EXPECT_HAS(refusal("a.stl", bytes), "promises 1 triangles, which end at byte 134; 50 bytes are left over");
}

TEST_F(MeshErrors, OfSizesThatNoFormatPreserves) {
  for (const double size : {1e-308, 9e-21, 1.01e7, 1e38, 1e308}) {
    EXPECT_THROW(make_plate(size, 1), InputError) << size;
    EXPECT_THROW(make_sphere(size, 1), InputError) << size;
  }
  for (const double size : {kMinSize, kLargestSize}) {
    for (const char* name : {"a.obj", "a.stl", "a.ply", "a.glb"}) {
      for (const TriangleMesh& mesh : {make_plate(size, size), make_sphere(size, 2), make_cylinder(size, size, 64)}) {
        write_mesh(folder / name, mesh);
        // float32 rounds each coordinate by 6e-8 of itself; an area has two of them, a dozen of such errors in all.
        EXPECT_NEAR(surface_area(read_mesh(folder / name)) / surface_area(mesh), 1, 1e-6) << name << ' ' << size;
      }
    }
  }
  // A mesh that cannot be read back is not written either.
  TriangleMesh far = make_plate(1, 1);
  far.vertices[0].x() = 1e9;
  EXPECT_THROW(write_mesh(folder / "far.obj", far), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "far.obj"));
}

// Damaged files of all formats: each is read as some mesh or refused with an InputError that names it, without any
// other effect.

class MeshFuzzing : public MeshFile, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    const fs::path valid = folder / ("sound" + std::string(GetParam()));
    write_mesh(valid, make_icosahedral_reflector());
    bytes = bytes_of(valid);
  }

  // True when the file was refused.
  bool refused(const std::string& content) const {
    const fs::path path = put("damaged" + std::string(GetParam()), content);
    const std::string message = refusal_of([&] {
      const TriangleMesh mesh = read_mesh(path);
      for (const auto& triangle : mesh.triangles)
        for (std::uint32_t v : triangle) EXPECT_TRUE(v < mesh.vertices.size() && mesh.vertices[v].allFinite());
    });
    EXPECT_THAT(message, testing::AnyOf("accepted", testing::StartsWith(path.string())));
    return message != "accepted";
  }

  std::string bytes;
};

TEST_P(MeshFuzzing, CutShortAnywhereIsNeverACrash) {
  int refusals = 0;
  for (std::size_t i = 0; i < 50; ++i) refusals += refused(bytes.substr(0, bytes.size() * i / 50));
  // Text formats without counts may be valid when truncated; the others always report it.
  const std::string format = GetParam();
  EXPECT_GE(refusals, format == ".obj" ? 1 : 50);
}

TEST_P(MeshFuzzing, ChangedBytesAreNeverACrash) {
  Random random({.seed = 1, .stream = Stream::kTest, .index = 0});
  int refusals = 0;
  for (int i = 0; i < 400; ++i) {
    std::string changed = bytes;
    const std::uint32_t count = 1 + random.below(4);
    // Half of the changes are in the first 2 kB, which contain the header.
    const auto span =
        static_cast<std::uint32_t>(i % 2 == 0 ? changed.size() : std::min<std::size_t>(changed.size(), 2048));
    for (std::uint32_t k = 0; k < count; ++k) changed[random.below(span)] = static_cast<char>(random.below(256));
    refusals += refused(changed);
  }
  EXPECT_GT(refusals, 0);
}

TEST_P(MeshFuzzing, ChangedDigitsAreNeverACrash) {
  Random random({.seed = 2, .stream = Stream::kTest, .index = 0});
  for (int i = 0; i < 200; ++i) {
    std::string changed = bytes;
    const auto span = static_cast<std::uint32_t>(std::min<std::size_t>(changed.size(), 4096));
    for (int tries = 0; tries < 200; ++tries) {
      char& c = changed[random.below(span)];
      if (c < '0' || c > '9') continue;
      c = static_cast<char>('0' + random.below(10));
      break;
    }
    refused(changed);
  }
}

TEST_P(MeshFuzzing, NoiseIsRefused) {
  Random random({.seed = 3, .stream = Stream::kTest, .index = 0});
  for (std::uint32_t size : {1u, 10u, 84u, 200u, 5000u}) {
    std::string noise(size, '\0');
    for (char& c : noise) c = static_cast<char>(random.below(256));
    EXPECT_TRUE(refused(noise)) << size;
    // A valid header followed by noise.
    EXPECT_TRUE(refused(bytes.substr(0, 30) + noise)) << size;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFuzzing, testing::Values(".glb", ".gltf", ".obj", ".stl", ".ply"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

}  // namespace
}  // namespace seaglint
