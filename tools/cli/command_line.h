// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seaglint {

// Runs the command that the words of a command line choose. Returns the exit code: 0, 1 (the work failed) or 2 (the
// input is wrong), then with one line on stderr that says why.
int run_command_line(int argc, char** argv);

}  // namespace seaglint
