// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Hull of the generated ship: its moulded surface and its mesh.

#include "sim/geometry/mesh/mesh_builder.h"
#include "sim/geometry/ship/ship_form.h"

namespace seaglint {

// Moulded surface: u = 0 at the transom to 1 at the stem, v = 0 at the waterline to 1 at the deck.
class HullSurface {
 public:
  explicit HullSurface(const ShipForm& form) : form_(form) {}

  Vec3 side(double u, double v) const;  // port side, y >= 0
  // Height and half-breadth of the deck at body x, m.
  double deck_height(double x) const;
  double deck_half_breadth(double x) const;

  // Positions on the 144 m by 17.5 m design, scaled to this form, m.
  double x_of(double design_x) const { return design_x * form_.length_m / 144.0; }
  double y_of(double design_y) const { return design_y * form_.beam_m / 17.5; }

  const ShipForm& form() const { return form_; }

 private:
  double waterline_half_breadth(double u) const;
  double deck_half_breadth_at(double u) const;

  ShipForm form_;
};

// One closed part: plated sides, transom, deck and a lid at z = 0.
void add_hull(MeshBuilder& builder, const HullSurface& hull);

// Bulwark along the forecastle's edge with its stays.
void add_bulwark(MeshBuilder& builder, const HullSurface& hull);

}  // namespace seaglint
