// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/scenario_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pthread.h>
#include <time.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <variant>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/dataset/format/hdf5_file.h"
#include "radar/echo/echo.h"
#include "radar/echo/sea_reflectivity.h"
#include "radar/echo/sea_scatterers.h"
#include "radar/rvmap/rv_map.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/field_tables/field_table.h"
#include "sim/scattering/geometry/look_basis.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/realisation.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Processor time of the calling thread, s.
double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

// A flag that becomes true when the thread that makes the limit has used `processor_s` more seconds of processor time,
// or when *outer becomes true.
class TimeLimit {
 public:
  TimeLimit(double processor_s, const StopFlag* outer) : over_(processor_s <= 0 || (outer != nullptr && *outer)) {
    clockid_t clock = CLOCK_PROCESS_CPUTIME_ID;
    pthread_getcpuclockid(pthread_self(), &clock);
    watch_ = std::jthread([this, clock, outer, end_s = seconds_of(clock) + processor_s](const std::stop_token& ended) {
      while (!over_ && !ended.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (seconds_of(clock) >= end_s || (outer != nullptr && *outer)) over_ = true;
      }
    });
  }

  const StopFlag* flag() const { return &over_; }

 private:
  StopFlag over_;
  std::jthread watch_;  // ends before the flag
};

// Values of all varied keys, in their order.
using Values = std::vector<std::string>;

enum class TrialPart { kEcho, kAll };       // the target alone; with clutter and noise
enum class TrialCost { kReduced, kWhole };  // fewer pulses, waves and contributions; the scenario's own settings

// What a trial is made of.
struct Trial {
  Values values;
  TrialPart part = TrialPart::kEcho;
  TrialCost cost = TrialCost::kReduced;

  auto operator<=>(const Trial&) const = default;
};

// Settings of a cheap map that leave most differences between two maps as they are.
constexpr int kPulses = 16, kComponents = 64, kBounces = 3;
constexpr double kSpinUp_s = 10;
constexpr std::size_t kMaxSurroundings = 40;  // values of the other keys with which a key is tried
constexpr std::size_t kWholeSurroundings = 3;
constexpr double kTolerance = 1e-9;  // of the largest value

// The scenario by the settings of a cheap map.
Scenario reduced(Scenario scenario) {
  scenario.radar.pulses = std::min(scenario.radar.pulses, kPulses);
  scenario.sea.components = std::min(scenario.sea.components, kComponents);
  scenario.sea.swell.components = std::min(scenario.sea.swell.components, kComponents);
  for (TargetSpec& target : scenario.targets) {
    target.motion.spin_up_s = std::min(target.motion.spin_up_s, kSpinUp_s);
    target.solver.max_bounces = std::min(target.solver.max_bounces, kBounces);
    target.solver.edges = false;
  }
  return scenario;
}

bool is_near(const std::vector<Complex>& a, const std::vector<Complex>& b) {
  if (a.size() != b.size()) return false;
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  return difference <= kTolerance * largest;
}

// Maps of single observations with chosen values of the varied keys: the same sea, hop code and random numbers in all.
class TrialMaps {
 public:
  TrialMaps(const Pipeline& pipeline, const std::vector<VariedKey>& keys, const StopFlag* stop)
      : pipeline_(pipeline), keys_(keys), stop_(stop) {}

  // Values of the map of a target; null where the values contradict each other or the target has no power.
  const std::vector<Complex>* map_of(const Trial& trial, int target) {
    auto entry = maps_.find({trial, target});
    if (entry == maps_.end()) entry = maps_.emplace(std::pair(trial, target), make(trial, target)).first;
    return entry->second ? &*entry->second : nullptr;
  }

