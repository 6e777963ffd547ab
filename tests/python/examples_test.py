# SPDX-License-Identifier: BSD-3-Clause
"""The example scripts as a user runs them, from another folder."""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import seaglint

EXAMPLES = pathlib.Path(os.environ["EXAMPLES"])
C = 299792458.0  # m/s


def run(script, folder, *arguments):
    return subprocess.run([sys.executable, EXAMPLES / f"{script}.py", *map(str, arguments)], cwd=folder, capture_output=True, text=True)


def module_of(script):
    spec = importlib.util.spec_from_file_location(script, EXAMPLES / f"{script}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_rcs_sweep_finds_a_plate_at_its_range(tmp_path):
    """Plate of 0.3 x 0.2 m normal to x, half a metre in front of the origin, in a file in millimetres."""
    image = pytest.importorskip("matplotlib.image", reason="needs the package python3-matplotlib")
    a, b, x, ghz, bandwidth_ghz = 0.3, 0.2, 0.5, 10.0, 2.0
    corners = np.array([[x, -a / 2, -b / 2], [x, a / 2, -b / 2], [x, a / 2, b / 2], [x, -a / 2, b / 2]])
    seaglint.Mesh.from_arrays(1e3 * corners, [[0, 1, 2], [0, 2, 3]]).write(tmp_path / "plate.stl")
    done = run("rcs_sweep", tmp_path, "plate.stl", "--unit", "mm", "--centre-ghz", ghz, "--bandwidth-ghz", bandwidth_ghz, "--azimuth-deg", -20, 20, 0.5, "-o", "plate")
    assert done.returncode == 0, done.stderr
    with np.load(tmp_path / "plate.npz") as sweep:
        S, frequency_hz, azimuth_deg = sweep["S"], sweep["frequency_hz"], sweep["azimuth_deg"]
    front, centre = int(np.argmin(np.abs(azimuth_deg))), len(frequency_hz) // 2
    assert S.shape == (len(frequency_hz), 1, 81, 2, 2) and frequency_hz[centre] == ghz * 1e9
    # 4 pi A^2 / lambda^2; the edges' own echoes at the normal are below a fiftieth of the amplitude, 0.2 dB.
    sigma = 4 * np.pi * np.abs(S[centre, 0, front, 1, 1]) ** 2
    assert abs(10 * np.log10(sigma / (4 * np.pi * (a * b * ghz * 1e9 / C) ** 2))) < 0.2
    range_m, profiles = module_of("rcs_sweep").range_profiles(S[:, 0, front, 1, 1], frequency_hz)
    cell_m = C / (2 * bandwidth_ghz * 1e9) / 4
    assert abs(range_m[np.argmax(np.abs(profiles))] - -x) < cell_m
    picture = image.imread(tmp_path / "plate.png")
    assert picture.shape[0] > 500 and picture[..., :3].std() > 0.1


def test_range_profiles_have_a_point_at_its_range_with_its_amplitude():
    pytest.importorskip("matplotlib", reason="needs the package python3-matplotlib")
    sweep = module_of("rcs_sweep")
    frequency_hz = sweep.frequencies(10e9, 1e9, 5.0)
    assert np.ptp(frequency_hz) == 1e9 and C / 2 / np.diff(frequency_hz).max() >= 3 * 2 * 5.0
    step_m = C / (2 * 4 * len(frequency_hz) * np.diff(frequency_hz)[0])
    for bin in (-40, 0, 17):
        point = 2.5 * np.exp(-4j * np.pi * frequency_hz * bin * step_m / C)
        range_m, profiles = sweep.range_profiles(point, frequency_hz)
        peak = np.argmax(np.abs(profiles))
        assert abs(range_m[peak] - bin * step_m) < 1e-6 and abs(np.abs(profiles[peak]) - 2.5) < 1e-6


def test_rcs_sweep_says_what_is_wrong_in_one_line(tmp_path):
    pytest.importorskip("matplotlib", reason="needs the package python3-matplotlib")
    done = run("rcs_sweep", tmp_path, "none.stl")
    assert done.returncode == 1 and done.stderr.startswith("rcs_sweep: none.stl: no such file") and done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_training_classifies_unseen_seas(tmp_path):
    pytest.importorskip("torch", reason="needs the package python3-torch")
    settings = ["dataset.realisations_per_case=20", "dataset.maps_per_case=40", "clutter.scr_db=30"]
    done = run("train_on_maps", tmp_path, "set", "--scenario", "points.yaml", *[word for value in settings for word in ("--set", value)], "--epochs", 6, "--folds", 2)
    assert done.returncode == 0, done.stderr
    found = re.search(r"accuracy on unseen seas: ([\d.]+) % \(95 % interval (\d+) to (\d+) %; 160 maps of 20 seas\)", done.stdout)
    assert found, done.stdout
    accuracy, low, high = map(float, found.groups())
    assert 50 < low < accuracy <= high  # better than guessing
    again = run("train_on_maps", tmp_path, "set", "--folds", 30)
    assert again.returncode == 1 and again.stderr == "train_on_maps: 20 seas for 30 folds: must be at least 2 folds, and a sea for each\n"


def test_folds_divide_between_seas_and_have_all_wave_heights():
    pytest.importorskip("torch", reason="needs the package python3-torch")
    training = module_of("train_on_maps")
    group = np.repeat(np.arange(30), 8)
    columns = {"group": group, "sea_state": group // 10}
    fold = training.folds_of_seas(columns, 5, 3)
    for g in range(30):
        assert len(np.unique(fold[group == g])) == 1
    for k in range(5):
        assert np.array_equal(np.unique(columns["sea_state"][fold == k], return_counts=True), [[0, 1, 2], [16, 16, 16]])


def test_interval_is_wilsons():
    """Table of Brown, Cai and DasGupta (2001) and the limit of no error: n / (n + z^2)."""
    pytest.importorskip("torch", reason="needs the package python3-torch")
    interval = module_of("train_on_maps").interval
    assert np.allclose(interval(0.5, 10), (0.2366, 0.7634), atol=1e-4)
    assert np.allclose(interval(1.0, 20), (20 / (20 + 1.96**2), 1))
