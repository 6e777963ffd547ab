// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <variant>

#include "classify/dataset/directory/export.h"
#include "radar/echo/sea_scatterers.h"
#include "radar/rvmap/rv_map.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/motion/statistics.h"
#include "sim/motion/target_motion.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scenario/files/scenario_document.h"
#include "sim/scenario/files/tables.h"
#include "sim/scenario/keys.h"
#include "sim/sea/realisation.h"

namespace seaglint {

namespace {

// The sea state with the widest strata, the only one that is reported.
struct CoarsestSea {
  double width = 0;  // relative to the peak frequency
  double peak_period_s = 0;
};

void add_doubt(std::vector<std::string>& lines, const char* key, int components, const CoarsestSea& sea) {
  if (sea.width <= kMaxStratumWidth) return;
  lines.push_back(fmt::format(
      "{}: {} components at Tp {:.3g} s give strata {:.2g} of the peak frequency wide, so that the mean period varies "
      "between realisations; {:.0f} or more keep it within about 1 %",
      key, components, sea.peak_period_s, sea.width, std::ceil(components * sea.width / kMaxStratumWidth)));
}

// Those of a target's smallest and largest body.
void add_mesh_warnings(std::vector<std::string>& lines, const Target& target) {
  if (target.models.empty()) return;
  const auto [smallest, largest] =
      std::ranges::minmax(target.models, {}, [](const auto& model) { return model->scale; });
  const std::vector<std::string>& of_smallest = smallest->prepared->warnings;
  for (const std::string& warning : of_smallest)
    lines.push_back(fmt::format("targets.{}.{}: {}", target.spec.name, source_key_of(target.spec), warning));
  for (const std::string& warning : largest->prepared->warnings) {
    if (std::ranges::find(of_smallest, warning) == of_smallest.end())
      lines.push_back(fmt::format("targets.{}.{}, {:.6g} times as large: {}", target.spec.name,
                                  source_key_of(target.spec), largest->scale, warning));
  }
}

// What of the target's bodies is below the water: that of the deepest one.
void add_waterline_warning(std::vector<std::string>& lines, const Target& target) {
  const auto& decoy = target.spec.decoy;
  if (target.spec.ship || (decoy && decoy->support != DecoySupport::kNone))
    return;  // made with what is below the water
  std::size_t cut = 0;
  SubmergedPart deepest;
  for (const auto& model : target.models) {
    const SubmergedPart& below = model->prepared->below;
    if (below.depth_m > 0) ++cut;
    if (below.depth_m > deepest.depth_m) deepest = below;
  }
  if (cut == 0) return;
  const std::string which =
      target.models.size() == 1 ? "" : fmt::format("of {} of {} bodies, ", cut, target.models.size());
  lines.push_back(fmt::format("targets.{}.{}: {}{}{}; {} moves it", target.spec.name, source_key_of(target.spec), which,
                              cut > 1 ? "at most " : "", cut_sentence(deepest), decoy ? "layout.heights" : "offset_m"));
}

// Those of the scenario, without companions.
std::span<const Target> own_targets(const Pipeline& pipeline) {
  return std::span(pipeline.targets()).first(pipeline.scenario().targets.size());
}

// Why a body of the target with this box hovers; empty where it does not.
std::string hovering_warning(const TargetSpec& target, const Bounds& box) {
  const bool is_ship = target.motion.model == MotionModel::kShip || target.motion.model == MotionModel::kRao;
  if (!is_ship && target.motion.model != MotionModel::kFloat) return "";
  if (is_raft(target.layout) || (target.layout && target.layout->heights_m)) return "";
  constexpr double kRounding = 1e-3;  // of its size: a mesh that ends at the waterline
  const double rounding = kRounding * (box.upper - box.lower).maxCoeff();
  const double gap = box.lower.z() + rest_height_m(target);
  const bool is_drawn_to_waterline = is_ship || box.lower.z() > -rounding;
  if (gap <= (is_drawn_to_waterline ? rounding : box.upper.z() - box.lower.z())) return "";
  return fmt::format(
      "targets.{}.{}: its lowest point is {:.3g} m above the water, where nothing carries it: is its waterline at z "
      "= {:.6g} m? {}",
      target.name, source_key_of(target), gap, 0.0 - rest_height_m(target),
      is_generated(target) ? "motion.origin_above_waterline_m lowers it"
      : is_ship            ? "offset_m lowers it"
                           : "motion.origin_above_waterline_m or offset_m lowers it");
}

}  // namespace

void print_note(const std::string& note) {
  if (!note.empty()) print_error(on_one_line(note) + "\n");
}

void warn(std::span<const std::string> sentences) {
  for (const std::string& sentence : sentences)
    print_error(fmt::format("seaglint: warning: {}\n", on_one_line(sentence)));
}

void report_scenario(const Pipeline& pipeline, const ReportScope& scope) {
  const Scenario& scenario = pipeline.scenario();
  for (const std::string& note : motion_file_notes(own_targets(pipeline))) print_note(note);
  if (scope.rest) report_rest(scenario, target_motions(pipeline, trial_seas(pipeline)));
  for (const std::string& note : material_notes(own_targets(pipeline))) print_note(note);
  warn(mesh_warnings(pipeline));
  warn(motion_warnings(own_targets(pipeline)));
  report_sea(scenario, pipeline.plan().sea_states());
  warn(clutter_warnings(pipeline));
  if (scope.bands) warn(band_warnings(pipeline));
  if (scope.coverage) warn(map_coverage_warnings(pipeline));
}

void report_sea(const Scenario& scenario, std::span<const SeaState> states) {
  if (scenario.sea.table_values != nullptr) {
    const SpectrumTable& table = *scenario.sea.table_values;
    print_note(fmt::format("sea.table: {}: {}; {} frequencies, {:.4g} to {:.4g} rad/s, Hs {:.4g} m, Tp {:.4g} s",
                           scenario.sea.table, table.reading, table.omega.size(), table.omega.front(),
                           table.omega.back(), 4 * std::sqrt(table.energy()), 2 * kPi / table.peak_omega()));
  }
  warn(sea_warnings(scenario, states));
}

std::vector<std::string> motion_file_notes(std::span<const Target> targets) {
  std::vector<std::string> notes;
  for (const Target& target : targets) {
    const std::string reading = target.models.empty() ? "" : motion_file_reading(*target.models.front()->motion);
    if (!reading.empty()) notes.push_back(fmt::format("targets.{}.motion.file: {}", target.spec.name, reading));
  }
  return notes;
}

std::vector<std::string> material_notes(std::span<const Target> targets) {
  std::vector<std::string> notes;
  for (const Target& target : targets) {
    const std::string note = target.models.empty() ? "" : target.models.front()->prepared->materials_note;
    if (!note.empty())
      notes.push_back(fmt::format("targets.{}.{}: {}", target.spec.name, source_key_of(target.spec), note));
  }
  return notes;
}

void report_motion(std::span<const Target> targets) {
  for (const std::string& note : motion_file_notes(targets)) print_note(note);
  warn(motion_warnings(targets));
}

std::vector<std::string> mesh_warnings(const Pipeline& pipeline) {
  std::vector<std::string> lines;
  for (const Target& target : own_targets(pipeline)) {
    add_mesh_warnings(lines, target);
    add_waterline_warning(lines, target);
  }
  return lines;
}

std::vector<std::string> motion_warnings(std::span<const Target> targets) {
  std::vector<std::string> lines;
  for (const Target& target : targets) {
    if (target.models.empty()) continue;
    const Body& body = *target.models.front()->motion;
    const MotionModel model = target.spec.motion.model;
    if (!is_generated(target.spec) && (model == MotionModel::kShip || model == MotionModel::kRao)) {
      const std::string finding = orientation_finding(body.shape);
      if (!finding.empty()) lines.push_back(fmt::format("targets.{}.mesh: {}", target.spec.name, finding));
    }
    const auto* series = std::get_if<AttitudeSeries>(&body.model);
    if (series != nullptr && series->grid == TimeGrid::kIrregular) {
      lines.push_back(fmt::format("targets.{}.motion.file: the times of {} are not uniform: resampled by a spline",
                                  target.spec.name, series->source));
    }
    for (const auto& one : target.models) {
      const std::string hovering = hovering_warning(target.spec, one->box);
      if (hovering.empty()) continue;
      lines.push_back(hovering);
      break;
    }
  }
  return lines;
}

std::vector<std::string> uncovered_waves(std::span<const Target> targets, const WaveField& sea) {
  std::vector<std::string> sentences;
  for (const Target& target : targets) {
    const auto* table =
        target.rest_positions.empty() ? nullptr : std::get_if<RaoTable>(&target.models.front()->motion->model);
    if (table == nullptr) continue;
    sentences.push_back(fmt::format("{}: {:.3g} % of the waves' variance lies outside of its frequencies",
                                    table->source(), 100 * table->uncovered_variance_fraction(sea)));
  }
  return sentences;
}

std::vector<std::string> sea_warnings(const Scenario& scenario, std::span<const SeaState> states) {
  CoarsestSea wind_sea, swell;
  for (const SeaState& state : states) {
    const StratumWidths widths = stratum_widths(state);
    if (widths.wind_sea > wind_sea.width) wind_sea = {widths.wind_sea, state.peak_period_s};
    if (widths.swell > swell.width) swell = {widths.swell, state.swell.peak_period_s};
  }
  std::vector<std::string> lines;
  add_doubt(lines, "sea.components", scenario.sea.components, wind_sea);
  add_doubt(lines, "sea.swell.components", scenario.sea.swell.components, swell);
  for (const Variation& variation : scenario.variations) {
    const ScatterDiagram* diagram = variation.distribution.diagram.get();
    if (diagram == nullptr || variation.distribution.is_period || diagram->excluded_cells == 0) continue;
    lines.push_back(fmt::format(
        "{}: the seas of {} of {} cells, {:.2g} % of the counts, may break (Hs above L/7): not drawn", kScatterKey,
        diagram->excluded_cells, diagram->excluded_cells + diagram->cells.size(), 100 * diagram->excluded_fraction));
  }
  return lines;
}

std::vector<std::string> clutter_warnings(const Pipeline& pipeline) {
  const ClutterSpec& clutter = pipeline.scenario().clutter;
  const PulseTrain train = pipeline.nominal_train();
  ClutterScene scene = pipeline.nominal_clutter_scene();
  if (!clutter.enabled || !(scene.significant_wave_height_m > 0)) return {};
  const double cell_m = train.range_resolution_m();
  std::vector<std::string> lines;
  if (texture_is_by_waves(clutter) && clutter.texture_shape) {
    const WaveField waves = pipeline.nominal_waves();
    scene.waves = &waves;
    const TextureParameters texture = texture_parameters(clutter, scene, train.band_centre_hz(), cell_m);
    const double shape = wave_modulation(texture, scene, scatterers_per_cell(clutter, cell_m), cell_m).cell_shape;
    constexpr double kReached = 1.1;
    if (shape > kReached * texture.shape)
      lines.push_back(
          fmt::format("clutter.texture_shape: {:g}: with texture: waves the power in a cell of {:.3g} m has "
                      "the shape {:.2g} at least, which is taken",
                      texture.shape, cell_m, shape));
  }
  const FittedFigure shape = k_shape(scene, train.band_centre_hz(), cell_m);
  if (!shape.is_within_range) return lines;
  constexpr double kFar = 3;
  const auto compare = [&](const char* key, const std::optional<double>& given, double measured) {
    if (given && (*given > kFar * measured || *given < measured / kFar))
      lines.push_back(fmt::format("clutter.{}: {:g}, where measured clutter has about {:.2g} in this scene", key,
                                  *given, measured));
  };
  compare("texture_shape", clutter.texture_shape, shape.value);
  // Of the texture as a whole: its correlation falls to 1/e within sqrt(2) of the key's length.
  if (!texture_is_by_waves(clutter))
    compare("texture_correlation_m", clutter.texture_correlation_m, texture_length_m(scene) / std::sqrt(2.0));
  return lines;
}

std::vector<std::string> band_warnings(const Pipeline& pipeline) {
  const std::string gaps = band_gap_warning(pipeline.nominal_train());
  if (gaps.empty()) return {};
  return {fmt::format("radar.bandwidth_mhz: {}", gaps)};
}

namespace {

constexpr std::size_t kMaxLines = 10;

struct Span {
  double low = 0, high = 0;

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Within the cells of the axis; a single cell contains everything.
  bool within(const std::vector<double>& axis) const {
    const double half = axis.size() > 1 ? (axis[1] - axis[0]) / 2 : std::numeric_limits<double>::infinity();
    return low >= axis.front() - half && high <= axis.back() + half;
  }
};

// Extent of a target with its companions in range and velocity.
struct Reach {
  Span range_m, velocity_mps;
};

// Of a mesh in range, relative to its origin, m.
Span extent_of(const TriangleMesh& mesh, const Vec3& r_hat) {
  Span extent;
  for (const Vec3& vertex : mesh.vertices) extent.include(-r_hat.dot(vertex));
  return extent;
}

// Recorded translations of a body in range, until duration_s after t = 0, m.
Span drift_of(const Body& body, const Vec3& r_hat, double duration_s) {
  Span drift;
  const auto* series = std::get_if<AttitudeSeries>(&body.model);
  if (series == nullptr || !body.spec.translations) return drift;
  const double begin_s = body.spec.series_start_s;
  for (std::size_t n = 0; n < series->time.size(); ++n) {
    const double before_s = series->time[n > 0 ? n - 1 : 0],
                 after_s = series->time[std::min(n + 1, series->time.size() - 1)];
    if (after_s >= begin_s && before_s <= begin_s + duration_s)
      drift.include(-r_hat.dot(series->samples[n].translation));
  }
  return drift;
}

// Times of a scenario, s.
struct Durations {
  double interval_s = 0;     // of one map
  double realisation_s = 0;  // until the end of the last interval
};

void extend(Reach& reach, const Target& target, const Vec3& r_hat, const Durations& durations) {
  for (const PointSpec& point : target.spec.points) {
    const double range = -r_hat.dot(Vec3(point.position_m)), velocity = -r_hat.dot(Vec3(point.velocity_mps));
    reach.range_m.include(range);
    reach.range_m.include(range + velocity * durations.interval_s);
    reach.velocity_mps.include(velocity);
  }
  std::map<const BodyModel*, Span> sizes;
  for (const auto& model : target.models) {
    if (sizes.contains(model.get())) continue;
    const Span mesh = extent_of(model->prepared->mesh, r_hat),
               drift = drift_of(*model->motion, r_hat, durations.realisation_s);
    sizes[model.get()] = {mesh.low + drift.low, mesh.high + drift.high};
  }
  constexpr double kDeviations = 3;  // of a body's own drift
  const MotionSpec& motion = target.spec.motion;
  const double mean_mps = -r_hat.dot(target.relative_velocity_mps + mean_drift_mps(motion)),
               own_mps = motion.drift ? kDeviations * motion.drift->spread_mps * r_hat.xy().norm() : 0;
  for (std::size_t i = 0; i < target.rest_positions.size(); ++i) {
    const Vec3& rest = target.rest_positions[i];
    const Span& body = sizes[target.models[i].get()];
    for (const double velocity_mps : {mean_mps - own_mps, mean_mps + own_mps}) {
      for (const double passed_m : {0.0, velocity_mps * durations.interval_s}) {
        reach.range_m.include(-r_hat.dot(rest) + passed_m + body.low);
        reach.range_m.include(-r_hat.dot(rest) + passed_m + body.high);
      }
      if (velocity_mps != 0) reach.velocity_mps.include(velocity_mps);
    }
  }
}

}  // namespace

std::vector<std::string> map_coverage_warnings(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const std::vector<Target>& targets = pipeline.targets();
  const PulseTrain train = pipeline.nominal_train();
  const MapGrid grid = map_grid(train, scenario.map);
  const PlatformSpec& platform = scenario.radar.platform;
  const double interval_s = train.time_s.back();
  const Durations durations{interval_s, pipeline.plan().last_start_s() + interval_s};
  std::vector<std::string> lines;
  std::size_t more = 0;
  const auto add_line = [&](const std::string& line) {
    if (lines.size() < kMaxLines) {
      lines.push_back(line);
    } else {
      ++more;
    }
  };
  for (const int number : pipeline.plan().classes()) {
    const auto t = static_cast<std::size_t>(number);
    for (const View& view : pipeline.plan().views()) {
      const Vec3 r_hat = direction_to_radar(view.azimuth_rad, view.elevation_rad);
      Reach reach;
      extend(reach, targets[t], r_hat, durations);
      for (const std::size_t companion : targets[t].companions) extend(reach, targets[companion], r_hat, durations);
      if (!platform.motion_compensated) {
        const double own_mps = r_hat.dot(Vec3(platform.velocity_mps));
        reach.velocity_mps = {reach.velocity_mps.low + own_mps, reach.velocity_mps.high + own_mps};
      }
      const std::string who =
          fmt::format("{} at azimuth {:g} deg",
                      is_sea_alone(scenario) ? "the sea" : "targets." + scenario.targets[t].name, view.azimuth_deg);
      if (!reach.range_m.within(grid.range_m)) {
        add_line(
            fmt::format("{} reaches from {:.1f} to {:.1f} m, the map from {:.1f} to {:.1f} m: raise map.range_span_m",
                        who, reach.range_m.low, reach.range_m.high, grid.range_m.front(), grid.range_m.back()));
      }
      if (!reach.velocity_mps.within(grid.velocity_mps)) {
        const double unambiguous = train.unambiguous_velocity_mps();
        const bool folds = std::max(-reach.velocity_mps.low, reach.velocity_mps.high) > unambiguous;
        add_line(fmt::format(
            "{} moves at {:.2f} to {:.2f} m/s, the map shows {:.2f} to {:.2f} m/s (unambiguous within +-{:.2f}): {}",
            who, reach.velocity_mps.low, reach.velocity_mps.high, grid.velocity_mps.front(), grid.velocity_mps.back(),
            unambiguous, folds ? "shorten radar.pri_us" : "raise map.velocity_span_mps"));
      }
    }
  }
  if (more > 0) lines.push_back(fmt::format("and {} more like these", more));
  return lines;
}

std::vector<std::string> data_set_warnings(const DatasetReader& reader) {
  std::vector<std::string> lines;
  if (const auto sentence = merged_file_of_another_manifest(reader)) lines.push_back(*sentence);
  return lines;
}

namespace {

constexpr double kDuration_s = 100;

// Motion of a body at the origin over 100 s, or over the scenario's intervals where its series ends before that.
Trajectory trial_motion(const Pipeline& pipeline, const Target& target, const WaveField& sea, std::uint64_t key) {
  const Scenario& scenario = pipeline.scenario();
  const auto simulated = [&](double duration_s) {
    return simulate_motion(*target.models.front()->motion, Vec3::Zero(), sea, duration_s, scenario.seed,
                           body_index(key, target.first_body));
  };
  try {
    return simulated(kDuration_s);
  } catch (const InputError&) {
    return simulated(pipeline.plan().last_start_s() + scenario.radar.pulses * scenario.radar.pri_us * 1e-6);
  }
}

// Why degree of freedom i of a moving target is 0.
std::string rest_reason(const TargetSpec& target, std::size_t i) {
  const MotionSpec& motion = target.motion;
  const std::string path = fmt::format("targets.{}.motion", target.name);
  if (i >= 3 && !motion.translations) return fmt::format("without {}.translations: true", path);
  if (motion.model == MotionModel::kSeries) return fmt::format("in its file ({}.file)", path);
  if (i == 2 && motion.model == MotionModel::kFloat && motion.yaw_rate_std_deg_s == 0)
    return fmt::format("without {}.yaw_rate_std_deg_s", path);
  if (motion.model == MotionModel::kRao)
    return fmt::format("in its table or in these waves ({}.file, sea.propagation_deg)", path);
  return "in these waves (sea.significant_wave_height_m, sea.propagation_deg, sea.spreading)";
}

// Whether the scenario has a section `motion` of the target.
bool has_motion_section(const Scenario& scenario, const TargetSpec& target) {
  const YamlNode* node = scenario.document ? &scenario.document->root : nullptr;
  for (const std::string& key : {std::string("targets"), target.name, std::string("motion")})
    node = node == nullptr ? nullptr : node->find(key);
  return node != nullptr;
}

}  // namespace

std::vector<TrialSea> trial_seas(const Pipeline& pipeline) {
  const SamplePlan& plan = pipeline.plan();
  const bool are_drawn = std::ranges::any_of(varied_keys(pipeline.scenario()), [](const VariedKey& key) {
    return key.drawn != nullptr && key.key_path.starts_with("sea.");
  });
  if (!are_drawn) {
    const std::vector<SeaState>& states = plan.sea_states();
    const auto highest = std::ranges::max_element(states, {}, total_wave_height);
    return {{*highest, sea_key(static_cast<std::size_t>(highest - states.begin()), 0)}};
  }
  constexpr std::size_t kMost = 4;
  std::vector<TrialSea> seas;
  for (std::size_t i = 0; i < kMost; ++i) {
    const SampleAddress at = plan.sea_address(i * (plan.size() - 1) / (kMost - 1));
    const std::uint64_t key = sea_key(static_cast<std::size_t>(at.sea_state), static_cast<std::size_t>(at.realisation));
    if (std::ranges::find(seas, key, &TrialSea::key) == seas.end()) seas.push_back({plan.sea_state(at), key});
  }
  return seas;
}

std::vector<TargetMotion> target_motions(const Pipeline& pipeline, std::span<const TrialSea> seas) {
  const Scenario& scenario = pipeline.scenario();
  std::vector<WaveField> fields;
  for (const TrialSea& sea : seas) fields.push_back(realise_sea(sea.state, scenario.seed, sea.key));
  std::vector<TargetMotion> motions;
  for (std::size_t t = 0; t < scenario.targets.size(); ++t) {
    const Target& target = pipeline.targets()[t];
    if (target.models.empty()) continue;
    TargetMotion motion{&scenario.targets[t]};
    try {
      for (std::size_t s = 0; s < seas.size(); ++s) {
        const auto rms = motion_rms(trial_motion(pipeline, target, fields[s], seas[s].key), kDuration_s);
        for (std::size_t i = 0; i < rms.size(); ++i) motion.rms[i] = std::hypot(motion.rms[i], rms[i]);
      }
    } catch (const InputError&) {
      continue;  // its responses do not cover these seas
    }
    for (double& rms : motion.rms) rms /= std::sqrt(static_cast<double>(seas.size()));
    motions.push_back(motion);
  }
  return motions;
}

std::string motion_text(const TargetMotion& motion) {
  std::string text;
  for (const bool angles : {true, false}) {
    std::vector<std::string> parts;
    for (std::size_t i = angles ? 0 : 3; i < (angles ? 3u : 6u); ++i) {
      if (motion.rms[i] > 0)
        parts.push_back(
            fmt::format("{} {:.3g}", kDegreesOfFreedom[i], angles ? degrees(motion.rms[i]) : motion.rms[i]));
    }
    if (parts.empty()) continue;
    if (!text.empty()) text += "; ";
    text += fmt::format("{} {} rms", fmt::join(parts, ", "), angles ? "deg" : "m");
  }
  return text;
}

std::string line_text(const TargetSpec& target) {
  std::string text;
  if (const auto rope_m = rope_length_m(target.layout))
    text += fmt::format("; without its ropes of {:.4g} m, which hold surge and sway", *rope_m);
  if (const auto& drift = target.motion.drift) {
    const Vec3 mean = mean_drift_mps(target.motion);
    text += fmt::format("; drifts at {:.3g} m/s towards {:.3g} deg", mean.norm(),
                        mean.isZero(0) ? 0 : degrees(std::atan2(mean.y(), mean.x())));
    if (drift->spread_mps > 0) text += fmt::format(", each by itself at {:g} m/s rms", drift->spread_mps);
  }
  return text;
}

std::string rest_text(const TargetMotion& motion) {
  const TargetSpec& target = *motion.target;
  if (target.motion.model == MotionModel::kFixed)
    return fmt::format("does not move: targets.{0}.motion.model is fixed", target.name);
  std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
  for (std::size_t i = 0; i < motion.rms.size(); ++i) {
    if (motion.rms[i] > 0) continue;
    const std::string reason = rest_reason(target, i);
    auto known = std::ranges::find(by_reason, reason, &decltype(by_reason)::value_type::first);
    if (known == by_reason.end()) known = by_reason.insert(by_reason.end(), {reason, {}});
    known->second.emplace_back(kDegreesOfFreedom[i]);
  }
  std::string text;
  for (const auto& [reason, names] : by_reason)
    text += fmt::format("{}{} {} 0 {}", text.empty() ? "" : "; ", fmt::join(names, ", "),
                        names.size() == 1 ? "is" : "are", reason);
  return text;
}

void report_rest(const Scenario& scenario, const std::vector<TargetMotion>& motions) {
  for (const TargetMotion& motion : motions) {
    if (motion.target->motion.model == MotionModel::kFixed && has_motion_section(scenario, *motion.target)) continue;
    const std::string text = rest_text(motion);
    if (!text.empty()) warn(std::array{fmt::format("targets.{}: {}", motion.target->name, text)});
  }
}

}  // namespace seaglint
