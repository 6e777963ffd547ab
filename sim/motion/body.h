// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A body prepared for motion once per target: the sections of a ship are solved here, not per sea realisation.

#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/float/float.h"
#include "sim/motion/recorded/attitude_series.h"
#include "sim/motion/ship/responses.h"
#include "sim/motion/ship/ship.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Dimensions of the mesh from which zero fields of a MotionSpec are derived.
struct BodyShape {
  Bounds box;         // of the mesh
  HullSections hull;  // below its waterline; empty when the mesh ends at the waterline
  // A rigid raft of reflectors, whose mesh says nothing about its hull: box and hull are empty, zero fields that they
  // would give are errors. Its frame has its origin on the water.
  bool is_raft = false;
  std::optional<double> metacentric_height_m = {};  // GM, where the centre of gravity is known
  double main_height_m = 0;  // extent in z of nine tenths of the surface: of a ship without its masts
};
// centre_of_gravity_m: height above the waterline, if known.
BodyShape shape_of(const TriangleMesh& mesh, std::optional<double> centre_of_gravity_m = {});

// Why a hull does not have its bow along x and its masts along z, as a sentence with its length, breadth and height and
// the keys that turn it: it is broader than long, its surface is higher than broad (main_height_m), or it is symmetric
// about the plane z = 0 and not about y = 0. Empty for a hull that is none of these, and for a raft.
std::string orientation_finding(const BodyShape& shape);

struct Body {
  MotionSpec spec;
  std::variant<std::monostate, ShipParticulars, FloatParticulars, AttitudeSeries, RaoTable>
      model;  // monostate: a fixed body
  BodyShape shape;
  Vec3 rotation_centre = Vec3::Zero();  // body frame: spec.rotation_centre_m, else a ship's centre of gravity or a
                                        // float's centre of flotation
};

// Files named in the spec are searched in `folder`, then in the working directory. Throws InputError for a missing or
// invalid file and for a spec that is inconsistent in itself or with the shape.
Body make_body(const MotionSpec& spec, const BodyShape& shape, const std::filesystem::path& folder = {});

// How the file of `motion.file` was understood, for users: "FILE: 300 rows, ..." with columns, units, headings and time
// factor; empty without a file.
std::string motion_file_reading(const Body& body);

// Sections of the strip theory: those of spec.sections, else of the mesh, both scaled to the dimensions of the spec,
// else those of HullCoefficients with the size of the mesh.
HullSections ship_sections(const MotionSpec& spec, const BodyShape& shape, const std::filesystem::path& folder = {},
                           const HullCoefficients& form = {});

}  // namespace seaglint
