// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "seaglint_version.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "tools/cli/command_line.h"
#include "tools/compare/comparison_page.h"
#include "tools/compare/comparison_text.h"
#include "tools/compare/differences.h"
#include "tools/compare/turntables.h"
#include "tools/figure/figure.h"
#include "tools/options/rcs_arguments.h"
#include "tools/page/html.h"
#include "tools/pipeline/warnings.h"
#include "tools/rcs/rcs_figure.h"
#include "tools/rcs/rcs_table.h"

namespace seaglint {
namespace {

struct CompareArguments {
  RcsArguments rcs;  // of the target
  ReferenceArguments exports;
  std::string against, directory;
  std::optional<double> tolerance_db, min_correlation, interpolation_radius_m;
  bool as_is = false;
};

void say(const std::string& line) { print_error(on_one_line(line) + "\n"); }

// The geometry that all exports name. Throws InputError where they name none or different ones.
std::vector<GeometryFile> geometry_of(const std::vector<FieldTable>& tables) {
  constexpr const char* kMissing = "compare: give either --target MESH or --against FILE";
  for (const FieldTable& table : tables) {
    if (table.geometry.empty())
      throw InputError(fmt::format("{}: {} names no geometry that is beside it", kMissing, table.name));
    if (table.geometry != tables.front().geometry)
      throw InputError(
          fmt::format("{}: {} and {} name different geometries", kMissing, tables.front().name, table.name));
  }
  return tables.front().geometry;
}

std::string text_of(const std::vector<GeometryFile>& geometry) {
  std::string text;
  for (const GeometryFile& mesh : geometry)
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", mesh.file.string(), mesh.unit);
  return text;
}

// What the exports are compared with: a mesh, or another table.
struct Counterpart {
  std::optional<RcsTarget> target;
  RcsRequest request;  // of the target
  std::optional<FieldTable> table;
};

Counterpart counterpart_of(const CompareArguments& arguments, const std::vector<FieldTable>& tables) {
  Counterpart counterpart;
  if (!arguments.against.empty()) {
    ReferenceArguments other;
    other.files = {arguments.against};
    counterpart.table = joined_tables(read_and_report(other), arguments.against);
    return counterpart;
  }
  counterpart.request = at_frequencies_of(tables, arguments.rcs.make_mesh_request());
  if (arguments.rcs.targets.empty()) {
    const std::vector<GeometryFile> geometry = geometry_of(tables);
    if (arguments.rcs.request.unit != "m")
      throw InputError("--unit is for --target: the export states the unit of its geometry");
    say(fmt::format("target as the export names it: {}", text_of(geometry)));
    set_target_files(counterpart.request, geometry);
  }
  counterpart.target = prepare_rcs_target(counterpart.request);
  print_note(counterpart.target->prepared.materials_note);
  warn(counterpart.target->prepared.warnings);
  return counterpart;
}

// Writes NAME.png and NAME.svg; empty without any plot.
std::filesystem::path draw_panels(const PlotPanels& panels, const std::filesystem::path& directory,
                                  const std::string& name) {
  if (panels.plots.empty()) return {};
  for (const char* kind : {".png", ".svg"}) write_figure(panels, directory / (name + kind));
  return directory / (name + ".png");
}

constexpr const char* kImages[] = {"image_export.png", "image_compared.png", "image_difference.png"};
constexpr const char* kTurntables[] = {"turntable_export.png", "profiles_export.png", "turntable_compared.png",
                                       "profiles_compared.png"};

// Phrases of the small print: what both sides are of.
std::vector<std::string> notes_of(const std::vector<PairedCut>& cuts, const Counterpart& counterpart) {
  const auto span = [&](const char* name, double PairedCut::Place::*value, double unit, const char* unit_name) {
    double low = 1e300, high = -1e300;
    for (const PairedCut& cut : cuts) {
      for (const PairedCut::Place& place : cut.places) {
        low = std::min(low, unit * place.*value);
        high = std::max(high, unit * place.*value);
      }
    }
    return low == high ? fmt::format("{}{:.6g} {}", name, low, unit_name)
                       : fmt::format("{}{:.6g} to {:.6g} {}", name, low, high, unit_name);
  };
  const bool monostatic = !cuts.empty() && !cuts.front().places.empty() && is_monostatic(cuts.front().places.front());
  std::vector<std::string> notes{span("", &PairedCut::Place::frequency_hz, 1e-9, "GHz"),
                                 span("azimuth ", &PairedCut::Place::azimuth_deg, 1, "deg"),
                                 span("elevation ", &PairedCut::Place::elevation_deg, 1, "deg"),
                                 monostatic ? "monostatic" : "bistatic"};
  const std::vector<std::string> solver =
      counterpart.target ? solver_notes(counterpart.request) : std::vector{fmt::format("seaglint {}", kVersion)};
  notes.insert(notes.end(), solver.begin(), solver.end());
  return notes;
}

// Curves, images and range profiles, as far as the cuts have them.
ComparisonFigures draw(const std::vector<ExportComparison>& comparisons, const ComparisonSettings& settings,
                       const Counterpart& counterpart, const CommandContext& context,
                       const std::filesystem::path& directory) {
  std::vector<PairedCut> cuts;
  for (const ExportComparison& comparison : comparisons)
    cuts.insert(cuts.end(), comparison.cuts.begin(), comparison.cuts.end());
  const std::string title = fmt::format("{} against {}", comparisons.front().name, comparisons.front().compared);
  const std::vector<std::string> notes = notes_of(cuts, counterpart);
  const auto drawn = [&](PlotPanels panels, const char* name) {
    panels.title = title;
    panels.notes = notes;
    return draw_panels(panels, directory, name);
  };
  ComparisonFigures figures;
  figures.curves = drawn(comparison_plots(cuts, settings.floor_db), "compare");
  std::vector<Heatmap> images = comparison_images(cuts, settings.floor_db);
  for (std::size_t i = 0; i < images.size(); ++i) {
    figures.images.push_back(directory / kImages[i]);
    images[i].notes = notes;
    write_figure(images[i], figures.images.back(), {720, 490});
  }
  TurntableTarget target{.threads = context.threads};
  if (counterpart.target) {
    target.mesh = &counterpart.target->prepared.mesh;
    if (counterpart.request.cavities.parts.empty()) target.names = part_names(counterpart.request, *counterpart.target);
    target.notes = solver_notes(counterpart.request);
  } else {
    target.notes = {notes.back()};
  }
  if (const auto turntable = compared_turntable(cuts)) {
    const std::vector<Heatmap> pictures = turntable_pictures(*turntable, target);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      figures.turntables.push_back(directory / kTurntables[i]);
      write_figure(pictures[i], figures.turntables.back(), map_size(FigureStyle::kScreen));
    }
  }
  const PlotPanels profiles = range_profile_plots(cuts, target.names);
  figures.profiles = drawn(profiles, "range_profiles");
  constexpr std::size_t kMostPoints = 50'000;  // of the page's script, about 1 MB
  std::size_t points = 0;
  for (const LinePlot& plot : profiles.plots) {
    for (const Series& series : plot.series) points += series.x.size();
  }
  if (points > 0 && points <= kMostPoints) figures.profiles_plot = plot_json(profiles.plots, profiles.columns);
  return figures;
}

// "; from the known value (exact (Mie series)) the export differs by 1.06 dB rms, seaglint by 0.03 dB", empty where
// nothing is known.
std::string known_too(const ExportComparison& comparison, std::size_t quantity) {
  if (!comparison.known) return "";
  for (const KnownStatistics& s : comparison.known->statistics) {
    if (s.quantity == quantity)
      return fmt::format("; from the known value ({}) the export differs by {:.2f} dB rms, {} by {:.2f} dB",
                         comparison.known->name, s.reference.rms_db, comparison.compared, s.compared.rms_db);
  }
  return "";
}

// Why a comparison is not good enough, a sentence each.
std::vector<std::string> failures(const std::vector<ExportComparison>& comparisons, const CompareArguments& arguments) {
  std::vector<std::string> sentences;
  for (const ExportComparison& comparison : comparisons) {
    for (const std::string& sentence : comparison.one_sided) {
      if (arguments.tolerance_db || arguments.min_correlation)
        sentences.push_back(fmt::format("{} {}", comparison.name, sentence));
    }
    for (const ElementStatistics& s : comparison.elements) {
      const char* element = kQuantityNames[s.quantity()];
      if (arguments.tolerance_db && s.difference.mean_db > *arguments.tolerance_db)
        sentences.push_back(fmt::format("{} {}: mean difference {:.3f} dB is over --tolerance-db {:g}{}",
                                        comparison.name, element, s.difference.mean_db, *arguments.tolerance_db,
                                        known_too(comparison, s.quantity())));
      if (arguments.min_correlation && std::abs(s.difference.correlation.value_or(0)) < *arguments.min_correlation)
        sentences.push_back(fmt::format("{} {}: correlation {:.4f} is under --min-correlation {:g}", comparison.name,
                                        element, std::abs(s.difference.correlation.value_or(0)),
                                        *arguments.min_correlation));
    }
  }
  return sentences;
}

// Throws InputError where no element of any export is left.
void require_comparison(const std::vector<ExportComparison>& comparisons) {
  std::string why;
  for (const ExportComparison& comparison : comparisons) {
    if (!comparison.elements.empty()) return;
    for (const std::vector<std::string>* sentences : {&comparison.omitted, &comparison.one_sided}) {
      for (const std::string& sentence : *sentences) why += fmt::format("\n  {}: {}", comparison.name, sentence);
    }
  }
  throw InputError("compare: nothing to compare:" + why);
}

// Makes the directory; throws before any work where a result cannot be written.
void require_results(const CompareArguments& arguments) {
  const std::filesystem::path directory = arguments.directory;
  make_directory(directory);
  std::vector<std::filesystem::path> inputs(arguments.exports.files.begin(), arguments.exports.files.end());
  inputs.insert(inputs.end(), arguments.rcs.targets.begin(), arguments.rcs.targets.end());
  if (!arguments.against.empty()) inputs.emplace_back(arguments.against);
  std::vector<std::string> outputs;
  for (const char* name : {"compare.json", "compare.csv", "compare.html", "compare.png", "compare.svg",
                           "range_profiles.png", "range_profiles.svg"})
    outputs.push_back((directory / name).string());
  for (const char* name : kImages) outputs.push_back((directory / name).string());
  for (const char* name : kTurntables) outputs.push_back((directory / name).string());
  require_outputs(outputs, inputs);
  require_figure(directory / "compare.png");
}

// Those of the first export as DIR/solved..., of the others as DIR/solved_2... and so on.
std::vector<std::filesystem::path> write_solved(const std::vector<ExportComparison>& comparisons,
                                                const CompareArguments& arguments) {
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const std::string stem = i == 0 ? "solved" : fmt::format("solved_{}", i + 1);
    for (const std::string& format : arguments.rcs.export_as) {
      const auto written = write_cuts_as(format, comparisons[i].solved, arguments.directory, stem);
      files.insert(files.end(), written.begin(), written.end());
    }
  }
  return files;
}

