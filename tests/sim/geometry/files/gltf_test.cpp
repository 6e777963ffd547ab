// SPDX-License-Identifier: BSD-3-Clause
// glTF files: axes, transforms, buffers, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sim/core/process/error.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using GltfFile = MeshFile;

// A triangle (0,0,0) (1,0,0) (0,1,0) in glTF's axes, with a JSON around it.
std::string gltf_with(const std::string& nodes, const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"name":"sheet","primitives":[{"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,)"
         R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])" +
         more + "}";
}

TEST_F(GltfFile, ForwardIsTheBowAndUpIsUp) {
  // glTF's +Z is forward, +X to port, +Y up.
  const TriangleMesh mesh = read_mesh(put("a.gltf", gltf_with(R"([{"mesh":0,"translation":[0,0,5]}])")));
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], Vec3(5, 0, 0));
  EXPECT_EQ(mesh.vertices[1], Vec3(5, 1, 0));
  EXPECT_EQ(mesh.vertices[2], Vec3(5, 0, 1));
  EXPECT_GT(area_vector(mesh, 0).x(), 0);
  EXPECT_EQ(mesh.part_names, std::vector<std::string>{"sheet"});
}

TEST_F(GltfFile, NodesPlaceMeshesByTheProductOfTheirTransforms) {
  // The parent rotates by 90 deg about glTF's y and doubles, the child translates first; the second child is mirrored,
  // so that its vertices swap.
  const TriangleMesh mesh = read_mesh(
      put("a.gltf",
          gltf_with(
              R"([{"children":[1,2],"rotation":[0,0.7071067811865476,0,0.7071067811865476],"scale":[2,2,2]},)"
              R"({"name":"shifted","mesh":0,"translation":[1,0,0]},{"name":"mirrored","mesh":0,"scale":[1,1,-1]}])")));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.part_names, (std::vector<std::string>{"shifted", "mirrored"}));
  // glTF (1,0,0) -> scaled (2,0,0) -> rotated (0,0,-2) -> body x = -2.
  EXPECT_LT((mesh.vertices[mesh.triangles[0][0]] - Vec3(-2, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(area_vector(mesh, 0).norm(), 2.0, 1e-12);
  EXPECT_LT((area_vector(mesh, 0) + area_vector(mesh, 1)).norm(), 1e-12);
}

TEST_F(GltfFile, MayHaveItsBufferInAFileNextToIt) {
  std::string json = gltf_with(R"([{"mesh":0}])");
  const std::string data("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0", 36);
  put("triangle.bin", data);
  const std::size_t from = json.find("data:"), to = json.find('"', from);
  EXPECT_EQ(read_mesh(put("a.gltf", std::string(json).replace(from, to - from, "triangle.bin"))).triangles.size(), 1u);
  std::filesystem::create_directory(folder / "inner");
  expect_error(put("inner/a.gltf", std::string(json).replace(from, to - from, "../triangle.bin")), "triangle.bin");
  expect_error(put("inner/a.gltf", std::string(json).replace(from, to - from, "%2e%2e/triangle.bin")), "triangle.bin");
  expect_error(put("inner/a.gltf", std::string(json).replace(from, to - from, (folder / "triangle.bin").string())),
               "triangle.bin");
  expect_error(put("a.gltf", std::string(json).replace(from, to - from, "missing.bin")), "missing.bin");
  std::filesystem::create_symlink(folder / "triangle.bin", folder / "inner" / "link.bin");
  expect_error(put("inner/a.gltf", std::string(json).replace(from, to - from, "link.bin")), "link.bin");
}

TEST_F(GltfFile, ThatLacksItsDeclaredContentsIsRefused) {
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string json = gltf_with(R"([{"mesh":0}])");
    const std::size_t at = json.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return put("a.gltf", json.replace(at, from.size(), to));
  };
  expect_error(changed("\"count\":3", "\"count\":4"), "accessors[0]");
  expect_error(changed("\"count\":3", "\"count\":1000000000000"), "accessors[0]");
  expect_error(changed("\"count\":3", "\"count\":-3"), "accessors[0].count");
  expect_error(changed("\"count\":3", "\"count\":3,\"sparse\":{\"count\":1}"), "sparse");
  expect_error(changed("\"bufferView\":0,", ""), "has no data");
  expect_error(changed("\"buffer\":0,\"byteLength\":36", "\"buffer\":0,\"byteLength\":360"), "bufferViews[0]");
  expect_error(changed("\"buffer\":0", "\"buffer\":7"), "bufferViews[0].buffer");
  expect_error(changed("[{\"byteLength\":36", "[{\"byteLength\":800000000"), "buffers[0]");
  expect_error(changed("[{\"byteLength\":36", "[{\"byteLength\":18446744073709551615"), "buffers[0]");
  expect_error(changed("\"POSITION\":0", "\"POSITION\":1"), "POSITION");
  expect_error(changed("5126", "5123"), "POSITION");
  expect_error(changed("\"mesh\":0", "\"mesh\":1"), "nodes[0].mesh");
  expect_error(changed("\"mesh\":0", "\"mesh\":0,\"children\":[0]"), "two parents");
  expect_error(changed("\"mesh\":0", "\"mesh\":0,\"scale\":[1,2]"), "nodes[0].scale");
  expect_error(changed("\"version\":\"2.0\"", "\"version\":\"1.0\""), "glTF 2");
  expect_error(changed("\"asset\"", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"asset\""), "KHR_draco");
  expect_error(changed("AAAA", "AADAfwAA").string(), "a.gltf");
  expect_error(put("a.gltf", "[1, 2"), "a.gltf: no valid JSON from byte 6 on");
  expect_error(put("a.gltf", std::string(100000, '[')), "deep");
  expect_error(put("a.gltf", R"({"asset":{"version":"2.0"}})"), "no triangles");
}

// Extensions that move or deform vertices are not supported, and must be reported.
TEST_F(GltfFile, WithAnUnsupportedTransformIsRefused) {
  expect_error(put("a.gltf", gltf_with(R"([{"mesh":0,"skin":0}])")), "nodes[0] has a skin");
  expect_error(
      put("a.gltf",
          gltf_with(R"([{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}])")),
      "EXT_mesh_gpu_instancing");
  EXPECT_EQ(read_mesh(put("a.gltf", gltf_with(R"([{"mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}}}])")))
                .triangles.size(),
            1u);
}

