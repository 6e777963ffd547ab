// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command.h"

#include <CLI/CLI.hpp>

namespace seaglint {

void add_threads_option(CLI::App& command, Shell& shell) {
  command.add_option("--threads", shell.threads, "Number of threads; 0 = all processors")->check(CLI::Range(0, 1024));
}

}  // namespace seaglint
