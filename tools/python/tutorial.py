# SPDX-License-Identifier: BSD-3-Clause
"""Tutorials of the manual: Markdown whose commands can be run.

A block ```console has commands behind `$ ` with what they print; `...` stands for any text, or, alone on a line, for any
lines, none included. A line `[exit code N]` ends the output of a command that fails. A block ```yaml NAME is the file
NAME; a comment <!-- copy FILE... --> copies files of the source tree, names with spaces in quotes. Standard output and
standard error are checked together, in the order of lines within each. A script ```python NAME.py is compiled; commands
that run it are left out where a module that it imports is not installed.
"""
import ast
import dataclasses
import importlib.util
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time


@dataclasses.dataclass
class Step:
    kind: str  # "file", "copy", "command"
    name: str  # of the file, the files, the command
    lines: list  # content of the file, expected lines of the command
    code: int = 0
    line: int = 0  # in the Markdown


FENCE = re.compile(r"^```(?P<language>\w+)?(?: (?P<name>\S+))?$")
EXIT_CODE = re.compile(r"^\[exit code (\d+)\]$")


def steps(text):
    """The files and commands of a tutorial, in order."""
    found, block = [], None
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if fence and block is None:
            block = fence["language"]
            if fence["name"]:
                found.append(Step("file", fence["name"], [], line=number))
        elif line == "```":
            block = None
        elif block == "console" and line.startswith("$ "):
            found.append(Step("command", line[2:], [], line=number))
        elif block == "console" and (code := EXIT_CODE.match(line)):
            found[-1].code = int(code[1])
        elif block == "console" or (block is not None and found and found[-1].kind == "file"):
            found[-1].lines.append(line)
        elif copied := re.match(r"^<!-- copy (.*) -->$", line):
            found.append(Step("copy", copied[1], [], line=number))
    return found


def pattern(lines):
    """The regular expression of expected lines."""
    parts = ["(?:.*\n)*?" if line == "..." else re.escape(line).replace(re.escape("..."), ".*") + "\n" for line in lines]
    return re.compile("".join(parts))


def as_printed(lines, printed):
    """Whether the lines that a command printed are those that are expected. Lines are compared without spaces at their end."""
    text = "".join(line.rstrip() + "\n" for line in printed.splitlines())
    return pattern([line.rstrip() for line in lines]).fullmatch(text) is not None


def missing_modules(script, folder, scripts):
    """Modules that a script imports, itself or by an earlier one of `scripts`, and that are not installed."""
    missing = set()
    for node in ast.walk(ast.parse((folder / script).read_text(encoding="utf-8"), script)):
        names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else [node.module] if isinstance(node, ast.ImportFrom) else []
        for name in (name.split(".")[0] for name in names):
            if f"{name}.py" in scripts:
                missing |= scripts[f"{name}.py"]
            elif importlib.util.find_spec(name) is None:
                missing.add(name)
    return missing


def environment_with(program):
    """The environment of commands that find a program and the Python package beside it, which this process then finds, too."""
    python = str(program.parent / "python")
    sys.path.insert(0, python)
    return dict(os.environ, PATH=f"{program.parent}:/usr/bin:{os.environ['PATH']}", PYTHONPATH=python, PYTHONDONTWRITEBYTECODE="1")


def pictures(tutorial, folder):
    """The pictures of a tutorial that its commands have written: (file in the source tree, file in the folder)."""
    names = re.findall(r"!\[[^]]*\]\(([^)]+)\)", tutorial.read_text(encoding="utf-8"))
    files = [(tutorial.parent / name).resolve() for name in names]
    return [(file, folder / file.name) for file in files if (folder / file.name).exists()]


def run(tutorial, source, folder, environment, seconds=None):
    """Runs a tutorial in an empty folder; returns the modules for lack of which commands were left out. Raises AssertionError
    with file, line, and both outputs, SyntaxError of a script. `environment` has the search path of this process's modules. `seconds`, if given, gets
    those of every command, by its line."""
    scripts, lacking = {}, set()  # name -> missing modules; of scripts that commands would have run
    for step in steps(tutorial.read_text(encoding="utf-8")):
        where = f"{tutorial.name}:{step.line}"
        if step.kind == "file":
            (folder / step.name).write_text("\n".join(step.lines) + "\n", encoding="utf-8")
            if step.name.endswith(".py"):
                scripts[step.name] = missing_modules(step.name, folder, scripts)
        elif step.kind == "copy":
            for name in shlex.split(step.name):
                shutil.copy(source / name, folder / pathlib.Path(name).name)
        elif missing := set().union(*(scripts.get(word, ()) for word in step.name.split())):
            print(f"{where}: {step.name}: left out without {', '.join(sorted(missing))}", flush=True)
            lacking |= missing
        else:
            print(f"{where}: {step.name}", flush=True)
            start = time.monotonic()
            result = subprocess.run(["bash", "-c", step.name], cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
            if seconds is not None:
                seconds[step.line] = time.monotonic() - start
            assert result.returncode == step.code, f"{where}: {step.name}\nexit code {result.returncode} in place of {step.code}\n{result.stdout}{result.stderr}"
            outputs = (result.stdout, result.stderr, result.stdout + result.stderr, result.stderr + result.stdout)
            assert any(as_printed(step.lines, printed) for printed in outputs), (
                f"{where}: {step.name}\nexpected\n" + "\n".join(step.lines) + f"\nprinted\n{result.stdout}\non standard error\n{result.stderr}")
    return lacking
