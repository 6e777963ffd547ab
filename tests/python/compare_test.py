# SPDX-License-Identifier: BSD-3-Clause
"""Comparisons of the package against those of the program."""
import json

import numpy as np
import pytest

import seaglint
from program import REFLECTOR, program


def table(file, azimuth, *options):
    made = program("rcs", "--target", REFLECTOR, "--frequency-ghz", "10", "--azimuth-deg", azimuth, "-o", file, *options)
    assert made.returncode == 0, made.stderr
    return file


def test_two_files(tmp_path):
    fine, same, other = (table(tmp_path / f"{name}.csv", f"0:14:{step}") for name, step in (("fine", "0.5"), ("same", "0.5"), ("other", "0.35")))
    equal = seaglint.compare(same, fine)
    assert {entry["polarisation"] for entry in equal["exports"]} == {"hh", "hv", "vh", "vv"}
    assert all(entry["rms_db"] == 0 for entry in equal["exports"])
    interpolated = seaglint.compare(other, fine, interpolate_m=0.6)
    assert all(entry["interpolation"]["omitted"] == 0 for entry in interpolated["exports"])
    several = seaglint.compare([same, fine], fine)
    assert several["exports"][:4] == equal["exports"] and len(several["exports"]) == 8


def test_with_a_mesh_is_that_of_the_program(tmp_path):
    # Physical optics alone as the export, so that the solver with edges differs from it.
    export = table(tmp_path / "po.csv", "0:20:2", "--edges", "off")
    made = program("compare", export, "--target", REFLECTOR, "--max-bounces", "6", "--floor-db", "40", "-o", tmp_path / "compared")
    assert made.returncode == 0, made.stderr
    expected = json.loads((tmp_path / "compared/compare.json").read_text())
    assert expected["exports"][0]["rms_db"] > 0
    assert seaglint.compare(export, target=REFLECTOR, max_bounces=6, floor_db=40) == expected
    of_arrays = seaglint.compare([export], target=seaglint.Mesh(REFLECTOR), max_bounces=6, floor_db=40)
    assert of_arrays == expected
    same = seaglint.compare(export, target=REFLECTOR, edges=False)
    assert all(entry["rms_db"] < 1e-6 for entry in same["exports"] if entry["polarisation"] in ("hh", "vv"))  # printed digits


def test_like_another_program(tmp_path):
    export = table(tmp_path / "like.csv", "0:20:4", "--like", "hfss")
    like = seaglint.compare(export, target=REFLECTOR, like="hfss")
    assert all(entry["rms_db"] < 1e-6 for entry in like["exports"] if entry["polarisation"] in ("hh", "vv"))  # printed digits
    assert like["exports"][0]["solver"] == {"like": "hfss", "crease_deg": 0, "edges": False, "max_bounces": 3, "method": "beams"}
    given = seaglint.compare(export, target=REFLECTOR, like="hfss", edges=True, max_bounces=5)
    assert given["exports"][0]["solver"] == {"like": "hfss", "crease_deg": 0, "edges": True, "max_bounces": 5, "method": "beams"}
    assert np.array_equal(seaglint.rcs(REFLECTOR, 10e9, [0, 4], like="hfss"), seaglint.rcs(REFLECTOR, 10e9, [0, 4], crease_deg=0, edges=False, max_bounces=3))


def test_a_sphere_has_a_known_value(tmp_path):
    """The series is within 0.1 dB of the optical level pi a^2, -5.49 dBsm, at ka 63."""
    sphere = tmp_path / "sphere.ply"
    assert program("mesh", "make", "sphere", "--radius-m", "0.3", "--subdivisions", "5", "-o", sphere).returncode == 0
    export = tmp_path / "levels.csv"
    export.write_text("# transmitter=monostatic\nfrequency_hz,azimuth_deg,elevation_deg,vv_dbsm\n1e10,0,0,-6.54\n1e10,5,0,-6.54\n")
    entry, = seaglint.compare(export, target=sphere)["exports"]
    assert abs(entry["known"]["export_bias_db"] + 6.54 - 5.49) < 0.1
    assert abs(entry["known"]["compared_bias_db"]) < 0.15 and entry["known"]["verdict"] == "seaglint is closer"


