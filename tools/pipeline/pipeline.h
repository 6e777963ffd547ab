// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Generates one sample of a scenario: sea and motion, response, echo, map, features. Every step is one call of one
// stage.

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "classify/dataset/format/sample.h"
#include "classify/features/feature_vector.h"
#include "classify/features/scattering_centres.h"
#include "radar/echo/echo.h"
#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/process/parallel.h"
#include "sim/core/process/shared_results.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scenario/sample_plan.h"
#include "tools/pipeline/scene.h"

namespace seaglint {

// All results for one sample.
struct GeneratedSample {
  SampleAddress address;
  PulseTrain train;
  ReceivedInterval received;  // echo, map, measured SCR
  std::vector<ScatteringCentre> centres;
  FeatureVector features;
  Sample stored;  // as the data set stores it
};

// The sample of an echo: map, measured SCR, scattering centres, features, and what the data set stores of them. Map and
// features are those of `scenario`; `clutter` sets its level (form_received_interval()). `record`: the columns of the
// row that are not measured in the map.
GeneratedSample sample_of_echo(const Echo& echo, const PulseTrain& train, const Scenario& scenario,
                               const ClutterSpec& clutter, SampleRecord record);

// Generates any sample of a scenario, in any order and from any thread.
class Pipeline {
 public:
  explicit Pipeline(const Scenario& scenario) : Pipeline(scenario, SamplePlan(scenario)) {}
  Pipeline(Scenario scenario, SamplePlan plan);  // loads the meshes; throws InputError

  // Pipeline of another scenario in the range window of this one, with which it shares bodies of equal fields.
  Pipeline of_other(const Scenario& scenario) const;

  const Scenario& scenario() const { return scenario_; }
  const SamplePlan& plan() const { return plan_; }
  // As loaded with drawn keys at the middles of their distributions.
  const std::vector<Target>& targets() const { return *targets_; }
  // The scenario with the drawn values of a sample.
  Scenario scenario_of(const SampleAddress& at) const { return plan_.drawn(scenario_, at); }

  // sample < plan().size(). Throws InputError when the target has no power, Interrupted when *stop becomes true while
  // its response is computed.
  GeneratedSample generate_sample(std::size_t sample, const StopFlag* stop = nullptr) const;

  // Its two steps after one another: the pulses of a sample; and the sample whose target has this response at their
  // times and frequencies. Throws InputError when the response has no power.
  PulseTrain pulse_train(std::size_t sample) const;
  GeneratedSample received_sample(std::size_t sample, const PulseTrain& train, const IntervalResult& response) const;

  double window_m() const { return range_window_m_; }  // full width of the range window of all its maps, m

  // Frequency response H of a sample's target with its companions, at the times and frequencies of `train`.
  IntervalResult response(const SampleAddress& at, const PulseTrain& train, const StopFlag* stop = nullptr) const;

  // Sea and motion that the clutter of a sample depends on; refers to the scene.
  ClutterScene clutter_scene(const SampleAddress& at, const Scene& scene) const;

  // The scene of a realisation; the most recent ones are cached.
  std::shared_ptr<const Scene> scene(int sea_state, int realisation) const;

 private:
  // What determines a sample's response: drawn values, and the scene of its sea.
  struct ObservedInterval {
    Scenario scenario;
    std::shared_ptr<const Scene> scene;
    View view;
    SeaState state;
    IntervalSampling sampling;
  };
  // Times and directions at which the interval from start_s samples the response, with the radar's own motion.
  IntervalSampling sampling(const PulseTrain& train, double start_s) const;
  // H of a target: the sum over its bodies, or its ideal points.
  static IntervalResult target_response(std::size_t target, const ObservedInterval& seen, const StopFlag* stop);

  // The echo of a sample. Throws InputError, naming target and sample, when it has no power.
  Echo echo_of(std::size_t sample, const SampleAddress& at, const PulseTrain& train, const IntervalResult& response,
               const Scene& scene) const;

  Pipeline(Scenario scenario, SamplePlan plan, std::shared_ptr<LoadedBodies> loaded, double range_window_m);

  Scenario scenario_;
  SamplePlan plan_;
  std::shared_ptr<LoadedBodies> loaded_;
  std::shared_ptr<const std::vector<Target>> targets_;
  double range_window_m_ = 0;

  mutable SharedResults<std::pair<int, int>, Scene> scenes_{8};       // by sea state and realisation
  mutable SharedResults<std::size_t, IntervalResult> responses_{16};  // by the first sample of an interval and target
};

// The axes of a map.
StoredAxes stored_axes(const RvMap& map);

}  // namespace seaglint
