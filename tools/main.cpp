// SPDX-License-Identifier: BSD-3-Clause
// The program: exits with 0, 1 (the work failed) or 2 (the input is wrong), with one line on stderr that says why.
#include "tools/cli/command_line.h"

int main(int argc, char** argv) { return seaglint::run_command_line(argc, argv); }
