// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What moves, made ready once: a ship's sections are solved here, not for every sea.

#include <filesystem>
#include <variant>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/float/float.h"
#include "sim/motion/recorded/attitude_series.h"
#include "sim/motion/ship/rao_table.h"
#include "sim/motion/ship/ship_particulars.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// What the zero fields of a MotionSpec are derived from.
struct BodyShape {
  Bounds box;         // of the mesh
  HullSections hull;  // below its waterline; empty when the mesh ends there
};
BodyShape shape_of(const TriangleMesh& mesh);

struct Body {
  MotionSpec spec;
  std::variant<std::monostate, ShipParticulars, FloatParticulars, AttitudeSeries, RaoTable>
      model;                            // nothing moves a fixed body
  Vec3 rotation_centre = Vec3::Zero();  // in its own frame: spec.rotation_centre_m, else a ship's centre of gravity or
                                        // a float's centre of flotation
};

// Files the spec names are looked for in `folder`, then in the working directory. Throws InputError when one of them is
// missing or wrong, or the spec contradicts itself or the shape.
Body make_body(const MotionSpec& spec, const BodyShape& shape, const std::filesystem::path& folder = {});

// The sections a ship moves by: those of spec.sections, else of the mesh, both stretched to the dimensions that the
// spec gives, else those of HullCoefficients with the mesh's size.
HullSections ship_sections(const MotionSpec& spec, const BodyShape& shape, const std::filesystem::path& folder = {},
                           const HullCoefficients& form = {});

}  // namespace seaglint