// Shape keys of Blender. The weights of a node replace those of its mesh, and are 0 by default.
TEST_F(GltfFile, WithMorphTargetsIsReadInItsBaseShapeWhereAllWeightsAre0) {
  const auto with = [&](const std::string& mesh_weights, const std::string& node_weights) {
    std::string json = gltf_with(R"([{"mesh":0)" + node_weights + "}]");
    json.insert(json.find("\"attributes\""), R"("targets":[{"POSITION":0},{"POSITION":0}],)");
    return put("a.gltf", json.insert(json.find("\"primitives\""), mesh_weights));
  };
  for (const auto& [mesh, node] : {std::pair{"", ""},
                                   {R"("weights":[0,0],)", ""},
                                   {R"("weights":[0.0,-0.0],)", ""},
                                   {R"("weights":[0,1],)", R"(,"weights":[0,0])"}}) {
    const TriangleMesh read = read_mesh(with(mesh, node));
    EXPECT_EQ(read.vertices, read_mesh(put("base.gltf", gltf_with(R"([{"mesh":0}])"))).vertices);
    EXPECT_EQ(read.findings,
              std::vector<std::string>{"1 mesh has morph targets (shape keys) of weight 0: read in the base shape"});
  }
  const char* const refused = "nodes[0]: meshes[0] has morph targets with weights other than 0";
  expect_error(with(R"("weights":[0,0.5],)", ""), refused);
  expect_error(with(R"("weights":[0,0],)", R"(,"weights":[1e-3,0])"), refused);
  expect_error(with(R"("weights":["a",0],)", ""), refused);
  const TriangleMesh blender = read_mesh(SEAGLINT_SOURCE_DIR "/tests/cases/meshes/shape_key_at_rest.gltf");
  EXPECT_EQ(blender.triangles.size(), 12u);
  EXPECT_NEAR(enclosed_volume(blender), 3 * 1.2 * 0.8, 1e-6);
}

