# SPDX-License-Identifier: BSD-3-Clause
"""The Python package against the program: the same values, the same errors; Ctrl-C, threads, workers."""
import multiprocessing
import os
import pathlib
import pickle
import shutil
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import seaglint
from program import REFLECTOR, interrupt, program, rows_of


def test_import_loads_no_torch():
    code = "import seaglint, sys; assert 'torch' not in sys.modules; print(any('torch' in line for line in open('/proc/self/maps')))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "False\n"


def import_of_a_copy(folder, *, compiled_as=None):
    """The error of importing the package without its compiled module, or with one of another Python's name."""
    package = pathlib.Path(seaglint.__file__).parent
    shutil.copytree(package, folder / "python/seaglint", ignore=shutil.ignore_patterns("_core*.so", "__pycache__"))
    if compiled_as:
        (folder / "python/seaglint" / compiled_as).write_bytes(b"")
    result = subprocess.run([sys.executable, "-c", "import seaglint"], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(folder / "python")})
    assert result.returncode == 1
    return result.stderr.splitlines()


def test_import_without_the_compiled_module_says_what_builds_it(tmp_path):
    (tmp_path / "CMakeCache.txt").touch()
    errors = import_of_a_copy(tmp_path)
    assert errors[-1] == f"ImportError: the compiled module of seaglint is not built: run `cmake --build {tmp_path} --target seaglint_python`"
    assert not any("circular" in line or "During handling" in line for line in errors)


def test_import_outside_of_a_build_says_how_to_build(tmp_path):
    assert import_of_a_copy(tmp_path)[-1] == "ImportError: the compiled module of seaglint is not built: run `cmake --preset release && cmake --build --preset release --target seaglint_python`"


def test_import_by_another_python_says_which_one_the_module_is_for(tmp_path):
    error = import_of_a_copy(tmp_path, compiled_as="_core.cpython-12-none.so")[-1]
    assert "is not built for Python" in error and "but as _core.cpython-12-none.so" in error


def test_all_mistakes_of_a_scenario_are_lines_of_one_error():
    with pytest.raises(seaglint.InputError) as raised:
        seaglint.Scenario({"seaglint": 1, "radar": {"bandwidth": 25, "pulses": 0}, "targets": {"a": {"label": 1, "mesh": "a.glb"}}})
    unknown, pulses = str(raised.value).splitlines()
    assert "radar.bandwidth: unknown key: did you mean 'bandwidth_mhz'?" in unknown and "radar.pulses: value '0'" in pulses


def test_rcs_is_that_of_the_program(tmp_path):
    azimuth, elevation, ghz = np.arange(0, 30, 7.5), [2, 5], [9.5, 10]
    values = seaglint.rcs(REFLECTOR, np.multiply(ghz, 1e9), azimuth, elevation)
    assert values.shape == (2, 2, 4, 2, 2) and values.dtype == complex
    assert program("rcs", "--target", REFLECTOR, "--frequency-ghz", "9.5:10:0.5", "--azimuth-deg", "0:22.5:7.5", "--elevation-deg", "2:5:3", "-o", tmp_path / "r.csv").returncode == 0
    rows = rows_of(tmp_path / "r.csv")
    assert len(rows) == 16
    for row in rows:
        at = (ghz.index(float(row["frequency_hz"]) / 1e9), elevation.index(float(row["elevation_deg"])), int(float(row["azimuth_deg"]) / 7.5))
        for p, received in enumerate("hv"):
            for q, transmitted in enumerate("hv"):
                pair = received + transmitted
                assert abs(values[at + (p, q)] - complex(float(row[pair + "_re"]), float(row[pair + "_im"]))) < 1e-8