 private:
  std::optional<std::vector<Complex>> make(const Trial& trial, int target) {
    auto made = std::ranges::find(made_, trial, &Made::first);
    if (made == made_.end()) {
      if (made_.size() == kKept) made_.erase(made_.begin());
      made = made_.insert(made_.end(), {trial, pipeline_of(trial)});
    }
    const Pipeline* pipeline = made->second.get();
    if (pipeline == nullptr) return std::nullopt;
    try {
      std::vector<Complex> values;
      for (const GeneratedSample& look : pipeline->generate_looks(pipeline->plan().sample({.target = target}), stop_))
        values.insert(values.end(), look.received.map.values.begin(), look.received.map.values.end());
      return values;
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  std::unique_ptr<const Pipeline> pipeline_of(const Trial& trial) const {
    const bool is_echo = trial.part == TrialPart::kEcho;
    Scenario scenario = pipeline_.scenario();
    if (trial.cost == TrialCost::kReduced) scenario = reduced(std::move(scenario));
    DatasetSpec& dataset = scenario.dataset;
    dataset.maps_per_case = dataset.realisations_per_case = dataset.maps_per_interval = 1;
    scenario.looks.count = std::min(scenario.looks.count, 2);
    if (is_echo) {
      scenario.clutter.enabled = false;
      scenario.clutter.noise_level = NoiseLevel::kCnr;  // relative to the clutter: none
    }
    std::vector<KeyValue> values;
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      if (!is_echo || !keys_[k].key_path.starts_with("clutter."))
        values.push_back({keys_[k].key_path, trial.values[k]});
    }
    try {
      // Not from std::make_unique(): a Pipeline cannot be moved.
      return std::unique_ptr<const Pipeline>(new Pipeline(pipeline_.of_other(scenario_with(scenario, values))));
    } catch (const InputError&) {
      return nullptr;
    }
  }

  using Made = std::pair<Trial, std::unique_ptr<const Pipeline>>;
  static constexpr std::size_t kKept = 4;

  const Pipeline& pipeline_;
  const std::vector<VariedKey>& keys_;
  const StopFlag* stop_;
  std::vector<Made> made_;  // the last ones
  std::map<std::pair<Trial, int>, std::optional<std::vector<Complex>>> maps_;
};

enum class Comparison { kEqual, kDifferent, kNone };

// Maps of a target with all values of key k and the other keys as in `trial`.
Comparison compared(TrialMaps& maps, const std::vector<VariedKey>& keys, std::size_t k, const Trial& trial,
                    int target) {
  const std::vector<Complex>* first = nullptr;
  Comparison result = Comparison::kNone;
  for (const std::string& value : keys[k].trial_values()) {
    Trial changed = trial;
    changed.values[k] = value;
    const std::vector<Complex>* map = maps.map_of(changed, target);
    if (map == nullptr) continue;
    if (first == nullptr) {
      first = map;
    } else if (is_near(*first, *map)) {
      result = Comparison::kEqual;
    } else {
      return Comparison::kDifferent;
    }
  }
  return result;
}

// Values of the keys with which key k is tried: all in their middles, all at one end, all at the other end, then each
// other key alone at each of its values.
std::vector<Values> surroundings(const std::vector<VariedKey>& keys, std::size_t k) {
  Values middle, low, high;
  for (const VariedKey& key : keys) {
    const std::vector<std::string> values = key.trial_values();
    middle.push_back(values.front());
    low.push_back(values[std::min<std::size_t>(1, values.size() - 1)]);
    high.push_back(values.back());
  }
  std::vector<Values> all{middle, low, high};
  for (std::size_t other = 0; other < keys.size(); ++other) {
    if (other == k) continue;
    for (const std::string& value : keys[other].trial_values()) {
      if (value == middle[other] || all.size() == kMaxSurroundings) continue;
      all.push_back(middle);
      all.back()[other] = value;
    }
  }
  return all;
}

class EffectSearch {
 public:
  EffectSearch(const Pipeline& pipeline, const StopFlag* stop)
      : classes_(pipeline.plan().classes()), keys_(varied_keys(pipeline.scenario())), maps_(pipeline, keys_, stop) {}

  const std::vector<VariedKey>& keys() const { return keys_; }