void run_compare(const CompareArguments& arguments, const CommandContext& context) {
  if (!arguments.rcs.targets.empty() && !arguments.against.empty())
    throw InputError("compare: give either --target MESH or --against FILE");
  if (!arguments.rcs.like.empty() && !arguments.against.empty())
    throw InputError("--like is for --target: it says how the mesh is solved");
  if (arguments.interpolation_radius_m && arguments.against.empty())
    throw InputError("--interpolate is for --against: a mesh is solved at the angles of the export");
  const std::vector<FieldTable> tables = read_and_report(arguments.exports);
  if (!arguments.rcs.export_as.empty() && !arguments.against.empty())
    throw InputError("--export-as is for --target: it writes the solved values");
  const Counterpart counterpart = counterpart_of(arguments, tables);
  require_results(arguments);

  const ComparisonSettings settings{arguments.exports.floor_db, arguments.as_is, arguments.interpolation_radius_m};
  TargetSolutions solutions{context.threads, context.stop, say};
  std::vector<ExportComparison> comparisons;
  for (const FieldTable& table : tables) {
    comparisons.push_back(
        counterpart.table ? compare_with_table(table, *counterpart.table, settings, context.threads)
                          : compare_with_target(table, counterpart.request, *counterpart.target, settings, solutions));
  }
  check_reciprocity(comparisons);
  require_comparison(comparisons);
  const std::filesystem::path directory = arguments.directory;
  write_file(directory / "compare.csv", comparison_csv(comparisons, context.threads));
  const ComparisonFigures figures = draw(comparisons, settings, counterpart, context, directory);
  write_file(directory / "compare.html", comparison_page(comparisons, settings, figures));
  write_file(directory / "compare.json", comparison_json(comparisons, settings));
  const std::vector<std::filesystem::path> solved = write_solved(comparisons, arguments);
  print_out("{}", comparison_table(comparisons, settings));
  for (const std::filesystem::path& file : solved) print_out("Solved values: {}\n", file.string());
  print_out("Results: {}; all figures in compare.json, every pair in compare.csv\n",
            (directory / "compare.html").string());
  const std::vector<std::string> failed = failures(comparisons, arguments);
  if (failed.empty()) return;
  for (const std::string& sentence : failed) say(sentence);
  throw WorkError(fmt::format("{} of the comparisons fail{}", failed.size(), failed.size() == 1 ? "s" : ""));
}

}  // namespace

