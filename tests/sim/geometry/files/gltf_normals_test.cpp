// SPDX-License-Identifier: BSD-3-Clause
// Normals of glTF that are replaced (sparse) or stored as integers (KHR_mesh_quantization).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

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
    for (int row = 0; row < 2; ++row) {
      for (const double side : {fold / 2, 0.0, -fold / 2})
        list.push_back({-std::sin(kTilt + side), 0, std::cos(kTilt + side)});
    }
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

}  // namespace
}  // namespace seaglint
