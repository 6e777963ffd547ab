// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Bodies of flat and curved parts at random places.

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/shapes/generators.h"

namespace seaglint::testing_echoes {

// A box, an ellipsoid and a cylinder upright on a plate.
inline TriangleMesh random_body(std::uint64_t seed) {
  Random random({seed, Stream::kTest, 0});
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const auto upright = [&](const TriangleMesh& mesh, const Vec3& place) {
    return transformed(mesh, axis_rotation(between(0, 2 * kPi), Vec3::UnitZ()), place);
  };
  TriangleMesh body = transformed(make_plate(2, 2), axis_rotation(-kPi / 2, Vec3::UnitY()), {0, 0, between(-0.1, 0.1)});
  TriangleMesh ellipsoid = make_sphere(0.25, 3);
  for (Vec3& x : ellipsoid.vertices) x = x.cwiseProduct(Vec3(between(0.5, 2), 1, between(0.5, 1)));
  body.append(upright(ellipsoid, {between(-0.6, -0.4), between(-0.6, 0.6), 0.5}));
  body.append(upright(make_cylinder(between(0.1, 0.2), 0.5, 40), {between(0.1, 0.3), between(0.3, 0.6), 0.4}));
  MeshBuilder box;
  box.begin_part("box");
  Pose pose;
  pose.R = axis_rotation(between(0, 1), Vec3(0.1, 0, 1).normalized());
  pose.p = {between(0.1, 0.5), between(-0.6, -0.3), 0.35};
  add_box(box, pose, {0.4, 0.3, 0.4});
  body.append(box.take());
  return body;
}

}  // namespace seaglint::testing_echoes
