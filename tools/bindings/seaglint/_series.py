# SPDX-License-Identifier: BSD-3-Clause
"""Sea surface and motion of the bodies over time."""
from __future__ import annotations

import os

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._common import InputError, count, number, threads_of, warn
from ._scenario import Scenario, scenario_of

_AXES = ("x", "y", "z")
_ANGLES = ("roll", "pitch", "yaw")
_MOTIONS = ("roll_deg", "pitch_deg", "yaw_deg", "surge_m", "sway_m", "heave_m")


def _times(duration_s, step_s):
    """Number of the times 0, step, 2 step, ... and the step, as the options --duration-s and --step-s."""
    duration_s, step_s = number("duration_s", duration_s, 0, 1e6), number("step_s", step_s, 1e-4, 1e4)
    if duration_s / step_s >= 1e7:
        raise InputError(f"duration_s {duration_s:g} with step_s {step_s:g}: must be at most 10000000 times")
    return _core.uniform_time_count(duration_s, step_s), step_s


class SeaSeries:
    """The water surface at one place over time, of one sea realisation.

    time_s, elevation_m, elevation_linear_m (its linear part), slope_x, slope_y: [time], z up. velocity_mps,
    acceleration_mps2: [time, 3] of the water at the surface, x, y, z of the target frame; None without kinematics.
    units: {name: unit} of these ("1" = none). state: the sea state's wave height, peak period, direction, depth,
    order, number of components. statistics: of this realisation: significant_wave_height_m (4 sqrt(m0)), mean_period_s
    (T1), skewness, rms_slope (linear waves), cutoff_rad_s, ...
    """

    units = {"time_s": "s", "elevation_m": "m", "elevation_linear_m": "m", "slope_x": "1", "slope_y": "1", "velocity_mps": "m/s", "acceleration_mps2": "m/s^2"}

    time_s: NDArray[np.float64]
    elevation_m: NDArray[np.float64]
    elevation_linear_m: NDArray[np.float64]
    slope_x: NDArray[np.float64]
    slope_y: NDArray[np.float64]
    velocity_mps: NDArray[np.float64] | None
    acceleration_mps2: NDArray[np.float64] | None
    state: dict[str, float]
    statistics: dict[str, float]

    def __init__(self, time_s, parts):
        self.time_s, self.state, self.statistics = time_s, parts["state"], parts["statistics"]
        self.elevation_m, self.elevation_linear_m, self.slope_x, self.slope_y = parts["shape"].T
        kinematics = parts.get("kinematics")
        self.velocity_mps, self.acceleration_mps2 = (None, None) if kinematics is None else (kinematics[:, 0], kinematics[:, 1])

    def columns(self) -> dict[str, NDArray[np.float64]]:
        """{column of the command's CSV: [time]}, for pandas.DataFrame(series.columns())."""
        table = {name: getattr(self, name) for name in ("time_s", "elevation_m", "elevation_linear_m", "slope_x", "slope_y")}
        if self.velocity_mps is not None:
            table |= {f"velocity_{axis}_mps": self.velocity_mps[:, i] for i, axis in enumerate(_AXES)}
            table |= {f"acceleration_{axis}_mps2": self.acceleration_mps2[:, i] for i, axis in enumerate(_AXES)}
        return table

    def __repr__(self):
        return f"<seaglint.SeaSeries: {len(self.time_s)} times to {self.time_s[-1]:g} s, Hs {self.statistics['significant_wave_height_m']:.3g} m>"


def sea(scenario: Scenario | str | os.PathLike | dict, realisation: int = 0, *, sea_state: int = 0, at_m: tuple[float, float] = (0.0, 0.0), kinematics: bool = False,
        duration_s: float = 600.0, step_s: float = 0.1) -> SeaSeries:
    """Elevation and slope of the water over time, with kinematics=True its velocity and acceleration: `seaglint sea`.

    realisation: of the sea state; those below dataset.realisations_per_case are the seas of the data set. sea_state:
    number in the sweep of wave heights and periods, as the column sea_state of the data set. at_m: place x, y in the
    target frame, m. Times 0, step_s, 2 step_s, ... up to duration_s.
    """
    place = [number("at_m", value, -1e4, 1e4) for value in np.asarray(at_m).reshape(-1).tolist()]
    if len(place) != 2:
        raise InputError(f"at_m: must be two numbers, x and y, not {len(place)}")
    times, step_s = _times(duration_s, step_s)
    source, choice = scenario_of(scenario)._core, _core.SeaChoice(count("sea_state", sea_state), count("realisation", realisation))
    series = SeaSeries(step_s * np.arange(times), _core.sea(source, choice, place, times, step_s, bool(kinematics)))
    warn(_core.sea_warnings(source))
    return series