  KeyEffect effect(std::size_t k) {
    KeyEffect effect{keys_[k], false, classes_, false};
    const std::vector<Values> all = surroundings(keys_, k);
    const std::vector<Values> some(all.begin(), all.begin() + std::min(all.size(), kWholeSurroundings));
    if (!keys_[k].key_path.starts_with("clutter.")) {
      remove_different(k, all, {{}, TrialPart::kEcho, TrialCost::kReduced}, effect);
      remove_different(k, some, {{}, TrialPart::kEcho, TrialCost::kWhole}, effect);
    }
    if (effect.same_targets.size() == classes_.size()) {
      KeyEffect with_clutter = effect;
      remove_different(k, all, {{}, TrialPart::kAll, TrialCost::kReduced}, with_clutter);
      effect.tested = with_clutter.tested;
      effect.changes_clutter = with_clutter.same_targets.size() < classes_.size();
    }
    return effect;
  }

 private:
  // Removes the targets whose maps differ.
  void remove_different(std::size_t k, const std::vector<Values>& all, Trial trial, KeyEffect& effect) {
    const bool of_one = !is_common(keys_[k].key_path);
    for (const Values& values : all) {
      trial.values = values;
      const std::vector<int> targets = effect.same_targets;
      for (const int target : targets) {
        const Comparison result = compared(maps_, keys_, k, trial, target);
        effect.tested = effect.tested || result != Comparison::kNone;
        if (result != Comparison::kDifferent) continue;
        if (of_one) return effect.same_targets.clear();
        std::erase(effect.same_targets, target);
      }
      if (effect.same_targets.empty()) return;
    }
  }

  // Keys of `targets` change the maps of one target, and of those that it accompanies.
  static bool is_common(const std::string& path) { return !path.starts_with("targets."); }

  std::vector<int> classes_;
  std::vector<VariedKey> keys_;
  TrialMaps maps_;
};

// Why the sea does not change the echo of a target; empty where that does not follow from its model.
std::string sea_reason(const TargetSpec& target) {
  if (is_sea_alone(target)) return "";
  const std::string path = "targets." + target.name;
  if (!has_mesh(target)) return fmt::format("{} is of points, which do not follow the sea", path);
  if (target.motion.model == MotionModel::kFixed) return fmt::format("{} does not move ({}.motion)", path, path);
  if (target.motion.model == MotionModel::kSeries)
    return fmt::format("{} moves as its file in any sea ({}.motion)", path, path);
  return "";
}

// ": why; why"; empty without a simple reason. `of_all`: the key changes no target's echo.
std::string reasons(const Scenario& scenario, const KeyEffect& effect, bool of_all) {
  const std::string& path = effect.key.key_path;
  std::vector<std::string> all;
  if (path.starts_with("sea.")) {
    for (const int t : effect.same_targets) {
      std::string reason = sea_reason(scenario.targets[static_cast<std::size_t>(t)]);
      if (!reason.empty()) all.push_back(std::move(reason));
    }
    const ClutterSpec& clutter = scenario.clutter;
    if (of_all && !effect.changes_clutter && clutter.enabled && clutter.level == ClutterLevel::kScr &&
        clutter.doppler == ClutterDoppler::kPrescribed)
      all.emplace_back("clutter of a given ratio and Doppler has no sea (clutter.level, clutter.doppler)");
  } else if (path.starts_with("sea_reflection.") && !scenario.sea_reflection.enabled) {
    all.emplace_back("sea_reflection.enabled is false");
  }
  return all.empty() ? "" : fmt::format(": {}", fmt::join(all, "; "));
}

}  // namespace

std::vector<KeyEffect> key_effects(const Pipeline& pipeline, const TrialLimit& limit) {
  const TimeLimit time(limit.processor_s, limit.stop);
  EffectSearch search(pipeline, time.flag());
  std::vector<KeyEffect> effects;
  for (std::size_t k = 0; k < search.keys().size(); ++k) {
    try {
      if (*time.flag()) throw Interrupted();
      effects.push_back(search.effect(k));
    } catch (const Interrupted&) {
      if (limit.stop != nullptr && *limit.stop) throw;
      effects.push_back({search.keys()[k], false, {}, false});
    }
  }
  return effects;
}

