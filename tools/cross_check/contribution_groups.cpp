// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cross_check/contribution_groups.h"

#include <fmt/format.h>

#include <complex>

#include "tools/rcs/echo_selection.h"

namespace seaglint {

GroupSums group_sums(std::span<const Point> points, double k) {
  GroupSums sums;
  for (const Point& point : points) {
    ScatteringMatrix& sum = sums[{point.source.part, point.source.bounces, point.source.mechanism}];
    const Complex phase = std::polar(1.0, k * point.psi);
    const ScatteringMatrix matrix = point.matrix(0);
    for (std::size_t i = 0; i < 4; ++i) sum[i] += phase * matrix[i];
  }
  return sums;
}

std::string text_of(const ContributionGroup& group, const std::vector<std::string>& part_names) {
  return fmt::format("part {}, {} bounce{}, {}", part_names[group.part], group.bounces, group.bounces == 1 ? "" : "s",
                     kMechanismNames[static_cast<std::size_t>(group.mechanism)]);
}

}  // namespace seaglint
