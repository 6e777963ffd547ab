// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Picture of a mesh: orthographic projection, flat Lambert shading, dark lines at discontinuities of depth or normal;
// its outline.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// View from infinity in the direction r^ of CONVENTIONS.md, "Frames".
struct PictureView {
  double azimuth_deg = 60;
  double elevation_deg = 15;
  int width = 1600;  // pixels, 16 <= x <= 8192
  int height = 0;    // pixels; 0 = height of the mesh at this width, at most the width
};

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // row by row from the top
};

// The mesh fills the picture up to a margin of 3 %. Throws InputError for a size out of range or an empty mesh.
Picture picture_of(const TriangleMesh& mesh, const PictureView& view);

// Outline of the mesh's projection: closed lines over the components along two perpendicular unit vectors, m, each
// ended by NaN; around holes too. From samples of sample_m; pieces of less than 20 samples are left out.
std::vector<std::array<double, 2>> outline_of(const TriangleMesh& mesh, const Vec3& right, const Vec3& up,
                                              double sample_m);

std::string png_bytes(const Picture& picture);

}  // namespace seaglint
