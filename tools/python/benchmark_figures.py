# SPDX-License-Identifier: BSD-3-Clause
"""Runs programs for tools/measure, and the benchmarks of the speed tables."""
import fnmatch
import json
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile
import time

from figure_tables import ROOT, Failure

LOG = ROOT / "build/measure.log"


def run(command, **options):
    """Runs a program, its output into build/measure.log; returns its wall and processor time in seconds."""
    def processor():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    LOG.parent.mkdir(exist_ok=True)
    before, start = processor(), time.monotonic()
    with LOG.open("w") as log:
        status = subprocess.run(command, cwd=ROOT, stdout=log, stderr=log, check=False, **options).returncode
    if status != 0:
        tail = "".join(LOG.read_text(errors="replace").splitlines(keepends=True)[-15:])
        raise Failure(f"{pathlib.Path(command[0]).name} failed with exit code {status}; the end of {LOG}:\n{tail}")
    return time.monotonic() - start, processor() - before


def progress(text):
    print(text, flush=True)


def build_release(targets):
    """Installs missing packages and builds these targets of build/release, all of them if none is named."""
    progress("building " + (" ".join(targets) or "everything") + " ...")
    run(["bash", "-c", 'source tools/setup.sh && install_packages build test && build_release "$@"', "build", *targets])


def duration(seconds):
    whole = round(seconds)
    return f"{whole // 60} min {whole % 60} s" if whole >= 120 else f"{whole} s"


def significant(value, digits):
    return f"{float(f'{value:.{digits}g}'):,.10g}"


# What follows makes figures, {identifier: text}, of the runs of benchmarks, {name: [run]}.


def seconds(run_of, clock="real_time"):
    return run_of[clock] * {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}[run_of["time_unit"]]


def each(identifier, figure, choose=lambda name: True):
    """Figures of each of these benchmarks: `identifier` with its arguments, `figure` of its runs."""
    return lambda runs: {identifier.format(*name.split("/")[1:]): figure(of)
                         for name, of in runs.items() if choose(name)}


def fastest_s(runs):
    return f"{min(seconds(run_of) for run_of in runs):.2f}"


def median(counter, digits):
    return lambda runs: f"{statistics.median(run_of[counter] for run_of in runs):.{digits}f}"


def milliseconds(clock):
    return lambda runs: significant(1e3 * min(seconds(run_of, clock) for run_of in runs), 3)


def microseconds(runs):
    value = 1e6 * min(seconds(run_of, "cpu_time") for run_of in runs)
    return f"{value:.1f}" if value < 99.95 else significant(value, 3)


def extremes(identifier, choose=lambda name: True):
    """The shortest and the longest of these benchmarks."""
    def figures(runs):
        times = [min(seconds(run_of) for run_of in of) for name, of in runs.items() if choose(name)]
        return {f"{identifier}_least_s": f"{min(times):.2f}", f"{identifier}_most_s": f"{max(times):.2f}"}

    return figures


def joined(*functions):
    return lambda runs: {name: figure for function in functions for name, figure in function(runs).items()}


def of_fine_rays(name):
    return name.endswith(("/18", "/10"))


def by_default(name):
    return name.endswith("/100")


def beside_definition(identifier):
    return lambda runs: {f"{identifier}_ms": milliseconds("cpu_time")(next(iter(runs.values()))),
                         f"{identifier}_speed_up": significant(next(iter(runs.values()))[0]["definition_over_this"], 2)}


