// SPDX-License-Identifier: BSD-3-Clause
#include "tools/warnings.h"

#include <fmt/format.h>

#include <cstdio>

#include "tools/pipeline.h"

namespace seaglint {

std::vector<std::string> mesh_doubts(const Pipeline& pipeline) {
  std::vector<std::string> lines;
  for (const Target& target : std::span(pipeline.targets()).first(pipeline.scenario().targets.size())) {  // no companions
    for (const std::string& doubt : target.doubts) lines.push_back(fmt::format("targets.{}.mesh: {}", target.spec.name, doubt));
  }
  return lines;
}

void warn(std::span<const std::string> sentences) {
  for (const std::string& sentence : sentences) fmt::print(stderr, "seaglint: warning: {}\n", sentence);
}

}  // namespace seaglint
