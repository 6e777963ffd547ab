// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "tools/cli/command_line.h"
#include "tools/compare/cross_check.h"
#include "tools/compare/differences.h"
#include "tools/figure/figure.h"
#include "tools/options/rcs_arguments.h"
#include "tools/page/html.h"
#include "tools/pipeline/warnings.h"
#include "tools/rcs/hot_spots.h"
#include "tools/rcs/rcs_figure.h"
#include "tools/rcs/rcs_statistics.h"
#include "tools/rcs/rcs_table.h"
#include "tools/rcs/rcs_uncertainty.h"
#include "tools/rcs/rcs_views.h"
#include "tools/rcs/turntable.h"
#include "tools/rcs/turntable_figure.h"

namespace seaglint {

namespace {

CrossCheck cross_checked(const RcsArguments& arguments, const RcsRequest& request, const RcsTarget& target,
                         const CommandContext& context) {
  try {
    return cross_check_rcs(request, target, context.threads, &context.stop);
  } catch (const WorkError& error) {
    if (arguments.output.empty()) throw;
    throw WorkError(fmt::format("{}; {} is not written", error.what(), arguments.output));
  }
}

// `rcs --cross-check`: prints the sweep's cross-check and writes its table where an output is given.
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
  print_note(prepared.materials_note);
  warnings.insert(warnings.end(), prepared.warnings.begin(), prepared.warnings.end());
  warn(warnings);
  const RcsTarget target = select_echoes(request, std::move(prepared));
  const CrossCheck check = cross_checked(arguments, request, target, context);
  if (!arguments.output.empty()) write_file(arguments.output, cross_check_table(request, target, check, warnings));
  print_out("{}", cross_check_text(check, target));
  if (arguments.output.empty()) return;
  print_out("Table: {}\n", arguments.output);
  PlotPanels panels = cross_check_plots(check);
  if (panels.plots.empty()) return;
  panels.title = arguments.target_name();
  panels.notes = sweep_notes(request);
  panels.size.style = figure_style(arguments.style);
  write_figure(panels, figure);
  print_out("Figure: {}\n", figure.string());
}

std::filesystem::path figure_file(const RcsArguments& arguments) {
  if (arguments.reference.figure_given()) return arguments.reference.figure;
  return std::filesystem::path(arguments.output).replace_extension(".png");
}

bool is_figure_asked(const RcsArguments& arguments) {
  return arguments.reference.figure_given() || !arguments.reference.files.empty() || arguments.request.uncertainty;
}

// Levels are drawn beside a table that is a file, not a device, except those of the one row of an export of a view, and
// unless another figure has that name.
bool is_drawn(const RcsArguments& arguments) {
  std::error_code error;
  const std::filesystem::file_status output = std::filesystem::status(arguments.output, error);
  const bool is_file = !std::filesystem::exists(output) || std::filesystem::is_regular_file(output);
  const std::filesystem::path figure = figure_file(arguments);
  const bool is_free = figure != arguments.isar && figure != arguments.profiles && !arguments.request.exports.wanted();
  return arguments.reference.draws() && (is_figure_asked(arguments) || (is_file && is_free));
}

bool has_images(const RcsArguments& arguments) { return !arguments.isar.empty() || !arguments.profiles.empty(); }

// Throws before any work where the sweep cannot have the images that are asked for.
void require_images(const RcsArguments& arguments, const RcsRequest& request, const TriangleMesh& mesh) {
  for (const auto& [file, option] :
       {std::pair{&arguments.isar, "--isar"}, std::pair{&arguments.profiles, "--profiles"}}) {
    if (file->empty()) continue;
    require_turntable(request, option);
    require_window(request, mesh, option, file == &arguments.isar);
  }
  if (arguments.polar && !arguments.reference.draws())
    throw InputError("--polar: there is no figure with --figure off");
  if (arguments.polar && request.azimuth_deg.size() < kFewestDrawn)
    throw InputError(
        fmt::format("--azimuth-deg: {} values: --polar needs at least {}", request.azimuth_deg.size(), kFewestDrawn));
}

void require_files(const RcsArguments& arguments) {
  const ViewExport& exports = arguments.request.exports;
  std::vector<std::filesystem::path> inputs(arguments.reference.files.begin(), arguments.reference.files.end());
  inputs.insert(inputs.end(), arguments.targets.begin(), arguments.targets.end());
  std::vector<std::string> outputs{arguments.output,           exports.centres, exports.hot_spots,
                                   arguments.reference.curves, arguments.isar,  arguments.profiles,
                                   arguments.statistics};
  if (is_drawn(arguments)) {
    outputs.push_back(figure_file(arguments));
    if (is_figure_asked(arguments)) require_figure(outputs.back());
  }
  require_outputs(outputs, inputs);
  require_figure(arguments.isar);
  require_figure(arguments.profiles);
  if (!exports.hot_spots.empty()) require_hot_spots(exports.hot_spots);
}

// Draws the comparison; without references the uncertainty where it is asked for, else the levels. A figure that was
// not asked for is left out, with the reason, where gnuplot or the place is missing.
void show_figure(const RcsArguments& arguments, const RcsRequest& request, const std::vector<PairedCut>& cuts,
                 const RcsSweep& sweep) {
  const std::filesystem::path figure = figure_file(arguments);
  const bool is_asked = is_figure_asked(arguments);
  try {
    PlotPanels panels = !cuts.empty()                   ? comparison_plots(cuts, arguments.reference.floor_db)
                        : arguments.request.uncertainty ? uncertainty_plots(sweep)
                                                        : level_plots(sweep, arguments.polar);
    panels.title = arguments.target_name();
    panels.notes = sweep_notes(request);
    if (arguments.polar)
      panels.notes.insert(panels.notes.begin(), "azimuth counter-clockwise seen from above, 90: port");
    panels.size.style = figure_style(arguments.style);
    if (!panels.plots.empty()) write_figure(panels, figure);
    if (!panels.plots.empty())
      print_out("Figure: {}\n", figure.string());
    else if (is_asked)
      print_out("No figure: it needs a cut along azimuth, elevation or frequency of {} points or more\n",
                cuts.empty() && !arguments.request.uncertainty ? kFewestDrawn : std::size_t{2});
  } catch (const WorkError& error) {
    if (is_asked) throw;
    print_out("No figure: {}\n", error.what());
  }
}

// The turntable image and the range profiles that are asked for.
void show_images(const RcsArguments& arguments, const RcsRequest& request, const RcsTarget& target,
                 const RcsSweep& sweep, int threads) {
  const FigureStyle style = figure_style(arguments.style);
  const auto element = static_cast<std::size_t>(std::ranges::find(kPolarisationNames, arguments.polarisation) -
                                                std::begin(kPolarisationNames));
  const TurntableEcho echo = turntable_echo(sweep, element);
  const TurntableSampling sampling = turntable_sampling(echo.frequency_hz, echo.azimuth_deg, echo.elevation_deg);
  const TriangleMesh& mesh = target.prepared.mesh;
  const TurntableExtent extent = turntable_extent(mesh, echo.azimuth_deg, echo.elevation_deg);
  TurntableCaption caption{fmt::format("{}, {}", arguments.target_name(), arguments.polarisation),
                           solver_notes(request)};
  if (!arguments.isar.empty()) {
    const Heatmap figure =
        turntable_figure(echo, turntable_image(echo, turntable_area(sampling, &extent), threads), &mesh, caption);
    write_figure(figure, arguments.isar, map_size(style));
    print_out("Turntable image: {}\n", arguments.isar);
  }
  if (arguments.profiles.empty()) return;
  const bool has_names = !request.sea.reflection && request.cavities.parts.empty();
  const Heatmap figure =
      profiles_figure(echo, turntable_profiles(echo, profiles_range(sampling, &extent)), caption,
                      has_names ? part_names(request, target) : PeakNames(), style == FigureStyle::kPaper ? 6 : 12);
  write_figure(figure, arguments.profiles, map_size(style));
  print_out("Range profiles: {}\n", arguments.profiles);
}

// Writes and prints the statistics of sectors. `warnings`: of the sweep's table.
void show_statistics(const RcsArguments& arguments, const RcsRequest& request, const RcsTarget& target,
                     const RcsSweep& sweep, std::vector<std::string> warnings) {
  const TriangleMesh& mesh = target.prepared.mesh;
  const RcsStatistics statistics = rcs_statistics(sweep, arguments.sector_deg);
  const AzimuthSampling sampling = azimuth_sampling(request, mesh);
  const std::string sampled = sampling_text(statistics, sampling);
  if (const auto few = sampling_warning(statistics, sampling)) {
    warn(std::array{*few});
    warnings.push_back(*few);
  }
  const std::string heading =
      rcs_heading(request, *target.prepared.scatterer, "rcs --statistics", warnings) + "# " + sampled + "\n";
  write_file(arguments.statistics, statistics_csv(statistics, heading, mesh.part_names));
  if (mesh.part_names.size() > 1 && !request.by_part)
    print_out("No statistics by part: {} rows of {} parts are too many\n", sweep.rows(), mesh.part_names.size());
  print_out("{}{}\nStatistics: {}\n", statistics_table(statistics, mesh.part_names), sampled, arguments.statistics);
}

// Writes the panels of the comparison's figure; without any there are no curves.
void write_curves(const std::string& file, const std::vector<PairedCut>& cuts, double floor_db) {
  const PlotPanels panels = comparison_plots(cuts, floor_db);
  write_file(file, plot_json(panels.plots, panels.columns) + "\n");
  print_out("Curves: {}\n", file);
}

// The cuts of all references that the sweep covers; throws before any work if one does not match.
std::vector<PairedCut> pair_with_all(const RcsSweep& sweep, const std::vector<FieldTable>& references) {
  std::vector<PairedCut> cuts;
  for (const FieldTable& reference : references) {
    for (const RcsCut& element : reference.cuts) {
      for (PairedCut& cut : match_reference(sweep, element)) cuts.push_back(std::move(cut));
    }
  }
  return cuts;
}

// The sweep; without --converge a series of no steps.
ConvergedSweep compute(const RcsArguments& arguments, const RcsRequest& request, const RcsTarget& target,
                       const CommandContext& context) {
  try {
    if (!arguments.converge_db) {
      return {compute_rcs(request, target, context.threads, &context.stop,
                          [](const std::string& line) { print_error(line + "\n"); }),
              {},
              true};
    }
    return converge_rcs(request, target, *arguments.converge_db, context.threads, &context.stop,
                        [](const std::string& line) { print_error(line); });
  } catch (const WorkError& error) {
    throw WorkError(fmt::format("{}; {} is not written", error.what(), arguments.output));
  }
}

void run_rcs(const RcsArguments& arguments, const CommandContext& context) {
  require_files(arguments);
  RcsRequest request = arguments.make_request();
  sector_count(arguments.sector_deg);  // throws before any work
  std::vector<std::string> warnings = request_warnings(request);
  warn(warnings);
  const RcsSweep asked = requested_sweep(request);
  std::vector<PairedCut> cuts = pair_with_all(asked, read_and_report(arguments.reference));
  PreparedTarget prepared = prepare_mesh(request);
  print_note(prepared.materials_note);
  warnings.insert(warnings.end(), prepared.warnings.begin(), prepared.warnings.end());
  warn(prepared.warnings);
  require_images(arguments, request, prepared.mesh);
  const RcsTarget target = select_echoes(request, std::move(prepared));
  require_hot_spots(request.exports.hot_spots, target);
  if (!arguments.statistics.empty()) {
    request.by_part = has_statistics_by_part(request, target.prepared.mesh);
  } else if (const auto lobes = lobe_warning(request, target.prepared.mesh)) {
    warn(std::array{*lobes});
  }
  for (const NamedCavity& cavity : target.cavities) {
    print_error(fmt::format("cavity {}: aperture of {:.4g} m^2, walls of {:.4g} m^2, {} patches at {:.6g} GHz\n",
                            cavity.name, cavity.size.aperture_m2, cavity.size.walls_m2, cavity.size.patches,
                            1e-9 * *std::max_element(request.frequency_hz.begin(), request.frequency_hz.end())));
  }
  const auto start = std::chrono::steady_clock::now();
  const ConvergedSweep computed = compute(arguments, request, target, context);
  const RcsResult& result = computed.result;
  if (!computed.series.empty()) request = at_step(request, computed.series.back());
  const double seconds =
      std::max(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1e-9);

  const RcsSweep& sweep = result.sweep;
  const std::vector<std::string> uncertain = uncertainty_warnings(sweep, target.prepared.mesh.part_names);
  warn(uncertain);
  warnings.insert(warnings.end(), uncertain.begin(), uncertain.end());
  if (!computed.converged) warnings.push_back(convergence_warning(request, computed));
  write_file(arguments.output, rcs_table(request, *target.prepared.scatterer, sweep, warnings));
  std::vector<RcsCut> solved;
  if (!arguments.export_as.empty()) append_cuts(sweep, solved);
  const std::filesystem::path output = arguments.output;
  for (const std::string& format : arguments.export_as) {
    for (const std::filesystem::path& file :
         write_cuts_as(format, solved, output.parent_path(), output.stem().string()))
      print_out("{}\n", file.string());
  }
  const double million_segments = 1e-6 * static_cast<double>(result.segments),
               views = static_cast<double>(sweep.views());
  print_error(fmt::format("{}: {} rows, {} views in {:.2f} s ({:.3g} views/s, {:.2f} M segments, {:.2f} M/s)\n",
                          arguments.output, sweep.rows(), sweep.views(), seconds, views / seconds, million_segments,
                          million_segments / seconds));
  if (request.exports.wanted()) print_out("{}", export_view(request, target, result.points));
  for (PairedCut& cut : cuts) set_models(cut, sweep);
  if (!cuts.empty()) print_out("{}", error_table(cuts, arguments.reference.floor_db));
  if (!arguments.statistics.empty()) {
    show_statistics(arguments, request, target, sweep, warnings);
  } else if (cuts.empty()) {
    print_out("{}", statistics_text(level_statistics(sweep)));
  }
  if (is_drawn(arguments)) show_figure(arguments, request, cuts, sweep);
  if (has_images(arguments)) show_images(arguments, request, target, sweep, context.threads);
  if (!arguments.reference.curves.empty()) write_curves(arguments.reference.curves, cuts, arguments.reference.floor_db);
  if (!computed.converged) throw WorkError(fmt::format("{}: {}", arguments.output, warnings.back()));
}

}  // namespace

