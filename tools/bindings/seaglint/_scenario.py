# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios."""
from __future__ import annotations

import json
import os
from collections.abc import Mapping

from . import _core
from ._common import overrides


class Scenario:
    """A scenario: a YAML file, one of the program by its name (`quick.yaml`), or a dictionary of its keys.

    set: values that replace those of the scenario, {"radar.pulses": 64}. len() is the number of its samples.
    """

    def __init__(self, source: str | os.PathLike | dict, set: Mapping[str, object] | None = None):
        pairs = overrides(set or {})
        if isinstance(source, dict):
            self._core = _core.Scenario.parse(json.dumps(source), "scenario", pairs)
        else:
            self._core = _core.Scenario.read(os.fspath(source), pairs)
        self._pipeline = None

    name = property(lambda self: self._core.name, doc="Its name, by default that of the file.")
    seed = property(lambda self: self._core.seed)
    targets = property(lambda self: self._core.targets, doc="Names of the targets; none for the sea alone.")

    def yaml(self) -> str:
        """The scenario with all defaults, as YAML."""
        return self._core.yaml()

    def __len__(self):
        return len(self._core)

    def __repr__(self):
        return f"<seaglint.Scenario {self.name}: {len(self)} samples>"


def scenario_of(source: Scenario | str | os.PathLike | dict) -> Scenario:
    """The scenario itself, or that of a file or dictionary."""
    return source if isinstance(source, Scenario) else Scenario(source)
