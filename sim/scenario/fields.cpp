// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

// A text that is one of the names.
template <std::size_t n>
void visit_word(FieldVisitor& v, const char* key, std::string& value, const char* const (&names)[n]) {
  auto index = static_cast<std::size_t>(std::find(names, names + n, std::string_view(value)) - names);
  SEAGLINT_CHECK(index < n, fmt::format("{}: '{}'", key, value));
  v.choice(key, index, names);
  value = names[index];
}

void visit(LinkBudgetSpec& spec, FieldVisitor& v) {
  v.number("beamwidth_deg", spec.beamwidth_deg, within(0.01, 60));
  v.number("peak_power_kw", spec.peak_power_kw, within(1e-6, 1e5));
  v.number("antenna_gain_db", spec.antenna_gain_db, within(0, 70));
  v.number("noise_figure_db", spec.noise_figure_db, within(0, 40));
  v.number("losses_db", spec.losses_db, within(0, 60));
  v.number("reference_temperature_k", spec.reference_temperature_k, within(1, 10000));
}

void visit(PlatformSpec& spec, FieldVisitor& v) {
  v.triple("velocity_mps", spec.velocity_mps, within(-1000, 1000));
  v.flag("motion_compensated", spec.motion_compensated);
}

void visit(RadarSpec& spec, FieldVisitor& v) {
  v.number("carrier_ghz", spec.carrier_ghz, within(0.1, 300));
  v.integer("hop_count", spec.carrier_count, within(1, 1024));
  v.number("hop_step_mhz", spec.hop_step_mhz, above(0));
  visit_choice(v, "hop_code", spec.hop_code, {"random", "balanced", "stepped", "file"});
  if (v.optional("hop_code_file", !spec.hop_code_file.empty())) v.text("hop_code_file", spec.hop_code_file);
  v.number("bandwidth_mhz", spec.bandwidth_mhz, within(0.001, 10000));
  v.number("pulse_width_us", spec.pulse_width_us, within(0.001, 1e6));
  v.number("sampling_mhz", spec.sampling_mhz, within(0.001, 1e6));
  v.number("pri_us", spec.pri_us, within(0.01, 1e7));
  v.number("pri_jitter_us", spec.pri_jitter_us, within(0, 1e7));
  v.integer("pulses", spec.pulses, within(1, 65536));
  visit_choice(v, "polarisation", spec.polarisation, {"hh", "hv", "vh", "vv"});
  v.flag("intra_pulse_motion", spec.intra_pulse_motion);
  v.number("range_km", spec.range_km, within(0.1, 1000));
  v.section("link_budget", [&](FieldVisitor& budget) { visit(spec.link_budget, budget); });
  v.section("platform", [&](FieldVisitor& platform) { visit(spec.platform, platform); });
}

void visit(ViewSpec& spec, FieldVisitor& v) {
  v.sweep("azimuth_deg", spec.azimuth_deg, within(-360, 360));
  v.sweep("elevation_deg", spec.elevation_deg, within(-90, 90));
}

// A sweep, or a word for a value of an enumeration after its first.
template <typename Enumeration, std::size_t n>
void visit_sweep(FieldVisitor& v, const char* key, Sweep& values, const Bound& bound, Enumeration& rule,
                 const char* const (&words)[n]) {
  auto word = static_cast<std::size_t>(rule);
  v.sweep(key, values, bound, words, &word);
  rule = static_cast<Enumeration>(word);
}

void visit(SpreadingSpec& spec, FieldVisitor& v) {
  visit_choice(v, "kind", spec.kind, {"none", "cos2s", "mitsuyasu", "wrapped_normal"});
  v.number("s", spec.s, above_up_to(0, 200));
  v.number("width_deg", spec.width_deg, above_up_to(0, 180));
}

void visit(WindSpec& spec, FieldVisitor& v) {
  v.number("speed_mps", spec.speed_mps, within(1, 60));
  v.number("fetch_km", spec.fetch_km, within(0.1, 5000));
}

// The energy of lower waves would underflow.
constexpr Bound kWaveHeights = zero_or_within(1e-6, 30);

