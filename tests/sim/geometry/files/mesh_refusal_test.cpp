// SPDX-License-Identifier: BSD-3-Clause
// Mesh files with a valid encoding and invalid contents.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

class MeshErrors : public testing::Test {
 protected:
  std::string refusal(const std::string& name, const std::string& content) const {
    write_file(folder_.path() / name, content);
    try {
      read_mesh(folder_.path() / name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
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
  EXPECT_EQ(refusal("a.gltf", gltf_of(3, "4", "")), "");
  EXPECT_EQ(refusal("a.gltf", gltf_of(4, "5", "")), "");
  EXPECT_THAT(
      refusal("a.gltf", gltf_of(4, "4", "")),
      HasSubstr("a.gltf: meshes[0].primitives[0]: 4 vertices without indices are no whole number of triangles"));
  EXPECT_THAT(refusal("a.gltf", gltf_of(2, "6", "")), HasSubstr("2 vertices without indices make no triangle"));
  write_mesh(folder_.path() / "plate.gltf", make_plate(1, 1));
  std::string indexed = read_file(folder_.path() / "plate.gltf");
  const std::size_t six = indexed.find("\"count\":6");
  ASSERT_NE(six, std::string::npos) << indexed;
  EXPECT_THAT(refusal("a.gltf", indexed.replace(six, 9, "\"count\":5")),
              HasSubstr("5 indices are no whole number of triangles"));
}

TEST_F(MeshErrors, OfSingularTransforms) {
  const auto with = [&](const std::string& node) { return refusal("a.gltf", gltf_of(3, "4", node)); };
  EXPECT_EQ(with(R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1])"), "");
  EXPECT_THAT(with(R"(,"matrix":[1,0,0,0.5, 0,1,0,0, 0,0,1,0, 0,0,0,1])"),
              HasSubstr("nodes[0].matrix has 0.5 in its last row, which must be 0 0 0 1"));
  EXPECT_THAT(with(R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,2])"),
              HasSubstr("nodes[0].matrix has 2 in its last row"));
  EXPECT_THAT(with(R"(,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],"scale":[2,2,2])"),
              HasSubstr("nodes[0] has a matrix and a scale"));
  EXPECT_THAT(with(R"(,"rotation":[0,0,0,0])"), HasSubstr("nodes[0].rotation is zero"));
  EXPECT_EQ(with(R"(,"rotation":[0,0,0,1],"scale":[2,2,2])"), "");
}

TEST_F(MeshErrors, OfAFileForALaterGltf) {
  EXPECT_EQ(refusal("a.gltf", gltf_of(3, "4", "", R"(,"minVersion":"2.0")")), "");
  EXPECT_THAT(refusal("a.gltf", gltf_of(3, "4", "", R"(,"minVersion":"3.0")")),
              HasSubstr("a.gltf: needs more than glTF 2 (asset.minVersion)"));
}

// Two solids in one file, or a count that is smaller than the contents.
TEST_F(MeshErrors, OfBinaryStlWithMoreTrianglesThanDeclared) {
  write_mesh(folder_.path() / "plate.stl", make_plate(1, 1));
  std::string bytes = read_file(folder_.path() / "plate.stl");
  EXPECT_THAT(refusal("a.stl", bytes + bytes),
              HasSubstr("a.stl: promises 2 triangles, which end at byte 184; 184 bytes are left over"));
  bytes[80] = 1;
  EXPECT_THAT(refusal("a.stl", bytes),
              HasSubstr("promises 1 triangles, which end at byte 134; 50 bytes are left over"));
}

TEST_F(MeshErrors, OfSizesThatNoFormatPreserves) {
  for (const double size : {1e-308, 9e-21, 1.01e7, 1e38, 1e308}) {
    EXPECT_THROW(make_plate(size, 1), InputError) << size;
    EXPECT_THROW(make_sphere(size, 1), InputError) << size;
  }
  for (const double size : {kMinSize, kLargestSize}) {
    for (const char* name : {"a.obj", "a.stl", "a.ply", "a.glb"}) {
      for (const TriangleMesh& mesh : {make_plate(size, size), make_sphere(size, 2), make_cylinder(size, size, 64)}) {
        write_mesh(folder_.path() / name, mesh);
        // float32 rounds each coordinate by 6e-8 of itself; an area has two of them, a dozen of such errors in all.
        EXPECT_NEAR(surface_area(read_mesh(folder_.path() / name)) / surface_area(mesh), 1, 1e-6)
            << name << ' ' << size;
      }
    }
  }
  // A mesh that cannot be read back is not written either.
  TriangleMesh far = make_plate(1, 1);
  far.vertices[0].x() = 1e9;
  EXPECT_THROW(write_mesh(folder_.path() / "far.obj", far), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "far.obj"));
}

}  // namespace
}  // namespace seaglint