namespace {

// "a, b, c", of more than eight keys the first and the number of the others.
std::string keys_text(const std::vector<std::string>& keys) {
  constexpr std::size_t kMost = 8;
  if (keys.size() <= kMost) return fmt::format("{}", fmt::join(keys, ", "));
  return fmt::format("{} and {} other keys", keys.front(), keys.size() - 1);
}

}  // namespace

std::vector<std::string> constant_key_warnings(const Pipeline& pipeline, const TrialLimit& limit) {
  const Scenario& scenario = pipeline.scenario();
  std::vector<std::string> lines, untested;
  for (const KeyEffect& effect : key_effects(pipeline, limit)) {
    const std::string name = fmt::format("{} ({})", effect.key.key_path, effect.key.text());
    if (!effect.tested) {
      untested.push_back(effect.key.key_path);
    } else if (effect.same_targets.size() == pipeline.plan().classes().size()) {
      if (!effect.changes_clutter) {
        lines.push_back(fmt::format("{} changes nothing: maps that differ in it alone are equal{}", name,
                                    reasons(scenario, effect, true)));
      } else if (!effect.key.key_path.starts_with("clutter.") && !is_sea_alone(scenario)) {
        lines.push_back(fmt::format("{} changes clutter and noise alone, the echo of no target{}", name,
                                    reasons(scenario, effect, true)));
      }
    } else if (!effect.same_targets.empty()) {
      std::vector<std::string> names;
      for (const int t : effect.same_targets)
        names.push_back("targets." + scenario.targets[static_cast<std::size_t>(t)].name);
      lines.push_back(fmt::format("{} does not change the echo of {}{}", name, fmt::join(names, ", "),
                                  reasons(scenario, effect, false)));
    }
  }
  if (!untested.empty()) {
    lines.push_back(fmt::format(
        "{}: not tested whether the maps change: no two trial maps{}", keys_text(untested),
        std::isfinite(limit.processor_s) ? fmt::format(" within {:g} s of processor", limit.processor_s) : ""));
  }
  return lines;
}

namespace {

constexpr double kEnoughSeconds = 1;   // of maps whose work is measured, beyond the first of every target
constexpr double kShardBytes = 130e3;  // of a shard without samples: attributes and headers of its arrays
constexpr double kOtherBytes = 20e3;   // scenario, manifest and data card

// Places within the sweeps of sea and view at which maps are timed: the middle of a sweep of aspects, often broadside,
// takes longest.
struct TimedPlace {
  double sea, view;
};
constexpr TimedPlace kPlaces[] = {{0.5, 0.3}, {0.2, 0.8}, {0.8, 0.1}, {0, 0.6}, {1, 0.9}};

int index_at(double place, std::size_t count) {
  return static_cast<int>(std::lround(place * static_cast<double>(count - 1)));
}

// Processor time of the maps of one interval and of the sea of one realisation, s.
struct MeasuredWork {
  double intervals_s = 0, seas_s = 0;  // sums
  int intervals = 0, seas = 0;
};

// Adds a map of every target, at a place within the sweeps; those of one interval share its response. For a map that
// is stopped, the time until then.
void measure(const Pipeline& pipeline, const TimedPlace& place, const StopFlag* stop, MeasuredWork& work) {
  const SamplePlan& plan = pipeline.plan();
  SampleAddress at{.sea_state = index_at(place.sea, plan.sea_states().size()),
                   .view = index_at(place.view, plan.views().size()),
                   .interval = index_at(place.sea, static_cast<std::size_t>(plan.intervals()))};
  const auto seconds = [](const auto& make) {
    const double begin_s = thread_seconds();
    make();
    return thread_seconds() - begin_s;
  };
  ++work.seas;
  for (const int target : plan.classes()) {
    if (*stop) throw Interrupted();
    at.target = target;
    at.clutter = 0;
    work.seas_s += seconds([&] { pipeline.scene(at); });  // common to all targets unless their keys are drawn
    ++work.intervals;
    const double begin_s = thread_seconds();
    try {
      work.intervals_s += seconds([&] { pipeline.generate_sample(plan.sample(at), stop); });
      if (plan.maps_per_interval() == 1) continue;
      at.clutter = 1;
      work.intervals_s +=
          (plan.maps_per_interval() - 1) * seconds([&] { pipeline.generate_sample(plan.sample(at), stop); });
    } catch (const Interrupted&) {
      work.intervals_s += thread_seconds() - begin_s;
      throw;
    }
  }
}

// "85 s", "12 min", "3.4 h", "5.1 days".
std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.2g} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.2g} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.2g} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", std::ceil(bytes / 1e3));
  if (bytes < 99.5e6) return fmt::format("{:.2g} MB", bytes / 1e6);
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

