// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace seaglint {

// Parses a command line and runs its command. Returns the exit code: 0 (done), 1 (the work failed) or 2 (the input is
// wrong); 1 and 2 with the reason as one line on stderr.
int run_command_line(int argc, char** argv);

}  // namespace seaglint
