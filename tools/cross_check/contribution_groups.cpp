// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cross_check/contribution_groups.h"

#include <fmt/format.h>

#include <complex>

#include "tools/rcs/echo_selection.h"

namespace seaglint {

GroupSums group_sums(std::span<const PointContribution> contributions, double k) {
  GroupSums sums;
  for (const PointContribution& c : contributions) {
    std::array<Complex, 4>& sum = sums[{c.part, c.bounces, c.mechanism}];
    const Complex field = c.amplitude * std::polar(1.0, k * c.psi);
    for (std::size_t i = 0; i < 4; ++i) sum[i] += Complex(c.pattern[i]) * field;
  }
  return sums;
}

std::string text_of(const ContributionGroup& group, const std::vector<std::string>& part_names) {
  return fmt::format("part {}, {} bounce{}, {}", part_names[group.part], group.bounces, group.bounces == 1 ? "" : "s",
                     kMechanismNames[static_cast<std::size_t>(group.mechanism)]);
}

}  // namespace seaglint
