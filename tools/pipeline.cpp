// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "classify/dataset/planned_record.h"
#include "radar/echo/echo.h"
#include "sim/core/constants.h"
#include "sim/core/error.h"
#include "sim/scattering/point_response.h"

namespace seaglint {

namespace {

constexpr std::size_t kScenesKept = 8;

// Map, hop code and centres as the data set stores them.
void store_signal(const MadeSample& made, bool complex_maps, Sample& stored) {
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

// A scene that one thread makes while others wait for it.
struct Pipeline::SceneSlot {
  int sea_state = 0;
  int realisation = 0;
  std::once_flag made;
  std::shared_ptr<const Scene> scene;
};

Pipeline::Pipeline(Scenario scenario)
    : scenario_(std::move(scenario)),
      plan_(scenario_),
      sea_states_(sea_states(scenario_.sea)),
      views_(views(scenario_.view)),
      targets_(load_targets(scenario_)),
      range_window_m_(range_window_m(scenario_, targets_)) {
  for (const Target& target : targets_) {
    const double crease = radians(target.spec.solver.crease_deg);
    scatterers_.push_back(target.rest_positions.empty()
                              ? nullptr
                              : std::make_unique<const Scatterer>(target.mesh, target.materials, crease));
  }
}

std::shared_ptr<const Scene> Pipeline::scene(int sea_state, int realisation) const {
  std::shared_ptr<SceneSlot> slot;
  {
    const std::lock_guard lock(scenes_mutex_);
    for (const auto& known : scenes_) {
      if (known->sea_state == sea_state && known->realisation == realisation) slot = known;
    }
    if (!slot) {
      slot = std::make_shared<SceneSlot>();
      slot->sea_state = sea_state;
      slot->realisation = realisation;
      if (scenes_.size() == kScenesKept) scenes_.erase(scenes_.begin());
      scenes_.push_back(slot);
    }
  }
  std::call_once(slot->made, [&] {
    slot->scene = std::make_shared<const Scene>(make_scene(scenario_, targets_, sea_state, realisation));
  });
  return slot->scene;
}

BodyResponse Pipeline::target_response(std::size_t target, const Scene& scene, const View& view, const SeaState& state,
                                       const IntervalSampling& sampling) const {
  const Vec3 r_hat = direction_to_radar(view);
  const SeaMirror mirror(scenario_.sea_reflection, total_wave_height(state));
  const SeaMirror* sea = scenario_.sea_reflection.enabled ? &mirror : nullptr;
  const TargetSpec& spec = targets_[target].spec;
  if (!scatterers_[target]) {
    if (sea != nullptr)
      return {point_response_over_sea(spec.points, r_hat, sampling, scenario_.radar.polarisation, *sea), 0};
    return {point_response(spec.points, r_hat, sampling), 0};
  }
  BodyResponse sum;
  for (const Trajectory& body : scene.bodies[target]) {
    const BodyResponse term =
        respond(*scatterers_[target], body, r_hat, scenario_.radar.polarisation, sampling, spec.solver, 1, sea);
    sum.traces += term.traces;
    if (sum.response.values.empty()) {
      sum.response = term.response;
    } else {
      sum.response += term.response;
    }
  }
  return sum;
}

MadeSample Pipeline::make(std::size_t sample) const {
  MadeSample made;
  made.address = plan_.address(sample);
  const SampleAddress& at = made.address;
  const View& view = views_[static_cast<std::size_t>(at.view)];
  const double start_s = plan_.start_s(at);

  // Sea and motion are shared by both classes and all views; hop code, clutter and noise are the sample's own.
  const std::shared_ptr<const Scene> moving = scene(at.sea_state, at.realisation);
  made.train = make_pulse_train(scenario_.radar, range_window_m_, scenario_.seed, sample);
  const SeaState& state = sea_states_[static_cast<std::size_t>(at.sea_state)];
  const BodyResponse response = target_response(static_cast<std::size_t>(at.target), *moving, view, state,
                                                interval_sampling(made.train, start_s));
  const Echo echo = synthesize_echo(made.train, response.response, scenario_.clutter, scenario_.seed, sample);
  made.received = receive(echo, made.train, scenario_.clutter, scenario_.map, scenario_.radar.intra_pulse_motion);
  made.centres = extract_centres(made.received.echo, made.train, scenario_.map, scenario_.radar.intra_pulse_motion,
                                 scenario_.features);
  made.features = compute_features(made.centres, scenario_.features);

  SampleRecord& record = made.stored.record;
  record = planned_record(scenario_, plan_, sample);
  record.empty_carriers = made.received.map.empty_carriers;
  record.scr_per_pulse_db = made.received.scr.per_pulse_db;
  record.scr_peak_cell_db = made.received.scr.peak_cell_db;
  record.scr_extent_db = made.received.scr.extent_db;
  record.mwr = made.features.mwr;
  record.ccf = made.features.ccf;
  record.sigma_r_m = made.features.sigma_r;
  record.sigma_v_mps = made.features.sigma_v;
  record.centres = made.features.centres;
  record.degenerate = made.features.degenerate ? 1 : 0;
  record.traces = response.traces;
  store_signal(made, scenario_.dataset.complex_maps, made.stored);
  return made;
}

StoredAxes stored_axes(const RvMap& map) { return {map.range_m, map.velocity_mps}; }

}  // namespace seaglint