// RFC 2397: data:[type][;attribute=value ...];base64,DIGITS. A message has none of the digits.
TEST_F(GltfFile, MayHaveItsBufferInADataUriWithParametersOrWithoutType) {
  const std::string json = gltf_with(R"([{"mesh":0}])");
  const std::size_t from = json.find("data:"), comma = json.find(',', from), to = json.find('"', from);
  const std::string digits = json.substr(comma + 1, to - comma - 1);
  const auto with = [&](const std::string& head, const std::string& data) {
    return put("a.gltf", std::string(json).replace(from, to - from, head + "," + data));
  };
  const std::vector<Vec3> vertices = read_mesh(put("plain.gltf", json)).vertices;
  for (const char* head :
       {"data:application/octet-stream;charset=utf-8;base64", "data:;base64", "DATA:;charset=x;BASE64",
        "data:application/gltf-buffer;a=b;c=d;base64", "data:model/vnd.something;base64"})
    EXPECT_EQ(read_mesh(with(head, digits)).vertices, vertices) << head;
  EXPECT_EQ(read_mesh(with("data:;base64", digits.substr(0, 8) + "\\n " + digits.substr(8))).vertices, vertices);

  const auto refusal = [&](const std::string& head, const std::string& data) {
    try {
      read_mesh(with(head, data));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto expect_short = [&](const std::string& message, const char* what) {
    EXPECT_NE(message.find(what), std::string::npos) << message;
    EXPECT_EQ(message.find("AAAA"), std::string::npos) << message;
  };
  expect_short(refusal("data:text/plain", digits), "buffers[0].uri is a data URI other than base64");
  expect_short(refusal("data:;base64", digits.substr(4)), "buffers[0].byteLength = 36 but its data URI has 33 bytes");
  expect_short(refusal("data:;base64", "AAAA" + digits), "buffers[0].byteLength = 36 but its data URI has 39 bytes");
  expect_short(refusal("data:;base64", "AAAA?" + digits.substr(5)), "buffers[0].uri: digit 5 of its base64 is none");
  expect_short(refusal(" data:;base64", digits), "File not found");
  EXPECT_EQ(read_mesh(SEAGLINT_SOURCE_DIR "/tests/cases/meshes/data_uri_with_charset.gltf").triangles.size(), 12u);
}

TEST_F(GltfFile, IndicesBeyondTheirVerticesAreRefused) {
  const TriangleMesh mesh = make_plate(1, 1);
  write_mesh(folder / "a.glb", mesh);
  std::string bytes = bytes_of(folder / "a.glb");
  // The last bytes are six indices of 16 bits.
  bytes[bytes.size() - 2] = 9;
  expect_error(put("b.glb", bytes), "vertex 9, there are 4");
}

TEST_F(GltfFile, OfTooManyPartsIsRefused) {
  std::string nodes = R"([{"children":[1)", rest;
  for (int i = 2; i <= 65001; ++i) nodes += fmt::format(",{}", i);
  for (int i = 1; i <= 65001; ++i) rest += fmt::format(R"(,{{"mesh":0,"name":"n{}"}})", i);
  expect_error(put("a.gltf", gltf_with(nodes + "]}" + rest + "]")), "its nodes make more than 65000 parts");
}

}  // namespace
}  // namespace seaglint
