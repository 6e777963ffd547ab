// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Generates one sample of a scenario: sea and motion, response, echo, map, features; and its I/Q samples. Every step is
// one call of one stage.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "classify/dataset/format/sample.h"
#include "classify/features/feature_vector.h"
#include "classify/features/scattering_centres.h"
#include "classify/features/tracks.h"
#include "radar/echo/echo.h"
#include "radar/rvmap/rv_map.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/process/parallel.h"
#include "sim/core/process/shared_results.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scenario/sample_plan.h"
#include "tools/pipeline/scene.h"

namespace seaglint {

// A look of a sample; the first where only its number is given.
struct SampleLook {
  std::size_t sample = 0;
  int look = 0;

  SampleLook(std::size_t of, int number = 0) : sample(of), look(number) {}
};

// All results for one sample, or one of its looks.
struct GeneratedSample {
  SampleAddress address;
  PulseTrain train;
  ReceivedInterval received;  // echo, map, measured SCR
  std::vector<ScatteringCentre> centres;
  std::vector<LookCentre> measured_centres;  // with standard errors; of a scenario with several looks
  FeatureVector features;
  Sample stored;  // as the data set stores it; of a sample with all its looks
};

// The sample of an echo: map, measured SCR, scattering centres, features, and what the data set stores of them. Map and
// features are those of `scenario`; `clutter` sets its level (form_received_interval()). `record`: the columns of the
// row that are not measured in the map.
GeneratedSample sample_of_echo(const Echo& echo, const PulseTrain& train, const Scenario& scenario,
                               const ClutterSpec& clutter, SampleRecord record, const StopFlag* stop = nullptr);

// The first look, with all of them in `stored`.
GeneratedSample with_all_looks(std::vector<GeneratedSample> looks);

// Tracks of the scattering centres over the looks of a sample, from generate_looks().
TrackSet tracks_of(std::span<const GeneratedSample> looks);

// The axes of a map.
StoredAxes stored_axes(const RvMap& map);

// Generates any sample of a scenario, in any order and from any thread.
class Pipeline {
 public:
  explicit Pipeline(const Scenario& scenario) : Pipeline(scenario, SamplePlan(scenario)) {}
  // Loads the meshes. Throws InputError, Interrupted when *stop becomes true.
  Pipeline(Scenario scenario, SamplePlan plan, const StopFlag* stop = nullptr);

  // Pipeline of another scenario in the range window of this one, with which it shares bodies of equal fields.
  Pipeline of_other(const Scenario& scenario) const;

  const Scenario& scenario() const { return scenario_; }
  const SamplePlan& plan() const { return plan_; }
  // As loaded with drawn keys at the middles of their distributions.
  const std::vector<Target>& targets() const { return *targets_; }
  // The scenario with the drawn values of a sample.
  Scenario scenario_of(const SampleAddress& at) const { return plan_.drawn(scenario_, at); }

  double window_m() const { return range_window_m_; }  // full width of the range window of all its maps, m
  // That of another scenario with the same targets.
  double window_m_of(const Scenario& other) const;

  // Its first look, with all its looks in `stored`. sample < plan().size(). Throws InputError when the target has no
  // power, Interrupted when *stop becomes true.
  GeneratedSample generate_sample(std::size_t sample, const StopFlag* stop = nullptr) const;
  // All looks of a sample. `response_of` returns the response of its target in a look. Clutter that is relative to the
  // target has one level in all looks: that of the ratio to the target's mean power over them.
  using ResponseOfLook = std::function<std::shared_ptr<const IntervalResult>(const SampleLook&, const PulseTrain&)>;
  std::vector<GeneratedSample> generate_looks(std::size_t sample, const StopFlag* stop = nullptr) const;
  std::vector<GeneratedSample> looks_of_responses(std::size_t sample, const ResponseOfLook& response_of,
                                                  const StopFlag* stop = nullptr) const;

  // Its steps after one another: the pulses of a look; the response of its target with its companions at their times
  // and frequencies; the echo; the map and its features. The last two throw InputError, naming target and sample, when
  // the response has no power; that of the sea alone is zero. level_change_db is added to clutter.scr_db.
  PulseTrain pulse_train(const SampleLook& of) const;
  IntervalResult response(const SampleAddress& at, const PulseTrain& train, const StopFlag* stop = nullptr) const;
  Echo echo(const SampleLook& of, const PulseTrain& train, const IntervalResult& response,
            const ClutterSpec& clutter) const;
  GeneratedSample received_sample(const SampleLook& of, const PulseTrain& train, const IntervalResult& response,
                                  const StopFlag* stop = nullptr, double level_change_db = 0) const;
  SampleAddress address(const SampleLook& of) const;

  // A pulse train with drawn keys at the middles of their distributions: band, frequencies and number of pulses of all
  // maps, and the hop code of the first.
  PulseTrain nominal_train() const;

  // The sea in the first view in the highest waves, drawn keys at the middles of their distributions; without waves.
  ClutterScene nominal_clutter_scene() const;
  WaveField nominal_waves() const;  // of its sea

  // The scene of a sample's sea, with all its intervals and at least this long; where keys of targets are drawn, with
  // the bodies of its target alone. The most recent ones are cached.
  std::shared_ptr<const Scene> scene(const SampleAddress& at, double at_least_s = 0) const;

 private:
  Pipeline(Scenario scenario, SamplePlan plan, std::shared_ptr<TargetCache> cache, std::optional<double> range_window_m,
           const StopFlag* stop);
  // What determines a sample's response: drawn values, and the scene of its sea.
  struct ObservedInterval {
    Scenario scenario;
    std::shared_ptr<const Scene> scene;
    View view;
    IntervalSampling sampling;
    double begin_s = 0;  // of the sample's first look, where companions and drifting floats are at their places
  };
  // H of a target: the sum over its bodies, or its ideal points.
  static IntervalResult target_response(std::size_t target, const ObservedInterval& seen, const StopFlag* stop);
  // Sea and motion that the clutter of a sample depends on; refers to the scene.
  ClutterScene clutter_scene(const SampleAddress& at, const Scene& scene) const;

  Scenario scenario_;
  SamplePlan plan_;
  std::shared_ptr<TargetCache> cache_;
  std::shared_ptr<const std::vector<Target>> targets_;
  double range_window_m_ = 0;

  // By sea state, realisation, target (-1: all) and least duration. Those of drawn targets have models of their own, up
  // to 100 MB each.
  mutable SharedResults<std::tuple<int, int, int, double>, Scene> scenes_{draws_targets(scenario_) ? 2u : 8u};
  // By the first sample of interval and target, and look.
  mutable SharedResults<std::pair<std::size_t, int>, IntervalResult> responses_{16};
};

// Echo of a sample over time as I/Q samples of a receiver. Target and clutter are those of the sample's map, at the
// same levels. Noise has the level of the map's noise but is another realisation: the map's frequencies contain only
// one part in `refinement` of it.
struct SampledInterval {
  PulseTrain train;                           // of the map
  SampledEcho target;                         // of the target with its companions
  std::optional<SampledEcho> clutter, noise;  // absent where the scenario has none
  SampleRecord record;  // row of the sample in a data set; of the sea alone, of which no map is made, without what
                        // is measured in the map (NaN)
};

// Throws InputError when radar.sampling_mhz fits no frequency grid, or the echo would hold more than 2^27 samples.
SampledInterval sampled_interval(const Pipeline& pipeline, std::size_t sample);

}  // namespace seaglint
