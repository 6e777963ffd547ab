// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>

#include "classify/dataset/directory/dataset_writer.h"
#include "classify/features/residual_echo.h"
#include "classify/features/scattering_centres.h"
#include "sim/canonical/point_response.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/motion/target_motion.h"
#include "sim/scattering/observation/observation.h"
#include "sim/sea/realisation.h"
#include "sim/sea/spectrum.h"

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

// The scenario; throws an InputError of all files that it names and that are missing.
Scenario with_files(Scenario scenario) {
  input_files(scenario);
  return scenario;
}

// The waves below a body of a target, of surface_profile: waves. The frame of a ship under way moves with it; a
// companion and a drifting float move from their places at begin_s, the start of the sample, relative to that frame,
// the float with its waves. velocity_mps: the body's mean one in the frame.
std::optional<WavesBelow> waves_below(const Scenario& scenario, const Scene& scene, const Target& target,
                                      const Vec3& velocity_mps, double begin_s) {
  if (scenario.sea_reflection.surface_profile == SurfaceProfileKind::kMean) return std::nullopt;
  const auto wind_sea = wind_sea_spectrum(scene.state);
  const double above_m2 = wind_sea ? wind_sea->energy_above(linear_cutoff(scene.state)) : 0;
  return WavesBelow{.field = &scene.sea,
                    .origin_m = begin_s * velocity_mps,
                    .velocity_mps = Vec3(target.spec.motion.speed_mps, 0, 0) - velocity_mps,
                    .rms_above_cutoff_m = std::sqrt(above_m2)};
}

