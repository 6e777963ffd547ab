// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/aspect_trace.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/scattering/radiation/edge_diffraction.h"
#include "sim/scattering/radiation/surface_radiation.h"

namespace seaglint {
namespace {

// Side of the smallest beam that is reflected further, in sides of the smallest patch: 18 mm on the ship. For equal run
// time two sizes in this ratio have a smaller error than one common size.
constexpr double kMinBeamPerPatch = 3.6;
// Parts per chunk grow with the mesh: the memory per chunk and frequency stays below 100 MB for 640 frequencies.
constexpr std::size_t kMaxChunks = 2048;

// Contributions and edge illuminations of the interactions of one transmit direction.
class InteractionRecorder : public InteractionVisitor {
 public:
  explicit InteractionRecorder(const TracingContext& scene) : scene_(scene), contributions(scene.receivers.size()) {
    for (std::size_t i = 0; i < contributions.size(); ++i)
      radiators_.emplace_back(scene, scene.receivers[i], contributions[i]);
  }

  bool needs_last_segment(const BeamSegment& segment) const override { return records_edges(scene_, segment); }
  void illuminated(const Interaction& interaction) override {
    if (records_edges(scene_, interaction.segment)) record_edges(scene_, interaction, edge_illuminations);
  }
  void visible(const Interaction& interaction, std::size_t receiver, std::span<const MovingPolygon> pieces) override {
    radiators_[receiver].radiate(interaction, pieces);
  }

 private:
  const TracingContext& scene_;
  std::vector<SurfaceRadiator> radiators_;

