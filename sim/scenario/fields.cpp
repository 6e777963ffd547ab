// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// A text that is one of the names.
template <std::size_t n>
void visit_word(FieldVisitor& v, const char* key, std::string& value, const char* const (&names)[n],
                const char* meaning) {
  auto index = static_cast<std::size_t>(std::find(names, names + n, std::string_view(value)) - names);
  SEAGLINT_CHECK(index < n, fmt::format("{}: '{}'", key, value));
  v.value(key, ChoiceField{index, names}, meaning);
  value = names[index];
}

void visit_sweep(FieldVisitor& v, const char* key, Sweep& values, const Bound& bound, const char* meaning) {
  std::size_t none = 0;
  v.value(key, SweepField{values, bound, {}, none}, meaning);
}

// A sweep, or a word for a value of an enumeration after its first.
template <typename Enumeration, std::size_t n>
void visit_sweep(FieldVisitor& v, const char* key, Sweep& values, const Bound& bound, Enumeration& rule,
                 const char* const (&words)[n], const char* meaning) {
  auto word = static_cast<std::size_t>(rule);
  v.value(key, SweepField{values, bound, words, word}, meaning);
  rule = static_cast<Enumeration>(word);
}

// A key without a default: a number, the numbers of a sweep, or a text that may be absent.
void visit_given(FieldVisitor& v, const char* key, std::optional<double>& value, const Bound& bound,
                 const char* meaning) {
  if (!v.optional(key, value.has_value())) return;
  if (!value) value.emplace();
  v.number(key, *value, bound, meaning);
}

void visit_given(FieldVisitor& v, const char* key, Sweep& values, const Bound& bound, const char* meaning) {
  if (v.optional(key, !values.empty())) visit_sweep(v, key, values, bound, meaning);
}

void visit_given(FieldVisitor& v, const char* key, std::string& value, const char* meaning) {
  if (v.optional(key, !value.empty())) v.text(key, value, meaning);
}

void visit(LinkBudgetSpec& spec, FieldVisitor& v) {
  v.number("beamwidth_deg", spec.beamwidth_deg, within(0.01, 60),
           "Beamwidth of the antenna in azimuth, one way at half power.");
  v.number("peak_power_kw", spec.peak_power_kw, within(1e-6, 1e5), "Peak power.");
  v.number("antenna_gain_db", spec.antenna_gain_db, within(0, 70), "Antenna gain.");
  v.number("noise_figure_db", spec.noise_figure_db, within(0, 40), "Noise figure.");
  v.number("losses_db", spec.losses_db, within(0, 60), "System losses.");
  v.number("reference_temperature_k", spec.reference_temperature_k, within(1, 10000),
           "Temperature T0 of the noise power k T0 F per hertz.");
}

void visit(PlatformSpec& spec, FieldVisitor& v) {
  v.triple("velocity_mps", spec.velocity_mps, within(-1000, 1000),
           "Velocity of the radar in the target frame; the line of sight turns with it.");
  v.flag("motion_compensated", spec.motion_compensated,
         "The radar's own radial motion relative to the reference point is removed from the echo.");
}

void visit(RadarSpec& spec, FieldVisitor& v) {
  v.number("carrier_ghz", spec.carrier_ghz, within(0.1, 300), "Lowest carrier.");
  v.integer("hop_count", spec.carrier_count, within(1, 1024), "Number of carriers M.");
  v.number("hop_step_mhz", spec.hop_step_mhz, above(0), "Spacing of the carriers.");
  v.choice("hop_code", spec.hop_code, {"random", "balanced", "stepped", "file"},
           "Order of the carriers: random (independent from pulse to pulse), balanced (each equally often), stepped, "
           "or file.");
  visit_given(v, "hop_code_file", spec.hop_code_file,
              "Carrier number of each pulse, for hop_code: file; at least pulses numbers.");
  v.number("bandwidth_mhz", spec.bandwidth_mhz, within(0.001, 10000), "Bandwidth B of the LFM pulse.");
  v.number("pulse_width_us", spec.pulse_width_us, within(0.001, 1e6), "Duration of the pulse; shorter than pri_us.");
  v.number("sampling_mhz", spec.sampling_mhz, within(0.001, 1e6),
           "Complex sampling rate of the echo; at least bandwidth_mhz.");
  v.number("pri_us", spec.pri_us, within(0.01, 1e7), "Pulse repetition interval.");
  v.number("pri_jitter_us", spec.pri_jitter_us, within(0, 1e7),
           "Uniform jitter of the pulses' times within +- this; the first pulse has none.");
  v.integer("pulses", spec.pulses, within(1, kMaxPulses), "Pulses N of one coherent interval, one map.");
  v.choice("polarisation", spec.polarisation, {"hh", "hv", "vh", "vv"}, "Received, then transmitted polarisation.");
  v.flag("intra_pulse_motion", spec.intra_pulse_motion,
         "Doppler within the pulse (range-Doppler coupling of the LFM pulse), in echo and map; with points as targets "
         "only.");
  v.number("range_km", spec.range_km, within(0.1, 1000),
           "Range to the target's reference point: for the link budget and the motion of the radar.");
  v.section("link_budget", spec.link_budget, visit, "Quantities of the radar equation, for absolute levels.");
  v.section("platform", spec.platform, visit, "Motion of the radar relative to the target's reference point.");
}

void visit(ViewSpec& spec, FieldVisitor& v) {
  visit_sweep(
      v, "azimuth_deg", spec.azimuth_deg, within(-360, 360),
      "Azimuth of the direction to the radar, target frame: 0 ahead of the bow, counter-clockwise seen from above.");
  visit_sweep(v, "elevation_deg", spec.elevation_deg, within(-90, 90), "Elevation of the radar seen from the target.");
}

void visit(SpreadingSpec& spec, FieldVisitor& v) {
  v.choice("kind", spec.kind, {"none", "cos2s", "mitsuyasu", "wrapped_normal"},
           "Directional spreading: none (long-crested), cos^2s, Mitsuyasu (s depends on frequency), wrapped normal.");
  v.number("s", spec.s, above_up_to(0, 200), "Exponent s of cos2s, of mitsuyasu at the peak.");
  v.number("width_deg", spec.width_deg, above_up_to(0, 180), "Standard deviation of wrapped_normal.");
}

