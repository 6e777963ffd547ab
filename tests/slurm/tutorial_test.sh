#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The tutorial of a study over sea states, on a Slurm of its own. Arguments: program, source folder. Exit code 77: skipped.
set -euo pipefail
program=$(realpath "$1")
source=$(realpath "$2")
source "$source/tests/slurm/cluster.sh"

cd "$work"
start_slurm
SEAGLINT_TUTORIAL_FOLDER=$work /usr/bin/python3 "$source/tests/manual/tutorial_test.py" "$program" "$source" sea_states
