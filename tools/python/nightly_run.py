# SPDX-License-Identifier: BSD-3-Clause
"""Runs steps one after the other, each with a log and a time limit, and writes the page of tools/nightly."""
import argparse
import dataclasses
import datetime
import fcntl
import fnmatch
import html
import os
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time

from figure_tables import ROOT, commit_name

GRACE_S = 20  # between SIGTERM and SIGKILL of a step
TAIL_LINES, TAIL_BYTES, LINE_CHARACTERS = 40, 64 * 1024, 400

interrupted = threading.Event()  # by SIGINT or SIGTERM

STYLE = """body { font: 15px/1.4 sans-serif; margin: 2em; max-width: 75em }
td, th { text-align: left; padding: .2em 1em .2em 0; vertical-align: top } td.time { text-align: right }
.passed { color: #060 } .failed { color: #a00; font-weight: bold } .other { color: #555 }
pre { background: #f4f4f4; padding: .8em; overflow-x: auto }"""


@dataclasses.dataclass
class Step:
    """A command from the root of the clone, its limit in minutes and, once it has run, its result."""
    name: str
    minutes: float
    command: tuple
    about: str
    by_default: bool = True
    result: str = "waiting"
    seconds: float = 0.0

    @property
    def failed(self):
        return self.result not in ("waiting", "running", "passed", "no time left")


