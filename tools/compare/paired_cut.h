// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Values of a reference beside those of a sweep at the same directions and frequencies: directions of a file in the
// body's angles, as few grids that a sweep solves at once, pairs, and values of a table at directions between its own.

#include <compare>
#include <complex>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
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

ViewPoint view_point(const RcsCut& cut, const FieldValue& value);

// Throws InputError with the option that states it if the cut has none.
const DeclaredTransmitter& stated_transmitter(const RcsCut& cut);

// Absent for a monostatic cut.
std::optional<FixedTransmitter> fixed_transmitter(const RcsCut& cut);

// The totals of the same transmitted polarisation as `total` from both elements of a table, where it has them in equal
// rows.
std::vector<RcsCut> sums_for(const RcsCut& total, const FieldTable& table);

// The values of `other` at the directions (0.001 deg) and frequencies (1e-6) of `cut`, as few sweeps with one model of
// its name; the element of `other` alone is filled, about the body's origin. Without phases the amplitudes are positive
// with the level's magnitude. Empty if no place is equal.
std::vector<RcsSweep> table_sweeps(const RcsCut& cut, const RcsCut& other);

// Variable that changes along a cut.
enum class CutAxis { kAzimuth, kElevation, kFrequency, kSeveral };

const char* axis_unit(CutAxis axis);  // "deg", "GHz"

// |S|^2 of hh, hv, vh or vv, or of a total the sum over both received polarisations, m^2 (quantity_of()).
template <class Matrix>
double squared_magnitude(const Matrix& matrix_m, std::size_t quantity) {
  const Polarisation element = element_of_quantity(quantity);
  const auto square = [&](Polarisation e) { return std::norm(Complex(matrix_m[static_cast<std::size_t>(e)])); };
  return is_total(quantity)
             ? square(element_of(false, transmits_v(element))) + square(element_of(true, transmits_v(element)))
             : square(element);
}

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
  bool has_phases() const { return !amplitude_m.empty() && !models[0].amplitude_m.empty(); }  // of both; with a model
};

// Matches directions within 0.001 deg and frequencies within a relative 1e-6; nothing is interpolated. One cut per
// frequency, or a single cut if there is one direction; none without a match. Throws InputError if the reference
// declares another transmitter direction than the sweep's.
std::vector<PairedCut> paired_cuts(const RcsSweep& sweep, const RcsCut& reference);

// The same; throws InputError if nothing matches, naming the content of both.
std::vector<PairedCut> match_reference(const RcsSweep& sweep, const RcsCut& reference);

// Fills the cut's models from the sweep that it was matched with, once that is computed.
void set_models(PairedCut& cut, const RcsSweep& sweep);

// Which places were interpolated and how well. Errors are relative to a scattering centre's own amplitude, or of levels
// alone to its power.
struct InterpolationQuality {
  double radius_m = 0;
  std::size_t interpolated = 0, omitted = 0;  // omitted: standard error above kLargestInterpolationError
  double standard_error = 0;                  // rms over all places, for centres anywhere within the radius
  double largest_error = 0;                   // of any centre within the radius, at any place
};

// Of both sets of places together.
InterpolationQuality combined(const InterpolationQuality& a, const InterpolationQuality& b);

// "interpolated at 40 directions, 2 omitted, for a target within 1.5 m of its phase origin: standard error -60 dB, at
// most -41 dB of a scattering centre".
std::string text_of(const InterpolationQuality& quality);

// -26 dB: at the mean level of a pattern 0.4 dB.
inline constexpr double kLargestInterpolationError = 0.05;

struct InterpolatedCut {
  RcsCut cut;  // in the angles and about the origin of the interpolated one; omitted places are absent
  InterpolationQuality quality;
};

// The cut at these places, each at the equal frequency of its own (1e-6), elsewhere omitted. The target is taken as
// scattering centres x with |x| <= radius_m about the cut's phase origin and constant amplitudes, S(q) = sum_n a_n
// e^{j q.x_n}, q = k (r^_t + r^_s). With centres equally dense in that sphere, values at q and q' are correlated by
// K(u) = 3 (sin u - u cos u) / u^3, u = radius |q - q'|, and the estimate of least mean-square error is w = K^-1 k
// (Wiener interpolation; Rasmussen & Williams 2006, (2.25)), of the nearest 48 values within 8 half-waves pi / radius,
// which are taken to have independent errors of 1e-4 of the mean level. Its standard error is sqrt(1 - k.w) relative to
// the mean level. Levels without phases are interpolated as powers, which hold the differences of two centres:
// twice the radius; powers below 0 become kMinLevel_dbsm. radius_m > 0, finite.
// Throws InputError with the step of angle that is needed if every place is omitted.
InterpolatedCut interpolated_cut(const RcsCut& cut, std::span<const ViewPoint> places, double radius_m, int threads);

}  // namespace seaglint