def test_rcs_of_arrays_is_that_of_a_plate():
    """Physical optics at the normal: sigma = 4 pi A^2 / lambda^2, S = -j A / lambda along the incident polarisation."""
    a, b, hz = 0.3, 0.2, 10e9
    corners = [[0, -a / 2, -b / 2], [0, a / 2, -b / 2], [0, a / 2, b / 2], [0, -a / 2, b / 2]]
    plate = seaglint.Mesh.from_arrays(corners, [[0, 1, 2], [0, 2, 3]])
    with pytest.warns(seaglint.SeaglintWarning, match="open"):
        values = seaglint.rcs(plate, hz, 0, 0, edges=False)
    expected = a * b / (299792458.0 / hz)
    assert np.allclose(np.abs(np.diag(values[0, 0, 0])), expected, rtol=1e-9)
    assert np.abs(values[0, 0, 0, 0, 1]) < 1e-9 * expected


@pytest.mark.parametrize("options", [{"method": "rays"}, {"method": "rays", "ray_spacing_m": 0.01}])
def test_rcs_by_another_method_is_that_of_the_program(tmp_path, options):
    value, = seaglint.rcs(REFLECTOR, 10e9, 7.5, 5, **options).reshape(-1, 4)
    words = [word for key, setting in options.items() for word in ("--" + key.replace("_", "-"), str(setting))]
    assert program("rcs", "--target", REFLECTOR, "--frequency-ghz", "10", "--azimuth-deg", "7.5", "--elevation-deg", "5", *words, "-o", tmp_path / "r.csv").returncode == 0
    row, = rows_of(tmp_path / "r.csv")
    assert np.allclose(value, [complex(float(row[pair + "_re"]), float(row[pair + "_im"])) for pair in ("hh", "hv", "vh", "vv")], atol=1e-8)


def test_views_are_not_copies_and_stay_alive():
    mesh = seaglint.Mesh(REFLECTOR)
    vertices = mesh.vertices
    assert np.shares_memory(vertices, mesh.vertices)
    total = vertices.sum()
    del mesh
    assert vertices.sum() == total
    with pytest.raises(ValueError):
        vertices[0, 0] = 1


@pytest.mark.parametrize("call, message", [
    (lambda: seaglint.Scenario({"seaglint": 1, "radr": {}}), "radr: unknown key: did you mean 'radar'?"),
    (lambda: seaglint.Scenario("points.yaml", set={"radar.pulses": -1}), "radar.pulses"),
    (lambda: seaglint.Scenario("none.yaml"), "none.yaml: no such file, neither in the working directory nor in "),
    (lambda: seaglint.rcs(REFLECTOR, "10 GHz"), "frequencies_hz: must be a number or a sequence of numbers, not <U6"),
    (lambda: seaglint.rcs(REFLECTOR, [[1e9]]), "frequencies_hz: must be a number or a sequence of numbers, not float64 of shape (1, 1)"),
    (lambda: seaglint.rcs(REFLECTOR, [1e9, np.nan]), "frequencies_hz: value nan: must be finite"),
    (lambda: seaglint.rcs(REFLECTOR, []), "frequencies_hz"),
    (lambda: seaglint.rcs(REFLECTOR, 1e9, materials="aluminum"), "no such material"),
    (lambda: seaglint.rcs("none.stl", 1e9), "none.stl: no such file"),
    (lambda: seaglint.rcs(REFLECTOR, 1e9, method="sbr"), "method: value 'sbr': must be beams or rays"),
    (lambda: seaglint.rcs(REFLECTOR, 1e9, method=1), "method: must be a text, not 1"),
    (lambda: seaglint.rcs(REFLECTOR, 1e9, ray_spacing_m=0.01), "ray_spacing_m: value 0.01: valid only with method 'rays'; beams have min_patch_m"),
    (lambda: seaglint.rcs(REFLECTOR, 1e9, method="rays", ray_spacing_m=-1), "ray_spacing_m: value -1: must be within 0 and 1e+06"),
    (lambda: seaglint.rcs(REFLECTOR, 1e9, method="rays", cavities=["cell_01"]), "--cavity does not support --method rays"),
    (lambda: seaglint.Mesh.from_arrays([[0, 0]], [[0, 1, 2]]), "vertices: must be an array of shape (n, 3)"),
    (lambda: seaglint.Mesh.from_arrays(np.zeros((3, 3)), [[0, 1, 3]]), "triangles: index 3: must be within 0 and 2"),
    (lambda: seaglint.Dataset("/none"), "no such file: not a data set, or not finished"),
])
def test_wrong_input_is_one_sentence(call, message):
    with pytest.raises(seaglint.InputError) as error:
        call()
    assert message in str(error.value)


