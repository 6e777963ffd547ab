// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "sim/core/process/standard_output.h"
#include "sim/scenario/key_list.h"
#include "tools/cli/command.h"

namespace seaglint {

void add_keys(CommandOptions& program, CommandContext& context) {
  CommandOptions command =
      program.add_command("keys", "List every key of a scenario file with its default and what it allows");
  command.footer("Example:\n  seaglint keys");
  command.callback([&context] { context.work = [] { print_out("{}", list_keys()); }; });
}

}  // namespace seaglint