constexpr Bound kPeakPeriods = within(0.5, 40), kMeanPeriods = within(0.3, 40), kDirections = within(-360, 360);

// A number in the place of that of another key.
void visit_alternative(FieldVisitor& v, const char* key, std::optional<double>& value, const Bound& bound) {
  if (!v.optional(key, value.has_value())) return;
  if (!value) value.emplace();
  v.number(key, *value, bound);
}

void visit_alternative(FieldVisitor& v, const char* key, Sweep& values, const Bound& bound) {
  if (v.optional(key, !values.empty())) v.sweep(key, values, bound);
}

void visit(SwellSpec& spec, FieldVisitor& v) {
  v.number("significant_wave_height_m", spec.significant_wave_height_m, kWaveHeights);
  if (v.optional("peak_period_s", !spec.energy_period_s && !spec.zero_crossing_period_s))
    v.number("peak_period_s", spec.peak_period_s, kPeakPeriods);
  visit_alternative(v, "energy_period_s", spec.energy_period_s, kMeanPeriods);
  visit_alternative(v, "zero_crossing_period_s", spec.zero_crossing_period_s, kMeanPeriods);
  v.number("gamma", spec.gamma, within(1, 20));
  if (v.optional("propagation_deg", !spec.coming_from_deg))
    v.number("propagation_deg", spec.propagation_deg, kDirections);
  visit_alternative(v, "coming_from_deg", spec.coming_from_deg, kDirections);
  v.integer("components", spec.components, within(1, 100000));
  v.section("spreading", [&](FieldVisitor& spreading) { visit(spec.spreading, spreading); });
}

void visit(SeaSpec& spec, FieldVisitor& v) {
  // A table replaces peak period and shape; Bretschneider's spectrum has gamma 1.
  visit_choice(v, "spectrum", spec.spectrum, {"jonswap", "bretschneider", "table"});
  if (v.optional("table", !spec.table.empty())) v.text("table", spec.table);
  if (v.optional("table_time", !spec.table_time.empty())) v.text("table_time", spec.table_time);
  const bool is_scatter = !spec.scatter_diagram.empty();
  if (v.optional("scatter_diagram", is_scatter)) v.text("scatter_diagram", spec.scatter_diagram);
  if (v.optional("significant_wave_height_m", !is_scatter)) {
    visit_sweep(v, "significant_wave_height_m", spec.significant_wave_height_m, kWaveHeights, spec.height_rule,
                {"from_table"});
  }
  if (v.optional("steepness", !spec.steepness.empty())) v.sweep("steepness", spec.steepness, within(1e-4, 0.14));
  const bool follows =
      !spec.energy_period_s.empty() || !spec.zero_crossing_period_s.empty() || !spec.steepness.empty() || is_scatter;
  if (v.optional("peak_period_s", spec.spectrum != SpectrumKind::kTable && !follows)) {
    visit_sweep(v, "peak_period_s", spec.peak_period_s, kPeakPeriods, spec.period_rule,
                {"dnv_wind_sea", "wind_and_fetch"});
  }
  for (const auto& [key, periods] : {std::pair{"energy_period_s", &spec.energy_period_s},
                                     {"zero_crossing_period_s", &spec.zero_crossing_period_s}}) {
    if (v.optional(key, !periods->empty() && !is_scatter)) v.sweep(key, *periods, kMeanPeriods);
  }
  if (v.optional("wind", spec.period_rule == PeakPeriod::kWindAndFetch)) {
    v.section("wind", [&](FieldVisitor& wind) { visit(spec.wind, wind); });
  }
  if (v.optional("gamma", spec.spectrum == SpectrumKind::kJonswap)) {
    visit_sweep(v, "gamma", spec.gamma, within(1, 20), spec.gamma_rule, {"dnv_rule"});
  }
  if (v.optional("normalisation", spec.spectrum == SpectrumKind::kJonswap)) {
    visit_choice(v, "normalisation", spec.normalisation, {"exact", "dnv"});
  }
  if (v.optional("propagation_deg", spec.coming_from_deg.empty()))
    v.sweep("propagation_deg", spec.propagation_deg, kDirections);
  visit_alternative(v, "coming_from_deg", spec.coming_from_deg, kDirections);
  v.section("spreading", [&](FieldVisitor& spreading) { visit(spec.spreading, spreading); });
  v.section("swell", [&](FieldVisitor& swell) { visit(spec.swell, swell); });
  if (v.optional("depth_m", spec.depth_m.has_value())) {
    if (!spec.depth_m) spec.depth_m.emplace(20);
    v.number("depth_m", *spec.depth_m, within(0.5, 12000));
  }
  visit_choice(v, "amplitude", spec.amplitude, {"fixed", "random"});
  v.integer("order", spec.order, within(1, 2));
  v.integer("components", spec.components, within(1, 100000));
  v.number("cutoff_rad_s", spec.cutoff_rad_s, within(0, 100));
  v.number("second_order_cutoff_rad_s", spec.second_order_cutoff_rad_s, within(0, 1000));
}