void visit(WindSpec& spec, FieldVisitor& v) {
  v.number("speed_mps", spec.speed_mps, within(1, 60),
           "Wind speed 10 m above the water, for peak_period_s: wind_and_fetch.");
  v.number("fetch_km", spec.fetch_km, within(0.1, 5000), "Fetch, for peak_period_s: wind_and_fetch.");
}

// The energy of lower waves would underflow.
constexpr Bound kWaveHeights = zero_or_within(1e-6, 30);

constexpr Bound kPeakPeriods = within(0.5, 40), kMeanPeriods = within(0.3, 40), kDirections = within(-360, 360);

void visit(SwellSpec& spec, FieldVisitor& v) {
  v.number("significant_wave_height_m", spec.significant_wave_height_m, kWaveHeights,
           "Significant wave height of the swell, a second wave system; 0: none.");
  if (v.optional("peak_period_s", !spec.energy_period_s && !spec.zero_crossing_period_s))
    v.number("peak_period_s", spec.peak_period_s, kPeakPeriods, "Peak period of the swell.");
  visit_given(v, "energy_period_s", spec.energy_period_s, kMeanPeriods,
              "In the place of its peak_period_s: energy period Te.");
  visit_given(v, "zero_crossing_period_s", spec.zero_crossing_period_s, kMeanPeriods,
              "In the place of its peak_period_s: mean zero-crossing period Tz.");
  v.number("gamma", spec.gamma, within(1, 20), "Peak enhancement of the swell's JONSWAP spectrum.");
  if (v.optional("propagation_deg", !spec.coming_from_deg))
    v.number("propagation_deg", spec.propagation_deg, kDirections,
             "Direction that the swell travels towards, target frame.");
  visit_given(v, "coming_from_deg", spec.coming_from_deg, kDirections,
              "In the place of its propagation_deg: direction that the swell comes from, target frame.");
  v.integer("components", spec.components, within(1, 100000), "Wave components of the swell.");
  v.section("spreading", spec.spreading, visit, "Directional spreading of the swell.");
}

void visit(SeaSpec& spec, FieldVisitor& v) {
  // A table replaces peak period and shape; Bretschneider's spectrum has gamma 1.
  v.choice("spectrum", spec.spectrum, {"jonswap", "bretschneider", "table"},
           "Wave spectrum: JONSWAP, Bretschneider (JONSWAP of gamma 1), or a table.");
  visit_given(v, "table", spec.table, "File of the spectrum, for spectrum: table.");
  visit_given(v, "table_time", spec.table_time,
              "Time of the spectrum in a file of several, as 2018-01-01 00:40, for spectrum: table.");
  const bool is_scatter = !spec.scatter_diagram.empty();
  visit_given(v, "scatter_diagram", spec.scatter_diagram,
              "Table of counts by wave height and peak period: each sea realisation has a pair of both, drawn by the "
              "counts.");
  if (v.optional("significant_wave_height_m", !is_scatter)) {
    visit_sweep(v, "significant_wave_height_m", spec.significant_wave_height_m, kWaveHeights, spec.height_rule,
                {"from_table"}, "Significant wave height Hs of the wind sea; from_table: the energy of the table.");
  }
  visit_given(v, "steepness", spec.steepness, within(1e-4, 0.14),
              "Steepness 2 pi Hs / (g Tp^2) in the place of peak_period_s, with the deep-water wavelength.");
  const bool follows =
      !spec.energy_period_s.empty() || !spec.zero_crossing_period_s.empty() || !spec.steepness.empty() || is_scatter;
  if (v.optional("peak_period_s", spec.spectrum != SpectrumKind::kTable && !follows)) {
    visit_sweep(v, "peak_period_s", spec.peak_period_s, kPeakPeriods, spec.period_rule,
                {"dnv_wind_sea", "wind_and_fetch"},
                "Peak period Tp; dnv_wind_sea: 3.96 sqrt(Hs); wind_and_fetch: from the section wind.");
  }
  const auto mean_period = [&](const char* key, Sweep& periods, const char* meaning) {
    if (v.optional(key, !periods.empty() && !is_scatter)) visit_sweep(v, key, periods, kMeanPeriods, meaning);
  };
  mean_period("energy_period_s", spec.energy_period_s,
              "In the place of peak_period_s: energy period Te = 2 pi m_-1 / m_0 of the whole spectrum.");
  mean_period(
      "zero_crossing_period_s", spec.zero_crossing_period_s,
      "In the place of peak_period_s: mean zero-crossing period Tz = 2 pi sqrt(m_0 / m_2) of the whole spectrum.");
  if (v.optional("wind", spec.period_rule == PeakPeriod::kWindAndFetch))
    v.section("wind", spec.wind, visit, "Wind of peak_period_s: wind_and_fetch (Hasselmann et al. 1973).");
  if (v.optional("gamma", spec.spectrum == SpectrumKind::kJonswap)) {
    visit_sweep(v, "gamma", spec.gamma, within(1, 20), spec.gamma_rule, {"dnv_rule"},
                "Peak enhancement of JONSWAP; dnv_rule: from Tp / sqrt(Hs) by DNV-RP-C205.");
  }
  if (v.optional("normalisation", spec.spectrum == SpectrumKind::kJonswap)) {
    v.choice("normalisation", spec.normalisation, {"exact", "dnv"},
             "exact: the density integrates to Hs^2 / 16; dnv: factor 1 - 0.287 ln gamma of DNV-RP-C205.");
  }
  if (v.optional("propagation_deg", spec.coming_from_deg.empty()))
    visit_sweep(v, "propagation_deg", spec.propagation_deg, kDirections,
                "Direction that the waves travel towards, target frame: 0 following sea, 180 head sea.");
  visit_given(
      v, "coming_from_deg", spec.coming_from_deg, kDirections,
      "In the place of propagation_deg: direction that the waves come from, target frame: 0 from ahead of the bow.");
  v.section("spreading", spec.spreading, visit, "Directional spreading of the wind sea.");
  v.section("swell", spec.swell, visit, "Swell: a second wave system.");
  visit_given(v, "depth_m", spec.depth_m, within(0.5, 12000), "Water depth; default: deep water.");
  v.choice("amplitude", spec.amplitude, {"fixed", "random"},
           "Amplitudes of the components: fixed by the spectrum with random phases, or random (Rayleigh) too.");
  v.integer("order", spec.order, within(1, 2), "1: linear waves; 2: with sum and difference waves of second order.");
  v.integer("components", spec.components, within(1, 100000), "Wave components of the wind sea.");
  v.number("cutoff_rad_s", spec.cutoff_rad_s, within(0, 100),
           "Highest linear component; 0: the larger of 8 and 4 wp. It sets the slope that floats respond to.");
  v.number("second_order_cutoff_rad_s", spec.second_order_cutoff_rad_s, within(0, 1000),
           "Highest component in the quadratic sums; 0: where k Hs = 2.");
}

