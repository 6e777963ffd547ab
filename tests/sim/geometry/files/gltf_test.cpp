// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "sim/geometry/mesh/topology.h"
#include "sim/geometry/placement/waterline.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/geometry/surface/facets.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using GltfFile = MeshFile;

// glTF files: axes, transforms, buffers, and what is refused.

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
    return refusal_of([&] { read_mesh(with(head, data)); });
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

// Normals of glTF that are replaced (sparse) or stored as integers (KHR_mesh_quantization).

// glTF's x, y, z are y, z, x of the body.
Vec3 in_gltf(const Vec3& body) { return {body.y(), body.z(), body.x()}; }

template <typename Number>
void append(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

// Two facets of 1 m x 1 m that meet at `fold` (rad) along y, in a plane turned by 0.4 rad: a file of positions, of
// normals in numbers of one type, and of four replaced normals.
class GltfNormals : public MeshFile {
 protected:
  static constexpr double kTilt = 0.4;

  static std::vector<Vec3> positions(double fold) {
    std::vector<Vec3> list;
    for (const double y : {-0.5, 0.5}) {
      list.push_back({-std::cos(kTilt + fold / 2), y, -std::sin(kTilt + fold / 2)});
      list.push_back({0, y, 0});
      list.push_back({std::cos(kTilt - fold / 2), y, std::sin(kTilt - fold / 2)});
    }
    return list;  // 0 1 2 at y = -0.5, 3 4 5 at 0.5
  }

  template <typename Number>
  void add_vectors(const std::vector<Vec3>& vectors, double scale) {
    for (const Vec3& v : vectors) {
      const Vec3 x = in_gltf(v) * scale;
      for (const double component : x)
        append(bytes_, static_cast<Number>(std::is_integral_v<Number> ? std::round(component) : component));
      while (bytes_.size() % 4 != 0) bytes_ += '\0';
    }
  }

  void begin(double fold) {
    bytes_.clear();
    add_vectors<float>(positions(fold), 1);
    for (const int i : {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}) append(bytes_, static_cast<std::uint16_t>(i));
  }

  // The accessor of the normals and further views, each behind what was added before.
  TriangleMesh read(const std::string& normals, const std::string& views) {
    put("a.bin", bytes_);
    return read_mesh(put(
        "a.gltf",
        R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_mesh_quantization"],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)"
        R"({"attributes":{"POSITION":0,"NORMAL":2},"indices":1}]}],"accessors":[)"
        R"({"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"},)" +
            normals + R"(],"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":24})" +
            views + R"(],"buffers":[{"uri":"a.bin","byteLength":)" + std::to_string(bytes_.size()) + "}]}"));
  }

  // Normals of the facets' edge between both, of the outer ones each facet's own.
  static std::vector<Vec3> smooth_normals(double fold) {
    std::vector<Vec3> list;
    for (int row = 0; row < 2; ++row)
      for (const double side : {fold / 2, 0.0, -fold / 2})
        list.push_back({-std::sin(kTilt + side), 0, std::cos(kTilt + side)});
    return list;
  }

  template <typename Number>
  TriangleMesh read_integers(double fold, int component, const std::string& stride) {
    begin(fold);
    const std::size_t first = bytes_.size();
    add_vectors<Number>(smooth_normals(fold), std::numeric_limits<Number>::max());
    return read(R"({"bufferView":2,"componentType":)" + std::to_string(component) +
                    R"(,"normalized":true,"count":6,"type":"VEC3"})",
                R"(,{"buffer":0,"byteOffset":96,"byteLength":)" + std::to_string(bytes_.size() - first) +
                    R"(,"byteStride":)" + stride + "}");
  }

  static double error(const TriangleMesh& mesh, double fold) {
    const std::vector<Vec3> given = smooth_normals(fold), at = positions(fold);
    double largest = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        std::size_t nearest = 0;
        for (std::size_t v = 0; v < at.size(); ++v) {
          const Vec3& x = mesh.vertices[mesh.triangles[t][i]];
          if ((at[v] - x).norm() < (at[nearest] - x).norm()) nearest = v;
        }
        largest = std::max(largest, (mesh.corner_normals[t][i] - given[nearest]).norm());
      }
    }
    return largest;
  }

  std::string bytes_;
};

