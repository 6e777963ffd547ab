// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/features/scattering_centres.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {

namespace {

// Motion of a body at time t.
void store_motion(const Trajectory& body, double t, SampleRecord& record) {
  const MotionSample motion = body.sample(t);
  record.roll_deg = degrees(motion.angles.x());
  record.pitch_deg = degrees(motion.angles.y());
  record.yaw_deg = degrees(motion.angles.z());
  record.heave_m = motion.translation.z();
  record.roll_rate_deg_s = degrees(motion.angle_rates.x());
  record.pitch_rate_deg_s = degrees(motion.angle_rates.y());
  record.yaw_rate_deg_s = degrees(motion.angle_rates.z());
  record.heave_rate_mps = motion.translation_rates.z();
}

// Map, hop code and centres as the data set stores them.
void store_signal(const GeneratedSample& made, bool complex_maps, Sample& stored) {
  const std::vector<Complex>& values = made.received.map.values;
  stored.magnitude.reserve(values.size());
  double peak = 0, energy = 0;
  for (const Complex& value : values) {
    const double magnitude = std::abs(value);
    peak = std::max(peak, magnitude);
    energy += magnitude * magnitude;
    stored.magnitude.push_back(static_cast<float>(magnitude));
    if (complex_maps) {
      stored.complex_values.push_back(static_cast<float>(value.real()));
      stored.complex_values.push_back(static_cast<float>(value.imag()));
    }
  }
  stored.record.peak_m = peak;
  stored.record.energy_m2 = energy;
  for (const int carrier : made.train.code) stored.hop_code.push_back(static_cast<std::uint16_t>(carrier));
  for (const ScatteringCentre& centre : made.centres) {
    stored.centre_list.push_back({static_cast<float>(centre.range_m), static_cast<float>(centre.velocity_mps),
                                  static_cast<float>(centre.amplitude_m)});
  }
}

}  // namespace

namespace {

// The scenario; throws an InputError of all files that it names and that are missing.
Scenario with_files(Scenario scenario) {
  input_files(scenario);
  return scenario;
}

// Throws InputError for an observation whose drawn values contradict each other.
void check_draws(const Scenario& scenario, const SamplePlan& plan) {
  if (scenario.variations.empty()) return;
  for (std::size_t sample = 0; sample < plan.size(); ++sample) {
    const SampleAddress at = plan.address(sample);
    if (at.target == plan.classes().front()) plan.drawn(scenario, at);
  }
}

}  // namespace

Pipeline::Pipeline(Scenario scenario, SamplePlan plan)
    : scenario_(with_files(std::move(scenario))),
      plan_(std::move(plan)),
      loaded_(std::make_shared<LoadedBodies>()),
      targets_(std::make_shared<const std::vector<Target>>(load_targets(scenario_, plan_, loaded_.get()))),
      range_window_m_(range_window_m(scenario_, plan_, *targets_)) {
  check_draws(scenario_, plan_);
}

Pipeline::Pipeline(Scenario scenario, SamplePlan plan, std::shared_ptr<LoadedBodies> loaded, double range_window_m)
    : scenario_(std::move(scenario)),
      plan_(std::move(plan)),
      loaded_(std::move(loaded)),
      targets_(std::make_shared<const std::vector<Target>>(load_targets(scenario_, plan_, loaded_.get()))),
      range_window_m_(range_window_m) {}

Pipeline Pipeline::of_other(const Scenario& scenario) const {
  return Pipeline(scenario, SamplePlan(scenario), loaded_, range_window_m_);
}

std::shared_ptr<const Scene> Pipeline::scene(int sea_state, int realisation) const {
  return scenes_.get({sea_state, realisation}, [&] {
    auto targets = targets_;
    if (!scenario_.variations.empty()) {
      const Scenario drawn = plan_.drawn(scenario_, {.sea_state = sea_state, .realisation = realisation});
      targets = std::make_shared<const std::vector<Target>>(load_targets(drawn, plan_, loaded_.get()));
    }
    Scene scene = make_scene(scenario_, plan_, *targets, sea_state, realisation);
    scene.targets = std::move(targets);
    return scene;
  });
}

