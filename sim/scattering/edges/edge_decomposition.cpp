// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/edges/edge_decomposition.h"

#include <algorithm>
#include <cmath>

namespace seaglint {

void split(const EdgeFootprint& footprint, const SplitSettings& settings, std::vector<Contribution>& out) {
  Contribution c;
  c.facet = footprint.facet;
  c.part = footprint.part;
  c.bounces = footprint.bounces;
  c.mechanism = Mechanism::kEdge;
  const std::array<Complex, 4> pattern = footprint.pattern.at(settings.kc);
  for (int i = 0; i < 4; ++i) c.pattern[i] = std::complex<float>(pattern[i]);
  const double k = settings.kc, run = footprint.psi[1] - footprint.psi[0];
  // Turning by u changes psi's slope along the edge by at most 2 u.
  const double threshold = 2 * settings.turn_rad / kAmplitudeError * footprint.length;
  if (std::abs(run) > threshold && std::abs(k * run) / 2 > kPieceHalfPhase && ends_answer_alone(footprint, k)) {
    for (int i = 0; i < 2; ++i) {
      const Complex end = end_term(footprint, k, i);
      c.amplitude = i == 0 ? -end : end;
      c.psi = footprint.psi[i];
      c.gradient = footprint.gradient[i];
      out.push_back(c);
    }
    return;
  }
  const double slope = std::max(std::abs(run), kAmplitudeError * threshold);
  const int pieces = std::max(1, static_cast<int>(std::ceil(k * slope / 2 / kPieceHalfPhase)));
  const PathGradient &a = footprint.gradient[0], &b = footprint.gradient[1];
  for (int i = 0; i < pieces; ++i) {
    const double s = (i + 0.5) / pieces, half = 0.5 / pieces;
    c.amplitude = part_integral(footprint, k, s - half, s + half);
    c.psi = footprint.psi[0] + s * run;
    c.gradient = between(a, b, s);
    out.push_back(c);
  }
}

}  // namespace seaglint
