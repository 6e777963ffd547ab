// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Values of a reference beside those of a sweep at the same directions and frequencies: directions of a file in the
// body's angles, as few grids that a sweep solves at once, and pairs.

#include <compare>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/field_tables/field_table.h"
#include "tools/rcs/rcs_request.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

struct ViewPoint {
  double frequency_hz = 0, azimuth_deg = 0, elevation_deg = 0;
  auto operator<=>(const ViewPoint&) const = default;  // NOLINT(modernize-use-nullptr): compares with 0
};

// All combinations of these values.
struct ViewGrid {
  std::vector<double> frequency_hz, azimuth_deg, elevation_deg;  // ascending
  bool operator==(const ViewGrid&) const = default;
};

// Grids that hold every point exactly once and nothing else: directions of equal frequencies, then elevations of equal
// azimuths. Points that stand repeatedly count once.
std::vector<ViewGrid> view_grids(std::span<const ViewPoint> points);

// The grid cut along its longest side, so that one variable changes in each: frequencies of each direction, or
// directions of one elevation or azimuth at all frequencies.
std::vector<ViewGrid> cuts_of(const ViewGrid& grid);

// Directions of a cut in the body's angles: azimuth = (phi - phi_offset) / phi_scale, elevation = 90 deg - theta.

double azimuth_of(const RcsCut& cut, double phi_deg);  // -180..180 deg

ViewPoint view_point(const RcsCut& cut, const FieldValue& value);

// Throws InputError with the option that states it if the cut has none.
const DeclaredTransmitter& stated_transmitter(const RcsCut& cut);

// Absent for a monostatic cut.
std::optional<FixedTransmitter> fixed_transmitter(const RcsCut& cut);

// The values of `other` at the directions (0.001 deg) and frequencies (1e-6) of `cut`, as few sweeps with one model of
// its name; the element of `other` alone is filled, about the body's origin. Without phases the amplitudes are positive
// with the level's magnitude. Empty if no place is equal.
std::vector<RcsSweep> table_sweeps(const RcsCut& cut, const RcsCut& other);

// Variable that changes along a cut.
enum class CutAxis { kAzimuth, kElevation, kFrequency, kSeveral };

const char* axis_unit(CutAxis axis);  // "deg", "GHz"

// Values of one reference at directions and frequencies of the sweep, in the sweep's order.
struct PairedCut {
  std::string reference;
  Polarisation element = Polarisation::kHh;
  bool total = false;  // levels of |S|^2 summed over both received polarisations, no phases (RcsCut)
  CutAxis axis = CutAxis::kAzimuth;
  std::optional<double> frequency_hz;  // absent if it varies along the cut
  std::string place;                   // in titles: what else is fixed along the cut; may be empty
  std::vector<double> x;               // deg or GHz; the running number when several axes vary
  std::vector<double> level_dbsm;
  std::vector<Complex> amplitude_m;  // of the reference, phase origin at the body's origin; empty without phases
  Vec3 origin_m = Vec3::Zero();      // its own, which was removed as of e^{+jwt}
  struct Place {
    std::size_t view = 0, frequency = 0;  // in the sweep
    double frequency_hz = 0, azimuth_deg = 0, elevation_deg = 0;
    Vec3 path_gradient = Vec3::Zero();  // k (r^_t + r^_s), rad/m
    int line = 0;                       // of the reference's file
  };
  std::vector<Place> places;
  struct Model {
    std::string name;
    std::vector<double> level_dbsm;
    std::vector<Complex> amplitude_m;
  };
  std::vector<Model> models;
  std::optional<Model> flat;  // the last model with flat facets, where the sweep has it
  // Exact or closed-form levels of a recognised body, NaN at places to which none applies; without amplitudes.
  std::optional<Model> known = {};

  std::size_t quantity() const { return quantity_of(element, total); }
};

// Matches directions within 0.001 deg and frequencies within a relative 1e-6; nothing is interpolated. One cut per
// frequency, or a single cut if there is one direction; none without a match. Throws InputError if the reference
// declares another transmitter direction than the sweep's.
std::vector<PairedCut> paired_cuts(const RcsSweep& sweep, const RcsCut& reference);

// The same; throws InputError if nothing matches, naming the content of both.
std::vector<PairedCut> match_reference(const RcsSweep& sweep, const RcsCut& reference);

// Fills the cut's models from the sweep that it was matched with, once that is computed.
void set_models(PairedCut& cut, const RcsSweep& sweep);

}  // namespace seaglint