std::vector<FieldTable> read_and_report(const ReferenceArguments& files) {
  ReferenceTables references = files.read();
  for (const std::string& folder : references.folders) say(folder);
  for (const FieldTable& table : references.tables) say(reading_of(table));
  return std::move(references.tables);
}

void add_compare(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "compare", "Compare exports of CST, FEKO, HFSS and measurements with this solver or with each other");
  auto arguments = std::make_shared<CompareArguments>();
  command
      .add_option("EXPORT", arguments->exports.files,
                  "Files with the radar cross section or scattered field, or folders of them")
      .repeatable("FILE")
      .required();
  arguments->rcs.add_target_to(command);
  command.add_option("--against", arguments->against, "Another such file or folder, instead of a mesh");
  command
      .add_option(
          "--interpolate", arguments->interpolation_radius_m,
          "Interpolate the values of --against at the angles of EXPORT, for a target within this many metres of "
          "its phase origin; the error is estimated, places above -26 dB are omitted")
      .number_within(1e-3, 1e4);
  arguments->rcs.add_detail_to(command);
  arguments->exports.add_properties_to(command);
  command.add_flag("--uncertainty", arguments->rcs.request.uncertainty,
                   "Also solve with all facets flat: the area between both in the figure");
  arguments->rcs.add_export_as_to(command);
  command.add_flag("--as-is", arguments->as_is,
                   "Fit no constant phase, phase origin, conjugation and signs before the complex correlation");
  command.add_option("--tolerance-db", arguments->tolerance_db, "Exit code 1 if a mean difference is over this")
      .number_within(0.0, 1000.0);
  command.add_option("--min-correlation", arguments->min_correlation, "Exit code 1 if a correlation is under this")
      .number_within(0.0, 1.0);
  command.add_option("-o,--output", arguments->directory, "Directory for the results").required();
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint compare 'rcs (f=9.5), theta=(85,85,1), phi=(0,180,1), VP.txt' --target ship.stl -o "
      "compared\n"
      "  seaglint compare VV_ship.json -o compared\n"
      "  seaglint compare ship.ffe --against chamber.csv --reference-polarisation vv --tolerance-db 2 -o compared");
  command.callback(
      [arguments, &context] { context.work = [arguments, &context] { run_compare(*arguments, context); }; });
}

}  // namespace seaglint
