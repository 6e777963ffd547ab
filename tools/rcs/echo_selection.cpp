// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/echo_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sim/core/process/error.h"
#include "sim/core/text/number.h"
#include "sim/core/text/suggestion.h"

namespace seaglint {
namespace {

ContributionSelector selector(const std::string& option, const std::string& text, const TriangleMesh& mesh) {
  const std::size_t equals = text.find('=');
  const std::string kind = text.substr(0, equals), value = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (kind == "part") {
    const auto place = std::find(mesh.part_names.begin(), mesh.part_names.end(), value);
    if (place == mesh.part_names.end())
      throw InputError(fmt::format("{} {}: no part '{}': {}", option, text, value, suggestion(value, mesh.part_names)));
    return {ContributionSelector::Kind::kPart, static_cast<int>(place - mesh.part_names.begin())};
  }
  if (kind == "bounces") {
    const std::optional<double> count = parse_number(value);
    if (!count || *count < 1 || *count > kMaxBounces || *count != std::floor(*count))
      throw InputError(fmt::format("{} {}: bounces must be 1, 2, ... {}", option, text, kMaxBounces));
    return {ContributionSelector::Kind::kBounces, static_cast<int>(*count)};
  }
  if (kind == "mechanism") {
    for (int i = 0; i < static_cast<int>(std::size(kMechanismNames)); ++i) {
      if (value == kMechanismNames[i]) return {ContributionSelector::Kind::kMechanism, i};
    }
    throw InputError(
        fmt::format("{} {}: the mechanism must be one of {}", option, text, fmt::join(kMechanismNames, ", ")));
  }
  throw InputError(fmt::format("{} {}: must be part=NAME, bounces=N or mechanism=NAME", option, text));
}

}  // namespace

ContributionFilter filter_of(const EchoSelection& selection, const TriangleMesh& mesh, int max_bounces, bool edges) {
  ContributionFilter result;
  for (const std::string& text : selection.without) result.excluded.push_back(selector("--without", text, mesh));
  for (const std::string& text : selection.only) {
    const ContributionSelector one = selector("--only", text, mesh);
    if (one.kind == ContributionSelector::Kind::kBounces && one.value > max_bounces)
      throw InputError(
          fmt::format("--only {} requires --max-bounces {} or more; {} are traced", text, one.value, max_bounces));
    if (one.kind == ContributionSelector::Kind::kMechanism && one.value == static_cast<int>(Mechanism::kDiffraction) &&
        !edges)
      throw InputError(fmt::format("--only {} requires --edges on", text));
    const auto same = [&](const ContributionSelector& other) {
      return other.kind == one.kind && other.value == one.value;
    };
    if (std::any_of(result.excluded.begin(), result.excluded.end(), same))
      throw InputError(fmt::format("--only {0} and --without {0} leave nothing of it", text));
    result.included.push_back(one);
  }
  return result;
}

std::string text_of(const EchoSelection& selection) {
  if (selection.only.empty() && selection.without.empty()) return "all";
  return fmt::format("{}{}{}", selection.only.empty() ? "all" : fmt::format("only {}", fmt::join(selection.only, " ")),
                     selection.without.empty() ? "" : " without ", fmt::join(selection.without, " "));
}

}  // namespace seaglint