void visit(SeaReflectionSpec& spec, FieldVisitor& v) {
  v.flag("enabled", spec.enabled, "Specular reflection by the mean sea surface between radar and target (four paths).");
  v.choice("surface", spec.surface, {"sea_water", "conductor"},
           "Sea water (double Debye permittivity) or a perfect conductor.");
  v.number("temperature_c", spec.temperature_c, within(-2, 29), "Temperature of the water.");
  v.number("salinity_psu", spec.salinity_psu, within(0, 40), "Salinity of the sea water.");
  v.choice("roughness", spec.roughness, {"miller_brown_vegh", "ament", "none"},
           "Coherent loss by roughness: Miller, Brown and Vegh; Ament; or none.");
  v.choice("paths", spec.paths, {"all", "direct_only", "multipath_only"},
           "All four paths, the direct one alone, or only those by the sea surface.");
  v.choice("surface_profile", spec.surface_profile, {"mean", "waves"},
           "Surface between radar and target: the mean plane, or the waves of the sea realisation with shadowing, "
           "diffraction and multipath.");
}

void visit(LineLayout& layout, FieldVisitor& v) {
  v.integer("count", layout.count, within(1, kMostBodies),
            "Number of equal bodies in a line along x of the target frame.");
  v.number("spacing_m", layout.spacing_m, above_up_to(0, 10000), "Spacing of the bodies.");
  v.number("centre_x_m", layout.centre_x_m, within(-1e5, 1e5), "Centre of the line, target frame.");
  v.number("centre_y_m", layout.centre_y_m, within(-1e5, 1e5), "Centre of the line, target frame.");
}

void visit(AreaLayout& layout, FieldVisitor& v) {
  v.choice("shape", layout.shape, kLayoutShapeNames,
           "In place of line, bodies over an area: line along x; ring (an ellipse); grid, row by row; random places.");
  v.integer("count", layout.count, within(1, kMostBodies), "Number of equal bodies.");
  v.number("length_m", layout.length_m, within(0, 10000), "Length of the area along x of the target frame.");
  v.number("width_m", layout.width_m, within(0, 10000), "Width of the area along y; without effect on a line.");
  v.number("min_distance_m", layout.min_distance_m, within(0, 10000), "Least distance between any two bodies.");
  v.number("centre_x_m", layout.centre_x_m, within(-1e5, 1e5), "Centre of the area, target frame.");
  v.number("centre_y_m", layout.centre_y_m, within(-1e5, 1e5), "Centre of the area, target frame.");
}

// A range that is drawn from for every body: its key with a meaning, and those of its ends.
struct RangeKeys {
  const char *key, *meaning;
  const char *lowest, *lowest_meaning;
  const char *highest, *highest_meaning;
};

void visit_range(FieldVisitor& v, const RangeKeys& keys, std::optional<BodyRange>& range, const Bound& bound,
                 const BodyRange& standard) {
  if (!v.optional(keys.key, range.has_value())) return;
  if (!range) range = standard;
  v.section(
      keys.key,
      [&](FieldVisitor& ends) {
        ends.number(keys.lowest, range->lowest, bound, keys.lowest_meaning);
        ends.number(keys.highest, range->highest, bound, keys.highest_meaning);
      },
      keys.meaning);
}

void visit(LayoutSpec& spec, FieldVisitor& v) {
  const bool has_area = v.optional("area", spec.area.has_value());
  if (!has_area) v.require("line");
  if (v.optional("line", spec.line.has_value())) {
    if (!spec.line) spec.line.emplace();
    v.section("line", *spec.line, visit, "Bodies at equal spacings along x of the target frame.");
  }
  if (has_area) {
    if (!spec.area) spec.area.emplace();
    v.section("area", *spec.area, visit, "In the place of line: a given number of bodies over an area.");
  }
  v.choice("bodies", spec.bodies, {"independent", "rigid"},
           "independent: each body has the target's motion by itself; rigid: all are fixed to one raft, which has it.");
  visit_range(v,
              {"heights", "Heights of the bodies.", "lowest_m",
               "Lowest height of a body above that of motion.origin_above_waterline_m, fixed to what moves it.",
               "highest_m", "Highest height; each body's is uniform between both."},
              spec.heights_m, within(-10, 100), {});
  visit_range(
      v,
      {"headings", "Headings of the bodies at rest.", "lowest_deg", "Lowest angle by which a body is turned about z.",
       "highest_deg", "Highest angle; each body's is uniform between both."},
      spec.headings_deg, within(-360, 360), {});
  visit_range(
      v,
      {"scales", "Sizes of the bodies.", "lowest", "Smallest factor by which a body's mesh is enlarged, beside scale.",
       "highest", "Largest factor; each body's is uniform between both."},
      spec.scales, within(1e-3, 1e3), {1, 1});
  if (v.optional("jitter_m", spec.jitter_m != 0))
    v.number("jitter_m", spec.jitter_m, within(0, 1000),
             "Standard deviation of each body's displacement from its place, in x and in y; default: 0.");
  visit_given(v, "tether_slack", spec.tether_slack, within(0, 10),
              "Ropes between the neighbours of a line of floats with translations, longer than the spacing by this "
              "fraction of it; default: no ropes.");
  if (v.optional("seed", spec.seed != 0))
    v.value("seed", NaturalField{spec.seed},
            "Seed of random places, heights, headings, scales and jitter; integers(0 1000000): one per sea.");
}

void visit(DriftSpec& spec, FieldVisitor& v) {
  v.number("wind_mps", spec.wind_mps, within(0, 60), "Wind speed 10 m above the water.");
  v.number("wind_towards_deg", spec.wind_towards_deg, kDirections,
           "Direction that the wind blows towards, target frame.");
  v.number("leeway", spec.leeway, within(0, 0.2), "Drift through the water over the wind speed.");
  v.number("current_mps", spec.current_mps, within(0, 5), "Speed of the current.");
  v.number("current_towards_deg", spec.current_towards_deg, kDirections,
           "Direction that the current flows towards, target frame.");
  v.number("spread_mps", spec.spread_mps, within(0, 2),
           "Standard deviation of each body's own velocity, in x and in y; one per sea.");
}

