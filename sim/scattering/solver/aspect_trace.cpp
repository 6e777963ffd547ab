// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/solver/aspect_trace.h"

#include <algorithm>
#include <optional>

#include "sim/scattering/radiation/edge_diffraction.h"
#include "sim/scattering/radiation/single_diffraction.h"

namespace seaglint {
namespace {

// Edge illuminations from a receive direction that transmits in no pair: no footprints are computed, and beams end
// after the reflections that an edge contribution allows.
IlluminationByEdge edge_illumination_from(const Scatterer& scatterer, const std::shared_ptr<const Aspect>& direction,
                                          TracingSettings settings, std::span<const double> wavenumbers, int threads,
                                          const StopFlag* stop) {
  settings.max_bounces = std::min(settings.max_bounces, kMaxEdgeReflections + 1);
  return Illumination(scatterer, {direction, {}}, settings, wavenumbers)
      .trace_all(
          threads, [](std::size_t, std::size_t, const PanelContributions&) {}, stop)
      .edge_illuminations;
}

}  // namespace

AspectTrace::AspectTrace(const Scatterer& scatterer, std::span<const BistaticGeometry> pairs,
                         const TracingSettings& settings, std::span<const double> wavenumbers, int threads)
    : scatterer_(scatterer), pairs_(pairs), settings_(settings), wavenumbers_(wavenumbers), threads_(threads) {
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
  for (const BistaticGeometry& pair : pairs) {
    transmit_.push_back(number_of(pair.transmit));
    receive_.push_back(number_of(pair.receive));
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

std::size_t AspectTrace::chunk_count(std::size_t pair) const {
  const auto of_pair = [&](const Transmitter& t) { return t.direction == transmit_[pair]; };
  return std::ranges::find_if(transmitters_, of_pair)->illumination.chunk_count() + kEdgeChunks;
}

std::size_t AspectTrace::run(const AspectVisitor& visit, const StopFlag* stop) const {
  std::size_t segments = 0;
  std::vector<std::optional<IlluminationByEdge>> illuminations(directions_.size());
  for (const Transmitter& transmitter : transmitters_) {
    TraceSummary reached = transmitter.illumination.trace_all(
        threads_,
        [&](std::size_t chunk, std::size_t receiver, const PanelContributions& contributions) {
          const std::size_t pair = transmitter.pairs[receiver];
          visit.surfaces(pair, chunk, contributions.footprints);
          visit.edges(pair, chunk, contributions.boundary_terms);
        },
        stop,
        [&](std::size_t chunk) {
          if (!visit.complete) return;
          for (const std::size_t pair : transmitter.pairs) visit.complete(pair, chunk);
        });
    illuminations[transmitter.direction] = std::move(reached.edge_illuminations);
    segments += reached.segments;
  }
  if (!settings_.edges) return segments;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
    std::optional<IlluminationByEdge>& outgoing = illuminations[receive_[pair]];
    if (!outgoing) {
      outgoing =
          edge_illumination_from(scatterer_, directions_[receive_[pair]], settings_, wavenumbers_, threads_, stop);
    }
    const std::size_t first = chunk_count(pair) - kEdgeChunks;
    edge_diffraction(scatterer_, pairs_[pair], settings_, wavenumbers_, *illuminations[transmit_[pair]], *outgoing,
                     threads_, [&](std::size_t chunk, std::span<const EdgeContribution> footprints) {
                       visit.edges(pair, first + chunk, footprints);
                     });
    for (std::size_t chunk = first; visit.complete && chunk < first + kEdgeChunks; ++chunk) visit.complete(pair, chunk);
  }
  return segments;
}

}  // namespace seaglint
