// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/ship/ship_design.h"

#include <algorithm>
#include <array>

namespace seaglint {

namespace {

struct ShipRange {
  double lowest = 0, highest = 0;

  double at(double u) const { return lowest + u * (highest - lowest); }
};

// Proportions of a kind of ship, laden, and the shape of its hull per length and beam (sim/geometry/ship/README.md has
// the sources).
struct ShipKindForm {
  ShipRange length_to_beam;  // length overall over beam at the waterline
  ShipRange beam_to_draught;
  ShipRange depth_to_draught;  // depth: keel to deck amidships
  ShipRange block;             // coefficient, on length and beam at the waterline
  ShipRange gm_to_beam;        // metacentric height over beam, laden
  double light_gm_to_beam;     // of the lightest loading
  double light_draught;        // of the lightest loading, per laden draught
  HullLines shape;             // lengths along x per length overall, breadths per beam, heights per freeboard
};

// Lines of a shape, per length overall and beam.
HullLines lines_of(double stern_at_water, double stem_at_water, const PlanShape& waterline, const PlanShape& deck) {
  HullLines lines;
  lines.stern_at_water = stern_at_water, lines.stern_at_deck = -0.5;
  lines.stem_at_water = stem_at_water, lines.stem_at_deck = 0.5;
  lines.waterline = waterline, lines.deck = deck;
  lines.beam = 1, lines.flare = 1.001;
  lines.freeboard = lines.bow_height = lines.stern_height = 1;
  lines.hollow = 0.3, lines.knuckle_gain = 0;
  lines.camber = 0.02;
  return lines;
}

HullLines frigate() {
  HullLines lines = combatant_lines(1, 1);
  for (double* height : {&lines.bow_height, &lines.stern_height, &lines.freeboard}) *height /= lines.freeboard;
  lines.midship = 0.821, lines.transom_draught = 0.08;
  lines.forefoot = 0.9, lines.forefoot_draught = 0.6;
  return lines;
}

HullLines naval(double flare, double midship) {
  HullLines lines = lines_of(-0.49, 0.45, {0.48, 0.48, 0.16, 2.2, 2.0}, {0.50, 0.52, 0.12, 2.4, 2.9});
  lines.flare = flare, lines.hollow = 0.75, lines.knuckle_gain = 0.2;
  lines.bow_height = 1.7, lines.stern_height = 0.9;
  lines.midship = midship, lines.transom_draught = 0.08;
  lines.forefoot = 0.9, lines.forefoot_draught = 0.5;
  return lines;
}

HullLines container() {
  HullLines lines = lines_of(-0.48, 0.485, {0.34, 0.56, 0.34, 2.4, 1.75}, {0.25, 0.76, 0.06, 2, 2.2});
  lines.hollow = 1.2, lines.bow_height = 1.35, lines.midship = 0.98;
  lines.keel_rise = 0.24, lines.transom_draught = 0.04, lines.keel_rise_power = 2.2;
  return lines;
}

HullLines full(double bow_height) {
  HullLines lines = lines_of(-0.485, 0.49, {0.30, 0.82, 0.60, 2.6, 2.2}, {0.24, 0.84, 0.25, 2.4, 2.4});
  lines.hollow = 0.4, lines.bow_height = bow_height, lines.midship = 0.994;
  lines.keel_rise = 0.14, lines.transom_draught = 0.05, lines.keel_rise_power = 3;
  return lines;
}

HullLines ferry() {
  HullLines lines = lines_of(-0.485, 0.465, {0.40, 0.50, 0.14, 2.2, 1.75}, {0.12, 0.72, 0.03, 2, 2.6});
  lines.hollow = 0.9, lines.bow_height = 1.25, lines.midship = 0.93, lines.flare = 1.03;
  lines.keel_rise = 0.42, lines.transom_draught = 0.04;
  return lines;
}

HullLines fishing() {
  HullLines lines = lines_of(-0.47, 0.44, {0.42, 0.50, 0.22, 2.2, 2.0}, {0.42, 0.56, 0.12, 2.2, 2.6});
  lines.hollow = 0.7, lines.bow_height = 2.6, lines.stern_height = 1.15, lines.midship = 0.86, lines.flare = 1.04;
  lines.transom_draught = 0.15, lines.forefoot = 0.85, lines.forefoot_draught = 0.6;
  return lines;
}

HullLines tug() {
  HullLines lines = lines_of(-0.47, 0.455, {0.36, 0.54, 0.18, 2.2, 2.2}, {0.36, 0.56, 0.10, 2.2, 2.6});
  lines.hollow = 0.4, lines.bow_height = 2.4, lines.stern_height = 1.0, lines.midship = 0.88, lines.flare = 1.03;
  lines.keel_rise = 0.5, lines.transom_draught = 0.15;
  lines.forefoot = 0.66, lines.forefoot_draught = 0.4;
  return lines;
}

HullLines planing(double midship, double camber) {
  HullLines lines = lines_of(-0.485, 0.43, {0.45, 0.47, 0.08, 2, 2.0}, {0.45, 0.50, 0.05, 2, 2.7});
  lines.camber = camber, lines.flare = 1.1, lines.hollow = 0.7, lines.bow_height = 1.45, lines.stern_height = 0.9;
  lines.midship = midship, lines.keel_rise = 0.45, lines.transom_draught = 0.45;
  lines.forefoot = 0.7, lines.forefoot_draught = 0.15;
  return lines;
}

// clang-format off
// in the order of ShipKind: length/beam, beam/draught, depth/draught, block, GM/beam, the same and draught when light
const std::array<ShipKindForm, 10> kForms{{
    {{8.1, 8.5}, {3.0, 3.2}, {1.95, 2.1}, {0.48, 0.53}, {0.065, 0.11}, 0.075, 0.95, frigate()},
    {{6.8, 7.6}, {3.2, 3.5}, {2.05, 2.25}, {0.45, 0.51}, {0.07, 0.12}, 0.08, 0.95, naval(1.09, 0.80)},
    {{4.8, 5.6}, {3.1, 3.7}, {2.0, 2.3}, {0.40, 0.45}, {0.13, 0.20}, 0.15, 0.95, planing(0.68, 0.02)},
    {{6.6, 7.4}, {2.8, 3.2}, {1.70, 1.85}, {0.60, 0.68}, {0.02, 0.06}, 0.09, 0.75, container()},
    {{5.5, 6.1}, {2.5, 3.0}, {1.42, 1.58}, {0.78, 0.84}, {0.08, 0.14}, 0.24, 0.5, full(1.35)},
    {{5.8, 6.4}, {2.4, 2.8}, {1.38, 1.50}, {0.79, 0.85}, {0.07, 0.13}, 0.24, 0.5, full(1.0)},
    {{3.5, 4.4}, {2.2, 2.6}, {1.30, 1.45}, {0.50, 0.58}, {0.07, 0.12}, 0.10, 0.9, fishing()},
    {{5.9, 6.6}, {3.9, 4.4}, {2.2, 2.5}, {0.54, 0.61}, {0.05, 0.10}, 0.08, 0.95, ferry()},
    {{2.7, 3.2}, {2.3, 2.7}, {1.28, 1.40}, {0.50, 0.58}, {0.12, 0.20}, 0.16, 0.9, tug()},
    {{3.3, 3.8}, {3.8, 4.5}, {1.8, 2.1}, {0.36, 0.42}, {0.36, 0.46}, 0.40, 0.95, planing(0.62, 0)},
}};
// clang-format on

}  // namespace

ShipDesign design_of(const ShipSpec& spec, Random& random) {
  const ShipKindForm& form = kForms[static_cast<std::size_t>(spec.kind)];
  // The reference ship of a kind has the middle of every range.
  const auto drawn = [&](const ShipRange& range) { return range.at(spec.seed == 0 ? 0.5 : random.uniform()); };
  ShipDesign ship;
  ship.spec = spec;
  check_ship(spec);
  const auto [shortest, longest, reference] = kShipLengths_m[static_cast<std::size_t>(spec.kind)];
  const double own_length = spec.seed == 0 ? reference : drawn({shortest, longest});
  ship.length = spec.length_m > 0 ? spec.length_m : own_length;
  ship.beam = ship.length / drawn(form.length_to_beam);
  ship.laden_draught = ship.beam / drawn(form.beam_to_draught);
  ship.depth = ship.laden_draught * drawn(form.depth_to_draught);
  const double block = drawn(form.block), laden_gm = drawn(form.gm_to_beam);
  const double own_loading = spec.seed == 0 ? 1 : random.uniform();
  ship.loading = spec.loading ? *spec.loading : own_loading;
  ship.draught = ship.laden_draught * (form.light_draught + (1 - form.light_draught) * ship.loading);
  // By the stern, up to 0.5 % of the length in the lightest loading.
  ship.trim = spec.seed == 0 ? 0 : (0.001 + 0.004 * (1 - ship.loading)) * random.uniform();
  ship.metacentric_height = ship.beam * (form.light_gm_to_beam + (laden_gm - form.light_gm_to_beam) * ship.loading);

  HullLines lines = form.shape;
  for (double* x : {&lines.stern_at_water, &lines.stern_at_deck, &lines.stem_at_water, &lines.stem_at_deck})
    *x *= ship.length;
  lines.beam *= ship.beam;
  for (double* height : {&lines.freeboard, &lines.bow_height, &lines.stern_height})
    *height *= ship.depth - ship.laden_draught;
  lines.draught = ship.laden_draught, lines.block = block;
  lines.panel = std::clamp(ship.length / 90, 0.3, 3.0);
  lines.dent = std::clamp(ship.length * 4e-5, 0.001, 0.005);
  lines.plating_key = static_cast<std::uint32_t>(random.bits());
  ship.lines = lines;
  ship.rail_width = spec.detail >= ShipDetail::kRails ? 0.045 : 0;
  return ship;
}

}  // namespace seaglint
