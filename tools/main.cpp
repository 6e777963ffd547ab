// SPDX-License-Identifier: BSD-3-Clause
// The program: exits with 0 (done), 1 (the work failed) or 2 (the input is wrong); 1 and 2 with the reason as one line
// on stderr.
#include "sim/core/process/out_of_memory.h"
#include "tools/cli/command_line.h"

namespace {

// The linker's table of functions that run before the constructors of all libraries, of which some need memory.
using Initialiser = void (*)();
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser before_libraries = &seaglint::report_uncaught_bad_alloc;

}  // namespace

int main(int argc, char** argv) { return seaglint::run_command_line(argc, argv); }