void visit(MotionSpec& spec, FieldVisitor& v) {
  v.choice("model", spec.model, kMotionModelNames,
           "fixed; ship (strip theory); float; series (recorded motion) or rao (recorded response operators) of file.");
  v.flag("translations", spec.translations, "Surge, sway and heave beside the rotations.");
  if (v.optional("rotation_centre_m", spec.rotation_centre_m.has_value())) {
    if (!spec.rotation_centre_m) spec.rotation_centre_m.emplace();
    v.triple("rotation_centre_m", *spec.rotation_centre_m, within(-1000, 1000),
             "Centre of rotation, body frame (of a raft: from the centre of the layout on the water); default: centre "
             "of gravity of a ship, of flotation of a float.");
  }
  v.number("roll_period_s", spec.roll_period_s, zero_or_within(0.2, 60),
           "Natural roll period; 0: from the size of the body.");
  v.number("pitch_period_s", spec.pitch_period_s, zero_or_within(0.2, 60),
           "Natural pitch period; 0: from the size of the body.");
  v.number("yaw_period_s", spec.yaw_period_s, zero_or_within(0.2, 1000),
           "Period of course keeping or of a mooring spring; 0: free.");
  v.number("roll_damping", spec.roll_damping, within(0, 2),
           "Ratio of the roll damping to critical; 0: from the size of the body.");
  v.number("roll_quadratic_damping", spec.roll_quadratic_damping, within(0, 100),
           "Coefficient b of quadratic damping b |x'| x', 1/rad.");
  v.number("pitch_damping", spec.pitch_damping, within(0, 2),
           "Ratio of the pitch damping to critical; 0: from the size of the body.");
  v.number("yaw_damping", spec.yaw_damping, within(0, 2), "Ratio of the yaw damping to critical at yaw_period_s.");
  v.number("yaw_rate_std_deg_s", spec.yaw_rate_std_deg_s, within(0, 180),
           "Standard deviation of a float's slow random yaw rate.");
  v.number("length_m", spec.length_m, within(0, 1000),
           "Waterline length; 0: that of the mesh (a rigid raft needs it).");
  v.number("beam_m", spec.beam_m, within(0, 200), "Waterline beam; 0: that of the mesh (a rigid raft needs it).");
  v.number("draught_m", spec.draught_m, within(0, 50), "Draught; 0: of a ship from its size, of a float negligible.");
  v.number("heave_period_s", spec.heave_period_s, zero_or_within(0.2, 60),
           "Natural heave period of a float; 0: from its size.");
  v.number("heave_damping", spec.heave_damping, within(0, 2),
           "Ratio of a float's heave damping to critical; 0: from its size.");
  v.number("effective_slope", spec.effective_slope, within(0, 1),
           "Effective wave slope coefficient of a float: tilt over the slope of long waves; below 1 where a mooring or "
           "a weight on a line holds it upright.");
  v.number("metacentric_height_m", spec.metacentric_height_m, zero_or_within(0.01, 20),
           "Transverse metacentric height of a ship; 0: of a generated ship from its mesh and loading, else 1.95.");
  v.number("roll_gyradius_m", spec.roll_gyradius_m, within(0, 100),
           "Radius of gyration in roll about the centre of gravity; 0: from roll_period_s.");
  v.number("pitch_gyradius_m", spec.pitch_gyradius_m, within(0, 500),
           "Radius of gyration in pitch; 0: from the length.");
  v.number("yaw_gyradius_m", spec.yaw_gyradius_m, within(0, 500), "Radius of gyration in yaw; 0: from the length.");
  v.number("speed_mps", spec.speed_mps, within(0, 40), "Forward speed, of models ship, rao and series.");
  if (v.optional("drift", spec.drift.has_value())) {
    if (!spec.drift) spec.drift.emplace();
    v.section("drift", *spec.drift, visit,
              "Drift of floats by wind and current, from their places at the start of every interval.");
  }
  visit_given(v, "file", spec.file, "File of model series (attitude over time) or rao (response operators).");
  v.number("series_start_s", spec.series_start_s, within(-1e10, 1e10), "Time in the series that is t = 0.");
  v.choice("heading", spec.heading, {"auto", "keep", "remove"},
           "Mean yaw of a series: auto removes one beyond 5 deg, the frame T having the mean heading; keep; remove.");
  v.choice(
      "position", spec.position, {"auto", "keep", "remove"},
      "Mean translations of a series: auto removes surge and sway beyond 100 m and heave beyond 10 m; keep; remove.");
  v.number("rao_scale", spec.rao_scale, above_up_to(0, 1e6),
           "Factor of all responses of a table of model rao: 2 for those per wave height.");
  v.number("rao_phase_deg", spec.rao_phase_deg, within(-360, 360),
           "Added to the phase of all responses of a table, time factor e^{+iwt}.");
  v.choice("rao_rotations", spec.rao_rotations, {"radians", "degrees", "slope", "slope_degrees"},
           "Rotations of a table: radians or degrees per metre of amplitude, or per slope of the wave in deep water.");
  v.flag("rao_follows_long_waves", spec.rao_follows_long_waves,
         "The body of a table is free: in long waves it heaves by 1 and turns by their slope, which is checked; false "
         "for a restrained body.");
  v.number("wamit_ulen_m", spec.wamit_ulen_m, above_up_to(0, 1000),
           "Length ULEN by which a WAMIT table is non-dimensional.");
  v.integer("wamit_body", spec.wamit_body, within(0, 100),
            "Body of a WAMIT run of several: 2 has the modes 7 to 12; 0: the table has one body.");
  v.triple("wamit_xbody_m", spec.wamit_xbody_m, within(-1e5, 1e5),
           "Origin of that body in the run, whose origin is the reference of the waves' phase (XBODY).");
  v.choice("wamit_first_column", spec.wamit_first_column, {"period", "omega"},
           "First column of a WAMIT table: period, s, or omega, rad/s.");
  v.choice("wamit_heading", spec.wamit_heading, {"towards", "from"},
           "Wave headings of a WAMIT table: the direction that waves travel towards, or come from.");
  v.choice("wamit_time_factor", spec.wamit_time_factor, {"plus", "minus"},
           "Time factor of a WAMIT table: e^{+iwt} (plus) or e^{-iwt}.");
  visit_given(v, "sections", spec.sections,
              "File of a ship's sections below the waterline; default: those of the mesh, else a parametric form.");
  v.number("diameter_m", spec.diameter_m, within(0, 50),
           "Diameter of a float's waterplane; 0: from the mesh (a rigid raft needs it).");
  v.number("origin_above_waterline_m", spec.origin_above_waterline_m, within(-10, 50),
           "Height of a float's mesh origin above its centre of flotation, of the reflectors of a moving rigid raft "
           "above its waterline.");
  v.choice("waves", spec.waves, {"same_field", "independent"},
           "Bodies of a layout in one wave field, or each in a realisation of its own.");
  v.number("step_s", spec.step_s, within(0.001, 0.1),
           "Time step of integration and of samples; at most an eighth of the shortest natural period.");
  v.number("spin_up_s", spec.spin_up_s, within(0, 3600), "Time simulated before t = 0.");
}

