// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A rectangular guide, shorted at its end, as a cavity: 0 <= y <= a, 0 <= z <= b, open at x = 0, closed at x = depth.

#include "sim/geometry/mesh/mesh_builder.h"

namespace seaglint {

// Its inner faces, each of two triangles; part "guide".
inline TriangleMesh guide(double a, double b, double depth) {
  MeshBuilder builder;
  builder.begin_part("guide");
  const auto v = [&](double x, double y, double z) { return builder.vertex({x, y, z}); };
  const auto o00 = v(0, 0, 0), oa0 = v(0, a, 0), oab = v(0, a, b), o0b = v(0, 0, b);
  const auto e00 = v(depth, 0, 0), ea0 = v(depth, a, 0), eab = v(depth, a, b), e0b = v(depth, 0, b);
  builder.quad(o00, e00, ea0, oa0);  // floor, seen from above
  builder.quad(o0b, oab, eab, e0b);  // ceiling
  builder.quad(o00, o0b, e0b, e00);  // y = 0
  builder.quad(oa0, ea0, eab, oab);  // y = a
  builder.quad(e00, e0b, eab, ea0);  // end
  return builder.take();
}

}  // namespace seaglint
