// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hull below its waterline as breadth, draught and area of sections along its length.

#include <filesystem>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// At x (forward of the origin, m): breadth on the waterline (m), draught (m), area below the waterline (m^2).
struct HullSection {
  double x = 0;
  double breadth = 0;
  double draught = 0;
  double area = 0;
};

// Shape of the hull below the waterline; by default that of model DTMB 5415, a fast displacement hull.
struct HullCoefficients {
  double block_coefficient = 0.507;       // volume / (L B T)
  double waterplane_coefficient = 0.778;  // waterplane area / (L B)
  double midship_coefficient = 0.821;     // area of the midship section / (B T)
  double lcb = 0;                         // centre of the volume, forward of amidships, per L
  double lcf = 0;                         // centre of the waterplane, likewise
};

// Sections in the middle of `count` strips of equal length, length/count each.
struct HullSections {
  double length = 0;  // m
  std::vector<HullSection> sections;

  double beam() const;     // largest breadth
  double draught() const;  // largest
};

// Half-breadth B/2 (1 - |u|^n) with one exponent per half of the length, from coefficient and centre; areas likewise.
// Throws InputError when no such exponents exist.
HullSections sections_of_form(double length, double beam, double draught, const HullCoefficients& form, int count);

// Sections of a mesh below z = 0, by a transverse cut at each strip; empty when the mesh ends at the waterline (less
// than 2 % of its breadth below). At each depth the outermost walls count, so that holes and inner walls have no
// effect.
HullSections sections_of_mesh(const TriangleMesh& mesh, int count);

// A table `x_m,breadth_m,draught_m,area_m2` with ascending x from stern to bow, interpolated linearly. Throws
// InputError with file and line.
HullSections read_sections(const std::filesystem::path& file, int count);

// The hull scaled to these dimensions, m (0 = unchanged).
HullSections scaled_to(HullSections hull, double length, double beam, double draught);

}  // namespace seaglint
