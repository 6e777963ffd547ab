// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/edge_decomposition.h"

#include <algorithm>
#include <cmath>

namespace seaglint {

void decompose(const EdgeContribution& contribution, const DecompositionSettings& settings,
               std::vector<PointContribution>& out) {
  PointContribution c;
  c.facet = contribution.facet;
  c.part = contribution.part;
  c.bounces = contribution.bounces;
  c.mechanism = contribution.mechanism;
  const std::array<Complex, 4> pattern = contribution.pattern.at(settings.kc);
  for (int i = 0; i < 4; ++i) c.pattern[i] = std::complex<float>(pattern[i]);
  const double k = settings.kc, run = contribution.psi[1] - contribution.psi[0];
  // An aspect change u changes the slope of psi along the edge by at most 2 u.
  const double threshold = 2 * settings.aspect_change_rad / kMaxAmplitudeError * contribution.length;
  if (std::abs(run) > threshold && std::abs(k * run) / 2 > kMaxHalfPhase && endpoints_suffice(contribution, k)) {
    for (int i = 0; i < 2; ++i) {
      const Complex end = endpoint_term(contribution, k, i);
      c.amplitude = i == 0 ? -end : end;
      c.psi = contribution.psi[i];
      c.gradient = contribution.gradient[i];
      out.push_back(c);
    }
    return;
  }
  const double slope = std::max(std::abs(run), kMaxAmplitudeError * threshold);
  const int pieces = std::max(1, static_cast<int>(std::ceil(k * slope / 2 / kMaxHalfPhase)));
  const PathGradient &a = contribution.gradient[0], &b = contribution.gradient[1];
  for (int i = 0; i < pieces; ++i) {
    const double s = (i + 0.5) / pieces, half = 0.5 / pieces;
    c.amplitude = interval_integral(contribution, k, s - half, s + half);
    c.psi = contribution.psi[0] + s * run;
    c.gradient = interpolate(a, b, s);
    out.push_back(c);
  }
}

}  // namespace seaglint