std::string line(const char* name, const std::string& text) {
  return fmt::format("{:<19} {}\n", name, on_one_line(text));
}

std::string sea_line(const Scenario& scenario, const SamplePlan& plan) {
  const auto states = plan.sea_states().size();
  const int realisations = scenario.dataset.realisations_per_case, intervals = plan.intervals();
  std::string text = fmt::format("{}: {} realisation{} of each sea state, {} interval{} of each",
                                 states * static_cast<std::size_t>(realisations), realisations,
                                 realisations == 1 ? "" : "s", intervals, intervals == 1 ? "" : "s");
  if (intervals > 1) text += fmt::format(" {:g} s apart", scenario.dataset.interval_spacing_s);
  text += " and view";
  if (plan.looks() > 1)
    text += fmt::format(", {} looks {} apart", plan.looks(),
                        value_text(scenario, "looks.spacing_s", fmt::format("{:g} s", scenario.looks.spacing_s)));
  if (plan.maps_per_interval() > 1) text += fmt::format(", {} maps of each interval", plan.maps_per_interval());
  return line("seas", text);
}

// A line for each key, the first with the name.
std::string key_lines(const Scenario& scenario, bool drawn) {
  std::string text;
  for (const VariedKey& key : varied_keys(scenario)) {
    if ((key.drawn != nullptr) == drawn)
      text += line(text.empty() ? (drawn ? "drawn" : "swept") : "", fmt::format("{} {}", key.key_path, key.text()));
  }
  return text.empty() ? line(drawn ? "drawn" : "swept", "nothing") : text;
}

std::string motion_lines(const Pipeline& pipeline) {
  const std::vector<TrialSea> seas = trial_seas(pipeline);
  std::vector<double> heights_m;
  for (const TrialSea& sea : seas) heights_m.push_back(total_wave_height(sea.state));
  const auto [lowest_m, highest_m] = std::ranges::minmax(heights_m);
  const std::string where =
      seas.size() == 1 ? fmt::format("Hs {:.3g} m", highest_m)
                       : fmt::format("Hs {:.3g} to {:.3g} m, over {} drawn seas", lowest_m, highest_m, seas.size());
  if (is_sea_alone(pipeline.scenario())) return line("moves", "the sea alone");
  std::string text;
  const auto add = [&](const std::string& of) { text += line(text.empty() ? "moves" : "", of); };
  for (const TargetMotion& motion : target_motions(pipeline, seas)) {
    const std::string moves = motion_text(motion), rests = rest_text(motion);
    const TargetSpec& target = *motion.target;
    if (moves.empty()) {
      add(fmt::format("{}: {}{}", target.name, rests, line_text(target)));
      continue;
    }
    add(fmt::format("{}: {}, {} at {}{}{}{}", target.name,
                    kMotionModelNames[static_cast<std::size_t>(target.motion.model)], moves, where, line_text(target),
                    rests.empty() ? "" : "; ", rests));
  }
  for (const TargetSpec& target : pipeline.scenario().targets) {
    if (!has_mesh(target) && !is_sea_alone(target))
      add(fmt::format("{}: {} points with velocities of their own in any sea", target.name, target.points.size()));
  }
  return text;
}

double hundredths(double value) { return std::round(100 * value) / 100 + 0.0; }  // no negative zero

