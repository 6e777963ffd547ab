# SPDX-License-Identifier: BSD-3-Clause
"""The steps of tools/nightly, in their order: where the hours do not suffice, the last ones are left out.

gcc and clang take turns by the date, as the sanitizers of both do not fit into one night, and each night begins with
another fuzz target.
"""
import datetime
import re

from figure_tables import ROOT
from nightly_run import Step

FUZZ_SECONDS = 600


def day():
    return datetime.date.today().toordinal()


def shell(script):
    return ("bash", "-euo", "pipefail", "-c", script)


def built(preset, then=""):
    return shell(f"cmake --preset {preset} && cmake --build --preset {preset} -- -k 0{then}")


def tested(preset):
    return built(preset, f' && ctest --preset {preset} -j "$(nproc)"')


def fuzz_steps():
    """A step for each target of tools/fuzz; one that fails if there is none."""
    table = ROOT / "tests/fuzz/targets.txt"
    lines = table.read_text().splitlines() if table.is_file() else []
    targets = re.findall(r"^([A-Za-z0-9_]+)\b", "\n".join(lines), re.MULTILINE)
    first = day() % max(len(targets), 1)
    targets = targets[first:] + targets[:first]
    if not targets:
        return [Step("fuzz", 5, shell("echo tests/fuzz/targets.txt names no target; exit 1"), "targets of tests/fuzz/targets.txt, of which none is found")]
    # The first one builds the libraries.
    return [Step(f"fuzz-{name}", FUZZ_SECONDS // 60 + (40 if name == targets[0] else 5),
                 ("tools/fuzz", name, str(FUZZ_SECONDS)), f"fuzzing of {name} for {FUZZ_SECONDS // 60} minutes")
            for name in targets]


def all_steps():
    """Names, limits in minutes, commands from the root of the clone."""
    odd = day() % 2 == 1
    return [
        Step("packages", 20, shell("source tools/setup.sh && install_packages build test full nightly fuzz"),
             "packages that are missing"),
        Step("check", 60, ("tools/check",), "build/release and all tests"),
        Step("dev-clang", 45, built("dev-clang"), "warnings of clang are errors"),
        Step("sanitize-clang", 240, tested("sanitize-clang"), "address and undefined-behaviour sanitizers, clang",
             by_default=odd),
        Step("sanitize", 240, tested("sanitize"), "address and undefined-behaviour sanitizers, gcc",
             by_default=not odd),
        Step("thread", 240, tested("thread"), "thread sanitizer, gcc", by_default=odd),
        Step("thread-clang", 240, tested("thread-clang"), "thread sanitizer, clang", by_default=not odd),
        Step("faults", 120, ("tools/faults", "1000", "100"), "1,000 injected faults, 100 kills"),
        Step("accuracy", 40, ("tools/measure", "accuracy", "--check"), "every accuracy figure and tools/validation"),
        Step("speed", 30, ("tools/measure", "speed", "--check", "--tolerance", "0.3"),
             "benchmarks within 30 % of the records"),
        Step("clean-root", 30, ("tests/install/clean_root_test.sh", "build/release"), "the Debian package on a system of its own"),
        Step("pip", 60, ("tests/install/pip_test.sh",), "the Python package by pip in a virtual environment"),
        Step("tidy", 120, built("tidy"), "clang-tidy on every file"),
        Step("dev", 45, built("dev"), "warnings of gcc are errors"),
        Step("definitions", 30, built("definitions"), "one definition of every type"),
        *fuzz_steps(),
        Step("tidy-clang", 120, built("tidy-clang"), "clang-tidy on what clang compiles", by_default=False),
        Step("sweep", 600, ("tools/measure", "sweep"), "two ships every 0.05 deg, nine hours", by_default=False),
    ]
