// SPDX-License-Identifier: BSD-3-Clause
// Shells as Gmsh and meshio write them (tests/cases/README.md), whole and damaged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/core/numbers/random.h"
#include "sim/core/process/error.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_diagnostics.h"
#include "tests/sim/geometry/mesh_file.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kFolder = SEAGLINT_SOURCE_DIR "/tests/cases/meshes/exchange/";

std::size_t triangles_of_part(const TriangleMesh& mesh, std::size_t part) {
  return static_cast<std::size_t>(std::count(mesh.triangle_part.begin(), mesh.triangle_part.end(), part));
}

class ExchangeFile : public MeshFile, public testing::WithParamInterface<const char*> {};

// A box of 1.2 x 0.7 x 0.5 m. Counts as meshio reads Gmsh's file: 38 triangles and 4 quadrilaterals at 25 corners.
TEST_P(ExchangeFile, HasTheBoxThatGmshMeshed) {
  const std::string name = GetParam();
  const TriangleMesh mesh = read_mesh(kFolder + name);
  EXPECT_EQ(mesh.triangles.size(), 46u);
  EXPECT_EQ(mesh.vertices.size(), 25u);
  // Six digits of small fields and of "%g", at 46 triangles.
  const double rounding = name.ends_with(".msh") || name.ends_with(".unv") ? 1e-14 : 46 * 1.2e-6;
  EXPECT_NEAR(surface_area(mesh), 3.58, rounding);
  EXPECT_NEAR(enclosed_volume(mesh), 0.42, rounding);
  const MeshDiagnostics found = diagnose(mesh);
  EXPECT_EQ(found.open_edges + found.inconsistent_edges + found.non_manifold_edges, 0u);
  if (name.find("second_order") != std::string::npos)
    EXPECT_THAT(mesh.findings, ElementsAre("42 elements of higher order: read by the corners, sides are straight"));
  else
    EXPECT_THAT(mesh.findings, IsEmpty());
}

TEST_P(ExchangeFile, HasItsParts) {
  const std::string name = GetParam();
  const TriangleMesh mesh = read_mesh(kFolder + name);
  if (name.ends_with(".bdf")) {
    EXPECT_THAT(mesh.part_names, testing::UnorderedElementsAre("property_1", "property_2", "property_3", "property_4",
                                                               "property_5", "property_6"));
  } else if (name.ends_with(".nas")) {
    EXPECT_THAT(mesh.part_names, ElementsAre("body"));  // meshio writes no properties
  } else {
    // Gmsh replaces blanks in names of universal files.
    EXPECT_THAT(mesh.part_names, ElementsAre("hull", name.ends_with(".unv") ? "deck_plate" : "deck plate"));
    EXPECT_EQ(triangles_of_part(mesh, 0), 38u);
    EXPECT_EQ(triangles_of_part(mesh, 1), 8u);
  }
}

// A file cut off anywhere before its last character is refused.
TEST_P(ExchangeFile, ThatIsCutOffIsRefused) {
  const std::string name = GetParam(), bytes = bytes_of(kFolder + name);
  const std::size_t end = bytes.find_last_not_of(" \r\n") + 1;
  for (std::size_t size = 1; size < end; size += 1 + end / 61) {
    const std::filesystem::path path = put(name, bytes.substr(0, size));
    try {
      const TriangleMesh mesh = read_mesh(path);
      // Gmsh writes no BEGIN BULK, without which a file may be a part of another.
      const bool is_part =
          name.ends_with(".bdf") && !mesh.findings.empty() && mesh.findings[0].starts_with("ends without ENDDATA");
      EXPECT_TRUE(is_part) << name << " cut at byte " << size;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string()));
    }
  }
}

TEST_P(ExchangeFile, WithChangedBytesIsNeverACrash) {
  const std::string name = GetParam(), bytes = bytes_of(kFolder + name);
  Random random({.seed = 4, .stream = Stream::kTest, .index = 0});
  for (int i = 0; i < 100; ++i) {
    std::string changed = bytes;
    const std::uint32_t count = 1 + random.below(4);
    for (std::uint32_t k = 0; k < count; ++k) {
      char& c = changed[random.below(static_cast<std::uint32_t>(changed.size()))];
      c = static_cast<char>(i % 2 == 0 ? random.below(256) : '0' + random.below(10));
    }
    const std::filesystem::path path = put(name, changed);
    try {
      const TriangleMesh mesh = read_mesh(path);
      for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) EXPECT_LT(v, mesh.vertices.size());
      }
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Files, ExchangeFile,
                         testing::Values("v22.msh", "v22_binary.msh", "v22_big_endian.msh", "v41.msh", "v41_binary.msh",
                                         "v41_big_endian.msh", "v41_second_order.msh", "box.unv", "second_order.unv",
                                         "small_field.bdf", "free_field.bdf", "large_field.bdf", "second_order.bdf",
                                         "meshio_large_field.nas"),
                         [](const auto& file) {
                           std::string name = file.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace seaglint
