// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/placement/hydrostatics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/geometry/placement/waterline.h"

namespace seaglint {

Hydrostatics hydrostatics_of(const TriangleMesh& mesh) {
  const WaterlineCut cut = cut_at_waterline(mesh, 0);
  const double margin = waterline_margin(bounds(mesh));
  Hydrostatics h;
  Vec3 moment = Vec3::Zero();  // int x, y, z dV
  Vec3 plane = Vec3::Zero();   // int x, y dA of the waterplane
  double plane_xx = 0, plane_yy = 0;
  double aft = 0, fore = 0, starboard = 0, port = 0;
  bool has_waterline = false;
  for (std::size_t t = 0; t < cut.mesh.triangles.size(); ++t) {
    if (!cut.submerged[t]) continue;
    const Vec3 area = area_vector(cut.mesh, t);
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = cut.mesh.vertices[cut.mesh.triangles[t][i]];
      h.draught_m = std::max(h.draught_m, -p[i].z());
      if (std::abs(p[i].z()) > margin) continue;
      aft = has_waterline ? std::min(aft, p[i].x()) : p[i].x();
      fore = has_waterline ? std::max(fore, p[i].x()) : p[i].x();
      starboard = has_waterline ? std::min(starboard, p[i].y()) : p[i].y();
      port = has_waterline ? std::max(port, p[i].y()) : p[i].y();
      has_waterline = true;
    }
    // Means over the triangle: of a product of two linear functions 1/12 (sum of products + product of sums).
    const Vec3 sum = p[0] + p[1] + p[2];
    const auto mean_product = [&](int i, int j) {
      double products = 0;
      for (const Vec3& corner : p) products += corner[i] * corner[j];
      return (products + sum[i] * sum[j]) / 12;
    };
    h.wetted_m2 += area.norm();
    h.volume_m3 += area.z() * sum.z() / 3;
    moment += area.z() * Vec3(mean_product(0, 2), mean_product(1, 2), 0.5 * mean_product(2, 2));
    h.waterplane_m2 -= area.z();
    plane -= area.z() / 3 * sum;
    plane_xx -= area.z() * mean_product(0, 0);
    plane_yy -= area.z() * mean_product(1, 1);
  }
  if (!(h.volume_m3 > 0) || !has_waterline || !(h.waterplane_m2 > 0)) return {};
  h.length_m = fore - aft;
  h.beam_m = port - starboard;
  h.flotation_x_m = plane.x() / h.waterplane_m2;
  h.buoyancy_m = moment / h.volume_m3;
  h.transverse_bm_m = (plane_yy - plane.y() * plane.y() / h.waterplane_m2) / h.volume_m3;
  h.longitudinal_bm_m = (plane_xx - plane.x() * plane.x() / h.waterplane_m2) / h.volume_m3;
  h.block_coefficient = h.volume_m3 / (h.length_m * h.beam_m * h.draught_m);
  h.waterplane_coefficient = h.waterplane_m2 / (h.length_m * h.beam_m);
  return h;
}

}  // namespace seaglint
