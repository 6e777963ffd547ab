// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Aspect traces that many intervals of one body share: made at the look directions of a lattice in body axes, kept as
// points (psi, path gradient), and evaluated along the path of look directions of each interval. The response of an
// interval is interpolated linearly between the four directions of the lattice around its own, each with the phases
// that its points have on the interval's path.
//
// Which traces an interval uses depends on its own look directions alone, so that its response does not depend on what
// is kept: a trace that is not is made again.

#include <atomic>
#include <compare>
#include <complex>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/core/process/shared_results.h"
#include "sim/scattering/observation/look_direction_path.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "sim/scattering/solver/direction_lattice.h"
#include "sim/scattering/solver/trace_plan.h"
#include "sim/scattering/sums/response_grid.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

// Points of one polarisation of a body at rest in one look direction.
struct SharedTrace {
  struct Point {
    std::complex<float> amplitude;   // without the phase e^{jk psi}, m
    double psi = 0;                  // m
    float along_h = 0, along_v = 0;  // change of psi per radian of the look direction, m
  };
  RadarBasis basis;  // traced look direction and its polarisation basis, body frame
  std::vector<Point> points;
};

// A direction that is traced for a planned path, and its weight.
struct SharedDirection {
  LatticeDirection at;
  RadarBasis basis;
  double weight = 0;
};

// The directions of the lattice around that of a planned path, whose weights are above 0. Empty, so that the interval
// has a trace of its own, unless
//   - one antenna in the far field receives the polarisation that it transmits, without reflection by the sea;
//   - the look direction departs from that in the middle by at most served_rad / 8: a ship at Hs 0.1 m (19 of 20
//     intervals), not at Hs 1 m (0 of 20), where directions hardly recur and each interval would need four traces;
//   - the polarisation basis is turned about the line of sight from radar_basis() in body axes by at most 0.15 deg, an
//     error below -45 dB.
// served_rad: aspect change that one trace serves; the lattice has steps of kSharedStep of it.
std::vector<SharedDirection> shared_directions(const PlannedPath& path, double served_rad, const SolverSpec& solver,
                                               Polarisation polarisation);
inline constexpr double kSharedStep = 0.7;

// Sum of traces over the wavenumbers and the look directions of a path near them; beside_m: largest path rate across
// the track.
struct WeightedTrace {
  std::shared_ptr<const SharedTrace> trace;
  double weight = 0;
};
ResponseGrid grid_of_traces(std::span<const WeightedTrace> traces, const PlannedPath& path,
                            const WavenumberGrid& wavenumbers, double beside_m, int threads);

// What a trace depends on beside the body and its solver settings.
struct SharedTraceKey {
  LatticeDirection direction;
  double kc = 0, half_band = 0;  // centre and half width of the band, rad/m
  int channel = 0;               // index of the polarisation

  auto operator<=>(const SharedTraceKey&) const = default;
};

// Points of a body in the look direction of `basis`, decomposed for an aspect change of served_rad / 2, the distance of
// the middle of a cell of the lattice from its corners. Throws Interrupted when *stop becomes true.
SharedTrace make_shared_trace(const Scatterer& scatterer, const RadarBasis& basis, const SharedTraceKey& key,
                              double served_rad, const SolverSpec& solver, int threads, const StopFlag* stop);

// Bytes that the traces of all bodies may take together, 3 GiB: 8 MB for each direction of the 144 m ship.
struct TraceMemory {
  std::atomic<std::int64_t> free_bytes{std::int64_t{3} << 30};
};

// Traces of one body. Any thread may use it; each is made by one thread, for which the others wait. Once the memory is
// full, further traces are made but not kept.
class SharedTraces {
 public:
  explicit SharedTraces(std::shared_ptr<TraceMemory> memory) : memory_(std::move(memory)) {}
  SharedTraces(const SharedTraces&) = delete;
  SharedTraces& operator=(const SharedTraces&) = delete;
  ~SharedTraces() { memory_->free_bytes += kept_bytes_; }

  std::shared_ptr<const SharedTrace> get(const SharedTraceKey& key, const std::function<SharedTrace()>& make);

 private:
  // Whether there was memory for a trace, which then counts as kept.
  bool keep(const SharedTrace& trace);

  std::shared_ptr<TraceMemory> memory_;
  std::atomic<std::int64_t> kept_bytes_ = 0;
  SharedResults<SharedTraceKey, SharedTrace> traces_{std::numeric_limits<std::size_t>::max()};
};

}  // namespace seaglint
