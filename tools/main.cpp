// SPDX-License-Identifier: BSD-3-Clause
// The program: exits with 0 (done), 1 (the work failed) or 2 (the input is wrong); 1 and 2 with the reason as one line
// on stderr.
#include "tools/cli/command_line.h"

int main(int argc, char** argv) { return seaglint::run_command_line(argc, argv); }
