#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Whether clang-format would change any source file. Argument: source folder. Exit code 77: skipped.
set -euo pipefail
command -v clang-format >/dev/null || { echo "skipped: clang-format is missing (package clang-format)"; exit 77; }
cd "$1"
find sim radar classify tests tools \( -name '*.cpp' -o -name '*.h' \) -print0 |
  xargs -0 -P 2 -n 50 clang-format --dry-run --Werror