// Half a step of each of three components; positions are float32.
TEST_F(GltfNormals, OfIntegersHaveTheirRounding) {
  const double fold = radians(20), half_step = std::sqrt(3.0) / 2;
  const TriangleMesh bytes = read_integers<std::int8_t>(fold, 5120, "4");
  ASSERT_EQ(bytes.corner_normals.size(), 4u);
  EXPECT_LT(error(bytes, fold), half_step / 127);
  EXPECT_GT(error(bytes, fold), 0.05 * half_step / 127) << "no rounding in the test";
  const TriangleMesh shorts = read_integers<std::int16_t>(fold, 5122, "8");
  EXPECT_LT(error(shorts, fold), half_step / 32767 + kFloatRounding);
}

// On a plane 8 bits are off by up to 0.4 deg, which would count as a curved surface: they are the facet's own.
TEST_F(GltfNormals, OfEightBitsOnAPlaneAreThoseOfTheFacets) {
  const TriangleMesh mesh = read_integers<std::int8_t>(0, 5120, "4");
  ASSERT_EQ(mesh.corner_normals.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_LT(normal_deviation(mesh, t), 1e-7);
  const TriangleMesh shorts = read_integers<std::int16_t>(0, 5122, "8");
  for (std::size_t t = 0; t < 4; ++t) EXPECT_LT(normal_deviation(shorts, t), kNormalDigits);
}

// glTF 2.0, section 3.6.2.3: without a view the others are zero, which is no normal.
TEST_F(GltfNormals, ThatAreSparseReplaceOthersOrNone) {
  const double fold = radians(20);
  const std::vector<Vec3> normals = smooth_normals(fold);
  begin(fold);
  const std::size_t first = bytes_.size();
  add_vectors<float>(std::vector<Vec3>(6, Vec3(0, 1, 0)), 1);
  for (const int i : {0, 1, 4, 5}) append(bytes_, static_cast<std::uint16_t>(i));
  add_vectors<float>({normals[0], normals[1], normals[4], normals[5]}, 1);
  const std::string sparse =
      R"("sparse":{"count":4,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":4}},)"
      R"("componentType":5126,"count":6,"type":"VEC3"})";
  const auto view = [](std::size_t offset, std::size_t size) {
    return R"(,{"buffer":0,"byteOffset":)" + std::to_string(offset) + R"(,"byteLength":)" + std::to_string(size) + "}";
  };
  const std::string views = view(first, 72) + view(first + 72, 8) + view(first + 80, 48);
  for (const bool has_base : {true, false}) {
    const TriangleMesh mesh = read((has_base ? R"({"bufferView":2,)" : "{") + sparse, views);
    ASSERT_EQ(mesh.corner_normals.size(), 4u);
    int others = 0;
    for (std::size_t t = 0; t < 4; ++t) {
      for (int i = 0; i < 3; ++i) {
        const Vec3& n = mesh.corner_normals[t][i];
        const bool is_replaced = std::any_of(normals.begin(), normals.end(),
                                             [&](const Vec3& expected) { return (n - expected).norm() < 1e-6; });
        others += is_replaced ? 0 : 1;
        EXPECT_TRUE(is_replaced || n == (has_base ? Vec3(0, 1, 0) : Vec3(0, 0, 0)));
      }
    }
    EXPECT_EQ(others, 2);  // vertices 2 and 3 are each a corner of one triangle
  }
}

// Surface normals in files and through the operations on a mesh.

class MeshNormals : public MeshFile {};

// A sphere whose corner normals are exact, but for one triangle that has none.
TriangleMesh sphere_with_normals() {
  TriangleMesh mesh = make_sphere(2, 2);
  for (const auto& triangle : mesh.triangles) {
    auto& normals = mesh.corner_normals.emplace_back();
    for (int i = 0; i < 3; ++i) normals[i] = mesh.vertices[triangle[i]].normalized();
  }
  mesh.corner_normals[7] = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  return mesh;
}

