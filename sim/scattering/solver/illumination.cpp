// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/illumination.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/geometry/tolerances.h"
#include "sim/scattering/radiation/beam_boundary.h"
#include "sim/scattering/radiation/beam_contributions.h"
#include "sim/scattering/radiation/beam_edges.h"
#include "sim/scattering/tracing/beam_tracer.h"
#include "sim/scattering/tracing/prism_search.h"
#include "sim/scattering/tracing/ray_tracer.h"

namespace seaglint {
namespace {

// Side of the smallest beam that is reflected further, in sides of the smallest patch: 18 mm on the ship. For equal run
// time two sizes in this ratio have a smaller error than one common size.
constexpr double kMinBeamPerPatch = 3.6;
// Panels per chunk grow with the mesh: the memory per chunk and frequency stays below 100 MB for 640 frequencies.
constexpr std::size_t kPanelsPerChunk = 64;
constexpr std::size_t kMaxChunks = 2048;

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
    const Mat3 turn =
        Eigen::AngleAxisd(kLookPerturbation, (axis.x() * basis.h + axis.y() * basis.v).normalized()).toRotationMatrix();
    aside = {turn * basis.r, turn * basis.h, turn * basis.v};
    if (!has_a_limit(aside.r)) break;
  }
  return aside;
}

// Records the contributions and edge illuminations of the beam segments of one illumination.
class IlluminationRecorder : public BeamVisitor {
 public:
  IlluminationRecorder(const TracingContext& scene, TracedContributions& out) : scene_(scene), out_(out) {
    out.receivers.resize(scene.receivers.size());
    edges_of_receiver_.reserve(out.receivers.size());  // referenced by surfaces_of_receiver_
    for (std::size_t i = 0; i < out.receivers.size(); ++i) {
      const Receiver& receiver = scene.receivers[i];
      surfaces_of_receiver_.emplace_back(
          scene, receiver, out.receivers[i].footprints,
          &edges_of_receiver_.emplace_back(scene, receiver, out.receivers[i].boundary_terms));
    }
  }

  bool needs_last_segment(const BeamSegment& segment) const override { return records_edges(scene_, segment); }
  void illuminated(const BeamSegment& segment, const CandidatePanel& candidate) override {
    if (records_edges(scene_, segment)) record_edges(scene_, segment, candidate, out_.edge_illuminations);
  }
  void visible(const BeamSegment& segment, const CandidatePanel& candidate, std::size_t receiver,
               std::span<const MovingPolygon> pieces) override {
    surfaces_of_receiver_[receiver].radiate(segment, candidate, pieces);
    surfaces_of_receiver_[receiver].radiate_image(segment, candidate, pieces);
  }

 private:
  const TracingContext& scene_;
  TracedContributions& out_;
  std::vector<FootprintEnds> edges_of_receiver_;
  std::vector<BeamContributions> surfaces_of_receiver_;
};

Aspects aspects_of(const Scatterer& scatterer, const BistaticGeometry& geometry, const TracingSettings& settings,
                   int threads) {
  const auto seen_along = [&](const RadarBasis& direction) {
    return std::make_shared<const Aspect>(scatterer, direction, settings, threads);
  };
  return {seen_along(geometry.transmit), {geometry.monostatic ? nullptr : seen_along(geometry.receive)}};
}

}  // namespace

Aspect::Aspect(const Scatterer& scatterer, const RadarBasis& direction, const TracingSettings& settings, int threads)
    : basis(perturbed_look_direction(scatterer, direction, settings.edges)) {
  if (settings.edges || method_for(settings) == SolverMethod::kBeams)
    visible.emplace(scatterer.facets(), scatterer.panels(), scatterer.tree(), basis, SmallestAreas(scatterer, settings),
                    threads);
}

