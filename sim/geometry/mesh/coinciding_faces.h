// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sheets that are drawn from both sides: faces of opposite orientation in one place, however either side is cut into
// triangles.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

struct FaceOverlap {
  std::uint32_t a, b;  // triangles of opposite orientation
  double area;         // m^2
};

struct CoincidingFaces {
  std::vector<std::uint32_t> backs;  // triangles that others of opposite orientation cover: one sheet without them
  double backs_m2 = 0;               // their area
  std::size_t partly = 0;            // triangles that are left and overlap others of their material in part
  double partly_m2 = 0;              // area of the overlaps
  std::vector<FaceOverlap> unlike;   // those of different materials
  std::vector<std::uint32_t> all;    // every triangle that overlaps another, ascending
  bool is_crowded = false;           // too many triangles in one place: nothing was found
};

// What two overlapping triangles of one material are.
enum class Coincidence : std::uint8_t {
  kSheet,          // both sides of one sheet
  kBodies,         // faces of two closed bodies in contact, which stay
  kSheetOnBody,    // the first belongs to an open surface, the second to a closed body: it may cover the first only
  kBodyUnderSheet  // the same in the other order
};

struct CoincidenceSettings {
  std::span<const char> left_out;  // by triangle: 1 where it counts as removed; empty: none
  std::function<Coincidence(std::uint32_t, std::uint32_t)> kind;  // of every pair that overlaps
  bool quads = false;  // quads with the same corners only, which are the clearest case; else overlaps of any triangles
};

// Triangles overlap where they are within 1e-6 of half the mesh's diagonal of a common plane; those of two quads, which
// need not be plane, where the quads have the same corners and different diagonals. Of the two sides of a connected
// overlap the one with the first triangle is kept if it covers the other side, else the other one if that covers it; if
// neither does, all triangles stay but those that the other side covers. Triangles of open surfaces that a closed body
// covers are backs too. Time: O(n log n), where no place has hundreds of triangles.
CoincidingFaces find_coinciding_faces(const TriangleMesh& mesh, const CoincidenceSettings& settings);

}  // namespace seaglint