class MotionSeries:
    """Motion of every body of a scenario over time, of one sea realisation.

    bodies: their names, `ship`, `array_1`, `array_2`, ... time_s: [time]. roll_deg, pitch_deg, yaw_deg, surge_m,
    sway_m, heave_m: [body, time]; right-handed about and along x (bow), y (port), z (up), so that pitch > 0 puts the
    bow down; translations are those of the rotation centre. units: {name: unit}. statistics: {"roll": {"mean_deg",
    "rms_deg" (about the mean), "largest_deg" (modulus), "mean_period_s" (2 pi rms / rms of the rate; nan of a constant
    angle)}: [body]}, likewise pitch and yaw, from samples 0.1 s apart. state: as that of SeaSeries. notes: how motion
    files were read.
    """

    units = {"time_s": "s", "roll_deg": "deg", "pitch_deg": "deg", "yaw_deg": "deg", "surge_m": "m", "sway_m": "m", "heave_m": "m"}

    bodies: list[str]
    time_s: NDArray[np.float64]
    roll_deg: NDArray[np.float64]
    pitch_deg: NDArray[np.float64]
    yaw_deg: NDArray[np.float64]
    surge_m: NDArray[np.float64]
    sway_m: NDArray[np.float64]
    heave_m: NDArray[np.float64]
    state: dict[str, float]
    statistics: dict[str, dict[str, NDArray[np.float64]]]
    notes: list[str]

    def __init__(self, time_s, parts):
        self.time_s, self.bodies, self.state, self.notes = time_s, parts["bodies"], parts["state"], parts["notes"]
        for name, values in zip(_MOTIONS, parts["values"]):
            setattr(self, name, values)
        figures = parts["figures"]
        figures[:, 3][figures[:, 3] == 0] = np.nan
        self.statistics = {angle: dict(zip(("mean_deg", "rms_deg", "largest_deg", "mean_period_s"), row)) for angle, row in zip(_ANGLES, figures)}

    def columns(self, body: str | int = 0) -> dict[str, NDArray[np.float64]]:
        """{column of the command's CSV: [time]} of one body, for pandas.DataFrame(motion.columns("ship"))."""
        if isinstance(body, str):
            if body not in self.bodies:
                raise InputError(f"no body {body}; the bodies are {', '.join(self.bodies)}")
            body = self.bodies.index(body)
        return {"time_s": self.time_s} | {name: getattr(self, name)[body] for name in _MOTIONS}

    def __repr__(self):
        return f"<seaglint.MotionSeries: {', '.join(self.bodies)}, {len(self.time_s)} times to {self.time_s[-1]:g} s>"


def motion(scenario: Scenario | str | os.PathLike | dict, realisation: int = 0, *, sea_state: int = 0, duration_s: float = 100.0, step_s: float = 0.1, threads: int = 0) -> MotionSeries:
    """Six degrees of freedom of every body over time, with statistics of the angles: `seaglint motion`.

    realisation, sea_state: as of sea(), whose surface moves these bodies. Times 0, step_s, 2 step_s, ... up to
    duration_s. The result does not depend on threads (0 = all processors).
    """
    times, step = _times(duration_s, step_s)
    source, choice = scenario_of(scenario)._core, _core.SeaChoice(count("sea_state", sea_state), count("realisation", realisation))
    series = MotionSeries(step * np.arange(times), _core.motion(source, choice, number("duration_s", duration_s), times, step, threads_of(threads)))
    warn(_core.sea_warnings(source))
    return series
