// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cli/rcs_cross_check_run.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/standard_output.h"
#include "tools/cross_check/cross_check_figure.h"
#include "tools/cross_check/cross_check_table.h"
#include "tools/cross_check/rcs_cross_check.h"
#include "tools/figure/figure.h"
#include "tools/pipeline/output_files.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {
namespace {

CrossCheck compute(const RcsArguments& arguments, const RcsRequest& request, const RcsTarget& target,
                   const CommandContext& context) {
  try {
    return cross_check_rcs(request, target, context.threads, &context.stop);
  } catch (const WorkError& error) {
    if (arguments.output.empty()) throw;
    throw WorkError(fmt::format("{}; {} is not written", error.what(), arguments.output));
  }
}

}  // namespace

void run_rcs_cross_check(const RcsArguments& arguments, const CommandContext& context) {
  const std::filesystem::path figure =
      arguments.output.empty() ? "" : std::filesystem::path(arguments.output).replace_extension(".png");
  if (!arguments.output.empty()) {
    require_figure(figure);
    require_outputs({arguments.output, figure.string()},
                    std::vector<std::filesystem::path>(arguments.targets.begin(), arguments.targets.end()));
  }
  RcsRequest request = arguments.make_request();
  request.method = SolverMethod::kRays;  // has the settings of both methods
  std::vector<std::string> warnings = request_warnings(request);
  PreparedTarget prepared = prepare_mesh(request);
  warnings.insert(warnings.end(), prepared.warnings.begin(), prepared.warnings.end());
  warn(warnings);
  const RcsTarget target = select_echoes(request, std::move(prepared));
  const CrossCheck check = compute(arguments, request, target, context);
  if (!arguments.output.empty()) write_file(arguments.output, cross_check_table(request, target, check, warnings));
  print_out("{}", cross_check_text(check, target));
  if (arguments.output.empty()) return;
  print_out("Table: {}\n", arguments.output);
  const PlotPanels panels = cross_check_plots(check);
  if (panels.plots.empty()) return;
  write_figure(fmt::format("{}, seaglint {}", arguments.target_name(), kVersion), panels, figure);
  print_out("Figure: {}\n", figure.string());
}

}  // namespace seaglint
