// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/points/edge_decomposition.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace seaglint {
namespace {

// Phase over half of a band from the middle of a piece to its ends, and between the contributions of an amplitude law:
// their part of the interpolation error (kCellHalfPhase).
constexpr double kPieceHalfPhase = 0.1;  // rad

// Calls add(amplitude, psi, gradient) for every point, the amplitude as a function of the wavenumber. k determines the
// form.
template <typename Add>
void for_each_point(const EdgeContribution& contribution, const FrequencyBand& band, double k, double aspect_change_rad,
                    const Add& add) {
  const double run = contribution.psi[1] - contribution.psi[0];
  // An aspect change u changes the slope of psi along the edge by at most 2 u.
  const double threshold = 2 * aspect_change_rad / kMaxAmplitudeError * contribution.length;
  if (std::abs(run) > threshold && std::abs(k * run) / 2 > kMaxHalfPhase && endpoints_suffice(contribution, k)) {
    for (int i = 0; i < 2; ++i) {
      const double sign = i == 0 ? -1 : 1;
      add([&](double at_k) { return sign * endpoint_term(contribution, at_k, i); }, contribution.psi[i],
          contribution.gradient[i]);
    }
    return;
  }
  const double slope = std::max(std::abs(run), kMaxAmplitudeError * threshold);
  const bool only_band = aspect_change_rad <= 0 && band.half_width() > 0;
  const double lengths = only_band ? band.half_width() * slope / 2 / kPieceHalfPhase : k * slope / 2 / kMaxHalfPhase;
  const int pieces = std::max(1, static_cast<int>(std::ceil(lengths)));
  const PathGradient &a = contribution.gradient[0], &b = contribution.gradient[1];
  for (int i = 0; i < pieces; ++i) {
    const double s = (i + 0.5) / pieces, half = 0.5 / pieces;
    add([&](double at_k) { return interval_integral(contribution, at_k, s - half, s + half); },
        contribution.psi[0] + s * run, interpolate(a, b, s));
  }
}

}  // namespace

void decompose(const EdgeContribution& contribution, const DecompositionSettings& settings,
               std::vector<PointContribution>& out) {
  PointContribution c;
  c.facet = contribution.facet;
  c.part = contribution.part;
  c.bounces = contribution.bounces;
  c.mechanism = contribution.mechanism;
  const std::array<Complex, 4> pattern = contribution.pattern.at(settings.kc);
  for (int i = 0; i < 4; ++i) c.pattern[i] = std::complex<float>(pattern[i]);
  for_each_point(contribution, FrequencyBand(settings.kc), settings.kc, settings.aspect_change_rad,
                 [&](const auto& amplitude, double psi, const PathGradient& gradient) {
                   c.amplitude = amplitude(settings.kc);
                   c.psi = psi;
                   c.gradient = gradient;
                   out.push_back(c);
                 });
}

void decompose(const EdgeContribution& contribution, const FrequencyBand& band, double aspect_change_rad,
               std::vector<BandPoint>& out) {
  for_each_point(contribution, band, band.form().centre(), aspect_change_rad,
                 [&](const auto& amplitude, double psi, const PathGradient& gradient) {
                   BandPoint& point = out.emplace_back();
                   for (std::size_t n = 0; n < band.nodes().size(); ++n)
                     point.amplitude[n] = amplitude(band.nodes()[n]);
                   point.psi = psi;
                   point.gradient = gradient;
                 });
}

bool varies_slowly(const EdgeContribution& contribution, const FrequencyBand& band) {
  const auto* penumbra = std::get_if<WallPenumbraTerm>(&contribution.amplitude);
  return penumbra == nullptr || band.half_width() * penumbra->psi_spread() <= kPieceHalfPhase;
}

}  // namespace seaglint