// Largest deviation of the given normals from those of a sphere about `centre`.
double error_on_sphere(const TriangleMesh& mesh, const Vec3& centre = Vec3::Zero()) {
  double largest = 0;
  for (std::size_t t = 0; t < mesh.corner_normals.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Vec3& n = mesh.corner_normals[t][i];
      if (!n.isZero(0))
        largest = std::max(largest, (n - (mesh.vertices[mesh.triangles[t][i]] - centre).normalized()).norm());
    }
  }
  return largest;
}

TEST_F(MeshNormals, ArePreservedByFilesAndWelding) {
  const TriangleMesh mesh = sphere_with_normals();
  for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.ply"}) {
    SCOPED_TRACE(name);
    write_mesh(folder / name, mesh);
    const TriangleMesh again = read_mesh(folder / name);
    ASSERT_EQ(again.corner_normals.size(), mesh.triangles.size());
    EXPECT_EQ(again.vertices.size(), mesh.vertices.size()) << "vertices split by normal are welded";
    const bool is_gltf = std::string(name).starts_with("a.gl");
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        // glTF has normals for all vertices of a primitive or for none.
        const Vec3 given = mesh.corner_normals[t][i],
                   expected = is_gltf && given.isZero(0) ? Vec3(area_vector(mesh, t).normalized()) : given;
        // Each component rounded to float32; OBJ and PLY are normalised once more.
        EXPECT_LT((again.corner_normals[t][i] - expected).norm(), is_gltf ? 3 * kFloatRounding : 4e-16);
      }
    }
  }
  write_mesh(folder / "a.stl", mesh);
  EXPECT_TRUE(read_mesh(folder / "a.stl").corner_normals.empty());
}

// The nodes turn, stretch and mirror: normals of an ellipsoid are the gradient of its quadric.
TEST_F(MeshNormals, OfGltfAreTransformedByTheInverseTranspose) {
  TriangleMesh mesh = sphere_with_normals();
  mesh.corner_normals[7] = mesh.corner_normals[8];
  for (int i = 0; i < 3; ++i) mesh.corner_normals[7][i] = mesh.vertices[mesh.triangles[7][i]].normalized();
  write_mesh(folder / "a.gltf", mesh);
  std::string text = bytes_of(folder / "a.gltf");
  const std::string node = "\"mesh\":0";
  const std::size_t at = text.find(node);
  ASSERT_NE(at, std::string::npos);
  text.insert(at, "\"scale\":[3,-1,0.5],");
  const TriangleMesh placed = read_mesh(put("b.gltf", text));
  ASSERT_EQ(placed.corner_normals.size(), placed.triangles.size());
  for (std::size_t t = 0; t < placed.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      // glTF's x, y, z are y, z, x of the body.
      const Vec3& p = placed.vertices[placed.triangles[t][i]];
      const Vec3 gradient(p.x() / 0.25, p.y() / 9, p.z());
      EXPECT_LT((placed.corner_normals[t][i] - gradient.normalized()).norm(), 40 * kFloatRounding);
    }
    EXPECT_GT(placed.corner_normals[t][0].dot(area_vector(placed, t)), 0);
  }
}

// glTF 2.0, section 3.7.2.1: a primitive without NORMAL is flat. The ship has primitives of both kinds.
TEST_F(MeshNormals, OfPrimitivesWithoutThemAreFlatInGltf) {
  const TriangleMesh ship = read_mesh(SEAGLINT_SOURCE_DIR "/assets/combatant_144m.glb");
  EXPECT_EQ(diagnose(ship).corners_without_normal, 0u);
  std::size_t flat = 0;
  for (std::size_t t = 0; t < ship.triangles.size(); ++t) flat += normal_deviation(ship, t) < kNormalDigits ? 1 : 0;
  EXPECT_GT(flat, ship.triangles.size() / 2);
  EXPECT_LT(flat, ship.triangles.size());
}

