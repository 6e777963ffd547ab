// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tools/cli/command_line.h"
#include "tools/figure/mesh_picture.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

class MeshCommand : public testing::Test {
 protected:
  // What the command prints.
  static std::string run(const std::vector<std::string>& words) {
    ProgramOptions program("test", "");
    CommandContext context;
    add_mesh(program, context);
    std::vector<const char*> argv{"test"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    const ParsedCommandLine parsed = program.parse(static_cast<int>(argv.size()), argv.data());
    if (parsed.error) throw InputError(*parsed.error);
    testing::internal::CaptureStdout();
    try {
      context.work();
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    return testing::internal::GetCapturedStdout();
  }

  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
};

TEST_F(MeshCommand, CreatesEveryKindOfMesh) {
  const std::string file = (folder / "a.glb").string();
  const std::pair<std::vector<std::string>, double> kinds[] = {
      {{"plate", "--length-m", "2", "--width-m", "0.5"}, 1.0},
      {{"dihedral", "--length-m", "1", "--width-m", "0.5"}, 1.0},
      {{"trihedral", "--leg-m", "2"}, 6.0},
      {{"trihedral", "--leg-m", "2", "--square"}, 12.0},
      {{"cylinder", "--radius-m", "1", "--height-m", "1", "--segments", "4"}, 4 + 4 * std::sqrt(2.0)},
      {{"reflector", "--edge-m", "1"}, 15.0},
      {{"sphere", "--radius-m", "1", "--subdivisions", "0"}, 9.57454},
  };
  for (const auto& [kind, area] : kinds) {
    std::vector<std::string> words{"mesh", "make"};
    words.insert(words.end(), kind.begin(), kind.end());
    words.insert(words.end(), {"-o", file});
    EXPECT_HAS(run(words), "triangles") << kind[0];
    // float32 positions: 6e-8 of each coordinate, a dozen coordinates.
    EXPECT_NEAR(surface_area(read_mesh(file)), area, 1e-5) << kind[0];
  }
  run({"mesh", "make", "ship", "--length-m", "120", "--detail", "hull", "-o", file});
  EXPECT_NEAR(bounds(read_mesh(file)).upper.x(), 60, 0.01);
}

TEST_F(MeshCommand, ReportsTheContentsOfAFileInItsUnit) {
  const std::string file = (folder / "plate.stl").string(), picture = (folder / "plate.png").string();
  write_mesh(file, make_plate(1000, 500));
  const std::string text = run({"mesh", "info", file, "--unit", "mm", "--picture", picture, "--width", "64"});
  EXPECT_HAS(text, "size       0 x 1 x 0.5 m");
  EXPECT_HAS(text, "triangles  2, vertices 4, area 0.5 m^2");
  EXPECT_HAS(text, "4 boundary");
  EXPECT_HAS(text, "4 free edges");
  EXPECT_THAT(read_file(picture), testing::StartsWith("\x89PNG"));
}

TEST_F(MeshCommand, RefusesWrongInput) {
  EXPECT_THROW(run({"mesh", "info", (folder / "absent.glb").string()}), InputError);
  EXPECT_THROW(run({"mesh", "make", "plate", "--length-m", "-1", "-o", (folder / "a.glb").string()}), InputError);
  EXPECT_THROW(run({"mesh", "make", "plate", "-o", (folder / "a.txt").string()}), InputError);
  EXPECT_THROW(run({"mesh", "make", "plate", "-o", (folder / "no" / "a.glb").string()}), WorkError);
  EXPECT_THROW(run({"mesh", "make", "ship"}), InputError);
  EXPECT_THROW(run({"mesh", "make", "boat", "-o", "a.glb"}), InputError);
}

TEST(MeshPicture, DrawsThePlateThatFacesTheViewerOnWhite) {
  const Picture picture = picture_of(make_plate(2, 1), {.azimuth_deg = 0, .elevation_deg = 0, .width = 200});
  // 2 m and twice 3 % of it across: 2.12 by 1.12 m.
  EXPECT_NEAR(picture.height, 200 * 1.12 / 2.12, 1.0);
  std::size_t white = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) white += picture.rgb[i] == 255;
  const double covered = 1.0 - static_cast<double>(3 * white) / static_cast<double>(picture.rgb.size());
  EXPECT_NEAR(covered, 2.0 / (2.12 * 1.12), 0.03);  // pixels at the boundary are partly covered
}

TEST(MeshPicture, HasTheBowOnTheLeftSeenFromPort) {
  // A plate at x = 10 and a smaller one at x = -10, both seen from port.
  const Mat3 rotation = axis_rotation(0.5 * 3.14159265358979, Vec3::UnitZ());
  TriangleMesh mesh = transformed(make_plate(4, 4), rotation, Vec3(10, 0, 0));
  mesh.append(transformed(make_plate(1, 1), rotation, Vec3(-10, 0, 0)));
  const Picture picture = picture_of(mesh, {.azimuth_deg = 90, .elevation_deg = 0, .width = 300});
  std::size_t left = 0, right = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const bool ink = picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)] != 255;
      (x < picture.width / 2 ? left : right) += ink;
    }
  }
  EXPECT_GT(left, 8 * right);
}

TEST(MeshPicture, RefusesInvalidArguments) {
  EXPECT_THROW(picture_of(TriangleMesh{}, {}), InputError);
  EXPECT_THROW(picture_of(make_plate(1, 1), {.width = 1}), InputError);
  EXPECT_THROW(picture_of(make_plate(1, 1), {.width = 100000}), InputError);
}

}  // namespace
}  // namespace seaglint