// Level, texture and velocity of the clutter and level of the noise, of the first view in the highest waves, with drawn
// keys at the middles of their distributions.
std::string clutter_line(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const ClutterSpec& spec = scenario.clutter;
  const View& view = pipeline.plan().views().front();
  const PulseTrain train = pipeline.nominal_train();
  ClutterScene scene = pipeline.nominal_clutter_scene();
  const double height_m = scene.significant_wave_height_m;
  constexpr const char* kRatios[] = {"per pulse", "in the map's peak cell", "within the target's extent in the map"};

  const auto against = [](double ratio_db) {
    return fmt::format("{:g} dB {}", std::abs(ratio_db), ratio_db < 0 ? "above" : "below");
  };
  std::string text;
  if (spec.enabled) {
    if (spec.level == ClutterLevel::kScr) {
      text = against(spec.scr_db) + " the target " + kRatios[static_cast<std::size_t>(spec.scr_definition)];
    } else {
      const double sigma0_db = sea_reflectivity_db(spec, scene, train.band_centre_hz());
      const double extent_m = train.unambiguous_range_m(),
                   area_m2 = clutter_patch_area_m2(scenario.radar, view.elevation_rad, extent_m),
                   power_m2 = std::pow(10, sigma0_db / 10) * area_m2 / (4 * kPi) * mean_power(train.chirp_spectrum);
      text = fmt::format(
          "sigma0 {:.2f} dB ({}, {}, elevation {:g} deg, Douglas sea state {:.2f}) on {:.4g} m x {:.4g} m: mean |Y|^2 "
          "{:.4g} m^2",
          sigma0_db, kClutterLevels[static_cast<std::size_t>(spec.level)],
          kPolarisationNames[static_cast<std::size_t>(scenario.radar.polarisation)], view.elevation_deg,
          sea_state_of(spec, scene), extent_m, area_m2 / extent_m, power_m2);
    }
    const bool is_under_way = std::ranges::any_of(scenario.targets, [](const TargetSpec& target) {
      return target.motion.speed_mps != 0 || (target.motion.drift && target.motion.drift->current_mps != 0);
    });
    std::optional<WaveField> waves;
    VelocityMoments moments;
    if (spec.doppler != ClutterDoppler::kPrescribed) {
      scene.waves = &waves.emplace(pipeline.nominal_waves());
      moments = clutter_velocity_moments(spec, scene, kSpeedOfLight / train.band_centre_hz());
    }
    const double cell_m = train.range_resolution_m();
    const TextureParameters texture = texture_parameters(spec, scene, train.band_centre_hz(), cell_m);
    const FittedFigure measured = k_shape(scene, train.band_centre_hz(), cell_m);
    double shape = texture.shape, width_mps = texture.spread_mps;
    if (texture_is_by_waves(spec)) {
      const WaveModulation modulation = wave_modulation(texture, scene, scatterers_per_cell(spec, cell_m), cell_m);
      shape = modulation.cell_shape;
      width_mps *= modulation.mean_width();
    }
    text += fmt::format("; texture {}of shape {:.3g}{}; velocity {:g} m/s, spread {:g} m/s{}",
                        texture_is_by_waves(spec) ? "modulated by the waves, " : "", shape,
                        height_m > 0 && spec.texture_shape && measured.is_within_range
                            ? fmt::format(" (measured clutter: {:.2g} in this scene)", measured.value)
                        : texture_is_by_waves(spec) && !spec.texture_shape && !measured.is_within_range
                            ? " (outside the fit of its formula)"
                            : "",
                        hundredths(spec.doppler_mean_mps + moments.mean_mps),
                        hundredths(std::hypot(width_mps, platform_doppler_spread_mps(scene), moments.spread_mps)),
                        spec.doppler == ClutterDoppler::kPrescribed
                            ? " in any sea"
                            : fmt::format(" at Hs {:.3g} m, azimuth {:g} deg{}", height_m, view.azimuth_deg,
                                          is_under_way ? ", of a target without its speed and current" : ""));
  }
  if (spec.noise_level == NoiseLevel::kCnr && !spec.enabled) return line("clutter", "none, and no noise");
  if (text.empty()) text = "none";
  switch (spec.noise_level) {
    case NoiseLevel::kCnr: text += "; noise " + against(spec.cnr_db) + " it"; break;
    case NoiseLevel::kSnr: text += "; noise " + against(spec.snr_db) + " the target per pulse"; break;
    case NoiseLevel::kThermal:
      text += fmt::format("; thermal noise, mean |Y|^2 {:.3g} m^2", thermal_noise_m2(train, scenario.radar));
      break;
  }
  return line("clutter", text);
}

}  // namespace