void visit(SeaReflectionSpec& spec, FieldVisitor& v) {
  v.flag("enabled", spec.enabled);
  visit_choice(v, "surface", spec.surface, {"sea_water", "conductor"});
  v.number("temperature_c", spec.temperature_c, within(-2, 29));
  v.number("salinity_psu", spec.salinity_psu, within(0, 40));
  visit_choice(v, "roughness", spec.roughness, {"miller_brown_vegh", "ament", "none"});
  visit_choice(v, "paths", spec.paths, {"all", "direct_only", "multipath_only"});
}

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
                 const char* highest, const Bound& bound, const BodyRange& standard = {}) {
  if (!v.optional(key, range.has_value())) return;
  if (!range) range = standard;
  v.section(key, [&](FieldVisitor& ends) {
    ends.number(lowest, range->lowest, bound);
    ends.number(highest, range->highest, bound);
  });
}

void visit(LayoutSpec& spec, FieldVisitor& v) {
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
  visit_range(v, "scales", spec.scales, "lowest", "highest", within(1e-3, 1e3), {1, 1});
  if (v.optional("seed", spec.seed != 0)) v.natural("seed", spec.seed);
}

void visit(MotionSpec& spec, FieldVisitor& v) {
  visit_choice(v, "model", spec.model, {"fixed", "ship", "float", "series", "rao"});
  v.flag("translations", spec.translations);
  if (v.optional("rotation_centre_m", spec.rotation_centre_m.has_value())) {
    if (!spec.rotation_centre_m) spec.rotation_centre_m.emplace();
    v.triple("rotation_centre_m", *spec.rotation_centre_m, within(-1000, 1000));
  }
  v.number("roll_period_s", spec.roll_period_s, zero_or_within(0.2, 60));
  v.number("pitch_period_s", spec.pitch_period_s, zero_or_within(0.2, 60));
  v.number("yaw_period_s", spec.yaw_period_s, zero_or_within(0.2, 1000));
  v.number("roll_damping", spec.roll_damping, within(0, 2));
  v.number("roll_quadratic_damping", spec.roll_quadratic_damping, within(0, 100));
  v.number("pitch_damping", spec.pitch_damping, within(0, 2));
  v.number("yaw_damping", spec.yaw_damping, within(0, 2));
  v.number("yaw_rate_std_deg_s", spec.yaw_rate_std_deg_s, within(0, 180));
  v.number("length_m", spec.length_m, within(0, 1000));
  v.number("beam_m", spec.beam_m, within(0, 200));
  v.number("draught_m", spec.draught_m, within(0, 50));
  v.number("heave_period_s", spec.heave_period_s, zero_or_within(0.2, 60));
  v.number("heave_damping", spec.heave_damping, within(0, 2));
  v.number("metacentric_height_m", spec.metacentric_height_m, within(0.01, 20));
  v.number("roll_gyradius_m", spec.roll_gyradius_m, within(0, 100));
  v.number("pitch_gyradius_m", spec.pitch_gyradius_m, within(0, 500));
  v.number("yaw_gyradius_m", spec.yaw_gyradius_m, within(0, 500));
  v.number("speed_mps", spec.speed_mps, within(0, 40));
  if (v.optional("file", !spec.file.empty())) v.text("file", spec.file);
  v.number("series_start_s", spec.series_start_s, within(-1e10, 1e10));
  visit_choice(v, "heading", spec.heading, {"auto", "keep", "remove"});
  visit_choice(v, "position", spec.position, {"auto", "keep", "remove"});
  v.number("rao_scale", spec.rao_scale, above_up_to(0, 1e6));
  v.number("rao_phase_deg", spec.rao_phase_deg, within(-360, 360));
  visit_choice(v, "rao_rotations", spec.rao_rotations, {"radians", "degrees", "slope", "slope_degrees"});
  v.flag("rao_follows_long_waves", spec.rao_follows_long_waves);
  v.number("wamit_ulen_m", spec.wamit_ulen_m, above_up_to(0, 1000));
  v.integer("wamit_body", spec.wamit_body, within(0, 100));
  v.triple("wamit_xbody_m", spec.wamit_xbody_m, within(-1e5, 1e5));
  visit_choice(v, "wamit_first_column", spec.wamit_first_column, {"period", "omega"});
  visit_choice(v, "wamit_heading", spec.wamit_heading, {"towards", "from"});
  visit_choice(v, "wamit_time_factor", spec.wamit_time_factor, {"plus", "minus"});
  if (v.optional("sections", !spec.sections.empty())) v.text("sections", spec.sections);
  v.number("diameter_m", spec.diameter_m, within(0, 50));
  v.number("origin_above_waterline_m", spec.origin_above_waterline_m, within(-10, 50));
  visit_choice(v, "waves", spec.waves, {"same_field", "independent"});
  v.number("step_s", spec.step_s, within(0.001, 0.1));
  v.number("spin_up_s", spec.spin_up_s, within(0, 3600));
}