@pytest.mark.parametrize("call", [
    lambda: seaglint.rcs(REFLECTOR, 1e9, crease_deg="auto"), lambda: seaglint.rcs(REFLECTOR, 1e9, transmitter_deg=(1,)), lambda: seaglint.rcs(REFLECTOR, 1e9, max_bounces=2.5),
    lambda: seaglint.rcs(None, 1e9), lambda: seaglint.Mesh(None), lambda: seaglint.Simulator("points.yaml")[10**9], lambda: seaglint.Simulator("points.yaml")["a"],
    lambda: seaglint.compare(1, 2)])
def test_wrong_types_raise(call):
    with pytest.raises((TypeError, ValueError, IndexError)):
        call()


def test_samples_are_those_of_the_data_set(data_set):
    data, simulator = seaglint.Dataset(data_set, check=True), seaglint.Simulator("points.yaml")
    assert len(data) == len(simulator) == 40
    for k in (0, 6, 7, 39, -1):
        sample = simulator[k]
        assert np.array_equal(np.abs(sample.map).astype(np.float32), data[k])
        for name, value in sample.columns.items():
            assert data.columns[name][k] == value, name
    assert np.array_equal(sample.range_m, data.range_m) and np.array_equal(sample.velocity_mps, data.velocity_mps)
    assert sample.echo.shape[0] == len(sample.hop_code) == len(sample.carrier_hz) == 256
    assert sample.centres.shape[1] == 3 and sample.centres[0, 2] == sample.centres[:, 2].max()
    assert data.classes == ["array", "ship"]
    ships = data.where(label=1)
    assert len(ships) == 20 and np.array_equal(data.maps(ships)[3], data[ships[3]])


def test_the_sea_alone_has_samples_and_no_target():
    scenario = seaglint.Scenario("clutter.yaml", set={"radar.pulses": 64})
    assert scenario.targets == [] and len(scenario) == 16 and "\ntargets: {}\n" in scenario.yaml()
    sample = seaglint.Simulator(scenario)[3]
    assert np.isfinite(sample.map).all() and np.abs(sample.map).max() > 0
    assert sample.columns["target_name"] == "sea" and sample.columns["label"] == 0 and np.isnan(sample.columns["scr_per_pulse_db"])
    for call in (lambda: seaglint.motion(scenario), lambda: seaglint.Scenario("clutter.yaml", set={"clutter.noise_level": "snr"})):
        with pytest.raises(seaglint.InputError, match="targets: {}"):
            call()
    assert seaglint.Scenario({"seaglint": 1, "targets": {}, "clutter": {"level": "git"}}).targets == []


def test_damaged_and_closed_data_sets(data_set, tmp_path):
    import shutil

    copy = tmp_path / "copy"
    shutil.copytree(data_set, copy)
    shard = sorted(copy.glob("*.h5"))[1]
    whole = shard.read_bytes()
    shard.write_bytes(whole[:5000])
    with pytest.raises(seaglint.InputError, match="not a shard"):
        seaglint.Dataset(copy)[8]
    shard.write_bytes(whole[:-9] + b"x" + whole[-8:])
    with pytest.raises(seaglint.InputError, match="SHA-256"):
        seaglint.Dataset(copy, check=True)
    shard.unlink()
    with pytest.raises(seaglint.InputError, match="no such file, but the manifest lists it"):
        seaglint.Dataset(copy)
    with seaglint.Dataset(data_set) as data:
        data[0]
    with pytest.raises(seaglint.InputError, match="closed"):
        data[0]
    with pytest.raises(seaglint.InputError, match="no column lable; the columns are aspect_traces, "):
        seaglint.Dataset(data_set).where(lable=1)