void visit(ShipSpec& spec, FieldVisitor& v) {
  v.require("kind");
  v.choice("kind", spec.kind, kShipKindNames, "Kind of ship.");
  v.number("length_m", spec.length_m, zero_or_within(3, 500),
           "Length overall, within the range of the kind; 0: that of its reference ship for seed 0, else by the seed.");
  visit_given(v, "loading", spec.loading, within(0, 1),
              "From the lightest loading, 0, to laden, 1; default: laden for seed 0, else by the seed.");
  v.choice("detail", spec.detail, kShipDetailNames,
           "hull (with houses), fittings (and masts, cargo gear, boats), rails (all).");
  v.value("seed", NaturalField{spec.seed},
          "Individual ship of its kind: proportions, loading, trim, fittings; 0: the reference ship; "
          "integers(1 1000000): one per sea.");
}

void visit(DecoySpec& spec, FieldVisitor& v) {
  v.require("kind");
  v.choice("kind", spec.kind, kDecoyKindNames,
           "icosahedral (20 trihedra), octahedral (8), trihedral_cluster (a ring of them), trihedral, dihedral or "
           "luneburg_lens (with a metal cap).");
  v.number("leg_m", spec.leg_m, within(0.05, 5), "Leg of a trihedron; side of a dihedral's faces; radius of a lens.");
  v.choice("panel", spec.panel, kDecoyPanelNames, "Panels of an octahedral or trihedral reflector.");
  v.choice("pose", spec.pose, kDecoyPoseNames,
           "Octahedral: rain_catcher, one trihedron upwards, or point_up, one corner upwards.");
  v.integer("cells", spec.cells, within(3, 12), "Trihedra of a trihedral_cluster.");
  v.number("boresight_elevation_deg", spec.boresight_elevation_deg, within(-45, 45),
           "Elevation of the boresights of a trihedral_cluster, a trihedral, a dihedral or a lens.");
  v.number("cap_half_angle_deg", spec.cap_half_angle_deg, within(20, 90),
           "Lens: half angle of its metal cap, seen from its centre.");
  v.number("lens_loss_db", spec.lens_loss_db, within(0, 10), "Lens: loss of its dielectric, both ways.");
  v.number("angle_error_deg", spec.angle_error_deg, within(0, 5), "Standard deviation of every right angle.");
  if (v.optional("seam_errors_deg", spec.seam_errors_deg != DecoySpec().seam_errors_deg))
    v.triple("seam_errors_deg", spec.seam_errors_deg, within(-10, 10),
             "Trihedral: error of the right angle at each seam; starboard, port, upper.");
  v.number("surface_error_mm", spec.surface_error_mm, within(0, 100),
           "Root mean square of a panel's displacement, at most leg / 50.");
  v.number("rounding_mm", spec.rounding_mm, zero_or_within(0.1, 1000),
           "Radius of the seams, of the tubes if inflatable, at most leg / 5; 0: sharp.");
  v.flag("inflatable", spec.inflatable, "Tubes along the outer edges.");
  v.integer("missing_panels", spec.missing_panels, within(0, 60), "Panels missing, at random.");
  v.integer("dented_panels", spec.dented_panels, within(0, 60), "Panels with a dent, at random.");
  v.number("dent_depth", spec.dent_depth, above_up_to(0, 0.2), "Depth of a dent over the leg.");
  v.number("frame_mm", spec.frame_mm, zero_or_within(0.1, 500), "Width of bars along the outer edges; 0: none.");
  v.choice("support", spec.support, kDecoySupportNames,
           "none; float with a mast; raft, an inflatable ring; tow, a float with its line. The reflector is "
           "motion.origin_above_waterline_m above the water.");
  v.choice("float_shape", spec.float_shape, kDecoyFloatNames, "Shape of the float, of supports float and tow.");
  v.number("float_m", spec.float_m, zero_or_within(0.05, 20), "Diameter of float or raft; 0: by the leg.");
  v.number("tether_m", spec.tether_m, within(0, 100), "Length of the line above the water.");
  v.value("seed", NaturalField{spec.seed},
          "Seed of all imperfections; integers(1 1000000): others in every sea. Each body of a layout has its own.");
}

void visit(SolverSpec& spec, FieldVisitor& v) {
  v.choice("method", spec.method, kSolverMethodNames,
           "How the reflectors of every path are found: beams, exact on flat panels; rays, shooting and bouncing.");
  v.number("ray_spacing_m", spec.ray_spacing_m, zero_or_within(1e-5, 1),
           "Distance between rays, for method: rays; 0: from the size of the target.");
  v.number("min_patch_m", spec.min_patch_m, zero_or_within(5e-5, 1),
           "Side of the smallest illuminated patch that is kept; 0: from the size of each body.");
  v.integer("max_bounces", spec.max_bounces, within(1, kMaxBounces), "Largest number of bounces.");
  v.number("max_aspect_change_deg", spec.max_aspect_change_deg, zero_or_within(0.001, 5),
           "Change of aspect that one trace serves; 0: from wavelength and size.");
  v.value("crease_deg", NumberOrAutoField{spec.crease_deg, within(0, 60)},
          "Adjacent facets whose normals differ by less form a smooth surface; 0: all flat; auto: from the mesh's "
          "normals or its shape, finer facets than its curvature requires merged.");
  v.flag("edges", spec.edges, "Edge diffraction.");
  v.number("wavefront_range_m", spec.wavefront_range_m, zero_or_within(100, 1e7),
           "Range of the curvature of the wavefront; 0: plane wave.");
}

