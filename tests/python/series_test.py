# SPDX-License-Identifier: BSD-3-Clause
"""Sea and motion of the package against the tables of the program."""
import numpy as np
import pytest

import seaglint
from program import interrupt, program, rows_of

# The printed digits of the tables, nine.
DIGITS = 0.5e-8


def assert_columns(columns, rows):
    assert list(columns) == [name for name in rows[0] if name != "body"]
    for name, values in columns.items():
        printed = np.array([float(row[name]) for row in rows])
        assert values.shape == printed.shape and np.all(np.abs(values - printed) <= DIGITS * np.abs(printed)), name


@pytest.mark.parametrize("kinematics", [False, True])
def test_sea_is_that_of_the_program(tmp_path, kinematics):
    options = ["--kinematics"] if kinematics else []
    assert program("sea", "quick.yaml", "--state", "0", "--at", "40,-3", "--duration-s", "20", "--step-s", "0.3", "-o", tmp_path / "sea.csv", *options).returncode == 0
    series = seaglint.sea("quick.yaml", at_m=(40, -3), duration_s=20, step_s=0.3, kinematics=kinematics)
    assert_columns(series.columns(), rows_of(tmp_path / "sea.csv"))
    assert (series.velocity_mps is not None) == kinematics
    assert set(series.units) >= {name for name in vars(series) if name not in ("state", "statistics")}


def test_sea_has_the_wave_height_of_its_statistics():
    """The standard deviation over 3000 s is that of the realisation within its statistical error, 1/sqrt(periods)."""
    series = seaglint.sea({"seaglint": 1, "sea": {"significant_wave_height_m": 2, "peak_period_s": 8, "order": 1}, "targets": {"p": {"label": 1, "points": [{"position_m": [0, 0, 0], "amplitude_m": 1}]}}},
                          duration_s=3000, step_s=0.5)
    hs = series.statistics["significant_wave_height_m"]
    assert abs(hs - 2) < 1e-9 and series.state["significant_wave_height_m"] == 2
    assert abs(4 * series.elevation_m.std() / hs - 1) < 3 / np.sqrt(3000 / 8)
    assert np.array_equal(series.elevation_m, series.elevation_linear_m)


def test_motion_is_that_of_the_program(tmp_path):
    made = program("motion", "quick.yaml", "--state", "0", "--duration-s", "20", "--step-s", "0.3", "-o", tmp_path / "motion.csv")
    assert made.returncode == 0, made.stderr
    rows = rows_of(tmp_path / "motion.csv")
    series = seaglint.motion("quick.yaml", duration_s=20, step_s=0.3)
    assert series.bodies == ["ship", "array_1", "array_2", "array_3", "array_4"] and series.roll_deg.shape == (5, 67)
    for body in series.bodies:
        assert_columns(series.columns(body), [row for row in rows if row["body"] == body])
    for body, line in zip(series.bodies, made.stdout.splitlines()):  # three printed digits
        for angle in ("roll", "pitch", "yaw"):
            figures = {name: values[series.bodies.index(body)] for name, values in series.statistics[angle].items()}
            said = f"{angle} mean {figures['mean_deg']:.3g} deg, rms about it {figures['rms_deg']:.3g} deg, largest {figures['largest_deg']:.3g} deg"
            assert line.startswith(body + ":") and said in line
            assert (f"mean period {figures['mean_period_s']:.3g} s" in line) != np.isnan(figures["mean_period_s"])


def test_realisations_differ_and_a_longer_series_begins_like_a_shorter():
    first, second, other = (seaglint.sea("quick.yaml", k, sea_state=s, duration_s=30) for k, s in ((0, 0), (1, 0), (0, 1)))
    assert not np.array_equal(first.elevation_m, second.elevation_m)
    assert abs(first.statistics["significant_wave_height_m"] - second.statistics["significant_wave_height_m"]) < 1e-12
    assert other.state["significant_wave_height_m"] != first.state["significant_wave_height_m"]
    short = seaglint.motion("quick.yaml", 2, duration_s=5, threads=1)
    assert np.array_equal(short.roll_deg, seaglint.motion("quick.yaml", 2, duration_s=10, threads=2).roll_deg[:, :51])


@pytest.mark.parametrize("call, message", [
    (lambda: seaglint.sea("none.yaml"), "none.yaml: no such file"),
    (lambda: seaglint.sea("quick.yaml", 1.5), "realisation: must be a whole number, not 1.5"),
    (lambda: seaglint.sea("quick.yaml", -1), "realisation: value -1: must be at least 0"),
    (lambda: seaglint.sea("quick.yaml", 10**6), "realisation 1000000: must be within 0 and 999999"),
    (lambda: seaglint.sea("quick.yaml", sea_state=3), "sea_state 3: must be within 0 and 2"),
    (lambda: seaglint.sea("quick.yaml", at_m=(1, 2, 3)), "at_m: must be two numbers, x and y, not 3"),
    (lambda: seaglint.sea("quick.yaml", at_m=("a", "b")), "at_m: must be a number"),
    (lambda: seaglint.sea("quick.yaml", step_s=0), "step_s: value 0: must be within 0.0001 and 10000"),
    (lambda: seaglint.sea("quick.yaml", duration_s=1e6, step_s=1e-3), "duration_s 1e+06 with step_s 0.001: must be at most 10000000 times"),
    (lambda: seaglint.motion("quick.yaml", duration_s="10 s"), "duration_s: must be a number"),
    (lambda: seaglint.motion("points.yaml"), "targets: none of them is a mesh"),
    (lambda: seaglint.motion("quick.yaml", duration_s=1).columns("boat"), "no body boat; the bodies are ship, array_1"),
])
def test_wrong_input_is_one_sentence(call, message):
    with pytest.raises(seaglint.InputError) as error:
        call()
    assert message in str(error.value) and "\n" not in str(error.value)


def test_ctrl_c_stops_a_long_series():
    returned, errors, _ = interrupt("import seaglint\nprint('begun', flush=True)\nseaglint.sea('quick.yaml', duration_s=9e5, kinematics=True)", after_s=0.5)
    assert returned != 0 and errors.endswith("KeyboardInterrupt"), errors
