// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/tracing/transmitted_wave.h"

#include <algorithm>
#include <vector>

#include "sim/core/numbers/rotation.h"
#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/tracing/beam_tracer.h"
#include "sim/scattering/tracing/ray_tracer.h"

namespace seaglint {
namespace {

// In the plane of a sheet nothing of it is visible, although its edges scatter; multiple diffraction along any face
// observed in its plane, and along edges adjacent to one that is normal to the look direction, has only a limit. Such a
// look direction is perturbed by this angle, rad, which changes phases by 0.05 rad at the ends of a 144 m ship at 16
// GHz.
constexpr double kLookPerturbation = 1e-6;

RadarBasis perturbed_look_direction(const Scatterer& scatterer, const RadarBasis& basis, bool edges) {
  const auto has_a_limit = [&](const Vec3& r) {
    const auto in_its_plane = [&](const Facet& facet) {
      return (facet.two_sided || edges) && std::abs(facet.normal.dot(r)) < kInPlaneAngle;
    };
    const auto square_to = [&](const SharpEdge& edge) {
      return edges && std::abs(edge.along().dot(r)) < kInPlaneAngle;
    };
    return std::ranges::any_of(scatterer.facets(), in_its_plane) ||
           std::ranges::any_of(scatterer.edges().edges, square_to);
  };
  if (!has_a_limit(basis.r)) return basis;
  // About h - v first, since faces are often parallel to h or v; a face that contains the axis stays edge-on and
  // requires another axis.
  RadarBasis aside = basis;
  for (const Vec2& axis : {Vec2(1, -1), Vec2(1, 0.6), Vec2(0.3, 1), Vec2(1, 0.1), Vec2(-0.2, 1)}) {
    const Mat3 turn = axis_rotation(kLookPerturbation, (axis.x() * basis.h + axis.y() * basis.v).normalized());
    aside = {turn * basis.r, turn * basis.h, turn * basis.v};
    if (!has_a_limit(aside.r)) break;
  }
  return aside;
}

// Beams from the panels that the transmitter sees.
class BeamWave : public TransmittedWave {
 public:
  BeamWave(const Scatterer& scatterer, const Aspect& transmitter) {
    for (int facet = 0; facet < static_cast<int>(scatterer.facets().size()); ++facet) {
      if (!transmitter.visible.pieces(facet).empty()) panels_.push_back(facet);
    }
  }
  std::size_t parts() const override { return panels_.size(); }
  std::size_t least_parts_per_chunk() const override { return 64; }
  std::size_t trace(const TracingContext& scene, std::size_t first, std::size_t last, InteractionVisitor& visitor,
                    const std::function<void()>& after_each) const override {
    return trace_beams(scene, PrismSearch(scene), std::span(panels_).subspan(first, last - first), visitor, after_each);
  }

 private:
  std::vector<int> panels_;  // by their representative facets, ascending
};

// Tubes of rays from the tiles of a lattice.
class RayWave : public TransmittedWave {
 public:
  RayWave(const Scatterer& scatterer, const Aspect& transmitter, const TracingSettings& settings)
      : lattice_(scatterer, transmitter.basis, ray_spacing(scatterer, settings)) {}
  std::size_t parts() const override { return lattice_.tiles(); }
  std::size_t least_parts_per_chunk() const override { return 1; }
  std::size_t trace(const TracingContext& scene, std::size_t first, std::size_t last, InteractionVisitor& visitor,
                    const std::function<void()>& after_each) const override {
    return trace_rays(scene, lattice_, first, last, visitor, after_each);
  }

 private:
  RayLattice lattice_;
};

}  // namespace

Aspect::Aspect(const Scatterer& scatterer, const RadarBasis& direction, const TracingSettings& settings, int threads)
    : Aspect(scatterer, settings, threads, perturbed_look_direction(scatterer, direction, settings.edges)) {}

Aspect::Aspect(const Scatterer& scatterer, const TracingSettings& settings, int threads, const RadarBasis& perturbed)
    : basis(perturbed),
      visible(scatterer.facets(), scatterer.panels(), scatterer.tree(), perturbed, SmallestAreas(scatterer, settings),
              threads) {}

std::unique_ptr<const TransmittedWave> transmitted_wave(const Scatterer& scatterer, const Aspect& transmitter,
                                                        const TracingSettings& settings) {
  if (settings.method == SolverMethod::kRays) return std::make_unique<RayWave>(scatterer, transmitter, settings);
  return std::make_unique<BeamWave>(scatterer, transmitter);
}

}  // namespace seaglint
