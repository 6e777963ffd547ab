// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Sums of the contributions of one view by part, number of bounces and mechanism.

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scattering/points/decomposition.h"

namespace seaglint {

struct ContributionGroup {
  std::uint16_t part = 0;  // index into the mesh's parts
  std::uint8_t bounces = 1;
  Mechanism mechanism = Mechanism::kPhysicalOptics;

  auto operator<=>(const ContributionGroup&) const = default;  // NOLINT(modernize-use-nullptr): compares with 0
};

using GroupSums = std::map<ContributionGroup, ScatteringMatrix>;

// hh, hv, vh, vv of every group that occurs, m, at wavenumber k; phase about the point that psi refers to.
GroupSums group_sums(std::span<const Point> points, double k);

// "part hull, 2 bounces, po"
std::string text_of(const ContributionGroup& group, const std::vector<std::string>& part_names);

}  // namespace seaglint