void visit(PointSpec& spec, FieldVisitor& v) {
  v.require("position_m");
  v.triple("position_m", spec.position_m, within(-100000, 100000),
           "Position of an ideal point scatterer, target frame.");
  v.number("amplitude_m", spec.amplitude_m, above_up_to(0, 1e6), "Its scattering amplitude |S|: sigma = 4 pi |S|^2.");
  v.triple("velocity_mps", spec.velocity_mps, within(-10000, 10000), "Its velocity, target frame.");
}

void visit(PartMaterialSpec& spec, FieldVisitor& v) {
  v.require("part");
  v.text("part", spec.part,
         "Name of a part, or of a material of the mesh's file where no part has it; a trailing * selects all with that "
         "prefix; later entries take precedence.");
  v.require("material");
  v.text("material", spec.material, "Material of these parts.");
}

void visit(CompanionSpec& spec, FieldVisitor& v) {
  v.require("target");
  v.text("target", spec.target, "Another target in the same sea and maps; its label is ignored there.");
  v.number("x_m", spec.x_m, within(-1e5, 1e5),
           "Position of its reference point at the start of every interval, target frame.");
  v.number("y_m", spec.y_m, within(-1e5, 1e5),
           "Position of its reference point at the start of every interval, target frame.");
  if (v.optional("towed", spec.towed))
    v.flag("towed", spec.towed,
           "It moves with the target that it accompanies, and meets the waves at that speed; default: false, it stays "
           "in the water.");
}

// A mesh with its motion, or ideal points; fields of a mesh are not written for points.
void visit(TargetSpec& spec, FieldVisitor& v) {
  v.choice("role", spec.role, {"class", "part"},
           "class: has samples of its own; part: only a companion of other targets, without label and samples.");
  const bool is_class = spec.role == TargetRole::kClass;
  if (is_class) v.require("label", false);
  if (v.optional("label", is_class))
    v.integer("label", spec.label, within(0, kMaxClasses - 1),
              "Class: index into dataset.classes, by default 0 = array, 1 = ship; required of every class.");
  if (!is_class) spec.label = 0;  // of a part without effect
  v.list("points", spec.points, 10000, visit, "Ideal point scatterers in the place of a mesh.");
  visit_given(v, "mesh", spec.mesh,
              "Mesh file, searched in the scenario's folder, the working directory, then the program's data.");
  if (v.optional("ship", spec.ship.has_value())) {
    if (!spec.ship) spec.ship.emplace();
    v.section("ship", *spec.ship, visit, "Generated ship in the place of a mesh file.");
  }
  if (v.optional("decoy", spec.decoy.has_value())) {
    if (!spec.decoy) spec.decoy.emplace();
    v.section("decoy", *spec.decoy, visit, "Generated decoy in the place of a mesh file.");
  }
  const bool is_mesh = spec.points.empty(), is_file = is_mesh && !is_generated(spec);
  if (v.optional("unit", is_file))
    visit_word(v, "unit", spec.unit, {"m", "cm", "mm", "km", "in", "ft"}, "Unit of the mesh file.");
  if (v.optional("scale", is_mesh))
    v.number("scale", spec.scale, within(1e-3, 1e3),
             "Factor by which the mesh is enlarged about its origin; lengths that keys of motion give stay "
             "as they are.");
  const MeshPlacement standard;
  if (v.optional("orientation", spec.forward != standard.forward || spec.up != standard.up)) {
    v.section(
        "orientation",
        [&](FieldVisitor& orientation) {
          visit_word(orientation, "forward", spec.forward, kMeshAxes,
                     "Axis of the mesh file that points forward, +x (default), -x, +y, -y, +z or -z; becomes +x, "
                     "before unit and scale.");
          visit_word(orientation, "up", spec.up, kMeshAxes,
                     "Axis of the mesh file that points up, default +z; perpendicular to forward.");
        },
        "Axes of the mesh file that are forward and up.");
  }
  if (v.optional("offset_m", spec.offset_m != standard.offset_m))
    v.triple("offset_m", spec.offset_m, within(-1e4, 1e4),
             "Translation of the turned and enlarged mesh: the waterline belongs at z = 0, the reference point at the "
             "origin.");
  if (v.optional("material", is_mesh))
    v.text("material", spec.material,
           "Material: pec, a name of assets/materials, or a material file. With pec, faces that no part_materials "
           "match have the material that the mesh names, if assets/materials has it.");
  v.list("part_materials", spec.part_materials, 1000, visit,
         "Materials of parts of the mesh, or of its own materials; later entries take precedence; part '*' is every "
         "face.");
  if (v.optional("sheet_thickness_mm", is_mesh))
    v.number("sheet_thickness_mm", spec.sheet_thickness_mm, within(0, 1000),
             "Thickness of open surfaces, in the diffraction of their free edges.");
  if (v.optional("layout", spec.layout.has_value())) {
    if (!spec.layout) spec.layout.emplace();
    v.section("layout", *spec.layout, visit,
              "Several bodies of one mesh: their places on the water, and what differs between them.");
  }
  if (v.optional("motion", is_mesh)) v.section("motion", spec.motion, visit, "Motion of each body.");
  if (v.optional("solver", is_mesh)) v.section("solver", spec.solver, visit, "How the echo is computed.");
  v.list("companions", spec.companions, 100, visit,
         "Further targets in the same sea and maps; their echoes are added, without shadowing or multiple "
         "scattering between targets.");
}

