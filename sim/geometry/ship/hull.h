// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Moulded form of a ship's hull from the keel to the deck, and its plated mesh.

#include <cstdint>

#include "sim/geometry/mesh/triangle_mesh.h"

namespace seaglint {

// Half-breadth along the ship per its largest, at u = 0 (stern) to 1 (stem): parallel from `aft` to `fore`, forward
// 1 - ((u - fore) / (1 - fore))^fore_power, aft 1 - aft_loss ((aft - u) / aft)^aft_power.
struct PlanShape {
  double aft = 0.5, fore = 0.5;
  double aft_loss = 0.2, aft_power = 2.2;
  double fore_power = 2;

  double at(double u) const;
};

// Dimensions in metres; x from amidships, positive forward; heights above the waterline, z = 0.
struct HullLines {
  double stern_at_water = -70.6, stern_at_deck = -72;
  double stem_at_water = 64, stem_at_deck = 72;
  double stem_power = 1.25;  // rake of the stem: x from water to deck over height to this power
  double beam = 17.5;        // at the waterline
  double flare = 1.085;      // breadth of the deck over that of the waterline, amidships
  PlanShape waterline{0.48, 0.48, 0.20, 2.2, 2.0};
  PlanShape deck{0.52, 0.52, 0.16, 2.4, 2.9};
  double freeboard = 5.8, bow_height = 9.8, stern_height = 5.2;  // of the deck; parabolas fore and aft
  // Breadth from waterline to deck over height: power 1.12, in the forebody larger by `hollow`, with a knuckle there.
  double hollow = 0.75, knuckle_gain = 0.20;
  double camber = 0;    // of the deck: height of its middle over its edges amidships, per breadth there
  double panel = 1.5;   // length of a plate
  double dent = 0.004;  // largest displacement of a plate's vertex above the water
  std::uint32_t plating_key = 144;

  // Below the water; draught 0: the hull is closed at the waterline.
  double draught = 0;
  double block = 0.507;                          // volume over (length at the waterline x beam x draught)
  double midship = 0.821;                        // area of the midship section over beam x draught
  double keel_rise = 0.35, keel_rise_power = 2;  // u from which the keel rises aft; exponent
  double transom_draught = 0.1;                  // depth of the keel at the stern, per draught
  double forefoot = 1, forefoot_draught = 1;     // u from which the keel rises forward; depth at the stem, per draught
};

// Moulded surface: u = 0 at the transom to 1 at the stem, v = 0 at the waterline to 1 at the deck.
class HullSurface {
 public:
  // Throws InputError where no distribution of the sections has the block coefficient.
  explicit HullSurface(const HullLines& lines);

  Vec3 side(double u, double v) const;  // port side, y >= 0
  // Port side below the waterline: p = 0 at the waterline to 1 at the keel, nearly equal steps along the section. A
  // section at depth d of keel depth t has the half-breadth b (1 - (d/t)^n) and the area 2 b t n / (n + 1).
  Vec3 below(double u, double p) const;
  double keel_depth(double u) const;

  // Edge of the deck at body x: height and half-breadth, m.
  double deck_edge_height(double x) const;
  double deck_half_breadth(double x) const;
  // Height of the deck at body (x, y), m, and over its edge there: by the camber, one parabola for all sections.
  double deck_height(double x, double y) const { return deck_edge_height(x) + deck_rise(x, y); }
  double deck_rise(double x, double y) const;
  // u of the deck's point at body x.
  double u_at_deck(double x) const { return (x - lines_.stern_at_deck) / (lines_.stem_at_deck - lines_.stern_at_deck); }

  double length() const { return lines_.stem_at_deck - lines_.stern_at_deck; }
  const HullLines& lines() const { return lines_; }

 private:
  // Area below the waterline over breadth times depth: `midship` in the parallel part, falling towards both ends with a
  // power of the distance from it.
  double section_coefficient(double u) const;

  HullLines lines_;
  double end_power_ = 2;
};

// One closed part "hull": plated sides, transom, deck, and the underwater body or a lid at z = 0.
void add_hull(MeshBuilder& builder, const HullSurface& hull);

// Solid bulwark on the deck's edge from x = from to x = to, m, with its stays; parts bulwark_port, bulwark_starboard.
struct Bulwark {
  double from = 0, to = 0;
  int bays = 17;
  double height = 1.1;
  double aft_height = 0.25;  // at its aft end
};
void add_bulwark(MeshBuilder& builder, const HullSurface& hull, const Bulwark& bulwark);

}  // namespace seaglint
