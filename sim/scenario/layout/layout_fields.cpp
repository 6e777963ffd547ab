// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/layout/layout_fields.h"

namespace seaglint {

namespace {

void visit(LineLayout& layout, FieldVisitor& v) {
  v.integer("count", layout.count, within(1, kMostBodies));
  v.number("spacing_m", layout.spacing_m, above_up_to(0, 10000));
  v.number("centre_x_m", layout.centre_x_m, within(-1e5, 1e5));
  v.number("centre_y_m", layout.centre_y_m, within(-1e5, 1e5));
}

void visit(AreaLayout& layout, FieldVisitor& v) {
  visit_choice(v, "shape", layout.shape, kLayoutShapeNames);
  v.integer("count", layout.count, within(1, kMostBodies));
  v.number("length_m", layout.length_m, within(0, 10000));
  v.number("width_m", layout.width_m, within(0, 10000));
  v.number("min_distance_m", layout.min_distance_m, within(0, 10000));
  v.number("centre_x_m", layout.centre_x_m, within(-1e5, 1e5));
  v.number("centre_y_m", layout.centre_y_m, within(-1e5, 1e5));
}

void visit_range(FieldVisitor& v, const char* key, std::optional<BodyRange>& range, const char* lowest,
                 const char* highest, const Bound& bound) {
  if (!v.optional(key, range.has_value())) return;
  if (!range) range.emplace();
  v.section(key, [&](FieldVisitor& ends) {
    ends.number(lowest, range->lowest, bound);
    ends.number(highest, range->highest, bound);
  });
}

}  // namespace

void visit_layout(LayoutSpec& spec, FieldVisitor& v) {
  const bool has_area = v.optional("area", spec.area.has_value());
  if (!has_area) v.require("line");
  if (v.optional("line", spec.line.has_value())) {
    if (!spec.line) spec.line.emplace();
    v.section("line", [&](FieldVisitor& line) { visit(*spec.line, line); });
  }
  if (has_area) {
    if (!spec.area) spec.area.emplace();
    v.section("area", [&](FieldVisitor& area) { visit(*spec.area, area); });
  }
  visit_choice(v, "bodies", spec.bodies, {"independent", "rigid"});
  visit_range(v, "heights", spec.heights_m, "lowest_m", "highest_m", within(-10, 100));
  visit_range(v, "headings", spec.headings_deg, "lowest_deg", "highest_deg", within(-360, 360));
  if (v.optional("seed", spec.seed != 0)) v.natural("seed", spec.seed);
}

}  // namespace seaglint
