// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

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
  std::string data;
  std::string model;
  std::vector<std::string> set;
};

// Only keys of learning and split may be overridden: the maps exist already.
std::vector<Override> learning_overrides(const std::vector<std::string>& set) {
  const std::vector<Override> overrides = read_overrides(set);
  for (const Override& entry : overrides) {
    if (!entry.key_path.starts_with("learning.") && entry.key_path != "dataset.split") {
      throw InputError(
          fmt::format("--set {}: train takes learning.* and dataset.split only; the data set is made", entry.key_path));
    }
  }
  return overrides;
}

}  // namespace

void add_train(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("train", "Train network and trees on a data set and evaluate them on unseen maps and seas");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("DIR", arguments->data, "Data set made by `seaglint generate` or `seaglint run`").required();
  command.add_option("-o,--output", arguments->model, "Directory of the model").required();
  command.add_option("--set", arguments->set, "Replace a value of the data set's scenario (repeatable)")
      .repeatable("learning.KEY=VALUE");
  add_threads_option(command, context);
  command.footer("Example:\n  seaglint train build/points -o build/points-model --set learning.epochs=40");
  command.callback([arguments, &context] {
    context.work = [arguments, &context] {
      const TrainedModel model = train_model(find_data_set(arguments->data), arguments->model,
                                             learning_overrides(arguments->set), context.threads, &context.stop);
      print_out("{}\n{}: network, trees and {}\n", accuracy_table(model.study), arguments->model, kMetricsFile);
    };
  });
}

}  // namespace seaglint
