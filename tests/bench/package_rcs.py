# SPDX-License-Identifier: BSD-3-Clause
"""Processor time of the package's rcs() over that of the command `rcs`, the same sweep: package_rcs.py BUILD [RUNS [THREADS]].

Runs of both alternate, each in a process of its own; user and system time, so that other work on the machine matters
less. The package's time is that of the call; Python, NumPy and the libraries start once per session.
"""
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

MESH, GHZ, LAST, STEP = "assets/combatant_144m.glb", 16, 10, 5  # azimuths 0 to LAST deg

CALL = f"""
import resource, sys, warnings
import numpy as np
import seaglint
warnings.simplefilter("ignore")
def spent():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime
begin = spent()
seaglint.rcs({MESH!r}, {GHZ}e9, np.arange(0, {LAST} + 1, {STEP}), 2, threads=int(sys.argv[1]))
print(spent() - begin, begin)
"""


def of_command(build, threads, output):
    command = [build / "seaglint", "rcs", "--target", MESH, "--frequency-ghz", str(GHZ), "--azimuth-deg", f"0:{LAST}:{STEP}", "--elevation-deg", "2", "--threads", threads, "-o", output]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"package_rcs: {' '.join(map(str, command))}: exit code {process.returncode}")
    return usage.ru_utime + usage.ru_stime


def of_package(build, threads):
    done = subprocess.run(["/usr/bin/python3", "-c", CALL, threads], env={**os.environ, "PYTHONPATH": str(build / "python")}, capture_output=True, text=True, check=True)
    return map(float, done.stdout.split())


def main(build, runs="7", threads="2"):
    command, call, start = [], [], []
    runs = int(runs)
    with tempfile.TemporaryDirectory() as folder:
        for run in range(runs):
            command.append(of_command(build, threads, os.path.join(folder, "rcs.csv")))
            seconds, begin = of_package(build, threads)
            call.append(seconds)
            start.append(begin)
            print(f"run {run + 1} of {runs}: command {command[-1]:.2f} s, rcs() {call[-1]:.2f} s, ratio {call[-1] / command[-1]:.3f}", flush=True)
    ratios = sorted(c / d for c, d in zip(call, command))
    print(f"rcs() over the command: median {statistics.median(ratios):.3f} ({ratios[0]:.3f} to {ratios[-1]:.3f}), fastest over fastest {min(call) / min(command):.3f}; start of Python and imports {statistics.median(start):.2f} s")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), *sys.argv[2:4])