def end(process):
    """Ends a step with all processes of its group."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, number)
        except ProcessLookupError:
            pass
        try:
            process.wait(GRACE_S)
        except subprocess.TimeoutExpired:
            continue


def run_step(step, log, seconds):
    """Runs a step for at most so many seconds or until a signal, its output into the log; sets result and time."""
    start = time.monotonic()
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(step.command, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=output,
                                       stderr=output, start_new_session=True)
        except OSError as error:
            output.write(f"{error}\n".encode())
            step.result = "not started"
            return
    while process.poll() is None and not interrupted.is_set() and time.monotonic() - start < seconds:
        interrupted.wait(0.02 if time.monotonic() - start < 2 else 0.5)
    code = process.poll()
    if code is None:
        end(process)
        step.result = "interrupted" if interrupted.is_set() else f"ended after {duration(seconds)}"
    else:
        step.result = "passed" if code == 0 else f"exit code {code}" if code > 0 else f"signal {-code}"
    step.seconds = time.monotonic() - start


def duration(seconds):
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02}:{whole % 60:02}"


def tail(log):
    """The last lines of a log as printable text."""
    try:
        with log.open("rb") as file:
            file.seek(max(log.stat().st_size - TAIL_BYTES, 0))
            text = file.read().decode("utf-8", "replace")
    except OSError:
        return []
    lines = [line.rsplit("\r", 1)[-1].expandtabs() for line in text.rstrip().split("\n")]
    return ["".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in line)[:LINE_CHARACTERS]
            for line in lines[-TAIL_LINES:]]


def log_of(folder, step):
    return folder / f"{step.name}.log"


def row(step, folder):
    kind = "failed" if step.failed else "passed" if step.result == "passed" else "other"
    ran = log_of(folder, step).is_file()
    link = f'<a href="{html.escape(step.name)}.log">log</a>' if ran else ""
    last = tail(log_of(folder, step))[-1:] if ran else []
    cells = (f"<td>{html.escape(step.name)}</td><td>{html.escape(step.about)}</td>",
             f'<td class="time">{duration(step.seconds) if ran else ""}</td>',
             f'<td class="{kind}">{html.escape(step.result)}</td><td>{link}</td>',
             f"<td><code>{html.escape(''.join(last)[:120])}</code></td>")
    return f"<tr>{''.join(cells)}</tr>"


def write_page(steps, folder, heading):
    """index.html: a table of all steps and the ends of the logs of those that failed."""
    parts = ["<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8"><title>seaglint: nightly run</title>',
             f"<style>{STYLE}</style></head><body>", f"<h1>Nightly run</h1><p>{html.escape(heading)}</p>",
             f"<p>{html.escape(summary(steps))}</p>",
             "<table><tr><th>step</th><th>content</th><th>time</th><th>result</th><th></th><th>last line</th></tr>",
             *(row(step, folder) for step in steps), "</table>"]
    for step in (step for step in steps if step.failed):
        text = "\n".join(tail(log_of(folder, step)))
        parts.append(f"<h2>{html.escape(step.name)}: {html.escape(step.result)}</h2>"
                     f"<p><code>{html.escape(' '.join(step.command))}</code></p><pre>{html.escape(text)}</pre>")
    parts.append("</body></html>\n")
    partial = folder / "index.html.part"
    partial.write_text("\n".join(parts), encoding="utf-8")
    partial.replace(folder / "index.html")


def summary(steps):
    passed = sum(step.result == "passed" for step in steps)
    return (f"{passed} of {len(steps)} steps passed, {sum(step.failed for step in steps)} failed, "
            f"{sum(step.result == 'no time left' for step in steps)} left out, in "
            f"{duration(sum(step.seconds for step in steps))}.")


def run_night(steps, folder, hours):
    """Runs all steps; whether all of them passed. The page is written anew after each."""
    start = time.monotonic()
    heading = (f"Commit {commit_name()}, begun {datetime.datetime.now().astimezone().isoformat(' ', 'minutes')}, "
               f"{os.cpu_count()} processors.")
    for log in folder.glob("*.log"):
        log.unlink()
    for step in steps:
        left = 3600 * hours - (time.monotonic() - start)
        step.result = "running" if left > 0 else "no time left"
        write_page(steps, folder, heading)
        if left > 0:
            print(f"{step.name}: {step.about} ...", flush=True)
            run_step(step, log_of(folder, step), min(60 * step.minutes, left))
            print(f"    {step.result}, {duration(step.seconds)}", flush=True)
        if interrupted.is_set():
            break
    write_page(steps, folder, heading)
    print(summary(steps))
    return all(step.result == "passed" for step in steps)


def parse_arguments(words, description):
    parser = argparse.ArgumentParser(prog="tools/nightly", description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", metavar="STEP", action="append", help="this step; * stands for any text; repeatable")
    parser.add_argument("--list", action="store_true", help="print the steps with their limits")
    parser.add_argument("--hours", type=float, default=10.0, help="for all steps together; default 10")
    arguments = parser.parse_args(words)
    if not 0 < arguments.hours <= 10:
        parser.error("--hours is above 0 and at most 10")
    return arguments


def chosen(steps, patterns):
    """The steps of a usual night, or those that the patterns name; an unknown pattern is an error."""
    if patterns is None:
        return [step for step in steps if step.by_default]
    for pattern in patterns:
        if not any(fnmatch.fnmatchcase(step.name, pattern) for step in steps):
            raise ValueError(f"--only {pattern}: no such step; see --list")
    return [step for step in steps if any(fnmatch.fnmatchcase(step.name, pattern) for pattern in patterns)]


def main(words, description, make_steps, folder):
    """The exit code: 0 all passed, 1 a step failed or was left out, 2 wrong input, 130 interrupted."""
    arguments = parse_arguments(words, description)
    try:
        every = make_steps()
        if arguments.list:
            for step in every:
                print(f"{step.name:<16} {step.minutes:>4g} min  {step.about}"
                      f"{'' if step.by_default else ' (tonight with --only)'}")
            return 0
        steps = chosen(every, arguments.only)
        folder = pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        with (folder / "lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            for number in (signal.SIGINT, signal.SIGTERM):
                signal.signal(number, lambda *_: interrupted.set())
            passed = run_night(steps, folder, arguments.hours)
        print(f"Page: {folder / 'index.html'}")
        return 130 if interrupted.is_set() else 0 if passed else 1
    except BlockingIOError:
        print(f"tools/nightly: another one is running in {folder}", file=sys.stderr)
        return 1
    except ValueError as error:
        print(f"tools/nightly: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"tools/nightly: {error}", file=sys.stderr)
        return 1
