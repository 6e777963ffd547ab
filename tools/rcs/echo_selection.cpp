// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/echo_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/suggestion.h"

namespace seaglint {
namespace {

// One selector, or those of every mechanism of edge diffraction.
std::vector<ContributionSelector> selectors(const std::string& option, const std::string& text,
                                            const TriangleMesh& mesh) {
  const std::size_t equals = text.find('=');
  const std::string kind = text.substr(0, equals), value = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (kind == "part") {
    const auto place = std::find(mesh.part_names.begin(), mesh.part_names.end(), value);
    if (place == mesh.part_names.end())
      throw InputError(fmt::format("{} {}: no part '{}': {}", option, text, value, suggestion(value, mesh.part_names)));
    return {{ContributionSelector::Kind::kPart, static_cast<int>(place - mesh.part_names.begin())}};
  }
  if (kind == "bounces") {
    const std::optional<std::int64_t> count = parse_integer(value);
    if (!count || *count < 1 || *count > kMaxBounces)
      throw InputError(fmt::format("{} {}: bounces must be 1, 2, ... {}", option, text, kMaxBounces));
    return {{ContributionSelector::Kind::kBounces, static_cast<int>(*count)}};
  }
  if (kind == "mechanism") {
    std::vector<ContributionSelector> of_value;
    for (int i = 0; i < kMechanisms; ++i) {
      const bool edge = static_cast<Mechanism>(i) != Mechanism::kPhysicalOptics;
      if (value == kMechanismNames[static_cast<std::size_t>(i)] || (value == "edge" && edge))
        of_value.push_back({ContributionSelector::Kind::kMechanism, i});
    }
    if (!of_value.empty()) return of_value;
    throw InputError(
        fmt::format("{} {}: the mechanism must be edge or one of {}", option, text, fmt::join(kMechanismNames, ", ")));
  }
  throw InputError(fmt::format("{} {}: must be part=NAME, bounces=N or mechanism=NAME", option, text));
}

bool is_edge_diffraction(const ContributionSelector& selector) {
  return selector.kind == ContributionSelector::Kind::kMechanism &&
         selector.value != static_cast<int>(Mechanism::kPhysicalOptics);
}

}  // namespace

ContributionFilter filter_of(const EchoSelection& selection, const TriangleMesh& mesh, int max_bounces, bool edges) {
  ContributionFilter result;
  for (const std::string& text : selection.without) {
    const auto of_text = selectors("--without", text, mesh);
    result.excluded.insert(result.excluded.end(), of_text.begin(), of_text.end());
  }
  for (const std::string& text : selection.only) {
    const std::vector<ContributionSelector> of_text = selectors("--only", text, mesh);
    const ContributionSelector& first = of_text.front();
    if (first.kind == ContributionSelector::Kind::kBounces && first.value > max_bounces)
      throw InputError(
          fmt::format("--only {} requires --max-bounces {} or more; {} are traced", text, first.value, max_bounces));
    if (is_edge_diffraction(first) && !edges) throw InputError(fmt::format("--only {} requires --edges on", text));
    const auto is_excluded = [&](const ContributionSelector& one) {
      return std::ranges::find(result.excluded, one) != result.excluded.end();
    };
    if (std::ranges::all_of(of_text, is_excluded))
      throw InputError(
          fmt::format("--only {} and --without {} leave nothing of it", text, fmt::join(selection.without, " ")));
    result.included.insert(result.included.end(), of_text.begin(), of_text.end());
  }
  return result;
}

std::string text_of(const EchoSelection& selection) {
  if (selection.only.empty() && selection.without.empty()) return "all";
  return fmt::format("{}{}{}", selection.only.empty() ? "all" : fmt::format("only {}", fmt::join(selection.only, " ")),
                     selection.without.empty() ? "" : " without ", fmt::join(selection.without, " "));
}

}  // namespace seaglint