void visit(SolverSpec& spec, FieldVisitor& v) {
  visit_choice(v, "method", spec.method, kSolverMethodNames);
  v.number("ray_spacing_m", spec.ray_spacing_m, zero_or_within(1e-5, 1));
  v.number("min_patch_m", spec.min_patch_m, zero_or_within(5e-5, 1));
  v.integer("max_bounces", spec.max_bounces, within(1, kMaxBounces));
  v.number("max_aspect_change_deg", spec.max_aspect_change_deg, zero_or_within(0.001, 5));
  v.number_or_auto("crease_deg", spec.crease_deg, within(0, 60));
  v.flag("edges", spec.edges);
  v.number("wavefront_range_m", spec.wavefront_range_m, zero_or_within(100, 1e7));
}

void visit(PointSpec& spec, FieldVisitor& v) {
  v.require("position_m");
  v.triple("position_m", spec.position_m, within(-100000, 100000));
  v.number("amplitude_m", spec.amplitude_m, above_up_to(0, 1e6));
  v.triple("velocity_mps", spec.velocity_mps, within(-10000, 10000));
}

void visit(PartMaterialSpec& spec, FieldVisitor& v) {
  v.require("part");
  v.text("part", spec.part);
  v.require("material");
  v.text("material", spec.material);
}

void visit(CompanionSpec& spec, FieldVisitor& v) {
  v.require("target");
  v.text("target", spec.target);
  v.number("x_m", spec.x_m, within(-1e5, 1e5));
  v.number("y_m", spec.y_m, within(-1e5, 1e5));
}

template <typename Spec>
void visit_list(FieldVisitor& v, const char* key, std::vector<Spec>& items, std::size_t most) {
  if (!v.optional(key, !items.empty())) return;
  v.list(
      key, items.size(), most, [&](std::size_t size) { items.resize(size); },
      [&](std::size_t i, FieldVisitor& item) { visit(items[i], item); });
}

