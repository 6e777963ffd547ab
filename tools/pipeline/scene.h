// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The bodies of a scenario: their meshes, scatterers and motion models, their places, and their motion in one sea
// realisation.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/motion/body.h"
#include "sim/motion/kinematics/trajectory.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"
#include "sim/sea/wave_field.h"
#include "tools/figure/motion_figures.h"

namespace seaglint {

// A mesh as its file or its generator has it, in metres with its axes turned, neither enlarged nor moved.
struct SourceMesh {
  TriangleMesh mesh;
  std::optional<double> centre_of_gravity_m;  // height above the waterline, of a generated ship
  Bounds box;
  double radius_m = 0;  // largest distance of a vertex from the origin
};

// What equal bodies of a target have in common: those of one size and, of decoys with random imperfections, one each.
struct BodyModel {
  double scale = 1;                                // factor by which the mesh of the file is enlarged, after its unit
  Bounds box;                                      // of the whole mesh at this scale and offset
  double radius_m = 0;                             // largest distance of a vertex of `prepared` from the mesh's origin
  std::shared_ptr<const SourceMesh> source;        // whole
  std::shared_ptr<const PreparedTarget> prepared;  // cut at the waterline; null for TargetUse::kMotion
  std::shared_ptr<const Body> motion;  // of a rigid raft that of the raft, whatever the size of its reflectors
};

// A target as loaded: bodies of one mesh, or ideal points.
struct Target {
  TargetSpec spec;
  std::vector<std::shared_ptr<const BodyModel>> models;  // of each body; empty for points
  std::vector<double> radii_m;          // largest distance of each body's vertices from its origin; empty for points
  std::vector<Vec3> rest_positions;     // of the bodies' origins, target frame; empty for points and parts
  std::size_t first_body = 0;           // bodies are numbered over all targets but parts, in order
  std::vector<std::size_t> companions;  // indices of its companions, which follow the targets of the scenario
  // of a companion, in the frame of the target that it accompanies, which may be under way; without drift
  Vec3 relative_velocity_mps = Vec3::Zero();
};

// Meshes, scatterers and motion models by the values that determine them. It keeps those in use elsewhere, and those
// used last up to kMostTriangles of each kind; others are made again. Any thread may use it; a thread waits only for
// another one that makes the same value.
class TargetCache {
 public:
  std::shared_ptr<const SourceMesh> source(const Scenario& scenario, const TargetSpec& spec);
  // Of one body. height_m: of the mesh's origin above the water; absent where the body does not reach the water.
  BodyModel model(const Scenario& scenario, const TargetSpec& spec, double scale, std::optional<double> height_m,
                  bool with_scatterer);

 private:
  // About 60 MB of scatterers.
  static constexpr std::size_t kMostTriangles = 60'000;
  template <class Key, class Value>
  class Kept {
   public:
    template <class Make>
    std::shared_ptr<const Value> get(const Key& key, const Make& make);

   private:
    struct Entry {
      explicit Entry(const Key& of) : key(of) {}
      Key key;
      std::mutex making;
      std::shared_ptr<const Value> value;
    };
    std::shared_ptr<Entry> entry_of(const Key& key);

    std::mutex mutex_;
    std::vector<std::shared_ptr<Entry>> entries_;  // the one used last at the end
  };
  struct SourceKey {
    std::filesystem::path file;  // empty for a generated mesh
    std::optional<ShipSpec> ship;
    std::optional<DecoySpec> decoy;
    MeshPlacement axes;
    bool operator==(const SourceKey&) const = default;
  };
  static SourceKey source_key(const Scenario& scenario, const TargetSpec& spec);

  struct MotionKey {
    SourceKey mesh;
    MeshPlacement placement;
    std::filesystem::path folder;  // searched for the files that are named
    MotionSpec motion;
    bool is_raft = false;
    bool operator==(const MotionKey&) const = default;
  };
  struct ScattererKey {
    SourceKey mesh;
    MeshPlacement placement;
    std::filesystem::path folder;
    std::string material;
    std::vector<PartMaterialSpec> part_materials;
    ScattererSettings settings;
    bool operator==(const ScattererKey&) const = default;
  };

