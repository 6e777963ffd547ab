#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""tutorial_test.py SEAGLINT SOURCE TUTORIAL...: runs tutorials as they stand, each in an empty folder, with the program on PATH, the Python package
beside it and tools/slurm below the folder. Exit code 77: scripts were left out for lack of a package of Debian."""
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True


def main(seaglint, source, *names):
    source = pathlib.Path(source).resolve()
    sys.path.insert(0, str(source / "tools/python"))
    import tutorial
    check_patterns(tutorial)
    environment = tutorial.environment_with(pathlib.Path(seaglint).resolve())
    lacking = set()
    for name in names:
        with tempfile.TemporaryDirectory(dir=os.environ.get("SEAGLINT_TUTORIAL_FOLDER")) as folder:
            folder = pathlib.Path(folder)
            folder.chmod(0o755)
            (folder / "tools").mkdir()
            (folder / "tools/slurm").symlink_to(source / "tools/slurm")
            lacking |= tutorial.run(source / f"tools/tutorials/{name}.md", source, folder, environment)
    if lacking:
        print(f"skipped: no modules {', '.join(sorted(lacking))} (packages python3-NAME)")
        sys.exit(77)


def check_patterns(tutorial):
    """What the tests below rely on: other output, another exit code and a changed option are found."""
    as_printed = tutorial.as_printed
    assert as_printed(["a", "...", "d"], "a\nb\nc\nd\n") and as_printed(["a", "...", "d"], "a\nd\n")
    assert as_printed(["made in ... s"], "made in 3.1 s\n") and not as_printed(["made in ... s"], "made in 3.1 m\n")
    assert not as_printed(["a"], "a\nb\n") and not as_printed([], "warning\n") and not as_printed(["a.c"], "abc\n")
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "t.md"
        for block in ("$ echo a\nb", "$ false", "$ ls --no-such-option\n..."):
            file.write_text(f"```console\n{block}\n```\n", encoding="utf-8")
            try:
                tutorial.run(file, None, pathlib.Path(folder), os.environ)
            except AssertionError:
                continue
            raise SystemExit(f"{block!r} was not found to fail")
        file.write_text("```python a.py\nimport os, no_such_module.x\n```\n```python b.py\nimport a\n```\n```console\n$ python3 b.py\n$ echo whole\nwhole\n```\n", encoding="utf-8")
        assert tutorial.run(file, None, pathlib.Path(folder), os.environ) == {"no_such_module"}
        file.write_text("```python a.py\nfor\n```\n", encoding="utf-8")
        try:
            tutorial.run(file, None, pathlib.Path(folder), os.environ)
        except SyntaxError:
            return
        raise SystemExit("a script that is no Python was not found")


main(*sys.argv[1:])
