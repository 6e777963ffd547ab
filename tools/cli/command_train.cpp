// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "classify/model/study_text.h"
#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "tools/cli/arguments.h"
#include "tools/cli/command.h"
#include "tools/pipeline/train.h"

namespace seaglint {

namespace {

struct Arguments {
  std::vector<std::string> data;
  std::string by;
  std::vector<std::string> hold_out;
  std::string model;
  std::vector<std::string> set;
};

// Only keys of learning and split may be overridden: the maps exist already.
std::vector<Override> learning_overrides(const std::vector<std::string>& set) {
  std::vector<Override> overrides = read_overrides(set);
  for (const Override& entry : overrides) {
    if (!entry.key_path.starts_with("learning.") && entry.key_path != "dataset.split") {
      throw InputError(
          fmt::format("--set {}: train takes learning.* and dataset.split only; the data set is made", entry.key_path));
    }
  }
  return overrides;
}

DivisionOptions division_options(const Arguments& arguments) {
  DivisionOptions options;
  if (!arguments.by.empty()) options.by = arguments.by;
  for (const std::string& text : arguments.hold_out) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(fmt::format("--hold-out {}: must be COLUMN=VALUE or COLUMN=LOW:HIGH", text));
    const std::string column = text.substr(0, equals);
    auto held = std::ranges::find(options.hold_out, column, &HoldOutSpec::column);
    if (held == options.hold_out.end()) held = options.hold_out.insert(held, {column, {}});
    held->values.push_back(text.substr(equals + 1));
  }
  return options;
}

}  // namespace

void add_train(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("train", "Train network and trees on a data set and evaluate them on unseen maps and seas");
  auto arguments = std::make_shared<Arguments>();
  command
      .add_option("DIR", arguments->data,
                  "Data sets made by `seaglint generate` or `seaglint run`; learning, split and seed are those of the "
                  "first one's scenario")
      .required()
      .repeatable("DIR");
  command.add_option("-o,--output", arguments->model, "Directory of the model").required();
  command.add_option("--set", arguments->set, "Replace a value of the data set's scenario (repeatable)")
      .repeatable("learning.KEY=VALUE");
  command.add_option("--by", arguments->by,
                     "Column whose values are on one side of the split each, in place of learning.split.by: any column "
                     "of the samples, sea, or data_set (numbered from 0)");
  command
      .add_option("--hold-out", arguments->hold_out,
                  "Values that are tested only and never trained on, for the classes that have them; LOW:HIGH for an "
                  "interval (repeatable: any of one column's values, all columns); in place of "
                  "learning.split.hold_out")
      .repeatable("COLUMN=VALUE");
  add_threads_option(command, context);
  command.footer(
      "Example:\n  seaglint train build/points -o build/points-model --set learning.epochs=40\n"
      "  seaglint train build/a build/b -o build/model --hold-out data_set=1");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      std::vector<std::filesystem::path> data_sets;
      for (const std::string& data : arguments->data) data_sets.push_back(find_data_set(data));
      const TrainedModel model = train_model(data_sets, arguments->model, learning_overrides(arguments->set),
                                             division_options(*arguments), context.threads, &context.stop);
      print_out("{}\n{}: network, trees and {}\n", accuracy_table(model.study), arguments->model, kMetricsFile);
    };
  });
}

}  // namespace seaglint
