# SPDX-License-Identifier: BSD-3-Clause
"""The program that the package is compared with."""
import csv
import os
import signal
import subprocess
import sys
import time

PROGRAM = os.environ["SEAGLINT"]
REFLECTOR = "assets/icosahedral_reflector.glb"


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)


def rows_of(file):
    """The rows of a CSV table of the program, without its comments."""
    with open(file) as lines:
        return list(csv.DictReader(line for line in lines if line[0] != "#"))


def interrupt(code, after_s=1.5):
    """Runs Python code that prints a line when it begins, and interrupts it: (exit code, errors, seconds from the signal to the end)."""
    with subprocess.Popen([sys.executable, "-W", "ignore", "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.readline()
        time.sleep(after_s)
        process.send_signal(signal.SIGINT)
        start = time.monotonic()
        _, errors = process.communicate(timeout=60)
    return process.returncode, errors.rstrip(), time.monotonic() - start
