// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Cut of a body at the mean water surface, and the part above, as a mesh drawn to its waterline.

#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Distance from the water surface below which a vertex of a mesh with these bounds counts as in it, m.
double waterline_margin(const Bounds& box);

struct WaterlineCut {
  TriangleMesh mesh;            // the same surface; no triangle crosses the waterline
  std::vector<bool> submerged;  // one per triangle: below or in the water surface
};

// Cuts the mesh along the plane z = height, m. Triangles that share an edge are cut at the same points. Vertices closer
// to the plane than 1e-6 of its largest height or half-length count as in the plane and are not moved, so that
// rounding does not decide whether a bottom at the waterline is submerged. Parts, materials and normals
// are kept; the normals of new vertices are interpolated.
WaterlineCut cut_at_waterline(const TriangleMesh& mesh, double height);

// What of a body is below the water.
struct SubmergedPart {
  double area_m2 = 0;      // of its surface
  double depth_m = 0;      // of its lowest point; 0: nothing is below
  double waterline_m = 0;  // z of the water surface in the mesh frame
  double open_m = 0;       // length of the waterline of closed surfaces for which no lid was found
};

// "44 m^2 of its surface, down to 1 m below the water, is cut off at ..."; empty where nothing is below.
std::string cut_sentence(const SubmergedPart& part);

struct AboveWater {
  TriangleMesh mesh;
  SubmergedPart below;
};

// Removes what is below z = height, m (cut_at_waterline()), and closes closed surfaces by lids in the water surface, as
// a hull that is drawn to its waterline is closed. A lid faces down and has the part and the material of the surface
// it closes. Open surfaces get a free edge. Triangles in the water surface itself stay where they face down, as the
// bottom of a hull that ends there; those that face up are under water. A mesh with nothing below is returned
// unchanged. Surfaces must be oriented (mesh_diagnostics.h); a waterline that crosses itself, or a concave one with
// more than kMaxConcaveVertices vertices, is left open.
AboveWater above_water(const TriangleMesh& mesh, double height);

}  // namespace seaglint
