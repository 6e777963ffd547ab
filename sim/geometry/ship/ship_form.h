// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Dimensions and detail of the generic naval combatant.

namespace seaglint {

enum class ShipDetail {
  kHull,      // hull and houses
  kFittings,  // and masts, weapons, boats, deck fittings
  kRails,     // and rails, ladders, nets
};

// Positions along and across the ship scale with length and beam; fittings keep their size.
struct ShipForm {
  double length_m = 144;        // overall, 90 <= x <= 200
  double beam_m = 17.5;         // at the waterline, 12 <= x <= 25
  double freeboard_m = 5.8;     // amidships, 4 <= x <= 9
  double bow_height_m = 9.8;    // of the deck above the water, freeboard <= x <= 14
  double stern_height_m = 5.2;  // of the deck above the water, 3 <= x <= 9
  double panel_m = 1.5;         // length of a hull plate, 0.5 <= x <= 6
  double plating_m = 0.004;     // largest displacement of a hull plate's vertex, 0 <= x <= 0.05
  double rail_width_m = 0.045;  // 0.02 <= x <= 0.1
  ShipDetail detail = ShipDetail::kRails;
};

}  // namespace seaglint
