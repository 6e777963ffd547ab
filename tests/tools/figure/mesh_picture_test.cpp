// SPDX-License-Identifier: BSD-3-Clause
// Pictures of meshes, and figures of meshes with levels.
#include "tools/figure/mesh_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/geometry/shapes/generators.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

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

std::array<int, 3> pixel(const Picture& picture, const Vec3& p) {
  const auto [x, y] = picture.place(p);
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(x));
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

TEST(MeshPicture, HasTheColoursOfItsTrianglesAndLinesThatNothingHides) {
  const TriangleMesh plate = make_plate(2, 1);  // seen from the front: port is on the right
  const std::vector<Rgb> colours{{1, 0, 0}, {0, 0, 1}};
  const std::array<std::array<Vec3, 2>, 2> lines{
      {{Vec3(0.1, -0.8, -0.4), Vec3(0.1, 0.8, -0.4)}, {Vec3(-0.5, -0.8, 0.4), Vec3(-0.5, 0.8, 0.4)}}};
  const Picture picture = picture_of(plate, {.azimuth_deg = 0, .elevation_deg = 0, .width = 400},
                                     {.triangles = colours, .lines = lines, .line = {0, 1, 0}});
  EXPECT_NEAR(picture.pixels_per_m, 400 / 2.12, 1e-9);
  EXPECT_LT(picture.place(Vec3(0, -0.9, 0))[0], picture.place(Vec3(0, 0.9, 0))[0]);
  EXPECT_LT(picture.place(Vec3(0, 0, 0.4))[1], picture.place(Vec3(0, 0, -0.4))[1]);
  for (std::size_t t = 0; t < 2; ++t) {
    Vec3 middle = Vec3::Zero();
    for (const std::uint32_t v : plate.triangles[t]) middle += plate.vertices[v] / 3;
    const std::array<int, 3> shown = pixel(picture, middle);
    const std::size_t full = t == 0 ? 0 : 2;
    for (std::size_t c = 0; c < 3; ++c) {
      if (c == full) {
        EXPECT_GT(shown[c], 0.7 * 255);
      } else {
        EXPECT_EQ(shown[c], 0);
      }
    }
  }
  EXPECT_GT(pixel(picture, lines[0][0] / 2 + lines[0][1] / 2)[1], 120) << "a line before the plate";
  EXPECT_EQ(pixel(picture, lines[1][0] / 2 + lines[1][1] / 2)[1], 0) << "a line behind it";
}

TEST(MeshFigure, IsDrawnInEveryFormat) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = make_icosahedral_reflector();
  std::vector<double> levels;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) levels.push_back(static_cast<double>(t) - 30);
  MeshFigure figure{.title = "it's a_test",
                    .mesh = mesh,
                    .levels = levels,
                    .colour = {"facets (dBsm)", AxisRange{-20, 30}},
                    .balls = {{Vec3(0.2, 0, 0), 10}, {Vec3(0, 0.3, 0), -15, true}},
                    .ball_range = {-20, 10}};
  for (const char* name : {"a", "another ein wenig längerer Näme mit Umläuten", "b's", "c", "d"})
    figure.names.push_back({Vec3(0.2, 0, 0), {name, "3 bounces"}});
  figure.notes = {"16 GHz"};
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    write_figure(figure, folder.path() / name);
    EXPECT_GT(read_file(folder.path() / name).size(), 10'000u) << name;
  }
  EXPECT_EQ(read_file(folder.path() / "a.png"), png_of(figure));
}

TEST(Names, KeepTheirDistanceNearTheirPlaces) {
  EXPECT_EQ(apart({1, 5, 9}, 2, {0, 10}), (std::vector<double>{1, 5, 9}));
  EXPECT_EQ(apart({4, 4, 4}, 2, {0, 10}), (std::vector<double>{4, 6, 8}));
  EXPECT_EQ(apart({8, 9, 9}, 2, {0, 10}), (std::vector<double>{6, 8, 10}));
  EXPECT_EQ(apart({3, 3, 3}, 20, {0, 10}), (std::vector<double>{0, 5, 10})) << "no room";
  EXPECT_TRUE(apart({}, 2, {0, 10}).empty());
}

}  // namespace
}  // namespace seaglint
