// SPDX-License-Identifier: BSD-3-Clause
// The echo of a body does not depend on the format of its mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/shapes/generators.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

std::array<Complex, 4> echo_of(const std::filesystem::path& mesh, const Vec3& r_hat) {
  constexpr double kFrequency = 10e9;
  TargetSource source;
  source.mesh = mesh;
  source.lowest_hz = source.highest_hz = kFrequency;
  ScattererSettings settings;
  settings.lowest_hz = settings.highest_hz = kFrequency;
  const PreparedTarget target = prepare_target(load_target_mesh(source), settings);
  const double k = 2 * kPi * kFrequency / kSpeedOfLight;
  return scattering_matrices(*target.scatterer, monostatic(radar_basis(r_hat)), std::array{k}, {0, 4, true})[0];
}

// Largest difference relative to the largest element of the first.
double difference(const std::array<Complex, 4>& a, const std::array<Complex, 4>& b) {
  double most = 0, size = 0;
  for (int i = 0; i < 4; ++i) {
    most = std::max(most, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(a[i]));
  }
  EXPECT_GT(size, 1e-3);
  return most / size;
}

// A box of 1.2 x 0.7 x 0.5 m that Gmsh meshed and wrote, that mesh as meshio writes it, and the box's eight corners.
TEST(ExchangeFormats, HaveTheEchoOfTheSameBodyAsObj) {
  const TemporaryFolder folder;
  MeshBuilder builder;
  add_box(builder, {}, Vec3(1.2, 0.7, 0.5));
  const std::filesystem::path corners = folder.path() / "corners.obj";
  write_mesh(corners, builder.take());
  // The first file of each line lists the elements in the order of the others.
  const std::vector<std::vector<std::string>> groups{
      {"meshio.obj", "v22.msh", "v22_big_endian.msh", "meshio_large_field.nas"},
      {"v41.msh", "v41_big_endian.msh", "v41_second_order.msh", "box.unv", "small_field.bdf", "large_field.bdf",
       "free_field.bdf"}};
  const std::string files = SEAGLINT_SOURCE_DIR "/tests/cases/meshes/exchange/";
  double by_format = 0, by_order = 0;
  for (const double azimuth_deg : {0.0, 33.0, 90.0, 141.0}) {
    const double az = radians(azimuth_deg), el = radians(12);
    const Vec3 r_hat(std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el));
    const std::array<Complex, 4> of_corners = echo_of(corners, r_hat);
    for (const std::vector<std::string>& names : groups) {
      const std::array<Complex, 4> first = echo_of(files + names.front(), r_hat);
      by_order = std::max(by_order, difference(of_corners, first));
      for (const std::string& name : names)
        by_format = std::max(by_format, difference(first, echo_of(files + name, r_hat)));
    }
  }
  std::printf("largest relative difference: formats %.1e, order of the elements %.1e\n", by_format, by_order);
  // The corners are exact in every format; rounding of some thousand operations on phases of k l = 300, l the diagonal.
  EXPECT_LT(by_format, 1e-9);
  // The order of the elements decides which contributions below a tenth of the smallest patch are left out.
  EXPECT_LT(by_order, 1e-4);
}

}  // namespace
}  // namespace seaglint