// A mesh with its motion, or ideal points; fields of a mesh are not written for points.
void visit(TargetSpec& spec, FieldVisitor& v) {
  visit_choice(v, "role", spec.role, {"class", "part"});
  const bool is_class = spec.role == TargetRole::kClass;
  if (is_class) v.require("label");
  if (v.optional("label", is_class)) v.integer("label", spec.label, within(0, kMaxClasses - 1));
  visit_list(v, "points", spec.points, 10000);
  if (v.optional("mesh", !spec.mesh.empty())) v.text("mesh", spec.mesh);
  const bool is_mesh = spec.points.empty();
  if (v.optional("unit", is_mesh)) visit_word(v, "unit", spec.unit, {"m", "cm", "mm", "km", "in", "ft"});
  if (v.optional("scale", is_mesh)) v.number("scale", spec.scale, within(1e-3, 1e3));
  const MeshPlacement standard;
  if (v.optional("orientation", spec.forward != standard.forward || spec.up != standard.up)) {
    v.section("orientation", [&](FieldVisitor& orientation) {
      visit_word(orientation, "forward", spec.forward, kMeshAxes);
      visit_word(orientation, "up", spec.up, kMeshAxes);
    });
  }
  if (v.optional("offset_m", spec.offset_m != standard.offset_m))
    v.triple("offset_m", spec.offset_m, within(-1e4, 1e4));
  if (v.optional("material", is_mesh)) v.text("material", spec.material);
  visit_list(v, "part_materials", spec.part_materials, 1000);
  if (v.optional("sheet_thickness_mm", is_mesh))
    v.number("sheet_thickness_mm", spec.sheet_thickness_mm, within(0, 1000));
  if (v.optional("layout", spec.layout.has_value())) {
    if (!spec.layout) spec.layout.emplace();
    v.section("layout", [&](FieldVisitor& layout) { visit(*spec.layout, layout); });
  }
  if (v.optional("motion", is_mesh)) v.section("motion", [&](FieldVisitor& motion) { visit(spec.motion, motion); });
  if (v.optional("solver", is_mesh)) v.section("solver", [&](FieldVisitor& solver) { visit(spec.solver, solver); });
  visit_list(v, "companions", spec.companions, 100);
}

void visit(ClutterSpec& spec, FieldVisitor& v) {
  visit_choice(v, "level", spec.level, {"scr", "nrl"});
  v.number("scr_db", spec.scr_db, within(-60, 200));
  visit_choice(v, "scr_definition", spec.scr_definition, {"per_pulse", "peak_cell", "extent"});
  v.flag("enabled", spec.enabled);
  visit_choice(v, "noise_level", spec.noise_level, {"cnr", "snr", "thermal"});
  v.number("cnr_db", spec.cnr_db, within(-60, 200));
  v.number("snr_db", spec.snr_db, within(-100, 200));
  v.number("texture_shape", spec.texture_shape, within(0.1, 1000));
  v.number("texture_correlation_time_s", spec.texture_correlation_time_s, within(0.1, 1000));
  visit_choice(v, "doppler", spec.doppler, {"prescribed", "sea_state", "wave_resolved"});
  v.number("doppler_mean_mps", spec.doppler_mean_mps, within(-20, 20));
  v.number("doppler_spread_mps", spec.doppler_spread_mps, within(0, 20));
  v.number("hh_velocity_factor", spec.hh_velocity_factor, within(0, 5));
  if (v.optional("sea_state", spec.sea_state.has_value())) {
    if (!spec.sea_state) spec.sea_state.emplace();
    v.number("sea_state", *spec.sea_state, within(0, 6));
  }
}

void visit(MapSpec& spec, FieldVisitor& v) {
  static constexpr const char* const kTapers[] = {"none", "hann", "hamming", "taylor"};
  v.number("range_span_m", spec.range_span_m, above_up_to(0, 1e6));
  v.number("velocity_span_mps", spec.velocity_span_mps, above_up_to(0, 1e5));
  v.number("range_oversampling", spec.range_oversampling, within(1, 16));
  v.number("velocity_oversampling", spec.velocity_oversampling, within(1, 16));
  visit_choice(v, "compression", spec.compression, {"inverse", "matched"});
  visit_choice(v, "range_taper", spec.range_taper, kTapers);
  visit_choice(v, "velocity_taper", spec.velocity_taper, kTapers);
  v.flag("clean", spec.clean);
}