void visit(ClutterSpec& spec, FieldVisitor& v) {
  v.choice("level", spec.level, kClutterLevels,
           "Level of the clutter: scr (relative to the target), or by range, beam and the sea's reflectivity by the "
           "model nrl, git, hyb or tsc.");
  v.number("scr_db", spec.scr_db, within(-60, 200), "Signal-to-clutter ratio, for level: scr.");
  v.choice("scr_definition", spec.scr_definition, {"per_pulse", "peak_cell", "extent"},
           "The ratio is that of one pulse, of the map's strongest cell, or of the target's extent in the map.");
  v.flag("enabled", spec.enabled, "Sea clutter.");
  v.choice(
      "noise_level", spec.noise_level, {"cnr", "snr", "thermal"},
      "Level of the noise: cnr (relative to the clutter), snr (relative to the target) or thermal (radar equation).");
  v.number("cnr_db", spec.cnr_db, within(-60, 200), "Clutter-to-noise ratio, for noise_level: cnr.");
  v.number("snr_db", spec.snr_db, within(-100, 200), "Signal-to-noise ratio of one pulse, for noise_level: snr.");
  if (v.optional("texture", spec.texture.has_value())) {
    if (!spec.texture) spec.texture.emplace();
    v.choice("texture", *spec.texture, {"independent", "waves"},
             "Local power of the sea: independent of the waves, or modulated by the waves that move the scatterers; "
             "default: waves with doppler: wave_resolved, else independent.");
  }
  visit_given(v, "texture_shape", spec.texture_shape, within(0.1, 1000),
              "Shape of the K distribution of a range cell; default: 2, with texture: waves by grazing angle, cell, "
              "polarisation and direction of the waves.");
  visit_given(v, "texture_correlation_time_s", spec.texture_correlation_time_s, within(0.1, 1000),
              "Time in which the correlation of the texture that is not of the waves falls to e^{-1/2}; default: 3 s, "
              "with texture: waves 1 s.");
  visit_given(v, "texture_correlation_m", spec.texture_correlation_m, within(0.1, 1e4),
              "Likewise the distance in range; default: five range cells, with texture: waves 8 m.");
  v.choice(
      "doppler", spec.doppler, {"prescribed", "sea_state", "wave_resolved"},
      "Velocity of the clutter: prescribed; with the mean and spread of the sea state; or per scatterer by the waves.");
  v.number("doppler_mean_mps", spec.doppler_mean_mps, within(-20, 20),
           "Mean velocity of the clutter, positive = receding.");
  visit_given(v, "doppler_spread_mps", spec.doppler_spread_mps, within(0, 20),
              "Standard deviation of its velocity; with texture: waves that of a scatterer on moving water that does "
              "not break; default: 0.5 m/s, with texture: waves 0.13 m/s.");
  v.number("hh_velocity_factor", spec.hh_velocity_factor, within(0, 5),
           "Mean velocity by waves and wind of hh, hv and vh relative to vv.");
  visit_given(v, "sea_state", spec.sea_state, within(0, 6),
              "Douglas sea state of the reflectivity; default: from the significant wave height.");
}

void visit(MapSpec& spec, FieldVisitor& v) {
  static constexpr const char* const kTapers[] = {"none", "hann", "hamming", "taylor"};
  v.number("range_span_m", spec.range_span_m, above_up_to(0, 1e6),
           "Full width of the map in range about the reference point; at most the unambiguous window.");
  v.number("velocity_span_mps", spec.velocity_span_mps, above_up_to(0, 1e5),
           "Full width of the map in velocity about zero.");
  v.number("range_oversampling", spec.range_oversampling, within(1, 16),
           "Cells per range resolution c / (2 B_s), B_s the synthetic bandwidth.");
  v.number("velocity_oversampling", spec.velocity_oversampling, within(1, 16),
           "Cells per velocity resolution lambda / (2 N T_r).");
  v.choice("compression", spec.compression, {"inverse", "matched"},
           "Pulse compression: inverse (flat spectrum) or matched filter.");
  v.choice("range_taper", spec.range_taper, kTapers, "Taper over frequency.");
  v.choice("velocity_taper", spec.velocity_taper, kTapers, "Taper over the pulses.");
  v.flag("clean", spec.clean, "The map shows the points that CLEAN finds, without the pedestal of the hop code.");
}

void visit(LookSpec& spec, FieldVisitor& v) {
  v.integer("count", spec.count, within(1, 1000), "Coherent intervals of a sample, each with its own map.");
  v.number("spacing_s", spec.spacing_s, within(0.001, 1000), "Time from the start of one look to that of the next.");
}

void visit(DatasetSpec& spec, FieldVisitor& v) {
  v.integer("maps_per_case", spec.maps_per_case, within(1, 1000000),
            "Maps of each target in a case (one sea state at one view).");
  v.integer("realisations_per_case", spec.realisations_per_case, within(1, 100000),
            "Independent seas of a case; divides maps_per_case.");
  v.integer("maps_per_interval", spec.maps_per_interval, within(1, 1000),
            "Maps of each interval and target, each with its own clutter, noise and drawn values of clutter; the "
            "target's response is computed once. Times realisations_per_case it divides maps_per_case.");
  v.number("interval_spacing_s", spec.interval_spacing_s, within(0.001, 10000),
           "Time from one interval of a realisation to the next.");
  v.integer("maps_per_shard", spec.maps_per_shard, within(1, 10000), "Maps in one HDF5 file.");
  v.value("split", RatioField{spec.train_fraction}, "Training to test rows, of maps and of sea realisations.");
  v.flag("complex_maps", spec.complex_maps, "Also store real and imaginary part.");
  v.flag(
      "echoes", spec.echoes,
      "Also store the target's echoes, of which `seaglint features` makes maps with other clutter, map and features.");
  if (v.optional("classes", spec.classes != default_classes() && spec.classes.size() >= kMinClasses))
    v.value("classes", NamesField{spec.classes, kMinClasses, kMaxClasses},
            "Names of the classes by label, 0 first: [array, ship] by default.");
}

void visit(FeatureSpec& spec, FieldVisitor& v) {
  v.number("dynamic_range_db", spec.dynamic_range_db, within(1, 100),
           "Scattering centres are kept down to this below the strongest.");
  v.integer("max_centres", spec.max_centres, within(3, 1000), "Largest number of scattering centres.");
  v.number("clean_gain", spec.clean_gain, within(0.05, 1), "Loop gain of CLEAN.");
  v.number("range_scale_m", spec.range_scale_m, above(0), "Normalisation of sigma_r in CCF.");
  v.number("velocity_scale_mps", spec.velocity_scale_mps, above(0), "Normalisation of sigma_v in CCF.");
  v.flag("weighted_fit", spec.weighted_fit, "The line of MWR is fitted with the centres' weights too.");
}

