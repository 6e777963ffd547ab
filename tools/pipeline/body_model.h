// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the bodies of one size of a target have in common: mesh, scatterer and motion model.

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/motion/body.h"
#include "sim/scattering/scatterer/prepare_target.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

struct BodyModel {
  double scale = 1;                                // factor by which the mesh of the file is enlarged, after its unit
  double radius_m = 0;                             // largest distance of a vertex from the mesh's origin
  std::shared_ptr<const PreparedTarget> prepared;  // cut at the waterline
  std::shared_ptr<const Body> motion;  // of a rigid raft that of the raft, whatever the size of its reflectors
};

// Largest distance of a vertex from the mesh's origin, m.
double radius_m(const TriangleMesh& mesh);

// The mesh of a target in metres with its axes turned, neither enlarged nor moved.
MeshPlacement turned_mesh(const TargetSpec& spec);

// `box` of the turned mesh. Throws InputError for a body that is entirely under water and, if the sea reflects, for
// bodies at several heights of which one reaches into the water.
void check_above_water(const Scenario& scenario, const TargetSpec& spec, const Bounds& box);

// Motion model of a body from its enlarged mesh, of a rigid raft from the keys alone, and the files that the target's
// `motion` names. Throws InputError naming the target.
Body load_body(const Scenario& scenario, const TargetSpec& spec, const TriangleMesh& mesh);

// Whether the motion model depends on the mesh: of ships and floats that are no raft.
bool moves_by_size(const TargetSpec& spec);

// Loads bodies, those with equal fields once. Any thread may use it.
class LoadedBodies {
 public:
  // The models of a target's bodies, in their order; bodies of one size share one, unless they are in the water at
  // different heights. Scatterers are cut at the mean water surface of the body at rest; motion models have the whole
  // mesh. Throws InputError for a mesh that is missing or invalid, as check_above_water() does, for a material that is
  // missing, invalid or not defined at the radar's frequencies, for a motion file that is missing or invalid, and for
  // bodies of several sizes with more than 2 million triangles in all.
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

  // height_m: of the mesh's origin above the water; absent where the body does not reach the water.
  BodyModel model(const Scenario& scenario, const TargetSpec& spec, double scale, std::optional<double> height_m);

  std::mutex mutex_;
  Kept<Bounds> boxes_;
  Kept<PreparedTarget> prepared_;
  Kept<Body> motions_;
};

}  // namespace seaglint
