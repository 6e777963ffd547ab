// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/sums/view_estimate.h"

#include <cmath>

namespace seaglint {
namespace {

void add_to(ViewEstimate::Sums& sum, const ViewEstimate::Sums& other, const CoPolar& factor, const Complex& cross) {
  for (std::size_t i = 0; i < 2; ++i) {
    const double size = std::abs(factor[i]);
    sum.flat_less_smooth[i] += factor[i] * other.flat_less_smooth[i];
    sum.flat_change[i] += size * other.flat_change[i];
    sum.displaced_power[i] += size * size * other.displaced_power[i];
    sum.in_cavity[i] += factor[i] * other.in_cavity[i];
  }
  sum.non_reciprocal += cross * other.non_reciprocal;
  sum.non_reciprocal_size += std::abs(cross) * other.non_reciprocal_size;
}

}  // namespace

void ViewEstimate::add(const Contribution& contribution, const ScatteringMatrix& smooth, const ScatteringMatrix& flat) {
  const Footprint& footprint = *contribution.footprint();
  const auto& [facet, part, other_part, bounces, mechanism] = contribution.source;
  // Polygons of one beam on one panel lie in one plane of image space.
  if (beam_ && (beam_->facet != facet || beam_->psi0 != footprint.psi0 || beam_->bounces != bounces)) end_beam();
  if (!beam_) {
    const double wavelength = 2 * kPi / k_, wall_distance = footprint.history.wall_distance;
    // A beam that is displaced on its last panel returns with the change of psi along that panel.
    const double phase_change = k_ * footprint.psi_slope * footprint.history.displacement * kVertexNoise * wavelength;
    const bool in_cavity =
        bounces >= kCavityReflections && wall_distance > 0 && wall_distance < kCavityWavelengths * wavelength;
    beam_ = Beam{facet, footprint.psi0, bounces, part, phase_change, in_cavity, {}, {}, {}};
  }
  beam_->smooth[0] += smooth[0];
  beam_->smooth[1] += smooth[3];
  beam_->flat[0] += flat[0];
  beam_->flat[1] += flat[3];
  beam_->non_reciprocal += 0.5 * (smooth[1] - smooth[2]);
}

void ViewEstimate::end_beam() {
  if (!beam_) return;
  if (parts_.size() <= beam_->part) parts_.resize(beam_->part + 1u);
  Sums& of_part = parts_[beam_->part];
  // Mean of |e^{jx} - 1|^2 over normally distributed phases x.
  const double squared_change = 2 * (1 - std::exp(-0.5 * beam_->phase_change * beam_->phase_change));
  for (std::size_t i = 0; i < 2; ++i) {
    const Complex change = beam_->flat[i] - beam_->smooth[i];
    of_part.flat_less_smooth[i] += change;
    of_part.flat_change[i] += std::abs(change);
    of_part.displaced_power[i] += squared_change * std::norm(beam_->smooth[i]);
    if (beam_->in_cavity) of_part.in_cavity[i] += beam_->smooth[i];
  }
  of_part.non_reciprocal += beam_->non_reciprocal;
  of_part.non_reciprocal_size += std::abs(beam_->non_reciprocal);
  beam_.reset();
}

void ViewEstimate::add(const ViewEstimate& other, const CoPolar& factor, const Complex& cross) {
  if (parts_.size() < other.parts_.size()) parts_.resize(other.parts_.size());
  for (std::size_t i = 0; i < other.parts_.size(); ++i) add_to(parts_[i], other.parts_[i], factor, cross);
}

ViewEstimate::Sums ViewEstimate::all() const {
  Sums sum;
  for (const Sums& of_part : parts_) add_to(sum, of_part, {1, 1}, 1);
  return sum;
}

}  // namespace seaglint