// The points after this time.
std::vector<PointSpec> moved_on(std::vector<PointSpec> points, double time_s) {
  for (PointSpec& point : points)
    for (std::size_t i = 0; i < 3; ++i) point.position_m[i] += time_s * point.velocity_mps[i];
  return points;
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

Pipeline::Pipeline(Scenario scenario, SamplePlan plan, const StopFlag* stop)
    : Pipeline(with_files(std::move(scenario)), std::move(plan), std::make_shared<TargetCache>(), std::nullopt, stop) {
  check_draws(scenario_, plan_);
}

Pipeline::Pipeline(Scenario scenario, SamplePlan plan, std::shared_ptr<TargetCache> cache,
                   std::optional<double> range_window_m, const StopFlag* stop)
    : scenario_(std::move(scenario)),
      plan_(std::move(plan)),
      cache_(std::move(cache)),
      targets_(std::make_shared<const std::vector<Target>>(
          load_targets({.scenario = scenario_, .plan = plan_, .cache = cache_.get(), .stop = stop}))),
      range_window_m_(range_window_m ? *range_window_m : window_m_of(scenario_)) {}

Pipeline Pipeline::of_other(const Scenario& scenario) const {
  return Pipeline(scenario, SamplePlan(scenario), cache_, range_window_m_, nullptr);
}

double Pipeline::window_m_of(const Scenario& other) const {
  return range_window_m({.scenario = other, .plan = SamplePlan(other), .cache = cache_.get()}, *targets_);
}

std::shared_ptr<const Scene> Pipeline::scene(const SampleAddress& at, double at_least_s) const {
  if (at_least_s > 0) {
    auto usual = scene(at);
    const auto lasts = [&](const Trajectory& body) { return body.end_s() >= at_least_s; };
    if (std::ranges::all_of(usual->bodies, [&](const auto& bodies) { return std::ranges::all_of(bodies, lasts); }))
      return usual;
    constexpr double kStep_s = 30;  // so that many such calls are for few scenes
    at_least_s = kStep_s * std::ceil(at_least_s / kStep_s);
  }
  const bool is_alone = draws_targets(scenario_);
  return scenes_.get({at.sea_state, at.realisation, is_alone ? at.target : -1, at_least_s}, [&] {
    auto targets = targets_;
    if (!scenario_.variations.empty()) {
      const Scenario drawn = plan_.drawn(scenario_, {.sea_state = at.sea_state, .realisation = at.realisation});
      TargetRequest request{.scenario = drawn, .plan = plan_, .cache = cache_.get()};
      if (is_alone) request.only = static_cast<std::size_t>(at.target);
      targets = std::make_shared<const std::vector<Target>>(load_targets(request));
    }
    Scene scene = make_scene({.scenario = scenario_,
                              .targets = *targets,
                              .sea = {static_cast<std::size_t>(at.sea_state), static_cast<std::size_t>(at.realisation)},
                              .plan = &plan_,
                              .at_least_s = at_least_s});
    scene.targets = std::move(targets);
    return scene;
  });
}

IntervalResult Pipeline::target_response(std::size_t index, const ObservedInterval& seen, const StopFlag* stop) {
  const auto& [scenario, scene, view, sampling, begin_s] = seen;
  const Target& target = (*scene->targets)[index];
  const Vec3 r_hat = direction_to_radar(view.azimuth_rad, view.elevation_rad);
  const TargetSpec& spec = target.spec;
  const bool has_mirror = scenario.sea_reflection.enabled;
  const auto mirror_of = [&](const Vec3& velocity_mps) {
    return SeaReflection(scenario.sea_reflection, total_wave_height(scene->state),
                         waves_below(scenario, *scene, target, velocity_mps, begin_s));
  };
  if (target.models.empty()) {
    const std::vector<PointSpec> points = moved_on(spec.points, sampling.pulse_time_s.front() - begin_s);
    if (!has_mirror) return {point_response(points, r_hat, sampling), 0};
    return {point_response_over_sea(points, r_hat, sampling, scenario.radar.polarisation,
                                    mirror_of(target.relative_velocity_mps)),
            0};
  }
  IntervalResult sum;
  for (std::size_t i = 0; i < target.models.size(); ++i) {
    const Trajectory& body = scene->bodies[index][i];
    const Vec3& velocity_mps = scene->velocities_mps[index][i];
    const Trajectory carried = velocity_mps.isZero(0) ? body : body.with_drift(velocity_mps, begin_s);
    const SeaReflection mirror = mirror_of(velocity_mps);
    const IntervalResult term = solve({.scatterer = *target.models[i]->prepared->scatterer,
                                       .trajectory = carried,
                                       .r_hat = r_hat,
                                       .polarisation = scenario.radar.polarisation,
                                       .sampling = sampling,
                                       .solver = spec.solver,
                                       .sea = has_mirror ? &mirror : nullptr,
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

ClutterScene Pipeline::clutter_scene(const SampleAddress& at, const Scene& scene) const {
  // Maps of one sea, view and target have one texture; another target has another texture, since a texture common to
  // both labels would reveal one label from the other.
  const std::uint64_t sea_and_view =
      static_cast<std::uint64_t>(plan_.group(at)) * plan_.views().size() + static_cast<std::uint64_t>(at.view);
  const View view = plan_.view(at);
  const MotionSpec& motion = (*scene.targets)[static_cast<std::size_t>(at.target)].spec.motion;
  return {scenario_.radar,
          direction_to_radar(view.azimuth_rad, view.elevation_rad),
          total_wave_height(scene.state),
          main_direction_rad(scene.state),
          &scene.sea,
          plan_.start_s(at),
          Vec3(motion.speed_mps, 0, 0),
          sea_and_view * scenario_.targets.size() + static_cast<std::uint64_t>(at.target),
          current_mps(motion)};
}

namespace {

SampleAddress first_look(SampleAddress at) {
  at.look = 0;
  return at;
}

}  // namespace

SampleAddress Pipeline::address(const SampleLook& of) const {
  SampleAddress at = plan_.address(of.sample);
  at.look = of.look;
  return at;
}

IntervalResult Pipeline::response(const SampleAddress& at, const PulseTrain& train, const StopFlag* stop) const {
  const double start_s = plan_.start_s(at);
  ObservedInterval seen{scenario_of(at), scene(at, start_s + train.time_s.back()), plan_.view(at),
                        interval_sampling(train, start_s), plan_.start_s(first_look(at))};
  seen.sampling.line_of_sight_rate = Vec3(scenario_.radar.platform.velocity_mps) / (scenario_.radar.range_km * 1e3);
  const auto target = static_cast<std::size_t>(at.target);
  IntervalResult sum = target_response(target, seen, stop);
  for (const std::size_t companion : (*seen.scene->targets)[target].companions) {
    const IntervalResult term = target_response(companion, seen, stop);
    sum.response += term.response;
    sum.traces += term.traces;
  }
  return sum;
}

Echo Pipeline::echo(const SampleLook& of, const PulseTrain& train, const IntervalResult& response,
                    const ClutterSpec& clutter) const {
  const SampleAddress at = address(of);
  const std::shared_ptr<const Scene> moving = scene(at, plan_.start_s(at) + train.time_s.back());
  try {
    if (!is_sea_alone(scenario_)) require_power(response.response);
    return synthesise_echo(train, response.response, clutter, scenario_.seed, plan_.look_key(of.sample, of.look),
                           clutter_scene(at, *moving));
  } catch (const InputError& error) {
    const TargetSpec& target = scenario_.targets[static_cast<std::size_t>(at.target)];
    const View view = plan_.view(at);
    throw InputError(fmt::format("{}: sample {}, azimuth {:g} deg, elevation {:g} deg: {}",
                                 place_of(scenario_, "targets." + target.name), of.sample, view.azimuth_deg,
                                 view.elevation_deg, error.what()));
  }
}

PulseTrain Pipeline::pulse_train(const SampleLook& of) const {
  return make_pulse_train(scenario_of(plan_.address(of.sample)).radar, range_window_m_, scenario_.seed,
                          plan_.look_key(plan_.first_of_interval(of.sample), of.look));
}

ClutterScene Pipeline::nominal_clutter_scene() const {
  const SeaState& highest = *std::ranges::max_element(plan_.sea_states(), {}, total_wave_height);
  const View& view = plan_.views().front();
  return {.radar = scenario_.radar,
          .r_hat = direction_to_radar(view.azimuth_rad, view.elevation_rad),
          .significant_wave_height_m = total_wave_height(highest),
          .waves_towards_rad = main_direction_rad(highest)};
}

WaveField Pipeline::nominal_waves() const {
  const std::vector<SeaState>& states = plan_.sea_states();
  const auto highest = std::ranges::max_element(states, {}, total_wave_height);
  return realise_sea(*highest, scenario_.seed, sea_key(static_cast<std::size_t>(highest - states.begin()), 0));
}

PulseTrain Pipeline::nominal_train() const {
  return make_pulse_train(scenario_.radar, range_window_m_, scenario_.seed, 0);
}

GeneratedSample Pipeline::generate_sample(std::size_t sample, const StopFlag* stop) const {
  return with_all_looks(generate_looks(sample, stop));
}

GeneratedSample with_all_looks(std::vector<GeneratedSample> looks) {
  GeneratedSample sample = std::move(looks.front());
  for (std::size_t i = 1; i < looks.size(); ++i) sample.stored.further_looks.push_back(std::move(looks[i].stored));
  return sample;
}

std::vector<GeneratedSample> Pipeline::generate_looks(std::size_t sample, const StopFlag* stop) const {
  return looks_of_responses(
      sample,
      [&](const SampleLook& of, const PulseTrain& train) {
        const auto made = [&] { return response(address(of), train, stop); };
        if (plan_.maps_per_interval() == 1) return std::make_shared<const IntervalResult>(made());
        return responses_.get({plan_.first_of_interval(of.sample), of.look}, made);
      },
      stop);
}

std::vector<GeneratedSample> Pipeline::looks_of_responses(std::size_t sample, const ResponseOfLook& response_of,
                                                          const StopFlag* stop) const {
  std::vector<PulseTrain> trains;
  std::vector<std::shared_ptr<const IntervalResult>> responses;
  std::vector<double> powers_m2;
  for (int look = 0; look < plan_.looks(); ++look) {
    trains.push_back(pulse_train({sample, look}));
    responses.push_back(response_of({sample, look}, trains.back()));
    powers_m2.push_back(mean_power(responses.back()->response.values));
  }
  const double mean_m2 =
      std::accumulate(powers_m2.begin(), powers_m2.end(), 0.0) / static_cast<double>(powers_m2.size());
  std::vector<GeneratedSample> looks;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const double change_db = powers_m2[i] > 0 && responses.size() > 1 ? 10 * std::log10(powers_m2[i] / mean_m2) : 0;
    looks.push_back(received_sample({sample, static_cast<int>(i)}, trains[i], *responses[i], stop, change_db));
  }
  return looks;
}

GeneratedSample Pipeline::received_sample(const SampleLook& of, const PulseTrain& train, const IntervalResult& response,
                                          const StopFlag* stop, double level_change_db) const {
  const SampleAddress at = address(of);
  SampleRecord record = planned_record(scenario_, plan_, of.sample, at);
  record.aspect_traces = response.traces;
  const std::shared_ptr<const Scene> moving = scene(at, plan_.start_s(at) + train.time_s.back());
  const std::vector<Trajectory>& bodies = moving->bodies[static_cast<std::size_t>(at.target)];
  const double middle_s = plan_.start_s(at) + 0.5 * (train.time_s.front() + train.time_s.back());
  if (!bodies.empty()) store_motion(bodies.front(), middle_s, record);  // points have velocities only
  ClutterSpec clutter = scenario_of(at).clutter;
  clutter.scr_db += level_change_db;
  GeneratedSample made =
      sample_of_echo(echo(of, train, response, clutter), train, scenario_, clutter, std::move(record), stop);
  made.address = at;
  if (scenario_.dataset.echoes) {
    for (const Complex& value : response.response.values) {
      made.stored.echo.push_back(value.real());
      made.stored.echo.push_back(value.imag());
    }
  }
  return made;
}

namespace {

CoherentInterval coherent_interval(const PulseTrain& train, const RadarSpec& radar) {
  return {.bandwidth_hz = train.synthetic_bandwidth_hz(),
          .duration_s = 1e-6 * radar.pri_us * radar.pulses,
          .wavelength_m = kSpeedOfLight / train.band_centre_hz()};
}

// Index of the value of an even axis nearest to x.
std::size_t nearest(const std::vector<double>& axis, double x) {
  if (axis.size() < 2) return 0;
  const double at = std::round((x - axis.front()) / (axis[1] - axis[0]));
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(axis.size() - 1)));
}

// The floor of a centre is that of the residual at its cell.
std::vector<LookCentre> with_errors(const CleanedMap& cleaned, const PulseTrain& train, const RadarSpec& radar) {
  const RvMap& residual = cleaned.residual;
  const std::vector<double> floor_m2 = residual_floor(residual);
  const CoherentInterval interval = coherent_interval(train, radar);
  std::vector<LookCentre> measured;
  for (const ScatteringCentre& centre : cleaned.centres) {
    const std::size_t cell = nearest(residual.velocity_mps, centre.velocity_mps) * residual.columns() +
                             nearest(residual.range_m, centre.range_m);
    const double least_m2 = std::pow(1e-6 * centre.amplitude_m, 2);  // without clutter and noise
    measured.push_back(with_errors(centre, std::sqrt(std::max(floor_m2[cell], least_m2)), interval));
  }
  return measured;
}

}  // namespace

TrackSet tracks_of(std::span<const GeneratedSample> looks) {
  std::vector<Look> measured;
  for (const GeneratedSample& look : looks) {
    const double middle_s = 0.5 * (look.train.time_s.front() + look.train.time_s.back());
    measured.push_back({look.stored.record.start_s + middle_s, look.measured_centres});
  }
  return associate(measured);
}

GeneratedSample sample_of_echo(const Echo& echo, const PulseTrain& train, const Scenario& scenario,
                               const ClutterSpec& clutter, SampleRecord record, const StopFlag* stop) {
  GeneratedSample made;
  made.train = train;
  const bool intra_pulse_motion = scenario.radar.intra_pulse_motion;
  made.received = form_received_interval(echo, train, clutter, scenario.map, intra_pulse_motion, stop);
  CleanedMap cleaned = clean_map(made.received.echo, train, scenario.map, intra_pulse_motion, scenario.features, stop);
  if (scenario.looks.count > 1) made.measured_centres = with_errors(cleaned, train, scenario.radar);
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

namespace {

// Mean power at the map's frequencies.
double power_of_map(const SampledEcho& sampled, const PulseTrain& train) {
  return mean_power(spectrum_of(sampled, train));
}

// Samples of all pulses: 2 GB for each of target, clutter and noise.
constexpr double kMaxSamples = 134217728;

void check_size(const Scenario& scenario, const PulseTrain& fine, double sampling_hz) {
  const double per_pulse = samples_per_pulse(fine, sampling_hz);
  const auto pulses = static_cast<double>(fine.pulses());
  if (pulses * per_pulse <= kMaxSamples) return;
  throw InputError(fmt::format("{}: value {}: with {:.0f} samples of each pulse at most {:.0f} pulses make an echo",
                               place_of(scenario, "radar.pulses"), pulses, per_pulse,
                               std::floor(kMaxSamples / per_pulse)));
}

// The response at the frequencies of the map, each the middle one of those of the fine grid in its cell.
IntervalResult at_map_frequencies(const IntervalResult& fine_response, const PulseTrain& train,
                                  const PulseTrain& fine) {
  const auto refinement = static_cast<std::size_t>(fine.grid_refinement);
  IntervalResult result{{static_cast<int>(train.pulses()), static_cast<int>(train.frequencies()), {}},
                        fine_response.traces};
  for (std::size_t i = 0; i < train.pulses() * train.frequencies(); ++i)
    result.response.values.push_back(fine_response.response.values[i * refinement + refinement / 2]);
  return result;
}

// NaN in the place of what is measured in a map.
SampleRecord without_map(SampleRecord record) {
  for (const SampleColumn& column : sample_columns().subspan(planned_columns().size())) {
    if (const auto* member = std::get_if<double SampleRecord::*>(&column.member))
      record.*(*member) = std::numeric_limits<double>::quiet_NaN();
  }
  return record;
}

void scale(SampledEcho& sampled, double power_gain) {
  for (Complex& value : sampled.values) value *= std::sqrt(power_gain);
}

}  // namespace

SampledInterval sampled_interval(const Pipeline& pipeline, std::size_t sample) {
  const SampleAddress at = pipeline.plan().address(sample);
  const Scenario scenario = pipeline.scenario_of(at);
  const double sampling_hz = scenario.radar.sampling_mhz * 1e6;
  const PulseTrain train = pipeline.pulse_train(sample), fine = train_for_samples(train, scenario.radar);
  check_size(scenario, fine, sampling_hz);
  const IntervalResult response = pipeline.response(at, fine);
  const Echo echo = pipeline.echo(sample, fine, response, scenario.clutter);

  SampledInterval interval;
  interval.train = train;
  interval.target = sample_echo(echo.target, fine, sampling_hz);
  if (is_sea_alone(scenario)) {
    // Absolute levels are those of any grid, but for noise below the clutter, which is so at the map's frequencies. No
    // map is made: its time grows with the square of the pulses.
    interval.record = without_map(planned_record(scenario, pipeline.plan(), sample, at));
    if (!echo.clutter.empty()) interval.clutter = sample_echo(echo.clutter, fine, sampling_hz);
    if (!echo.noise.empty()) interval.noise = sample_echo(echo.noise, fine, sampling_hz);
    if (interval.noise && scenario.clutter.noise_level == NoiseLevel::kCnr)
      scale(*interval.noise, fine.grid_refinement);
    return interval;
  }
  const GeneratedSample made = pipeline.received_sample(sample, train, at_map_frequencies(response, train, fine));
  interval.record = made.stored.record;
  const auto with_level = [&](const std::vector<Complex>& part, double power_m2) {
    SampledEcho sampled = sample_echo(part, fine, sampling_hz);
    scale(sampled, power_m2 / power_of_map(sampled, train));
    return sampled;
  };
  if (!echo.clutter.empty()) interval.clutter = with_level(echo.clutter, made.received.clutter_power_m2);
  if (!echo.noise.empty()) interval.noise = with_level(echo.noise, fine.grid_refinement * made.received.noise_power_m2);
  return interval;
}

}  // namespace seaglint