void visit(DatasetSpec& spec, FieldVisitor& v) {
  v.integer("maps_per_case", spec.maps_per_case, within(1, 1000000));
  v.integer("realisations_per_case", spec.realisations_per_case, within(1, 100000));
  v.integer("maps_per_interval", spec.maps_per_interval, within(1, 1000));
  v.number("interval_spacing_s", spec.interval_spacing_s, within(0.001, 10000));
  v.integer("maps_per_shard", spec.maps_per_shard, within(1, 10000));
  v.ratio("split", spec.train_fraction);
  v.flag("complex_maps", spec.complex_maps);
  v.flag("echoes", spec.echoes);
  if (v.optional("classes", spec.classes != default_classes()))
    v.words("classes", spec.classes, kMinClasses, kMaxClasses);
}

void visit(FeatureSpec& spec, FieldVisitor& v) {
  v.number("dynamic_range_db", spec.dynamic_range_db, within(1, 100));
  v.integer("max_centres", spec.max_centres, within(3, 1000));
  v.number("clean_gain", spec.clean_gain, within(0.05, 1));
  v.number("range_scale_m", spec.range_scale_m, above(0));
  v.number("velocity_scale_mps", spec.velocity_scale_mps, above(0));
  v.flag("weighted_fit", spec.weighted_fit);
}

void visit(LearningSpec& spec, FieldVisitor& v) {
  v.section("split", [&](FieldVisitor& split) {
    split.text("by", spec.split.by);
    split.hold_outs("hold_out", spec.split.hold_out);
  });
  visit_choice(v, "fusion", spec.fusion, {"split", "in_sample"});
  v.number("network_fraction", spec.network_fraction, within(0.1, 0.9));
  v.integer("epochs", spec.epochs, within(1, 10000));
  v.integer("patience", spec.patience, within(1, 10000));
  v.integer("batch_size", spec.batch_size, within(1, 4096));
  v.number("learning_rate", spec.learning_rate, within(1e-6, 1));
  v.integer("embedding_size", spec.embedding_size, within(1, 512));
  v.integer("threads", spec.threads, within(1, 256));
  v.number("map_floor_db", spec.map_floor_db, {.lowest = -120, .highest = 0, .without_highest = true});
  v.integer("trees", spec.trees, within(1, 100000));
  v.integer("max_depth", spec.max_depth, within(1, 32));
  v.number("tree_learning_rate", spec.tree_learning_rate, above_up_to(0, 1));
  v.number("subsample", spec.subsample, above_up_to(0, 1));
  v.number("colsample_bytree", spec.colsample_bytree, above_up_to(0, 1));
  v.integer("tree_seed", spec.tree_seed, within(0, std::numeric_limits<int>::max()));
  v.flag("refit", spec.refit);
  v.integer("split_repeats", spec.split_repeats, within(1, 100));
  v.integer("bootstrap_samples", spec.bootstrap_samples, within(10, 100000));
}

template <typename Spec>
void visit_section(FieldVisitor& v, const char* key, Spec& spec) {
  v.section(key, [&](FieldVisitor& section) { visit(spec, section); });
}

}  // namespace

void visit_fields(Scenario& scenario, FieldVisitor& v) {
  v.require("seaglint");
  v.integer("seaglint", scenario.version, within(1, 1));
  v.text("name", scenario.name);
  v.natural("seed", scenario.seed);
  visit_section(v, "radar", scenario.radar);
  visit_section(v, "view", scenario.view);
  visit_section(v, "sea", scenario.sea);
  visit_section(v, "sea_reflection", scenario.sea_reflection);
  std::vector<std::string> names;
  for (const TargetSpec& target : scenario.targets) names.push_back(target.name);
  v.require("targets");
  v.dictionary(
      "targets", names, 100,
      [&](const std::vector<std::string>& read_names) {
        scenario.targets.resize(read_names.size());
        for (std::size_t i = 0; i < read_names.size(); ++i) scenario.targets[i].name = read_names[i];
      },
      [&](std::size_t i, FieldVisitor& target) { visit(scenario.targets[i], target); });
  visit_section(v, "clutter", scenario.clutter);
  visit_section(v, "map", scenario.map);
  visit_section(v, "dataset", scenario.dataset);
  visit_section(v, "features", scenario.features);
  visit_section(v, "learning", scenario.learning);
}

}  // namespace seaglint
