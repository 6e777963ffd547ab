// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/like_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "sim/core/process/error.h"

namespace seaglint {

std::vector<std::string> like_names() {
  std::vector<std::string> names;
  for (const LikeProgram& program : kLikePrograms) names.emplace_back(program.name);
  return names;
}

const LikeProgram& like_program(std::string_view name) {
  for (const LikeProgram& program : kLikePrograms) {
    if (program.name == name) return program;
  }
  throw InputError(fmt::format("like: value '{}': must be one of {}", name, fmt::join(like_names(), ", ")));
}

const LikeProgram* like_program_of_reader(std::string_view reader) {
  const auto says = [&](std::string_view word) { return reader.find(word) != std::string_view::npos; };
  if (says("HFSS") || says("PyAEDT")) return &like_program("hfss");
  if (says("FEKO")) return &like_program("feko");
  if (says("CST")) return &like_program("cst");
  return nullptr;
}

RcsRequest solved_like(RcsRequest request, const LikeProgram& program, const GivenSettings& given) {
  request.like = program.name;
  if (!given.crease) request.crease_deg = program.flat ? std::optional(0.0) : std::nullopt;
  if (!given.edges) request.edges = program.edges;
  if (!given.max_bounces) request.max_bounces = program.max_bounces;
  return request;
}

std::string solver_text(const RcsRequest& request) {
  const std::string facets = !request.crease_deg       ? "surfaces smooth as the mesh says"
                             : *request.crease_deg > 0 ? fmt::format("crease angle {:g} deg", *request.crease_deg)
                                                       : "flat facets";
  return fmt::format("{}, {} edge diffraction, at most {} bounces, method {}{}", facets, request.edges ? "with" : "no",
                     request.max_bounces, kSolverMethodNames[static_cast<int>(request.method)],
                     request.like.empty() ? "" : " (--like " + request.like + ")");
}

}  // namespace seaglint
