// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/main_contribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "tools/rcs/echo_selection.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

std::string main_contribution(const RcsRequest& request, const RcsTarget& target, const PairedCut::Place& place,
                              Polarisation element, const StopFlag& stop) {
  if (!request.cavities.parts.empty()) return "";
  RcsRequest view = request;
  view.frequency_hz = {place.frequency_hz};
  view.azimuth_deg = {place.azimuth_deg};
  view.elevation_deg = {place.elevation_deg};
  view.transmitter.reset();
  view.exports.centres = "contributions";  // not written: asks for them
  std::map<std::tuple<std::uint16_t, std::uint8_t, Mechanism>, Complex> sums;
  const double k = 2 * kPi * place.frequency_hz / kSpeedOfLight;
  for (const PointContribution& c : compute_rcs(view, target, 1, &stop).contributions)
    sums[{c.part, c.bounces, c.mechanism}] +=
        Complex(c.pattern[static_cast<std::size_t>(element)]) * c.amplitude * std::polar(1.0, k * c.psi);
  const auto most = std::max_element(
      sums.begin(), sums.end(), [](const auto& a, const auto& b) { return std::norm(a.second) < std::norm(b.second); });
  if (most == sums.end() || std::norm(most->second) == 0) return "";
  const auto& [part, bounces, mechanism] = most->first;
  return fmt::format("part {}, {} bounce{}, {}, {:.1f} dBsm", target.prepared.mesh.part_names[part], bounces,
                     bounces == 1 ? "" : "s", kMechanismNames[static_cast<std::size_t>(mechanism)], dbsm(most->second));
}

}  // namespace seaglint