  Kept<SourceKey, SourceMesh> sources_;
  Kept<ScattererKey, PreparedTarget> prepared_;
  Kept<MotionKey, Body> motions_;
};

// What targets are loaded for. Motion alone needs no scatterers, no companions and no models of parts, and neither a
// radar that is far from all bodies nor a recorded motion that lasts until the last interval.
enum class TargetUse { kEcho, kMotion };

struct TargetRequest {
  const Scenario& scenario;  // without variations, or with drawn values
  const SamplePlan& plan;
  TargetUse use = TargetUse::kEcho;
  TargetCache* cache = nullptr;  // null: one of its own
  // Models of this target and its companions alone; the others have none.
  std::optional<std::size_t> only = {};
  const StopFlag* stop = nullptr;
};

// Whether keys of targets are drawn: each sea has bodies of its own.
bool draws_targets(const Scenario& scenario);

// The targets of a scenario in its order, then one more per companion, moved to its place. Bodies of one size share a
// model, unless they are in the water at different heights or are decoys with random imperfections. Scatterers are cut
// at the mean water surface of the body at rest; motion models have the whole mesh. Throws InputError for a mesh that
// is missing or invalid, a body entirely under water, if the sea reflects also for bodies at several heights of which
// one reaches into the water, for a material that is missing, invalid or not defined at the radar's frequencies, for a
// motion file that is missing or invalid, and for different bodies of one target with more than 2 million triangles in
// all; Interrupted when *stop becomes true.
std::vector<Target> load_targets(const TargetRequest& request);

// Full width, m, of the range window that contains the response of every target of the scenario at every aspect, with
// all values that its plan draws. It is one number for all samples: a window fitted to the target would reveal its
// size. `targets` of this scenario or of one with the same targets. Throws InputError when the echo from the window
// would last beyond the next pulse.
double range_window_m(const TargetRequest& request, const std::vector<Target>& targets);

// A realisation of one of the scenario's sea states, as the samples of the data set have it.
struct SeaChoice {
  std::size_t sea_state = 0;    // index into sea_states()
  std::size_t realisation = 0;  // below 1000000; the data set has those below dataset.realisations_per_case
};

struct ChosenSea {
  SeaState state;
  WaveField field;
};

// With drawn keys at the middles of their distributions. Throws InputError for a sea state or realisation beyond the
// last.
ChosenSea choose_sea(const Scenario& scenario, const SeaChoice& choice);

struct SceneRequest {
  const Scenario& scenario;
  const std::vector<Target>& targets;
  SeaChoice sea = {};
  // Its drawn values of the sea, and its intervals, which the scene contains; null: choose_sea().
  const SamplePlan* plan = nullptr;
  double at_least_s = 0;  // a longer scene begins with the same values
  int threads = 1;        // without influence on the result; 0 = all processors
  const StopFlag* stop = nullptr;
};

// One sea realisation with the motion of every body, from t = 0.
struct Scene {
  SeaState state;
  WaveField sea;
  std::vector<std::vector<Trajectory>> bodies;                   // [target][body]; none for points and parts
  std::vector<std::vector<Vec3>> velocities_mps;                 // their mean ones: relative and by drift
  std::shared_ptr<const std::vector<Target>> targets = nullptr;  // those that move, as a Pipeline loads them
};

// Throws Interrupted between targets when *stop becomes true.
Scene make_scene(const SceneRequest& request);

// Bodies of every mesh target but parts in the order of the file, `ship`, `array_1`, `array_2`, ... A rigid raft is one
// body: its first reflector, whose angles and translations are the raft's. Throws InputError for a scenario without
// meshes.
std::vector<NamedTrajectory> named_bodies(const std::vector<Target>& targets, const Scene& scene);

// Angles and translations at a time within the simulated duration; a time beyond the last sample by rounding is the
// last sample's. A body at rest has no samples of its own.
MotionSample motion_at(const NamedTrajectory& body, double t);

}  // namespace seaglint