double stored_bytes(const Pipeline& pipeline) {
  const Scenario& scenario = pipeline.scenario();
  const DatasetSpec& set = scenario.dataset;
  const PulseTrain train = pipeline.nominal_train();
  const MapGrid grid = map_grid(train, scenario.map);
  const auto cells = static_cast<double>(grid.range_m.size() * grid.velocity_mps.size());
  const auto pulses = static_cast<double>(train.pulses()), frequencies = static_cast<double>(train.frequencies());
  double each = cells * sizeof(float) * (set.complex_maps ? 3 : 1);
  if (set.echoes) each += pulses * frequencies * 2 * sizeof(double);
  each += pulses * sizeof(std::uint16_t) + static_cast<double>(scenario.features.max_centres) * sizeof(StoredCentre);
  for (const SampleColumn& column : sample_columns())
    each += static_cast<double>(std::holds_alternative<std::string SampleRecord::*>(column.member) ? kNameBytes
                                                                                                   : sizeof(double));
  for (const Variation& variation : scenario.variations)
    each += static_cast<double>(variation.distribution.is_numeric() ? sizeof(double) : kNameBytes);
  const SamplePlan& plan = pipeline.plan();
  each *= plan.looks();
  return static_cast<double>(plan.size()) * each + static_cast<double>(plan.shards()) * kShardBytes + kOtherBytes;
}

WorkEstimate estimate_work(const Pipeline& pipeline, const TrialLimit& limit) {
  const SamplePlan& plan = pipeline.plan();
  WorkEstimate estimate{0, false, stored_bytes(pipeline), {}};
  const TimeLimit time(limit.processor_s, limit.stop);
  const double begin_s = thread_seconds();
  MeasuredWork work;
  try {
    for (const TimedPlace& place : kPlaces) {
      measure(pipeline, place, time.flag(), work);
      if (thread_seconds() - begin_s > kEnoughSeconds) break;
    }
  } catch (const Interrupted&) {
    if (limit.stop != nullptr && *limit.stop) throw;
    estimate.is_bound = work.intervals <= static_cast<int>(plan.classes().size());
    if (work.intervals == 0) work = {thread_seconds() - begin_s, 0, 1, 1};
  } catch (const InputError& error) {
    estimate.failure = error.what();
    return estimate;
  }
  const double intervals = static_cast<double>(plan.size()) / plan.maps_per_interval();
  const auto seas = static_cast<double>(plan.sea_states().size()) *
                    static_cast<double>(pipeline.scenario().dataset.realisations_per_case);
  estimate.processor_s = intervals * work.intervals_s / work.intervals + seas * work.seas_s / work.seas;
  return estimate;
}

std::string scenario_summary(const Pipeline& pipeline, const WorkEstimate& work, int threads) {
  const Scenario& scenario = pipeline.scenario();
  const double together = std::min(static_cast<double>(threads), static_cast<double>(pipeline.plan().size()));
  const std::string time =
      work.failure.empty() ? fmt::format("{} {} of processor, {} on {} thread{}, ",
                                         work.is_bound ? "more than" : "about", duration_text(work.processor_s),
                                         duration_text(work.processor_s / together), threads, threads == 1 ? "" : "s")
                           : "";
  return sea_line(scenario, pipeline.plan()) + key_lines(scenario, false) + key_lines(scenario, true) +
         motion_lines(pipeline) + clutter_line(pipeline) +
         line("work", fmt::format("{}{} of maps", time, size_text(work.bytes)));
}

}  // namespace seaglint