IntervalResult Pipeline::target_response(std::size_t index, const ObservedInterval& seen, const StopFlag* stop) {
  const auto& [scenario, scene, view, state, sampling] = seen;
  const Target& target = (*scene->targets)[index];
  const Vec3 r_hat = direction_to_radar(view.azimuth_rad, view.elevation_rad);
  const SeaReflection mirror(scenario.sea_reflection, total_wave_height(state));
  const SeaReflection* sea = scenario.sea_reflection.enabled ? &mirror : nullptr;
  const TargetSpec& spec = target.spec;
  const Vec3& relative_velocity_mps = target.relative_velocity_mps;
  if (target.models.empty()) {
    if (sea != nullptr)
      return {point_response_over_sea(spec.points, r_hat, sampling, scenario.radar.polarisation, *sea), 0};
    return {point_response(spec.points, r_hat, sampling), 0};
  }
  IntervalResult sum;
  for (std::size_t i = 0; i < target.models.size(); ++i) {
    const Trajectory& body = scene->bodies[index][i];
    // A companion is at its given place at the start of the interval.
    const Trajectory carried =
        relative_velocity_mps.isZero(0) ? body : body.with_drift(relative_velocity_mps, sampling.pulse_time_s.front());
    const IntervalResult term = solve({.scatterer = *target.models[i]->prepared->scatterer,
                                       .trajectory = carried,
                                       .r_hat = r_hat,
                                       .polarisation = scenario.radar.polarisation,
                                       .sampling = sampling,
                                       .solver = spec.solver,
                                       .sea = sea,
                                       .stop = stop});
    sum.traces += term.traces;
    if (sum.response.values.empty()) {
      sum.response = term.response;
    } else {
      sum.response += term.response;
    }
  }
  return sum;
}

IntervalSampling Pipeline::sampling(const PulseTrain& train, double start_s) const {
  IntervalSampling sampling = interval_sampling(train, start_s);
  sampling.line_of_sight_rate = Vec3(scenario_.radar.platform.velocity_mps) / (scenario_.radar.range_km * 1e3);
  return sampling;
}

ClutterScene Pipeline::clutter_scene(const SampleAddress& at, const Scene& scene) const {
  // Maps of one sea, view and target have one texture; another target has another texture, since a texture common to
  // both labels would reveal one label from the other.
  const std::uint64_t sea_and_view =
      static_cast<std::uint64_t>(plan_.group(at)) * plan_.views().size() + static_cast<std::uint64_t>(at.view);
  const View view = plan_.view(at);
  return {scenario_.radar,
          direction_to_radar(view.azimuth_rad, view.elevation_rad),
          total_wave_height(plan_.sea_state(at)),
          &scene.sea,
          plan_.start_s(at),
          Vec3((*scene.targets)[static_cast<std::size_t>(at.target)].spec.motion.speed_mps, 0, 0),
          sea_and_view * scenario_.targets.size() + static_cast<std::uint64_t>(at.target)};
}

IntervalResult Pipeline::response(const SampleAddress& at, const PulseTrain& train, const StopFlag* stop) const {
  const ObservedInterval seen{scenario_of(at), scene(at.sea_state, at.realisation), plan_.view(at), plan_.sea_state(at),
                              sampling(train, plan_.start_s(at))};
  const auto target = static_cast<std::size_t>(at.target);
  IntervalResult sum = target_response(target, seen, stop);
  for (const std::size_t companion : (*seen.scene->targets)[target].companions) {
    const IntervalResult term = target_response(companion, seen, stop);
    sum.response += term.response;
    sum.traces += term.traces;
  }
  return sum;
}