void visit(LearningSpec& spec, FieldVisitor& v) {
  v.section(
      "split",
      [&](FieldVisitor& split) {
        split.text("by", spec.split.by,
                   "Column of the samples, or drawn key, whose values are on one side of the split each; sea: whole "
                   "sea realisations.");
        split.value("hold_out", HoldOutsField{spec.split.hold_out},
                    "Values of columns that are tested on and never trained on, for the classes that have them: any of "
                    "a column's values, all columns.");
      },
      "Division into training and test maps.");
  v.choice("fusion", spec.fusion, {"split", "in_sample"},
           "split: network and trees learn from different training maps; in_sample: from the same (the paper's).");
  v.number("network_fraction", spec.network_fraction, within(0.1, 0.9),
           "Fraction of the training rows that the network is fitted to; the rest selects its epoch and, with fusion: "
           "split, trains the trees.");
  v.integer("epochs", spec.epochs, within(1, 10000), "Training epochs of the network at most.");
  v.integer("patience", spec.patience, within(1, 10000),
            "Epochs without a smaller loss of the validation rows after which its training ends.");
  v.integer("batch_size", spec.batch_size, within(1, 4096), "Batch size of the network.");
  v.number("learning_rate", spec.learning_rate, within(1e-6, 1), "Learning rate of the network.");
  v.integer("embedding_size", spec.embedding_size, within(1, 512), "Features that the network gives to the trees.");
  v.integer("threads", spec.threads, within(1, 256),
            "Threads of each network's training; results do not depend on them.");
  v.number("map_floor_db", spec.map_floor_db, {.lowest = -120, .highest = 0, .without_highest = true},
           "Floor of the network's images relative to the power of all centres.");
  v.integer("trees", spec.trees, within(1, 100000),
            "Number of trees (XGBoost); the defaults of the trees are those of the paper's table II.");
  v.integer("max_depth", spec.max_depth, within(1, 32), "Depth of the trees.");
  v.number("tree_learning_rate", spec.tree_learning_rate, above_up_to(0, 1), "Learning rate of the trees.");
  v.number("subsample", spec.subsample, above_up_to(0, 1), "Fraction of the rows for each tree.");
  v.number("colsample_bytree", spec.colsample_bytree, above_up_to(0, 1), "Fraction of the columns for each tree.");
  v.integer("tree_seed", spec.tree_seed, within(0, std::numeric_limits<int>::max()), "Seed of XGBoost.");
  v.flag("refit", spec.refit,
         "Fit the saved model to all maps that are not held out, in place of the first split's; accuracies stay those "
         "of the splits.");
  v.integer("split_repeats", spec.split_repeats, within(1, 100),
            "Independent splits whose test predictions are pooled.");
  v.integer("bootstrap_samples", spec.bootstrap_samples, within(10, 100000),
            "Bootstrap samples of the confidence intervals.");
}

void visit(ReportSpec& spec, FieldVisitor& v) {
  v.choice("claims", spec.claims, {"none", "paper"},
           "paper: also judge the claims of Yuan et al., Corner Reflector Array Jamming Discrimination.");
}

}  // namespace

bool Bound::holds(double value) const {
  if (or_zero && value == 0) return true;
  const bool low = without_lowest ? value > lowest : value >= lowest;
  const bool high = without_highest ? value < highest : value <= highest;
  return low && high;
}

std::string Bound::text() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!without_lowest && !without_highest && lowest > -kInfinity && highest < kInfinity) {
    return fmt::format("within {} and {}", lowest, highest);
  }
  std::string low;
  std::string high;
  if (lowest > -kInfinity) low = fmt::format("{} {}", without_lowest ? "greater than" : "at least", lowest);
  if (highest < kInfinity) high = fmt::format("{} {}", without_highest ? "less than" : "at most", highest);
  return low + (low.empty() || high.empty() ? "" : " and ") + high;
}

std::string_view unit_of(std::string_view key) {
  // Longer endings first.
  static constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
      {"_rad_s", "rad/s"}, {"_deg_s", "deg/s"}, {"_ghz", "GHz"}, {"_mhz", "MHz"}, {"_us", "us"}, {"_km", "km"},
      {"_mm", "mm"},       {"_deg", "deg"},     {"_mps", "m/s"}, {"_kw", "kW"},   {"_db", "dB"}, {"_k", "K"},
      {"_c", "deg C"},     {"_psu", "psu"},     {"_s", "s"},     {"_m", "m"}};
  const auto* found = std::ranges::find_if(kUnits, [&](const auto& unit) { return key.ends_with(unit.first); });
  return found == std::end(kUnits) ? std::string_view() : found->second;
}

void visit_fields(Scenario& scenario, FieldVisitor& v) {
  v.require("seaglint");
  v.integer("seaglint", scenario.version, within(1, 1), "Version of the file format: 1.");
  v.text("name", scenario.name,
         "Name of the scenario, on reports and in data sets; default: the file's name without its extension.");
  v.value("seed", NaturalField{scenario.seed},
          "Seed of all random numbers; every number is keyed by (seed, stream, index).");
  v.section("radar", scenario.radar, visit, "Radar and waveform.");
  v.section("view", scenario.view, visit, "Directions in which the radar sees the target.");
  v.section("sea", scenario.sea, visit, "Waves.");
  v.section("sea_reflection", scenario.sea_reflection, visit,
            "Specular reflection by the mean sea surface between radar and target.");
  v.require("targets", true, "; targets: {} is the sea alone");
  FieldItems targets{.most = 100, .when_empty = "the sea alone"};
  for (const TargetSpec& target : scenario.targets) {
    if (!is_sea_alone(scenario)) targets.names.push_back(target.name);
  }
  targets.resize = [&](const std::vector<std::string>& names) {
    scenario.targets.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) scenario.targets[i].name = names[i];
  };
  targets.item = [&](std::size_t i, FieldVisitor& target) { visit(scenario.targets[i], target); };
  v.items("targets", targets, "Targets by their names: letters, digits, '_' and '-'; {}: the sea alone.");
  v.section("clutter", scenario.clutter, visit, "Sea clutter and noise.");
  v.section("map", scenario.map, visit, "Range-velocity map.");
  if (v.optional("looks", scenario.looks.count != 1))
    v.section("looks", scenario.looks, visit, "Several looks of one target in one sea make a sample.");
  v.section("dataset", scenario.dataset, visit, "Size and division of the data set.");
  v.section("features", scenario.features, visit, "Scattering centres and their features.");
  v.section("learning", scenario.learning, visit, "Training of network and trees.");
  v.section("report", scenario.report, visit, "Contents of the report.");
}

}  // namespace seaglint