TEST_F(MeshNormals, ThatAreInvalidRefuseNoFileAndAreCounted) {
  const TriangleMesh mesh = read_mesh(put("a.obj",
                                          "v 0 0 0\nv 2 0 0\nv 0 1 0\nvn 0 0 5\nvn nan 0 1\nvn 0 0\n"
                                          "f 1//1 2//1 3//-3\nf 1//2 2//3 3//9\nf 1 2/1 3/1/x\n"));
  ASSERT_EQ(mesh.corner_normals.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(mesh.corner_normals[0][i], Vec3(Vec3::UnitZ()));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(mesh.corner_normals[1][i].isZero(0) && mesh.corner_normals[2][i].isZero(0));
  EXPECT_EQ(diagnose(mesh).corners_without_normal, 6u);
  EXPECT_THAT(diagnostic_messages(diagnose(mesh)), testing::Contains(testing::HasSubstr("6 of 9 corners")));

  const TriangleMesh ply = read_mesh(put(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 0 0 1e-3\n1 0 0 nan 0 0\n0 1 0 0 0 0\n3 0 1 2\n"));
  ASSERT_EQ(ply.corner_normals.size(), 1u);
  EXPECT_EQ(ply.corner_normals[0][0], Vec3(Vec3::UnitZ()));
  EXPECT_EQ(diagnose(ply).corners_without_normal, 2u);
}

TEST_F(MeshNormals, FollowTheOperationsOnAMesh) {
  TriangleMesh mesh = sphere_with_normals();
  const Mat3 R = axis_rotation(0.8, Vec3(1, -1, 2).normalized());
  const Vec3 shift(3, 1, -0.5);
  EXPECT_LT(error_on_sphere(transformed(mesh, R, shift), shift), 1e-14);

  // Inside out: the repair turns triangles and normals.
  TriangleMesh inverted = mesh;
  for (std::size_t t = 0; t < inverted.triangles.size(); ++t) {
    std::swap(inverted.triangles[t][1], inverted.triangles[t][2]);
    const auto n = mesh.corner_normals[t];
    inverted.corner_normals[t] = {-n[0], -n[2], -n[1]};
  }
  EXPECT_LT(error_on_sphere(repair(inverted)), 1e-15);
  EXPECT_EQ(repair(inverted).corner_normals.size(), mesh.triangles.size());

  TriangleMesh both = make_plate(1, 1);
  both.append(mesh);
  both.append(make_plate(1, 1));
  ASSERT_EQ(both.corner_normals.size(), both.triangles.size());
  EXPECT_LT(error_on_sphere(both), 1e-15);
  EXPECT_TRUE(both.corner_normals.front()[0].isZero(0) && both.corner_normals.back()[0].isZero(0));

  // Interpolated along a side of 0.57 rad: half the second difference of a unit vector, 0.57^2 / 8, at most.
  const WaterlineCut cut = cut_at_waterline(mesh, 0.123);
  ASSERT_EQ(cut.mesh.corner_normals.size(), cut.mesh.triangles.size());
  EXPECT_LT(error_on_sphere(cut.mesh), 0.57 * 0.57 / 8);
  for (const auto& normals : cut.mesh.corner_normals)
    for (const Vec3& n : normals) EXPECT_TRUE(n.isZero(0) || std::abs(n.norm() - 1) < 1e-15);
}

// On a sphere the rule is exact; a cylinder's caps stay flat, and its side has the normals of the circle.
TEST_F(MeshNormals, ByCreaseAngleFollowSmoothSurfacesAndStopAtEdges) {
  TriangleMesh sphere = make_sphere(2, 3);
  sphere.corner_normals = crease_normals(sphere, radians(20));
  EXPECT_LT(error_on_sphere(sphere), 1e-13);
  TriangleMesh cylinder = make_cylinder(1, 2, 36);
  cylinder.corner_normals = crease_normals(cylinder, radians(20));
  for (std::size_t t = 0; t < cylinder.triangles.size(); ++t) {
    const Vec3 facet = area_vector(cylinder, t).normalized();
    for (int i = 0; i < 3; ++i) {
      Vec3 expected = cylinder.vertices[cylinder.triangles[t][i]];
      expected.z() = 0;
      if (std::abs(facet.z()) > 0.5) {
        EXPECT_TRUE(cylinder.corner_normals[t][i].isZero(0)) << "a flat fan";
      } else {
        EXPECT_LT((cylinder.corner_normals[t][i] - expected.normalized()).norm(), 1e-14);
      }
    }
  }
  for (const auto& normals : crease_normals(make_sphere(2, 1), 0))
    for (const Vec3& n : normals) EXPECT_TRUE(n.isZero(0)) << "every triangle is flat";
}

}  // namespace
}  // namespace seaglint
