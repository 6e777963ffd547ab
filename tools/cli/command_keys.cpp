// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/core/process/error.h"
#include "sim/core/process/standard_output.h"
#include "sim/scenario/key_list.h"
#include "sim/scenario/key_meanings.h"
#include "tools/cli/command.h"

namespace seaglint {
namespace {

struct KeysArguments {
  std::string of;
  bool json = false;
};

std::string keys_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const KeyEntry& entry : scenario_keys()) {
    list.push_back({{"key", entry.key},
                    {"default", entry.standard},
                    {"allowed", entry.allowed},
                    {"meaning", std::string(meaning_of(entry.key))}});
  }
  return list.dump(1) + "\n";
}

void run_keys(const KeysArguments& arguments) {
  if (arguments.json && !arguments.of.empty())
    throw InputError("--json lists all keys: it is used without a key or section");
  print_out("{}", arguments.json ? keys_json() : list_keys(arguments.of));
}

}  // namespace

void add_keys(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("keys", "List every key of a scenario file with its default and what it allows");
  auto arguments = std::make_shared<KeysArguments>();
  command.add_option("KEY", arguments->of, "Only this key or section, with what it means");
  command.add_flag("--json", arguments->json, "All keys with their meanings as JSON");
  command.footer("Example:\n  seaglint keys sea.gamma");
  command.callback([arguments, &context] { context.work = [arguments] { run_keys(*arguments); }; });
}

}  // namespace seaglint
