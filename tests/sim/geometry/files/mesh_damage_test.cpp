// SPDX-License-Identifier: BSD-3-Clause
// Damaged files of all formats: each is read as some mesh or refused with an InputError that names it, without any
// other effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class MeshFuzzing : public testing::TestWithParam<const char*> {
 protected:
  MeshFuzzing()
      : folder(fs::path(testing::TempDir()) /
               ("seaglint_damage_" + std::to_string(::getpid()) + std::string(GetParam()))) {
    fs::create_directories(folder);
    const fs::path valid = folder / ("sound" + std::string(GetParam()));
    write_mesh(valid, make_icosahedral_reflector());
    std::ostringstream content;
    content << std::ifstream(valid, std::ios::binary).rdbuf();
    bytes = content.str();
  }
  ~MeshFuzzing() override { fs::remove_all(folder); }

  // True when the file was refused.
  bool refused(const std::string& content) const {
    const fs::path path = folder / ("damaged" + std::string(GetParam()));
    std::ofstream(path, std::ios::binary) << content;
    try {
      const TriangleMesh mesh = read_mesh(path);
      for (const auto& triangle : mesh.triangles) {
        for (std::uint32_t v : triangle) EXPECT_TRUE(v < mesh.vertices.size() && mesh.vertices[v].allFinite());
      }
      return false;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string()));
      return true;
    }
  }

  fs::path folder;
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