def columns_by_hdf5(data):
    import h5py

    parts = []
    for shard in data.manifest["shards"]:
        with h5py.File(data.folder / shard["file"]) as file:
            parts.append({name: array[...] for name, array in [*file["samples"].items(), *file.get("drawn", {}).items()]})
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    return {name: np.char.decode(values, "utf-8") if values.dtype.kind == "S" else values for name, values in columns.items()}


def assert_equal_columns(first, second):
    assert first.keys() == second.keys() and "label" in first and "target_name" in first
    for name in first:
        assert first[name].dtype == second[name].dtype and np.array_equal(first[name], second[name]), name


def test_columns_are_those_that_hdf5_reads(data_set, tmp_path):
    """Six shards, the last with fewer samples; then the third stored by h5py, without chunks."""
    import h5py
    import shutil

    assert_equal_columns(seaglint.Dataset(data_set).columns, columns_by_hdf5(seaglint.Dataset(data_set)))
    copy = tmp_path / "copy"
    shutil.copytree(data_set, copy)
    shard = copy / "shard_00002.h5"
    with h5py.File(shard) as file:
        values = {name: array[...] for name, array in file["samples"].items()}
    with h5py.File(shard, "w") as file:
        for name, array in values.items():
            file[f"samples/{name}"] = array[::-1]
    columns = seaglint.Dataset(copy).columns
    assert_equal_columns(columns, columns_by_hdf5(seaglint.Dataset(copy)))
    assert np.array_equal(columns["sample"][14:21], np.arange(20, 13, -1))


def test_drawn_keys_are_columns(tmp_path):
    made = program("generate", "points.yaml", "-o", tmp_path / "set", "--set", "dataset.maps_per_shard=7", "--set", "clutter.scr_db=uniform(5 20)",
                   "--set", "radar.hop_code=choice(random, balanced)")
    assert made.returncode == 0, made.stderr
    data = seaglint.Dataset(tmp_path / "set")
    assert_equal_columns(data.columns, columns_by_hdf5(data))
    assert np.allclose(data.columns["clutter.scr_db"], data.columns["scr_per_pulse_db"], atol=1e-9)
    assert sorted([*data.where(**{"radar.hop_code": "random"}), *data.where(**{"radar.hop_code": "balanced"})]) == list(range(40))


def test_samples_of_several_looks(tmp_path):
    import h5py
    import torch

    made = program("generate", "points.yaml", "-o", tmp_path / "set", "--set", "looks.count=3", "--set", "looks.spacing_s=0.4", "--set", "dataset.maps_per_shard=30")
    assert made.returncode == 0, made.stderr
    data = seaglint.Dataset(tmp_path / "set", check=True)
    assert data.looks == 3 and data.map_shape == (64, 256)
    with h5py.File(tmp_path / "set/shard_00001.h5") as shard:
        assert np.array_equal(data[35], shard["maps"][5]) and data.maps([35, 2]).shape == (2, 3, 64, 256)
        assert np.array_equal(data.look_columns["centres"][30:], shard["looks/centres"][:])
    assert np.allclose(np.diff(data.look_columns["start_s"], axis=1), 0.4)
    assert np.array_equal(data.look_columns["mwr"][:, 0], data.columns["mwr"])
    item, label = data.torch_dataset()[35]
    assert item.shape == (3, 64, 256) and item.dtype == torch.float32 and label == data.columns["label"][35]
    assert data.to_webdataset(tmp_path / "tar") == 1
    one = program("generate", "points.yaml", "-o", tmp_path / "one")
    assert one.returncode == 0 and seaglint.Dataset(tmp_path / "one").looks == 1 and not seaglint.Dataset(tmp_path / "one").look_columns