# By the beginning of the benchmarks' names, each a process of its own: number of runs, and what makes figures of them.
SETTINGS = {"ShipDefaultSettingsError/": (1, each("default_error_{}_db", median("error_dB", 1)))}
# Beams beside rays, half an hour.
RAYS = {
    "ShipSbrReference/": (3, joined(each("rays_{}_{}mm_db", median("rays_dB", 0)),
                                    each("beams_{}_db", median("beams_dB", 0)),
                                    each("matrix_over_rays_{}_{}mm", median("matrix/embree", 2), of_fine_rays),
                                    each("interval_over_rays_{}_{}mm", median("interval/embree", 2), of_fine_rays))),
}
# The two methods of the solver, three minutes.
METHODS = {
    "ShipByRays/": (1, joined(each("ship_by_rays_{}_{}_db", median("rays_dB", 0)),
                              each("ship_by_beams_{}_{}_db", median("beams_dB", 0), by_default),
                              each("ship_by_rays_{}_{}_over_beams", median("rays/beams", 2)),
                              each("ship_by_rays_{}_{}_over_embree", median("rays/embree", 1), by_default),
                              each("matrix_by_rays_{}_{}_over_embree", median("matrix/embree", 1), by_default),
                              each("search_by_rays_{}_{}_over_embree", median("search/embree", 2), by_default))),
    "SphereByRays/": (1, joined(each("sphere_by_rays_{}_facets", median("facets", 0)),
                                each("sphere_by_rays_{}_s", median("rays_s", 2)),
                                each("sphere_by_rays_{}_over_beams", median("rays/beams", 1)))),
}
# Generated ships beside the combatant, three minutes.
FLEET = {"FleetIntervalOverCombatant/": (1, each("fleet_{}_{}_over_combatant", median("ratio", 2)))}
BENCHMARKS = {
    "ShipAspect/": (4, each("ship_aspect_{1}_s", fastest_s)),
    "ShipSweepOverOneFrequency/": (1, each("ship_sweep_over_one_{}", median("ratio", 2))),
    "ShipInterval/": (4, each("ship_interval_{}_s", fastest_s)),
    "ShipIntervalRollingAtOneRms/": (4, each("ship_rolling_{}_s", fastest_s)),
    "ReflectorInterval": (4, lambda runs: {"reflector_interval_ms": milliseconds("real_time")(*runs.values())}),
    "SolverTimeOverEmbreeFirstHits/": (1, each("solver_over_embree_{}", median("ratio", 0))),
    "ShipLength/": (1, extremes("ship_length")),
    "ShipBand/": (1, joined(extremes("ship_carrier", lambda name: name.endswith("/320")),
                            extremes("ship_frequencies", lambda name: "/16/" in name and not name.endswith("/320")))),
    "MillionFacets/": (1, lambda runs: {"million_facets_gb": f"{1e-3 * next(iter(runs.values()))[0]['peak_MB']:.2f}"}),
    "LongCrestedSeries/": (1, each("sea_series_{}_us", microseconds)),
    "LongCrestedMotion/": (1, each("sea_motion_{}_us", microseconds)),
    "LongCrestedAnywhere/": (1, each("sea_anywhere_{}_us", microseconds)),
    "DirectionalSeries/": (1, each("sea_spread_series_{}_us", microseconds)),
    "DirectionalMotion/": (1, each("sea_spread_motion_{}_us", microseconds)),
    "EchoAndReceivedMap/": (1, each("echo_and_map_{}_ms", milliseconds("cpu_time"))),
    "MapVersusDirectSum": (1, beside_definition("map")),
    "SixtyPointsVersusDirectSum": (1, beside_definition("sixty_points")),
    "CentresOfSixtyPoints": (1, lambda runs: {"clean_ms": milliseconds("cpu_time")(*runs.values())}),
}


def measure_benchmarks(only, groups):
    groups = {name: group for name, group in groups.items() if fnmatch.fnmatch(name.rstrip("/"), only)}
    if groups:
        build_release(["seaglint_bench"])
    figures = {}
    for name, (repetitions, figures_of) in groups.items():
        progress(f"seaglint_bench: {name.rstrip('/')} ...")
        with tempfile.TemporaryDirectory() as folder:
            result = pathlib.Path(folder) / "result.json"
            run([ROOT / "build/release/seaglint_bench", "=".join(("--benchmark_filter", "^" + name)),
                 f"--benchmark_repetitions={repetitions}", f"--benchmark_out={result}", "--benchmark_out_format=json"])
            runs = {}
            for run_of in json.loads(result.read_text())["benchmarks"]:
                if run_of["run_type"] == "iteration":
                    key = re.sub(r"/(iterations|repeats):\d+|/real_time", "", run_of["run_name"])
                    runs.setdefault(key, []).append(run_of)
        figures.update(figures_of(runs))
    return figures