 public:
  std::vector<std::vector<Contribution>> contributions;  // per receiver
  std::vector<EdgeIllumination> edge_illuminations;
};

// Edge illuminations from a receive direction that transmits in no pair: no contributions are computed, and beams end
// after the reflections that an edge contribution allows.
IlluminationByEdge edge_illumination_from(const Scatterer& scatterer, const std::shared_ptr<const Aspect>& direction,
                                          TracingSettings settings, std::span<const double> wavenumbers, int threads,
                                          const StopFlag* stop) {
  settings.max_bounces = std::min(settings.max_bounces, kMaxEdgeReflections + 1);
  return Illumination(scatterer, {direction, {}}, settings, wavenumbers)
      .trace(
          threads, [](std::size_t, std::size_t, std::span<const Contribution>) {}, stop)
      .edge_illuminations;
}

}  // namespace

Illumination::Illumination(const Scatterer& scatterer, Aspects aspects, const TracingSettings& settings,
                           std::span<const double> wavenumbers)
    : scatterer_(scatterer),
      settings_(settings),
      aspects_(std::move(aspects)),
      wave_(transmitted_wave(scatterer, *aspects_.transmitter, settings)) {
  const Aspect& transmitter = *aspects_.transmitter;
  for (const auto& receiver : aspects_.receivers) {
    if (receiver) {
      receivers_.push_back({bistatic(transmitter.basis, receiver->basis), receiver->visible});
    } else {
      receivers_.push_back({monostatic(transmitter.basis), transmitter.visible});
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

std::size_t Illumination::parts_per_chunk() const {
  return std::max(wave_->least_parts_per_chunk(), (wave_->parts() + kMaxChunks - 1) / kMaxChunks);
}

std::size_t Illumination::chunk_count() const { return (wave_->parts() + parts_per_chunk() - 1) / parts_per_chunk(); }

Illumination::Summary Illumination::trace(int threads, const Visit& visit, const StopFlag* stop,
                                          const std::function<void(std::size_t)>& complete) const {
  const std::size_t size = parts_per_chunk();
  const double faint = lowest_ > 0 ? min_amplitude(scatterer_, settings_, lowest_) : 0.0;
  const auto is_rejected = [&](const Contribution& contribution) {
    const auto& [facet, part, other_part, bounces, mechanism] = contribution.source;
    if (contribution.footprint()) return !settings_.filter.accepts(part, bounces, mechanism);
    return !settings_.filter.accepts_edge(part, other_part, bounces, mechanism) ||
           (faint > 0 && boundary_term_bound(contribution, lowest_, highest_) < faint);
  };
  const TracingContext scene{scatterer_,
                             aspects_.transmitter->basis,
                             receivers_,
                             settings_,
                             aspects_.transmitter->visible,
                             surfaces_,
                             SmallestAreas(scatterer_, settings_),
                             kMinBeamPerPatch * kMinBeamPerPatch};
  std::vector<std::vector<EdgeIllumination>> illuminations(chunk_count());
  std::vector<std::size_t> segments(chunk_count(), 0);
  parallel_for(
      chunk_count(), threads,
      [&](std::size_t chunk) {
        InteractionRecorder recorder(scene);
        const auto pass_on = [&] {
          for (std::size_t receiver = 0; receiver < recorder.contributions.size(); ++receiver) {
            std::vector<Contribution>& contributions = recorder.contributions[receiver];
            std::erase_if(contributions, is_rejected);
            visit(chunk, receiver, contributions);
            contributions.clear();
          }
        };
        const std::size_t first = chunk * size, last = std::min(wave_->parts(), first + size);
        segments[chunk] = wave_->trace(scene, first, last, recorder, pass_on);
        illuminations[chunk] = std::move(recorder.edge_illuminations);
        if (complete) complete(chunk);
      },
      stop);
  return {IlluminationByEdge(std::move(illuminations), scatterer_.edges().edges.size()),
          std::accumulate(segments.begin(), segments.end(), std::size_t{0})};
}

AspectTrace::AspectTrace(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                         const TracingSettings& settings, std::span<const double> wavenumbers, Reciprocity reciprocity,
                         int threads)
    : scatterer_(scatterer),
      pairs_(pairs),
      settings_(settings),
      wavenumbers_(wavenumbers),
      reciprocity_(reciprocity),
      threads_(threads),
      lenses_(luneburg_lenses(scatterer)) {
  std::vector<const RadarBasis*> known;
  const auto number_of = [&](const RadarBasis& basis) {
    const auto at = std::ranges::find_if(known, [&](const RadarBasis* other) { return *other == basis; });
    if (at == known.end()) {
      known.push_back(&basis);
      directions_.push_back(std::make_shared<const Aspect>(scatterer, basis, settings, threads));
      return directions_.size() - 1;
    }
    return static_cast<std::size_t>(at - known.begin());
  };
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
    transmit_.push_back(number_of(pairs[pair].transmit));
    receive_.push_back(number_of(pairs[pair].receive));
    exchanged_.push_back(reciprocity == Reciprocity::kAllPairs && transmit_[pair] != receive_[pair]
                             ? exchanged_pair(pairs, pair)
                             : std::nullopt);
  }
  for (std::size_t direction = 0; direction < directions_.size(); ++direction) {
    std::vector<std::size_t> own;
    Aspects aspects{directions_[direction], {}};
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (transmit_[i] != direction) continue;
      own.push_back(i);
      aspects.receivers.push_back(pairs[i].monostatic ? nullptr : directions_[receive_[i]]);
    }
    if (own.empty()) continue;
    transmitters_.push_back(
        {direction, std::move(own), Illumination(scatterer, std::move(aspects), settings, wavenumbers)});
  }
}

std::size_t AspectTrace::own_chunks(std::size_t pair) const {
  const auto of_pair = [&](const Transmitter& t) { return t.direction == transmit_[pair]; };
  return std::ranges::find_if(transmitters_, of_pair)->illumination.chunk_count() + kEdgeChunks;
}

std::size_t AspectTrace::chunk_count(std::size_t pair) const {
  return own_chunks(pair) + (exchanged_[pair] ? own_chunks(*exchanged_[pair]) : 0);
}

void AspectTrace::pass_on(std::size_t source, std::size_t chunk, std::span<const Contribution> contributions,
                          const Visit& visit) const {
  const std::optional<std::size_t>& other = exchanged_[source];
  const PathSense own_sense = reciprocity_ == Reciprocity::kNone || other ? PathSense::kOneWay : PathSense::kMean;
  visit({source, source, chunk, own_sense, other ? 0.5 : 1.0, contributions});
  if (other) visit({source, *other, own_chunks(*other) + chunk, PathSense::kExchanged, 0.5, contributions});
}

void AspectTrace::pass_complete(std::size_t source, std::size_t chunk, const Complete& complete) const {
  if (!complete) return;
  complete(source, chunk);
  if (const auto& other = exchanged_[source]) complete(*other, own_chunks(*other) + chunk);
}

std::size_t AspectTrace::run(const Visit& visit, const Complete& complete, const StopFlag* stop) const {
  std::size_t segments = 0;
  std::vector<std::optional<IlluminationByEdge>> illuminations(directions_.size());
  for (const Transmitter& transmitter : transmitters_) {
    Illumination::Summary reached = transmitter.illumination.trace(
        threads_,
        [&](std::size_t chunk, std::size_t receiver, std::span<const Contribution> contributions) {
          pass_on(transmitter.pairs[receiver], chunk, contributions, visit);
        },
        stop,
        [&](std::size_t chunk) {
          for (const std::size_t pair : transmitter.pairs) pass_complete(pair, chunk, complete);
        });
    illuminations[transmitter.direction] = std::move(reached.edge_illuminations);
    segments += reached.segments;
  }
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    const std::size_t first = own_chunks(pair) - kEdgeChunks;
    if (!lenses_.empty()) {
      const Aspect &from = *directions_[transmit_[pair]], &to = *directions_[receive_[pair]];
      const BistaticGeometry antennas =
          pairs_[pair].monostatic ? monostatic(from.basis) : bistatic(from.basis, to.basis);
      pass_on(pair, first,
              lens_reflection({scatterer_, lenses_, antennas, from.visible, to.visible, wavenumbers_, settings_}),
              visit);
    }
    if (settings_.edges) {
      std::optional<IlluminationByEdge>& outgoing = illuminations[receive_[pair]];
      if (!outgoing) {
        outgoing =
            edge_illumination_from(scatterer_, directions_[receive_[pair]], settings_, wavenumbers_, threads_, stop);
      }
      const EdgeDiffractionRequest request{
          scatterer_, pairs_[pair], settings_, wavenumbers_, *illuminations[transmit_[pair]], *outgoing, threads_};
      edge_diffraction(request, [&](std::size_t chunk, std::span<const Contribution> contributions) {
        pass_on(pair, first + chunk, contributions, visit);
      });
    }
    for (std::size_t chunk = first; chunk < first + kEdgeChunks; ++chunk) pass_complete(pair, chunk, complete);
  }
  return segments;
}

}  // namespace seaglint
