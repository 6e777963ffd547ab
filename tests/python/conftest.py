# SPDX-License-Identifier: BSD-3-Clause
"""Data sets that several tests read."""
import pytest
from program import program


@pytest.fixture(scope="session")
def data_set(tmp_path_factory):
    folder = tmp_path_factory.mktemp("points") / "set"
    made = program("generate", "points.yaml", "-o", folder, "--set", "dataset.maps_per_shard=7")
    assert made.returncode == 0, made.stderr
    return folder
