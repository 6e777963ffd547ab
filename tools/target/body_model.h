// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the bodies of one size of a target have in common: mesh, scatterer and motion model.

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/body.h"
#include "sim/scattering/interval/shared_traces.h"
#include "sim/scattering/target/prepare_target.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Scatterer with the traces that its intervals share (solver.shared_traces).
struct TracedTarget : PreparedTarget {
  std::shared_ptr<SharedTraces> traces;
};

struct BodyModel {
  double scale = 1;     // factor by which the mesh of the file is enlarged, after its unit
  double radius_m = 0;  // largest distance of a vertex from the mesh's origin
  std::shared_ptr<const TracedTarget> prepared;
  std::shared_ptr<const Body> motion;  // of a rigid raft that of the raft, whatever the size of its reflectors
};

// Largest distance of a vertex from the mesh's origin, m.
double radius_m(const TriangleMesh& mesh);

// Motion model of a body from its enlarged mesh, of a rigid raft from the keys alone, and the files that the target's
// `motion` names. Throws InputError naming the target.
Body load_body(const Scenario& scenario, const TargetSpec& spec, const TriangleMesh& mesh);

// Whether the motion model depends on the mesh: of ships and floats that are no raft.
bool moves_by_size(const TargetSpec& spec);

// Loads bodies, those with equal fields once. Any thread may use it.
class LoadedBodies {
 public:
  // The models of a target's bodies, in their order; bodies of one size share one. Throws InputError for a mesh that is
  // missing, invalid or, if the sea reflects, under water, for a material that is missing, invalid or not defined at
  // the radar's frequencies, for a motion file that is missing or invalid, and for bodies of several sizes with more
  // than 2 million triangles in all.
  std::vector<std::shared_ptr<const BodyModel>> models(const Scenario& scenario, const TargetSpec& spec);

 private:
  // Values by the fields that determine them, as text: those in use elsewhere, and the kKept others used last.
  template <class Value>
  class Kept {
   public:
    template <class Make>
    std::shared_ptr<const Value> get(const std::string& fields, const Make& make);

   private:
    static constexpr std::size_t kKept = 16;
    struct Entry {
      std::shared_ptr<const Value> value;
      std::size_t used = 0;  // number of the last call of get() for these fields
    };
    std::map<std::string, Entry> entries_;
    std::size_t calls_ = 0;
  };

  // lowest_height_m: of the mesh's origin above the water, of all bodies of this size.
  BodyModel model(const Scenario& scenario, const TargetSpec& spec, double scale, double lowest_height_m);

  std::mutex mutex_;
  std::shared_ptr<TraceMemory> memory_ = std::make_shared<TraceMemory>();
  Kept<TracedTarget> prepared_;
  Kept<Body> motions_;
};

}  // namespace seaglint
