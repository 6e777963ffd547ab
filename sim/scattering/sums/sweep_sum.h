// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sums of contributions over the frequencies of a sweep: in closed form where a frequency is its own node and the
// wavefront is plane, else as points over a band.

#include <array>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "sim/scattering/observation/sweep_plan.h"
#include "sim/scattering/points/point_contributions.h"
#include "sim/scattering/radiation/edge_contribution.h"
#include "sim/scattering/sums/view_estimate.h"

namespace seaglint {

using Matrices = std::vector<std::array<Complex, 4>>;  // hh, hv, vh, vv per frequency, m

// Of one pair of directions. At a finite range contributions are points, to each of which its own part of the wavefront
// belongs; `spread`: largest difference of the direction to the radar over the target, rad, of edges. `estimated`:
// frequency of the view's estimate, which changes no matrix. The plan and the geometry must outlive the object.
class SweepSum {
 public:
  SweepSum(const SweepPlan& plan, const BistaticGeometry& geometry, const RadarRange& radar, double spread,
           std::optional<std::size_t> estimated = std::nullopt);

  void add(std::span<const Footprint> footprints);
  void add(std::span<const EdgeContribution> contributions);
  void add(const SweepSum& other);

  Matrices matrices() const;
  const std::optional<ViewEstimate>& estimate() const { return estimate_; }

 private:
  bool in_closed_form(const FrequencyBand& band) const { return band.nodes().size() == 1 && radar_.range_m <= 0; }
  // Of an edge contribution whose amplitude law oscillates over the bands.
  std::array<Complex, 4> at(const EdgeContribution& contribution, double k);
  void decompose_edge(const EdgeContribution& contribution, const FrequencyBand& band, BandSum& sum);
  // Adds the points to the sum of a band.
  void add_points(std::span<const std::array<Complex, 4>> patterns, BandSum& sum);
  // Adds a footprint with its matrix to the estimate.
  void estimate(const Footprint& footprint, const std::array<Complex, 4>& matrix);
  // Matrix of points_ at the estimate's wavenumber, interpolated in the band, m.
  std::array<Complex, 4> at_estimate(const FrequencyBand& band, std::span<const std::array<Complex, 4>> patterns) const;

  const SweepPlan& plan_;
  const BistaticGeometry& geometry_;
  RadarRange radar_;
  double spread_;
  std::vector<BandSum> bands_;     // of the plan's bands
  Matrices direct_;                // of contributions in closed form, at the first of equal frequencies
  std::vector<BandPoint> points_;  // of one contribution
  std::optional<ViewEstimate> estimate_;
  std::size_t estimated_band_ = 0, estimated_node_ = 0;  // of the plan: that with its frequency, and its nearest node
};

// Adds the sums of chunks in the order of the chunks, whichever is complete first, so that bits do not depend on
// threads; those that wait for an earlier one are kept.
class OrderedSweepSum {
 public:
  OrderedSweepSum(SweepSum empty, std::size_t chunks);

  // The sum of one chunk, filled by one thread; complete() takes it, also where it was never filled.
  SweepSum& chunk(std::size_t chunk);
  void complete(std::size_t chunk);

  Matrices matrices() const { return sum_.matrices(); }
  const std::optional<ViewEstimate>& estimate() const { return sum_.estimate(); }

 private:
  SweepSum empty_, sum_;
  std::vector<std::optional<SweepSum>> chunks_;
  std::vector<bool> complete_;
  std::size_t next_ = 0;  // the chunk that is added next
  std::mutex mutex_;      // of sum_, complete_ and next_
};

}  // namespace seaglint