@pytest.mark.parametrize("number", [0, 1, 5])
def test_a_changed_byte_of_a_column_is_found(data_set, tmp_path, number):
    """In the first shard, one of equal structure, and the last, which is shorter."""
    import h5py
    import shutil

    copy = tmp_path / "copy"
    shutil.copytree(data_set, copy)
    shard = copy / f"shard_{number:05d}.h5"
    with h5py.File(shard) as file:
        place = file["samples/label"].id.get_chunk_info(0).byte_offset
    content = bytearray(shard.read_bytes())
    content[place] ^= 1
    shard.write_bytes(content)
    with pytest.raises(seaglint.InputError, match=shard.name):
        seaglint.Dataset(copy).columns
    shard.write_bytes(b"")
    with pytest.raises(seaglint.InputError, match=f"{shard.name}: not a shard"):
        seaglint.Dataset(copy).columns


def total(data, indices):
    return float(sum(data[i].sum(dtype=float) for i in indices))


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_four_workers(data_set, method):
    data = seaglint.Dataset(data_set)
    expected = [total(data, range(first, 40, 4)) for first in range(4)]  # handles are open before the fork
    with multiprocessing.get_context(method).Pool(4) as pool:
        assert pool.starmap(total, [(data, range(first, 40, 4)) for first in range(4)]) == expected
    assert total(pickle.loads(pickle.dumps(data)), range(40)) == total(data, range(40))


def test_torch_loader(data_set):
    torch = pytest.importorskip("torch", reason="needs the package python3-torch")
    loader = torch.utils.data.DataLoader(seaglint.Dataset(data_set).torch_dataset(), batch_size=10, num_workers=4)
    batches = list(loader)
    assert [tuple(maps.shape) for maps, _ in batches] == [(10, 1, 64, 256)] * 4
    assert sum(int(labels.sum()) for _, labels in batches) == 20


def test_columns_of_torch_items(data_set):
    data = seaglint.Dataset(data_set)
    assert data.torch_dataset(["label", "azimuth_deg"]).values[1] is data.columns["azimuth_deg"]
    with pytest.raises(seaglint.InputError, match="no column 'azimut_deg': did you mean 'azimuth_deg'"):
        data.torch_dataset("azimut_deg")


def test_other_threads_go_on():
    count, done = 0, threading.Event()

    def counting():
        nonlocal count
        while not done.is_set():
            count += 1
            time.sleep(0.001)

    thread = threading.Thread(target=counting)
    thread.start()
    start = time.monotonic()
    seaglint.rcs(REFLECTOR, 16e9, np.arange(0, 360, 0.25), 2)
    seconds = time.monotonic() - start
    done.set()
    thread.join()
    assert count > 100 * seconds


def test_ctrl_c_stops_long_work():
    code = "import seaglint, numpy as np\nprint('begun', flush=True)\nseaglint.rcs('assets/combatant_144m.glb', 16e9, np.arange(0, 360, 0.01))"
    returned, errors, _ = interrupt(code)
    assert returned != 0 and errors.endswith("KeyboardInterrupt"), errors


def test_ctrl_c_stops_within_a_sample():
    """Of a ship in waves of 5 m with a trace for every 0.001 deg of its motion, which takes a minute."""
    code = """import seaglint
solver = {"min_patch_m": 5e-5, "max_aspect_change_deg": 0.001}
simulator = seaglint.Simulator(seaglint.Scenario("quick.yaml", set={"targets.ship.solver": solver, "sea.significant_wave_height_m": 5}))
print("begun", flush=True)
simulator[0]"""
    returned, errors, seconds = interrupt(code)
    assert returned != 0 and errors.endswith("KeyboardInterrupt"), errors
    assert seconds < 5


def test_names_of_the_package_are_documented():
    for name in seaglint.__all__:
        assert getattr(seaglint, name).__doc__, name