void add_rcs(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command("rcs", "Scattering matrix of a mesh at rest over frequency and aspect");
  auto arguments = std::make_shared<RcsArguments>();
  arguments->add_to(command);
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint rcs --target assets/icosahedral_reflector.glb --frequency-ghz 16 --azimuth-deg 0:360:0.5 "
      "--elevation-deg 2 -o rcs.csv\n  seaglint rcs --target plate.glb --frequency-ghz 10.24 --azimuth-deg 0:60:0.5 -o "
      "plate.csv --reference "
      "ref.H.txt --reference ref.V.txt\n  seaglint rcs --target ship.glb --frequency-ghz 9.85:10.15:0.001 "
      "--azimuth-deg "
      "29.1:30.9:0.009 -o ship.csv --isar ship_isar.png --profiles ship_profiles.png\n  seaglint rcs --target ship.glb "
      "--waterline-m 0 --frequency-ghz 9.4 --azimuth-deg 0:360:0.5 --elevation-deg 1 -o ship.csv --statistics "
      "ship_statistics.csv");
  command.callback([arguments, command, &context] {
    command.require_any_of("--transmit-elevation-deg", {"--transmit-azimuth-deg"});
    if (!shows_centres(arguments->request.exports.hot_spots))
      command.require_any_of("--centre-cell-m", {"--export-scattering-centres"});
    command.require_any_of("--export-dynamic-range-db", {"--export-scattering-centres", "--export-hot-spots"});
    command.require_any_of("--polarisation", {"--isar", "--profiles"});
    command.require_one_of({"--output", "--cross-check"});
    command.refuse_with("--polar", {"--reference", "--uncertainty"});
    command.refuse_with("--average",
                        {"--cross-check", "--converge", "--uncertainty", "--statistics", "--reference", "--export-as",
                         "--export-scattering-centres", "--export-hot-spots", "--isar", "--profiles"});
    command.refuse_with("--cross-check", {"--method", "--cavity", "--converge", "--uncertainty", "--statistics",
                                          "--reference", "--export-as", "--export-scattering-centres",
                                          "--export-hot-spots", "--isar", "--profiles", "--polar"});
    context.work = [arguments, &context] {
      arguments->cross_check ? run_rcs_cross_check(*arguments, context) : run_rcs(*arguments, context);
    };
  });
}

}  // namespace seaglint