Echo Pipeline::echo_of(std::size_t sample, const SampleAddress& at, const PulseTrain& train,
                       const IntervalResult& response, const Scene& scene) const {
  try {
    return synthesise_echo(train, response.response, scenario_of(at).clutter, scenario_.seed, sample,
                           clutter_scene(at, scene));
  } catch (const InputError& error) {
    const TargetSpec& target = scenario_.targets[static_cast<std::size_t>(at.target)];
    const View view = plan_.view(at);
    throw InputError(fmt::format("{}: sample {}, azimuth {:g} deg, elevation {:g} deg: {}",
                                 place_of(scenario_, "targets." + target.name), sample, view.azimuth_deg,
                                 view.elevation_deg, error.what()));
  }
}

PulseTrain Pipeline::pulse_train(std::size_t sample) const {
  return make_pulse_train(scenario_of(plan_.address(sample)).radar, range_window_m_, scenario_.seed,
                          plan_.first_of_interval(sample));
}

GeneratedSample Pipeline::generate_sample(std::size_t sample, const StopFlag* stop) const {
  const PulseTrain train = pulse_train(sample);
  const auto made = [&] { return response(plan_.address(sample), train, stop); };
  if (plan_.maps_per_interval() == 1) return received_sample(sample, train, made());
  return received_sample(sample, train, *responses_.get(plan_.first_of_interval(sample), made));
}

GeneratedSample Pipeline::received_sample(std::size_t sample, const PulseTrain& train,
                                          const IntervalResult& response) const {
  const SampleAddress at = plan_.address(sample);
  // Sea and motion are common to both classes and all views; hop code, clutter and noise are specific to the sample.
  const std::shared_ptr<const Scene> moving = scene(at.sea_state, at.realisation);
  SampleRecord record = planned_record(scenario_, plan_, sample, at);
  record.aspect_traces = response.traces;
  const std::vector<Trajectory>& bodies = moving->bodies[static_cast<std::size_t>(at.target)];
  const double middle_s = plan_.start_s(at) + 0.5 * (train.time_s.front() + train.time_s.back());
  if (!bodies.empty()) store_motion(bodies.front(), middle_s, record);  // points have velocities only
  GeneratedSample made = sample_of_echo(echo_of(sample, at, train, response, *moving), train, scenario_,
                                        scenario_of(at).clutter, std::move(record));
  made.address = at;
  if (scenario_.dataset.echoes) {
    for (const Complex& value : response.response.values) {
      made.stored.echo.push_back(value.real());
      made.stored.echo.push_back(value.imag());
    }
  }
  return made;
}

GeneratedSample sample_of_echo(const Echo& echo, const PulseTrain& train, const Scenario& scenario,
                               const ClutterSpec& clutter, SampleRecord record) {
  GeneratedSample made;
  made.train = train;
  const bool intra_pulse_motion = scenario.radar.intra_pulse_motion;
  made.received = form_received_interval(echo, train, clutter, scenario.map, intra_pulse_motion);
  CleanedMap cleaned = clean_map(made.received.echo, train, scenario.map, intra_pulse_motion, scenario.features);
  if (scenario.map.clean) made.received.map.values = restored_map(cleaned, train, scenario.map).values;
  made.centres = std::move(cleaned.centres);
  made.features = compute_features(made.centres, scenario.features);

  record.unused_carriers = made.received.map.unused_carriers;
  record.scr_per_pulse_db = made.received.scr.per_pulse_db;
  record.scr_peak_cell_db = made.received.scr.peak_cell_db;
  record.scr_extent_db = made.received.scr.scr_extent_db;
  record.snr_per_pulse_db = made.received.scr.snr_per_pulse_db;
  record.mwr = made.features.mwr;
  record.ccf = made.features.ccf;
  record.sigma_r_m = made.features.sigma_r;
  record.sigma_v_mps = made.features.sigma_v;
  record.centres = made.features.centres;
  record.degenerate = made.features.degenerate ? 1 : 0;
  made.stored.record = std::move(record);
  store_signal(made, scenario.dataset.complex_maps, made.stored);
  return made;
}

StoredAxes stored_axes(const RvMap& map) { return {map.range_m, map.velocity_mps}; }

}  // namespace seaglint
