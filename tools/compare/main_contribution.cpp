// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/main_contribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "tools/cross_check/contribution_groups.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

std::string main_contribution(const RcsRequest& request, const RcsTarget& target, const PairedCut::Place& place,
                              std::size_t quantity, const StopFlag& stop) {
  if (!request.cavities.parts.empty()) return "";
  RcsRequest monostatic = request;
  monostatic.transmitter.reset();
  const RcsView view{place.azimuth_deg, place.elevation_deg, place.frequency_hz};
  const GroupSums sums = group_sums(view_contributions(monostatic, target, view, 1, &stop).views[0].points,
                                    2 * kPi * place.frequency_hz / kSpeedOfLight);
  const Polarisation element = element_of_quantity(quantity);
  const auto size = [&](const auto& group) {
    const auto power = [&](Polarisation e) { return std::norm(group.second[static_cast<std::size_t>(e)]); };
    return is_total(quantity)
               ? power(element_of(false, transmits_v(element))) + power(element_of(true, transmits_v(element)))
               : power(element);
  };
  const auto most = std::ranges::max_element(sums, {}, size);
  if (most == sums.end() || size(*most) == 0) return "";
  return fmt::format("{}, {:.1f} dBsm", text_of(most->first, target.prepared.mesh.part_names),
                     dbsm_of_area(4 * kPi * size(*most)));
}

}  // namespace seaglint
