// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/cavity_aperture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "tests/sim/cavity/guide.h"

namespace seaglint {
namespace {

struct Sum {
  Vec3 area = Vec3::Zero(), moment = Vec3::Zero();  // of the area about the origin, signed along the sum
};

Sum sum_of(const std::vector<ApertureCell>& cells) {
  Sum sum;
  for (const ApertureCell& cell : cells) sum.area += cell.area * cell.inward;
  for (const ApertureCell& cell : cells) sum.moment += cell.area * cell.inward.dot(sum.area.normalized()) * cell.centre;
  return sum;
}

TriangleMesh inverted(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// A prism with its base at z = -1 and its top open at z = 0; the outline runs counter-clockwise seen from above. Side
// faces have inward normals; the base is a fan about `hub`, from which all of it must be visible.
TriangleMesh pit(const std::vector<Vec2>& outline, const Vec2& hub) {
  MeshBuilder builder;
  builder.begin_part("pit");
  std::vector<std::uint32_t> top, base;
  for (const Vec2& p : outline) {
    top.push_back(builder.vertex({p.x(), p.y(), 0}));
    base.push_back(builder.vertex({p.x(), p.y(), -1}));
  }
  const std::uint32_t middle = builder.vertex({hub.x(), hub.y(), -1});
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = (i + 1) % outline.size();
    builder.quad(base[next], base[i], top[i], top[next]);
    builder.triangle(middle, base[i], base[next]);
  }
  return builder.take();
}

TEST(CavityAperture, OfAGuideIsItsOpenFaceWithInwardNormal) {
  const Sum sum = sum_of(aperture_cells(guide(0.3, 0.2, 0.5), 0.011));
  EXPECT_LT((sum.area - Vec3(0.06, 0, 0)).norm(), 1e-12);
  EXPECT_LT((sum.moment / 0.06 - Vec3(0, 0.15, 0.1)).norm(), 1e-12);
}

TEST(CavityAperture, MayBeOfAnyShapeEvenConcave) {
  // An L: two unit squares and one in the corner.
  const std::vector<Vec2> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const auto cells = aperture_cells(pit(outline, {0.5, 0.5}), 0.07);
  const Sum sum = sum_of(cells);
  EXPECT_LT((sum.area - Vec3(0, 0, -3)).norm(), 1e-12);
  EXPECT_LT((sum.moment / 3 - Vec3(2.5 / 3, 2.5 / 3, 0)).norm(), 1e-12);
  for (const ApertureCell& cell : cells) {
    EXPECT_LE(cell.area, 0.07 * 0.07 * (1 + 1e-12));
    EXPECT_LT((cell.across.cross(cell.up) - cell.inward).norm(), 1e-12);
  }
}

TEST(CavityAperture, WithAnIslandIsTheRingBetweenTheRims) {
  // A post of 1 m square in a pit of 3 m square, as high as the rim, with a solid interior: its walls face the pit, so
  // that its rim has the opposite orientation.
  TriangleMesh mesh = pit({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {1.5, 1.5});
  const TriangleMesh post = inverted(pit({{1, 1}, {2, 1}, {2, 2}, {1, 2}}, {1.5, 1.5}));
  mesh.append(post);
  const auto cells = aperture_cells(mesh, 0.1);
  const Sum sum = sum_of(cells);
  EXPECT_LT((sum.area - Vec3(0, 0, -8)).norm(), 1e-11);
  for (const ApertureCell& cell : cells) {
    EXPECT_LT(cell.inward.z(), -0.99);  // a wave from above enters through all of them
    EXPECT_GT((cell.centre - Vec3(1.5, 1.5, 0)).cwiseAbs().maxCoeff(), 0.5 - 1e-9);
  }
}

TEST(CavityAperture, RefusesSurfacesThatAreNoCavity) {
  const auto refused = [](const TriangleMesh& mesh, const std::string& why) {
    try {
      aperture_cells(mesh, 0.01);
      FAIL() << "not refused: " << why;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
    }
  };
  refused(inverted(guide(0.3, 0.2, 0.5)), "face away from its inside");

  // Its two halves with their apertures facing each other.
  TriangleMesh closed = guide(0.3, 0.2, 0.5);
  const Mat3 half_turn(-Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ());
  closed.append(transformed(closed, half_turn, Vec3(0, 0.3, 0)));
  refused(welded(closed), "closed");

  TriangleMesh uneven = guide(0.3, 0.2, 0.5);
  uneven.vertices[2].x() = 0.05;
  refused(uneven, "not flat");

  // Two guides whose apertures have one edge or one vertex in common.
  TriangleMesh sharing = guide(0.3, 0.2, 0.5), touching = sharing;
  sharing.append(transformed(guide(0.3, 0.2, 0.5), Mat3::Identity(), Vec3(0, 0.3, 0.2)));
  refused(welded(sharing), "more than two triangles");
  const Mat3 tilt = axis_rotation(0.1, Vec3::UnitY());
  touching.append(transformed(guide(0.3, 0.2, 0.5), tilt, Vec3(0, 0.3, 0.2)));
  refused(welded(touching), "touches itself");

  TriangleMesh flipped = guide(0.3, 0.2, 0.5);
  std::swap(flipped.triangles[8][1], flipped.triangles[8][2]);
  refused(flipped, "have opposite orientation");

  MeshBuilder sheet;
  sheet.begin_part("sheet");
  sheet.quad(sheet.vertex({0, 0, 0}), sheet.vertex({0, 0, 1}), sheet.vertex({0.3, 1, 1}), sheet.vertex({0.3, 1, 0}));
  refused(sheet.take(), "enclose nothing");
}

}  // namespace
}  // namespace seaglint
