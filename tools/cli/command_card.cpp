// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "classify/dataset/cards/cards.h"
#include "classify/dataset/cards/croissant.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/directory/file_names.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace {

struct CardArguments {
  std::string directory;
  Publication publication;
};

void make_cards(const CardArguments& arguments, const StopFlag& stop) {
  const DatasetReader reader(find_data_set(arguments.directory));
  warn(data_set_warnings(reader));
  write_cards(reader, arguments.publication, &stop);
  const auto file = [&](const char* name) { return (reader.directory() / name).string(); };
  print_out("{}: data card of {} samples\n{}: Croissant 1.0\n{}: columns of all samples\n", file(kDataCardFile),
            reader.size(), file(kCroissantFile), file(kColumnsFile));
  const std::vector<std::string> missing = missing_properties(arguments.publication);
  if (!missing.empty())
    warn(
        std::vector{fmt::format("{}: Croissant requires {} too; --licence, --url, --creator or --organisation, --date "
                                "give them",
                                kCroissantFile, fmt::join(missing, ", "))});
}

}  // namespace

void add_card(CommandOptions& program, CommandContext& context) {
  CommandOptions command = program.add_command(
      "card", "Files with which a data set is handed to others: README.md (Hugging Face), croissant.json, columns.csv");
  auto arguments = std::make_shared<CardArguments>();
  Publication& publication = arguments->publication;
  command.add_option("directory", arguments->directory, "Directory of the data set, or of a run").required();
  command.add_option("--name", publication.name, "Title; the scenario's name unless given").check(name_problem);
  command
      .add_option("--licence,--license", publication.licence,
                  "Licence of the data: identifier of the SPDX list (CC-BY-4.0), LicenseRef-NAME, or a URL")
      .check(licence_problem);
  command.add_option("--creator", publication.creators, "Person who made the data set; repeatable")
      .repeatable("NAME")
      .check(name_problem);
  command.add_option("--organisation", publication.organisations, "Organisation that made it; repeatable")
      .repeatable("NAME")
      .check(name_problem);
  command.add_option("--url", publication.url, "Page of the data set").check(url_problem);
  command.add_option("--date", publication.date, "Date of publication, YYYY-MM-DD").check(date_problem);
  command.add_option("--data-version", publication.version, "Version of the data set, MAJOR.MINOR.PATCH")
      .check(version_problem);
  command.footer(
      "What is not given is left out. Existing cards are replaced unless they were changed by hand.\n\nExample:\n"
      "  seaglint card build/points/data --licence CC-BY-4.0 --organisation \"Radar Laboratory\" --date 2026-05-01");
  command.callback(
      [arguments, &context] { context.work = [arguments, &context] { make_cards(*arguments, context.stop); }; });
}

}  // namespace seaglint