Illumination::Illumination(const Scatterer& scatterer, Aspects aspects, const TracingSettings& settings,
                           std::span<const double> wavenumbers)
    : scatterer_(scatterer), settings_(settings), aspects_(std::move(aspects)) {
  const Aspect& transmitter = *aspects_.transmitter;
  const auto surface_of = [](const Aspect& aspect) { return aspect.visible ? &*aspect.visible : nullptr; };
  for (const auto& receiver : aspects_.receivers) {
    if (receiver) {
      receivers_.push_back({bistatic(transmitter.basis, receiver->basis), surface_of(*receiver)});
    } else {
      receivers_.push_back({monostatic(transmitter.basis), surface_of(transmitter)});
    }
  }
  if (method_for(settings) == SolverMethod::kRays) {
    lattice_.emplace(scatterer, transmitter.basis, ray_spacing(scatterer, settings));
  } else {
    for (int facet = 0; facet < static_cast<int>(scatterer.facets().size()); ++facet) {
      if (!transmitter.visible->pieces(facet).empty()) seen_.push_back(facet);
    }
  }
  for (const MaterialSpec& material : scatterer.materials()) {
    std::vector<MaterialSurface>& surface = surfaces_.emplace_back();
    if (material.kind == SurfaceKind::kPec && material.roughness_mm == 0) continue;
    SEAGLINT_CHECK(!wavenumbers.empty(), "the material " + material.name + " needs a wavenumber");
    for (const double k : wavenumbers) surface.emplace_back(material, k);
  }
  if (!wavenumbers.empty()) {
    lowest_ = std::ranges::min(wavenumbers);
    highest_ = std::ranges::max(wavenumbers);
  }
}

Illumination::Illumination(const Scatterer& scatterer, const BistaticGeometry& geometry,
                           const TracingSettings& settings, int threads, std::span<const double> wavenumbers)
    : Illumination(scatterer, aspects_of(scatterer, geometry, settings, threads), settings, wavenumbers) {}

std::size_t Illumination::items() const { return lattice_ ? lattice_->tiles() : seen_.size(); }

std::size_t Illumination::items_per_chunk() const {
  return std::max(lattice_ ? 1 : kPanelsPerChunk, (items() + kMaxChunks - 1) / kMaxChunks);
}

std::size_t Illumination::chunk_count() const { return (items() + items_per_chunk() - 1) / items_per_chunk(); }

TraceSummary Illumination::trace_all(int threads, const Visit& visit, const StopFlag* stop,
                                     const std::function<void(std::size_t)>& complete) const {
  const std::size_t size = items_per_chunk();
  const ContributionFilter& filter = settings_.filter;
  const double faint = lowest_ > 0 ? min_amplitude(scatterer_, settings_, lowest_) : 0.0;
  std::vector<std::vector<EdgeIllumination>> illuminations(chunk_count());
  std::vector<std::size_t> segments(chunk_count(), 0);
  parallel_for(
      chunk_count(), threads,
      [&](std::size_t chunk) {
        TracedContributions traced;
        const std::size_t first = chunk * size, last = std::min(items(), first + size);
        const TracingContext of_chunk = scene();
        IlluminationRecorder recorder(of_chunk, traced);
        const auto pass_on = [&] {
          for (std::size_t receiver = 0; receiver < traced.receivers.size(); ++receiver) {
            auto& [footprints, boundary_terms] = traced.receivers[receiver];
            std::erase_if(footprints, [&](const Footprint& f) {
              return !filter.accepts(f.part, f.bounces, Mechanism::kPhysicalOptics);
            });
            std::erase_if(boundary_terms, [&](const EdgeContribution& end) {
              return !filter.accepts_edge(end.part, end.other_part, end.bounces, end.mechanism) ||
                     (faint > 0 && boundary_term_bound(end, lowest_, highest_) < faint);
            });
            visit(chunk, receiver, {footprints, boundary_terms});
            footprints.clear();
            boundary_terms.clear();
          }
        };
        segments[chunk] = lattice_ ? trace_rays(of_chunk, *lattice_, first, last, recorder, pass_on)
                                   : trace_beams(of_chunk, PrismSearch(of_chunk),
                                                 visible_panels().subspan(first, last - first), recorder, pass_on);
        illuminations[chunk] = std::move(traced.edge_illuminations);
        if (complete) complete(chunk);
      },
      stop);
  return {IlluminationByEdge(std::move(illuminations), scatterer_.edges().edges.size()),
          std::accumulate(segments.begin(), segments.end(), std::size_t{0})};
}

TracingContext Illumination::scene() const {
  const auto& [basis, visible] = *aspects_.transmitter;
  const VisibleSurface* surface = visible ? &*visible : nullptr;
  return {scatterer_,
          basis,
          receivers_,
          settings_,
          surface,
          surfaces_,
          SmallestAreas(scatterer_, settings_),
          kMinBeamPerPatch * kMinBeamPerPatch};
}

std::size_t Illumination::trace_from(std::span<const int> facets, TracedContributions& traced) const {
  const TracingContext of_facets = scene();
  IlluminationRecorder recorder(of_facets, traced);
  return trace_beams(of_facets, PrismSearch(of_facets), facets, recorder);
}

}  // namespace seaglint
