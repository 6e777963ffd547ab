#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The installed program from an empty folder, its manual page and completion, and a program of a user that links the
# installed libraries. Arguments: build folder, source folder.
set -euo pipefail
build=$(realpath "$1")
source=$(realpath "$2")
work=$(mktemp -d -t seaglint_install_XXXXXX)
trap 'rm -rf "$work"' EXIT

fail() { echo "install_test: $*" >&2; exit 1; }
# has TEXT PART: the text contains the part.
has() { [[ $1 == *"$2"* ]] || fail "'$2' is not in: $1"; }

DESTDIR="$work/system" cmake --install "$build" --prefix /usr >/dev/null
prefix=$work/system/usr
mkdir "$work/empty"
cd "$work/empty"
seaglint=$prefix/bin/seaglint

has "$("$seaglint" paths)" "3. the data of the program   $prefix/share/seaglint"
has "$("$seaglint" check quick.yaml 2>&1)" "300 maps"
has "$("$seaglint" check nowhere.yaml 2>&1 || true)" "neither in the working directory nor in $prefix/share/seaglint nor in $prefix/share/seaglint/scenarios"
"$seaglint" run points.yaml -o x --set learning.epochs=1 >/dev/null 2>&1 || fail "run ends with $?"
[[ -s x/report.html ]] || fail "no report"
"$seaglint" rcs --target assets/icosahedral_reflector.glb --material aluminium --frequency-ghz 10 --azimuth-deg 0 -o r.csv 2>/dev/null
[[ $(ls) == $'r.csv\nx' ]] || fail "other files: $(ls)"

# Every command stands in the manual page.
[[ -f $prefix/share/doc/seaglint/html/index.html ]] || fail "no manual"
man_page=$prefix/share/man/man1/seaglint.1
commands=$("$seaglint" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z]*\) .*/\1/p')
for command in $commands; do grep -qw "$command" "$man_page" || fail "$command is not in the manual page"; done

# complete WORD...: what the completion offers for the last word.
complete_words() {
  bash -c 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _seaglint; printf "%s\n" "${COMPREPLY[@]}"' \
    complete "$prefix/share/bash-completion/completions/seaglint" "$seaglint" "$@"
}
[[ $(complete_words com) == compare ]] || fail "completion of com: $(complete_words com)"
[[ $(complete_words rcs --max-b) == --max-bounces ]] || fail "completion of an option: $(complete_words rcs --max-b)"
[[ $(complete_words rcs --edges o | sort | tr '\n' ' ') == "off on " ]] || fail "completion of a value: $(complete_words rcs --edges o)"
[[ $(complete_words rcs --method r) == rays ]] || fail "completion of a method: $(complete_words rcs --method r)"
[[ $(complete_words mesh sens) == sensitivity ]] || fail "completion below mesh: $(complete_words mesh sens)"

# The Python package with the installed data.
has "$(PYTHONPATH=$prefix/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c 'import seaglint; print(seaglint.data_folder(), seaglint.Scenario("quick.yaml"))')" \
  "$prefix/share/seaglint <seaglint.Scenario quick: 300 samples>"
has "$(PYTHONPATH=$prefix/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c 'import seaglint; print(seaglint.train("x", "trained", epochs=1)["scenario"])')" points
for example in rcs_sweep train_on_maps; do [[ -s $prefix/share/seaglint/examples/$example.py ]] || fail "no example $example.py"; done

# A program of a user; the launcher is taken from the environment as for the project itself.
cmake -S "$source/tests/install/consumer" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >"$work/log" 2>&1 &&
  cmake --build "$work/consumer" >>"$work/log" 2>&1 || { tail -30 "$work/log"; fail "the user's program is not built"; }
peak=$("$work/consumer/map_of_points")
# The point is put at 30 m and 2 m/s; an eighth of the resolution of 0.75 m and 0.15 m/s for clutter of -20 dB.
awk -F'[ ,]+' '{ exit !(($1 - 30) ^ 2 < 0.094 ^ 2 && ($3 - 2) ^ 2 < 0.018 ^ 2) }' <<<"$peak" || fail "the peak of the user's map is at $peak"
echo "peak of the user's map: $peak"

# What was installed is all that is removed.
xargs -a "$build/install_manifest.txt" -I{} rm -f "$work/system{}"
left=$(find "$work/system" -type f | head)
[[ -z $left ]] || fail "files left: $left"
