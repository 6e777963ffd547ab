# SPDX-License-Identifier: BSD-3-Clause
"""Samples of a scenario."""
from __future__ import annotations

import os

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._scenario import Scenario, scenario_of


class Sample:
    """One sample of a scenario.

    map: complex [velocity, range], m, of target, clutter and noise; range_m, velocity_mps: its axes (positive =
    farther, receding). echo: complex [pulse, frequency], carrier_hz, pulse_time_s, hop_code: [pulse]. centres:
    [centre, 3] range (m), velocity (m/s), amplitude (m), strongest first. columns: label, target, sea state, aspect,
    features, as the data set stores them.
    """

    map: NDArray[np.complex128]
    range_m: NDArray[np.float64]
    velocity_mps: NDArray[np.float64]
    echo: NDArray[np.complex128]
    carrier_hz: NDArray[np.float64]
    pulse_time_s: NDArray[np.float64]
    hop_code: NDArray[np.int32]
    centres: NDArray[np.float64]
    columns: dict

    def __init__(self, parts):
        self.__dict__.update(parts)

    def __repr__(self):
        return f"<seaglint.Sample {self.columns['sample']}: {self.columns['target_name']}, map {self.map.shape}>"


class Simulator:
    """Makes any sample of a scenario, in any order: simulator[k]. Meshes are loaded once, seas of the last samples kept."""

    def __init__(self, scenario: Scenario | str | os.PathLike | dict):
        self.scenario = scenario_of(scenario)
        self._core = _core.Pipeline(self.scenario._core)

    def __len__(self):
        return len(self._core)

    def __getitem__(self, k: int) -> Sample:
        k = int(k)
        if not -len(self) <= k < len(self):
            raise IndexError(f"sample {k}: the scenario has samples 0 to {len(self) - 1}")
        return Sample(self._core.sample(k % len(self)))


def sample(scenario: Scenario | str | os.PathLike | dict, k: int) -> Sample:
    """Sample k of a scenario (Sample). For several samples of one, Simulator(scenario)[k] or a Scenario object."""
    if not isinstance(scenario, Scenario):
        return Simulator(scenario)[k]
    if scenario._pipeline is None:
        scenario._pipeline = Simulator(scenario)
    return scenario._pipeline[k]
