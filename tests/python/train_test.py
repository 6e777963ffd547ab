# SPDX-License-Identifier: BSD-3-Clause
"""Learning by the package against that of the program."""
import json
import os
import pty
import subprocess
import sys

import pytest

import seaglint
from program import interrupt, program

FEW = dict(epochs=1, trees=20, split_repeats=1)


def test_metrics_are_those_of_the_program(data_set, tmp_path):
    options = [word for key, value in FEW.items() for word in ("--set", f"learning.{key}={value}")]
    made = program("train", data_set, "-o", tmp_path / "program", *options, "--set", "dataset.split=5:3")
    assert made.returncode == 0, made.stderr
    metrics = seaglint.train(seaglint.Dataset(data_set), tmp_path / "package", split="5:3", threads=1, **FEW)
    assert metrics == json.loads((tmp_path / "program/metrics.json").read_text()) and metrics["learning"]["epochs"] == 1
    files = sorted(file.name for file in (tmp_path / "program").iterdir())
    assert sorted(file.name for file in (tmp_path / "package").iterdir()) == files
    for name in files:
        assert (tmp_path / "package" / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name


def test_a_division_by_columns_is_that_of_the_program(data_set, tmp_path):
    options = [word for key, value in FEW.items() for word in ("--set", f"learning.{key}={value}")]
    made = program("train", data_set, "-o", tmp_path / "program", *options, "--by", "sea", "--hold-out", "azimuth_deg=80")
    assert made.returncode == 0, made.stderr
    metrics = seaglint.train(data_set, tmp_path / "package", by="sea", hold_out={"azimuth_deg": 80}, **FEW)
    assert metrics == json.loads((tmp_path / "program/metrics.json").read_text()) and "azimuth_deg=80" in metrics["division"]


def test_evaluation_is_that_of_the_program(data_set, tmp_path):
    model = tmp_path / "model"
    seaglint.train(data_set, model, **FEW)
    made = program("evaluate", model, data_set, "-o", tmp_path / "program", "--by", "energy_m2", "--trained-rows")
    assert made.returncode == 0, made.stderr
    evaluation = seaglint.evaluate(model, seaglint.Dataset(data_set), by=["energy_m2"], trained_rows=True, output=tmp_path / "package")
    assert evaluation == json.loads((tmp_path / "program/evaluation.json").read_text())
    for name in ("evaluation.json", "probabilities.csv"):
        assert (tmp_path / "package" / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name
    unseen = seaglint.evaluate(model, [data_set], unseen_seas=True)
    assert unseen["maps"]["evaluated"] == 40 - unseen["maps"]["trained"] - unseen["maps"]["sea_seen"]
    for call, message in [(lambda: seaglint.evaluate(tmp_path / "none", data_set), "none"), (lambda: seaglint.evaluate(model, []), "data: must be a data set"),
                          (lambda: seaglint.evaluate(model, [data_set, data_set]), "the same maps as"), (lambda: seaglint.evaluate(model, data_set, by="energy"), "energy: no column of a data set")]:
        with pytest.raises(seaglint.InputError) as error:
            call()
        assert message in str(error.value)


@pytest.mark.parametrize("before, after", [("import torch", ""), ("", "import torch")])
def test_torch_of_python_before_or_after(data_set, tmp_path, before, after):
    pytest.importorskip("torch", reason="needs the package python3-torch")
    code = f"""{before}
import seaglint
seaglint.train({str(data_set)!r}, {str(tmp_path / 'model')!r}, **{FEW})
{after}
import torch
layer = torch.nn.Linear(3, 1)
layer(torch.ones(2, 3)).sum().backward()
print(layer.weight.grad.sum().item())
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "6.0\n", done.stderr


@pytest.mark.parametrize("call, message", [
    (lambda data, model: seaglint.train(data, model, epoch=3), "learning.epoch: unknown key: did you mean 'epochs'?"),
    (lambda data, model: seaglint.train(data, model, epochs=0), "learning.epochs"),
    (lambda data, model: seaglint.train(data, model, split="9"), "dataset.split"),
    (lambda data, model: seaglint.train(data, model, threads=-1), "threads: value -1: must be at least 0"),
    (lambda data, model: seaglint.train(data, data), "the directory contains no model, but "),
    (lambda data, model: seaglint.train("/none", model), "/none: no such directory"),
])
def test_wrong_input_is_one_sentence(data_set, tmp_path, call, message):
    with pytest.raises(seaglint.InputError) as error:
        call(data_set, tmp_path / "model")
    assert message in str(error.value) and "\n" not in str(error.value)
    assert not (tmp_path / "model").exists()


def test_ctrl_c_keeps_the_earlier_model(data_set, tmp_path):
    model = tmp_path / "model"
    seaglint.train(data_set, model, **FEW)
    before = {file.name: file.read_bytes() for file in model.iterdir()}
    code = f"import seaglint\nprint('begun', flush=True)\nseaglint.train({str(data_set)!r}, {str(model)!r}, trees=100000)"
    returned, errors, _ = interrupt(code, after_s=3)
    assert returned != 0 and errors.endswith("KeyboardInterrupt"), errors
    assert {file.name: file.read_bytes() for file in model.iterdir()} == before


def test_a_terminal_shows_the_progress(data_set, tmp_path):
    terminal, inner = pty.openpty()
    code = f"import seaglint\nseaglint.train({str(data_set)!r}, {str(tmp_path / 'model')!r}, epochs=100, split_repeats=2)"
    with subprocess.Popen([sys.executable, "-c", code], stderr=inner) as process:
        os.close(inner)
        text = b""
        while b"training  [" not in text:
            text += os.read(terminal, 4096)
        process.terminate()
    os.close(terminal)


def test_importing_the_package_loads_no_libtorch_and_training_does(data_set, tmp_path):
    code = f"""import seaglint
loaded = lambda: any("libtorch" in line for line in open("/proc/self/maps"))
before = loaded()
seaglint.train({str(data_set)!r}, {str(tmp_path / 'model')!r}, **{FEW})
print(before, loaded())"""
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "False True\n"