def test_what_an_export_does_not_say(tmp_path):
    """The four columns frequency_hz theta_deg phi_deg dBsm say neither polarisation nor incidence."""
    sigma = 4 * np.pi * np.abs(seaglint.rcs(REFLECTOR, 10e9, [0, 5, 10])[0, 0, :, 1, 1]) ** 2
    export = tmp_path / "levels.txt"
    export.write_text("".join(f"1e10 90 {phi} {10 * np.log10(value):.6f}\n" for phi, value in zip((0, 5, 10), sigma)))
    compared = seaglint.compare(export, target=REFLECTOR, polarisation="vv", incidence="monostatic")
    entry, = compared["exports"]
    assert entry["polarisation"] == "vv" and entry["pairs"] == 3 and entry["rms_db"] < 1e-5
    turned = seaglint.compare([export], target=REFLECTOR, polarisation=["vv"], incidence=["monostatic"], phi=(1, 3))
    assert turned["exports"][0]["rms_db"] > 0.01


def test_tables_by_azimuth_and_folders(tmp_path):
    """A chamber's table says neither frequency nor elevation; a folder is all its tables."""
    values = seaglint.rcs(REFLECTOR, 10e9, [0, 5, 10], elevation_deg=3)[0, 0]
    for name, element in (("HH", 0), ("VV", 1)):
        level = 10 * np.log10(4 * np.pi * np.abs(values[:, element, element]) ** 2)
        rows = "".join(f"{azimuth};{one:.6f}\n" for azimuth, one in zip((0, 5, 10), level))
        (tmp_path / f"{name}.csv").write_text(f"Azimuth (deg);{name} (dBsm)\n" + rows)
    compared = seaglint.compare(tmp_path, target=REFLECTOR, frequency_hz=10e9, elevation_deg=3)
    assert [entry["polarisation"] for entry in compared["exports"]] == ["hh", "vv"]
    assert all(entry["pairs"] == 3 and entry["rms_db"] < 1e-5 for entry in compared["exports"])
    with pytest.raises(seaglint.InputError, match="elevation_deg: value 91: must be within"):
        seaglint.compare(tmp_path, target=REFLECTOR, frequency_hz=10e9, elevation_deg=91)


@pytest.mark.parametrize("call, message", [
    (lambda file: seaglint.compare(file), "compare: give either target, a mesh, or against, a file"),
    (lambda file: seaglint.compare(file, file, target=REFLECTOR), "compare: give either target, a mesh, or against, a file"),
    (lambda file: seaglint.compare(file, target="none.stl"), "none.stl: no such file"),
    (lambda file: seaglint.compare("none.txt", target=REFLECTOR), "none.txt: cannot read: No such file or directory"),
    (lambda file: seaglint.compare([], target=REFLECTOR), "export: must be a file or several"),
    (lambda file: seaglint.compare(file, target=REFLECTOR, interpolate_m=1), "interpolate_m is for against"),
    (lambda file: seaglint.compare(file, target=REFLECTOR, polarisation="xx"), "xx: must be hh, hv, vh or vv"),
    (lambda file: seaglint.compare(file, target=REFLECTOR, polarisation=3), "polarisation: must be a text, not 3"),
    (lambda file: seaglint.compare(file, target=REFLECTOR, origin_m=(0, 0)), "must be 3 numbers"),
    (lambda file: seaglint.compare(file, target=REFLECTOR, floor_db=0), "floor_db: value 0: must be within 1 and 300"),
    (lambda file: seaglint.compare(file, target=REFLECTOR, unit="parsec"), "parsec"),
    (lambda file: seaglint.compare(file, target=REFLECTOR, like="xpatch"), "like: value 'xpatch': must be one of hfss, feko, cst"),
])
def test_wrong_input_is_one_sentence(tmp_path_factory, call, message):
    file = tmp_path_factory.getbasetemp() / "one.csv"
    if not file.exists():
        table(file, "0:4:2")
    with pytest.raises(seaglint.InputError) as error:
        call(file)
    assert message in str(error.value) and "\n" not in str(error.value)
